//! Solves the contacts of all colliders in one substep, one collider after the other.
//!
//! ```text
//! each collider    particles ─▶ triangles (`triangle_rounds`)
//! again            particles and triangles that one collider pushed into another
//! then             particles between two colliders, and in the creases where solids overlap
//!                  (`squeezed`)
//! ```
//! Reads colliders, the blocks near them, positions and predicted positions; writes positions and
//! the list of contacts.
//! Invariant: contacts are sorted by collider, with at most one for a particle and a collider.

use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::contact_distance::contact_gap;
use crate::solver::collide::local_particles::{
    ContactMaterial, ContactScales, Depenetration, LocalParticles,
};
use crate::solver::collide::long_triangles::MeasuredSurface;
use crate::solver::collide::projection::{MAX_DEPENETRATION_SPEED, Projection};
use crate::solver::collide::triangle_rounds::{ClothTriangles, ROUND_TOLERANCE, RoundScratch};
use crate::solver::collide::{particle_vs_shape, squeezed, triangle_rounds};
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;
use glam::Vec3;

/// The largest number of times that what one collider pushed into another is pushed out again.
const MAX_REPEATS: u32 = 7;

/// The largest number of steps in which particles leave a crease.
const MAX_CREASE_STEPS: u32 = 20;

/// The length of the first of these steps, in depths, and by how much the next one is longer.
const FIRST_CREASE_STEP: f32 = 3.0;
const CREASE_STEP_GROWTH: f32 = 1.5;

/// The longest way along a crease, in mean edge lengths.
const MAX_WAY_IN_CREASE: f32 = 2.0;

/// A penetration deeper than this, in mean edge lengths, is not the result of motion. The first
/// value is for round shapes, the second for shapes with flat faces, whose vertices may stick
/// through the cloth.
const DEEP: [f32; 2] = [0.25, 0.75];

/// Solves the contacts of all colliders, one after the other. `frames` gives the frames of a
/// collider at the start and at the end, and `part` is the end and the length of the way of surfaces
/// that deform, in ticks. With `projection` it only pushes out, without friction and
/// restitution.
pub(super) fn solve(
    world: &mut World,
    frames: &dyn Fn(&ColliderBody) -> [Transform; 2],
    part: [f32; 2],
    projection: Option<Projection>,
) {
    let mut run = |pass| run_pass(world, frames, part, projection, pass);
    run(Pass::First);
    (0..MAX_REPEATS).all(|_| run(Pass::Again));
    if run(Pass::Distances) {
        let leave_creases = |run: &mut dyn FnMut(Pass) -> bool| {
            let mut reach = FIRST_CREASE_STEP;
            (0..MAX_CREASE_STEPS).all(|_| {
                let has_moved = run(Pass::Creases { reach });
                reach *= CREASE_STEP_GROWTH;
                has_moved
            });
        };
        leave_creases(&mut run);
        (0..MAX_REPEATS).all(|_| {
            let has_pushed = run(Pass::Again);
            if has_pushed {
                leave_creases(&mut run);
            }
            has_pushed
        });
        run(Pass::Creases { reach: 0.0 });
    }
    let contacts = &mut world.scratch.contacts;
    let (list, slots) = (&mut contacts.collider_contacts, &mut contacts.contact_slots);
    ColliderContact::sort_by_body(list, slots);
}

/// What is done with each collider.
#[derive(Clone, Copy, PartialEq)]
enum Pass {
    /// Pushes particles and triangles out.
    First,
    /// Pushes particles and triangles out again that another collider pushed into this one.
    Again,
    /// Measures the distances of particles that two colliders push towards each other; then these are
    /// separated.
    Distances,
    /// Pushes out particles that two colliders leave no room on the line between them, by one step.
    Creases {
        /// The longest step, in depths; 0: those that did not come out go back.
        reach: f32,
    },
}

/// Runs one pass over all colliders. Without particles between two colliders only the first does
/// anything. Returns whether another pass has something to do: after `Again` the same one, after
/// `Distances` and `Creases` the latter.
fn run_pass(
    world: &mut World,
    frames: &dyn Fn(&ColliderBody) -> [Transform; 2],
    part: [f32; 2],
    projection: Option<Projection>,
    pass: Pass,
) -> bool {
    let contacts = &mut world.scratch.contacts;
    let count = contacts.collider_contacts.len();
    let is_needed = match pass {
        Pass::First | Pass::Creases { .. } => true,
        Pass::Again => count > 0 && contacts.nearby.are_several_near(),
        Pass::Distances => squeezed::select(contacts),
    };
    if !is_needed {
        return false;
    }
    let mut has_pushed = false;
    let scheme = world.scheme();
    let is_projection = projection.is_some();
    let pushes_triangles = projection != Some(Projection::Particles);
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let contacts = &mut scratch.contacts;
    let scales = ContactScales::new(&world.maps, &contacts.room);
    let cloth =
        ClothTriangles { mesh: &world.mesh, mean_edge: world.mean_edge, level: world.level };
    let predicted = [&scratch.predicted, &scratch.displacement];
    let mut rounds = RoundScratch {
        long: &mut contacts.long,
        clearance: &mut contacts.clearance,
        pushes: &mut contacts.pushes,
        long_pairs: &mut contacts.long_pairs,
        slacks: &mut contacts.slacks,
        corners: &mut contacts.corners,
    };
    for (at, body) in world.colliders.iter_mut().enumerate() {
        let neighbours = contacts.nearby.of_collider(at);
        if neighbours.particle_blocks.is_empty() {
            continue;
        }
        if let Some(deformation) = body.deformation_mut().filter(|_| pass == Pass::First) {
            deformation.pose(part);
        }
        let Some(shape) = body.collision_shape() else { continue };
        let gap = contact_gap(body, world.material.thickness)
            * projection.map_or(1.0, Projection::gap_share);
        let frames = frames(body);
        let mut particles = LocalParticles {
            x: &mut p.x,
            v: &p.v,
            w: &p.w,
            displacement: &scratch.displacement,
            predicted: &scratch.predicted,
            frames,
            is_moving: frames[0] != frames[1],
            material: if is_projection {
                ContactMaterial::FRICTIONLESS
            } else {
                ContactMaterial::of(body, world.material.friction, world.material.restitution)
            },
            contact_scales: scales,
            gap,
            margin: neighbours.sagitta_margin,
            depenetration: Depenetration {
                max_step: MAX_DEPENETRATION_SPEED * scheme.h,
                deep: if is_projection {
                    2.0 * gap
                } else {
                    DEEP[usize::from(shape.bends().is_some())] * world.mean_edge
                },
                holds_deep: is_projection,
            },
            scheme,
            body: at as u32,
            is_far_from_zero: world.origin != Vec3::ZERO,
            holds_corners: pass == Pass::Again || is_projection,
            contacts: &mut contacts.collider_contacts,
            contact_slots: &mut contacts.contact_slots,
            max_contacts: contacts.max_contacts,
        };
        let candidates = &neighbours.candidates;
        let mut pushed = 0.0;
        let has_triangles = match pass {
            Pass::First => {
                let can_dip = neighbours.longest_free_edge < f32::INFINITY;
                let clearance = &mut *rounds.clearance;
                if can_dip || clearance.len() != particles.w.len() {
                    // Corners of triangles that lie in no listed particle block count as near.
                    clearance.clear();
                    clearance.resize(particles.w.len(), 0.0);
                }
                let first_contact = particles.contacts.len();
                let (level, blocks) = (world.level, neighbours.particle_blocks);
                let own = &mut particles;
                particle_vs_shape::solve_blocks(level, shape, own, blocks, candidates, clearance);
                if pushes_triangles && can_dip {
                    let new = &particles.contacts[first_contact..];
                    let surface = surface(&cloth, particles.x, predicted, scales);
                    rounds.long.measure_after_pushes(new, cloth.mean_edge, surface);
                    if shape.bends().is_none() && !rounds.long.list().is_empty() {
                        let (own, clearance) = (&particles, &mut *rounds.clearance);
                        particle_vs_shape::measure_other_blocks(
                            level, shape, own, blocks, clearance,
                        );
                    }
                }
                true
            }
            Pass::Again => {
                pushed = squeezed::push_again(shape, &mut particles, candidates, count);
                let (mesh, rounds) = (cloth.mesh, &mut rounds);
                triangle_rounds::mark_pushed_by_others(shape, &particles, &neighbours, mesh, rounds)
            }
            Pass::Distances | Pass::Creases { .. } => {
                let is_in_crease = pass != Pass::Distances;
                squeezed::measure(shape, &mut particles, candidates, count, is_in_crease);
                false
            }
        };
        if pushes_triangles && has_triangles {
            let (own, rounds) = (&mut particles, &mut rounds);
            pushed += triangle_rounds::push_triangles(body, own, &neighbours, cloth, rounds, part);
        }
        has_pushed |= pushed > gap * ROUND_TOLERANCE;
    }
    match pass {
        Pass::Distances => {
            has_pushed = squeezed::separate(&mut p.x, contacts);
            let scales = ContactScales::new(&world.maps, &contacts.room);
            contacts.long.measure_after_narrowing(surface(&cloth, &p.x, predicted, scales));
            has_pushed
        }
        Pass::Creases { reach } => {
            squeezed::leave_creases(&mut p.x, contacts, reach, world.mean_edge * MAX_WAY_IN_CREASE)
        }
        Pass::First | Pass::Again => has_pushed,
    }
}

/// Returns what long triangles are found from.
fn surface<'a>(
    cloth: &ClothTriangles<'a>,
    x: &'a Columns,
    predicted: [&'a Columns; 2],
    scales: ContactScales<'a>,
) -> MeasuredSurface<'a> {
    let (triangles, room) = (&cloth.mesh.triangles[..], scales.all_room());
    MeasuredSurface { x, predicted, triangles, room, level: cloth.level }
}
