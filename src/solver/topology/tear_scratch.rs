//! Scratch buffers of stage `Tear`.
//!
//! Data only, allocated before the first tick. `tear` fills them anew in each call; nothing in them
//! is state.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::mesh::Fan;

/// Buffers of `tear`, kept so that no tick allocates.
#[derive(Clone, Debug, Default)]
pub(crate) struct TearScratch {
    /// Most overstretched links, in order of descending excess.
    pub candidates: Vec<TearCandidate>,
    /// Fan of the vertex that splits.
    pub fan: Fan,
    /// Fans at the far ends of the two edges that the split opens.
    pub far_fans: [Fan; 2],
    /// Buffer for one part of a fan that was divided.
    pub part: Fan,
    /// Fan from which the mass of a vertex is computed.
    pub mass_fan: Fan,
    /// For each triangle of `fan`, whether it goes to the new vertex.
    pub goes_to_new: Vec<bool>,
    /// Vertices that tears of this tick changed.
    pub touched: Vec<u32>,
}

heap_bytes!(
    TearScratch {
        candidates, fan, far_fans, part, mass_fan, goes_to_new, touched,
    } plain {}
);

/// A link whose stretch exceeds its tear limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TearCandidate {
    /// Stretch divided by the stretch at which this link tears; above 1.
    pub excess: f32,
    pub a: u32,
    pub b: u32,
}

impl TearScratch {
    /// Allocates buffers for `max_tears` tears per tick.
    pub fn with_capacity(max_tears: usize) -> Self {
        // A fan has one entry per triangle of its vertex. 64 exceeds any practical mesh; a larger
        // fan costs one allocation, once.
        let fan = || Fan {
            corners: Vec::with_capacity(64),
            ring: Vec::with_capacity(65),
            is_closed: false,
        };
        Self {
            candidates: Vec::with_capacity(max_tears + 1),
            fan: fan(),
            far_fans: [fan(), fan()],
            part: fan(),
            mass_fan: fan(),
            goes_to_new: Vec::with_capacity(64),
            touched: Vec::with_capacity(8 * max_tears.min(1024)),
        }
    }

    /// Reserves capacity for `max_tears` tears per tick.
    pub fn reserve(&mut self, max_tears: usize) {
        let candidates = &mut self.candidates;
        candidates.reserve_total(max_tears + 1);
    }
}
