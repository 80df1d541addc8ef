//! Violations: guarantees that did not hold when the last tick ended, because others contradicted
//! them.
//!
//! Each is counted after every tick and reported by one event, and again only after it held in
//! between.

use serde::{Deserialize, Serialize};

/// How often one guarantee is violated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Violation {
    /// The number of particles, links or pairs that violate it.
    pub count: u32,
    /// Whether an event has reported this.
    is_reported: bool,
}

impl Violation {
    /// Sets the count after a tick, and returns whether an event is due.
    pub fn update(&mut self, count: u32) -> bool {
        self.count = count;
        let was_reported = core::mem::replace(&mut self.is_reported, count > 0);
        count > 0 && !was_reported
    }
}

/// The violations of one cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Violations {
    /// Links that exceed `max_stretch`. Written by `strain_limit`.
    pub over_stretched: Violation,
    /// Sewn pairs whose two particles are held apart. Written by `sewn_pairs`.
    pub open_pairs: Violation,
    /// Particles that pins, attachments or grabs hold inside a collider. Written by
    /// `collide::inside`, as the next.
    pub held_inside: Violation,
    /// Other particles inside a collider.
    pub free_inside: Violation,
    /// Pairs of an edge and a triangle that it passes through, with surface collision. Written by
    /// `crossing_report`.
    pub crossings: Violation,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_event_is_due_once_until_the_guarantee_holds_again() {
        let mut violation = Violation::default();
        let due = [0, 3, 5, 0, 0, 1].map(|count| violation.update(count));
        assert_eq!(due, [false, true, false, false, false, true]);
        assert_eq!(violation.count, 1);
    }
}
