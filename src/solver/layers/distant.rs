//! Pairs that may meet in a substep but are too far from each other to push: a direction told them apart as it
//! began, and the fence asks whether it still does.

use super::contacts::{Kind, SLIT, between, places};
use super::spots::Spot;
use glam::Vec3;

/// A pair that is left to the fence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distant {
    pub ids: [u32; 4],
    /// How many of them are the first side.
    pub first: Kind,
    /// Whether the sides may be near at rest.
    pub is_woven: bool,
    /// From the second side to the first.
    pub n: Vec3,
}

impl Distant {
    /// Whether sides are apart by more than a fence leaves between such that keep `gap`.
    #[inline(always)]
    pub fn is_apart(&self, now: &[Spot], gap: f32) -> bool {
        between(places(now, self.ids), self.first, self.n) > gap * SLIT
    }
}
