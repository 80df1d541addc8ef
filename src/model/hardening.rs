//! Hardening and weakening: plastic curvature accumulated by folds, in both directions.
//!
//! With A the plastic angle that a fold has accumulated, h and k the material's hardening and
//! weakening, and ℓ its fold length, the angle by which a moment m bends the fold and the yield
//! angle become
//!
//! ```text
//! m ℓ / D · (1 + k A),    φ_y (1 + k A) + h A
//! ```
//! The first divides the stiffness by 1 + k A as in Narain, Pfaff and O'Brien ("Folding and
//! crumpling adaptive sheets", SIGGRAPH 2013; they measure yield in curvatures, Muslin in radians).
//! In the second, h A is linear hardening (Simo and Hughes, "Computational Inelasticity", 1998,
//! 1.2). The term k A keeps the yield moment constant: if a weakened element yielded at a smaller
//! moment, the whole fold would concentrate in one element and depend on the mesh.
//!
//! The stored quantity is curvature, whose integral across the width of a fold is A, however wide
//! the fold is: at an accumulated curvature κ the stiffness of the sheet is divided by
//! 1 + k ℓ κ, in all directions.
//!
//! Reads `Material` and changes of rest angles (`folds`); writes accumulated curvatures.
//!
//! Invariant: curvatures are finite, not negative and never decrease.

use crate::math::heap_bytes::heap_bytes;
use crate::math::{max, min};
use crate::model::material::Material;
use crate::model::plate_elements::PerKind;

/// Minimum share of the stiffness that remains.
const MIN_STIFFNESS_SCALE: f32 = 1.0e-3;

/// Maximum accumulated curvature [1/m], so that sums stay finite.
const MAX_CURVATURE: f32 = 1.0e30;

/// Accumulated plastic curvature per grid particle, or per triangle of another mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Hardening {
    /// Accumulated curvature [1/m]; empty until a material uses it.
    curvature: Vec<f32>,
    /// Number of entries in use.
    count: usize,
    /// Whether any entry is not 0.
    pub has_any: bool,
    /// Counter of changes.
    revision: u32,
}

heap_bytes!(Hardening { curvature } plain { count, has_any, revision });

impl Hardening {
    /// No plastic curvature at `count` places.
    pub fn new(count: usize) -> Self {
        Self { count, ..Self::default() }
    }

    /// Allocates the entries, if the material uses them.
    pub fn reserve(&mut self, material: &Material) {
        if material.tracks_hardening() {
            self.curvature.resize(self.count, 0.0);
        }
    }

    /// Replaces the entries by saved ones. Returns false if they do not fit.
    pub fn restore(&mut self, curvature: Vec<f32>) -> bool {
        let are_valid =
            curvature.iter().all(|curvature| curvature.is_finite() && *curvature >= 0.0);
        self.has_any = !curvature.is_empty();
        let fits = !self.has_any || curvature.len() == self.count;
        self.curvature = curvature;
        are_valid && fits
    }

    /// The entries for a save; empty if there was no plastic bending.
    pub fn saved(&self) -> &[f32] {
        if self.has_any { &self.curvature } else { &[] }
    }

    /// The accumulated curvature at one place [1/m].
    pub fn get(&self, at: usize) -> f32 {
        self.curvature.get(at).copied().unwrap_or(0.0)
    }

    /// Adds plastic curvature at one place [1/m].
    pub fn add(&mut self, at: usize, curvature: f32) {
        if curvature > 0.0 && curvature.is_finite() {
            self.curvature[at] = min(self.curvature[at] + curvature, MAX_CURVATURE);
            self.has_any = true;
            self.revision = self.revision.wrapping_add(1);
        }
    }

    /// The loss of stiffness that follows; `None` if there is none.
    pub fn softening(&self, material: &Material) -> Option<Softening<'_>> {
        let factor = material.yield_weakening * material.fold_length;
        let is_softer = self.has_any && factor > 0.0;
        is_softer.then_some(Softening {
            curvature: &self.curvature,
            factor,
            revision: self.revision,
        })
    }
}

/// Loss of bending stiffness by accumulated plastic curvature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Softening<'a> {
    /// Accumulated curvature [1/m].
    pub curvature: &'a [f32],
    factor: f32,
    revision: u32,
}

impl Softening<'_> {
    /// A key that changes whenever the softening changes.
    pub fn key(&self) -> (u32, f32) {
        (self.revision, self.factor)
    }

    /// Remaining share of the stiffness at an accumulated curvature [1/m].
    pub fn stiffness_scale(&self, curvature: f32) -> f32 {
        if curvature > 0.0 {
            max(1.0 / (1.0 + self.factor * curvature), MIN_STIFFNESS_SCALE)
        } else {
            1.0
        }
    }

    /// Multiplies the stiffness of plate elements by their remaining share; a cell uses the mean of
    /// its corners.
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
