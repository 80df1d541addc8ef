//! Grabs: particles held by pointers, each with a target of its own.

use crate::arena::Arena;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A handle to a grab of one cloth. It becomes stale when the grab is released.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Grab(pub(crate) u32);

impl Grab {
    /// Converts the handle to a number, for language bindings. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// Converts a number from [`Grab::to_bits`] back. Functions that use an unknown handle return
    /// an error.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// One grabbed particle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct GrabbedParticle {
    pub particle: u32,
    /// Position of the pointer [m]; the particle moves towards it with limited speed.
    pub target: Vec3,
    /// Target at the end of an `advance` [m], while its ticks run; see
    /// `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_target: Vec3,
}

/// Maximum number of grabs of a cloth.
pub(crate) const MAX_GRABS: u16 = 64;

/// All grabs of a cloth.
pub(crate) type Grabs = Arena<GrabbedParticle>;
