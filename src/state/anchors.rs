//! Anchors: bounds on the distance between a particle and its animated position.
//!
//! ```text
//!        normal
//!          ▲   max_distance: the particle stays inside the sphere about its anchor
//!          ● anchor
//!          ┊   backstop_distance
//!       ╭──┴──╮
//!       │     │  backstop: the particle stays outside the sphere behind its anchor
//!       ╰─────╯  backstop_radius
//! ```
//! Both bounds are enforced by projection. If they conflict, `max_distance` wins: the particle goes
//! to the circle where both spheres meet, on its own side.
//!
//! Invariant: the list is sorted by particle, so that the order of processing comes from the mesh.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The anchor of one particle. Field order is part of the save format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct AnchorConstraint {
    pub particle: u32,
    /// Anchor at the end of the last tick [m].
    pub from: Vec3,
    /// Anchor at the end of the next tick [m].
    pub anchor: Vec3,
    /// Outward normal of the animated body at the end of the last tick; zero = not set, which
    /// disables the backstop.
    pub normal_from: Vec3,
    /// Outward normal at the end of the next tick.
    pub normal: Vec3,
    /// Maximum distance from the anchor [m]; infinity = unbounded.
    pub max_distance: f32,
    /// Distance from the anchor back to the surface of the backstop sphere [m].
    pub backstop_distance: f32,
    /// Radius of the backstop sphere [m]; 0 = none.
    pub backstop_radius: f32,
    /// Anchor [m] and normal at the end of an `advance`, while its ticks run; see
    /// `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_anchor: [Vec3; 2],
}

impl AnchorConstraint {
    /// An anchor without bounds.
    pub fn new(particle: u32, anchor: Vec3) -> Self {
        Self {
            particle,
            from: anchor,
            anchor,
            normal_from: Vec3::ZERO,
            normal: Vec3::ZERO,
            max_distance: f32::INFINITY,
            backstop_distance: 0.0,
            backstop_radius: 0.0,
            final_anchor: [anchor, Vec3::ZERO],
        }
    }

    /// Interpolates two anchors at `share` of the way from `a` to `b`, for a particle that a cut
    /// inserted.
    pub fn between(particle: u32, a: &Self, b: &Self, share: f32) -> Self {
        let point = |a: Vec3, b: Vec3| a + (b - a) * share;
        // Equal values stay exact, and infinity is never subtracted from infinity.
        let number = |a: f32, b: f32| if a == b { a } else { a * (1.0 - share) + b * share };
        Self {
            particle,
            from: point(a.from, b.from),
            anchor: point(a.anchor, b.anchor),
            normal_from: unit_or_zero(point(a.normal_from, b.normal_from)),
            normal: unit_or_zero(point(a.normal, b.normal)),
            max_distance: number(a.max_distance, b.max_distance),
            backstop_distance: number(a.backstop_distance, b.backstop_distance),
            backstop_radius: number(a.backstop_radius, b.backstop_radius),
            final_anchor: [Vec3::ZERO; 2],
        }
    }

    /// Returns whether the anchor or its normal moves during the next tick.
    pub fn is_moving(&self) -> bool {
        self.from != self.anchor || self.normal_from != self.normal
    }

    /// Returns whether all numbers are in their ranges; for saved data.
    pub fn is_valid(&self) -> bool {
        let vectors = [self.from, self.anchor, self.normal_from, self.normal];
        let is_length = |v: f32| v.is_finite() && v >= 0.0;
        vectors.iter().all(|v| v.is_finite())
            && self.max_distance >= 0.0
            && is_length(self.backstop_distance)
            && is_length(self.backstop_radius)
    }

    /// Returns the nearest permitted position to `x` at `share` (0 to 1) of the tick; `x` itself if
    /// it is permitted.
    pub fn project(&self, x: Vec3, share: f32) -> Vec3 {
        let anchor =
            if share < 1.0 { self.from + (self.anchor - self.from) * share } else { self.anchor };
        let clamped = clamp_to_sphere(x, anchor, self.max_distance);
        if self.backstop_radius == 0.0 {
            return clamped;
        }
        let normal = if share < 1.0 {
            unit_or_zero(self.normal_from + (self.normal - self.normal_from) * share)
        } else {
            self.normal
        };
        if normal == Vec3::ZERO {
            return clamped;
        }
        let center = anchor - normal * (self.backstop_distance + self.backstop_radius);
        let r = clamped - center;
        if r.length_squared() >= self.backstop_radius * self.backstop_radius {
            return clamped;
        }
        self.project_out_of_backstop(x, center, normal, anchor)
    }

    /// Moves `x` out of the backstop without exceeding `max_distance`: onto the circle where both
    /// spheres meet if necessary.
    fn project_out_of_backstop(&self, x: Vec3, center: Vec3, normal: Vec3, anchor: Vec3) -> Vec3 {
        let (radius, max_distance) = (self.backstop_radius, self.max_distance);
        let r = x - center;
        let out =
            if r.length_squared() > 0.0 { r * (radius / r.length()) } else { normal * radius };
        if (center + out - anchor).length_squared() <= max_distance * max_distance {
            return center + out;
        }
        let center_distance = self.backstop_distance + radius;
        // The circle: its offset along the normal from the backstop's centre, and its radius
        // squared.
        let along = (center_distance * center_distance + radius * radius
            - max_distance * max_distance)
            / (2.0 * center_distance);
        let off = radius * radius - along * along;
        let side = r - normal * r.dot(normal);
        let side = if side.length_squared() > 0.0 {
            unit_or_zero(side)
        } else {
            any_perpendicular(normal)
        };
        center + normal * along + side * if off > 0.0 { off.sqrt() } else { 0.0 }
    }
}

/// `x`, or the nearest point that is at most `max_distance` from `point`.
fn clamp_to_sphere(x: Vec3, point: Vec3, max_distance: f32) -> Vec3 {
    let r = x - point;
    let length2 = r.length_squared();
    if length2 > max_distance * max_distance {
        point + r * (max_distance / length2.sqrt())
    } else {
        x
    }
}

/// Normalises a vector; zero stays zero.
pub(crate) fn unit_or_zero(v: Vec3) -> Vec3 {
    let length2 = v.length_squared();
    if length2 > 0.0 { v * (1.0 / length2.sqrt()) } else { Vec3::ZERO }
}

/// Some unit vector perpendicular to `normal`.
fn any_perpendicular(normal: Vec3) -> Vec3 {
    let axis = if normal.x * normal.x < 0.5 { Vec3::X } else { Vec3::Y };
    unit_or_zero(normal.cross(axis))
}

/// All anchors, sorted by particle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct AnchorConstraints {
    list: Vec<AnchorConstraint>,
}

heap_bytes!(AnchorConstraints { list } plain {});

impl AnchorConstraints {
    /// Allocates for `capacity` anchors in all, if there are any.
    pub fn reserve(&mut self, capacity: usize) {
        if !self.list.is_empty() {
            self.list.reserve_total(capacity);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &AnchorConstraint> {
        self.list.iter()
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut AnchorConstraint> {
        self.list.iter_mut()
    }

    fn search(&self, particle: u32) -> Result<usize, usize> {
        self.list.binary_search_by_key(&particle, |constraint| constraint.particle)
    }

    pub fn get(&self, particle: u32) -> Option<&AnchorConstraint> {
        Some(&self.list[self.search(particle).ok()?])
    }

    /// Returns the anchor of a particle, and creates one at `x` without bounds if there is none.
    pub fn get_or_insert(&mut self, particle: u32, x: Vec3) -> &mut AnchorConstraint {
        let at = match self.search(particle) {
            Ok(at) => at,
            Err(at) => {
                self.list.insert(at, AnchorConstraint::new(particle, x));
                at
            }
        };
        &mut self.list[at]
    }

    /// Adds an anchor, unless its particle has one.
    pub fn insert(&mut self, constraint: AnchorConstraint) {
        if let Err(at) = self.search(constraint.particle) {
            self.list.insert(at, constraint);
        }
    }

    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// Returns whether the anchors fit a cloth of `count` particles; for saved data.
    pub fn are_valid(&self, count: usize) -> bool {
        let is_valid = |constraint: &AnchorConstraint| {
            (constraint.particle as usize) < count && constraint.is_valid()
        };
        self.list.iter().all(is_valid) && self.list.is_sorted_by(|a, b| a.particle < b.particle)
    }

    /// Completes the motion of a tick: every anchor has arrived.
    pub fn finish_tick(&mut self) {
        for constraint in &mut self.list {
            (constraint.from, constraint.normal_from) = (constraint.anchor, constraint.normal);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constraint(
        max_distance: f32,
        backstop_distance: f32,
        backstop_radius: f32,
    ) -> AnchorConstraint {
        let (normal, anchor) = (Vec3::Y, Vec3::new(0.5, 1.0, -2.0));
        let free = AnchorConstraint::new(0, anchor);
        AnchorConstraint {
            normal,
            normal_from: normal,
            max_distance,
            backstop_distance,
            backstop_radius,
            ..free
        }
    }

    #[test]
    fn projected_particles_satisfy_both_bounds_and_permitted_ones_do_not_move() {
        for max_distance in [0.0, 0.02, 0.3, 1.1, 2.5, f32::INFINITY] {
            for (distance, radius) in [(0.0, 0.0), (0.0, 0.1), (0.0, 1.0), (0.05, 0.5), (0.3, 2.0)]
            {
                let constraint = constraint(max_distance, distance, radius);
                let center = constraint.anchor - Vec3::Y * (distance + radius);
                for i in 0..1000 {
                    let number = |k: i32| ((i * k % 101) - 50) as f32 / 25.0;
                    let x = constraint.anchor + Vec3::new(number(7), number(13), number(29));
                    let projected = constraint.project(x, 1.0);
                    let [to_anchor, to_center] =
                        [projected.distance(constraint.anchor), projected.distance(center)];
                    assert!(
                        to_anchor <= max_distance + 1e-5,
                        "{to_anchor} from the anchor, at most {max_distance} allowed"
                    );
                    assert!(
                        to_center >= radius - 1e-5,
                        "{to_center} from the backstop's centre, at least {radius} required"
                    );
                    let is_permitted = x.distance(constraint.anchor) <= max_distance
                        && x.distance(center) >= radius;
                    assert!(!is_permitted || projected == x, "{x} is moved to {projected}");
                }
            }
        }
    }

    #[test]
    fn particles_on_the_axis_of_the_backstop_leave_it_too() {
        let constraint = constraint(0.2, 0.0, 0.5);
        let center = constraint.anchor - Vec3::Y * 0.5;
        for x in [center, center - Vec3::Y * 0.1, center - Vec3::Y * 3.0, center + Vec3::Y * 0.1] {
            let projected = constraint.project(x, 1.0);
            assert!(
                projected.distance(center) >= 0.5 - 1e-6
                    && projected.distance(constraint.anchor) <= 0.2 + 1e-6
            );
        }
    }
}
