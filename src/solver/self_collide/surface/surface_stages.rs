//! Stages `Pairs` and `SelfContacts` with surface collision: the entry points for the tick
//! pipeline.
//!
//! ```text
//! tick       begin_tick
//! substep    detect_contacts ─▶ solve_contacts ─▶ enforce_non_crossing
//!            ─▶ (stage `Velocities`) ─▶ `contact_damping`
//! tick end   begin_tick ─▶ (strain limit, anchors) ─▶ enforce_non_crossing_at_tick_end
//! ```
//! See the module `surface` for the methods.
//!
//! Reads and writes `World`: particles, predicted positions, contact forces, and
//! `surface_collision`. Each stage takes the box out of `World` while it runs.
//!
//! Invariant: after [`enforce_non_crossing`] no surface has passed through another in the substep,
//! and `motion.start` holds the positions that the next substep starts from.

use crate::math::wide4::xyz;
use crate::math::{max, min};
use crate::model::maps::Map;
use crate::solver::collide;
use crate::solver::integrate::{momentum, recover};
use crate::solver::particle_stage::interleaved;
use crate::solver::self_collide::MAX_GAP;
use crate::solver::self_collide::surface::contact_solver::{self, LayerFriction};
use crate::solver::self_collide::surface::detection::{DetectedContacts, Detector};
use crate::solver::self_collide::surface::rest_gap::{PaintedGap, RestGap};
use crate::solver::self_collide::surface::surface_collision::SurfaceCollision;
use crate::solver::self_collide::surface::swept_particles::{SweptParticles, Widened};
use crate::solver::self_collide::surface::{non_crossing, sewn_sides, speculative};
use crate::solver::world::World;
use crate::state::settings::SelfCollision;
use glam::Vec3;

/// Least gap between layers [mean rest lengths].
const MIN_GAP: f32 = 0.005;

/// Slack of the tick bounds [mean rest lengths].
const TICK_SLACK: f32 = 0.2;

/// Largest number of repeats of the non-crossing pass, each with the pairs of escaped particles.
const MAX_REPEATS: u32 = 12;

/// Rounds in which colliders and the non-crossing pass alternate, and rounds in which they roll
/// back.
const COLLIDER_ROUNDS: u32 = 6;
const ROLLBACK_ROUNDS: u32 = 8;

impl World {
    /// Rebuilds the data of surface collision, or drops it, by `settings.self_collision`.
    pub fn rebuild_surface_collision(&mut self) {
        let is_wanted = self.settings.self_collision == SelfCollision::Surface;
        self.scratch.surface_collision = is_wanted.then(|| {
            let (count, capacity) = (self.particles.len(), self.capacity());
            Box::new(SurfaceCollision::new(&self.mesh, &self.rest, count, capacity))
        });
        if is_wanted {
            self.warm_start.reserve(self.particles.len());
        } else {
            self.warm_start.clear();
        }
    }

    /// Gap between layers at scale 1 [m]: `self_distance`, or the thickness of the material if that
    /// is 0.
    fn unscaled_layer_gap(&self) -> f32 {
        let own = self.settings.self_distance;
        if own > 0.0 { own } else { self.material.thickness }
    }

    /// Largest gap between layers [m].
    fn layer_gap(&self) -> f32 {
        let [_, largest] = self.maps.range(Map::Thickness);
        let gap = self.unscaled_layer_gap() * largest;
        // Not `clamp`: the text of its panic message would add 18 kB to the WebAssembly module.
        min(max(gap, MIN_GAP * self.mean_edge), MAX_GAP * self.mean_edge)
    }
}

/// The rest shape of the cloth, for gaps of pairs.
fn rest_gap<'a>(world: &'a World, pieces: &'a [u32], gap: f32) -> RestGap<'a> {
    let painted = world.maps.get(Map::Thickness).map(|scales| PaintedGap {
        scales,
        gap: world.unscaled_layer_gap(),
        least: MIN_GAP * world.mean_edge,
    });
    RestGap {
        mesh: &world.mesh,
        rest: &world.rest,
        pieces,
        mean_edge: world.mean_edge,
        gap,
        painted,
        sewing: &world.sewing,
    }
}

impl SurfaceCollision {
    /// Whether layers touch in this substep.
    pub(crate) fn has_contacts(&self) -> bool {
        !self.active.is_empty()
    }

    /// Detects contacts and intersections from the current positions, with `substeps` left in the
    /// tick.
    fn detect(&mut self, world: &World, substeps: u32) {
        let Self {
            motion,
            tick_bounds,
            bvh,
            pieces,
            pairs,
            candidates,
            narrow_phase,
            contacts,
            speculative,
            gap,
            ..
        } = self;
        let touches_collider = !world.scratch.contacts.collider_contacts.is_empty();
        motion.reset_bounds(world.mean_edge, *gap, touches_collider);
        let is_valid = tick_bounds.is_valid;
        if is_valid {
            tick_bounds.update_mean_displacements(motion);
        }
        if !is_valid || !tick_bounds.contain(motion) {
            tick_bounds.rebuild(motion, substeps, world.mean_edge * TICK_SLACK);
            bvh.rebuild_tick_pairs(tick_bounds, *gap);
        }
        if !is_valid {
            bvh.clear_pair_cache();
        }
        let rest_gap = rest_gap(world, pieces, *gap);
        let mut detected = DetectedContacts { contacts, speculative };
        Detector { level: world.level, rest_gap, bvh, motion }.detect(
            pairs,
            candidates,
            narrow_phase,
            &mut detected,
        );
        self.has_detected = true;
        self.detect_intersections(world);
    }

    /// Detects intersections of the surface with itself, and disables the contacts that would
    /// block untangling.
    ///
    /// A cloth that is known to intersect itself is tested whole in each substep, others in parts,
    /// in the first substep of each tick.
    fn detect_intersections(&mut self, world: &World) {
        let Self { motion, bvh, pairs, contacts, speculative, intersections, gap, .. } = self;
        let (mesh, start, tick) = (&world.mesh, &motion.start, world.clock.tick);
        intersections.clear();
        let scans = core::mem::take(&mut self.is_new_tick);
        if world.is_tangled || scans && intersections.scan(mesh, bvh, pairs, start, tick) {
            let sizes = [*gap, world.mean_edge, world.regular_scheme().h];
            intersections.detect(mesh, (bvh, pairs), start, sizes);
            intersections.disable_contacts(contacts, speculative);
        }
    }

    /// Widens the bounds of escaped particles, and adds to the speculative contacts their pairs and
    /// those where the cloth folded since the last detection, when all particles moved or those of
    /// the last repeat. Returns whether all particles are within their bounds now.
    fn detect_escaped(&mut self, world: &World, may_roll_back: bool, is_first: bool) -> bool {
        let Self {
            graph,
            motion,
            tick_bounds,
            bvh,
            pieces,
            pairs,
            escaped_candidates,
            speculative,
            gap,
            ..
        } = self;
        let Widened { any, are_all_within } =
            motion.widen_bounds(world.mean_edge, *gap, may_roll_back);
        let moved = (!is_first).then(|| graph.moved());
        if !any && moved.is_some_and(<[u32]>::is_empty) {
            return are_all_within;
        }
        motion.set_moved(moved);
        let all = 0..motion.now.len() as u32;
        let escaped = all.filter(|i| motion.has_escaped(*i));
        if !tick_bounds.contain(motion) {
            escaped.for_each(|i| tick_bounds.widen(motion, i));
            bvh.rebuild_tick_pairs(tick_bounds, *gap);
        }
        let rest_gap = rest_gap(world, pieces, *gap);
        let mut detector = Detector { level: world.level, rest_gap, bvh, motion };
        detector.detect_escaped(pairs, escaped_candidates, speculative);
        are_all_within
    }

    /// Runs the non-crossing pass, and returns whether any particle moved. The centre of mass of a
    /// free cloth (no fixed particles, no collider contacts) does not move.
    pub(super) fn enforce_non_crossing(&mut self, world: &World) -> bool {
        let has_rolled_back = self.run_non_crossing(world);
        let now = &mut self.motion.now;
        if has_rolled_back
            && world.scratch.contacts.collider_contacts.is_empty()
            && !interleaved::has_fixed_particle(now)
        {
            let w = now.iter().map(|particle| particle[3]);
            let before = interleaved::center_of_mass(world.particles.x.iter().zip(w));
            let after = interleaved::center_of_mass(
                now.iter().map(|particle| (xyz(particle), particle[3])),
            );
            now.iter_mut().for_each(|particle| interleaved::translate(particle, before - after));
        }
        self.graph.any_moved
    }

    /// Pushes crossing sides apart, or rolls them back, until no pair crosses and no particle is
    /// out of its bounds. Returns whether any particle rolled back.
    fn run_non_crossing(&mut self, world: &World) -> bool {
        if !self.has_detected {
            self.detect(world, 1);
        }
        let (mut may_roll_back, mut has_rolled_back) = (false, false);
        self.graph.reset(self.motion.now.len());
        let mut known = 0;
        for repeat in 0..=MAX_REPEATS {
            let is_last = repeat == MAX_REPEATS;
            let were_within = self.detect_escaped(world, may_roll_back || is_last, repeat == 0);
            let Self {
                contacts,
                speculative,
                separated,
                motion,
                leaders,
                open,
                graph,
                planes,
                vectors,
                intersections,
                gap,
                ..
            } = self;
            intersections.disable_contacts(&mut [], speculative);
            let all = may_roll_back || is_last;
            speculative::promote(world.level, speculative, separated, all, motion, *gap, contacts);
            graph.schedule_from(known, contacts);
            graph.clear_moved();
            if !is_last {
                let now = &motion.now;
                non_crossing::unschedule_separated(world.level, contacts, known, now, graph);
            }
            known = contacts.len();
            let is_done = !is_last && non_crossing::separate(contacts, motion, graph, planes, open);
            if !is_done && (may_roll_back || is_last) {
                non_crossing::roll_back(contacts, motion, graph, leaders, vectors);
                has_rolled_back = true;
            }
            let are_within = || were_within || motion.are_within_bounds(0..motion.now.len() as u32);
            let are_separated =
                || speculative::are_separated(world.level, speculative, &motion.now, graph);
            // What moved may have left its bounds, or folded the cloth.
            if is_done && graph.moved().is_empty() && are_within() && are_separated() {
                break;
            }
            // Roll-back needs wider bounds and all pairs as contacts, so it waits for the next
            // repeat.
            may_roll_back |= !is_done;
        }
        has_rolled_back
    }
}

/// A particle that a collider supports counts with this share of its inverse mass in the damping of
/// contacts, and in the non-crossing pass if the collider projected it out.
const SUPPORTED_SHARE: f32 = 0.02;

/// Starts a tick, or the part of it after tears, at the current positions.
pub(crate) fn begin_tick(world: &mut World) {
    let Some(mut surface) = world.scratch.surface_collision.take() else { return };
    let gap = world.layer_gap();
    surface.tick_bounds.is_valid &= gap == surface.gap;
    surface.gap = gap;
    let p = &world.particles;
    let motion = &mut surface.motion;
    let is_same_count = motion.start.len() == p.len();
    if !is_same_count {
        surface.bvh.update_topology(&world.mesh);
    }
    interleaved::gather(&mut motion.start, &p.x, &p.w);
    surface.planes.reset(p.len());
    surface.has_detected = false;
    surface.is_new_tick = true;
    surface.tick_bounds.is_valid &= is_same_count;
    world.scratch.surface_collision = Some(surface);
}

/// Detects the contacts of a substep, and whether the surface intersects itself.
pub(crate) fn detect_contacts(world: &mut World) {
    let Some(mut surface) = world.scratch.surface_collision.take() else { return };
    collide::second_response::store_heights(world);
    interleaved::gather(&mut surface.motion.now, &world.particles.x, &world.particles.w);
    surface.planes.reset(world.particles.len());
    surface.mobility.clear();
    surface.mobility.resize(world.particles.len(), 1.0);
    for contact in &world.scratch.contacts.collider_contacts {
        let i = contact.particle as usize;
        surface.mobility[i] = SUPPORTED_SHARE;
        if contact.weight == 1.0 {
            let slack = contact.gap * (1.0 - collide::PROJECTION_GAP);
            let at = world.particles.x.get(i) - contact.normal * slack;
            surface.planes.insert(contact.particle, contact.body, contact.normal, at);
        }
    }
    surface.detect(world, world.substeps);
    world.is_tangled = !surface.intersections.is_empty();
    world.scratch.surface_collision = Some(surface);
}

/// Solves the contacts of a substep: impulses, friction, penetration, untangling.
pub(crate) fn solve_contacts(world: &mut World) {
    let scheme = world.scheme();
    let friction = LayerFriction {
        coefficient: world.material.friction,
        scales: world.maps.get(Map::Friction),
    };
    let Some(mut surface) = world.scratch.surface_collision.take() else { return };
    let SurfaceCollision {
        contacts, active, warm_start_index, motion, vectors, intersections, ..
    } = &mut *surface;
    let SweptParticles { start, now, .. } = &mut *motion;
    contact_solver::collect_active(contacts, active, &world.particles.w, start, now);
    let is_free = !active.is_empty() && momentum::is_one_free_piece(world);
    if is_free {
        vectors.clone_from(now);
    }
    let force_scale = 1.0 / (scheme.velocity_step * scheme.velocity_step);
    contact_solver::solve(
        contacts,
        active,
        (&mut world.warm_start, warm_start_index),
        &mut world.scratch.contacts.collider_contacts,
        start,
        now,
        friction,
        force_scale,
    );
    if is_free {
        // What colliders pushed meanwhile stays.
        for contact in &world.scratch.contacts.collider_contacts {
            let pushed = &mut vectors[contact.particle as usize];
            interleaved::translate(pushed, contact.normal * contact.pushed);
        }
        momentum::remove_rigid_motion_since(world, vectors, now);
    }
    let predicted = &mut world.scratch.predicted;
    contact_solver::correct_penetration(contacts, active, now, predicted, scheme.h);
    intersections.resolve(motion, predicted);
    interleaved::scatter(&motion.now, &mut world.particles.x);
    let has_contacts = !active.is_empty();
    world.scratch.surface_collision = Some(surface);
    if has_contacts {
        collide::second_response::apply(world);
        gather_positions(world);
    }
}

/// Gathers the current positions, which other stages changed.
fn gather_positions(world: &mut World) {
    if let Some(surface) = &mut world.scratch.surface_collision {
        let p = &world.particles;
        interleaved::gather(&mut surface.motion.now, &p.x, &p.w);
    }
}

/// Runs the non-crossing pass of substep `substep`, after all other stages moved particles; `None`
/// after the last substep, when colliders rest. What it moves ends outside all colliders. Does nothing if a position is invalid: nothing can separate such
/// positions, and the end of the tick restores them.
pub(crate) fn enforce_non_crossing(world: &mut World, substep: Option<u32>) {
    if world.scratch.surface_collision.is_none() || !recover::are_positions_valid(world) {
        return;
    }
    let Some(mut surface) = world.scratch.surface_collision.take() else { return };
    let mut pushed = core::mem::take(&mut world.scratch.contacts.projected);
    pushed.clear();
    if !surface.active.is_empty() {
        // Contacts moved particles; those that are in a collider now get planes.
        collide::project_out_in_substep(world, substep, None, &mut pushed);
        support_projected(&mut surface, world, &pushed, SUPPORTED_SHARE);
        if world.is_tangled {
            // Untangling gives no velocity, so the way back out of a collider must not either.
            let scratch = &mut world.scratch;
            for projection in scratch.contacts.projections() {
                scratch.predicted.add(projection.particle as usize, projection.correction);
            }
            scratch.contacts.forget_late_pushes();
        }
    }
    let was_behind = surface.planes.project_all(&mut surface.motion.now) || !pushed.is_empty();
    if surface.enforce_non_crossing(world) || was_behind {
        interleaved::scatter(&surface.motion.now, &mut world.particles.x);
        project_out_of_colliders(&mut surface, world, substep, &mut pushed);
    }
    if !world.sewing.is_empty() {
        sewn_sides::enforce_joined(&mut surface, world);
    }
    world.scratch.contacts.projected = pushed;
    // The next substep starts here; it gathers `now` anew.
    let SweptParticles { start, now, .. } = &mut surface.motion;
    core::mem::swap(start, now);
    world.scratch.surface_collision = Some(surface);
}

/// Alternates between colliders and the non-crossing pass until both hold.
///
/// Particles that the non-crossing pass moved into a collider are projected out of it and get a
/// plane there, which the next pass respects. If that does not end, they go back to where the
/// substep began, as the collider carries that along, and so does what they cross there: at the start
/// nothing was inside and nothing crossed. What a collider still penetrates after that is projected
/// out: colliders take precedence over non-crossing.
fn project_out_of_colliders(
    surface: &mut SurfaceCollision,
    world: &mut World,
    substep: Option<u32>,
    pushed: &mut Vec<u32>,
) {
    for round in 0..COLLIDER_ROUNDS + ROLLBACK_ROUNDS {
        let rolls_back = round >= COLLIDER_ROUNDS;
        let starts = rolls_back.then_some(&surface.motion.start[..]);
        collide::project_out_in_substep(world, substep, starts, pushed);
        let Some(first) = pushed.first() else { return };
        let first = *first as usize;
        let share = if rolls_back { 0.0 } else { SUPPORTED_SHARE };
        support_projected(surface, world, pushed, share);
        if rolls_back {
            let SweptParticles { start, now, rollback_displacement, .. } = &mut surface.motion;
            *rollback_displacement = xyz(&now[first]) - xyz(&start[first]);
        }
        surface.enforce_non_crossing(world);
        interleaved::scatter(&surface.motion.now, &mut world.particles.x);
    }
    collide::project_out_in_substep(world, substep, None, pushed);
    support_projected(surface, world, pushed, 0.0);
}

/// Copies the positions of particles that colliders have just projected out to `motion.now`, with a
/// share of their inverse masses, and gives each the plane that it was projected onto.
fn support_projected(surface: &mut SurfaceCollision, world: &World, pushed: &[u32], share: f32) {
    for i in pushed.iter().map(|i| *i as usize) {
        let x = world.particles.x.get(i);
        surface.motion.now[i] = [x.x, x.y, x.z, world.particles.w[i] * share];
    }
    for projection in world.scratch.contacts.projections() {
        let at = world.particles.x.get(projection.particle as usize);
        surface.planes.insert(projection.particle, projection.body, projection.normal, at);
    }
}

/// Runs the non-crossing pass after the strain limit and anchors moved particles at the end of a
/// tick. Particles that anchors moved count as fixed.
pub(crate) fn enforce_non_crossing_at_tick_end(world: &mut World) {
    gather_positions(world);
    let anchor_moved = &world.scratch.anchor_moved;
    if let Some(surface) = &mut world.scratch.surface_collision {
        anchor_moved.iter().for_each(|i| surface.motion.now[*i as usize][3] = 0.0);
    }
    enforce_non_crossing(world, None);
}

/// Separates those of `vertices` that have the same position as another copy after a split.
/// Momentum is conserved; nearby surfaces are pushed aside.
pub(crate) fn separate_splits(world: &mut World, vertices: impl Iterator<Item = u32>) {
    let Some(mut surface) = world.scratch.surface_collision.take() else { return };
    let split = &mut surface.split_separation;
    split.compute(&world.mesh, &world.particles, world.mean_edge, vertices);
    let copies = core::mem::take(&mut split.copies);
    let displacements = core::mem::take(&mut split.displacements);
    world.scratch.surface_collision = Some(surface);
    if displacements.iter().any(|displacement| *displacement != Vec3::ZERO) {
        begin_tick(world);
        collide::begin_last_phase(world);
        for (vertex, displacement) in copies.iter().zip(&displacements) {
            world.particles.x.add(*vertex as usize, *displacement);
            world.particles.x_prev_tick.add(*vertex as usize, *displacement);
        }
        gather_positions(world);
        enforce_non_crossing(world, None);
    }
    if let Some(surface) = &mut world.scratch.surface_collision {
        let split = &mut surface.split_separation;
        (split.copies, split.displacements) = (copies, displacements);
    }
}
