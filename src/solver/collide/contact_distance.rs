//! The distances that cloth keeps from colliders: the gap, and the margin that smooth shapes get on
//! top.
//!
//! ```text
//!        _____________        surface of radius R
//!     ╱        ↕        ╲     A chord of length L between two particles on the surface lies inside
//!   ●────────  L  ────────●   by up to the sagitta L² / (8 R).  (L: diagonal of a cell)
//! ```
//! If particles stay that much farther out, the triangles between them stay outside too: then the
//! contacts of particles are enough, and the cloth comes to rest. Where the sagitta would be too
//! large, triangles and edges are tested themselves.
//!
//! Reads shapes, descriptors and mean lengths; writes nothing.
//! Invariant: the margin depends only on the shape and on lengths at rest, so it is constant over
//! time.

use crate::geometry::bends::SurfaceBend;
use crate::geometry::collision_shape::CollisionShape;
use crate::state::colliders::ColliderBody;

/// The fraction of the gap that edges and triangles keep. On a smooth shape a triangle sinks in by
/// less than the remaining fraction, so only its corners are in contact and the cloth comes to
/// rest.
pub(super) const TRIANGLE_GAP: f32 = 0.5;

/// A factor for cells that are stretched.
const STRETCH_ALLOWANCE: f32 = 1.25;

/// The diagonal of a cell, stretched, in mean edge lengths.
const DIAGONAL: f32 = 1.5;

/// The diagonal of a cell at rest, in mean edge lengths, and a little more.
const LONGEST_EDGE: f32 = 1.25;

/// The largest margin at shapes with flat faces, in mean edge lengths.
const MAX_MARGIN: f32 = 0.1;

/// Round shapes with a smaller radius than this, in mean edge lengths, are tested against
/// triangles.
const MIN_RADIUS: f32 = 1.5;

/// Returns the gap between a collider and the cloth [m]: its own thickness, or else that of the
/// material.
pub(super) fn contact_gap(body: &ColliderBody, thickness: f32) -> f32 {
    if body.desc.thickness < 0.0 { thickness } else { body.desc.thickness }
}

/// Returns the largest bend at which features count as smooth and are not tested, and the margin
/// [m] that particles keep on top of the gap in return. `spacing` is the mean edge length [m].
pub(super) fn smoothing(shape: &CollisionShape, spacing: f32) -> (SurfaceBend, f32) {
    let sagitta = |radius: f32| {
        if radius >= MIN_RADIUS * spacing {
            spacing * spacing * (0.25 * STRETCH_ALLOWANCE) / radius
        } else {
            0.0
        }
    };
    let margin = match shape {
        CollisionShape::Sphere(sphere) => sagitta(sphere.radius),
        CollisionShape::Capsule(capsule) => sagitta(capsule.min_radius()),
        _ => {
            let diagonal = spacing * DIAGONAL;
            let smooth =
                shape.bends().map(|bends| bends.largest_within(diagonal, spacing * MAX_MARGIN));
            let smooth = smooth.unwrap_or_default();
            return (smooth, smooth.sagitta(diagonal));
        }
    };
    (SurfaceBend::default(), margin)
}

/// Returns the longest edge of a triangle that stays outside a shape if its corners keep the
/// contact distance [m]: `gap` [m] and `margin` [m]. Features that bend no more than `smooth` count
/// as smooth. Infinity for planes, and for shapes without smooth features, such as boxes: their edges and
/// corners are tested themselves.
///
/// The sagitta of that edge uses up the margin and what triangles may leave of the gap.
pub(super) fn longest_free_edge(
    shape: &CollisionShape,
    smooth: SurfaceBend,
    gap: f32,
    margin: f32,
) -> f32 {
    let allowed = gap * TRIANGLE_GAP + margin;
    match shape {
        CollisionShape::HalfSpace(_) => f32::INFINITY,
        CollisionShape::Sphere(sphere) => (8.0 * sphere.radius * allowed).sqrt(),
        CollisionShape::Capsule(capsule) => (8.0 * capsule.min_radius() * allowed).sqrt(),
        _ => smooth.longest_chord(allowed),
    }
}

/// Returns whether most triangles can touch a round shape where no particle does, even if the cloth
/// is not stretched. `spacing` is the mean edge length [m].
pub(super) fn needs_triangle_tests(
    shape: &CollisionShape,
    longest_free_edge: f32,
    spacing: f32,
) -> bool {
    shape.bends().is_none() && longest_free_edge < spacing * LONGEST_EDGE
}
