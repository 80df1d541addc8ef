//! Stage `Bend`: bending elements pull the cloth towards its rest curvature.
//!
//! ```text
//! mesh             0 < bend_stiffness < 1                bend_stiffness >= 1
//! grid             plate elements: `plate`               distance links over two edges,
//!   torn parts     `irregular`, element by element       solved with the other links
//! any other mesh   hinges: `mesh_implicit`
//! after a cut      `hinge`, hinge by hinge
//! ```
//! Method: quadratic bending energy (Bergou et al., "A quadratic bending model for inextensible
//! surfaces", SGP 2006), one implicit step per substep for the whole sheet. `bend_stiffness` is the
//! bending rigidity [N m].
//!
//! The first solve of a substep comes before the links, so that the links carry the forces of
//! bending like the weight; the second comes in the first backward sweep.
//!
//! Reads elements, folds, masses and the predicted positions; writes particle positions.
//! Invariant: bending conserves linear momentum. The stage works on columns or on the interleaved
//! layout, whichever is current. With `bend_stiffness` 0 it does nothing.

pub(crate) mod banded;
pub(crate) mod bend_scratch;
pub(crate) mod chebyshev;
pub(crate) mod fold_edits;
pub(crate) mod hinge;
pub(crate) mod incomplete_cholesky;
pub(crate) mod irregular;
pub(crate) mod line_factors;
pub(crate) mod mesh_implicit;
pub(crate) mod plate;
pub(crate) mod plate_kernels;
pub(crate) mod rest_direction;
pub(crate) mod spectral_bound;
pub(crate) mod stiffness_matrix;
pub(crate) mod twist;

use crate::math::min;
use crate::model::bend_scale::BendScale;
use crate::model::folds::Folds;
use crate::model::links::LinkKind;
use crate::model::maps::Maps;
use crate::model::material::Material;
use crate::solver::bend::hinge::HingeStep;
use crate::solver::bend::mesh_implicit::MeshBend;
use crate::solver::integrate::elastic_corrections;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::stretch::{distance, mesh_kernel};
use crate::solver::world::World;
use glam::Vec3;

/// Largest bending rigidity that painted scales give [N m], as of the material.
const MAX_RIGIDITY: f32 = 1.0;

/// Largest time of bending damping, in substeps. Products with it stay finite.
const MAX_LAG: f32 = 1.0e10;

/// Whether this stage may change the angular momentum of a free piece.
///
/// An implicit solve with few iterations leaves a residual, and damping measures from the start of
/// the substep. Both exert a torque once folds or damping are in use.
pub(crate) fn may_add_spin(world: &World) -> bool {
    is_elastic(world) && (world.folds.has_any || world.material.bend_damping > 0.0)
}

/// Whether plates and hinges bend the cloth; otherwise bend links do.
fn is_elastic(world: &World) -> bool {
    world.material.bend_stiffness > 0.0 && world.material.bend_stiffness < 1.0
}

/// Runs the first bending solve of a substep.
pub(crate) fn solve_first(world: &mut World) {
    if is_elastic(world) {
        solve_elements(world, SweepOrder::Forward);
    }
}

/// Runs the part of bending that belongs to sweep `iteration`: the bend links in every sweep, or
/// the second solve of the elements in the first backward sweep.
pub(crate) fn solve_in_sweep(world: &mut World, order: SweepOrder, iteration: u32) {
    if !is_elastic(world) {
        distance::solve(world, LinkKind::Bend, order);
    } else if iteration == 1 {
        // The plate solver needs columns, even if the links use the interleaved layout.
        let is_packed = world.plate_elements.is_some() && world.scratch.interleaved.is_current;
        if is_packed {
            mesh_kernel::scatter(world);
        }
        solve_elements(world, SweepOrder::Backward);
        if is_packed {
            mesh_kernel::gather(world);
        }
    }
}

/// Solves all bending elements once. Each solver is a function of its own that is never inlined,
/// for the reason given in `pipeline`.
fn solve_elements(world: &mut World, order: SweepOrder) {
    let scheme = world.scheme();
    // Damping acts on the change of curvature since the start of the substep.
    let lag = min(world.material.bend_damping / scheme.h, MAX_LAG);
    let stiffness =
        world.material.bend_stiffness * scheme.velocity_step * scheme.velocity_step * (1.0 + lag);
    let step = HingeStep { stiffness, start_share: lag / (1.0 + lag) };
    elastic_corrections::run(world, |world| {
        if world.plate_elements.is_some() {
            solve_plates(world, step, order);
        } else {
            solve_hinges(world, step, order);
        }
    });
    if order == SweepOrder::Forward {
        solve_off_grid(world, step);
    }
}

/// Bends the elements that tears and cuts took out of the regular layout, in a sweep forward and one
/// backward, since the elements of one sweep in one direction would add energy.
#[inline(never)]
fn solve_off_grid(world: &mut World, step: HingeStep) {
    let has_irregular =
        world.plate_elements.as_ref().is_some_and(|plates| !plates.irregular.groups.is_empty());
    let has_hinges = !world.constraints.sparse.batches_of(LinkKind::Bend).is_empty();
    if has_irregular {
        solve_irregular(world, step, SweepOrder::Forward);
    }
    if has_hinges {
        solve_cut_hinges(world, step, SweepOrder::Forward);
        solve_cut_hinges(world, step, SweepOrder::Backward);
    }
    if has_irregular {
        solve_irregular(world, step, SweepOrder::Backward);
    }
}

/// Bends a grid by its plate elements.
#[inline(never)]
fn solve_plates(world: &mut World, step: HingeStep, order: SweepOrder) {
    let effective_mass = world.compute_effective_mass();
    let [lightest, _] = world.mass_scales.range();
    let Some(plates) = &world.plate_elements else { return };
    let area = plates.spacing * plates.spacing;
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let rest = if world.folds.has_any {
        let (normal, directions) = (&mut scratch.bend.normal, &mut scratch.bend.rest_direction);
        let offset = &world.folds.offset;
        rest_direction::compute_normals(world.level, plates, &p.x, normal);
        rest_direction::compute(world.level, plates, offset, &p.x, normal, directions);
        Some((offset, &scratch.bend.rest_direction))
    } else {
        None
    };
    let (stiffness, mass) = (step.stiffness / area, world.material.density * area * lightest);
    let limit = plate::MAX_STIFFNESS_OVER_MASS * mass / stiffness;
    let step = plate::PlateStep {
        level: world.level,
        stiffness,
        mass,
        start_share: step.start_share,
        is_first: order == SweepOrder::Forward,
        predicted: &scratch.predicted,
        displacement: &scratch.displacement,
        rest,
        scale: BendScale::new(&world.folds.hardening, &world.material, &world.maps, limit),
    };
    let mass = effective_mass.as_deref().unwrap_or(&p.mass);
    plate::solve(plates, &mut scratch.bend.plates, step, &mut p.x, &p.w, mass);
    if let Some(effective_mass) = effective_mass {
        scratch.effective_mass = effective_mass;
    }
}

/// Updates the folds at the end of a tick: an element that is bent beyond its yield angle keeps a
/// part of that angle (plasticity).
pub(crate) fn update_folds(world: &mut World) {
    if world.material.yield_angle == 0.0 || world.material.yield_creep == 0.0 || !is_elastic(world)
    {
        return;
    }
    let (material, x) = (&world.material, &world.particles.x);
    if let Some(plates) = &world.plate_elements {
        rest_direction::compute_normals(world.level, plates, x, &mut world.scratch.bend.normal);
        world.folds.yield_plates(plates, material, x, &world.scratch.bend.normal);
    } else {
        world.folds.yield_hinges(&world.constraints.hinges, material, world.mean_edge, x);
    }
}

/// Scales of the bending stiffness that give at most `MAX_RIGIDITY`.
fn bend_scale<'a>(folds: &'a Folds, material: &Material, maps: &'a Maps) -> BendScale<'a> {
    BendScale::new(&folds.hardening, material, maps, MAX_RIGIDITY / material.bend_stiffness)
}

/// Bends the parts of a grid whose elements tears took out of the regular layout.
#[inline(never)]
fn solve_irregular(world: &mut World, step: HingeStep, order: SweepOrder) {
    let Some(plates) = &mut world.plate_elements else { return };
    let mut lambda = core::mem::take(&mut plates.irregular.lambda);
    if order == SweepOrder::Forward {
        lambda.iter_mut().for_each(|lambda| lambda.fill(0.0));
    }
    let (scratch, [weft, warp, _]) = (&world.scratch, &world.folds.offset);
    let step = irregular::IrregularStep {
        elements: &plates.irregular,
        stiffness: step.stiffness / (plates.spacing * plates.spacing),
        start_share: step.start_share,
        predicted: &scratch.predicted,
        displacement: &scratch.displacement,
        rest: world.folds.has_any.then_some([weft, warp]),
        scale: bend_scale(&world.folds, &world.material, &world.maps),
    };
    irregular::solve(world.level, step, order, &mut lambda, &mut world.particles);
    plates.irregular.lambda = lambda;
}

/// Bends the hinges that cuts added, one after the other.
#[inline(never)]
fn solve_cut_hinges(world: &mut World, step: HingeStep, order: SweepOrder) {
    let links = &world.constraints.dynamic;
    let scale = bend_scale(&world.folds, &world.material, &world.maps);
    let lambda = &mut world.scratch.bend.hinge_lambda;
    if order == SweepOrder::Forward {
        lambda.clear();
        lambda.resize(links.len(), Vec3::ZERO);
    }
    for k in 0..links.len() {
        let link = match order {
            SweepOrder::Forward => k,
            SweepOrder::Backward => links.len() - 1 - k,
        };
        if links.kind(link) != LinkKind::Bend || !links.active[link] {
            continue;
        }
        let hinge = world.constraints.hinges.dynamic_hinge(&world.mesh, links, link, &world.rest);
        if let Some(mut hinge) = hinge {
            hinge.shape *= scale.painted(&hinge.particles);
            if hinge.shape == 0.0 {
                continue;
            }
            let (predicted, displacement) = (&world.scratch.predicted, &world.scratch.displacement);
            let start = |i: usize| predicted.get(i) - displacement.get(i);
            hinge::project(&hinge, step, start, &mut lambda[link], &mut world.particles);
        }
    }
}

/// Bends a mesh by its hinges.
#[inline(never)]
fn solve_hinges(world: &mut World, step: HingeStep, order: SweepOrder) {
    let (count, scratch) = (world.particles.len(), &mut world.scratch);
    let (predicted, displacement) = (&scratch.predicted, &scratch.displacement);
    let cell = world.mean_edge * world.mean_edge;
    let scale = bend_scale(&world.folds, &world.material, &world.maps);
    let solver = MeshBend {
        hinges: &world.constraints.hinges,
        active: &world.constraints.links.active,
        folds: world.folds.has_any.then_some(&world.folds.offset[0][..]),
        scale,
        step,
        stiffness_over_mass: step.stiffness * scale.largest()
            / (world.material.density * cell * cell),
        triangles: &world.mesh.triangles,
        corner_area: &world.corner_area,
        rest: &world.rest,
        site: &world.mesh.source,
        is_first: order == SweepOrder::Forward,
    };
    let start = |i: usize| predicted.get(i) - displacement.get(i);
    let buffers = &mut scratch.bend.mesh;
    if scratch.interleaved.is_current {
        solver.solve(buffers, count, start, &mut scratch.interleaved);
    } else {
        solver.solve(buffers, count, start, &mut world.particles);
    }
}
