//! Mesh quality: lengths of the edges and aspect ratios of the triangles.
//!
//! ```text
//!        ╱╲           longest edge l, least height h = 2A / l
//!      ╱ h┊ ╲         aspect ratio l / h = l² / 2A; at least 2/√3, that of equal edges
//!    ╱────┴───╲
//!         l
//! ```
//! Reads the rest mesh after the repair; writes the quality fields of `MeshReport`.
//! Invariant: each edge counts once; sums are in the order of the mesh.

use crate::mesh::report::{MeshReport, THIN_ASPECT};
use crate::mesh::{Mesh, next_corner};
use glam::{DVec3, Vec3};

impl MeshReport {
    /// Measures the edges and triangles of `mesh` with its rest positions [m]. `given` returns the
    /// number of a triangle in the given list.
    pub(crate) fn measure_quality(
        &mut self,
        mesh: &Mesh,
        position: impl Fn(u32) -> Vec3,
        given: impl Fn(u32) -> u32,
    ) {
        let position = |corner: u32| position(mesh.vertex(corner)).as_dvec3();
        let length = |corner: u32| (position(next_corner(corner)) - position(corner)).length();
        let (mut shortest, mut sum, mut count) = (f64::INFINITY, 0.0, 0.0);
        for corner in mesh.edges() {
            let length = length(corner);
            shortest = if length < shortest { length } else { shortest };
            sum += length;
            count += 1.0;
        }
        let mut worst = 0.0;
        self.thin_triangles = 0;
        for triangle in 0..mesh.triangles.len() as u32 {
            let aspect = aspect([0, 1, 2].map(|k| position(3 * triangle + k)));
            self.thin_triangles += u32::from(aspect > THIN_ASPECT);
            if aspect > worst {
                (worst, self.thinnest_triangle) = (aspect, given(triangle));
            }
        }
        self.shortest_edge = shortest as f32;
        self.mean_edge = (sum / count) as f32;
        self.worst_aspect = worst as f32;
    }
}

/// Returns the longest edge of a triangle divided by its least height.
fn aspect([a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let [ab2, bc2, ca2] = [ab, bc, ca].map(DVec3::length_squared);
    let longest2 = if ab2 > bc2 { ab2 } else { bc2 };
    let longest2 = if longest2 > ca2 { longest2 } else { ca2 };
    longest2 / ab.cross(ca).length()
}
