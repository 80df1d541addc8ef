//! Scripted gestures: pointer input by keyframes, for pictures and tests.
//!
//! Method: positions between two keyframes are interpolated linearly; the result goes through
//! [`App::press`], [`App::drag`] and [`App::lift`], as the input of a user does.
//!
//! Reads the keyframes and the outline of the sheet on the screen; writes pointer events and runs
//! ticks.
//!
//! Invariant: the same gesture on the same state gives the same cloth.

use glam::Vec2;
use muslin::Result;

use crate::app::App;

/// A scripted gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Two pointers grab the hem side by side and pull it apart.
    Tear,
    /// One pointer grabs the side of the sheet and pulls it down and away quickly.
    Yank,
    /// The blade swipes across the sheet.
    Cut,
}

/// Keyframes of one pointer: tick and position, as a fraction of the sheet on the screen when the
/// gesture starts; (0, 0) is the top left corner.
struct Stroke {
    blade: bool,
    keyframes: &'static [(u32, [f32; 2])],
}

const TEAR: [Stroke; 2] = [
    Stroke {
        blade: false,
        keyframes: &[(0, [0.44, 0.85]), (45, [-0.18, 0.85]), (80, [-0.18, 0.85])],
    },
    Stroke {
        blade: false,
        keyframes: &[(0, [0.54, 0.85]), (45, [1.16, 0.73]), (80, [1.16, 0.73])],
    },
];

const YANK: [Stroke; 1] = [Stroke {
    blade: false,
    keyframes: &[(0, [0.03, 0.72]), (6, [0.03, 0.72]), (30, [-0.60, 0.90]), (60, [-0.60, 1.00])],
}];

const CUT: [Stroke; 1] = [Stroke {
    blade: true,
    keyframes: &[(0, [-0.12, 0.30]), (10, [0.22, 0.46]), (24, [0.78, 0.60])],
}];

impl Gesture {
    /// All gestures with their names on the command line.
    pub const ALL: [(&'static str, Self); 3] =
        [("tear", Self::Tear), ("yank", Self::Yank), ("cut", Self::Cut)];

    /// Returns the number of ticks until the cloth is at rest again.
    pub fn ticks(self) -> u32 {
        match self {
            Self::Tear => 110,
            Self::Yank => 100,
            Self::Cut => 90,
        }
    }

    fn strokes(self) -> &'static [Stroke] {
        match self {
            Self::Tear => &TEAR,
            Self::Yank => &YANK,
            Self::Cut => &CUT,
        }
    }
}

/// State of a gesture while it runs.
pub struct GesturePlayer {
    gesture: Gesture,
    tick: u32,
    corner: Vec2,
    size: Vec2,
}

impl GesturePlayer {
    /// Starts a gesture on the current state of the sheet.
    pub fn new(gesture: Gesture, app: &mut App) -> Self {
        let Some([columns, rows]) = app.grid_size() else {
            return Self::over(gesture, app);
        };
        let place = |app: &mut App, particle| app.particle_on_screen(particle).unwrap_or_default();
        let corner = place(app, 0);
        let right = place(app, columns - 1);
        let bottom = place(app, (rows - 1) * columns);
        let size = Vec2::new(right.x - corner.x, bottom.y - corner.y);
        Self { gesture, tick: 0, corner, size }
    }

    /// Starts a gesture on the outline of the first cloth, for scenes without a grid.
    fn over(gesture: Gesture, app: &App) -> Self {
        let places: Vec<_> = (0..).map_while(|i| app.particle_on_screen(i)).collect();
        let low = places.iter().copied().reduce(Vec2::min).unwrap_or_default();
        let high = places.into_iter().reduce(Vec2::max).unwrap_or_default();
        Self { gesture, tick: 0, corner: low, size: high - low }
    }

    /// Sends the input of one tick and runs the tick.
    ///
    /// # Errors
    /// As [`App::press`], [`App::drag`] and [`App::lift`].
    pub fn step(&mut self, app: &mut App) -> Result<()> {
        for (id, stroke) in (1..).zip(self.gesture.strokes()) {
            let [(begin, _), .., (end, _)] = stroke.keyframes else {
                continue;
            };
            let at = self.corner + stroke.at(self.tick) * self.size;
            if self.tick == *begin {
                app.hold_blade(stroke.blade);
                app.press(id, at)?;
                app.hold_blade(false);
            } else if self.tick > *begin && self.tick < *end {
                app.drag(id, at)?;
            } else if self.tick == *end {
                app.drag(id, at)?;
                app.lift(id)?;
            }
        }
        app.play(1);
        self.tick += 1;
        Ok(())
    }
}

impl Stroke {
    fn at(&self, tick: u32) -> Vec2 {
        let after = self.keyframes.iter().position(|(at, _)| *at >= tick);
        let to = after.unwrap_or(self.keyframes.len() - 1);
        let from = to.saturating_sub(1);
        let [(start, a), (end, b)] = [self.keyframes[from], self.keyframes[to]];
        let share = (tick.saturating_sub(start) as f32 / (end - start).max(1) as f32).min(1.0);
        Vec2::from(a).lerp(Vec2::from(b), share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;

    fn played(gesture: Gesture, settings: Settings) -> App {
        let mut app = App::new(settings, || 0.0).unwrap();
        app.camera().set_drift(false);
        app.play(60);
        let mut play = GesturePlayer::new(gesture, &mut app);
        for _ in 0..gesture.ticks() {
            play.step(&mut app).unwrap();
        }
        app
    }

    #[test]
    fn a_stroke_passes_its_keyframes_at_their_ticks() {
        let stroke = &CUT[0];
        for (tick, place) in stroke.keyframes {
            assert!(stroke.at(*tick).distance(Vec2::from(*place)) < 1.0e-6);
        }
        let half = Vec2::new(0.5, 0.53);
        assert!(stroke.at(17).distance(half) < 1.0e-3, "{}", stroke.at(17));
    }

    #[test]
    fn a_swipe_of_the_blade_makes_one_cut_and_leaves_one_piece() {
        let app = played(Gesture::Cut, Settings::default());
        let readout = app.readout();
        assert!(readout.particles > 1600 + 25, "{} particles", readout.particles);
        // The blade crosses 0.78 of 39 columns and 0.26 of 39 rows: 31 and 10 threads, and at most
        // one diagonal in each of 41 cells. Each of them gets a particle on both sides. A second cut
        // along the first would open as many again.
        let most = 1600 + 2 * (31 + 10 + 41);
        assert!(readout.particles <= most, "{} particles", readout.particles);
        assert_eq!(readout.pieces, 1);
    }

    #[test]
    fn a_yank_tears_the_sheet_into_at_most_three_pieces() {
        let app = played(Gesture::Yank, Settings { tearing: true, ..Settings::default() });
        let readout = app.readout();
        assert!(readout.particles > 1600 + 8, "{} particles", readout.particles);
        assert!(readout.pieces <= 3, "{} pieces", readout.pieces);
        let whole = played(Gesture::Yank, Settings::default()).readout();
        assert_eq!(whole.particles, 1600);
    }
}
