//! Stage `Bend`: what is bent straightens, by the bending rigidity of the material.
//!
//! Grids bend as plates (see `plates`), other meshes at their hinges (see `flaps`). What left a plate when the
//! cloth was torn bends where its threads meet (see `elbows`), what a cut divided at hinges of its own. With a
//! rigidity of 1 or more all of it is links over two cells, as rigid as the sweeps allow, see `links`.
//!
//! The first round comes before the links, so that they bear the load that bending leaves them as they bear
//! the weight; the second comes on the way back.

pub(crate) mod banded;
pub(crate) mod chebyshev;
pub(crate) mod hinge;
pub(crate) mod irregular;
pub(crate) mod mesh_implicit;
pub(crate) mod plate;
pub(crate) mod rest_direction;
pub(crate) mod spectral_bound;
pub(crate) mod stiffness_matrix;
pub(crate) mod twist;

use crate::solver::bend::mesh_implicit::Flaps;
use crate::solver::stretch::distance::Order;

use crate::solver::stretch::{distance, mesh_kernel};

use crate::math::columns::Columns;
use crate::model::folds::{Lengths, Line2};
use crate::model::hinges::Hinge;
use crate::model::links::LinkKind;
use crate::model::plate_elements::{Each, PlateElements};
use crate::solver::world::World;
use glam::Vec3;

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct BendScratch {
    pub plates: plate::PlateScratch,
    /// The normals of a grid, current while folds are looked at, and the ways that its elements are bent.
    normal: Columns,
    ways: Each<Columns>,
    flaps: mesh_implicit::MeshBendScratch,
}

impl BendScratch {
    /// Room for so many particles.
    pub fn new(world: &World, capacity: usize) -> Self {
        let is_grid = world.plates.is_some();
        let (triangles, hinges) = (world.mesh.triangles.len(), world.constraints.hinges.all.len());
        let grid = || Columns::filled(world.plates.as_ref().map_or(0, PlateElements::count));
        let plates = world.plates.as_ref().map(plate::PlateScratch::new);
        Self {
            plates: plates.unwrap_or_default(),
            normal: grid(),
            ways: [grid(), grid(), grid()],
            flaps: if is_grid {
                mesh_implicit::MeshBendScratch::default()
            } else {
                mesh_implicit::MeshBendScratch::new(triangles, hinges, capacity)
            },
        }
    }
}

/// Whether bending is a matter of plates and hinges.
fn is_elastic(world: &World) -> bool {
    world.material.bend_stiffness > 0.0 && world.material.bend_stiffness < 1.0
}

/// Whether bending may turn a cloth as a whole. One round of it leaves a rest of what it should do, and damping
/// counts from where the substep began: neither is free of torque where there is something to bend.
pub(crate) fn may_turn(world: &World) -> bool {
    is_elastic(world) && (world.folds.are_any || world.material.bend_damping > 0.0)
}

/// The first round of a substep.
pub(crate) fn begin(world: &mut World) {
    if is_elastic(world) {
        bend(world, Order::Forward);
    }
}

/// Once in a sweep, as far as bending is a matter of links, or on the way back of the first one.
pub(crate) fn go_on(world: &mut World, order: Order, iteration: u32) {
    if !is_elastic(world) {
        distance::solve(world, LinkKind::Bend, order);
    } else if iteration == 1 {
        // PlateElements are in columns, whatever the links are in.
        let is_packed = world.plates.is_some() && world.scratch.interleaved.is_current;
        if is_packed {
            mesh_kernel::unpack(world);
        }
        bend(world, Order::Backward);
        if is_packed {
            mesh_kernel::pack(world);
        }
    }
}

/// Each way to bend is a function of its own, as stages are (see `pipeline`).
fn bend(world: &mut World, order: Order) {
    let scheme = world.settings.scheme();
    // Damping acts against how much more or less something is bent than when the substep began.
    let lag = world.material.bend_damping / scheme.h;
    let stiffness = world.material.bend_stiffness * scheme.step * scheme.step * (1.0 + lag);
    let step = hinge::Step { stiffness, before: lag / (1.0 + lag) };
    if world.plates.is_some() {
        bend_plates(world, step, order);
        if order == Order::Forward {
            bend_elbows(world, step);
        }
    } else {
        bend_hinges(world, step, order);
    }
    if order == Order::Forward {
        bend_late(world, step);
    }
}

#[inline(never)]
fn bend_plates(world: &mut World, step: hinge::Step, order: Order) {
    let inertia = world.inertia();
    let [lightest, _] = world.mass_scales.range();
    let Some(plates) = &world.plates else { return };
    let area = plates.spacing * plates.spacing;
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let rest = if world.folds.are_any {
        let (normal, ways) = (&mut scratch.bend.normal, &mut scratch.bend.ways);
        rest_direction::find_normals(world.level, plates, &p.x, normal);
        rest_direction::find_ways(world.level, plates, &world.folds.offset, &p.x, normal, ways);
        Some((&world.folds.offset, &scratch.bend.ways))
    } else {
        None
    };
    let step = plate::Step {
        level: world.level,
        stiffness: step.stiffness / area,
        mass: world.material.density * area * lightest,
        before: step.before,
        is_first: order == Order::Forward,
        predicted: &scratch.predicted,
        way: &scratch.displacement,
        rest,
        softening: world.folds.wear.softens(&world.material),
    };
    let mass = inertia.as_deref().unwrap_or(&p.mass);
    plate::bend(plates, &mut scratch.bend.plates, step, &mut p.x, &p.w, mass);
    if let Some(inertia) = inertia {
        scratch.inertia = inertia;
    }
}

/// After a tick: folds stay where the cloth is bent beyond what its material bears.
pub(crate) fn yield_folds(world: &mut World) {
    if world.material.yield_angle == 0.0 || world.material.yield_creep == 0.0 || !is_elastic(world)
    {
        return;
    }
    let (material, x) = (&world.material, &world.particles.x);
    if let Some(plates) = &world.plates {
        rest_direction::find_normals(world.level, plates, x, &mut world.scratch.bend.normal);
        world.folds.yield_plates(plates, material, x, &world.scratch.bend.normal);
    } else {
        world.folds.yield_hinges(&world.constraints.hinges, material, world.mean_edge, x);
    }
}

impl World {
    /// Takes over folds from elsewhere; false if they do not fit.
    pub fn take_folds(&mut self, angle: Each<Vec<f32>>) -> bool {
        let lengths = match &self.plates {
            Some(plates) => Lengths::Grid(plates.spacing),
            None => Lengths::Hinges(&self.constraints.hinges.all),
        };
        self.folds.take_over(angle, &lengths)
    }

    /// Takes over what folds gave way by; false if that does not fit.
    pub fn take_wear(&mut self, curve: Vec<f32>) -> bool {
        let fits = self.folds.wear.take_over(curve);
        self.folds.reserve_wear(&self.material);
        fits
    }

    /// Folds a grid along a line in its plane [m].
    pub fn crease_flat(&mut self, from: [f32; 2], to: [f32; 2], angle: f32) {
        if let (Some(plates), true) = (&self.plates, from != to) {
            let wears = self.material.wears();
            self.folds.crease_plates(plates, Line2::new(from, to), angle, wears);
        }
    }

    /// Folds any mesh along a line [m].
    pub fn crease_across(&mut self, line: [Vec3; 2], angle: f32) {
        let (mesh, rest) = (&self.mesh, &self.rest);
        let at = |hinge: &Hinge| hinge.at.map(|v| rest[mesh.source[v as usize] as usize]);
        let (hinges, wears) = (&self.constraints.hinges, self.material.wears());
        self.folds.crease_hinges(hinges, at, line, self.mean_edge, angle, wears);
    }
}

/// What left its place in a grid.
#[inline(never)]
fn bend_elbows(world: &mut World, step: hinge::Step) {
    let Some(plates) = &world.plates else { return };
    let (scratch, [weft, warp, _]) = (&world.scratch, &world.folds.offset);
    let step = irregular::Step {
        elbows: &plates.elbows,
        stiffness: step.stiffness / (plates.spacing * plates.spacing),
        before: step.before,
        predicted: &scratch.predicted,
        way: &scratch.displacement,
        rest: world.folds.are_any.then_some([weft, warp]),
        softening: world.folds.wear.softens(&world.material),
    };
    irregular::bend(world.level, step, &mut world.particles);
}

/// What cuts folded anew.
#[inline(never)]
fn bend_late(world: &mut World, step: hinge::Step) {
    let links = &world.constraints.extra;
    if world.constraints.loose.batches_of(LinkKind::Bend).is_empty() {
        return;
    }
    for link in 0..links.len() {
        if links.kind(link) != LinkKind::Bend || !links.active[link] {
            continue;
        }
        let hinge = world.constraints.hinges.late(&world.mesh, links, link, &world.rest);
        if let Some(hinge) = hinge {
            let scratch = &world.scratch;
            let start = |i: usize| scratch.predicted.at(i) - scratch.displacement.at(i);
            hinge::project(&hinge, step, start, &mut world.particles);
        }
    }
}

#[inline(never)]
fn bend_hinges(world: &mut World, step: hinge::Step, order: Order) {
    let (count, scratch) = (world.particles.len(), &mut world.scratch);
    let (predicted, way) = (&scratch.predicted, &scratch.displacement);
    let cell = world.mean_edge * world.mean_edge;
    let flaps = Flaps {
        hinges: &world.constraints.hinges,
        active: &world.constraints.links.active,
        folds: world.folds.are_any.then_some(&world.folds.offset[0][..]),
        softening: world.folds.wear.softens(&world.material),
        step,
        over_mass: step.stiffness / (world.material.density * cell * cell),
        is_first: order == Order::Forward,
    };
    let start = |i: usize| predicted.at(i) - way.at(i);
    let room = &mut scratch.bend.flaps;
    if scratch.interleaved.is_current {
        flaps.bend(room, count, start, &mut scratch.interleaved);
    } else {
        flaps.bend(room, count, start, &mut world.particles);
    }
}
