//! Welding: vertices that lie together become one.
//!
//! Vertices are processed in order. Each one is welded to the nearest kept vertex within the
//! distance (of equally near ones the lowest), otherwise it is kept. So every welded vertex is near
//! the vertex that it is welded to: the distances of a row of near vertices do not add up. A vertex
//! is not welded to a kept vertex if a triangle with an area joins it to that vertex, or to another
//! vertex that is welded to that vertex.
//!
//! Candidates come from a hash grid of cells twice as wide as the distance: eight cells cover the
//! ball.
//!
//! Reads positions and triangles; returns the target of each vertex.

use crate::mesh::NONE;
use crate::mesh::intake::remove_degenerate::is_degenerate;
use glam::{DVec3, Vec3};

/// For each vertex the vertex it is welded to, which may be itself. A `distance` [m] of 0 welds
/// equal positions; a negative one welds nothing.
pub(super) fn weld(positions: &[Vec3], triangles: &[[u32; 3]], distance: f32) -> Vec<u32> {
    let mut welded_to: Vec<u32> = (0..positions.len() as u32).collect();
    if distance < 0.0 {
        return welded_to;
    }
    let neighbors = VertexNeighbors::new(positions, triangles);
    let mut kept = KeptVertices::new(f64::from(distance), positions.len());
    for (vertex, position) in positions.iter().enumerate() {
        let at = position.as_dvec3();
        let mut nearest: Option<(f64, u32)> = None;
        for other in kept.candidates(at) {
            let distance_squared = (positions[other as usize].as_dvec3() - at).length_squared();
            let is_nearer = nearest.is_none_or(|(least, lowest)| {
                distance_squared < least || (distance_squared == least && other < lowest)
            });
            if distance_squared <= kept.distance * kept.distance
                && is_nearer
                && !neighbors.share_a_triangle(vertex as u32, other, &welded_to)
            {
                nearest = Some((distance_squared, other));
            }
        }
        match nearest {
            Some((_, other)) => welded_to[vertex] = other,
            None => kept.insert(vertex as u32, at),
        }
    }
    welded_to
}

/// Neighbours of each vertex in triangles with an area, in CSR layout: `others[first[v]..first[v +
/// 1]]` holds the two other corners of each triangle of v.
struct VertexNeighbors {
    first: Vec<u32>,
    others: Vec<[u32; 2]>,
}

impl VertexNeighbors {
    fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let has_area = |corners: &&[u32; 3]| !is_degenerate(positions, corners);
        let mut first = vec![0u32; positions.len() + 1];
        for v in triangles.iter().filter(has_area).flatten() {
            first[*v as usize + 1] += 1;
        }
        for v in 1..first.len() {
            first[v] += first[v - 1];
        }
        let mut next = first.clone();
        let mut others = vec![[0; 2]; first.last().map_or(0, |all| *all as usize)];
        for [a, b, c] in triangles.iter().filter(has_area) {
            for [v, p, q] in [[a, b, c], [b, c, a], [c, a, b]] {
                let at = &mut next[*v as usize];
                others[*at as usize] = [*p, *q];
                *at += 1;
            }
        }
        Self { first, others }
    }

    /// Whether `vertex` shares a triangle with `other`, or with an earlier vertex that was welded
    /// to `other`.
    fn share_a_triangle(&self, vertex: u32, other: u32, welded_to: &[u32]) -> bool {
        let range = self.first[vertex as usize] as usize..self.first[vertex as usize + 1] as usize;
        self.others[range].as_flattened().iter().any(|v| welded_to[*v as usize] == other)
    }
}

/// The kept vertices in a hash grid with cells of twice the distance; the vertices of the cells that
/// share a bucket form a linked list.
///
/// It has its own buckets: the hash function of the standard library would make the wasm modules 1 %
/// larger.
struct KeptVertices {
    distance: f64,
    /// The cell of each kept vertex.
    cells: Vec<[i64; 3]>,
    /// The last kept vertex of each bucket; a power of two of them.
    heads: Vec<u32>,
    next: Vec<u32>,
}

impl KeptVertices {
    fn new(distance: f64, count: usize) -> Self {
        let heads = vec![NONE; (2 * count).next_power_of_two()];
        Self { distance, cells: vec![[0; 3]; count], heads, next: vec![NONE; count] }
    }

    /// The bucket of a cell.
    fn bucket(&self, cell: [i64; 3]) -> usize {
        let hash = cell.into_iter().fold(0, |hash: u64, index| {
            (hash ^ hash >> 32 ^ index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        });
        (hash >> 32) as usize & (self.heads.len() - 1)
    }

    /// Position in units of a cell. With distance 0 every position is its own cell.
    fn scaled(&self, at: DVec3) -> [f64; 3] {
        at.to_array().map(|x| if self.distance > 0.0 { x / (2.0 * self.distance) } else { x })
    }

    fn cell(&self, at: DVec3) -> [i64; 3] {
        if self.distance > 0.0 {
            self.scaled(at).map(|x| x.floor() as i64)
        } else {
            // Adding +0 maps −0 to +0.
            at.to_array().map(|x| (x + 0.0).to_bits() as i64)
        }
    }

    fn insert(&mut self, vertex: u32, at: DVec3) {
        let cell = self.cell(at);
        let bucket = self.bucket(cell);
        self.cells[vertex as usize] = cell;
        self.next[vertex as usize] = core::mem::replace(&mut self.heads[bucket], vertex);
    }

    /// All kept vertices that may be within the distance: those of its cell and of the neighbouring
    /// cells on the nearer side of each axis.
    fn candidates(&self, at: DVec3) -> impl Iterator<Item = u32> {
        let cell = self.cell(at);
        let nearer_side = self.scaled(at).map(|x| if x - x.floor() < 0.5 { -1 } else { 1 });
        let cell_count = if self.distance > 0.0 { 8 } else { 1 };
        (0..cell_count).flat_map(move |offset: usize| {
            let mut other = cell;
            for axis in 0..3 {
                if offset >> axis & 1 == 1 {
                    other[axis] = other[axis].saturating_add(nearer_side[axis]);
                }
            }
            let some = |at: u32| (at != NONE).then_some(at);
            let head = self.heads[self.bucket(other)];
            core::iter::successors(some(head), move |at| some(self.next[*at as usize]))
                .filter(move |at| self.cells[*at as usize] == other)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(xs: &[f32]) -> Vec<Vec3> {
        xs.iter().map(|x| Vec3::X * *x).collect()
    }

    #[test]
    fn a_vertex_is_welded_to_the_nearest_kept_vertex() {
        assert_eq!(weld(&along(&[0.0, 1.0, 0.45, 0.55, 0.5]), &[], 0.5), [0, 1, 0, 1, 0]);
    }

    #[test]
    fn chains_of_small_steps_do_not_accumulate() {
        assert_eq!(weld(&along(&[0.0, 0.4, 0.8, 1.2]), &[], 0.5), [0, 0, 2, 2]);
    }

    #[test]
    fn distance_zero_welds_equal_positions_and_a_negative_distance_nothing() {
        let points = along(&[0.0, -0.0, 1.0, 1.0, 1.0 + f32::EPSILON]);
        assert_eq!(weld(&points, &[], 0.0), [0, 0, 2, 2, 4]);
        assert_eq!(weld(&points, &[], -1.0), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn corners_of_a_triangle_are_not_welded_together() {
        let points = [Vec3::ZERO, Vec3::X * 0.1, Vec3::Y, Vec3::X * 0.12, Vec3::X * 0.04];
        // 1 shares a triangle with 0; 3 is welded to 1, and 4 to the nearer of both.
        assert_eq!(weld(&points, &[[0, 1, 2]], 0.2), [0, 1, 2, 1, 0]);
        // 3 shares a triangle with 1, which is nearest.
        assert_eq!(weld(&points, &[[0, 1, 2], [1, 3, 2]], 0.2), [0, 1, 2, 0, 0]);
    }

    #[test]
    fn candidates_in_neighbouring_cells_are_found() {
        let mut points = Vec::new();
        for at in 0..64 {
            points.push(Vec3::new((at % 4) as f32, (at / 4 % 4) as f32, (at / 16) as f32) * 0.25);
        }
        let moved: Vec<Vec3> = points.iter().map(|p| *p + Vec3::new(0.06, -0.06, 0.06)).collect();
        points.extend(moved);
        let welded_to = weld(&points, &[], 0.11);
        assert!(
            (0..64).all(|v| welded_to[v] == v as u32 && welded_to[v + 64] == v as u32),
            "{welded_to:?}"
        );
    }
}
