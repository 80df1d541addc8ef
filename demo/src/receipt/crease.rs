//! Creases: finds the bend under a finger and makes it permanent. Paper that is only bent springs
//! back.
//!
//! ```text
//!   bend    ╭─╮        crease   ╱╲        the crease is as long as the bend
//!          ╱   ╲               ╱  ╲
//! ```
//! Method: the bend angle across a line is the sum of the angles between neighbouring normals; the
//! direction with the most bending is searched in steps of 7.5°.
//!
//! Reads the positions of the cloth on its grid; writes rest angles through [`Cloth::crease`].
//!
//! Invariant: a repeated press does not deepen a crease.

use glam::{Vec2, Vec3};
use muslin::{Cloth, GridDesc, Result};
use muslin_scenes::Sheet;

use super::crease_map::CreaseMap;

/// Half the distance over which the bend is measured to find its direction [cells].
const DIRECTION_REACH: f32 = 3.0;
/// Half the distance over which the whole bend angle is measured [cells].
const ANGLE_REACH: f32 = 9.0;
/// Least bend angle that counts as a bend [rad].
const MIN_BEND: f32 = 0.6;
/// Greatest crease angle [rad]: even a flat press opens again by the rest.
const MAX_CREASE: f32 = 2.75;
/// Bend angle above which a press is flat [rad].
const FLAT_PRESS_BEND: f32 = 1.6;
/// Greatest distance of a bend from a crease that it belongs to [cells].
const MERGE_DISTANCE: f32 = 4.0;

/// A crease, in cells of the grid.
#[derive(Clone, Copy, Debug)]
struct Crease {
    middle: Vec2,
    along: Vec2,
    /// Crease angle [rad]; positive towards the front.
    angle: f32,
}

/// All creases so far.
#[derive(Clone, Debug, Default)]
pub struct Creases {
    lines: Vec<Crease>,
    /// How the sheet is folded and was folded, for drawing.
    pub(super) map: CreaseMap,
}

/// The cloth as its original grid, without the particles that tears have added.
struct GridSheet<'a> {
    positions: &'a [Vec3],
    columns: usize,
    rows: usize,
}

impl Creases {
    /// Updates the crease map to the present state of a cloth. Only paper keeps the marks of folds.
    pub(super) fn record(&mut self, cloth: &Cloth, sheet: Sheet, grid_size: [u32; 2]) {
        if sheet != Sheet::Paper {
            self.map.forget();
        }
        self.map.record(cloth.positions(), grid_size);
    }

    /// Creases the bend at a particle; returns whether there is one.
    ///
    /// # Errors
    /// As [`Cloth::crease`].
    pub fn press(&mut self, cloth: &mut Cloth, desc: &GridDesc, particle: u32) -> Result<bool> {
        let sheet = GridSheet {
            positions: cloth.positions(),
            columns: desc.columns as usize,
            rows: desc.rows as usize,
        };
        let source = cloth.source_vertices()[particle as usize];
        let at = Vec2::new((source % desc.columns) as f32, (source / desc.columns) as f32);
        let Some((middle, along)) = sheet.find_bend(at) else {
            return Ok(false);
        };
        let bend = sheet.bend_angle(middle, along.perp(), ANGLE_REACH);
        // In a sharp bend both sides meet under the finger, so that the press is flat.
        let angle = if bend.abs() > FLAT_PRESS_BEND { MAX_CREASE.copysign(bend) } else { bend };
        let [from, to] = [-1.0, 1.0].map(|way| sheet.find_end(middle, along * way));
        let is_known = |line: &&mut Crease| {
            let off = (middle - line.middle).perp_dot(line.along).abs();
            off < MERGE_DISTANCE && line.along.dot(along).abs() > 0.9
        };
        let more = match self.lines.iter_mut().find(is_known) {
            // The crease is sharp enough already.
            Some(line) if line.angle.abs() >= angle.abs() - 0.3 => return Ok(true),
            Some(line) => {
                let more = angle - line.angle;
                line.angle = angle;
                more
            }
            None => {
                self.lines.push(Crease { middle, along, angle });
                angle
            }
        };
        let position =
            |cell: Vec2| desc.origin + (desc.right * cell.x + desc.down * cell.y) * desc.spacing;
        cloth.crease(position(from), position(to), more.clamp(-3.0, 3.0))?;
        Ok(true)
    }
}

impl GridSheet<'_> {
    /// Returns the interpolated position at a cell; the cell is clamped to the grid.
    fn position(&self, cell: Vec2) -> Vec3 {
        let most = Vec2::new((self.columns - 1) as f32, (self.rows - 1) as f32);
        let cell = cell.clamp(Vec2::ZERO, most);
        let low = cell.floor().min(most - 1.0);
        let share = cell - low;
        let at = |x: usize, y: usize| {
            self.positions[(low.y as usize + y) * self.columns + low.x as usize + x]
        };
        at(0, 0).lerp(at(1, 0), share.x).lerp(at(0, 1).lerp(at(1, 1), share.x), share.y)
    }

    /// Returns the unit normal of the front near a cell.
    fn normal(&self, cell: Vec2) -> Vec3 {
        let most = Vec2::new((self.columns - 1) as f32, (self.rows - 1) as f32);
        let cell = cell.clamp(Vec2::ONE, most - 1.0);
        let across = self.position(cell + Vec2::X) - self.position(cell - Vec2::X);
        let down = self.position(cell + Vec2::Y) - self.position(cell - Vec2::Y);
        down.cross(across).normalize_or_zero()
    }

    /// Returns the bend angle [rad] along `way`, from `reach` cells before a cell to `reach` after
    /// it; positive towards the front.
    fn bend_angle(&self, cell: Vec2, way: Vec2, reach: f32) -> f32 {
        let mut turned = 0.0;
        let steps = (2.0 * reach).ceil() as i32;
        let step = 2.0 * reach / steps as f32;
        for i in 0..steps {
            let from = cell + way * (-reach + i as f32 * step);
            let to = from + way * step;
            let (a, b) = (self.normal(from), self.normal(to));
            let ahead = self.position(to) - self.position(from);
            let towards_front = (b - a).dot(ahead) < 0.0;
            turned += if towards_front { a.angle_between(b) } else { -a.angle_between(b) };
        }
        turned
    }

    /// Returns centre and direction of the sharpest bend near a cell; `None` if the sheet is flat
    /// there.
    fn find_bend(&self, cell: Vec2) -> Option<(Vec2, Vec2)> {
        let directions = (0..24).map(|i| Vec2::from_angle(i as f32 * core::f32::consts::PI / 24.0));
        // A fold does not bend along its line, only across it.
        let across = directions.max_by(|a, b| {
            let bend = |way: &Vec2| {
                self.bend_angle(cell, *way, DIRECTION_REACH).abs()
                    - self.bend_angle(cell, way.perp(), ANGLE_REACH).abs()
            };
            bend(a).total_cmp(&bend(b))
        })?;
        let places = (-6..=6).map(|i| cell + across * i as f32);
        let middle = places.max_by(|a, b| {
            let bend = |at: &Vec2| self.bend_angle(*at, across, DIRECTION_REACH).abs();
            bend(a).total_cmp(&bend(b))
        })?;
        let bends = self.bend_angle(middle, across, ANGLE_REACH).abs() > MIN_BEND;
        bends.then_some((middle, across.perp()))
    }

    /// Returns the end of the bend in a direction.
    fn find_end(&self, middle: Vec2, way: Vec2) -> Vec2 {
        let across = way.perp();
        let bends = |at: Vec2| self.bend_angle(at, across, ANGLE_REACH).abs() > MIN_BEND;
        let mut far = 0.0;
        let longest = (self.columns + self.rows) as f32;
        while far < longest && bends(middle + way * far) {
            far += 1.0;
        }
        middle + way * far
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bends a sheet around its middle row, to the front or to the back.
    fn bent_sheet(front: bool) -> (Cloth, GridDesc) {
        let desc = Sheet::Paper.desc(true);
        let mut cloth = Cloth::grid(&desc).unwrap();
        let side = if front { 1.0 } else { -1.0 };
        let (mut at, mut angle) = (desc.origin, 0.0_f32);
        for row in 0..desc.rows {
            for column in 0..desc.columns {
                let x = desc.right * (column as f32 * desc.spacing);
                cloth.set_position(row * desc.columns + column, at + x).unwrap();
            }
            angle += if row.abs_diff(18) < 4 { 1.4 / 7.0 } else { 0.0 };
            at += Vec3::new(0.0, -angle.cos(), side * angle.sin()) * desc.spacing;
        }
        (cloth, desc)
    }

    #[test]
    fn a_crease_keeps_the_angle_and_the_side_of_its_bend() {
        for front in [true, false] {
            let (mut cloth, desc) = bent_sheet(front);
            let mut creases = Creases::default();
            assert!(creases.press(&mut cloth, &desc, 17 * 24 + 11).unwrap());
            let line = creases.lines[0];
            assert!((line.middle.y - 18.0).abs() < 2.0 && line.along.x.abs() > 0.99, "{line:?}");
            assert!(
                (line.angle.abs() - 1.4).abs() < 0.2 && (line.angle > 0.0) == front,
                "{line:?}"
            );
            // Without gravity and pins the sheet keeps about the crease angle.
            cloth.unpin_all();
            let mut settings = cloth.settings().clone();
            (settings.gravity, settings.damping) = (Vec3::ZERO, 5.0);
            cloth.set_settings(settings).unwrap();
            cloth.step(600);
            let row = |row: u32| cloth.positions()[(row * desc.columns + 11) as usize];
            let (up, down) = (row(8) - row(2), row(34) - row(28));
            let turned = up.angle_between(down);
            assert!((turned - 1.4).abs() < 0.3, "it is folded by {turned} rad");
        }
    }

    #[test]
    fn a_second_press_changes_nothing_and_flat_paper_has_no_bend() {
        let (mut cloth, desc) = bent_sheet(true);
        let mut creases = Creases::default();
        creases.press(&mut cloth, &desc, 17 * 24 + 11).unwrap();
        let hash = cloth.state_hash();
        assert!(creases.press(&mut cloth, &desc, 18 * 24 + 5).unwrap());
        assert_eq!(cloth.state_hash(), hash);
        assert!(!creases.press(&mut cloth, &desc, 5 * 24 + 11).unwrap());
        assert_eq!(creases.lines.len(), 1);
    }
}
