//! Points of the uncut cloth, and where they are after cuts.
//!
//! ```text
//!        C                    C
//!       ╱ ╲                  ╱ ╲          The root triangle A B C was divided; the same point,
//!      ╱ • ╲       ─▶       ╱ •─╲         with the same weights of A, B, C, lies on one of its
//!     ╱     ╲              ╱──   ╲        pieces.
//!    A───────B            A───────B
//! ```
//! Method: every site that a cut created lies between two older ones, so it has barycentric weights
//! of the corners of its root triangle, and so has each corner of a piece. Pieces with the same
//! three root sites belong together. A point is on the piece where its smallest weight is largest.
//!
//! Reads the mesh and the sites that cuts created; writes nothing.
//! Invariant: a [`RootPoint`] never changes, whatever is torn, cut or reset; a point that is a
//! corner of a piece has one weight of exactly 1 there.

use crate::math::sort::sort;
use crate::mesh::NONE;
use crate::mesh::split_edge::CutSite;
use crate::solver::world::World;
use glam::Vec3;

/// A point of the uncut cloth.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootPoint {
    /// Sites at the corners of its triangle, in ascending order.
    sites: [u32; 3],
    /// Barycentric weights of these sites.
    weights: Vec3,
}

/// A point of the cloth as it is now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Location {
    pub triangle: u32,
    /// Barycentric weights of the corners of the triangle.
    pub weights: [f32; 3],
    /// The direction from the first to the second root site: multiples of the edges from corner 0
    /// to corner 1 and to corner 2.
    pub direction: [f32; 2],
}

/// A site as a weighted sum of original sites; unused entries are `NONE`.
type SiteWeights = [(u32, f32); 3];

/// A triangle of the mesh, as a piece of its root triangle.
#[derive(Clone, Copy, Debug)]
struct Piece {
    sites: [u32; 3],
    triangle: u32,
    /// Weights of the three sites at each corner.
    corners: [Vec3; 3],
}

/// All triangles of the mesh, grouped by root triangle.
#[derive(Debug)]
pub(super) struct RootTriangles {
    /// Ordered by root sites and then by number.
    pieces: Vec<Piece>,
    /// The piece of each triangle; `NONE` for a triangle without an area.
    piece: Vec<u32>,
}

impl RootTriangles {
    pub fn new(world: &World) -> Self {
        let sites = site_weights(world.rest.len() - world.cut_sites.len(), &world.cut_sites);
        let mesh = &world.mesh;
        let mut keys = Vec::with_capacity(mesh.triangles.len());
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            let of_corners = corners.map(|v| sites[mesh.source[v as usize] as usize]);
            if let Some(sites) = root_sites(&of_corners) {
                keys.push((sites, triangle as u32));
            }
        }
        sort(&mut keys);
        let mut all = Self {
            pieces: Vec::with_capacity(keys.len()),
            piece: vec![NONE; mesh.triangles.len()],
        };
        for (at, (roots, triangle)) in keys.iter().enumerate() {
            let corners = mesh.triangles[*triangle as usize].map(|v| {
                let weights = sites[mesh.source[v as usize] as usize];
                let of = |site: u32| weights.iter().find(|(one, _)| *one == site);
                Vec3::from_array(roots.map(|site| of(site).map_or(0.0, |(_, weight)| *weight)))
            });
            all.piece[*triangle as usize] = at as u32;
            all.pieces.push(Piece { sites: *roots, triangle: *triangle, corners });
        }
        all
    }

    /// Returns the root point of a point of a triangle.
    pub fn root_point(&self, triangle: u32, weights: [f32; 3]) -> Option<RootPoint> {
        let piece = self.pieces.get(self.piece[triangle as usize] as usize)?;
        let [a, b, c] = piece.corners;
        let weights = a * weights[0] + b * weights[1] + c * weights[2];
        Some(RootPoint { sites: piece.sites, weights })
    }

    /// Returns where a point is now; `None` if the cloth never had its triangle.
    pub fn locate(&self, point: &RootPoint) -> Option<Location> {
        let first = self.pieces.partition_point(|piece| piece.sites < point.sites);
        let pieces = self.pieces[first..].iter().take_while(|piece| piece.sites == point.sites);
        let mut best: Option<(f32, Location)> = None;
        for piece in pieces {
            let Some(location) = piece.locate(point.weights) else { continue };
            let [a, b, c] = location.weights;
            let least = crate::math::min(a, crate::math::min(b, c));
            if best.is_none_or(|(most, _)| least > most) {
                best = Some((least, location));
            }
        }
        best.map(|(_, location)| location)
    }
}

impl Piece {
    /// Returns a root point in terms of this piece's corners; `None` if the piece has no area.
    fn locate(&self, weights: Vec3) -> Option<Location> {
        // Weights add up to 1, so two of the three are coordinates of the plane.
        let [a, b, c] = self.corners.map(Vec3::truncate);
        let (p, q, r) = (b - a, c - a, weights.truncate() - a);
        let area = p.perp_dot(q);
        let inverse = 1.0 / area;
        let solve = |v: glam::Vec2| [v.perp_dot(q) * inverse, p.perp_dot(v) * inverse];
        let [u, v] = solve(r);
        let direction = solve(glam::Vec2::new(-1.0, 1.0));
        let location =
            Location { triangle: self.triangle, weights: [1.0 - u - v, u, v], direction };
        inverse.is_finite().then_some(location)
    }
}

/// Returns every site as a weighted sum of the `original` ones.
fn site_weights(original: usize, cut_sites: &[CutSite]) -> Vec<SiteWeights> {
    const EMPTY: (u32, f32) = (NONE, 0.0);
    let mut all: Vec<SiteWeights> = Vec::with_capacity(original + cut_sites.len());
    all.extend((0..original as u32).map(|site| [(site, 1.0), EMPTY, EMPTY]));
    for cut in cut_sites {
        let mut sum = [EMPTY; 3];
        for (end, share) in cut.ends.into_iter().zip([1.0 - cut.fraction, cut.fraction]) {
            for (site, weight) in all[end as usize].into_iter().filter(|(site, _)| *site != NONE) {
                let entry = sum.iter_mut().find(|(one, _)| *one == site || *one == NONE);
                // An edge lies in one root triangle, so three entries are enough.
                if let Some(entry) = entry {
                    *entry = (site, entry.1 + weight * share);
                }
            }
        }
        all.push(sum);
    }
    all
}

/// Returns the three original sites, in ascending order, of a triangle with these corners; `None`
/// if it lies on an edge of its root triangle.
fn root_sites(corners: &[SiteWeights; 3]) -> Option<[u32; 3]> {
    let mut sites = [NONE; 3];
    for (site, _) in corners.as_flattened().iter().filter(|(site, _)| *site != NONE) {
        let entry = sites.iter_mut().find(|one| **one == *site || **one == NONE)?;
        *entry = *site;
    }
    sort(&mut sites);
    (sites[2] != NONE).then_some(sites)
}
