//! The mesh of a skin descriptor: its checks, its normals, tangents and inner edges.
//!
//! Method: area-weighted normals, summed over all vertices at the same position, so that a texture
//! seam of the skin does not show; tangents as in `solver::output::tangents`.
//!
//! Reads a [`SkinDesc`]; writes nothing.
//! Invariant: every normal is a unit vector or zero.

use crate::error::{Result, check, check_finite, check_index};
use crate::math::sort::{sort, sort_by};
use crate::mesh::{Corner, next_corner};
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Largest number of vertices.
const MAX_VERTICES: usize = 1 << 22;

/// A render mesh that follows a cloth. See [`Skin`](crate::Skin).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkinDesc {
    /// Positions of the vertices [m], where the cloth is now; from 3 to 4194304. None may be
    /// farther from the cloth than half the diagonal of the cloth's bounding box.
    pub positions: Vec<Vec3>,
    /// Three vertices per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Texture coordinates, one entry per vertex, or empty for none.
    pub uvs: Vec<Vec2>,
    /// Curvature over each triangle of the cloth, from 0 (flat triangles) to 1. Default 1.
    ///
    /// Above 0, a fine skin has a smooth outline on a coarse cloth (Phong tessellation). At 1 a
    /// skin lies on a circle between particles that lie on one. Particles are on the surface for
    /// any value.
    pub smoothness: f32,
}

impl Default for SkinDesc {
    fn default() -> Self {
        Self { positions: Vec::new(), indices: Vec::new(), uvs: Vec::new(), smoothness: 1.0 }
    }
}

impl SkinDesc {
    /// Checks every field.
    pub(super) fn check(&self) -> Result<()> {
        let count = self.positions.len();
        check(count >= 3, "positions", "hold at least 3 vertices")?;
        check(count <= MAX_VERTICES, "positions", "hold at most 4194304 vertices")?;
        self.positions.iter().try_for_each(|position| check_finite(*position, "positions"))?;
        let triples = !self.indices.is_empty() && self.indices.len().is_multiple_of(3);
        check(triples, "indices", "hold three entries for each of one or more triangles")?;
        self.indices.iter().try_for_each(|vertex| check_index(*vertex, count, "indices"))?;
        let fits = self.uvs.is_empty() || self.uvs.len() == count;
        check(fits, "uvs", "have as many entries as `positions`, or none")?;
        check(self.uvs.iter().all(|uv| uv.is_finite()), "uvs", "be finite")?;
        check((0.0..=1.0).contains(&self.smoothness), "smoothness", "be from 0 to 1")
    }

    /// The vertices of each triangle.
    pub(super) fn triangles(&self) -> &[[u32; 3]] {
        self.indices.as_chunks().0
    }

    /// The texture coordinates; zeros if there are none.
    pub(super) fn uvs(&self) -> Vec<Vec2> {
        let mut uvs = self.uvs.clone();
        uvs.resize(self.positions.len(), Vec2::ZERO);
        uvs
    }

    /// The center of each triangle [m].
    pub(super) fn centers(&self) -> Vec<Vec3> {
        let center = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| self.positions[v as usize]);
            a + ((b - a) + (c - a)) * (1.0 / 3.0)
        };
        self.triangles().iter().map(center).collect()
    }

    /// For each vertex the mean of the centers of its triangles; its position if it has none.
    pub(super) fn inner_points(&self) -> Vec<Vec3> {
        let centers = self.centers();
        let mut sums = vec![(Vec3::ZERO, 0.0); self.positions.len()];
        for (corners, center) in self.triangles().iter().zip(&centers) {
            for v in corners {
                let (sum, count) = &mut sums[*v as usize];
                *sum += *center - self.positions[*v as usize];
                *count += 1.0;
            }
        }
        let mean = |((sum, count), x): (&(Vec3, f32), &Vec3)| {
            if *count > 0.0 { *x + *sum * (1.0 / *count) } else { *x }
        };
        sums.iter().zip(&self.positions).map(mean).collect()
    }

    /// The unit normal of each vertex; zero where there is none. `first` is the lowest vertex at
    /// the position of each.
    pub(super) fn normals(&self, first: &[u32]) -> Vec<Vec3> {
        let mut sums = vec![Vec3::ZERO; first.len()];
        for corners in self.triangles() {
            let [a, b, c] = corners.map(|v| self.positions[v as usize]);
            let area = (b - a).cross(c - a);
            corners.iter().for_each(|v| sums[first[*v as usize] as usize] += area);
        }
        let unit = |first: &u32| {
            let sum = sums[*first as usize];
            let inverse = 1.0 / sum.length();
            if inverse.is_finite() { sum * inverse } else { Vec3::ZERO }
        };
        first.iter().map(unit).collect()
    }

    /// The lowest vertex at the position of each vertex.
    pub(super) fn first_at_position(&self) -> Vec<u32> {
        // Adding zero turns −0 to 0.
        let bits = |v: u32| (self.positions[v as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        sort_by(&mut order, |a, b| bits(*a).cmp(&bits(*b)).then(a.cmp(b)));
        let mut first: Vec<u32> = (0..order.len() as u32).collect();
        for pair in order.windows(2) {
            if bits(pair[0]) == bits(pair[1]) {
                first[pair[1] as usize] = first[pair[0] as usize];
            }
        }
        first
    }

    /// The direction in which u grows at each vertex, not normalised, and the handedness: 1 or −1.
    pub(super) fn tangents(&self) -> Vec<(Vec3, f32)> {
        let mut sums = vec![(Vec3::ZERO, 0.0); self.positions.len()];
        if self.uvs.is_empty() {
            return sums.iter().map(|(sum, _)| (*sum, 1.0)).collect();
        }
        for corners in self.triangles() {
            let [a, b, c] = corners.map(|v| self.positions[v as usize]);
            let [ua, ub, uc] = corners.map(|v| self.uvs[v as usize]);
            let (u, v) = (ub - ua, uc - ua);
            let area = u.perp_dot(v);
            let sign = if area < 0.0 { -1.0 } else { 1.0 };
            let along = ((b - a) * v.y - (c - a) * u.y) * sign;
            for corner in corners {
                let (sum, total) = &mut sums[*corner as usize];
                *sum += along;
                *total += area;
            }
        }
        sums.iter().map(|(sum, area)| (*sum, if *area < 0.0 { -1.0 } else { 1.0 })).collect()
    }

    /// Pairs of corners where the two triangles of an inner edge start it.
    pub(super) fn inner_edges(&self) -> Vec<[Corner; 2]> {
        let mut edges: Vec<([u32; 2], Corner)> = (0..self.indices.len() as u32)
            .map(|corner| {
                let [a, b] = [corner, next_corner(corner)].map(|at| self.indices[at as usize]);
                ([a.min(b), a.max(b)], corner)
            })
            .collect();
        sort(&mut edges);
        let twins = edges.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        twins.map(|pair| [pair[0].1, pair[1].1]).collect()
    }
}
