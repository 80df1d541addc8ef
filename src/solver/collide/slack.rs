//! Slacks of candidate pairs of cloth and features: how far the corners of the cloth must be pushed
//! before the pair can touch. Few pairs touch, so most need no test.
//!
//! ```text
//! they touch only if    distance now < gap,  or  distance now < way in the substep: one passed the other
//! pushes of length s    change the distance by s at most, and the way by s at most
//! slack                 min(distance − gap, (distance − way) / 2)
//! ```
//! Cloth inside a solid may be pushed out from farther away, so it has no slack. Cloth that is more than
//! [`CLOSE_GAPS`] above a feature, along the normal of both, has an infinite slack, even if it passed the
//! feature: it is assumed to have gone around it.
//!
//! Reads local particles, pushed corners and candidate pairs; writes slacks.
//! Invariant: a pair with a finite slack has no contact until a corner is pushed as far as that.

use crate::geometry::closest_points::{interpolate, segment_to_segment, triangle_to_origin};
use crate::geometry::features::FeatureSides;
use crate::geometry::relative_motion::RigidStep;
use crate::math::{max, min};
use crate::solver::collide::edge_vs_feature::{FeatureQuery, start_position};
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::pushed_corners::PushedCorners;
use crate::solver::collide::triangle_vs_round::BESIDE;
use glam::Vec3;

/// Cloth rests at the gap. So that rounding does not decide whether it touches, pairs up to this part of
/// the gap beyond it have no slack.
const ROUNDING: f32 = 0.1;

/// Pairs that are farther apart than this many gaps along their common normal are not tested until slacks
/// are computed again.
pub(super) const CLOSE_GAPS: f32 = 4.0;

/// Sets the slack of each pair of a query [m]: edge pairs first, then vertex pairs.
pub(super) fn set_slacks(
    query: &FeatureQuery<'_>,
    particles: &LocalParticles<'_>,
    corners: &PushedCorners<'_>,
    slacks: &mut Vec<f32>,
) {
    let FeatureQuery { features, edges, vertices, .. } = *query;
    let search = Search { gap: query.gap * query.largest_scale, particles, corners };
    slacks.clear();
    slacks.extend(edges.iter().map(|pair| {
        let edge = &features.edges[pair.edge as usize];
        let ends = pair.particles.map(|i| search.position(i) - edge.ends[0]);
        let along = edge.ends[1] - edge.ends[0];
        let normal = along.cross(ends[1] - ends[0]);
        if !edge.sides.is_boundary() && search.is_far(normal, ends[0], edge.outward) {
            return f32::INFINITY;
        }
        let (s, t) = segment_to_segment([Vec3::ZERO, along], ends);
        let between = ends[0] + (ends[1] - ends[0]) * t - along * s;
        let is_inside = || !edge.is_outside(edge.ends[0] + between);
        let distance =
            if edge.sides == FeatureSides::Solid && is_inside() { 0.0 } else { between.length() };
        let step = features.edge_step(pair.edge);
        search.slack(distance, (&pair.particles, &ends), (step, along))
    }));
    slacks.extend(vertices.iter().map(|pair| {
        let vertex = &features.vertices[pair.vertex as usize];
        let [a, b, c] = pair.particles.map(|i| search.position(i) - vertex.position);
        let normal = (b - a).cross(c - a);
        if !vertex.sides.is_boundary() && search.is_far(normal, a, vertex.outward) {
            return f32::INFINITY;
        }
        let between = interpolate([a, b, c], triangle_to_origin([a, b, c]));
        let is_inside = || !features.is_outside_vertex(vertex, vertex.position + between);
        let distance = if vertex.sides == FeatureSides::Solid && is_inside() {
            0.0
        } else {
            // A vertex that passes a little beside the triangle counts as passing through it.
            between.length() - BESIDE * normal.length().sqrt()
        };
        let step = features.vertex_step(pair.vertex);
        search.slack(distance, (&pair.particles, &[a, b, c]), (step, Vec3::ZERO))
    }));
}

/// What the pairs of a query share.
struct Search<'a> {
    /// The distance to keep [m].
    gap: f32,
    particles: &'a LocalParticles<'a>,
    corners: &'a PushedCorners<'a>,
}

impl Search<'_> {
    fn position(&self, i: u32) -> Vec3 {
        self.corners.position(i)
    }

    /// Returns whether cloth is far above a feature along their common normal, which need not have unit
    /// length, given a point of the cloth relative to the feature. The outward side of a boundary depends
    /// on where the cloth is, so it has no height.
    #[inline(always)]
    fn is_far(&self, normal: Vec3, at: Vec3, outward: Vec3) -> bool {
        let far = self.gap * CLOSE_GAPS;
        // Both have the length of the normal as a factor; NaN counts as close.
        let height = normal.dot(at) * 1.0_f32.copysign(normal.dot(outward));
        height > 0.0 && height * height > far * far * normal.length_squared()
    }

    /// Returns the slack of a pair [m]. Corners of the cloth are relative to one end of the feature, and
    /// `along` leads to its other end [m]. `step` is the motion of the feature.
    #[inline(always)]
    fn slack(
        &self,
        distance: f32,
        (particles, corners): (&[u32], &[Vec3]),
        (step, along): (Option<&RigidStep>, Vec3),
    ) -> f32 {
        match step {
            None => self.slack_after(distance, self.corners.longest_way(particles)),
            Some(step) => self.slack_in_motion(distance, (particles, corners), (step, along)),
        }
    }

    /// Returns the slack of a pair [m]. `way` is the longest way of a corner in the substep, relative to
    /// the feature [m].
    #[inline(always)]
    fn slack_after(&self, distance: f32, way: f32) -> f32 {
        min(distance - self.gap * (1.0 + ROUNDING), (distance - way) * 0.5)
    }

    /// Returns the slack of a pair whose feature moves [m]; see [`Search::slack`].
    #[inline(never)]
    fn slack_in_motion(
        &self,
        distance: f32,
        (particles, corners): (&[u32], &[Vec3]),
        (step, along): (&RigidStep, Vec3),
    ) -> f32 {
        let own = self.corners.longest_way(particles);
        let farthest = || corners.iter().map(|x| x.length()).fold(0.0, max);
        let carried = step.longest_way(|| farthest() + along.length() + own);
        let bound = self.slack_after(distance, own + carried);
        if bound > 0.0 || distance <= self.gap * (1.0 + ROUNDING) {
            return bound;
        }
        // The bound is not enough where cloth and feature move along with each other.
        let way = |i: &u32| {
            let start = start_position(self.particles, *i as usize, Some(step));
            self.position(*i).distance(start)
        };
        self.slack_after(distance, particles.iter().map(way).fold(0.0, max))
    }
}
