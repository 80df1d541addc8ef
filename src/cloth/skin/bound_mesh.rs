//! A mesh that is bound to a cloth: its vertices as points of the uncut cloth, and its triangles
//! and vertices as they are after tears and cuts.
//!
//! ```text
//! given vertices ──bind──▶ root points + vectors in the frame      once
//! root points ──locate──▶ locations ──sides──▶ copies, indices     when the cloth's mesh changes
//! ```
//! Reads the descriptor and `World`; writes its own lists.
//! Invariant: given vertices keep their numbers and copies follow; every triangle is kept. A mesh
//! that does not fit the world is left unchanged.

use crate::cloth::skin::evaluate::BoundColumns;
use crate::cloth::skin::given_mesh::SkinDesc;
use crate::cloth::skin::nearest::ClothSurface;
use crate::cloth::skin::root_points::{Location, RootPoint, RootTriangles};
use crate::cloth::skin::sides::{SideInput, VertexCopy, share_bindings};
use crate::error::{Error, Result};
use crate::math::pack::BLOCK;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{Corner, next_corner};
use crate::solver::world::World;
use glam::{Vec2, Vec3};

/// A given vertex: its root point, and its vectors in the frame there.
#[derive(Clone, Debug)]
struct BoundVertex {
    root: RootPoint,
    /// [m]
    offset: Vec3,
    normal: Vec3,
    tangent: Vec3,
    uv: Vec2,
    /// 1 or −1.
    handedness: f32,
}

/// The bound mesh. See the module documentation.
#[derive(Clone, Debug)]
pub(super) struct BoundMesh {
    vertices: Vec<BoundVertex>,
    triangles: Vec<[u32; 3]>,
    /// The center of each triangle.
    centers: Vec<RootPoint>,
    /// Inner edges, each by its corner in both triangles.
    edges: Vec<[Corner; 2]>,
    /// The sites of cuts that `locations` belong to.
    cut_sites: Vec<CutSite>,
    /// The number of triangles of the cloth that they belong to.
    cloth_triangles: usize,
    locations: Vec<Location>,
    center_locations: Vec<Location>,
    copies: Vec<VertexCopy>,
    /// The given vertex of each vertex.
    pub sources: Vec<u32>,
    pub indices: Vec<u32>,
    pub uvs: Vec<Vec2>,
    pub handedness: Vec<f32>,
    /// Whether each vertex is on an edge that a tear or cut opened.
    pub frayed: Vec<bool>,
    pub columns: BoundColumns,
}

impl BoundMesh {
    /// Binds the mesh of a checked descriptor to the surface of the cloth.
    pub fn new(world: &World, surface: &mut ClothSurface<'_>, desc: &SkinDesc) -> Result<Self> {
        let roots = RootTriangles::new(world);
        let mut bind = |absolute: Vec3, inner: Vec3| {
            let found = surface.nearest(absolute - world.origin, inner - world.origin);
            let root = found.and_then(|(triangle, weights)| roots.root_point(triangle, weights));
            let located = root.and_then(|root| Some((root, roots.locate(&root)?)));
            located.ok_or(Error::BadValue {
                field: "positions",
                must: "be within half the diagonal of the cloth's bounding box of the cloth",
            })
        };
        let mut centers = Vec::with_capacity(desc.indices.len() / 3);
        for center in desc.centers() {
            centers.push(bind(center, center)?);
        }
        let mut bound = Vec::with_capacity(desc.positions.len());
        for (position, inner) in desc.positions.iter().zip(desc.inner_points()) {
            bound.push(bind(*position, inner)?);
        }
        let first = desc.first_at_position();
        share_bindings(world, &first, &mut bound);
        let (normals, tangents, uvs) = (desc.normals(&first), desc.tangents(), desc.uvs());
        let mut vertices = Vec::with_capacity(bound.len());
        for (at, (root, Location { triangle, weights, direction })) in bound.iter().enumerate() {
            let frame = surface.frame(*triangle, *weights, *direction);
            let axes = frame.axes.map(Vec3::from_array);
            let in_frame = |v: Vec3| Vec3::from_array(axes.map(|axis| v.dot(axis)));
            let point = desc.positions[at] - world.origin;
            let normal = unit_or(in_frame(normals[at]), Vec3::Z);
            vertices.push(BoundVertex {
                root: *root,
                offset: in_frame(point - Vec3::from_array(frame.point)),
                normal,
                tangent: orthogonal(in_frame(tangents[at].0), normal),
                uv: uvs[at],
                handedness: tangents[at].1,
            });
        }
        let locations: Vec<Location> = bound.into_iter().map(|(_, location)| location).collect();
        let (centers, center_locations) = centers.into_iter().unzip();
        let triangles = desc.triangles().to_vec();
        let mut mesh = Self {
            vertices,
            triangles,
            centers,
            edges: desc.inner_edges(),
            cut_sites: world.cut_sites.clone(),
            cloth_triangles: world.mesh.triangles.len(),
            locations,
            center_locations,
            copies: Vec::new(),
            sources: Vec::new(),
            indices: Vec::new(),
            uvs: Vec::new(),
            handedness: Vec::new(),
            frayed: Vec::new(),
            columns: BoundColumns::default(),
        };
        mesh.assign_sides(world);
        // Edges along which the cloth is in pieces from the start are no tears.
        let indices = &mesh.indices;
        mesh.edges.retain(|edge| !is_open(indices, *edge));
        mesh.frayed.fill(false);
        Ok(mesh)
    }

    /// Largest number of vertices: each corner of a triangle has one of its own.
    pub fn vertex_capacity(&self) -> usize {
        self.vertices.len() + self.indices.len()
    }

    /// Follows a change of the cloth's mesh. Returns whether vertices or triangles changed.
    ///
    /// # Errors
    /// [`Error::BadHandle`] if the cloth has no triangle for a vertex; nothing changes.
    pub fn update(&mut self, world: &World) -> Result<bool> {
        let count = world.mesh.triangles.len();
        if self.cut_sites != world.cut_sites || self.cloth_triangles != count {
            let roots = RootTriangles::new(world);
            let locate =
                |root: &RootPoint| roots.locate(root).ok_or(Error::BadHandle { what: "skin" });
            let locations = self.vertices.iter().map(|vertex| locate(&vertex.root));
            let locations = locations.collect::<Result<Vec<Location>>>()?;
            let centers = self.centers.iter().map(locate);
            self.center_locations = centers.collect::<Result<Vec<Location>>>()?;
            self.locations = locations;
            self.cloth_triangles = count;
            self.cut_sites.clone_from(&world.cut_sites);
        }
        let old = (core::mem::take(&mut self.indices), core::mem::take(&mut self.sources));
        self.assign_sides(world);
        Ok(old.0 != self.indices || old.1 != self.sources)
    }

    /// Rebuilds the vertices and triangles for the present mesh of the cloth.
    fn assign_sides(&mut self, world: &World) {
        let input = SideInput {
            world,
            triangles: &self.triangles,
            centers: &self.center_locations,
            locations: &self.locations,
        };
        input.assign(&mut self.indices, &mut self.copies);
        self.sources.clear();
        self.sources.extend(0..self.vertices.len() as u32);
        self.sources.extend(self.copies.iter().map(|copy| copy.source));
        let (vertices, sources) = (&self.vertices, &self.sources);
        self.uvs.clear();
        self.uvs.extend(sources.iter().map(|source| vertices[*source as usize].uv));
        self.handedness.clear();
        self.handedness.extend(sources.iter().map(|source| vertices[*source as usize].handedness));
        self.frayed.clear();
        self.frayed.resize(sources.len(), false);
        for [a, b] in self.edges.iter().filter(|edge| is_open(&self.indices, **edge)) {
            for corner in [*a, next_corner(*a), *b, next_corner(*b)] {
                self.frayed[self.indices[corner as usize] as usize] = true;
            }
        }
        self.fill_columns(world);
    }

    fn fill_columns(&mut self, world: &World) {
        let columns = &mut self.columns;
        columns.clear();
        let given = self.locations.iter().map(|location| (location, Vec3::ZERO));
        let copies = self.copies.iter().map(|copy| (&copy.location, copy.offset));
        for ((location, offset), source) in given.chain(copies).zip(&self.sources) {
            let vertex = &self.vertices[*source as usize];
            let corners = world.mesh.triangles[location.triangle as usize];
            let offset = vertex.offset + offset;
            columns.push(corners, location, offset, vertex.normal, vertex.tangent);
        }
        let padding = Location { triangle: 0, weights: [1.0, 0.0, 0.0], direction: [1.0, 0.0] };
        while !columns.len().is_multiple_of(BLOCK) {
            columns.push([0; 3], &padding, Vec3::ZERO, Vec3::Z, Vec3::X);
        }
    }
}

impl BoundColumns {
    fn len(&self) -> usize {
        self.corners[0].len()
    }

    fn clear(&mut self) {
        self.corners.iter_mut().for_each(Vec::clear);
        self.direction.iter_mut().for_each(|column| column.clear());
        for columns in [&mut self.weights, &mut self.offset, &mut self.normal, &mut self.tangent] {
            columns.set_all(core::iter::empty());
        }
    }

    fn push(
        &mut self,
        corners: [u32; 3],
        location: &Location,
        offset: Vec3,
        normal: Vec3,
        tangent: Vec3,
    ) {
        self.corners.iter_mut().zip(corners).for_each(|(list, corner)| list.push(corner));
        self.direction.iter_mut().zip(location.direction).for_each(|(list, x)| list.push(x));
        self.weights.push(Vec3::from_array(location.weights));
        self.offset.push(offset);
        self.normal.push(normal);
        self.tangent.push(tangent);
    }
}

/// Whether an edge of the given mesh has different vertices in its two triangles.
fn is_open(indices: &[u32], edge: [Corner; 2]) -> bool {
    let [one, other] = edge.map(|corner| {
        let [a, b] = [corner, next_corner(corner)].map(|at| indices[at as usize]);
        [a.min(b), a.max(b)]
    });
    one != other
}

/// Returns `v` with length one; `fallback` if that is not a direction.
fn unit_or(v: Vec3, fallback: Vec3) -> Vec3 {
    let inverse = 1.0 / v.length();
    if inverse.is_finite() { v * inverse } else { fallback }
}

/// Returns the unit vector orthogonal to the unit vector `normal` in the direction of `v`; any if
/// there is none.
fn orthogonal(v: Vec3, normal: Vec3) -> Vec3 {
    let part = |v: Vec3| v - normal * v.dot(normal);
    let axis = if normal.x * normal.x < 0.5 { Vec3::X } else { Vec3::Z };
    let spare = unit_or(part(axis), Vec3::X);
    let own = part(v);
    if own.length_squared() > v.length_squared() * 1.0e-10 { unit_or(own, spare) } else { spare }
}

/// Writes positions or normals of particles as `[x, y, z, 0]`.
pub(super) fn interleave(vectors: impl Iterator<Item = Vec3>, out: &mut Vec<[f32; 4]>) {
    out.clear();
    out.extend(vectors.map(|v| v.extend(0.0).to_array()));
}
