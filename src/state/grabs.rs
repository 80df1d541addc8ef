//! Grabs: particles that pointers hold, each following its own target.

use crate::arena::Arena;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A handle to one grab of one cloth; stale once released.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Grab(pub(crate) u32);

impl Grab {
    /// The handle as a number, for a face that speaks in numbers. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The handle that [`Grab::to_bits`] gave. A made-up number is refused where it is used.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// One held particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct GrabbedParticle {
    pub particle: u32,
    /// Where the pointer is [m]; the particle follows as fast as it may.
    pub target: Vec3,
}

/// How many pointers may hold a cloth at once.
pub(crate) const MAX_GRABS: u16 = 64;

/// All grabs of a cloth.
pub(crate) type Grabs = Arena<GrabbedParticle>;
