//! What hands do with the receipt in pictures and tests: gestures played by tick, through the same door as
//! a person's pointers and keys.

use glam::Vec2;
use muslin::Result;

use super::Tender;
use super::hands::Button;
use super::settings::Action;

/// A gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Two hands lift the lower edge to the upper one; the bend is pressed into a crease; they let go.
    Fold,
    /// Hands press the sheet to a ball, again and again, and drop it.
    Crumple,
    /// Two hands fold it on the floor, in half and in half again, and let go.
    Letter,
    /// A hand takes it off its pins and throws it across the floor.
    Toss,
}

/// A pointer's way: where it is at which tick, in shares of the sheet as it hangs, (0, 0) its top left
/// corner; it eases from place to place.
type Way = &'static [(u32, [f32; 2])];

/// Something that is done at a tick.
#[derive(Clone, Copy)]
enum Deed {
    Act(Action),
    /// A finger presses the bend at this place, in shares of the sheet as it hangs.
    Crease([f32; 2]),
}

struct Score {
    ticks: u32,
    ways: &'static [Way],
    deeds: &'static [(u32, Deed)],
}

const FOLD: Score = Score {
    ticks: 720,
    ways: &[
        &[(0, [0.03, 0.99]), (12, [0.03, 0.99]), (150, [0.06, 0.10]), (330, [0.06, 0.10])],
        &[(0, [0.97, 0.99]), (12, [0.97, 0.99]), (150, [0.94, 0.10]), (330, [0.94, 0.10])],
    ],
    deeds: &[(250, Deed::Crease([0.5, 0.40])), (290, Deed::Crease([0.5, 0.40]))],
};

const CRUMPLE: Score = Score { ticks: 960, ways: &[], deeds: &[(1, Deed::Act(Action::Crumple))] };

const LETTER: Score = Score { ticks: 1080, ways: &[], deeds: &[(1, Deed::Act(Action::Fold))] };

const TOSS: Score = Score {
    ticks: 840,
    ways: &[&[
        (0, [0.5, 0.12]),
        (30, [0.5, 0.12]),
        (90, [-0.25, 0.10]),
        (130, [-0.35, 0.15]),
        (160, [0.80, 0.05]),
    ]],
    deeds: &[(20, Deed::Act(Action::Drop))],
};

impl Gesture {
    /// All of them, with the names that the command line knows.
    pub const ALL: [(&'static str, Self); 4] = [
        ("fold", Self::Fold),
        ("letter", Self::Letter),
        ("crumple", Self::Crumple),
        ("toss", Self::Toss),
    ];

    /// Ticks from its beginning until the receipt rests again.
    pub fn ticks(self) -> u32 {
        self.score().ticks
    }

    /// How far the camera is dragged to see it well, in heights of the screen, and what its distance is multiplied by.
    pub fn view(self) -> (Vec2, f32) {
        match self {
            // It ends flat on the floor.
            Self::Letter => (Vec2::new(-0.05, 0.22), 0.9),
            // It flies to the right, out of a square picture otherwise.
            Self::Toss => (Vec2::new(0.0, 0.1), 1.45),
            Self::Fold | Self::Crumple => (Vec2::ZERO, 1.0),
        }
    }

    fn score(self) -> &'static Score {
        match self {
            Self::Fold => &FOLD,
            Self::Letter => &LETTER,
            Self::Crumple => &CRUMPLE,
            Self::Toss => &TOSS,
        }
    }
}

/// A gesture while it is played.
pub struct Play {
    gesture: Gesture,
    tick: u32,
}

impl Play {
    /// Begins on the sheet as it hangs.
    pub fn new(gesture: Gesture) -> Self {
        Self { gesture, tick: 0 }
    }

    /// Plays one tick.
    ///
    /// # Errors
    /// As [`Tender::press`], [`Tender::lift`], [`Tender::act`] and [`Tender::crease`].
    pub fn step(&mut self, tender: &mut Tender) -> Result<()> {
        let score = self.gesture.score();
        for (id, way) in (1..).zip(score.ways) {
            let [(begin, _), .., (end, _)] = way else {
                continue;
            };
            let at = on_screen(tender, place(way, self.tick));
            if self.tick == *begin {
                tender.press(id, at, Button::Main)?;
            } else if self.tick > *begin && self.tick <= *end {
                tender.drag(id, at);
            }
            if self.tick == *end {
                tender.lift(id)?;
            }
        }
        for (_, deed) in score.deeds.iter().filter(|(tick, _)| *tick == self.tick) {
            match deed {
                Deed::Act(action) => tender.act(*action)?,
                Deed::Crease(share) => {
                    let at = on_screen(tender, *share);
                    tender.crease(at)?;
                }
            }
        }
        tender.play(1)?;
        self.tick += 1;
        Ok(())
    }
}

/// Where on the screen a place of the sheet as it hangs is.
fn on_screen(tender: &Tender, [x, y]: [f32; 2]) -> Vec2 {
    let at = Vec2::new(x - 0.5, 0.5 - y) * tender.span();
    tender.on_screen(at.extend(0.0)).unwrap_or_default()
}

/// Where a way is at a tick: a hand speeds up and slows down, but the last stretch ends at full speed.
fn place(way: Way, tick: u32) -> [f32; 2] {
    let after = way.iter().position(|(at, _)| *at >= tick);
    let to = after.unwrap_or(way.len() - 1);
    let from = to.saturating_sub(1);
    let [(start, a), (end, b)] = [way[from], way[to]];
    let share = (tick.saturating_sub(start) as f32 / (end - start).max(1) as f32).min(1.0);
    let eased =
        if to + 1 == way.len() { share * share } else { share * share * (3.0 - 2.0 * share) };
    Vec2::from(a).lerp(Vec2::from(b), eased).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_passes_its_places_at_their_ticks() {
        for way in FOLD.ways.iter().chain(TOSS.ways) {
            for (tick, at) in *way {
                let off = Vec2::from(place(way, *tick)).distance(Vec2::from(*at));
                assert!(off < 1.0e-5, "at {tick} it is {off} off {at:?}");
            }
        }
    }
}
