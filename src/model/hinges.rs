//! Hinges of a mesh: resistance to bending where there is no regular grid.
//!
//! A sum of independent hinges stores about three times the exact energy of a cylinder, and the
//! factor depends on the direction of the edges. Therefore the three hinges of a triangle act
//! together, see `bend_elements`; then a strip of any mesh bends as the material says, in any
//! direction. Hinges that a cut adds act alone: their energy is divided by the mean ratio of hinge
//! energy to exact energy of cylinders, measured on the mesh.
//!
//! Reads mesh, bend links and rest positions; writes `Hinges`.
//!
//! Invariant: hinges are sorted by colour (neighbours in the list share no particle, for
//! pipelining), and each belongs to one bend link.

use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::sort_groups;
use crate::mesh::{Corner, Mesh, next_corner, triangle_of};
use crate::model::bend_elements::BendElements;
use crate::model::hinge::{CurvatureResponse, Hinge};
use crate::model::links::{LinkKind, LinkSupport, Links};
use glam::Vec3;

/// Ratio of hinge energy to exact energy of a cylinder for the triangles of a grid: between 3 along
/// threads and 4½ at 45°.
const GRID_ENERGY_RATIO: f32 = 3.75;

/// The hinges of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Hinges {
    /// Hinges created with the cloth, sorted by colour.
    pub all: Vec<Hinge>,
    /// Bend link of each hinge.
    pub links: Vec<u32>,
    /// The triangles that couple them.
    pub elements: BendElements,
    /// Whether any hinge is bent at rest.
    pub are_bent: bool,
    /// Counter of changes of hinges or of their activity.
    pub revision: u32,
    /// Factor on the energy of a hinge that acts alone.
    scale: f32,
    /// First bend link, and the hinge of each bend link from there on.
    first: usize,
    hinge_of: Vec<u32>,
}

heap_bytes!(Hinges { all, links, elements, hinge_of } plain { are_bent, revision, scale, first });

impl Hinges {
    /// No hinges, for a grid, which has plate elements.
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

    /// Creates the hinges of a mesh with these links. `rest` is the rest position of each site [m].
    pub fn new(mesh: &Mesh, links: &Links, rest: &[Vec3]) -> Self {
        let is_bend = |link: &usize| links.kind(*link) == LinkKind::Bend;
        let first = (0..links.len()).find(is_bend).unwrap_or(links.len());
        let (mut modelled, mut exact) = (0.0_f64, 0.0_f64);
        let mut candidates = Vec::new();
        for link in (first..links.len()).filter(is_bend) {
            let Some(corners) = corners(links, link) else { continue };
            if let Some((hinge, [modelled_energy, exact_energy], responses)) =
                between(mesh, rest, corners)
            {
                (modelled, exact) =
                    (modelled + f64::from(modelled_energy), exact + f64::from(exact_energy));
                let [edge, _, _, beyond] = corners;
                let triangles = [triangle_of(edge), triangle_of(beyond)].map(|at| at as u32);
                candidates.push((link as u32, hinge, triangles, responses));
            }
        }
        let scale = if modelled > 0.0 { (exact / modelled) as f32 } else { 1.0 };
        let color = colors(&candidates, mesh.vertex_count());
        let mut order: Vec<[u32; 2]> =
            color.iter().zip(0..).map(|(color, at)| [*color, at]).collect();
        sort_groups(&mut order, |[color, _]| *color);
        let mut hinge_of = vec![u32::MAX; links.len() - first];
        let (mut all, mut of) = (Vec::new(), Vec::new());
        let (mut triangles, mut responses) = (Vec::new(), Vec::new());
        for [_, at] in order {
            let (link, hinge, between, response) = candidates[at as usize];
            hinge_of[link as usize - first] = all.len() as u32;
            all.push(Hinge { shape: hinge.shape * scale, ..hinge });
            of.push(link);
            triangles.push(between);
            responses.push(response);
        }
        let rest_position = |vertex: u32| rest[mesh.source[vertex as usize] as usize];
        let corners = |triangle: u32| mesh.triangles[triangle as usize].map(rest_position);
        let elements = BendElements::new(&all, &triangles, &responses, corners, rest_position);
        let are_bent = all.iter().any(|hinge| hinge.rest != 0.0);
        Self { all, links: of, elements, are_bent, revision: 0, scale, first, hinge_of }
    }

    /// Updates the particles of the hinge of a link after the mesh changed.
    pub fn update_link(&mut self, mesh: &Mesh, links: &Links, link: usize) {
        let candidates = link.checked_sub(self.first).and_then(|at| self.hinge_of.get(at)).copied();
        let Some(hinge) = candidates.and_then(|at| self.all.get_mut(at as usize)) else { return };
        self.revision = self.revision.wrapping_add(1);
        if let Some(corners) = corners(links, link) {
            hinge.particles = corners.map(|corner| mesh.vertex(corner));
        }
    }

    /// Creates the hinge of a dynamic link; `None` if it has none.
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
}

/// The corners of a link across an edge: both ends of the edge, and both vertices opposite it.
fn corners(links: &Links, link: usize) -> Option<[Corner; 4]> {
    let spec = &links.spec[link];
    match spec.support {
        LinkSupport::AcrossEdge(edge) => {
            Some([edge, next_corner(edge), spec.ends[0], spec.ends[1]])
        }
        _ => None,
    }
}

/// Creates the hinge with these corners, see [`Hinge::between_triangles`].
fn between(
    mesh: &Mesh,
    rest: &[Vec3],
    corners: [Corner; 4],
) -> Option<(Hinge, [f32; 2], CurvatureResponse)> {
    let at = corners.map(|corner| mesh.vertex(corner));
    Hinge::between_triangles(at, at.map(|vertex| rest[mesh.source[vertex as usize] as usize]))
}

/// A colour per hinge: the lowest that none of its particles has yet, at most 63.
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
