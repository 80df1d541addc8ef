//! Hinge: bending across one inner edge of a triangle mesh.
//!
//! ```text
//!      a           C = Σ wᵢ xᵢ over the four particles, with cotangents of the angles at edge pq
//!    ╱   ╲         as weights: a vector that is zero while both triangles are in one plane
//!   p ─── q
//!    ╲   ╱         energy ½ D k |C|², k = 3 / area
//!      b
//! ```
//! Bergou et al., "A quadratic bending model for inextensible surfaces", SGP 2006. The weights are
//! those at rest, so the energy is quadratic in the positions.
//!
//! Invariant: Σ wᵢ = 0, so rigid motions store no energy.
use glam::Vec3;

/// A rest curvature below this share of the edge length counts as flat.
const MAX_FLAT_CURVATURE: f32 = 1.0e-4;

/// Response of a hinge to the curvature of a surface: |C| per curvature along its edge, across it,
/// and per twist.
pub(crate) type CurvatureResponse = [f32; 3];

/// One hinge.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hinge {
    /// Particles: p and q at the ends of the edge, a and b opposite it.
    pub particles: [u32; 4],
    /// Weight of each in C.
    pub weight: [f32; 4],
    /// Energy divided by ½ D |C|², for a hinge that is solved alone [1/m²].
    pub shape: f32,
    /// C at rest, along the hinge normal [m].
    pub rest: f32,
    /// Length of the edge, and width of the strip across it that belongs to the hinge [m].
    pub length: f32,
    pub width: f32,
}

impl Hinge {
    /// The curvature vector C at positions `x` [m].
    pub fn curvature(&self, x: [Vec3; 4]) -> Vec3 {
        let [p, q, a, b] = self.weight;
        x[0] * p + x[1] * q + x[2] * a + x[3] * b
    }

    /// Width of sheet that bends like this hinge when a fold runs along it [m].
    pub fn fold_width(&self) -> f32 {
        1.5 * self.width
    }

    /// Creates the hinge between two triangles from their rest positions [m]; `None` if one has no
    /// area.
    ///
    /// Also returns the energies of a cylinder, averaged over its directions, in this hinge and in
    /// the exact sheet, both divided by ½ D κ², and the response to curvature.
    pub fn between_triangles(
        particles: [u32; 4],
        [p, q, a, b]: [Vec3; 4],
    ) -> Option<(Self, [f32; 2], CurvatureResponse)> {
        let edge = q - p;
        let length = edge.length();
        let doubled = |c: Vec3| edge.cross(c - p).length();
        let (area_a, area_b) = (doubled(a), doubled(b));
        let least = 1.0e-6 * length * length;
        if !(area_a > least && area_b > least) {
            return None;
        }
        let cotangents = |c: Vec3, doubled: f32| {
            let along = edge.dot(c - p);
            [along / doubled, (length * length - along) / doubled]
        };
        let ([pa, qa], [pb, qb]) = (cotangents(a, area_a), cotangents(b, area_b));
        let weight = [qa + qb, pa + pb, -pa - qa, -pb - qb];
        let area = 0.5 * (area_a + area_b);
        let shape = 3.0 / area;
        let curvature = p * weight[0] + q * weight[1] + a * weight[2] + b * weight[3];
        let bent = curvature.dot(hinge_normal([p, q, a, b]));
        let rest = if bent.abs() > MAX_FLAT_CURVATURE * length { bent } else { 0.0 };
        // Positions in the unfolded plane, with the edge along x.
        let unfold = |c: Vec3, doubled: f32| (edge.dot(c - p) / length, doubled / length);
        let ((ax, ay), (bx, by)) = (unfold(a, area_a), unfold(b, area_b));
        let corners = [(0.0, 0.0), (length, 0.0), (ax, ay), (bx, -by)];
        let mut sums = [0.0; 3];
        for ((x, y), weight) in corners.into_iter().zip(weight) {
            let terms = [x * x + y * y, x * x - y * y, x * y];
            sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += weight * term);
        }
        let [round, across, twist] = sums;
        let mean = 0.25 * (0.25 * round * round + 0.125 * across * across + 0.5 * twist * twist);
        let width = (area_a + area_b) / (3.0 * length);
        let hinge = Self { particles, weight, shape, rest, length, width };
        let shows = [0.25 * (round + across), 0.25 * (round - across), twist];
        Some((hinge, [shape * mean, area / 3.0], shows))
    }
}

/// The direction in which C points for a positive bend: perpendicular to the edge and to a − b;
/// zero if undefined.
#[inline(always)]
pub(crate) fn hinge_normal([p, q, a, b]: [Vec3; 4]) -> Vec3 {
    let across = (q - p).cross(a - b);
    let length = across.length();
    if length > 1.0e-20 { across * (1.0 / length) } else { Vec3::ZERO }
}
