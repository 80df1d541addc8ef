//! The triangles of a cloth as they are after a tick, with the tree over them.

use super::bvh::Bvh;
use muslin::Cloth;
use muslin::glam::DVec3;

/// Triangles of particles: vertices of one particle (a UV seam) count as one corner.
#[derive(Debug)]
pub struct Surface {
    /// Particles of each triangle.
    pub corners: Vec<[u32; 3]>,
    /// The tree over the triangles, in the same order.
    pub tree: Bvh,
}

impl Surface {
    /// Reads the triangles of a cloth whose positions are finite.
    pub fn of(cloth: &Cloth) -> Self {
        let particles = cloth.vertex_particles();
        let (indices, _) = cloth.indices().as_chunks::<3>();
        let corners: Vec<[u32; 3]> =
            indices.iter().map(|t| t.map(|v| particles[v as usize])).collect();
        let positions = cloth.positions();
        let at = |v: u32| positions[v as usize].as_dvec3();
        let triangles: Vec<[DVec3; 3]> = indices.iter().map(|t| t.map(at)).collect();
        Self { corners, tree: Bvh::new(triangles) }
    }
}
