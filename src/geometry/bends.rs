//! How much a surface with flat faces bends at its edges and vertices, and what that means for the
//! chords of a cloth that lies on it.
//!
//! Reads and writes nothing else.
//! Invariant: a bend of angle 0 lets in no chord.

use glam::Vec3;

/// How much a surface bends at a feature.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SurfaceBend {
    /// The exterior dihedral angle as the length of the difference of the two face normals: nearly
    /// the angle [rad] if that is small.
    pub angle: f32,
    /// The angle divided by the width of the narrower face: a discrete curvature [1/m].
    pub curvature: f32,
}

/// The diameter of the circle around a face in widths of the face: between that of an equilateral
/// triangle, 1.33, and that of a square cut in two, 1.41 to 2.
const FACE_SIZE: f32 = 1.5;

/// A vertex with at least this many edges counts as the pole of a fan.
pub(crate) const POLE_EDGES: usize = 8;

impl SurfaceBend {
    /// At the pole of a fan, widens the largest bend of the edges to the bend between opposite faces.
    /// Neighbouring faces of a fan are narrow, so the angles between them are small. `normals` has a face
    /// normal for each edge; zero at an edge whose faces lie in one plane.
    pub fn widen_at_pole(&mut self, outward: Vec3, normals: impl ExactSizeIterator<Item = Vec3>) {
        if normals.len() < POLE_EDGES {
            return;
        }
        for normal in normals {
            // The normals of two edges may point to different sides.
            let cosine = normal.dot(outward).abs();
            if cosine > 0.0 {
                self.angle = self.angle.max(2.0 * (2.0 - 2.0 * cosine).max(0.0).sqrt());
            }
        }
    }

    /// Widens the bend of an edge to that of the pole where it ends, unless its faces lie in one plane.
    /// A cloth edge over the pole touches two such edges.
    pub fn widen_to(&mut self, pole: Self) {
        if self.angle > 0.0 {
            self.angle = self.angle.max(pole.angle);
        }
    }

    /// Returns how much farther from the faces the ends of a chord of `length` [m] must be, so that
    /// its middle stays as far from the surface as they are [m].
    ///
    /// ```text
    /// one bend in the middle: angle L / 4    many, close together: curvature (L² + F²) / 8
    /// ```
    /// With many bends the ends may lie over the middles of faces, which are lower than the edges
    /// by the sagitta of the size F of a face.
    pub fn sagitta(&self, length: f32) -> f32 {
        let one = self.angle * length * 0.25;
        let face = self.face_size();
        let face = if face < length { face } else { length };
        let many = self.curvature * (length * length + face * face) * 0.125;
        if one > many { one } else { many }
    }

    /// Returns the longest chord with at most this sagitta [m]; infinity for a plane.
    pub fn longest_chord(&self, sagitta: f32) -> f32 {
        if self.angle <= 0.0 {
            return f32::INFINITY;
        }
        let one = sagitta * 4.0 / self.angle;
        let face = self.face_size();
        let both2 = sagitta * 8.0 / self.curvature;
        let many2 = both2 - face * face;
        let many2 = if many2 > face * face { many2 } else { both2 * 0.5 };
        if one * one < many2 { one } else { many2.sqrt() }
    }

    /// Returns the diameter of the circle around a face between such bends [m].
    fn face_size(&self) -> f32 {
        FACE_SIZE * self.angle / self.curvature
    }

    /// Takes the larger angle and the larger curvature of both.
    pub fn merge(&mut self, other: Self) {
        self.angle = self.angle.max(other.angle);
        self.curvature = self.curvature.max(other.curvature);
    }
}

/// The bends of a shape, in buckets by their angle: each bucket holds the largest angle and the
/// largest curvature of its bends.
#[derive(Clone, Debug)]
pub(crate) struct BendHistogram([SurfaceBend; BUCKETS]);

/// Two buckets per octave.
const BUCKETS: usize = 32;

/// All angles below two to the power of minus this are in the first bucket.
const MIN_EXPONENT: u32 = 16;

impl Default for BendHistogram {
    fn default() -> Self {
        Self([SurfaceBend::default(); BUCKETS])
    }
}

impl BendHistogram {
    /// Merges a bend into its bucket.
    pub fn insert(&mut self, bend: SurfaceBend) {
        // The exponent and the first bit of the mantissa.
        let bucket = (bend.angle.to_bits() >> 22).saturating_sub(2 * (127 - MIN_EXPONENT)) as usize;
        self.0[bucket.min(BUCKETS - 1)].merge(bend);
    }

    /// Returns the largest bend at which a chord of `length` [m] lies at most `sagitta` [m] below
    /// the surface.
    pub fn largest_within(&self, length: f32, sagitta: f32) -> SurfaceBend {
        let mut largest = SurfaceBend::default();
        let is_within = |bend: &&SurfaceBend| bend.sagitta(length) <= sagitta;
        self.0.iter().filter(is_within).for_each(|bend| largest.merge(*bend));
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_chord_has_the_sagitta_that_it_was_asked_for() {
        // One bend, bends closer together than the chord, and faces as wide as the chord.
        for (angle, curvature, sagitta) in [(0.2, 0.1, 0.004), (0.05, 8.0, 0.02), (0.2, 3.3, 0.004)]
        {
            let bend = SurfaceBend { angle, curvature };
            let found = bend.sagitta(bend.longest_chord(sagitta));
            assert!((found / sagitta - 1.0).abs() < 1.0e-4, "{bend:?}: {found} m");
        }
        assert_eq!(SurfaceBend::default().longest_chord(0.001), f32::INFINITY);
    }

    #[test]
    fn many_bends_close_together_count_the_size_of_their_faces() {
        let bend = SurfaceBend { angle: 0.2, curvature: 10.0 };
        let [chord, face] = [0.1_f32, 0.03];
        let expected = 10.0 / 8.0 * (chord * chord + face * face);
        assert!((bend.sagitta(chord) - expected).abs() < 1.0e-6, "{}", bend.sagitta(chord));
    }

    #[test]
    fn the_histogram_gives_the_largest_bends_within_a_sagitta() {
        let mut bends = BendHistogram::default();
        for angle in [0.01, 0.1, 0.125, 0.5, 1.5] {
            bends.insert(SurfaceBend { angle, curvature: angle * 8.0 });
        }
        let largest = bends.largest_within(0.1, 0.004);
        assert_eq!((largest.angle, largest.curvature), (0.125, 1.0));
        assert_eq!(bends.largest_within(0.1, 0.0001).angle, 0.0);
        // Many bends close together let a chord in farther than one.
        bends.insert(SurfaceBend { angle: 0.01, curvature: 9.0 });
        assert_eq!(bends.largest_within(0.1, 0.004).angle, 0.125);
        assert_eq!(bends.largest_within(0.1, 0.004).curvature, 1.0);
    }
}
