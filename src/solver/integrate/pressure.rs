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
//! A piece is closed if every edge of its triangles has two of them, wound consistently, or is a
//! border between two particles that are sewn to closed pieces. Its outside is where the volume of
//! its rest shape is positive, or where the windings say if that volume is zero. For a sewn piece
//! that is the volume between it and the middle of all pieces that are sewn together.
//!
//! Reads settings, mesh, rest positions, sewn pairs, piece labels and predicted positions; writes positions,
//! `scratch.pieces.outward`, `scratch.piece_groups`, and the scratch list `relative_wind`, which are
//! free at that time.
//! Invariant: the forces on a closed piece that nothing holds add up to zero but for rounding, also
//! where `max_displacement` limits them: the whole piece then gets a lower pressure.

use crate::math::max;
use crate::mesh::{Mesh, NONE, next_corner, triangle_of};
use crate::solver::tick_scratch::TickScratch;
use crate::solver::topology::piece_labels::PieceLabels;
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

/// Closed by its own triangles, or with the help of sewn borders; the sign comes later.
const WHOLE: f32 = 1.0;
const SEWN: f32 = 2.0;

/// Sets the side on which the outside of each piece is; 0 for pieces that are not closed.
#[inline(never)]
fn find_closed_pieces(world: &mut World) {
    let World { mesh, rest, sewing, .. } = world;
    let TickScratch { pieces: PieceLabels { label, outward, .. }, piece_groups, .. } =
        &mut world.scratch;
    outward.resize(world.pieces as usize, WHOLE);
    for edge in 0..3 * mesh.triangles.len() as u32 {
        if has_consistent_neighbor(mesh, edge) {
            continue;
        }
        let ends = [mesh.vertex(edge), mesh.vertex(next_corner(edge))];
        let is_sewn = mesh.across(edge) == NONE && ends.iter().all(|end| sewing.is_joined(*end));
        let state = &mut outward[label[triangle_of(edge)] as usize];
        *state = if is_sewn && *state != 0.0 { SEWN } else { 0.0 };
    }
    piece_groups.reset(world.pieces);
    let piece = |particle: u32| label[triangle_of(mesh.corner_of[particle as usize])];
    let mut has_opened = true;
    while core::mem::take(&mut has_opened) {
        for pair in sewing.pairs().iter().filter(|pair| pair.is_closed()) {
            let [a, b] = pair.particles.map(piece);
            for (own, other) in [(a as usize, b as usize), (b as usize, a as usize)] {
                if outward[own] == SEWN && outward[other] == 0.0 {
                    (outward[own], has_opened) = (0.0, true);
                }
            }
            if outward[a as usize] == SEWN && outward[b as usize] == SEWN {
                piece_groups.join(a, b);
            }
        }
    }
    for piece in 0..world.pieces {
        let state = &mut outward[piece as usize];
        if *state != 0.0 {
            let root = piece_groups.root(piece);
            let is_grouped = |at: usize| piece_groups.root(label[at]) == root;
            let is_own = |at: usize| label[at] == piece;
            let is_inwards = has_negative_volume(mesh, rest, &is_grouped, &is_own);
            *state = if is_inwards { -1.0 } else { 1.0 };
        }
    }
}

/// Whether the edge that starts at `edge` has a triangle on its other side with the same winding.
fn has_consistent_neighbor(mesh: &Mesh, edge: u32) -> bool {
    let (next, ends) = (mesh.across(edge), [mesh.vertex(edge), mesh.vertex(next_corner(edge))]);
    let is_opposite = |other: u32| [mesh.vertex(next_corner(other)), mesh.vertex(other)] == ends;
    next != NONE && (3 * next..3 * next + 3).any(is_opposite)
}

/// Whether the triangles that `is_own` selects face the middle of those that `is_grouped` selects, at
/// rest: whether they and the middle enclose a negative volume.
fn has_negative_volume(
    mesh: &Mesh,
    rest: &[Vec3],
    is_grouped: &dyn Fn(usize) -> bool,
    is_own: &dyn Fn(usize) -> bool,
) -> bool {
    let corners =
        |at: usize| mesh.triangles[at].map(|v| rest[mesh.source[v as usize] as usize].as_dvec3());
    let all = 0..mesh.triangles.len();
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    for [a, b, c] in all.clone().filter(|at| is_grouped(*at)).map(corners) {
        (sum, count) = (sum + a + b + c, count + 3.0);
    }
    let (mut volume, mut area) = (0.0, 0.0);
    for triangle in all.filter(|at| is_own(*at)).map(corners) {
        let [a, b, c] = triangle.map(|x| x - sum / count);
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
        // Not `clamp`: the text of its panic would add 18 kB to the WebAssembly module.
        let scale =
            if pressure_step.abs() > bound { bound.copysign(pressure_step) } else { pressure_step };
        all().for_each(|i| p.x.add(i, sums.get(i) * (p.w[i] * scale)));
    }
}
