//! Narrow phase: particles against collision shapes.
//!
//! ```text
//! solid (half space, sphere,     signed distance; continuous detection if the particle went
//!   capsule, box, hull)          around or through the body
//! triangle surface               first crossing of the path, then closest point
//! heightfield                    samples along the path, half a cell apart
//! ```
//! Continuous detection for solids is conservative advancement (Mirtich, "Impulse-based dynamic
//! simulation of rigid body systems", 1996): step along the path to the plane in front of the body,
//! until the surface is reached or the path ends. Concave places are resolved by projecting onto up
//! to four planes, one after the other.
//!
//! Reads local particles and candidate faces; writes positions and contacts through
//! [`LocalParticles`], and lower bounds of distances.
//! Invariant: a particle that started outside ends outside, whatever its speed.

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::heightfield::Heightfield;
use crate::geometry::polyhedron::CandidateFaces;
use crate::geometry::signed_distance::SignedDistance;
use crate::geometry::triangle_surface::CandidateTriangles;
use crate::math::simd::Level;
use crate::math::{max, min};
use crate::solver::collide::distance_cull::{self, BlockColumns};
use crate::solver::collide::local_particles::{Depenetration, LocalParticles, Penetration};
use crate::solver::collide::mid_phase::Candidates;
use crate::solver::collide::nearby_blocks::BLOCK;
use crate::solver::collide::solid_distances::{MeasuredPoint, SolidDistances};
use glam::Vec3;

/// Largest number of steps of conservative advancement.
const MAX_STEPS: u32 = 24;

/// Normals at the start and at the end whose angle has at least this cosine belong to the same side
/// of a body.
const SAME_SIDE: f32 = 0.7;

/// Pushes the free particles of some blocks out of a shape. Afterwards `clearance` holds a lower
/// bound of the distance of each particle of these blocks from the shape [m]; entries of other
/// particles are unchanged.
pub(super) fn solve_blocks(
    level: Level,
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    blocks: &[u32],
    candidates: &Candidates<'_>,
    clearance: &mut [f32],
) {
    let count = particles.w.len();
    let (bound, largest_gap) = (shape.distance_bound(), particles.largest_gap());
    let mut distances = SolidDistances::default();
    for block in blocks {
        let first = *block as usize * BLOCK;
        let range = first..(first + BLOCK).min(count);
        let may_touch =
            distance_cull::update_clearance(level, particles, bound, range.clone(), clearance);
        if !may_touch {
            continue;
        }
        let block = BlockColumns::of(particles, &range);
        let is_measured = distances.measure(level, shape, block, &particles.frames);
        for i in range.clone() {
            // The comparison is false for NaN, so that NaN is tested.
            if particles.w[i] <= 0.0 || clearance[i] > largest_gap {
                continue;
            }
            if is_measured {
                solve_measured(shape, particles, distances.path(i - range.start), i);
            } else {
                solve_particle(shape, particles, candidates, i);
            }
        }
    }
}

/// Pushes one particle, whose path is measured, out of a solid.
#[inline(always)]
fn solve_measured(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    [start, end]: [MeasuredPoint; 2],
    i: usize,
) {
    let (gap, depenetration) = (particles.gap_of(i), particles.depenetration);
    let continuous = |gap| continuous_contact(shape.solid()?, start, end.at, gap);
    if let Some(penetration) =
        contact_between(start, end.at, || end, gap, depenetration, continuous)
    {
        particles.push_out(i, &[start.at, end.at], &penetration);
    }
}

/// Sets the clearances of the particles of all blocks that `blocks` does not list. The list is in
/// ascending order.
pub(super) fn measure_other_blocks(
    level: Level,
    shape: &CollisionShape,
    particles: &LocalParticles<'_>,
    blocks: &[u32],
    clearance: &mut [f32],
) {
    let (count, bound, mut blocks) = (particles.w.len(), shape.distance_bound(), blocks.iter());
    let mut next = blocks.next();
    for block in 0..count.div_ceil(BLOCK) {
        if next.is_some_and(|listed| *listed as usize == block) {
            next = blocks.next();
            continue;
        }
        let range = block * BLOCK..((block + 1) * BLOCK).min(count);
        distance_cull::update_clearance(level, particles, bound, range, clearance);
    }
}

/// Pushes one particle out of a shape.
#[inline(never)]
pub(super) fn solve_particle(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    candidates: &Candidates<'_>,
    i: usize,
) {
    let [from, end] = particles.path_of(i);
    let gap = particles.gap_of(i);
    let depenetration = particles.depenetration;
    let nearby = |surface| CandidateTriangles { surface, triangles: candidates.faces(i) };
    let penetration = match shape {
        CollisionShape::ConvexHull(body, _) => {
            let solid = CandidateFaces { body, faces: candidates.faces(i) };
            if solid.faces.is_empty() {
                None
            } else {
                solid_contact(&solid, from, end, gap, depenetration)
            }
        }
        CollisionShape::TriangleSurface(surface, _) => {
            surface_contact(&nearby(surface), from, end, max(gap, MIN_SURFACE_GAP))
        }
        CollisionShape::Heightfield(terrain) => terrain_contact(terrain, from, end, gap),
        _ => shape.solid().and_then(|solid| solid_contact(solid, from, end, gap, depenetration)),
    };
    let Some(penetration) = penetration else { return };
    let start = if penetration.carry == Vec3::ZERO { from } else { from + penetration.carry };
    let CollisionShape::TriangleSurface(surface, _) = shape else {
        return particles.push_out(i, &[start, end], &penetration);
    };
    let correction = particles.correction(([i; 3], [1.0, 0.0, 0.0]), [start, end], penetration);
    // Friction moves along a plane and can cross a bent surface.
    let crosses = nearby(surface).first_crossing(from, end + correction).is_some();
    let correction = if crosses { start - end } else { correction };
    particles.apply_local_correction(i, end, penetration, correction);
}

/// Returns the distance of a point from a shape [m]: negative inside a solid, and behind a surface
/// that its way from `start` to `end` crosses. `most` if it is farther away from all `faces` near it.
/// The second value is the outward normal, for convex solids only.
#[inline(never)]
pub(super) fn signed_distance(
    shape: &CollisionShape,
    faces: &[u32],
    [start, end]: [Vec3; 2],
    most: f32,
) -> (f32, Option<Vec3>) {
    let of_solid = |(distance, normal): (f32, Vec3)| (distance, Some(normal));
    match shape {
        CollisionShape::ConvexHull(body, _) => match faces {
            [] => (most, None),
            faces => of_solid(CandidateFaces { body, faces }.signed_distance(end)),
        },
        CollisionShape::TriangleSurface(surface, _) => {
            let nearby = CandidateTriangles { surface, triangles: faces };
            let distance = match nearby.first_crossing(start, end) {
                Some(point) => (end - point.at).dot(point.outward),
                None => nearby.closest(end, start, most).map_or(most, |point| point.distance),
            };
            (distance, None)
        }
        _ => match shape.solid() {
            Some(solid) => of_solid(solid.signed_distance(end)),
            None => (-shape.depth(end), None),
        },
    }
}

/// Smallest gap to surfaces without an inside [m]: for a point on the surface the side is unknown.
const MIN_SURFACE_GAP: f32 = 1.0e-4;

/// Largest number of planes of a concave place that a particle is projected onto, one after the
/// other.
const MAX_PLANES: u32 = 4;

/// The fraction of the gap that counts as clear after a projection; the rest covers rounding.
const CLEAR: f32 = 0.95;

/// Returns the penetration of a particle at a triangle surface: at the first crossing of its path,
/// or else at the closest point. If no projection ends on the right side, the particle goes back to
/// `start`, as the surface carries it along.
fn surface_contact(
    surface: &CandidateTriangles<'_>,
    start: Vec3,
    end: Vec3,
    gap: f32,
) -> Option<Penetration> {
    let (mut at, mut carry) = (end, Vec3::ZERO);
    for number in 0..MAX_PLANES {
        if let Some(point) = surface.first_crossing(start, at) {
            at += point.outward * (gap - (at - point.at).dot(point.outward));
            carry = point.carry;
            continue;
        }
        let max_distance = if number == 0 { gap } else { gap * CLEAR };
        let Some(point) = surface.closest(at, start, max_distance) else {
            return penetration_between(end, at, carry);
        };
        at += point.outward * (gap - point.distance);
        carry = point.carry;
    }
    if let Some(through) = surface.first_crossing(start, at) {
        return penetration_between(end, start + through.carry, through.carry);
    }
    penetration_between(end, at, carry)
}

/// Returns the penetration whose resolution moves a point from `end` to `target`, at a surface that
/// moved by `carry`; `None` if both are the same.
fn penetration_between(end: Vec3, target: Vec3, carry: Vec3) -> Option<Penetration> {
    let out = target - end;
    let depth = out.length();
    let penetration = || Penetration { carry, ..Penetration::new(out * (1.0 / depth), depth) };
    (depth > 0.0).then(penetration)
}

/// Returns the penetration of a particle at a heightfield: below the ground now, or below it
/// anywhere on its path.
fn terrain_contact(terrain: &Heightfield, start: Vec3, end: Vec3, gap: f32) -> Option<Penetration> {
    let path = end - start;
    let horizontal = (path.x * path.x + path.z * path.z).sqrt();
    let count = max(min((horizontal / (0.5 * terrain.spacing())).ceil(), 1000.0), 1.0) as u32;
    let samples = (1..=count).map(|k| start + path * (k as f32 / count as f32));
    let distances = samples.map(|at| Some((at, terrain.signed_distance(at)?)));
    let (hit, (distance, outward)) =
        distances.flatten().find(|(_, (distance, _))| *distance < gap)?;
    let depth = gap - distance - (end - hit).dot(outward);
    if depth <= 0.0 {
        return None;
    }
    let mut at = end + outward * depth;
    for _ in 1..MAX_PLANES {
        match terrain.signed_distance(at) {
            Some((distance, outward)) if distance < gap * CLEAR => {
                at += outward * (gap - distance);
            }
            _ => break,
        }
    }
    penetration_between(end, at, Vec3::ZERO)
}

/// Returns the penetration of a particle that moved from `start` to `end` at a convex body. One
/// that started inside comes out step by step.
fn solid_contact(
    solid: &dyn SignedDistance,
    start: Vec3,
    end: Vec3,
    gap: f32,
    depenetration: Depenetration,
) -> Option<Penetration> {
    let start = MeasuredPoint::new(solid, start);
    let measured_end = || MeasuredPoint::new(solid, end);
    let continuous = |gap| continuous_contact(solid, start, end, gap);
    contact_between(start, end, measured_end, gap, depenetration, continuous)
}

/// As [`solid_contact`], where the start is measured, `measured_end` measures the end, and
/// `continuous` gives the penetration of a particle that went around the body or through it, for a
/// gap.
#[inline(always)]
fn contact_between(
    start: MeasuredPoint,
    end: Vec3,
    measured_end: impl FnOnce() -> MeasuredPoint,
    gap: f32,
    depenetration: Depenetration,
    continuous: impl FnOnce(f32) -> Option<Penetration>,
) -> Option<Penetration> {
    let (start_distance, outward) = (start.distance, start.normal);
    // The plane in front of the body separates them at the end.
    let separated = min(gap, start_distance + depenetration.max_step);
    if start_distance + (end - start.at).dot(outward) >= separated {
        return None;
    }
    let MeasuredPoint { distance: end_distance, normal, .. } = measured_end();
    if normal.dot(outward) >= SAME_SIDE {
        return depenetration.penetration(normal, gap, start_distance, end_distance);
    }
    if start_distance < -depenetration.deep {
        if depenetration.holds_deep {
            return None;
        }
        let depth = depenetration.max_step;
        return Some(Penetration { is_frictionless: true, ..Penetration::new(outward, depth) });
    }
    continuous(separated)
}

/// Returns the penetration of a particle that went around a body or through it, with the normal
/// where its path first meets the body.
#[inline(never)]
fn continuous_contact(
    solid: &dyn SignedDistance,
    start: MeasuredPoint,
    end: Vec3,
    gap: f32,
) -> Option<Penetration> {
    let (at, normal) = first_hit(solid, start.at, end - start.at, start.distance, gap)?;
    let (distance, _) = solid.signed_distance(at);
    let depth = gap - distance - (end - at).dot(normal);
    (depth > 0.0).then_some(Penetration::new(normal, depth))
}

/// Returns the point where a path meets a body, and the normal there, by conservative advancement:
/// all of a convex body lies behind the plane in front of it, so the path is free up to that plane.
/// A path that starts at the surface may slide along it.
fn first_hit(
    solid: &dyn SignedDistance,
    start: Vec3,
    path: Vec3,
    start_distance: f32,
    gap: f32,
) -> Option<(Vec3, Vec3)> {
    let surface = max(min(start_distance, gap), 0.0) * 0.5;
    let tolerance = surface * 0.1 + path.length() * 1.0e-4;
    let mut fraction = 0.0;
    for _ in 0..MAX_STEPS {
        let at = start + path * fraction;
        let (distance, normal) = solid.signed_distance(at);
        if distance <= surface + tolerance {
            return Some((at, normal));
        }
        let approach = -path.dot(normal);
        fraction += (distance - surface) / approach;
        if approach <= 0.0 || fraction >= 1.0 {
            return None;
        }
    }
    let (distance, normal) = solid.signed_distance(start + path);
    (distance < gap).then_some((start + path, normal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::primitives::{Cuboid, HalfSpace, Sphere};

    const GAP: f32 = 1.0e-3;

    /// Returns where a particle ends that moves from `before` to `now`.
    fn end(solid: &impl SignedDistance, before: Vec3, now: Vec3) -> Vec3 {
        solid_contact(
            solid,
            before,
            now,
            GAP,
            Depenetration { max_step: 9.0, deep: 9.0, holds_deep: false },
        )
        .map_or(now, |one| now + one.normal * one.depth)
    }

    #[test]
    fn a_particle_that_passes_a_thin_plate_ends_on_the_side_where_it_started() {
        for half in [0.00005, 0.0025, 0.1] {
            let plate = Cuboid { half_extents: Vec3::new(1.0, half, 1.0) };
            for fall in [0.01, 0.1, 1.0, 10.0] {
                let from = Vec3::new(0.2, half + 0.5 * fall, 0.1);
                let end = end(&plate, from, from + Vec3::new(0.03, -fall, 0.0));
                assert!((end.y - half - GAP).abs() < 3.0e-4 + fall * 1.0e-3, "{fall} m: {end}");
            }
        }
    }

    #[test]
    fn a_particle_that_passes_a_sphere_ends_on_the_side_where_it_started() {
        let ball = Sphere { radius: 0.05 };
        let end = end(&ball, Vec3::Y * 0.5, Vec3::new(0.01, -0.5, 0.0));
        assert!(ball.signed_distance(end).0 > 0.9 * GAP && end.y > 0.0, "{end}");
    }

    #[test]
    fn a_grazing_path_does_not_pass_a_plate() {
        let plate = Cuboid { half_extents: Vec3::new(9.0, 0.001, 9.0) };
        for slope in [0.01, 0.03, 0.1] {
            let before = Vec3::Y * (0.001 + GAP);
            let end = end(&plate, before, before + Vec3::new(1.0, -slope, 0.3));
            assert!(end.y > 0.001, "at a slope of {slope} to {end}");
        }
    }

    #[test]
    fn a_path_beside_a_body_is_unchanged() {
        let ball = Sphere { radius: 0.05 };
        let now = Vec3::new(0.06, -0.5, 0.0);
        assert_eq!(end(&ball, Vec3::new(0.06, 0.5, 0.0), now), now);
        let plate = Cuboid { half_extents: Vec3::new(1.0, 0.01, 1.0) };
        let now = Vec3::new(1.03, -0.02, 0.0);
        assert_eq!(end(&plate, Vec3::new(1.01, 0.02, 0.0), now), now);
    }

    #[test]
    fn a_particle_that_slides_over_an_edge_falls() {
        let plate = Cuboid { half_extents: Vec3::new(1.0, 0.01, 1.0) };
        let now = Vec3::new(1.0 + GAP, 0.009, 0.0);
        let before = Vec3::new(1.0 - GAP, 0.01 + GAP, 0.0);
        let end = end(&plate, before, now);
        assert!((end - now).length() < 2.1 * GAP, "{now} to {end}");
    }

    #[test]
    fn a_particle_that_falls_on_terrain_or_flies_into_a_hill_stays_above() {
        let heights = (0..25).map(|i| if i % 5 == 2 { 1.0 } else { 0.0 }).collect();
        let ground = Heightfield::new(5, 5, 0.5, heights);
        let end = |before: Vec3, now: Vec3| {
            let contact = terrain_contact(&ground, before, now, GAP);
            contact.map_or(now, |one| now + one.normal * one.depth)
        };
        let valley = Vec3::new(0.1, 0.5, 1.1);
        for fall in [0.01, 0.1, 1.0, 3.0] {
            let end = end(valley, valley - Vec3::Y * fall);
            let height = ground.signed_distance(end).map_or(9.0, |(height, _)| height);
            assert!(height > 0.9 * GAP, "fell {fall} m to {end}");
        }
        let through = end(valley, Vec3::new(1.9, 0.5, 1.1));
        assert!(through.x < 1.0, "flew through a hill to {through}");
        assert_eq!(end(valley, valley + Vec3::X * 0.2), valley + Vec3::X * 0.2);
    }

    #[test]
    fn a_particle_that_starts_inside_comes_out_step_by_step() {
        let ball = Sphere { radius: 0.5 };
        let inside = Vec3::new(0.1, 0.2, 0.0);
        assert!((ball.signed_distance(end(&ball, inside, inside)).0 - GAP).abs() < 1.0e-6);
        let end = end(&HalfSpace, Vec3::Y * -3.0, Vec3::Y * -3.0);
        assert!((end - Vec3::Y * GAP).length() < 1.0e-6, "{end}");
        let depth = |deep| {
            let depenetration = Depenetration { max_step: 0.25, deep, holds_deep: false };
            let (start, end) = (Vec3::Y * -3.0, Vec3::Y * -3.5);
            solid_contact(&HalfSpace, start, end, GAP, depenetration).unwrap().depth
        };
        assert_eq!((depth(9.0), depth(1.0)), (0.75, 0.25));
    }
}
