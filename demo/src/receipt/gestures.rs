//! Scripted gestures on the receipt: pointer input by keyframes and actions by tick, for pictures
//! and tests.
//!
//! Method: the input goes through the same functions as the pointers and keys of a user.
//!
//! Reads the script and the camera; writes pointer events and runs ticks.
//!
//! Invariant: the same gesture on the same state gives the same paper.

use glam::Vec2;
use muslin::Result;

use super::ReceiptApp;
use super::pointers::PressKind;
use super::settings::ReceiptAction;

/// A scripted gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReceiptGesture {
    /// Two pointers lift the lower edge to the upper one, a finger creases the bend, and the
    /// pointers release it.
    Fold,
    /// Many grabs press the sheet into a ball, several times, and release it.
    Crumple,
    /// Many grabs fold the sheet in half twice, lay it on the floor and release it.
    Letter,
    /// One pointer takes the sheet off its pins and throws it across the floor.
    Toss,
}

/// Keyframes of a pointer: tick and position, as a fraction of the hanging sheet; (0, 0) is the top
/// left corner. Positions in between are eased.
type PointerTrack = &'static [(u32, [f32; 2])];

/// An action at a tick.
#[derive(Clone, Copy)]
enum ScriptedAction {
    Act(ReceiptAction),
    /// A finger creases the bend at this position, as a fraction of the hanging sheet.
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
    /// All gestures with their names on the command line.
    pub const ALL: [(&'static str, Self); 4] = [
        ("fold", Self::Fold),
        ("letter", Self::Letter),
        ("crumple", Self::Crumple),
        ("toss", Self::Toss),
    ];

    /// Returns the number of ticks until the receipt is at rest again.
    pub fn ticks(self) -> u32 {
        self.script().ticks
    }

    /// Returns the camera drag (in screen heights) and the distance factor that show the gesture
    /// best.
    pub fn view(self) -> (Vec2, f32) {
        match self {
            // The letter ends flat on the floor.
            Self::Letter => (Vec2::new(-0.05, 0.22), 0.9),
            // The receipt flies to the right and would leave a square picture.
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

/// State of a gesture while it runs.
pub struct ReceiptGesturePlayer {
    gesture: ReceiptGesture,
    tick: u32,
}

impl ReceiptGesturePlayer {
    /// Starts a gesture on the hanging sheet.
    pub fn new(gesture: ReceiptGesture) -> Self {
        Self { gesture, tick: 0 }
    }

    /// Sends the input of one tick and runs the tick.
    ///
    /// # Errors
    /// As [`ReceiptApp::press`], [`ReceiptApp::lift`], [`ReceiptApp::run_action`] and
    /// [`ReceiptApp::crease`].
    pub fn step(&mut self, app: &mut ReceiptApp) -> Result<()> {
        let script = self.gesture.script();
        for (id, way) in (1..).zip(script.tracks) {
            let [(begin, _), .., (end, _)] = way else {
                continue;
            };
            let at = on_screen(app, place(way, self.tick));
            if self.tick == *begin {
                app.press(id, at, PressKind::Main)?;
            } else if self.tick > *begin && self.tick <= *end {
                app.drag(id, at);
            }
            if self.tick == *end {
                app.lift(id)?;
            }
        }
        for (_, action) in script.actions.iter().filter(|(tick, _)| *tick == self.tick) {
            match action {
                ScriptedAction::Act(action) => app.run_action(*action)?,
                ScriptedAction::Crease(share) => {
                    let at = on_screen(app, *share);
                    app.crease(at)?;
                }
            }
        }
        app.play(1)?;
        self.tick += 1;
        Ok(())
    }
}

/// Returns the screen position of a fraction of the hanging sheet.
fn on_screen(app: &ReceiptApp, [x, y]: [f32; 2]) -> Vec2 {
    let at = Vec2::new(x - 0.5, 0.5 - y) * app.span();
    app.on_screen(at.extend(0.0)).unwrap_or_default()
}

/// Returns the position of a track at a tick: eased at both ends, but the last piece ends at full
/// speed.
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
    fn a_track_passes_its_keyframes_at_their_ticks() {
        for way in FOLD.tracks.iter().chain(TOSS.tracks) {
            for (tick, at) in *way {
                let off = Vec2::from(place(way, *tick)).distance(Vec2::from(*at));
                assert!(off < 1.0e-5, "at {tick} it is {off} off {at:?}");
            }
        }
    }
}
