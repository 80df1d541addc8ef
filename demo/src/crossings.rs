//! The exact crossing test of the library's tests, for the tests of the demo.

#[allow(dead_code)]
#[path = "../../tests/common/crossings.rs"]
mod exact;

use muslin::Cloth;

pub use exact::crossing_count;

/// Returns the vertices of each triangle.
fn triangles(cloth: &Cloth) -> Vec<[u32; 3]> {
    cloth.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()
}
