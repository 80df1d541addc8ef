//! Folds that stay: what each plate or hinge is bent by when nothing bends it.
//!
//! Real sheets are bent for good where they are bent sharply. A fold of given angle lies on one element
//! or on several, as the mesh has it, so that none of them can tell by itself: what counts is the angle
//! along some length of the sheet. With φ that angle and φ_y the material's, a fold that is let go keeps
//! φ − φ_y; each element keeps its part of it. If the material hardens or weakens, φ_y grows by H for each angle that
//! the fold gives way by, see `wear`, so that of one folded for the first time (φ − φ_y) / (1 + H) stays.

use crate::math::columns::Columns;
use crate::math::trig::{asin, sin};
use crate::math::{max, min};
use crate::model::hardening::Hardening;
use crate::model::hinges::{Hinge, Hinges, normal};
use crate::model::material::Material;
use crate::model::plate_elements::{Each, PlateElements};
use glam::Vec3;

/// A fold counts over at least and at most so many elements in a row.
const LEAST: usize = 3;
const MOST_IN_A_ROW: usize = 128;

/// Angles below this are no folds [rad].
const TINY_ANGLE: f32 = 1.0e-3;

/// What elements are bent by at rest. Of a grid each kind has a list; of other meshes the first one is that
/// of its hinges.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Folds {
    /// Angles at rest [rad], …
    pub angle: Each<Vec<f32>>,
    /// … and what curvatures are by them [m].
    pub offset: Each<Vec<f32>>,
    /// Whether there is any.
    pub are_any: bool,
    /// How much folds have given way so far.
    pub wear: Hardening,
    /// How bent each particle of a grid is, or was at rest [rad].
    bent: Vec<f32>,
    /// What each particle's cells are to be twisted by more [rad].
    more: Vec<f32>,
    /// If that counts: how each particle of a grid or hinge rested before it gave way [rad], and what each hinge
    /// had given way by in all.
    was: Vec<[f32; 3]>,
    worn: Vec<f32>,
}

impl Folds {
    /// A grid's; all flat.
    pub fn of_plates(plates: &PlateElements) -> Self {
        let list = || vec![0.0; plates.count()];
        let each = || [list(), list(), list()];
        Self {
            angle: each(),
            offset: each(),
            bent: list(),
            more: list(),
            wear: Hardening::of(plates.count()),
            ..Self::default()
        }
    }

    /// Those of a mesh with these hinges.
    pub fn of_hinges(hinges: &Hinges) -> Self {
        let list = || vec![0.0; hinges.all.len()];
        Self {
            angle: [list(), Vec::new(), Vec::new()],
            offset: [list(), Vec::new(), Vec::new()],
            wear: Hardening::of(hinges.facets.count()),
            ..Self::default()
        }
    }

    /// Takes over angles from elsewhere; false if they do not fit.
    pub fn take_over(&mut self, angle: Each<Vec<f32>>, lengths: &Lengths<'_>) -> bool {
        let fits = |(own, new): (&Vec<f32>, &Vec<f32>)| {
            own.len() == new.len() && new.iter().all(|angle| angle.abs() <= MOST)
        };
        if angle.iter().all(Vec::is_empty) {
            return true;
        }
        if !self.angle.iter().zip(&angle).all(fits) {
            return false;
        }
        self.angle = angle;
        self.are_any = true;
        for kind in 0..3 {
            for at in 0..self.angle[kind].len() {
                self.bend(kind, at, self.angle[kind][at], lengths);
            }
        }
        true
    }

    /// Makes room for how much folds give way, if the material counts it.
    pub fn reserve_wear(&mut self, material: &Material) {
        self.wear.reserve(material);
        if material.wears() {
            self.was.resize(self.angle[0].len(), [0.0; 3]);
            self.worn.resize(if self.bent.is_empty() { self.angle[0].len() } else { 0 }, 0.0);
        }
    }

    /// The angles to keep; none if all is flat.
    pub fn kept(&self) -> Each<Vec<f32>> {
        if self.are_any { self.angle.clone() } else { Each::default() }
    }

    /// Sets an element's angle at rest.
    fn bend(&mut self, kind: usize, at: usize, angle: f32, lengths: &Lengths<'_>) {
        let angle = max(min(angle, MOST), -MOST);
        self.angle[kind][at] = angle;
        self.are_any |= angle != 0.0;
        let length = match lengths {
            Lengths::Grid(spacing) => *spacing,
            Lengths::Hinges(hinges) => hinges[at].length,
        };
        self.offset[kind][at] =
            if kind == 2 { length * angle } else { 2.0 * length * sin(f64::from(0.5 * angle)) };
    }

    /// Lets the folds of a grid follow where it is bent beyond what its material bears.
    pub fn yield_plates(
        &mut self,
        plates: &PlateElements,
        material: &Material,
        x: &Columns,
        normal: &Columns,
    ) {
        let yields = Yield::new(material, plates.spacing);
        let (columns, count) = (plates.columns, plates.count());
        let now = Now { plates, x, normal };
        let mut bent = core::mem::take(&mut self.bent);
        let mut is_any = false;
        for (at, bent) in bent.iter_mut().enumerate() {
            let (q, rest) = (now.tensor(at), self.tensor(plates, at));
            *bent = max(norm(q), norm(rest));
            is_any |= *bent > TINY_ANGLE;
            if material.wears() {
                self.was[at] = rest;
            }
        }
        if is_any {
            let mut gives_way = false;
            self.more.fill(0.0);
            for at in 0..count {
                if bent[at] > TINY_ANGLE {
                    gives_way |= self.yield_plate(&now, &yields, &bent, at);
                }
            }
            for at in 0..count - columns - 1 {
                let corners = [at, at + 1, at + columns, at + columns + 1];
                let more: f32 = corners.iter().map(|at| self.more[*at]).sum::<f32>() * 0.25;
                if more != 0.0 && plates.share[2][at] > 0.0 {
                    self.bend(2, at, self.angle[2][at] + more, &Lengths::Grid(plates.spacing));
                }
            }
            if gives_way && material.wears() {
                self.wear_plates(plates);
            }
        }
        self.bent = bent;
    }

    /// Takes note of how a grid rests, before it gives way.
    fn remember(&mut self, plates: &PlateElements) {
        for at in 0..plates.count() {
            self.was[at] = self.tensor(plates, at);
        }
    }

    /// Counts by how much a grid rests otherwise than it was.
    fn wear_plates(&mut self, plates: &PlateElements) {
        for at in 0..plates.count() {
            let (is, was) = (self.tensor(plates, at), self.was[at]);
            let by = norm([is[0] - was[0], is[1] - was[1], is[2] - was[2]]);
            self.wear.grow(at, by / plates.spacing);
        }
    }

    /// Lets the elements of a particle follow; whether they do.
    fn yield_plate(&mut self, now: &Now<'_>, yields: &Yield, bent: &[f32], at: usize) -> bool {
        let plates = now.plates;
        let (q, rest) = (now.tensor(at), self.tensor(plates, at));
        let larger = if norm(q) > norm(rest) { q } else { rest };
        let fold = sum_across(plates, yields.over, bent, larger, at);
        // This element's part of what the whole fold may give way by.
        let limit = yields.angle * bent[at] / max(fold, bent[at]);
        let limit = yields.harden(limit, self.wear.at(at) * plates.spacing);
        let Some(new) = yields.follow(q, rest, limit) else { return false };
        let lengths = Lengths::Grid(plates.spacing);
        for kind in 0..2 {
            if plates.share[kind][at] > 0.0 {
                self.bend(kind, at, new[kind], &lengths);
            }
        }
        self.more[at] = new[2] - rest[2];
        true
    }

    fn tensor(&self, plates: &PlateElements, at: usize) -> [f32; 3] {
        let of_kind = |kind: usize, at: usize| {
            if plates.share[kind][at] > 0.0 { self.angle[kind][at] } else { 0.0 }
        };
        [of_kind(0, at), of_kind(1, at), mean_twist(plates, at, |cell| self.angle[2][cell])]
    }

    /// Lets the folds at hinges follow where they are bent beyond what their material bears.
    pub fn yield_hinges(&mut self, hinges: &Hinges, material: &Material, mean: f32, x: &Columns) {
        let (wears, mut gives_way) = (material.wears(), false);
        if wears {
            self.remember_hinges(hinges);
        }
        let yields = Yield::new(material, mean);
        let over = max(material.fold_length, 3.0 * mean);
        for (at, hinge) in hinges.all.iter().enumerate() {
            let corners = hinge.at.map(|vertex| x.at(vertex as usize));
            let curve = hinge.curve(corners).dot(normal(corners)) - hinge.rest;
            let q = angle_of(curve / hinge.length);
            let worn = if wears { self.worn[at] } else { 0.0 };
            let limit = yields.harden(yields.angle * hinge.reach() / over, worn);
            let rest = self.angle[0][at];
            if let Some([new, ..]) = yields.follow([q, 0.0, 0.0], [rest, 0.0, 0.0], limit) {
                self.bend(0, at, new, &Lengths::Hinges(&hinges.all));
                gives_way = true;
            }
        }
        if gives_way && wears {
            self.wear_hinges(hinges);
        }
    }

    /// Takes note of how hinges rest before they give way, and of what each has given way by: half of what both its
    /// triangles have, over what a fold along it has of them.
    fn remember_hinges(&mut self, hinges: &Hinges) {
        for (was, rest) in self.was.iter_mut().zip(&self.angle[0]) {
            *was = [*rest, 0.0, 0.0];
        }
        self.worn.fill(0.0);
        for (triangle, own) in hinges.facets.hinges().enumerate() {
            let curve = 0.5 * self.wear.at(triangle);
            own.for_each(|hinge| self.worn[hinge] += curve * hinges.all[hinge].reach());
        }
    }

    /// Counts by how much triangles rest otherwise than they did.
    fn wear_hinges(&mut self, hinges: &Hinges) {
        for triangle in 0..hinges.facets.count() {
            let more = |hinge: usize| self.angle[0][hinge] - self.was[hinge][0];
            let by = hinges.facets.curve(triangle, &hinges.all, more);
            self.wear.grow(triangle, by);
        }
    }

    /// Adds a fold along a line of a grid, in the grid's own plane [m].
    pub fn crease_plates(&mut self, plates: &PlateElements, line: Line2, angle: f32, wears: bool) {
        if wears {
            self.remember(plates);
        }
        let (spacing, columns) = (plates.spacing, plates.columns);
        let lengths = Lengths::Grid(spacing);
        let ([nx, ny], width) = (line.normal, spacing * line.widest());
        for at in 0..plates.count() {
            let (row, column) = ((at / columns) as f32, (at % columns) as f32);
            let share = line.share([column * spacing, row * spacing], width, spacing);
            let center = [(column + 0.5) * spacing, (row + 0.5) * spacing];
            let of_cell = line.share(center, width, spacing);
            let whole = angle * spacing / width;
            let folds = [nx * nx * share, ny * ny * share, nx * ny * of_cell];
            for (kind, fold) in folds.into_iter().enumerate() {
                if fold != 0.0 && plates.share[kind][at] > 0.0 {
                    self.bend(kind, at, self.angle[kind][at] + whole * fold, &lengths);
                }
            }
        }
        if wears {
            self.wear_plates(plates);
        }
    }

    /// Adds a fold along a line of any mesh at rest [m]; `corners` are where each hinge's particles are.
    pub fn crease_hinges(
        &mut self,
        hinges: &Hinges,
        corners: impl Fn(&Hinge) -> [Vec3; 4],
        [from, to]: [Vec3; 2],
        width: f32,
        angle: f32,
        wears: bool,
    ) {
        if wears {
            self.remember_hinges(hinges);
        }
        let (length, along) = ((to - from).length(), (to - from).normalize_or_zero());
        for (at, hinge) in hinges.all.iter().enumerate() {
            let x = corners(hinge);
            let middle = (x[0] + x[1]) * 0.5 - from;
            let side = normal(x).cross(along).normalize_or_zero();
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
            let more = angle_of(curve / hinge.length);
            self.bend(0, at, self.angle[0][at] + more, &Lengths::Hinges(&hinges.all));
        }
        if wears {
            self.wear_hinges(hinges);
        }
    }
}

/// The most that an element is bent by at rest [rad]: a half turn would have no side.
const MOST: f32 = 3.0;

/// The length of each element, over which its curvature is an angle.
pub(crate) enum Lengths<'a> {
    Grid(f32),
    Hinges(&'a [Hinge]),
}

/// A line on a grid's plane: where it starts, which way it goes and how far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line2 {
    pub from: [f32; 2],
    pub along: [f32; 2],
    pub normal: [f32; 2],
    pub length: f32,
}

impl Line2 {
    /// From one point to another that is apart from it.
    pub fn new(from: [f32; 2], to: [f32; 2]) -> Self {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let along = [dx / length, dy / length];
        Self { from, along, normal: [-along[1], along[0]], length }
    }

    fn widest(&self) -> f32 {
        max(self.normal[0].abs(), self.normal[1].abs())
    }

    /// How much of a fold belongs to a point: 1 on the line, 0 from `width` on, or beyond its ends.
    fn share(&self, [x, y]: [f32; 2], width: f32, spacing: f32) -> f32 {
        let (dx, dy) = (x - self.from[0], y - self.from[1]);
        let ahead = dx * self.along[0] + dy * self.along[1];
        let off = dx * self.normal[0] + dy * self.normal[1];
        let is_beside = ahead >= -0.5 * spacing && ahead <= self.length + 0.5 * spacing;
        if is_beside { max(1.0 - off.abs() / width, 0.0) } else { 0.0 }
    }
}

/// When and how far folds follow.
struct Yield {
    angle: f32,
    keeps: f32,
    hardens: f32,
    /// Elements in a row that count as one fold.
    over: usize,
}

impl Yield {
    fn new(material: &Material, spacing: f32) -> Self {
        let over = (material.fold_length / spacing + 1.0) as usize;
        Self {
            angle: material.yield_angle,
            keeps: material.yield_creep,
            hardens: material.hardens(),
            over: over.clamp(LEAST, MOST_IN_A_ROW),
        }
    }

    /// How far an element bends and still opens, of which that is `limit` before it has given way by `worn`.
    fn harden(&self, limit: f32, worn: f32) -> f32 {
        if worn > 0.0 { limit + self.hardens * worn } else { limit }
    }

    /// What the angle at rest becomes; nothing if it stays. The limit grows with what this adds to it.
    fn follow(&self, q: [f32; 3], rest: [f32; 3], limit: f32) -> Option<[f32; 3]> {
        let by = [q[0] - rest[0], q[1] - rest[1], q[2] - rest[2]];
        let (strain, size) = (norm(by), norm(q));
        if strain <= limit {
            return None;
        }
        let grows = 1.0 + self.keeps * self.hardens;
        if dot(by, q) > 0.0 {
            // Folded more: it keeps a share of all that is beyond the limit, and no less than before.
            if size <= limit {
                return None;
            }
            let kept = self.keeps * (size - limit) - dot(rest, q) / size;
            let share = kept / (size * grows);
            return (kept > 0.0).then(|| core::array::from_fn(|k| rest[k] + q[k] * share));
        }
        let share = self.keeps * (1.0 - limit / strain) / grows;
        Some(core::array::from_fn(|k| rest[k] + by[k] * share))
    }
}

/// The angle of a fold whose curvature is so much over its length.
fn angle_of(curve: f32) -> f32 {
    if curve.abs() < 0.25 {
        let square = curve * curve;
        return curve * (1.0 + square * (1.0 / 24.0 + square * (3.0 / 640.0)));
    }
    2.0 * asin(max(min(0.5 * curve, 1.0), -1.0))
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + 2.0 * (a[2] * b[2])
}

fn norm(q: [f32; 3]) -> f32 {
    dot(q, q).sqrt()
}

/// A grid as it is bent now.
struct Now<'a> {
    plates: &'a PlateElements,
    x: &'a Columns,
    normal: &'a Columns,
}

impl Now<'_> {
    fn tensor(&self, at: usize) -> [f32; 3] {
        let plates = self.plates;
        let n = self.normal.at(at);
        let over = 1.0 / plates.spacing;
        let along = |kind: usize, step: usize| {
            if plates.share[kind][at] == 0.0 {
                return 0.0;
            }
            let curve = self.x.at(at - step) + self.x.at(at + step) - self.x.at(at) * 2.0;
            angle_of(curve.dot(n) * over)
        };
        let twist = mean_twist(plates, at, |cell| {
            let x = |at: usize| self.x.at(at);
            let below = cell + plates.columns;
            ((x(cell) - x(cell + 1)) - (x(below) - x(below + 1))).dot(n) * over
        });
        [along(0, 1), along(1, plates.columns), twist]
    }
}

/// The mean over the cells around a particle.
fn mean_twist(plates: &PlateElements, at: usize, of: impl Fn(usize) -> f32) -> f32 {
    let (row, column) = (at / plates.columns, at % plates.columns);
    let (mut sum, mut count) = (0.0, 0.0);
    for (up, left) in [(1, 1), (1, 0), (0, 1), (0, 0)] {
        if row >= up && column >= left {
            let cell = at - up * plates.columns - left;
            if plates.share[2][cell] > 0.0 {
                (sum, count) = (sum + of(cell), count + 1.0);
            }
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

/// The angle of the fold that goes through a particle: what its row or column has of it, whichever it crosses
/// more squarely, as a fold square to it would have.
fn sum_across(plates: &PlateElements, over: usize, bent: &[f32], q: [f32; 3], at: usize) -> f32 {
    let columns = plates.columns;
    let (row, column) = (at / columns, at % columns);
    let (weft, warp) = (q[0].abs(), q[1].abs());
    let both = weft + warp;
    let (place, last, step, main) = if weft >= warp {
        (column, columns - 1, 1, weft)
    } else {
        (row, plates.rows - 1, columns, warp)
    };
    let squarely = if both > 0.0 { (main / both).sqrt() } else { 1.0 };
    let (before, behind) = (place.min(over - 1), (last - place).min(over - 1));
    let first = at - before * step;
    let of = |k: usize| bent[first + k * step];
    let count = before + behind + 1;
    // The most that a stretch of this length has that the particle is in.
    let mut sum: f32 = (0..count.min(over)).map(of).sum();
    let mut most = sum;
    for k in over..count {
        sum += of(k) - of(k - over);
        most = max(most, sum);
    }
    most * squarely
}
