//! What pointers do with the receipt in pictures and tests: gestures played by tick, through the same door as
//! a person's pointers and keys.

use glam::Vec2;
use muslin::Result;

use super::ReceiptApp;
use super::pointers::PressKind;
use super::settings::ReceiptAction;

/// A gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReceiptGesture {
    /// Two pointers lift the lower edge to the upper one; the bend is pressed into a crease; they let go.
    Fold,
    /// ReceiptPointers press the sheet to a ball, again and again, and drop it.
    Crumple,
    /// Two pointers fold it on the floor, in half and in half again, and let go.
    Letter,
    /// A hand takes it off its pins and throws it across the floor.
    Toss,
}

/// A pointer's way: where it is at which tick, in shares of the sheet as it hangs, (0, 0) its top left
/// corner; it eases from place to place.
type PointerTrack = &'static [(u32, [f32; 2])];

/// Something that is done at a tick.
#[derive(Clone, Copy)]
enum ScriptedAction {
    Act(ReceiptAction),
    /// A finger presses the bend at this place, in shares of the sheet as it hangs.
    Crease([f32; 2]),
}

struct GestureScript {
    ticks: u32,
    tracks: &'static [PointerTrack],
    actions: &'static [(u32, ScriptedAction)],
}

const FOLD: GestureScript = GestureScript {
    ticks: 720,
    tracks: &[
        &[(0, [0.03, 0.99]), (12, [0.03, 0.99]), (150, [0.06, 0.10]), (330, [0.06, 0.10])],
        &[(0, [0.97, 0.99]), (12, [0.97, 0.99]), (150, [0.94, 0.10]), (330, [0.94, 0.10])],
    ],
    actions: &[
        (250, ScriptedAction::Crease([0.5, 0.40])),
        (290, ScriptedAction::Crease([0.5, 0.40])),
    ],
};

const CRUMPLE: GestureScript = GestureScript {
    ticks: 960,
    tracks: &[],
    actions: &[(1, ScriptedAction::Act(ReceiptAction::Crumple))],
};

const LETTER: GestureScript = GestureScript {
    ticks: 1080,
    tracks: &[],
    actions: &[(1, ScriptedAction::Act(ReceiptAction::Fold))],
};

const TOSS: GestureScript = GestureScript {
    ticks: 840,
    tracks: &[&[
        (0, [0.5, 0.12]),
        (30, [0.5, 0.12]),
        (90, [-0.25, 0.10]),
        (130, [-0.35, 0.15]),
        (160, [0.80, 0.05]),
    ]],
    actions: &[(20, ScriptedAction::Act(ReceiptAction::Drop))],
};

impl ReceiptGesture {
    /// All of them, with the names that the command line knows.
    pub const ALL: [(&'static str, Self); 4] = [
        ("fold", Self::Fold),
        ("letter", Self::Letter),
        ("crumple", Self::Crumple),
        ("toss", Self::Toss),
    ];

    /// Ticks from its beginning until the receipt rests again.
    pub fn ticks(self) -> u32 {
        self.script().ticks
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

    fn script(self) -> &'static GestureScript {
        match self {
            Self::Fold => &FOLD,
            Self::Letter => &LETTER,
            Self::Crumple => &CRUMPLE,
            Self::Toss => &TOSS,
        }
    }
}

/// A gesture while it is played.
pub struct ReceiptGesturePlayer {
    gesture: ReceiptGesture,
    tick: u32,
}

impl ReceiptGesturePlayer {
    /// Begins on the sheet as it hangs.
    pub fn new(gesture: ReceiptGesture) -> Self {
        Self { gesture, tick: 0 }
    }

    /// Plays one tick.
    ///
    /// # Errors
    /// As [`ReceiptApp::press`], [`ReceiptApp::lift`], [`ReceiptApp::act`] and [`ReceiptApp::crease`].
    pub fn step(&mut self, tender: &mut ReceiptApp) -> Result<()> {
        let script = self.gesture.script();
        for (id, way) in (1..).zip(script.tracks) {
            let [(begin, _), .., (end, _)] = way else {
                continue;
            };
            let at = on_screen(tender, place(way, self.tick));
            if self.tick == *begin {
                tender.press(id, at, PressKind::Main)?;
            } else if self.tick > *begin && self.tick <= *end {
                tender.drag(id, at);
            }
            if self.tick == *end {
                tender.lift(id)?;
            }
        }
        for (_, action) in script.actions.iter().filter(|(tick, _)| *tick == self.tick) {
            match action {
                ScriptedAction::Act(action) => tender.act(*action)?,
                ScriptedAction::Crease(share) => {
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
fn on_screen(tender: &ReceiptApp, [x, y]: [f32; 2]) -> Vec2 {
    let at = Vec2::new(x - 0.5, 0.5 - y) * tender.span();
    tender.on_screen(at.extend(0.0)).unwrap_or_default()
}

/// Where a way is at a tick: a hand speeds up and slows down, but the last stretch ends at full speed.
fn place(way: PointerTrack, tick: u32) -> [f32; 2] {
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
        for way in FOLD.tracks.iter().chain(TOSS.tracks) {
            for (tick, at) in *way {
                let off = Vec2::from(place(way, *tick)).distance(Vec2::from(*at));
                assert!(off < 1.0e-5, "at {tick} it is {off} off {at:?}");
            }
        }
    }
}
