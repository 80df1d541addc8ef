//! Stage `Pairs`: the broad phase, which finds the blocks of particles and triangles near each
//! collider.
//!
//! Every tick computes the swept bounds of all colliders. Blocks and candidate pairs are rebuilt
//! only when they are stale: a particle has moved by almost `margin` since the last rebuild, a
//! collider has left the bounds that were searched, or the cloth or its colliders have changed.
//! Shapes with flat faces are searched again in every tick. Beside surfaces that deform, the velocity
//! of a particle predicts its motion in the tick; if few of them leave it, pairs are searched for
//! these alone.
//!
//! Reads colliders, positions, predicted positions and the mesh; writes `scratch.contacts.nearby`.
//! Invariant: results never depend on when a rebuild happens, because everything that can touch is
//! always listed.

use crate::geometry::aabb::Aabb;
use crate::math::{max, min};
use crate::model::maps::Map;
use crate::solver::collide::any_moved::any_moved;
use crate::solver::collide::contact_distance::{
    contact_gap, longest_free_edge, needs_triangle_tests, smoothing,
};
use crate::solver::collide::long_triangles::{MeasuredSurface, longest_edge_squared};
use crate::solver::collide::mid_phase::{CandidateRange, Earlier, PairSearch};
use crate::solver::collide::nearby_blocks::{BLOCK, ColliderEntry, SweptBounds, of_deforming};
use crate::solver::collide::particle_bounds;
use crate::solver::collide::particle_motions::{MotionBound, ParticleMotions, carry_along};
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;
use glam::Vec3;

/// How far particles may move before a rebuild, in mean edge lengths at rest.
const MARGIN: f32 = 0.5;

/// Edges are measured if a collider comes this near to the bounds of the cloth, in mean edge lengths
/// at rest.
const NEAR: f32 = 2.0;

/// The fraction of the margin at which a rebuild is due; the rest covers rounding.
const REBUILD_AT: f32 = 0.95;

/// A search is partial if at most one in this many particles left its predicted motion.
const FEW: usize = 4;

/// Triangles whose edges are longer than this share of the longest free edge are listed as long: links
/// may stretch them beyond it within a substep.
const LISTED_LENGTH: f32 = 0.95;

/// Updates the swept bounds of all colliders at the start of a tick.
pub(super) fn update_swept_bounds(world: &mut World) {
    let nearby = &mut world.scratch.contacts.nearby;
    let thickness = world.material.thickness;
    let [least, largest] = world.maps.range(Map::Thickness);
    let mut count = 0;
    let is_new = nearby.is_stale;
    if is_new {
        nearby.entries.clear();
    }
    for body in world.colliders.iter_mut() {
        if let Some(deformation) = body.deformation_mut() {
            deformation.prepare();
        }
        let Some(shape) = body.collision_shape() else { continue };
        if count == nearby.entries.len() {
            let (smooth, sagitta_margin) = smoothing(shape, world.mean_edge);
            nearby.entries.push(ColliderEntry {
                now: SweptBounds::EMPTY,
                searched: SweptBounds::EMPTY,
                smooth,
                sagitta_margin,
                longest_free_edge: 0.0,
                candidates: CandidateRange::default(),
                first_particles: 0,
                first_triangles: 0,
                end: 0,
            });
        }
        let entry = &mut nearby.entries[count];
        let gap = contact_gap(body, thickness);
        entry.longest_free_edge =
            longest_free_edge(shape, entry.smooth, gap * least, entry.sagitta_margin);
        let distance = gap * largest + entry.sagitta_margin;
        entry.now = SweptBounds::of_body(body, shape, distance);
        // For cloth that is deep between two edges of a shape, the candidates depend on when the
        // search ran. So the search runs at the start of every tick, and a restored cloth gives the
        // same result.
        nearby.is_stale |= shape.bends().is_some() || !entry.searched.contains(&entry.now);
        count += 1;
    }
}

/// Rebuilds blocks and candidate pairs if they are stale, for a part of the tick: its end and its
/// length, in ticks.
pub(crate) fn refresh(world: &mut World, part: [f32; 2]) {
    let nearby = &world.scratch.contacts.nearby;
    if nearby.entries.is_empty() {
        return;
    }
    let margin = MARGIN * world.mean_edge;
    let has_topology_changed = nearby.positions_at_rebuild.x.len() != world.particles.len()
        || nearby.triangles_at_rebuild != world.mesh.triangles.len();
    let is_stale = nearby.is_stale || has_topology_changed;
    if is_stale || has_particle_moved(world, margin * REBUILD_AT, part[0]) {
        let is_partial = !is_stale && predict_moved(world, margin, part);
        rebuild(world, margin, part, is_partial);
    }
    refresh_long_triangles(world);
}

/// Measures the edges of triangles if their list is not current. In fast motion, and once there are
/// long triangles, links stretch far within a tick, so it is current for one substep only.
fn refresh_long_triangles(world: &mut World) {
    let contacts = &mut world.scratch.contacts;
    let is_fast = world.substeps > world.settings.substeps;
    let room = contacts.room.shares();
    if contacts.long.is_current() && !is_fast && contacts.long.list().is_empty() && room.is_none() {
        return;
    }
    let x = &world.particles.x;
    let bounds = particle_bounds::of_columns(x);
    let entries = contacts.nearby.entries.iter();
    let near = entries.filter(|entry| entry.now.overlaps(&bounds, NEAR * world.mean_edge));
    let limit = near.fold(f32::INFINITY, |least, entry| min(entry.longest_free_edge, least));
    let triangles = &world.mesh.triangles;
    let predicted = [&world.scratch.predicted, &world.scratch.displacement];
    let surface = MeasuredSurface { x, predicted, triangles, room, level: world.level };
    contacts.long.refresh(limit * LISTED_LENGTH, surface);
}

/// Returns whether a particle is farther than `limit` [m] from where the last rebuild predicted it at
/// `moment`.
fn has_particle_moved(world: &mut World, limit: f32, moment: f32) -> bool {
    let mut has_moved = false;
    let nearby = &mut world.scratch.contacts.nearby;
    let mut predicted = &nearby.positions_at_rebuild;
    let displacements = of_deforming(&nearby.displacements);
    if !displacements.is_empty() {
        let since = moment - nearby.moment_of_rebuild;
        nearby.predicted.copy_from(&nearby.positions_at_rebuild);
        for (i, displacement) in displacements.iter().enumerate() {
            nearby.predicted.add(i, *displacement * since);
        }
        predicted = &nearby.predicted;
    }
    let (x, predicted) = (world.particles.x.slices(), predicted.slices());
    any_moved(world.level, x, predicted, limit * limit, &mut has_moved);
    has_moved
}

/// Returns how near features of a collider must be to be candidates [m].
fn search_distance(body: &ColliderBody, entry: &ColliderEntry, gap: f32, margin: f32) -> f32 {
    let arc = body.collision_shape().map_or(0.0, |shape| body.max_arc_deviation(shape));
    margin + gap + entry.sagitta_margin + arc
}

/// Lists the particles that left their predicted motion, and predicts their motion again, from the
/// end of a part of the tick on. Returns whether a search for these particles alone is enough: they
/// are few, every collider with flat faces near the cloth deforms, and the first search of the tick
/// has measured its edges near these particles.
fn predict_moved(world: &mut World, margin: f32, [moment, length]: [f32; 2]) -> bool {
    let tick = world.settings.tick;
    let limit = margin * REBUILD_AT;
    let [_, largest] = world.maps.range(Map::Thickness);
    let shares = [max(1.0 - moment, 0.0), length];
    let (scratch, x) = (&mut world.scratch, &world.particles.x);
    let nearby = &mut scratch.contacts.nearby;
    if of_deforming(&nearby.displacements).is_empty() {
        return false;
    }
    let since = moment - nearby.moment_of_rebuild;
    let mut count = 0;
    nearby.moved.clear();
    for i in 0..x.x.len() {
        let now = x.get(i);
        let moved2 = (now - nearby.predicted.get(i)).length_squared();
        // NaN counts as moved.
        let has_moved = moved2.is_nan() || moved2 > limit * limit;
        nearby.moved.push(has_moved);
        if has_moved {
            count += 1;
            let displacement = world.particles.v.get(i) * tick;
            nearby.displacements[i] = displacement;
            nearby.positions_at_rebuild.set(i, now - displacement * since);
        }
    }
    if count * FEW > x.x.len() {
        return false;
    }
    nearby.searched.clone_from(&nearby.moved);
    for corners in &world.mesh.triangles {
        if corners.iter().any(|i| nearby.moved[*i as usize]) {
            corners.iter().for_each(|i| nearby.searched[*i as usize] = true);
        }
    }
    let motions = ParticleMotions {
        x,
        predicted: &scratch.predicted,
        displacement: &scratch.displacement,
        displacements: of_deforming(&nearby.displacements),
        shares,
    };
    for (entry, body) in nearby.entries.iter().zip(world.colliders.iter()) {
        let has_flat_faces = body.collision_shape().is_some_and(|shape| shape.bends().is_some());
        if !has_flat_faces || entry.first_triangles == entry.first_particles {
            continue;
        }
        let Some(deformation) = body.deformation().filter(|one| one.is_moving()) else {
            return false;
        };
        let gap = contact_gap(body, world.material.thickness) * largest;
        let distance = search_distance(body, entry, gap, margin);
        let mut bounds = Aabb::EMPTY;
        let searched = (0..).zip(&nearby.searched).filter(|(_, is_searched)| **is_searched);
        searched.for_each(|(i, _)| bounds.merge(&motions.bound(i, body, distance).bounds));
        if !deformation.is_measured(&bounds) {
            return false;
        }
    }
    true
}

/// Rebuilds the blocks and candidate pairs of all colliders, to hold until a particle is `margin` [m]
/// from where it is predicted: where it is now, or beside surfaces that deform where its velocity
/// takes it. A partial rebuild searches for pairs of the particles that [`predict_moved`] listed.
fn rebuild(world: &mut World, margin: f32, [moment, length]: [f32; 2], is_partial: bool) {
    let is_any_deforming = world.colliders.iter().any(|body| body.is_deforming());
    let tick = world.settings.tick;
    let shares = [max(1.0 - moment, 0.0), length];
    let (scratch, x) = (&mut world.scratch, &world.particles.x);
    let nearby = &mut scratch.contacts.nearby;
    let count = world.particles.len();
    if !is_partial {
        nearby.moment_of_rebuild = moment;
        nearby.displacements.clear();
        if is_any_deforming {
            nearby.displacements.extend((0..count).map(|i| world.particles.v.get(i) * tick));
            for body in world.colliders.iter().filter(|body| body.is_deforming()) {
                carry_along(body, x, margin, &mut nearby.displacements);
            }
        }
        nearby.positions_at_rebuild.copy_from(x);
    }
    nearby.triangles_at_rebuild = world.mesh.triangles.len();
    nearby.is_stale = false;
    let [_, largest] = world.maps.range(Map::Thickness);
    let motions = ParticleMotions {
        x,
        predicted: &scratch.predicted,
        displacement: &scratch.displacement,
        displacements: of_deforming(&nearby.displacements),
        shares,
    };
    let since = moment - nearby.moment_of_rebuild;
    let positions = &nearby.positions_at_rebuild;
    let bounds_of = |particles: &mut dyn Iterator<Item = usize>| {
        let mut bounds = Aabb::EMPTY;
        for i in particles {
            motions.path(i).iter().for_each(|x| bounds.include(*x));
            if is_partial {
                // Particles that are not searched for stay near their earlier prediction.
                let predicted = positions.get(i) + motions.displacements[i] * since;
                bounds.include(predicted);
                bounds.include(predicted + motions.forward(i));
            }
        }
        bounds
    };
    nearby.particle_bounds.clear();
    nearby.particle_bounds.extend(
        (0..count).step_by(BLOCK).map(|first| bounds_of(&mut (first..(first + BLOCK).min(count)))),
    );
    nearby.triangle_bounds.clear();
    nearby.blocks.clear();
    if is_partial {
        core::mem::swap(&mut nearby.candidates, &mut nearby.earlier);
    }
    nearby.candidates.clear();
    nearby.longest_edge = 0.0;
    for (entry, body) in nearby.entries.iter_mut().zip(world.colliders.iter_mut()) {
        let Some(shape) = body.collision_shape() else { continue };
        // The bounds of moving colliders get a margin of their own.
        let slack = if body.is_moving() { margin } else { 0.0 };
        entry.searched = entry.now.expanded(slack);
        let range = core::mem::take(&mut entry.candidates);
        let had_pairs = entry.first_triangles > entry.first_particles;
        entry.first_particles = nearby.blocks.len() as u32;
        for (block, bounds) in nearby.particle_bounds.iter().enumerate() {
            if entry.searched.overlaps(bounds, margin) {
                nearby.blocks.push(block as u32);
            }
        }
        entry.first_triangles = nearby.blocks.len() as u32;
        let gap = contact_gap(body, world.material.thickness) * largest;
        let has_features = shape.bends().is_some() && entry.first_triangles > entry.first_particles;
        let needs_triangles = needs_triangle_tests(shape, entry.longest_free_edge, world.mean_edge);
        if (has_features || needs_triangles) && nearby.longest_edge == 0.0 {
            let triangles = world.mesh.triangles.iter();
            nearby.longest_edge = longest_edge(triangles, |i| x.get(i)) + 2.0 * margin;
        }
        if has_features {
            // Particles that a partial search leaves out may be a margin from their prediction.
            let more = if is_partial && !had_pairs { margin } else { 0.0 };
            let distance = search_distance(body, entry, gap, margin + more);
            let search = PairSearch { distance, smooth: entry.smooth };
            let candidates = &mut nearby.candidates;
            let bounds = &mut nearby.motion_bounds;
            let is_partial = is_partial && had_pairs;
            let is_deforming = body.is_deforming();
            if is_deforming {
                bounds.clear();
                bounds.extend((0..count).map(|i| {
                    let is_searched = !is_partial || nearby.searched[i];
                    if is_searched { motions.bound(i, body, distance) } else { MotionBound::NONE }
                }));
            }
            if let Some(deformation) = body.deformation_mut().filter(|_| is_deforming) {
                if is_partial {
                    let moved = bounds.iter().zip(&nearby.searched);
                    let boxes = moved.filter(|(_, is_searched)| **is_searched);
                    deformation.pose_some_for_search(boxes.map(|(one, _)| one.bounds), moment);
                } else {
                    let mut all = Aabb::EMPTY;
                    bounds.iter().for_each(|one| all.merge(&one.bounds));
                    deformation.pose_for_search(all, moment, &|bend| !search.is_smooth(bend));
                }
            }
            let Some(shape) = body.collision_shape() else { continue };
            let deformation = body.deformation().filter(|_| is_deforming);
            entry.candidates = match deformation.and_then(|one| one.sharp_features()) {
                Some(mut sharp) => {
                    let (pairs, moved) = (&nearby.earlier, &nearby.moved[..]);
                    let earlier = is_partial.then_some(Earlier { pairs, range, moved });
                    let shape: (_, &mut dyn Iterator<Item = u32>) = (shape, &mut sharp);
                    let search = (search, shares, moment);
                    candidates.push_pairs_of_deforming(shape, &world.mesh, bounds, search, earlier)
                }
                None => {
                    let motion_bound = |i: usize| motions.bound(i, body, distance);
                    candidates.push_pairs(shape, &world.mesh, count, motion_bound, search)
                }
            };
            if let Some(deformation) = body.deformation_mut() {
                let found = candidates.of_range(&entry.candidates);
                deformation.activate(
                    found.all_faces(count).iter().copied(),
                    found.edges.iter().map(|pair| pair.edge),
                    found.vertices.iter().map(|pair| pair.vertex),
                );
            }
        }
        if needs_triangles {
            if nearby.triangle_bounds.is_empty() {
                let blocks = world.mesh.triangles.chunks(BLOCK);
                nearby.triangle_bounds.extend(blocks.map(|block| {
                    let corners = block.as_flattened().iter();
                    bounds_of(&mut corners.map(|i| *i as usize))
                }));
            }
            for (block, bounds) in nearby.triangle_bounds.iter().enumerate() {
                if entry.searched.overlaps(bounds, margin) {
                    nearby.blocks.push(block as u32);
                }
            }
        }
        entry.end = nearby.blocks.len() as u32;
    }
}

/// Returns the length of the longest edge of some triangles [m].
fn longest_edge<'a>(
    triangles: impl Iterator<Item = &'a [u32; 3]>,
    at: impl Fn(usize) -> Vec3,
) -> f32 {
    let mut longest2 = 0.0;
    for triangle in triangles {
        longest2 = max(longest_edge_squared(triangle.map(|i| at(i as usize))), longest2);
    }
    longest2.sqrt()
}
