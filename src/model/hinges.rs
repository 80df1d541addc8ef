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
use crate::mesh::{Corner, Mesh, next_corner, triangle_of};
use crate::model::bend_elements::BendElements;
use crate::model::hinge::{CurvatureResponse, Hinge};
use crate::model::links::{LinkKind, LinkSupport, Links};
use glam::Vec3;

/// What a grid's triangles give a cylinder, over what they should: 3 along threads, 4½ halfway between.
const GRID_ENERGY_RATIO: f32 = 3.75;

/// The hinges of a weave.
#[derive(Clone, Debug)]
pub(crate) struct Hinges {
    /// Those it was woven with.
    pub all: Vec<Hinge>,
    /// The bend link of each.
    pub links: Vec<u32>,
    /// How they go together.
    pub elements: BendElements,
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
            elements: BendElements::default(),
            are_bent: false,
            revision: 0,
            scale: 1.0 / GRID_ENERGY_RATIO,
            first: 0,
            hinge_of: Vec::new(),
        }
    }

    /// The hinges of a mesh with these links, in the order of colours so that neighbours do not wait for
    /// each other. `rest` is the rest position of each site.
    pub fn new(mesh: &Mesh, links: &Links, rest: &[Vec3]) -> Self {
        let is_bend = |link: &usize| links.kind(*link) == LinkKind::Bend;
        let first = (0..links.len()).find(is_bend).unwrap_or(links.len());
        let (mut modelled, mut exact) = (0.0_f64, 0.0_f64);
        let mut found = Vec::new();
        for link in (first..links.len()).filter(is_bend) {
            let Some(corners) = corners(links, link) else { continue };
            if let Some((hinge, [modelled_energy, exact_energy], response)) =
                between(mesh, rest, corners)
            {
                (modelled, exact) =
                    (modelled + f64::from(modelled_energy), exact + f64::from(exact_energy));
                let [edge, _, _, beyond] = corners;
                let triangles = [triangle_of(edge), triangle_of(beyond)].map(|at| at as u32);
                found.push((link as u32, hinge, triangles, response));
            }
        }
        let scale = if modelled > 0.0 { (exact / modelled) as f32 } else { 1.0 };
        let color = colors(&found, mesh.vertex_count());
        let mut order: Vec<usize> = (0..found.len()).collect();
        sort_by(&mut order, |p, q| (color[*p], p).cmp(&(color[*q], q)));
        let mut hinge_of = vec![u32::MAX; links.len() - first];
        let (mut all, mut of) = (Vec::new(), Vec::new());
        let (mut triangles, mut response) = (Vec::new(), Vec::new());
        for at in order {
            let (link, hinge, between, own_response) = found[at];
            hinge_of[link as usize - first] = all.len() as u32;
            all.push(Hinge { shape: hinge.shape * scale, ..hinge });
            of.push(link);
            triangles.push(between);
            response.push(own_response);
        }
        let place = |vertex: u32| rest[mesh.source[vertex as usize] as usize];
        let corners = |triangle: u32| mesh.triangles[triangle as usize].map(place);
        let elements = BendElements::new(&all, &triangles, &response, corners, place);
        let are_bent = all.iter().any(|hinge| hinge.rest != 0.0);
        Self { all, links: of, elements, are_bent, revision: 0, scale, first, hinge_of }
    }

    /// Brings the hinge of a link in line with the mesh.
    pub fn update_link(&mut self, mesh: &Mesh, links: &Links, link: usize) {
        let found = link.checked_sub(self.first).and_then(|at| self.hinge_of.get(at)).copied();
        let Some(hinge) = found.and_then(|at| self.all.get_mut(at as usize)) else { return };
        self.revision = self.revision.wrapping_add(1);
        if let Some(corners) = corners(links, link) {
            hinge.particles = corners.map(|corner| mesh.vertex(corner));
        }
    }

    /// The hinge of a link that came later.
    pub fn dynamic_hinge(
        &self,
        mesh: &Mesh,
        links: &Links,
        link: usize,
        rest: &[Vec3],
    ) -> Option<Hinge> {
        let (hinge, ..) = between(mesh, rest, corners(links, link)?)?;
        Some(Hinge { shape: hinge.shape * self.scale, ..hinge })
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        self.all.len() * (size_of::<Hinge>() + size_of::<u32>())
            + self.hinge_of.len() * size_of::<u32>()
            + self.elements.bytes()
    }
}

/// The corners of a link across an edge.
fn corners(links: &Links, link: usize) -> Option<[Corner; 4]> {
    let spec = &links.spec[link];
    match spec.support {
        LinkSupport::AcrossEdge(edge) => {
            Some([edge, next_corner(edge), spec.ends[0], spec.ends[1]])
        }
        _ => None,
    }
}

fn between(
    mesh: &Mesh,
    rest: &[Vec3],
    corners: [Corner; 4],
) -> Option<(Hinge, [f32; 2], CurvatureResponse)> {
    let at = corners.map(|corner| mesh.vertex(corner));
    Hinge::between_triangles(at, at.map(|vertex| rest[mesh.source[vertex as usize] as usize]))
}

/// A colour for each hinge, the lowest that none of its particles has yet.
fn colors(hinges: &[(u32, Hinge, [u32; 2], CurvatureResponse)], vertex_count: usize) -> Vec<u32> {
    let mut taken = vec![0_u64; vertex_count];
    let mut colors = Vec::with_capacity(hinges.len());
    for (_, hinge, ..) in hinges {
        let all = hinge.particles.iter().fold(0, |all, vertex| all | taken[*vertex as usize]);
        let color = (!all).trailing_zeros().min(63);
        hinge.particles.iter().for_each(|vertex| taken[*vertex as usize] |= 1 << color);
        colors.push(color);
    }
    colors
}
