//! The motion of the cloth relative to the colliders near it, which decides how many substeps a
//! tick needs.
//!
//! ```text
//! substeps needed = max over colliders and particles near them of |v T − d(x)| / step
//! ```
//! d(x): displacement that the collider gives a point at x in the tick, see [`BodyMotion`]; T:
//! length of the tick. So a cloth that flies along with a body needs no more than one at rest
//! beside it. Three tests cull: by the fastest particle, by blocks of particles, by the path of each
//! particle.
//!
//! Reads colliders, positions and velocities at the start of the tick; writes
//! `scratch.contacts.body_motions`.
//! Invariant: the result depends on the saved state only, not on the broad phase or on what an
//! earlier tick found.

use crate::geometry::aabb::Aabb;
use crate::math::{max, min};
use crate::model::maps::Map;
use crate::solver::collide::body_motion::BodyMotion;
use crate::solver::collide::contact_distance::{contact_gap, smoothing};
use crate::solver::collide::nearby_blocks::BLOCK;
use crate::solver::world::World;
use core::ops::Range;
use glam::Vec3;

/// Motion relative to a collider that one substep resolves, in mean edge lengths at rest.
const STEP: f32 = 1.0;

/// The same for cloth with a bound of stretch: the links carry an impact to the rest of the cloth in
/// steps that the bound can still take back.
const BOUNDED_STEP: f32 = 0.2;

/// Distance from a collider that counts as near, in mean edge lengths at rest.
const MARGIN: f32 = 1.0;

/// Returns how many substeps the motion of the cloth relative to colliders needs in the next tick.
/// Anything up to `available` means that these are enough.
pub(crate) fn needed_substeps(world: &mut World, available: f32) -> f32 {
    let mut bodies = core::mem::take(&mut world.scratch.contacts.body_motions);
    bodies.clear();
    let (step, margin) = (step(world), MARGIN * world.mean_edge);
    let [_, largest] = world.maps.range(Map::Thickness);
    // Displacement of a particle in the tick up to which no body needs more substeps [m].
    let mut harmless = f32::INFINITY;
    for body in world.colliders.iter_mut() {
        if let Some(deformation) = body.deformation_mut() {
            deformation.prepare();
        }
        let Some(shape) = body.collision_shape() else { continue };
        let (_, sagitta_margin) = smoothing(shape, world.mean_edge);
        let gap = contact_gap(body, world.material.thickness) * largest + sagitta_margin;
        let motion = BodyMotion::new(body, shape, gap + margin, step);
        harmless = min(available * motion.step - motion.longest, harmless);
        bodies.push(motion);
    }
    let needed = if !bodies.is_empty() && has_longer_displacement(world, harmless) {
        largest_ratio(world, &bodies, available)
    } else {
        0.0
    };
    world.scratch.contacts.body_motions = bodies;
    needed
}

/// Returns the motion relative to a collider that one substep resolves [m].
fn step(world: &World) -> f32 {
    let is_bounded = world.settings.max_stretch > 0.0;
    world.mean_edge * if is_bounded { BOUNDED_STEP } else { STEP }
}

/// Returns whether a particle met a collider in this substep at a speed that needs more substeps
/// than the settings ask for.
pub(crate) fn has_fast_impact(world: &World) -> bool {
    let settings = &world.settings;
    let speed = settings.substeps as f32 * step(world) / settings.tick;
    world.scratch.contacts.collider_contacts.iter().any(|contact| {
        let relative = contact.approach_velocity - contact.surface_velocity;
        relative.length_squared() > speed * speed
    })
}

/// Returns whether a particle moves farther than `length` [m] in the next tick.
fn has_longer_displacement(world: &World, length: f32) -> bool {
    if length < 0.0 {
        return true;
    }
    let speed = length / world.settings.tick;
    is_one_faster(world.particles.v.slices(), speed * speed)
}

/// Returns whether the square of a velocity is above `speed2` [m²/s²].
fn is_one_faster([x, y, z]: [&[f32]; 3], speed2: f32) -> bool {
    let mut found = 0_u32;
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        found |= u32::from(x * x + y * y + z * z > speed2);
    }
    found != 0
}

/// Returns the largest ratio of a relative path to the step of its body, and at least `least`.
fn largest_ratio(world: &World, bodies: &[BodyMotion], least: f32) -> f32 {
    let (p, tick, mut most) = (&world.particles, world.settings.tick, least);
    let with_shape = || world.colliders.iter().filter(|body| body.collision_shape().is_some());
    for first in (0..p.len()).step_by(BLOCK) {
        let block = first..(first + BLOCK).min(p.len());
        let (bounds, moves) = block_bounds(world, block.clone());
        for (motion, body) in bodies.iter().zip(with_shape()) {
            if motion.longest_path(body, &bounds, &moves) <= most * motion.step {
                continue;
            }
            for i in block.clone().filter(|i| p.w[*i] > 0.0) {
                let (least, moved) = (most * motion.step, p.v.get(i) * tick);
                let path = motion.relative_path(body, p.x.get(i), moved, least);
                most = max(path / motion.step, most);
            }
        }
    }
    most
}

/// Returns the bounds of the positions of a block of particles, and of their displacements in the
/// next tick [m].
fn block_bounds(world: &World, block: Range<usize>) -> (Aabb, Aabb) {
    let (mut bounds, mut moves) = (Aabb::EMPTY, Aabb::EMPTY);
    for i in block {
        let (x, v): (Vec3, Vec3) = (world.particles.x.get(i), world.particles.v.get(i));
        bounds.include(x);
        moves.include(v * world.settings.tick);
    }
    (bounds, moves)
}
