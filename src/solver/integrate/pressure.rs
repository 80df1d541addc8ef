//! Stage `Forces`, pressure: the over-pressure inside closed pieces of the cloth.
//!
//! ```text
//!        ╱▲╲  p A n                        p: over-pressure [Pa], constant
//!      ◀╱  ╲▶                              A n: area times normal, outwards
//!      ╱────╲     f_i = p / 3 · Σ A n      over the triangles around particle i
//!        ▼             = p ∂V / ∂x_i
//! ```
//! Method: the force is the gradient of p V, with V the enclosed volume, so it has neither a net
//! force nor a net torque. It acts in every substep on the predicted positions, where the links
//! answer it: evaluated once per tick, it would lag behind a piece that spins, and turn it.
//!
//! A piece is closed if every edge of its triangles has two of them, wound consistently. Its
//! outside is where the volume of its rest shape is positive, or where the windings say if that
//! volume is zero.
//!
//! Reads settings, mesh, rest positions, piece labels and predicted positions; writes positions,
//! `scratch.pieces.outward`, and the scratch list `relative_wind`, which is free at that time.
//! Invariant: the forces on a closed piece that nothing holds add up to zero but for rounding, also
//! where `max_displacement` limits them: the whole piece then gets a lower pressure.

use crate::math::max;
use crate::mesh::{Mesh, NONE, next_corner, triangle_of};
use crate::solver::world::World;
use glam::{DVec3, Vec3};

/// Volume of a rest shape, over the power 3/2 of its area, below which it counts as zero: rounding
/// of positions contributes less.
const MIN_VOLUME: f64 = 1.0e-6;

/// Finds the closed pieces, if there is pressure and the mesh changed since the last time.
pub(crate) fn begin_tick(world: &mut World) {
    if world.settings.pressure != 0.0 && world.scratch.pieces.outward.is_empty() {
        find_closed_pieces(world);
    }
}

/// Moves the particles of closed pieces by the pressure of one substep.
pub(crate) fn apply(world: &mut World) {
    if world.has_pressure() {
        push_particles(world);
    }
}

impl World {
    /// Whether pressure acts on any piece.
    pub fn has_pressure(&self) -> bool {
        self.settings.pressure != 0.0 && self.scratch.pieces.outward.iter().any(|side| *side != 0.0)
    }
}

/// Sets the side on which the outside of each piece is; 0 for pieces that are not closed.
#[inline(never)]
fn find_closed_pieces(world: &mut World) {
    let (mesh, rest, pieces) = (&world.mesh, &world.rest, &mut world.scratch.pieces);
    pieces.outward.resize(world.pieces as usize, 1.0);
    for edge in 0..3 * mesh.triangles.len() as u32 {
        if !has_consistent_neighbor(mesh, edge) {
            pieces.outward[pieces.label[triangle_of(edge)] as usize] = 0.0;
        }
    }
    let mut first = 0;
    for piece in 0..world.pieces {
        while pieces.label[first] != piece {
            first += 1;
        }
        let outward = &mut pieces.outward[piece as usize];
        if *outward != 0.0 && has_negative_volume(mesh, rest, &pieces.label, first) {
            *outward = -1.0;
        }
    }
}

/// Whether the edge that starts at `edge` has a triangle on its other side with the same winding.
fn has_consistent_neighbor(mesh: &Mesh, edge: u32) -> bool {
    let (next, ends) = (mesh.across(edge), [mesh.vertex(edge), mesh.vertex(next_corner(edge))]);
    let is_opposite = |other: u32| [mesh.vertex(next_corner(other)), mesh.vertex(other)] == ends;
    next != NONE && (3 * next..3 * next + 3).any(is_opposite)
}

/// Whether the windings of the piece of triangle `first`, the first of its piece, enclose a
/// negative volume at rest.
fn has_negative_volume(mesh: &Mesh, rest: &[Vec3], label: &[u32], first: usize) -> bool {
    let corners =
        |at: usize| mesh.triangles[at].map(|v| rest[mesh.source[v as usize] as usize].as_dvec3());
    let [center, ..] = corners(first);
    let (mut volume, mut area) = (0.0, 0.0);
    for at in (first..label.len()).filter(|at| label[*at] == label[first]) {
        let [a, b, c] = corners(at).map(|x| x - center);
        let double_area: DVec3 = (b - a).cross(c - a);
        volume += a.dot(double_area) / 6.0;
        area += 0.5 * double_area.length();
    }
    volume < -MIN_VOLUME * area * area.sqrt()
}

/// Moves the particles of closed pieces by s² w f, with s the velocity step of the substep.
#[inline(never)]
fn push_particles(world: &mut World) {
    let step = world.scheme().velocity_step;
    let max_length = world.max_displacement();
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let (pieces, sums) = (&scratch.pieces, &mut scratch.relative_wind);
    sums.fill(Vec3::ZERO);
    for (triangle, label) in world.mesh.triangles.iter().zip(&pieces.label) {
        let side = pieces.outward[*label as usize];
        if side == 0.0 {
            continue;
        }
        let [a, b, c] = triangle.map(|v| v as usize);
        let (xa, xb, xc) = (p.x.get(a), p.x.get(b), p.x.get(c));
        let double_area = (xb - xa).cross(xc - xa) * side;
        [a, b, c].into_iter().for_each(|v| sums.add(v, double_area));
    }
    // Each corner gets a third of the triangle, and `double_area` is twice its area.
    let pressure_step = world.settings.pressure * (step * step / 6.0);
    for (piece, side) in pieces.members.iter().zip(&pieces.outward) {
        if *side == 0.0 {
            continue;
        }
        let all = || piece.iter().map(|i| *i as usize);
        let longest = all().fold(0.0, |longest, i| max(longest, (sums.get(i) * p.w[i]).length()));
        let bound = max_length / max(longest, f32::MIN_POSITIVE);
        let scale = pressure_step.clamp(-bound, bound);
        all().for_each(|i| p.x.add(i, sums.get(i) * (p.w[i] * scale)));
    }
}
