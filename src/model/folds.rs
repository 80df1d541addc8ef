//! Folds (plastic bending): the rest angle of each plate element or hinge.
//!
//! A fold is permanent if it is sharper than the material's yield angle φ_y. Depending on the mesh,
//! a fold of given angle lies on one element or on several, so the yield test uses the total angle
//! within a length of sheet (`fold_length`), not the angle of one element. A fold of angle φ keeps
//! φ − φ_y after it is released, and each element keeps its part of that. With hardening, φ_y grows
//! by H per radian of plastic angle, see `hardening`, so that a first fold keeps (φ − φ_y) / (1 +
//! H).
//!
//! Reads positions, normals and `Material`; writes rest angles, offsets and `Hardening`.
//!
//! Invariants: |angle| ≤ `MAX_ANGLE`; `offset` follows from `angle`.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::trig::{asin, sin};
use crate::math::{max, min};
use crate::model::hardening::Hardening;
use crate::model::hinge::{Hinge, hinge_normal};
use crate::model::hinges::Hinges;
use crate::model::material::Material;
use crate::model::plate_elements::{PerKind, PlateElements};

/// Minimum and maximum number of consecutive elements over which a fold counts.
const MIN_FOLD_ELEMENTS: usize = 3;
const MAX_FOLD_ELEMENTS: usize = 128;

/// Angles below this are not folds [rad].
const TINY_ANGLE: f32 = 1.0e-3;

/// Rest angles of all elements. A grid has a list per kind; for another mesh the first list holds
/// its hinges. The lists are empty until `reserve`, as if all angles were 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Folds {
    /// Rest angles [rad].
    pub angle: PerKind<Vec<f32>>,
    /// Rest curvatures that follow from them: lengths along the normal [m].
    pub offset: PerKind<Vec<f32>>,
    /// Number of elements of each kind.
    counts: PerKind<usize>,
    /// Whether any angle is not 0.
    pub has_any: bool,
    /// Plastic curvature accumulated so far.
    pub hardening: Hardening,
    /// Scratch: larger of current and rest angle of each grid particle [rad].
    bent: Vec<f32>,
    /// Scratch: increment of the rest twist of the cells around each particle [rad].
    twist_increment: Vec<f32>,
    /// Scratch for hardening: rest angles before yielding, per grid particle or hinge [rad], and
    /// the plastic angle accumulated per hinge [rad].
    previous_rest: Vec<[f32; 3]>,
    hinge_hardening: Vec<f32>,
}

heap_bytes!(
    Folds {
        angle, offset, hardening, bent, twist_increment, previous_rest, hinge_hardening,
    } plain { counts, has_any }
);

impl Folds {
    /// The folds of a flat grid.
    pub fn of_plates(plates: &PlateElements) -> Self {
        let count = plates.count();
        Self { counts: [count; 3], hardening: Hardening::new(count), ..Self::default() }
    }

    /// The folds of a mesh with these hinges, all unbent.
    pub fn of_hinges(hinges: &Hinges) -> Self {
        Self {
            counts: [hinges.all.len(), 0, 0],
            hardening: Hardening::new(hinges.elements.count()),
            ..Self::default()
        }
    }

    /// Returns whether the lists have an entry per element.
    pub fn is_allocated(&self) -> bool {
        self.angle[0].len() == self.counts[0]
    }

    /// Allocates the lists, with zeros.
    pub fn reserve(&mut self) {
        for (lists, count) in [&mut self.angle, &mut self.offset].map(|lists| (lists, self.counts))
        {
            lists.iter_mut().zip(count).for_each(|(list, count)| list.resize(count, 0.0));
        }
        for list in [&mut self.bent, &mut self.twist_increment] {
            list.resize(self.counts[2], 0.0);
        }
    }

    /// Replaces the rest angles by saved ones. Returns false if they do not fit.
    pub fn restore_angles(
        &mut self,
        angle: PerKind<Vec<f32>>,
        lengths: &ElementLengths<'_>,
    ) -> bool {
        let fits = |(own, new): (&Vec<f32>, &Vec<f32>)| {
            own.len() == new.len() && new.iter().all(|angle| angle.abs() <= MAX_ANGLE)
        };
        if angle.iter().all(Vec::is_empty) {
            return true;
        }
        self.reserve();
        if !self.angle.iter().zip(&angle).all(fits) {
            return false;
        }
        self.angle = angle;
        self.has_any = true;
        for kind in 0..3 {
            for at in 0..self.angle[kind].len() {
                self.set_angle(kind, at, self.angle[kind][at], lengths);
            }
        }
        true
    }

    /// Allocates for hardening, if the material uses it.
    pub fn reserve_hardening(&mut self, material: &Material) {
        self.hardening.reserve(material);
        if material.tracks_hardening() {
            self.reserve();
            self.previous_rest.resize(self.angle[0].len(), [0.0; 3]);
            self.hinge_hardening
                .resize(if self.bent.is_empty() { self.angle[0].len() } else { 0 }, 0.0);
        }
    }

    /// The angles for a save; empty if all are 0.
    pub fn saved_angles(&self) -> PerKind<Vec<f32>> {
        if self.has_any { self.angle.clone() } else { PerKind::default() }
    }

    /// Sets the rest angle of an element, clamped to ±`MAX_ANGLE`, and its offset.
    pub(super) fn set_angle(
        &mut self,
        kind: usize,
        at: usize,
        angle: f32,
        lengths: &ElementLengths<'_>,
    ) {
        let angle = max(min(angle, MAX_ANGLE), -MAX_ANGLE);
        self.angle[kind][at] = angle;
        self.has_any |= angle != 0.0;
        let length = match lengths {
            ElementLengths::Grid(spacing) => *spacing,
            ElementLengths::Hinges(hinges) => hinges[at].length,
        };
        self.offset[kind][at] =
            if kind == 2 { length * angle } else { 2.0 * length * sin(f64::from(0.5 * angle)) };
    }

    /// Updates the rest angles of a grid where it is bent beyond its yield limit.
    pub fn yield_plates(
        &mut self,
        plates: &PlateElements,
        material: &Material,
        x: &Columns,
        normal: &Columns,
    ) {
        let yield_rule = YieldRule::new(material, plates.spacing);
        let (columns, count) = (plates.columns, plates.count());
        let bent_grid = BentGrid { plates, x, normal };
        let mut bent = core::mem::take(&mut self.bent);
        let mut any_bent = false;
        for (at, bent) in bent.iter_mut().enumerate() {
            let (q, rest) = (bent_grid.tensor(at), self.tensor(plates, at));
            *bent = max(norm(q), norm(rest));
            any_bent |= *bent > TINY_ANGLE;
            if material.tracks_hardening() {
                self.previous_rest[at] = rest;
            }
        }
        if any_bent {
            let mut yields = false;
            self.twist_increment.fill(0.0);
            for at in 0..count {
                if bent[at] > TINY_ANGLE {
                    yields |= self.yield_plate(&bent_grid, &yield_rule, &bent, at);
                }
            }
            for at in 0..count - columns - 1 {
                let corners = [at, at + 1, at + columns, at + columns + 1];
                let twist_increment: f32 =
                    corners.iter().map(|at| self.twist_increment[*at]).sum::<f32>() * 0.25;
                if twist_increment != 0.0 && plates.area_fraction[2][at] > 0.0 {
                    self.set_angle(
                        2,
                        at,
                        self.angle[2][at] + twist_increment,
                        &ElementLengths::Grid(plates.spacing),
                    );
                }
            }
            if yields && material.tracks_hardening() {
                self.accumulate_plate_hardening(plates);
            }
        }
        self.bent = bent;
    }

    /// Stores the rest angles of a grid before it yields.
    pub(super) fn store_rest_angles(&mut self, plates: &PlateElements) {
        for at in 0..plates.count() {
            self.previous_rest[at] = self.tensor(plates, at);
        }
    }

    /// Adds the change of rest angles of a grid to the hardening.
    pub(super) fn accumulate_plate_hardening(&mut self, plates: &PlateElements) {
        for at in 0..plates.count() {
            let (new, old) = (self.tensor(plates, at), self.previous_rest[at]);
            let change = norm([new[0] - old[0], new[1] - old[1], new[2] - old[2]]);
            self.hardening.add(at, change / plates.spacing);
        }
    }

    /// Updates the elements of one particle; returns whether they yielded.
    fn yield_plate(
        &mut self,
        bent_grid: &BentGrid<'_>,
        yield_rule: &YieldRule,
        bent: &[f32],
        at: usize,
    ) -> bool {
        let plates = bent_grid.plates;
        let (q, rest) = (bent_grid.tensor(at), self.tensor(plates, at));
        let larger = if norm(q) > norm(rest) { q } else { rest };
        let fold = fold_angle(plates, yield_rule.fold_elements, bent, larger, at);
        // The part of the whole fold's limit that falls to this element.
        let limit = yield_rule.angle * bent[at] / max(fold, bent[at]);
        let limit = yield_rule.hardened_limit(limit, self.hardening.get(at) * plates.spacing);
        let Some(new) = yield_rule.yielded_rest(q, rest, limit) else { return false };
        let lengths = ElementLengths::Grid(plates.spacing);
        for kind in 0..2 {
            if plates.area_fraction[kind][at] > 0.0 {
                self.set_angle(kind, at, new[kind], &lengths);
            }
        }
        self.twist_increment[at] = new[2] - rest[2];
        true
    }

    /// Rest angles of a particle along weft and warp, and mean twist of its cells.
    fn tensor(&self, plates: &PlateElements, at: usize) -> [f32; 3] {
        let of_kind = |kind: usize, at: usize| {
            if plates.area_fraction[kind][at] > 0.0 { self.angle[kind][at] } else { 0.0 }
        };
        [of_kind(0, at), of_kind(1, at), mean_twist(plates, at, |cell| self.angle[2][cell])]
    }

    /// Updates the rest angles of hinges that are bent beyond their yield limit. `mean` is the mean
    /// edge length [m].
    pub fn yield_hinges(&mut self, hinges: &Hinges, material: &Material, mean: f32, x: &Columns) {
        let (tracks_hardening, mut yields) = (material.tracks_hardening(), false);
        if tracks_hardening {
            self.store_hinge_state(hinges);
        }
        let yield_rule = YieldRule::new(material, mean);
        let fold_length = max(material.fold_length, 3.0 * mean);
        for (at, hinge) in hinges.all.iter().enumerate() {
            let corners = hinge.particles.map(|vertex| x.get(vertex as usize));
            let curve = hinge.curvature(corners).dot(hinge_normal(corners)) - hinge.rest;
            let q = angle_of(curve / hinge.length);
            let plastic_angle = if tracks_hardening { self.hinge_hardening[at] } else { 0.0 };
            let limit = yield_rule
                .hardened_limit(yield_rule.angle * hinge.fold_width() / fold_length, plastic_angle);
            let rest = self.angle[0][at];
            if let Some([new, ..]) = yield_rule.yielded_rest([q, 0.0, 0.0], [rest, 0.0, 0.0], limit)
            {
                self.set_angle(0, at, new, &ElementLengths::Hinges(&hinges.all));
                yields = true;
            }
        }
        if yields && tracks_hardening {
            self.accumulate_hinge_hardening(hinges);
        }
    }

    /// Stores the rest angles of hinges before they yield, and computes the plastic angle of each:
    /// the mean plastic curvature of its two triangles times its fold width.
    pub(super) fn store_hinge_state(&mut self, hinges: &Hinges) {
        for (previous_rest, rest) in self.previous_rest.iter_mut().zip(&self.angle[0]) {
            *previous_rest = [*rest, 0.0, 0.0];
        }
        self.hinge_hardening.fill(0.0);
        for (triangle, own) in hinges.elements.hinges().enumerate() {
            let curve = 0.5 * self.hardening.get(triangle);
            own.for_each(|hinge| {
                self.hinge_hardening[hinge] += curve * hinges.all[hinge].fold_width();
            });
        }
    }

    /// Adds the change of rest curvature of each triangle to the hardening.
    pub(super) fn accumulate_hinge_hardening(&mut self, hinges: &Hinges) {
        for triangle in 0..hinges.elements.count() {
            let change = |hinge: usize| self.angle[0][hinge] - self.previous_rest[hinge][0];
            let curvature = hinges.elements.curvature(triangle, &hinges.all, change);
            self.hardening.add(triangle, curvature);
        }
    }
}

/// Maximum rest angle [rad]; at a half turn the side would be undefined.
const MAX_ANGLE: f32 = 3.0;

/// Length of each element, over which its curvature is an angle [m].
pub(crate) enum ElementLengths<'a> {
    Grid(f32),
    Hinges(&'a [Hinge]),
}

/// Yield condition and flow rule.
struct YieldRule {
    angle: f32,
    creep: f32,
    hardening_rate: f32,
    /// Number of consecutive elements that count as one fold.
    fold_elements: usize,
}

impl YieldRule {
    fn new(material: &Material, spacing: f32) -> Self {
        let fold_elements = (material.fold_length / spacing + 1.0) as usize;
        Self {
            angle: material.yield_angle,
            creep: material.yield_creep,
            hardening_rate: material.effective_hardening(),
            fold_elements: fold_elements.clamp(MIN_FOLD_ELEMENTS, MAX_FOLD_ELEMENTS),
        }
    }

    /// The yield limit of an element after hardening by `plastic_angle` [rad].
    fn hardened_limit(&self, limit: f32, plastic_angle: f32) -> f32 {
        if plastic_angle > 0.0 { limit + self.hardening_rate * plastic_angle } else { limit }
    }

    /// The new rest angles, or `None` if the element stays elastic. `q` are the current angles,
    /// `rest` the rest angles. The limit grows with the plastic angle that this step adds.
    fn yielded_rest(&self, q: [f32; 3], rest: [f32; 3], limit: f32) -> Option<[f32; 3]> {
        let by = [q[0] - rest[0], q[1] - rest[1], q[2] - rest[2]];
        let (strain, size) = (norm(by), norm(q));
        if strain <= limit {
            return None;
        }
        let growth = 1.0 + self.creep * self.hardening_rate;
        if dot(by, q) > 0.0 {
            // Folded further: the element keeps a share of all that exceeds the limit, and never
            // less than before.
            if size <= limit {
                return None;
            }
            let permanent = self.creep * (size - limit) - dot(rest, q) / size;
            let share = permanent / (size * growth);
            return (permanent > 0.0).then(|| core::array::from_fn(|k| rest[k] + q[k] * share));
        }
        let share = self.creep * (1.0 - limit / strain) / growth;
        Some(core::array::from_fn(|k| rest[k] + by[k] * share))
    }
}

/// The fold angle whose curvature vector has the given length relative to the element, inverse of c
/// = 2 sin(θ/2).
pub(super) fn angle_of(curve: f32) -> f32 {
    if curve.abs() < 0.25 {
        let square = curve * curve;
        return curve * (1.0 + square * (1.0 / 24.0 + square * (3.0 / 640.0)));
    }
    2.0 * asin(max(min(0.5 * curve, 1.0), -1.0))
}

/// Product of two symmetric tensors (xx, yy, xy).
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + 2.0 * (a[2] * b[2])
}

/// Frobenius norm of a symmetric tensor (xx, yy, xy).
fn norm(q: [f32; 3]) -> f32 {
    dot(q, q).sqrt()
}

/// Current positions and normals of a grid.
struct BentGrid<'a> {
    plates: &'a PlateElements,
    x: &'a Columns,
    normal: &'a Columns,
}

impl BentGrid<'_> {
    fn tensor(&self, at: usize) -> [f32; 3] {
        let plates = self.plates;
        let n = self.normal.get(at);
        let inverse_spacing = 1.0 / plates.spacing;
        let along = |kind: usize, step: usize| {
            if plates.area_fraction[kind][at] == 0.0 {
                return 0.0;
            }
            let curve = self.x.get(at - step) + self.x.get(at + step) - self.x.get(at) * 2.0;
            angle_of(curve.dot(n) * inverse_spacing)
        };
        let twist = mean_twist(plates, at, |cell| {
            let x = |at: usize| self.x.get(at);
            let below = cell + plates.columns;
            ((x(cell) - x(cell + 1)) - (x(below) - x(below + 1))).dot(n) * inverse_spacing
        });
        [along(0, 1), along(1, plates.columns), twist]
    }
}

/// Mean over the cells around a particle.
fn mean_twist(plates: &PlateElements, at: usize, of: impl Fn(usize) -> f32) -> f32 {
    let (row, column) = (at / plates.columns, at % plates.columns);
    let (mut sum, mut count) = (0.0, 0.0);
    for (up, left) in [(1, 1), (1, 0), (0, 1), (0, 0)] {
        if row >= up && column >= left {
            let cell = at - up * plates.columns - left;
            if plates.area_fraction[2][cell] > 0.0 {
                (sum, count) = (sum + of(cell), count + 1.0);
            }
        }
    }
    if count > 0.0 { sum / count } else { 0.0 }
}

/// The angle of the fold through a particle [rad]: the largest sum over `fold_elements` consecutive
/// elements that include the particle. The elements lie along the row or along the column,
/// whichever is more nearly perpendicular to the fold. If it is not quite perpendicular, the sum is
/// reduced to the angle across the fold.
fn fold_angle(
    plates: &PlateElements,
    fold_elements: usize,
    bent: &[f32],
    q: [f32; 3],
    at: usize,
) -> f32 {
    let columns = plates.columns;
    let (row, column) = (at / columns, at % columns);
    let (weft, warp) = (q[0].abs(), q[1].abs());
    let both = weft + warp;
    let (position, last, step, main) = if weft >= warp {
        (column, columns - 1, 1, weft)
    } else {
        (row, plates.rows - 1, columns, warp)
    };
    let alignment = if both > 0.0 { (main / both).sqrt() } else { 1.0 };
    let (before, behind) =
        (position.min(fold_elements - 1), (last - position).min(fold_elements - 1));
    let first = at - before * step;
    let of = |k: usize| bent[first + k * step];
    let count = before + behind + 1;
    // Maximum over the windows of this length that contain the particle.
    let mut sum: f32 = (0..count.min(fold_elements)).map(of).sum();
    let mut largest_sum = sum;
    for k in fold_elements..count {
        sum += of(k) - of(k - fold_elements);
        largest_sum = max(largest_sum, sum);
    }
    largest_sum * alignment
}
