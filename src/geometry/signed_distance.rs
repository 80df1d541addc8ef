//! Signed distance queries, which every solid collision shape answers.
//!
//! ```text
//! d(p) > 0 outside, d(p) < 0 inside;  n(p) = ∇d(p),  |n| = 1;  p − d n lies on the surface
//! ```
//! Reads the shape and a point in the local frame of the shape, and writes nothing. Invariant: d
//! changes by at most the distance that the point moves, so a point that moves by less than d(p)
//! cannot reach the surface.

use glam::Vec3;

/// A convex solid that knows how far a point is from its surface.
pub(crate) trait SignedDistance {
    /// Returns the signed distance of `p` from the surface [m], negative inside, and the outward
    /// normal there, of length one.
    fn signed_distance(&self, p: Vec3) -> (f32, Vec3);
}
