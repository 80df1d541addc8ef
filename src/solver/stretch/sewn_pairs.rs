//! Sewn pairs: draws particles together, then holds them at one place.
//!
//! ```text
//! drawn    |x_b − x_a| ≤ length,  length ← length − speed · h       moves by inverse masses
//! closed   x ← Σ m x / Σ m  over the group        v, history alike: one inelastic impact
//! ```
//! Closed pairs act as one particle: after every stage that moves particles, all members of a group
//! return to their common centre of mass, or to a held one. What a stage pulls at one side so moves
//! both, and linear momentum stays. Groups, not pairs, since three panels may meet at a point. The
//! force on a stitch is what these corrections amount to over a tick:
//!
//! ```text
//! f_a = Σ m_a Δx_a / (substeps · s²)      s: velocity step of the integration scheme
//! force = |f_a − f_b| / 2                 of a pair alone, f_a = −f_b
//! ```
//! Blender calls drawn pairs sewing springs. Its springs have a force and never join; these have a
//! speed, so that the time until the garment is closed does not depend on its mass.
//!
//! Reads particles and settings; writes positions, velocities, history, `world.sewing` and events.
//! Invariant: while a pair is closed and at most one of its particles is held, both have the same
//! position and velocity bit for bit when a tick ends.

use crate::math::columns::Columns;
use crate::math::wide4::{Float4, xyz};
use crate::mesh::{NONE, triangle_of};
use crate::solver::particle_stage::access::ParticleAccess;
use crate::solver::world::World;
use crate::state::events::EventKind;
use crate::state::sewing::{SewKind, SewState, Sewing};
use glam::Vec3;

/// Torn sides collide by their surface again once they are this many gaps apart.
const PARTED_GAPS: f32 = 2.0;

/// Starts a tick: the pulls of the last one are forgotten.
pub(crate) fn begin_tick(world: &mut World) {
    if !world.sewing.is_empty() {
        world.sewing.pulls.fill(Vec3::ZERO);
    }
}

/// Shortens the pairs that are drawn together, and closes those of length 0.
pub(crate) fn begin_substep(world: &mut World) {
    if world.sewing.is_drawing() {
        shorten(world);
    }
}

#[inline(never)]
fn shorten(world: &mut World) {
    let h = world.regular_scheme().h;
    let mut has_closed = false;
    for pair in world.sewing.pairs.iter_mut().filter(|pair| pair.state == SewState::Drawn) {
        pair.length -= pair.speed * h;
        if pair.length <= 0.0 {
            (pair.length, pair.state, has_closed) = (0.0, SewState::Closing, true);
        }
    }
    if has_closed {
        world.sewing.refresh_groups();
    }
}

/// Draws pairs together and joins the closed ones, within a sweep.
pub(crate) fn project(world: &mut World) {
    if world.sewing.is_empty() {
        return;
    }
    let interleaved = &mut world.scratch.interleaved;
    if interleaved.is_current {
        project_particles(&mut world.sewing, interleaved);
    } else {
        project_particles(&mut world.sewing, &mut world.particles);
    }
}

/// Joins the closed pairs, after a stage that moved particles. Returns whether any particle moved.
pub(crate) fn join(world: &mut World) -> bool {
    !world.sewing.is_empty() && join_particles(&mut world.sewing, &mut world.particles)
}

/// Joins positions, velocities and histories of closed pairs.
pub(crate) fn join_motion(world: &mut World) {
    if !world.sewing.is_empty() {
        join_all_columns(world);
    }
}

#[inline(never)]
fn join_all_columns(world: &mut World) {
    join_particles(&mut world.sewing, &mut world.particles);
    let p = &mut world.particles;
    for columns in [&mut p.displacement, &mut p.v, &mut p.v_extrapolated] {
        join_columns(&mut world.sewing, columns, &p.w);
    }
}

#[inline(never)]
fn project_particles(sewing: &mut Sewing, p: &mut dyn ParticleAccess) {
    for pair in sewing.pairs.iter().filter(|pair| pair.state == SewState::Drawn) {
        let [a, b] = pair.particles.map(|particle| particle as usize);
        let ((xa, wa), (xb, wb)) = (p.particle(a), p.particle(b));
        let span = xb - xa;
        let length = span.length();
        if length > pair.length && wa + wb > 0.0 {
            let share = span * ((1.0 - pair.length / length) / (wa + wb));
            p.set_position(a, xa + share * wa);
            p.set_position(b, xb - share * wb);
        }
    }
    join_particles(sewing, p);
}

/// Moves the members of each closed group to its centre of mass, or to its first held member, and
/// counts how far.
#[inline(never)]
fn join_particles(sewing: &mut Sewing, p: &mut dyn ParticleAccess) -> bool {
    let mut has_moved = false;
    let Sewing { members, closed, sums, pulls, .. } = sewing;
    sum_groups(members, closed, sums, &|i| p.particle(i));
    for (at, member) in members.iter().enumerate() {
        let (x, w) = p.particle(*member as usize);
        let target = sums[closed[at] as usize].0;
        if w > 0.0 && target != x {
            pulls[at] += (target - x) * (1.0 / w);
            p.set_position(*member as usize, target);
            has_moved = true;
        }
    }
    has_moved
}

/// Gives the members of each closed group its mean by mass, or that of its first held member.
#[inline(never)]
fn join_columns(sewing: &mut Sewing, columns: &mut Columns, w: &[f32]) {
    let Sewing { members, closed, sums, .. } = sewing;
    sum_groups(members, closed, sums, &|i| (columns.get(i), w[i]));
    for (at, member) in members.iter().enumerate() {
        if w[*member as usize] > 0.0 {
            columns.set(*member as usize, sums[closed[at] as usize].0);
        }
    }
}

/// Fills `sums` at the root of each group with the mean of the members' vectors by mass, or with the
/// vector of the first held member. `of` gives the vector and the inverse mass of a particle.
fn sum_groups(
    members: &[u32],
    groups: &[u32],
    sums: &mut [(Vec3, f32)],
    of: &dyn Fn(usize) -> (Vec3, f32),
) {
    let root = |at: usize| of(members[groups[at] as usize] as usize).0;
    sums.fill((Vec3::ZERO, 0.0));
    // Sums of differences from the root, so that a group at one place keeps its bits. A held member
    // has infinite mass: its own difference ends the sum.
    for (at, member) in members.iter().enumerate() {
        let (x, w) = of(*member as usize);
        let (sum, mass) = &mut sums[groups[at] as usize];
        if *mass == f32::INFINITY {
            continue;
        }
        let difference = x - root(at);
        if w > 0.0 {
            *sum += difference * (1.0 / w);
            *mass += 1.0 / w;
        } else {
            (*sum, *mass) = (difference, f32::INFINITY);
        }
    }
    for at in (0..members.len()).filter(|at| groups[*at] as usize == *at) {
        let (sum, mass) = sums[at];
        let mean = if mass == f32::INFINITY { sum } else { sum * (1.0 / mass) };
        sums[at].0 = root(at) + mean;
    }
}

/// Ends the substeps of a tick: tears stitches, and lets torn sides collide once they are apart.
pub(crate) fn end_tick(world: &mut World) {
    if !world.sewing.is_empty() {
        tear_stitches(world);
    }
}

#[inline(never)]
fn tear_stitches(world: &mut World) {
    let mut sewing = core::mem::take(&mut world.sewing);
    let step = world.regular_scheme().velocity_step;
    let per_pull = 1.0 / (world.substeps as f32 * step * step);
    let apart = match (&world.scratch.particle_collision, &world.scratch.surface_collision) {
        (Some(collision), _) => collision.distance,
        (None, Some(collision)) => PARTED_GAPS * collision.gap(),
        (None, None) => 0.0,
    };
    let mut has_changed = false;
    for (pair, ends) in sewing.pairs.iter_mut().zip(&sewing.ends) {
        let [a, b] = pair.particles.map(|particle| particle as usize);
        let [pull_a, pull_b] = ends.map(|end| sewing.pulls[end as usize]);
        let p = &world.particles;
        match pair.state {
            SewState::Closing => {
                pair.state = SewState::Closed;
                // Now it may close a piece for `integrate::pressure`.
                world.scratch.pieces.outward.clear();
            }
            SewState::Closed if pair.kind == SewKind::Stitch && pair.tear_force > 0.0 => {
                let is_held = p.w[a] <= 0.0 || p.w[b] <= 0.0;
                let share = if is_held { 1.0 } else { 0.5 };
                let force = (pull_a - pull_b).length() * share * per_pull;
                if force > pair.tear_force {
                    (pair.state, has_changed) = (SewState::Torn, true);
                    let mut event = world.event_at(EventKind::StitchTorn, p.x.get(a));
                    (event.particle_a, event.particle_b) = (a as u32, b as u32);
                    world.events.push(event);
                }
            }
            SewState::Torn if (p.x.get(b) - p.x.get(a)).length() > apart => {
                (pair.state, has_changed) = (SewState::Parted, true);
            }
            _ => {}
        }
    }
    world.sewing = sewing;
    if has_changed {
        world.sewing.refresh_groups();
        world.scratch.pieces.outward.clear();
        world.forget_collision_pairs();
    }
}

/// Counts the closed pairs that two held particles keep apart, and reports them once.
#[inline(never)]
pub(crate) fn report(world: &mut World) {
    let x = &world.particles.x;
    let mut open = world.sewing.pairs().iter().filter(|pair| {
        let [a, b] = pair.particles.map(|particle| x.get(particle as usize));
        pair.is_closed() && a != b
    });
    let first = open.next().map(|pair| pair.particles);
    let count = open.count() as u32 + u32::from(first.is_some());
    if world.violations.open_pairs.update(count)
        && let Some([a, b]) = first
    {
        let mut event = world.event_at(EventKind::HeldApart, x.get(a as usize));
        (event.particle_a, event.particle_b, event.count) = (a, b, count);
        world.events.push(event);
    }
}

/// Rolls back the partners of closed pairs of which one particle rolled back, see `strain_limit`, and
/// returns whether any moved.
#[inline(never)]
pub(crate) fn roll_back_partners(world: &mut World) -> bool {
    let (x, targets) = (&mut world.particles.x, &world.scratch.rollback.positions);
    let mut has_moved = false;
    for pair in world.sewing.pairs().iter().filter(|pair| pair.is_closed()) {
        let [a, b] = pair.particles.map(|particle| particle as usize);
        if x.get(a) != x.get(b) {
            for end in [a, b].into_iter().filter(|end| world.particles.w[*end] > 0.0) {
                has_moved |= x.get(end) != targets.get(end);
                x.set(end, targets.get(end));
            }
        }
    }
    has_moved
}

/// Moves both particles of each closed pair that is apart to where the substep began, `start`. Returns
/// whether any moved.
pub(crate) fn roll_back_open(world: &mut World, start: &[Float4]) -> bool {
    let (x, w) = (&mut world.particles.x, &world.particles.w);
    let mut has_moved = false;
    for pair in world.sewing.pairs().iter().filter(|pair| pair.is_closed()) {
        let [a, b] = pair.particles.map(|particle| particle as usize);
        if x.get(a) != x.get(b) {
            for end in [a, b].into_iter().filter(|end| w[*end] > 0.0) {
                has_moved |= x.get(end) != xyz(&start[end]);
                x.set(end, xyz(&start[end]));
            }
        }
    }
    has_moved
}

/// Sorts the particles by groups of sewn pieces in `scratch.piece_groups`, and returns whether there
/// is a group of several pieces.
#[inline(never)]
pub(crate) fn group_sewn_pieces(world: &mut World) -> bool {
    if world.pieces < 2 || world.sewing.is_empty() {
        return false;
    }
    world.scratch.piece_groups.reset(world.pieces);
    join_sewn_pieces(world);
    let has_joined = world.scratch.piece_groups.has_joined;
    if has_joined {
        world.scratch.piece_groups.sort(&world.mesh, &world.scratch.pieces.label);
    }
    has_joined
}

/// Joins the pieces that active pairs connect, in `scratch.piece_groups`.
#[inline(never)]
pub(crate) fn join_sewn_pieces(world: &mut World) {
    let (labels, mesh) = (&world.scratch.pieces, &world.mesh);
    for pair in world.sewing.pairs().iter().filter(|pair| pair.is_active()) {
        let corners = pair.particles.map(|particle| mesh.corner_of[particle as usize]);
        if !corners.contains(&NONE) {
            let [a, b] = corners.map(|corner| labels.label[triangle_of(corner)]);
            world.scratch.piece_groups.join(a, b);
        }
    }
}

impl World {
    /// Makes both kinds of self-collision search all pairs again, after sewn pairs changed.
    pub fn forget_collision_pairs(&mut self) {
        if let Some(collision) = &mut self.scratch.particle_collision {
            collision.invalidate();
        }
        if let Some(collision) = &mut self.scratch.surface_collision {
            collision.invalidate();
        }
    }
}
