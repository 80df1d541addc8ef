//! Creases: folds that the host adds along a line, independent of the mesh.
//!
//! ```text
//! share of the fold  1 ─      ╱╲          an element at distance d from the line gets
//!                            ╱  ╲         angle · (1 − |d| / width) · length / width
//!                    0 ─ ───╱────╲───
//!                      −width     +width
//! ```
//! Reads plate elements or hinges; adds to the rest angles of [`Folds`], and to its hardening if
//! the material uses it.
//!
//! Invariant: the angles that one crease adds along a path across it sum to about `angle`.

use crate::math::max;
use crate::model::folds::{ElementLengths, Folds, angle_of};
use crate::model::hinge::{Hinge, hinge_normal};
use crate::model::hinges::Hinges;
use crate::model::plate_elements::PlateElements;
use glam::Vec3;

impl Folds {
    /// Adds a fold by `angle` [rad] along a line in the plane of a grid.
    pub fn crease_plates(
        &mut self,
        plates: &PlateElements,
        line: CreaseLine,
        angle: f32,
        tracks_hardening: bool,
    ) {
        if tracks_hardening {
            self.store_rest_angles(plates);
        }
        let (spacing, columns) = (plates.spacing, plates.columns);
        let lengths = ElementLengths::Grid(spacing);
        let ([nx, ny], width) = (line.normal, spacing * line.max_normal_component());
        for at in 0..plates.count() {
            let (row, column) = ((at / columns) as f32, (at % columns) as f32);
            let share = line.share([column * spacing, row * spacing], width, spacing);
            let center = [(column + 0.5) * spacing, (row + 0.5) * spacing];
            let of_cell = line.share(center, width, spacing);
            let whole = angle * spacing / width;
            let folds = [nx * nx * share, ny * ny * share, nx * ny * of_cell];
            for (kind, fold) in folds.into_iter().enumerate() {
                if fold != 0.0 && plates.area_fraction[kind][at] > 0.0 {
                    self.set_angle(kind, at, self.angle[kind][at] + whole * fold, &lengths);
                }
            }
        }
        if tracks_hardening {
            self.accumulate_plate_hardening(plates);
        }
    }

    /// Adds a fold by `angle` [rad] along the segment `from`–`to` of a mesh at rest, over `width`
    /// to either side [m]. `corners` returns the rest positions of a hinge.
    pub fn crease_hinges(
        &mut self,
        hinges: &Hinges,
        corners: impl Fn(&Hinge) -> [Vec3; 4],
        [from, to]: [Vec3; 2],
        width: f32,
        angle: f32,
        tracks_hardening: bool,
    ) {
        if tracks_hardening {
            self.store_hinge_state(hinges);
        }
        let (length, along) = ((to - from).length(), (to - from).normalize_or_zero());
        for (at, hinge) in hinges.all.iter().enumerate() {
            let x = corners(hinge);
            let middle = (x[0] + x[1]) * 0.5 - from;
            let side = hinge_normal(x).cross(along).normalize_or_zero();
            let (ahead, off) = (middle.dot(along), middle.dot(side));
            let near = (middle - along * ahead).length();
            if near >= width || ahead < -0.5 * width || ahead > length + 0.5 * width {
                continue;
            }
            let density = angle * (1.0 - off.abs() / width) / width;
            let terms = x.iter().zip(hinge.weight).map(|(x, weight)| {
                let d = (*x - from - middle).dot(side);
                weight * d * d
            });
            let curve = 0.5 * density * terms.sum::<f32>();
            let increment = angle_of(curve / hinge.length);
            self.set_angle(
                0,
                at,
                self.angle[0][at] + increment,
                &ElementLengths::Hinges(&hinges.all),
            );
        }
        if tracks_hardening {
            self.accumulate_hinge_hardening(hinges);
        }
    }
}

/// A segment in the plane of a grid: start, unit direction, unit normal and length [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct CreaseLine {
    pub from: [f32; 2],
    pub along: [f32; 2],
    pub normal: [f32; 2],
    pub length: f32,
}

impl CreaseLine {
    /// The segment between two different points.
    pub fn new(from: [f32; 2], to: [f32; 2]) -> Self {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let along = [dx / length, dy / length];
        Self { from, along, normal: [-along[1], along[0]], length }
    }

    fn max_normal_component(&self) -> f32 {
        max(self.normal[0].abs(), self.normal[1].abs())
    }

    /// Share of a fold that belongs to a point: 1 on the segment, falling to 0 at distance `width`;
    /// 0 beyond the ends.
    fn share(&self, [x, y]: [f32; 2], width: f32, spacing: f32) -> f32 {
        let (dx, dy) = (x - self.from[0], y - self.from[1]);
        let ahead = dx * self.along[0] + dy * self.along[1];
        let off = dx * self.normal[0] + dy * self.normal[1];
        let is_beside = ahead >= -0.5 * spacing && ahead <= self.length + 0.5 * spacing;
        if is_beside { max(1.0 - off.abs() / width, 0.0) } else { 0.0 }
    }
}
