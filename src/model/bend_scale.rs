//! Scales of the bending stiffness: what plastic bending left of it, times the painted map.
//!
//! ```text
//! weft, warp element at a particle    softening of the particle · scale of the particle
//! twist element of a cell             softening of the cell · mean scale of its corners
//! bending element of a triangle       softening of the triangle · mean scale of its corners
//! ```
//! Reads `Hardening`, `Material` and `Maps`; multiplies stiffnesses.
//!
//! Invariant: equal keys give equal scales, so a solver may keep what it computed from them.

use crate::math::min;
use crate::model::hardening::{Hardening, Softening};
use crate::model::maps::{Map, Maps, mean};
use crate::model::material::Material;
use crate::model::plate_elements::PerKind;

/// Smaller painted scales count as 0, so that compliances stay finite.
const NEGLIGIBLE_SCALE: f32 = 1.0e-6;

/// Scales of one cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BendScale<'a> {
    /// Loss of stiffness by plastic bending, if any.
    softening: Option<Softening<'a>>,
    /// Painted scale of each particle; `None` if all are 1.
    painted: Option<&'a [f32]>,
    /// Counter of changes of the maps, 0 without painted scales.
    revision: u32,
    /// Largest painted scale that acts; larger ones count as this.
    largest: f32,
}

/// Changes whenever the scales may have changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BendScaleKey {
    softening: Option<(u32, f32)>,
    revision: u32,
    largest: f32,
}

impl<'a> BendScale<'a> {
    /// Combines both scales. Painted scales act up to `limit`.
    pub fn new(hardening: &'a Hardening, material: &Material, maps: &'a Maps, limit: f32) -> Self {
        let softening = hardening.softening(material);
        let painted = maps.get(Map::Bend);
        let [_, largest] = maps.range(Map::Bend);
        let (revision, largest) =
            if painted.is_some() { (maps.revision, min(limit, largest)) } else { (0, 1.0) };
        Self { softening, painted, revision, largest }
    }

    pub fn key(&self) -> BendScaleKey {
        let softening = self.softening.map(|softening| softening.key());
        BendScaleKey { softening, revision: self.revision, largest: self.largest }
    }

    /// Largest painted scale; 1 without a map.
    pub fn largest(&self) -> f32 {
        self.largest
    }

    /// Whether all scales are 1.
    pub fn is_one(&self) -> bool {
        self.softening.is_none() && self.painted.is_none()
    }

    /// Painted scale between some particles.
    #[inline(never)]
    pub fn painted(&self, particles: &[u32]) -> f32 {
        self.painted.map_or(1.0, |scales| {
            let scale = min(mean(scales, particles), self.largest);
            if scale < NEGLIGIBLE_SCALE { 0.0 } else { scale }
        })
    }

    /// Scale of an element with an entry of accumulated curvature, between some particles.
    pub fn of_element(&self, curvature: usize, particles: &[u32]) -> f32 {
        let painted = self.painted(particles);
        match self.softening {
            Some(softening) => softening.stiffness_scale(softening.curvature[curvature]) * painted,
            None => painted,
        }
    }

    /// Multiplies the stiffness of the plate elements of a grid.
    #[inline(never)]
    pub fn apply(&self, columns: usize, weight: &mut PerKind<Vec<f32>>) {
        if let Some(softening) = self.softening {
            softening.apply(columns, weight);
        }
        if self.painted.is_none() {
            return;
        }
        let (below, [weft, warp, twist]) = (columns as u32, weight);
        self.scale_elements(weft, &[0]);
        self.scale_elements(warp, &[0]);
        self.scale_elements(twist, &[0, 1, below, below + 1]);
    }

    /// Multiplies the stiffness of elements by the painted scale between the particles at `offsets`
    /// from the element's own.
    #[inline(never)]
    fn scale_elements(&self, weight: &mut [f32], offsets: &[u32]) {
        for (at, weight) in (0..).zip(weight) {
            let mut corners = [at; 4];
            corners.iter_mut().zip(offsets).for_each(|(corner, offset)| *corner += offset);
            if *weight > 0.0 {
                *weight *= self.painted(&corners[..offsets.len()]);
            }
        }
    }
}
