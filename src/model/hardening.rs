//! Hardening: by how much the folds of a sheet have given way so far, to either side.
//!
//! With A the angle that a fold has given way by in all, h and k the material's hardening and weakening, and ℓ
//! its fold length, what the fold turns by under a moment m, and the angle up to which it opens again, become
//!
//! ```text
//! m ℓ / D · (1 + k A),    φ_y (1 + k A) + h A
//! ```
//! The first is a stiffness over 1 + k times what gave way, as Narain, Pfaff and O'Brien have it ("Folding and
//! crumpling adaptive sheets", SIGGRAPH 2013; they count it in yield curvatures, ours are radians). In the second,
//! h A is linear hardening (Simo and Hughes, "Computational Inelasticity", 1998, 1.2), and k A is there because what is
//! weaker gives way under the same moment as before: if it took less, all of a fold would be drawn to one element,
//! and depend on the mesh. What is counted is curvature, whose sum over the width of a fold is A however it is
//! spread: at a curvature κ in all, the stiffness is that of the sheet over 1 + k ℓ κ, to all sides alike.

use crate::math::{max, min};
use crate::model::material::Material;
use crate::model::plate_elements::PerKind;

/// What is left of a stiffness at least.
const MIN_STIFFNESS_SCALE: f32 = 1.0e-3;

/// What is counted at most [1/m], so that sums stay numbers.
const MAX_CURVATURE: f32 = 1.0e30;

/// By how much the sheet has been bent for good so far, at each particle of a grid or triangle of another mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Hardening {
    /// Curvatures, all that were added or taken away [1/m]; none until a material counts them.
    curvature: Vec<f32>,
    /// How many there are to be.
    count: usize,
    /// Whether there is any.
    pub is_any: bool,
    /// How often any grew.
    revision: u32,
}

impl Hardening {
    /// None yet, of so many.
    pub fn new(count: usize) -> Self {
        Self { count, ..Self::default() }
    }

    /// Makes room, if the material counts it.
    pub fn reserve(&mut self, material: &Material) {
        if material.tracks_hardening() {
            self.curvature.resize(self.count, 0.0);
        }
    }

    /// Takes over what there was; false if that does not fit.
    pub fn restore(&mut self, curvature: Vec<f32>) -> bool {
        let is_sound = curvature.iter().all(|curvature| curvature.is_finite() && *curvature >= 0.0);
        self.is_any = !curvature.is_empty();
        let fits = !self.is_any || curvature.len() == self.count;
        self.curvature = curvature;
        is_sound && fits
    }

    /// What to keep; none if nothing has given way.
    pub fn saved(&self) -> &[f32] {
        if self.is_any { &self.curvature } else { &[] }
    }

    /// What there is in one place [1/m].
    pub fn at(&self, at: usize) -> f32 {
        self.curvature.get(at).copied().unwrap_or(0.0)
    }

    /// One place is bent for good by so much more or less [1/m].
    pub fn add(&mut self, at: usize, factor: f32) {
        if factor > 0.0 && factor.is_finite() {
            self.curvature[at] = min(self.curvature[at] + factor, MAX_CURVATURE);
            self.is_any = true;
            self.revision = self.revision.wrapping_add(1);
        }
    }

    /// How much softer that makes it; nothing if it does not.
    pub fn softening(&self, material: &Material) -> Option<Softening<'_>> {
        let factor = material.yield_weakening * material.fold_length;
        let is_softer = self.is_any && factor > 0.0;
        is_softer.then_some(Softening {
            curvature: &self.curvature,
            factor,
            revision: self.revision,
        })
    }
}

/// How much softer the sheet is by what gave way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Softening<'a> {
    /// What gave way in each place [1/m].
    pub curvature: &'a [f32],
    factor: f32,
    revision: u32,
}

impl Softening<'_> {
    /// What changes whenever any of it does.
    pub fn key(&self) -> (u32, f32) {
        (self.revision, self.factor)
    }

    /// What is left of the stiffness where so much gave way.
    pub fn stiffness_scale(&self, curvature: f32) -> f32 {
        if curvature > 0.0 {
            max(1.0 / (1.0 + self.factor * curvature), MIN_STIFFNESS_SCALE)
        } else {
            1.0
        }
    }

    /// Takes off how stiff the elements of a grid are what they are softer by: of a cell the mean of its corners.
    pub fn apply(&self, columns: usize, [weft, warp, twist]: &mut PerKind<Vec<f32>>) {
        let curvature = self.curvature;
        for ((weft, warp), curvature) in weft.iter_mut().zip(warp).zip(curvature) {
            let stiffness_scale = self.stiffness_scale(*curvature);
            (*weft, *warp) = (*weft * stiffness_scale, *warp * stiffness_scale);
        }
        let upper = curvature.iter().zip(&curvature[1..]);
        let lower = curvature[columns..].iter().zip(&curvature[columns + 1..]);
        for (twist, ((a, b), (c, d))) in twist.iter_mut().zip(upper.zip(lower)) {
            *twist *= self.stiffness_scale(((a + b) + (c + d)) * 0.25);
        }
    }
}
