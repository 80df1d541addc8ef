//! Attachments: moving poses that carry pins, such as a bone or a flagpole.

use crate::arena::Arena;
use crate::state::pose::Pose;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A handle to an attachment of one cloth. It becomes stale when the attachment is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Attachment(pub(crate) u32);

impl Attachment {
    /// Converts the handle to a number, for language bindings. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// Converts a number from [`Attachment::to_bits`] back. Functions that use an unknown handle
    /// return an error.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// The motion of an attachment over the next tick: poses of its `center`, as for colliders. The
/// default is at rest at the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct AttachmentPose {
    /// Pose at the end of the last tick.
    pub last: Pose,
    /// Pose at the end of the next tick.
    pub next: Pose,
    /// A point near the cloth in the frame of the attachment [m].
    pub center: Vec3,
    /// Pose at the end of an `advance`, while its ticks run; see `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_pose: Pose,
    /// Share of the initial offset of a pin from its place on the attachment that is left at the
    /// end of the next tick; 0 except between the ticks of an `advance`.
    #[serde(skip)]
    pub offset_left: f32,
}

/// Maximum number of attachments of a cloth.
pub(crate) const MAX_ATTACHMENTS: u16 = 64;

/// All attachments of a cloth.
pub(crate) type Attachments = Arena<AttachmentPose>;
