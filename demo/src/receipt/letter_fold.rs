//! Folding a letter_fold: two pointers tip the sheet back, its print away from the eye, fold it in half towards the eye and
//! in half again, press each crease, lay it on the floor and let go.
//!
//! ```text
//!  end ──────── 1 ──────── top      1 ──────── end, top      ╭──── 1
//!                                                            ╰──── end, top
//! ```

use core::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use muslin::{Cloth, Error, Grab, GridDesc, Result};
use muslin_scenes::receipt::FLOOR;

/// Fingers across the sheet, and rows of them down its length.
const ACROSS: u32 = 6;
const DOWN: u32 = 9;
/// When the pointers have it all, when it is before the eye, when each half is begun to be folded over, when it is over, when
/// its crease is pressed, when the letter lies, and when they let go [s].
const TAKEN: f32 = 0.3;
const TIPPED: f32 = 1.5;
const BEGUN: [f32; 2] = [TIPPED, 3.7];
const FOLDED: [f32; 2] = [3.0, 5.2];
const PRESSED: [f32; 2] = [3.6, 5.8];
const LAID: f32 = 7.0;
const RELEASED: f32 = 7.3;
/// By how much it is tilted towards the eye [rad], and how high over the floor, in units.
const TILT: f32 = 0.6;
const HEIGHT: f32 = 1.2;
/// What a pressed crease is bent by [rad].
const CREASE: f32 = 0.3;
/// Height of what lies, over the floor, and of every layer more, in units.
const LYING: f32 = 0.05;
const LAYER: f32 = 0.07;
/// ReceiptPointers that fold.
#[derive(Debug)]
pub struct LetterFold {
    /// Each with where it takes hold [m], and which place of the sheet, in units from the middle of its top.
    fingers: Vec<(Grab, Vec3, [f32; 2])>,
    /// Length of the sheet, in units.
    length: f32,
    desc: GridDesc,
    unit: f32,
    age: f32,
}

impl LetterFold {
    /// Takes hold of a sheet as it was woven by `desc`, where a unit is so long [m].
    ///
    /// # Errors
    /// As [`Cloth::grab_particle`].
    pub fn new(cloth: &mut Cloth, desc: GridDesc, unit: f32) -> Result<Self> {
        let spacing = desc.spacing / unit;
        let mut fingers = Vec::new();
        for i in 0..DOWN {
            for j in 0..ACROSS {
                let row = i * (desc.rows - 1) / (DOWN - 1);
                let column = j * (desc.columns - 1) / (ACROSS - 1);
                let particle = row * desc.columns + column;
                let from = cloth.positions()[particle as usize];
                let grab = match cloth.grab_particle(particle) {
                    Ok(grab) => grab,
                    // Other pointers hold all that can be held.
                    Err(Error::Full { .. }) => break,
                    Err(error) => return Err(error),
                };
                let across = column as f32 - 0.5 * (desc.columns - 1) as f32;
                fingers.push((grab, from, [across * spacing, row as f32 * spacing]));
            }
        }
        let length = (desc.rows - 1) as f32 * spacing;
        Ok(Self { fingers, length, desc, unit, age: 0.0 })
    }

    /// Goes on for one tick, and says whether the pointers still hold; they have let go otherwise.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`] and [`Cloth::crease`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        let before = self.age;
        self.age += seconds;
        if self.age > RELEASED {
            for (grab, ..) in self.fingers.drain(..) {
                cloth.release(grab)?;
            }
            return Ok(false);
        }
        let taken = ease(self.age, 0.0, TAKEN);
        for (grab, from, place) in &self.fingers {
            cloth.move_grab(*grab, from.lerp(self.place(*place) * self.unit, taken))?;
        }
        for fold in 0..2 {
            let share = |age| ease(age, FOLDED[fold], PRESSED[fold]);
            let more = share(self.age) - share(before);
            if more > 0.0 {
                self.press(fold, more * CREASE, cloth)?;
            }
        }
        Ok(true)
    }

    /// Lets go before the time.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn release(self, cloth: &mut Cloth) -> Result<()> {
        self.fingers.into_iter().try_for_each(|(grab, ..)| cloth.release(grab))
    }

    /// Presses a crease by so much more: the first away from the print, and the second through two layers, of which
    /// the one above lies the other way round.
    fn press(&self, fold: usize, angle: f32, cloth: &mut Cloth) -> Result<()> {
        let lines: &[(f32, f32)] =
            if fold == 0 { &[(0.5, -1.0)] } else { &[(0.25, -1.0), (0.75, 1.0)] };
        let GridDesc { origin, right, down, spacing, columns, .. } = self.desc;
        let across = right * (columns as f32 * spacing);
        for (share, way) in lines {
            let from = origin + down * (share * self.length * self.unit) - across * 0.1;
            cloth.crease(from, from + across * 1.2, way * angle)?;
        }
        Ok(())
    }

    /// Where pointers have a place of the sheet now, in units.
    fn place(&self, [across, down]: [f32; 2]) -> Vec3 {
        let half = 0.5 * self.length;
        let [first, second] = [0, 1].map(|fold| ease(self.age, BEGUN[fold], FOLDED[fold]));
        // How far it is from the first crease towards the top, and how high; then the same from the second one.
        let [ahead, high] = turned([half - down, 0.0], first, 1.0);
        let [ahead, high] = turned([ahead - 0.5 * half, high], second, 3.0);
        let ahead = ahead - 0.25 * half;
        // From where it hung to before the eye; and at last to the floor.
        let [up, low] = [ease(self.age, 0.0, TIPPED), ease(self.age, PRESSED[1], LAID)];
        let tilt = -FRAC_PI_2 + (TILT + FRAC_PI_2) * up - TILT * low;
        let hung = 0.75 * half;
        let height = hung + (FLOOR + HEIGHT - hung) * up + (LYING - HEIGHT) * low;
        let (sin, cos) = tilt.sin_cos();
        Vec3::new(across, height + high * cos - ahead * sin, high * sin + ahead * cos)
    }
}

/// A place so far ahead of a crease and so high; or behind it, and then turned over it as far as `share` says, so that
/// in the end what was lowest is so many layers high.
fn turned([ahead, high]: [f32; 2], share: f32, layers: f32) -> [f32; 2] {
    if ahead >= 0.0 {
        return [ahead, high];
    }
    let (sin, cos) = (PI * share).sin_cos();
    [ahead * cos + high * sin, high * cos - ahead * sin + layers * LAYER * share]
}

/// From 0 to 1 between two times, slow at both ends.
fn ease(age: f32, from: f32, to: f32) -> f32 {
    let share = ((age - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}
