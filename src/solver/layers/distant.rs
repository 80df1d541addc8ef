//! Pairs that may meet in a substep but are too far from each other to push: a direction told them apart as it
//! began, and the fence asks whether it still does.

use super::contacts::{Contact, EDGES, Kind, SLIT, VERTEX, between, places};
use super::motion::Motion;
use super::spots::Spot;
use glam::Vec3;

/// A pair that is left to the fence.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distant {
    pub ids: [u32; 4],
    /// How many of them are the first side.
    pub first: Kind,
    /// How far they keep apart [m].
    pub gap: f32,
    /// From the second side to the first.
    pub n: Vec3,
}

impl Distant {
    /// Whether sides are apart by more than a fence leaves between them.
    #[inline(always)]
    pub fn is_apart(&self, now: &[Spot]) -> bool {
        between(places(now, self.ids), self.first, self.n) > self.gap * SLIT
    }
}

/// Makes contacts of what is apart no more, or of all. None keep more than `most` [m].
pub(super) fn call(
    distant: &mut Vec<Distant>,
    all: bool,
    motion: &Motion,
    most: f32,
    contacts: &mut Vec<Contact>,
) {
    distant.retain(|pair| {
        let stays = !all && pair.is_apart(&motion.now);
        if !stays {
            let Distant { ids, gap, .. } = *pair;
            contacts.extend(if pair.first == VERTEX {
                Contact::find::<VERTEX>(ids, motion, most, gap)
            } else {
                Contact::find::<EDGES>(ids, motion, most, gap)
            });
        }
        stays
    });
}
