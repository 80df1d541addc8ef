//! Hinges: what resists bending across the edges of any mesh.
//!
//! ```text
//!      a           C = Σ cᵢ xᵢ over the two triangles at an edge pq, with cotangents of their angles
//!    ╱   ╲         at the edge as weights: a vector that is naught while they are in one plane
//!   p ─── q
//!    ╲   ╱         energy ½ D k |C|², k = 3 / area
//!      b
//! ```
//! Bergou et al., "A quadratic bending model for inextensible surfaces", SGP 2006. How much energy that
//! gives a sheet in the shape of a cylinder depends on how its edges lie, and is about three times
//! what it should be. So the hinges of a triangle are taken together, see `facets`: then a strip of any mesh
//! bends as the material says, whichever way it is cut. Hinges that a cut makes go by themselves: a mesh
//! measures at its own flaps what they give a cylinder, over all its directions, and takes them by so much less.

use crate::math::sort::sort_by;
use crate::mesh::{Corner, Mesh, after, triangle_of};
use crate::model::bend_elements::{BendElements, Shows};
use crate::model::links::{LinkKind, Links, Support};
use glam::Vec3;

/// What a grid's triangles give a cylinder, over what they should: 3 along threads, 4½ halfway between.
const OF_GRIDS: f32 = 3.75;

/// A rest shape that is bent by less than this share of its size is flat.
const FLAT: f32 = 1.0e-4;

/// One hinge: its particles, their weights, and what it takes to bend it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hinge {
    /// The ends of the edge, and what is across from it on either side.
    pub at: [u32; 4],
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
    pub fn curve(&self, x: [Vec3; 4]) -> Vec3 {
        let [p, q, a, b] = self.weight;
        x[0] * p + x[1] * q + x[2] * a + x[3] * b
    }

    /// How much of the sheet across it bends as it does where a fold goes along it [m].
    pub fn reach(&self) -> f32 {
        1.5 * self.width
    }

    /// A hinge between two triangles, from where its corners are at rest; none if one has no area. Also
    /// what a cylinder gives it on average and should, each over ½ D κ², and what it shows of a curvature.
    fn flap(at: [u32; 4], [p, q, a, b]: [Vec3; 4]) -> Option<(Self, [f32; 2], Shows)> {
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
        let curve = p * weight[0] + q * weight[1] + a * weight[2] + b * weight[3];
        let bent = curve.dot(normal([p, q, a, b]));
        let rest = if bent.abs() > FLAT * length { bent } else { 0.0 };
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
        let hinge = Self { at, weight, shape, rest, length, width };
        let shows = [0.25 * (round + across), 0.25 * (round - across), twist];
        Some((hinge, [shape * mean, area / 3.0], shows))
    }
}

/// The side that a hinge bends to if it is bent by more than naught: square to its edge and to the way
/// across; naught if it has none.
#[inline(always)]
pub(crate) fn normal([p, q, a, b]: [Vec3; 4]) -> Vec3 {
    let across = (q - p).cross(a - b);
    let length = across.length();
    if length > 1.0e-20 { across * (1.0 / length) } else { Vec3::ZERO }
}

/// The hinges of a weave.
#[derive(Clone, Debug)]
pub(crate) struct Hinges {
    /// Those it was woven with.
    pub all: Vec<Hinge>,
    /// The bend link of each.
    pub links: Vec<u32>,
    /// How they go together.
    pub facets: BendElements,
    /// Whether any is bent at rest.
    pub are_bent: bool,
    /// How often any followed its link, or lost it.
    pub revision: u32,
    /// What all are taken by.
    scale: f32,
    /// The first bend link, and the hinge of each from there on.
    first: usize,
    hinge_of: Vec<u32>,
}

impl Hinges {
    /// None, for a grid, which has plates.
    pub fn none() -> Self {
        Self {
            all: Vec::new(),
            links: Vec::new(),
            facets: BendElements::default(),
            are_bent: false,
            revision: 0,
            scale: 1.0 / OF_GRIDS,
            first: 0,
            hinge_of: Vec::new(),
        }
    }

    /// The hinges of a mesh with these links, in the order of colours so that neighbours do not wait for
    /// each other. `rest` is the rest position of each site.
    pub fn find(mesh: &Mesh, links: &Links, rest: &[Vec3]) -> Self {
        let is_bend = |link: &usize| links.kind(*link) == LinkKind::Bend;
        let first = (0..links.len()).find(is_bend).unwrap_or(links.len());
        let (mut given, mut due) = (0.0_f64, 0.0_f64);
        let mut found = Vec::new();
        for link in (first..links.len()).filter(is_bend) {
            let Some(corners) = corners(links, link) else { continue };
            if let Some((hinge, [gives, should], shows)) = between(mesh, rest, corners) {
                (given, due) = (given + f64::from(gives), due + f64::from(should));
                let [edge, _, _, beyond] = corners;
                let triangles = [triangle_of(edge), triangle_of(beyond)].map(|at| at as u32);
                found.push((link as u32, hinge, triangles, shows));
            }
        }
        let scale = if given > 0.0 { (due / given) as f32 } else { 1.0 };
        let color = colors(&found, mesh.vertex_count());
        let mut order: Vec<usize> = (0..found.len()).collect();
        sort_by(&mut order, |p, q| (color[*p], p).cmp(&(color[*q], q)));
        let mut hinge_of = vec![u32::MAX; links.len() - first];
        let (mut all, mut of) = (Vec::new(), Vec::new());
        let (mut triangles, mut shows) = (Vec::new(), Vec::new());
        for at in order {
            let (link, hinge, between, shown) = found[at];
            hinge_of[link as usize - first] = all.len() as u32;
            all.push(Hinge { shape: hinge.shape * scale, ..hinge });
            of.push(link);
            triangles.push(between);
            shows.push(shown);
        }
        let place = |vertex: u32| rest[mesh.source[vertex as usize] as usize];
        let corners = |triangle: u32| mesh.triangles[triangle as usize].map(place);
        let facets = BendElements::find(&all, &triangles, &shows, corners, place);
        let are_bent = all.iter().any(|hinge| hinge.rest != 0.0);
        Self { all, links: of, facets, are_bent, revision: 0, scale, first, hinge_of }
    }

    /// Brings the hinge of a link in line with the mesh.
    pub fn follow_link(&mut self, mesh: &Mesh, links: &Links, link: usize) {
        let found = link.checked_sub(self.first).and_then(|at| self.hinge_of.get(at)).copied();
        let Some(hinge) = found.and_then(|at| self.all.get_mut(at as usize)) else { return };
        self.revision = self.revision.wrapping_add(1);
        if let Some(corners) = corners(links, link) {
            hinge.at = corners.map(|corner| mesh.vertex(corner));
        }
    }

    /// The hinge of a link that came later.
    pub fn late(&self, mesh: &Mesh, links: &Links, link: usize, rest: &[Vec3]) -> Option<Hinge> {
        let (hinge, ..) = between(mesh, rest, corners(links, link)?)?;
        Some(Hinge { shape: hinge.shape * self.scale, ..hinge })
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        self.all.len() * (size_of::<Hinge>() + size_of::<u32>())
            + self.hinge_of.len() * size_of::<u32>()
            + self.facets.bytes()
    }
}

/// The corners of a link across an edge.
fn corners(links: &Links, link: usize) -> Option<[Corner; 4]> {
    let spec = &links.spec[link];
    match spec.support {
        Support::Flap(edge) => Some([edge, after(edge), spec.anchors[0], spec.anchors[1]]),
        _ => None,
    }
}

fn between(mesh: &Mesh, rest: &[Vec3], corners: [Corner; 4]) -> Option<(Hinge, [f32; 2], Shows)> {
    let at = corners.map(|corner| mesh.vertex(corner));
    Hinge::flap(at, at.map(|vertex| rest[mesh.source[vertex as usize] as usize]))
}

/// A colour for each hinge, the lowest that none of its particles has yet.
fn colors(hinges: &[(u32, Hinge, [u32; 2], Shows)], vertex_count: usize) -> Vec<u32> {
    let mut taken = vec![0_u64; vertex_count];
    let mut colors = Vec::with_capacity(hinges.len());
    for (_, hinge, ..) in hinges {
        let all = hinge.at.iter().fold(0, |all, vertex| all | taken[*vertex as usize]);
        let color = (!all).trailing_zeros().min(63);
        hinge.at.iter().for_each(|vertex| taken[*vertex as usize] |= 1 << color);
        colors.push(color);
    }
    colors
}
