//! Self-collision: by particles (balls that keep apart) or by the surface (triangles that do not
//! cross).
//!
//! ```text
//! settings.self_collision
//!     None          nothing runs
//!     Particles     particle_pairs (pair list) ─▶ particle_contacts (one pass per substep)
//!     Surface       surface (its module has a diagram)
//! ```
//! Particle collision is cheap and approximate: triangles may still cross. Surface collision
//! guarantees that they do not.
//!
//! Reads and writes `World`; each method owns one box of data in it, which exists while the method
//! is chosen.
//!
//! Invariant: at most one of both boxes exists.

mod connected_pieces;
pub(crate) mod contact_forces;
pub(crate) mod particle_contacts;
pub(crate) mod particle_pairs;
#[cfg_attr(not(feature = "self-collision"), path = "no_surface.rs")]
pub(crate) mod surface;

/// Largest gap between layers [mean rest lengths].
pub(crate) const MAX_GAP: f32 = 0.5;
