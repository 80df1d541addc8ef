//! Letter fold: an animation that folds the sheet in half twice, creases it, and lays it on the
//! floor.
//!
//! ```text
//!  end ──────── 1 ──────── top      1 ──────── end, top      ╭──── 1
//!                                                            ╰──── end, top
//! ```
//! Method: a grid of grabs follows prescribed rotations about the two fold lines. The sheet is
//! tilted first, with the print away from the eye.
//!
//! Reads the age of the animation; writes grab targets and creases.
//!
//! Invariant: when the animation ends, all its grabs are released.

use core::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use muslin::{Cloth, Error, Grab, GridDesc, Result};
use muslin_scenes::receipt::FLOOR;

/// Grabs across the sheet, and rows of grabs along its length.
const ACROSS: u32 = 6;
const DOWN: u32 = 9;
/// Times [s]: the grabs reach the sheet; it is in front of the camera; each fold starts; each fold
/// is closed; each crease is done; the letter lies on the floor; the grabs are released.
const REACHED: f32 = 0.3;
const TIPPED: f32 = 1.5;
const FOLD_STARTED: [f32; 2] = [TIPPED, 3.7];
const FOLDED: [f32; 2] = [3.0, 5.2];
const PRESSED: [f32; 2] = [3.6, 5.8];
const LAID: f32 = 7.0;
const RELEASED: f32 = 7.3;
/// Tilt towards the camera [rad], and height over the floor, in units.
const TILT: f32 = 0.6;
const HEIGHT: f32 = 1.2;
/// Angle of a crease [rad].
const CREASE: f32 = 0.3;
/// Height of the first layer over the floor, and thickness of each further layer, in units.
const FIRST_LAYER: f32 = 0.05;
const LAYER: f32 = 0.07;
/// State of the animation.
#[derive(Debug)]
pub struct LetterFold {
    /// Each grab with its start position [m] and its place on the sheet, in units from the middle
    /// of the top edge.
    grabs: Vec<(Grab, Vec3, [f32; 2])>,
    /// Length of the sheet, in units.
    length: f32,
    desc: GridDesc,
    unit: f32,
    age: f32,
}

impl LetterFold {
    /// Grabs a sheet that was created from `desc`; `unit` is the length of a unit [m].
    ///
    /// # Errors
    /// As [`Cloth::grab_particle`].
    pub fn new(cloth: &mut Cloth, desc: GridDesc, unit: f32) -> Result<Self> {
        let spacing = desc.spacing / unit;
        let mut grabs = Vec::new();
        for i in 0..DOWN {
            for j in 0..ACROSS {
                let row = i * (desc.rows - 1) / (DOWN - 1);
                let column = j * (desc.columns - 1) / (ACROSS - 1);
                let particle = row * desc.columns + column;
                let from = cloth.positions()[particle as usize];
                let grab = match cloth.grab_particle(particle) {
                    Ok(grab) => grab,
                    // Other pointers use all grabs of the cloth.
                    Err(Error::Full { .. }) => break,
                    Err(error) => return Err(error),
                };
                let across = column as f32 - 0.5 * (desc.columns - 1) as f32;
                grabs.push((grab, from, [across * spacing, row as f32 * spacing]));
            }
        }
        let length = (desc.rows - 1) as f32 * spacing;
        Ok(Self { grabs, length, desc, unit, age: 0.0 })
    }

    /// Advances by one tick; returns whether the animation still runs. At its end it releases the
    /// grabs.
    ///
    /// # Errors
    /// As [`Cloth::move_grab`] and [`Cloth::crease`].
    pub fn tick(&mut self, seconds: f32, cloth: &mut Cloth) -> Result<bool> {
        let before = self.age;
        self.age += seconds;
        if self.age > RELEASED {
            for (grab, ..) in self.grabs.drain(..) {
                cloth.release(grab)?;
            }
            return Ok(false);
        }
        let taken = ease(self.age, 0.0, REACHED);
        for (grab, from, target) in &self.grabs {
            cloth.move_grab(*grab, from.lerp(self.target(*target) * self.unit, taken))?;
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

    /// Releases the grabs before the end.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn release(self, cloth: &mut Cloth) -> Result<()> {
        self.grabs.into_iter().try_for_each(|(grab, ..)| cloth.release(grab))
    }

    /// Adds `angle` to a crease. The first fold has one crease; the second one has two, with
    /// opposite signs, because one of the two layers is upside down.
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

    /// Returns the current target of a place on the sheet, in units.
    fn target(&self, [across, down]: [f32; 2]) -> Vec3 {
        let half = 0.5 * self.length;
        let [first, second] = [0, 1].map(|fold| ease(self.age, FOLD_STARTED[fold], FOLDED[fold]));
        // Distance to the first fold line (towards the top) and height; then the same for the
        // second fold line.
        let [ahead, high] = rotated_over([half - down, 0.0], first, 1.0);
        let [ahead, high] = rotated_over([ahead - 0.5 * half, high], second, 3.0);
        let ahead = ahead - 0.25 * half;
        // The sheet moves from its hanging position to the camera, and later to the floor.
        let [up, low] = [ease(self.age, 0.0, TIPPED), ease(self.age, PRESSED[1], LAID)];
        let tilt = -FRAC_PI_2 + (TILT + FRAC_PI_2) * up - TILT * low;
        let hung = 0.75 * half;
        let height = hung + (FLOOR + HEIGHT - hung) * up + (FIRST_LAYER - HEIGHT) * low;
        let (sin, cos) = tilt.sin_cos();
        Vec3::new(across, height + high * cos - ahead * sin, high * sin + ahead * cos)
    }
}

/// Rotates a point that is behind a fold line (`ahead` below zero) over it by `share` of a half
/// turn; in the end it is `layers` layers higher.
fn rotated_over([ahead, high]: [f32; 2], share: f32, layers: f32) -> [f32; 2] {
    if ahead >= 0.0 {
        return [ahead, high];
    }
    let (sin, cos) = (PI * share).sin_cos();
    [ahead * cos + high * sin, high * cos - ahead * sin + layers * LAYER * share]
}

/// Smoothstep from 0 to 1 between two times.
fn ease(age: f32, from: f32, to: f32) -> f32 {
    let share = ((age - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}
