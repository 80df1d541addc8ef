//! Stretch damping: a viscous force along compliant links, solved implicitly with the links.
//!
//! A Kelvin-Voigt link pulls with k (l − rest) + k τ l'. Over a substep of length h, l' = (l − l₀)
//! / h, where l₀ is the length at its start. So the pull equals that of an undamped link with
//!
//! ```text
//! stiffness  k (1 + τ / h)                       so  compliance / (1 + τ / h)
//! rest       (rest + l₀ τ / h) / (1 + τ / h)
//! ```
//! A link has these values while a substep is solved, and gets its own values back at the end. The
//! damping acts along links only: rotation, bending and free fall are not damped.
//!
//! Reads `material.stretch_damping` (τ [s]) and the positions at the start of the substep; writes
//! `rest` and `compliance` of the links.
//! Invariant: [`apply`] and [`remove`] are called in pairs; nothing tears in between.

use crate::model::constraints::Constraints;
use crate::model::links::{LinkKind, Links};
use crate::solver::stretch::link_projection::is_rigid;
use crate::solver::world::World;
use glam::Vec3;

fn is_on(world: &World) -> bool {
    world.material.stretch_damping > 0.0 && !is_rigid(&world.material, LinkKind::Shear)
}

/// Replaces rest lengths and compliances by those of the damped links of this substep.
pub(crate) fn apply(world: &mut World) {
    if !is_on(world) {
        return;
    }
    let ratio = world.material.stretch_damping / world.regular_scheme().h;
    let (predicted, displacement) = (&world.scratch.predicted, &world.scratch.displacement);
    let start = |i: u32| predicted.get(i as usize) - displacement.get(i as usize);
    let Constraints { links, dynamic, .. } = &mut world.constraints;
    let undamped = &mut world.scratch.damping.undamped;
    for (links, [rest, compliance]) in [links, dynamic].into_iter().zip(undamped) {
        rest.clone_from(&links.rest);
        compliance.clone_from(&links.compliance);
        damp(links, start, ratio);
    }
    update_copies(&mut world.constraints);
}

/// Restores the rest lengths and compliances of the undamped links.
pub(crate) fn remove(world: &mut World) {
    if !is_on(world) {
        return;
    }
    let Constraints { links, dynamic, .. } = &mut world.constraints;
    let undamped = &world.scratch.damping.undamped;
    for (links, [rest, compliance]) in [links, dynamic].into_iter().zip(undamped) {
        links.rest.copy_from_slice(rest);
        links.compliance.copy_from_slice(compliance);
    }
    update_copies(&mut world.constraints);
}

/// Applies the formulas of the module doc, with `ratio` = τ / h, to all active stretch and shear
/// links.
fn damp(links: &mut Links, start: impl Fn(u32) -> Vec3, ratio: f32) {
    let inverse = 1.0 / (1.0 + ratio);
    let Links { a, b, rest, compliance, active, spec, .. } = links;
    let (rest, compliance) = (&mut **rest, &mut **compliance);
    for link in 0..spec.len() {
        if !active[link] || spec[link].kind == LinkKind::Bend {
            continue;
        }
        let length = (start(b[link]) - start(a[link])).length();
        rest[link] = (rest[link] + length * ratio) * inverse;
        compliance[link] *= inverse;
    }
}

/// Copies the rest lengths to the line blocks and the sparse links.
fn update_copies(constraints: &mut Constraints) {
    constraints.chains.blocks.update_rest_lengths(&constraints.links);
    constraints.sparse.update_rest_lengths(&constraints.dynamic);
    if let Some(rows) = &mut constraints.rows {
        rows.sparse.update_rest_lengths(&constraints.links);
    }
}
