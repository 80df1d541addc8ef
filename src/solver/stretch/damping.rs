//! Damping of stretch: links that give way are slow to.
//!
//! What pulls at a link is k (l − rest) + k τ l', and with l' = (l − l₀) / h over the substep that is the pull of
//! a link 1 + τ / h times as stiff that rests at (rest + l₀ τ / h) / (1 + τ / h). So links are such ones
//! while a substep is solved, and themselves again then. It brakes along links alone: what turns, bends or
//! falls does not feel it.

use crate::math::column::Column;
use crate::model::constraints::Constraints;
use crate::model::links::{LinkKind, Links};
use crate::solver::stretch::distance::is_rigid;
use crate::solver::world::World;
use glam::Vec3;

/// What links are when no substep is solved: lengths at rest and compliances of the woven and the extra ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct DampingScratch {
    kept: [[Column; 2]; 2],
}

impl DampingScratch {
    /// Room for so many links.
    pub fn new(woven: usize, extra: usize) -> Self {
        let room = |count: usize| [Column::with_capacity(count), Column::with_capacity(count)];
        Self { kept: [room(woven), room(extra)] }
    }
}

fn is_on(world: &World) -> bool {
    world.material.stretch_damping > 0.0 && !is_rigid(world, LinkKind::Shear)
}

/// Makes links those of a substep.
pub(crate) fn begin(world: &mut World) {
    if !is_on(world) {
        return;
    }
    let lag = world.material.stretch_damping / world.settings.scheme().h;
    let (to, way) = (&world.scratch.predicted, &world.scratch.displacement);
    let start = |i: u32| to.at(i as usize) - way.at(i as usize);
    let Constraints { links, extra, .. } = &mut world.constraints;
    for (links, [rest, compliance]) in
        [links, extra].into_iter().zip(&mut world.scratch.damping.kept)
    {
        rest.clone_from(&links.rest);
        compliance.clone_from(&links.compliance);
        slow(links, start, lag);
    }
    follow(&mut world.constraints);
}

/// Makes links themselves again.
pub(crate) fn end(world: &mut World) {
    if !is_on(world) {
        return;
    }
    let Constraints { links, extra, .. } = &mut world.constraints;
    for (links, [rest, compliance]) in [links, extra].into_iter().zip(&world.scratch.damping.kept) {
        links.rest.copy_from_slice(rest);
        links.compliance.copy_from_slice(compliance);
    }
    follow(&mut world.constraints);
}

fn slow(links: &mut Links, start: impl Fn(u32) -> Vec3, lag: f32) {
    let over = 1.0 / (1.0 + lag);
    for link in 0..links.len() {
        if !links.active[link] || links.kind(link) == LinkKind::Bend {
            continue;
        }
        let length = (start(links.b[link]) - start(links.a[link])).length();
        links.rest[link] = (links.rest[link] + length * lag) * over;
        links.compliance[link] *= over;
    }
}

/// Lines and loose links have the lengths of the links that they are.
fn follow(constraints: &mut Constraints) {
    constraints.lines.abreast.measure(&constraints.links);
    constraints.loose.measure(&constraints.extra);
    if let Some(rows) = &mut constraints.rows {
        rows.loose.measure(&constraints.links);
    }
}
