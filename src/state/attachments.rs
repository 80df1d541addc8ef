//! Attachments: moving transforms that carry pins, as a bone or a pole carries the cloth that is sewn to it.

use crate::arena::Arena;
use crate::state::pose::Pose;
use serde::{Deserialize, Serialize};

/// A handle to one attachment of one cloth; stale once detached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Attachment(pub(crate) u32);

impl Attachment {
    /// The handle as a number, for a face that speaks in numbers. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// The handle that [`Attachment::to_bits`] gave. A made-up number is refused where it is used.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// A transform on its way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct AttachmentPose {
    /// Where it was at the end of the last tick.
    pub last: Pose,
    /// Where it is at the end of the next tick.
    pub next: Pose,
}

/// How many attachments a cloth may have.
pub(crate) const MAX_ATTACHMENTS: u16 = 64;

/// All attachments of a cloth.
pub(crate) type Attachments = Arena<AttachmentPose>;
