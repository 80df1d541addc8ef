use glam::Vec3;

/// A rest shape that is bent by less than this share of its size is flat.
const MAX_FLAT_CURVATURE: f32 = 1.0e-4;

/// What a hinge shows of a curvature whose parts along its edge, across and between are these.
pub(crate) type CurvatureResponse = [f32; 3];

/// One hinge: its particles, their weights, and what it takes to bend it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hinge {
    /// The ends of the edge, and what is across from it on either side.
    pub particles: [u32; 4],
    pub weight: [f32; 4],
    /// Energy over ½ D |C|² of one that goes by itself [1/m²].
    pub shape: f32,
    /// What |C| is at rest, to the side that its normal is on [m].
    pub rest: f32,
    /// The length of its edge, and how much of the sheet across it is its own [m].
    pub length: f32,
    pub width: f32,
}

impl Hinge {
    /// Its curvature, for where its particles are [m].
    pub fn curvature(&self, x: [Vec3; 4]) -> Vec3 {
        let [p, q, a, b] = self.weight;
        x[0] * p + x[1] * q + x[2] * a + x[3] * b
    }

    /// How much of the sheet across it bends as it does where a fold goes along it [m].
    pub fn fold_width(&self) -> f32 {
        1.5 * self.width
    }

    /// A hinge between two triangles, from where its corners are at rest; none if one has no area. Also
    /// what a cylinder gives it on average and should, each over ½ D κ², and what it shows of a curvature.
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
        // Unfolded, with the edge along x.
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

/// The side that a hinge bends to if it is bent by more than naught: square to its edge and to the way
/// across; naught if it has none.
#[inline(always)]
pub(crate) fn hinge_normal([p, q, a, b]: [Vec3; 4]) -> Vec3 {
    let across = (q - p).cross(a - b);
    let length = across.length();
    if length > 1.0e-20 { across * (1.0 / length) } else { Vec3::ZERO }
}
