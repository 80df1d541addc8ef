//! Bend elements: rotation-free triangle elements that couple the hinges of each triangle of a
//! mesh.
//!
//! On a surface of height ½ xᵀ S x the curvature tensor S has three numbers. A hinge measures one
//! linear combination of them, C = c · S, where c depends on the shape of its two triangles.
//! Independent hinges are therefore stiffer in some directions than in others. The three hinges of
//! a triangle determine S there, and the energy is exact in every direction:
//!
//! ```text
//! ½ D A |S|² = ½ D A Σ Cᵢ Cⱼ (M⁻¹)ᵢⱼ / |cᵢ| |cⱼ|,    Mᵢⱼ = cᵢ · cⱼ / |cᵢ| |cⱼ|
//! ```
//! With fewer than three hinges (at a border, which carries no moment) S is the smallest tensor
//! with these C.
//!
//! This element is exact for evenly bent sheets, but on some meshes with alternating diagonals it
//! gives some creases too little energy. The element of Oñate and Zárate ("Rotation-free triangular
//! plate and shell elements", IJNME 2000), S = Σ C nnᵀ / 2 A with n across an edge, resists all
//! creases, but is too stiff in oblique directions on these meshes. On periodic meshes both agree;
//! elsewhere their errors have opposite signs, so the mean of both is used.
//!
//! Reads hinges and rest positions; writes `TriangleStiffness` per triangle.
//!
//! Invariant: M stays invertible, see `MIN_DETERMINANT`.

use crate::math::heap_bytes::HeapBytes;
use crate::math::max;
use crate::model::hinge::{CurvatureResponse, Hinge};
use glam::{Vec2, Vec3};

/// No hinge.
const NONE: u32 = u32::MAX;

/// Minimum determinant of M. Below it the hinges measure nearly the same number, and rounding
/// errors would act as a large stiffness; so the difference is added to the diagonal of M.
const MIN_DETERMINANT: f32 = 0.15;

/// The pairs of the three hinges of a triangle.
pub(crate) const PAIRS: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];

/// The element of one triangle.
#[derive(Clone, Copy, Debug)]
struct BendTriangle {
    /// Its hinges, and for each whether the triangle is the first (0) or second (1) of that hinge.
    hinges: [u32; 3],
    sides: [u8; 3],
    /// √A / |c| of each hinge.
    sizes: [f32; 3],
    /// Coefficient of the Oñate–Zárate element, 1 / 2 √A [1/m].
    slope_size: f32,
    /// M of each pair of hinges (`PAIRS`), and the same for the Oñate–Zárate element.
    coupling: [f32; 3],
    slope_coupling: [f32; 3],
}

/// All triangles that have hinges.
#[derive(Clone, Debug, Default)]
pub(crate) struct BendElements(Vec<BendTriangle>);

impl HeapBytes for BendElements {
    fn heap_bytes(&self) -> usize {
        self.0.heap_bytes()
    }
}

/// Energy of a triangle divided by ½ D [m²]: Σ own Cᵢ² + 2 Σ between Cᵢ · Cⱼ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleStiffness {
    /// Its hinges; entries whose `own` is 0 may be missing (`NONE`).
    pub hinges: [u32; 3],
    /// Diagonal terms [1/m²].
    pub own: [f32; 3],
    /// Terms of the pairs in `PAIRS` [1/m²].
    pub between: [f32; 3],
    /// Scale of the stiffness, which the terms include.
    pub stiffness_scale: f32,
}

impl TriangleStiffness {
    /// Multiplies the energy by `by`.
    pub fn scale(&mut self, by: f32) {
        self.own.iter_mut().chain(&mut self.between).for_each(|term| *term *= by);
    }
}

/// A hinge at an edge of a triangle.
#[derive(Clone, Copy, Debug)]
struct HingeSide {
    triangle: u32,
    hinge: u32,
    side: u8,
}

impl BendElements {
    /// Creates the elements of all triangles at these hinges. `triangles` are the two triangles of
    /// each hinge, `responses` their responses to curvature, `corners` returns the rest positions
    /// of a triangle and `rest` that of a vertex [m].
    pub fn new(
        hinges: &[Hinge],
        triangles: &[[u32; 2]],
        responses: &[CurvatureResponse],
        corners: impl Fn(u32) -> [Vec3; 3],
        rest: impl Fn(u32) -> Vec3,
    ) -> Self {
        let mut edges = Vec::with_capacity(2 * hinges.len());
        for (hinge, of) in triangles.iter().enumerate() {
            for (side, triangle) in of.iter().enumerate() {
                edges.push(HingeSide {
                    triangle: *triangle,
                    hinge: hinge as u32,
                    side: side as u8,
                });
            }
        }
        crate::math::sort::sort_by(&mut edges, |p, q| {
            (p.triangle, p.hinge).cmp(&(q.triangle, q.hinge))
        });
        let mut triangles_with_hinges = Vec::new();
        for own in edges.chunk_by(|p, q| p.triangle == q.triangle) {
            let [a, b, c] = corners(own[0].triangle);
            let (right, across) = ((b - a).normalize_or_zero(), (b - a).cross(c - a));
            let up = across.normalize_or_zero().cross(right);
            let flat = |v: Vec3| Vec2::new(v.dot(right), v.dot(up));
            let mut triangle_element = BendTriangle {
                hinges: [NONE; 3],
                sides: [0; 3],
                sizes: [0.0; 3],
                slope_size: 1.0 / (2.0 * across.length()).sqrt(),
                coupling: [0.0; 3],
                slope_coupling: [0.0; 3],
            };
            let (mut unit_responses, mut across_directions) = ([Vec3::ZERO; 3], [Vec2::ZERO; 3]);
            for (slot, edge) in own.iter().take(3).enumerate() {
                let hinge = &hinges[edge.hinge as usize];
                let [p, q] = [hinge.particles[0], hinge.particles[1]].map(&rest);
                let along = flat(q - p).normalize_or_zero();
                // The across direction of a hinge points to the apex of its first triangle.
                let to_apex = flat(rest(hinge.particles[2 + usize::from(edge.side)]) - p);
                let to_apex = to_apex - along * along.dot(to_apex);
                let to_first = if edge.side == 0 { to_apex } else { -to_apex };
                across_directions[slot] = to_first.normalize_or_zero();
                let c =
                    response_vector(responses[edge.hinge as usize], along, across_directions[slot]);
                let size = c.length();
                if size > 0.0 {
                    unit_responses[slot] = c * (1.0 / size);
                    triangle_element.hinges[slot] = edge.hinge;
                    triangle_element.sides[slot] = edge.side;
                    triangle_element.sizes[slot] = (0.5 * across.length()).sqrt() / size;
                }
            }
            for (pair, [p, q]) in PAIRS.into_iter().enumerate() {
                let slope_coupling = across_directions[p].dot(across_directions[q]);
                triangle_element.coupling[pair] = unit_responses[p].dot(unit_responses[q]);
                triangle_element.slope_coupling[pair] = slope_coupling * slope_coupling;
            }
            triangles_with_hinges.push(triangle_element);
        }
        Self(triangles_with_hinges)
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The hinges of each element.
    pub fn hinges(&self) -> impl Iterator<Item = impl Iterator<Item = usize>> {
        let exists = |hinge: &u32| *hinge != NONE;
        self.0.iter().map(move |triangle_element| {
            triangle_element.hinges.into_iter().filter(exists).map(|at| at as usize)
        })
    }

    /// The curvature |S| of a flat element whose hinges are bent by the angles `bent` [rad], in
    /// 1/m.
    pub fn curvature(&self, at: usize, hinges: &[Hinge], bent: impl Fn(usize) -> f32) -> f32 {
        let triangle_element = &self.0[at];
        let (mut multipliers, mut bends) = ([0.0; 3], [0.0; 3]);
        for (slot, hinge) in triangle_element.hinges.into_iter().enumerate() {
            if hinge != NONE {
                (multipliers[slot], bends[slot]) =
                    (1.0, bent(hinge as usize) * hinges[hinge as usize].length);
            }
        }
        if bends == [0.0; 3] {
            return 0.0;
        }
        let element = triangle_element.element(multipliers);
        let own = element.own.into_iter().zip(bends).map(|(own, c)| own * (c * c));
        let pairs = element.between.into_iter().zip(PAIRS);
        let between = pairs.map(|(between, [p, q])| 2.0 * between * (bends[p] * bends[q]));
        // `energy` is A |S|², and `slope_size` gives A.
        let energy = own.sum::<f32>() + between.sum::<f32>();
        2.0 * triangle_element.slope_size * max(energy, 0.0).sqrt()
    }

    /// Computes the stiffness of all elements from the active hinges (`is_active`) and the held
    /// particles (`is_held`). `stiffness_scale` is the factor on the stiffness of an element with
    /// these corners.
    ///
    /// Where a mesh continues into a clamp, only the half of a hinge outside the clamp bends, and
    /// takes the whole angle.
    pub fn compute_stiffness(
        &self,
        hinges: &[Hinge],
        is_active: impl Fn(usize) -> bool,
        is_held: impl Fn(u32) -> bool,
        stiffness_scale: impl Fn(usize, [u32; 3]) -> f32,
        elements: &mut Vec<TriangleStiffness>,
    ) {
        elements.clear();
        elements.extend(self.0.iter().enumerate().map(|(at, triangle_element)| {
            let mut multipliers = [0.0; 3];
            for (slot, multipliers) in multipliers.iter_mut().enumerate() {
                let hinge = triangle_element.hinges[slot] as usize;
                if triangle_element.hinges[slot] != NONE && is_active(hinge) {
                    let [p, q, a, b] = hinges[hinge].particles.map(&is_held);
                    let (own, other) =
                        if triangle_element.sides[slot] == 0 { (a, b) } else { (b, a) };
                    *multipliers = match (p && q, own, other) {
                        (true, true, false) => 0.0,
                        (true, false, true) => 2.0,
                        _ => 1.0,
                    };
                }
            }
            let (mut element, stiffness_scale) = (
                triangle_element.element(multipliers),
                stiffness_scale(at, triangle_element.corners(hinges)),
            );
            element.scale(stiffness_scale);
            element.stiffness_scale = stiffness_scale;
            element
        }));
    }
}

impl BendTriangle {
    /// The particles at its corners.
    fn corners(&self, hinges: &[Hinge]) -> [u32; 3] {
        let slot = self.hinges.iter().position(|hinge| *hinge != NONE).unwrap_or(0);
        let [p, q, first, second] = hinges[self.hinges[slot] as usize].particles;
        [p, q, if self.sides[slot] == 0 { first } else { second }]
    }

    /// Its stiffness, with the bend of each hinge multiplied by `multipliers`; hinges with 0 are
    /// absent.
    fn element(&self, multipliers: [f32; 3]) -> TriangleStiffness {
        let mut coupling = self.coupling;
        for (coupling, [p, q]) in coupling.iter_mut().zip(PAIRS) {
            if multipliers[p] * multipliers[q] == 0.0 {
                *coupling = 0.0;
            }
        }
        let [ab, ac, bc] = coupling;
        let determinant = 1.0 + 2.0 * (ab * ac * bc) - (ab * ab + ac * ac + bc * bc);
        let d = 1.0 + max(MIN_DETERMINANT - determinant, 0.0);
        let minors = [d * d - bc * bc, d * d - ac * ac, d * d - ab * ab];
        let mixed = [ac * bc - ab * d, ab * bc - ac * d, ab * ac - bc * d];
        let inverse_determinant = 1.0 / (d * minors[0] + (ab * mixed[0] + ac * mixed[1]));
        let slope_size = self.slope_size * self.slope_size;
        let mut element = TriangleStiffness {
            hinges: self.hinges,
            own: [0.0; 3],
            between: [0.0; 3],
            stiffness_scale: 1.0,
        };
        for slot in 0..3 {
            let size = self.sizes[slot] * self.sizes[slot];
            let mean = 0.5 * (minors[slot] * inverse_determinant * size + slope_size);
            element.own[slot] = mean * (multipliers[slot] * multipliers[slot]);
        }
        for (pair, [p, q]) in PAIRS.into_iter().enumerate() {
            let size = self.sizes[p] * self.sizes[q];
            let mean = 0.5
                * (mixed[pair] * inverse_determinant * size
                    + self.slope_coupling[pair] * slope_size);
            if mean.abs() > NEGLIGIBLE * slope_size {
                element.between[pair] = mean * (multipliers[p] * multipliers[q]);
            }
        }
        element
    }
}

/// Relative size of a coupling below which it is rounding.
const NEGLIGIBLE: f32 = 1.0e-4;

/// Response of a hinge in the frame of its triangle, as coefficients of Sₓₓ, Sᵧᵧ and √2 Sₓᵧ; t and
/// n are the directions along and across the hinge.
fn response_vector([along, across, between]: CurvatureResponse, t: Vec2, n: Vec2) -> Vec3 {
    let half_root = 0.5_f32.sqrt();
    let parts =
        |u: Vec2, v: Vec2| Vec3::new(u.x * v.x, u.y * v.y, half_root * (u.x * v.y + u.y * v.x));
    parts(t, t) * along + parts(n, n) * across + parts(t, n) * between
}
