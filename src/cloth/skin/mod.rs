//! Skins: fine render meshes that follow a coarse cloth.
//!
//! ```text
//! SkinDesc ──given_mesh──▶ nearest ──▶ root_points ──▶ bound_mesh      once
//! cloth ──▶ positions, normals of particles ──evaluate──▶ vertices     each frame
//! tears, cuts ──▶ root_points, sides ──▶ copies, indices               when triangles change
//! ```
//! Method: each vertex is bound to the nearest triangle, by barycentric weights and an offset in
//! the frame of the curved surface over the triangle (Phong tessellation, see `evaluate`).
//!
//! Reads a [`Cloth`]; writes its own lists.
//! Invariant: a skin never changes its cloth. Updates allocate nothing unless triangles of the
//! cloth changed.

mod bound_mesh;
mod evaluate;
pub(crate) mod given_mesh;
mod nearest;
mod root_points;
mod sides;
mod write;

use crate::cloth::Cloth;
use crate::cloth::interpolated_surface::InterpolatedSurface;
use crate::cloth::skin::bound_mesh::{BoundMesh, interleave};
use crate::cloth::skin::evaluate::{ParticlePoints, SkinBlock, evaluate};
use crate::cloth::skin::given_mesh::SkinDesc;
use crate::cloth::skin::nearest::ClothSurface;
use crate::error::{Error, Result};
use crate::math::columns::Columns;
use crate::math::float_env::with_float_env;
use crate::math::pack::BLOCK;
use crate::solver::world::World;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// A render mesh that follows a cloth, usually a fine mesh on a coarse cloth.
///
/// Each vertex is bound to the nearest point of the cloth as it is when the skin is made, at its
/// distance from it. [`Skin::update`] moves the vertices along with the cloth: on a surface that is
/// curved over each triangle ([`SkinDesc::smoothness`]), so that the outline of a coarse cloth is
/// smooth. Normals turn with that surface. Vertices at the same position share their normal, so
/// texture seams do not show.
///
/// Make the skin while the cloth has the shape that the mesh was modelled in, usually right after
/// the cloth, before the first tick: on a folded cloth the nearest layer may be another one.
///
/// - **Tears and cuts**: a triangle of the skin that a tear or cut would stretch goes with one
///   side, that of its center. Its corners on the other side are copied, so the number of vertices
///   may grow; the number of triangles never changes. [`Cloth::reset`] restores the given mesh.
/// - **Open seams**: where the cloth is in pieces from the start, the skin is too.
/// - **Save**: [`Cloth::save`] contains no skins. A skin fits every cloth that was cloned or
///   restored from its own.
///
/// ```
/// use muslin::{Cloth, GridDesc, Skin, SkinDesc};
/// use muslin::glam::Vec3;
///
/// // 12 x 12 particles, and a skin of 67 x 67 vertices.
/// let mut cloth = Cloth::grid(&GridDesc { columns: 12, rows: 12, spacing: 0.1, ..Default::default() })?;
/// let fine = GridDesc { columns: 67, rows: 67, spacing: 1.1 / 66.0, ..Default::default() };
/// let fine = Cloth::grid(&fine)?; // for its vertices and triangles
/// let mut skin = Skin::new(&cloth, &SkinDesc {
///     positions: fine.positions().to_vec(),
///     indices: fine.indices().to_vec(),
///     uvs: fine.uvs().to_vec(),
///     ..SkinDesc::default()
/// })?;
/// cloth.advance(1.0 / 60.0)?;
/// skin.update(&cloth)?;
/// assert_eq!(skin.positions().len(), 67 * 67);
/// # Ok::<(), muslin::Error>(())
/// ```
#[derive(Debug)]
pub struct Skin {
    mesh: BoundMesh,
    smoothness: f32,
    cloth: ClothIdentity,
    /// The mesh of the cloth that `mesh` belongs to.
    seen: MeshRevision,
    topology_revision: u32,
    state_revision: u32,
    surface: InterpolatedSurface,
    particle_positions: Vec<[f32; 4]>,
    particle_normals: Vec<[f32; 4]>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
}

/// What a cloth has in common with its clones and restored copies, and with no other cloth that is
/// likely to be confused with it.
#[derive(Clone, Debug, PartialEq)]
struct ClothIdentity {
    original_count: u32,
    first: Vec3,
    last: Vec3,
}

impl ClothIdentity {
    fn of(world: &World) -> Self {
        let original_count = world.mesh.original_count;
        let last = world.rest[original_count as usize - 1];
        Self { original_count, first: world.rest[0], last }
    }
}

/// Changes whenever the triangles of the cloth change.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MeshRevision {
    topology: u32,
    particles: usize,
    triangles: usize,
}

impl MeshRevision {
    fn of(cloth: &Cloth) -> Self {
        let mesh = &cloth.world.mesh;
        Self {
            topology: cloth.topology_revision,
            particles: mesh.vertex_count(),
            triangles: mesh.triangles.len(),
        }
    }
}

impl Clone for Skin {
    fn clone(&self) -> Self {
        Self {
            mesh: self.mesh.clone(),
            smoothness: self.smoothness,
            cloth: self.cloth.clone(),
            seen: self.seen,
            topology_revision: self.topology_revision,
            state_revision: self.state_revision,
            surface: self.surface.with_same_capacity(),
            particle_positions: Vec::with_capacity(self.particle_positions.capacity()),
            particle_normals: Vec::with_capacity(self.particle_normals.capacity()),
            positions: self.positions.clone(),
            normals: self.normals.clone(),
        }
    }
}

impl Skin {
    /// Binds a mesh to the cloth as it is now.
    ///
    /// # Errors
    /// [`Error::BadValue`] or [`Error::BadIndex`] names the invalid field of `desc` and its rule;
    /// also if a vertex is farther from the cloth than half the diagonal of the cloth's bounding
    /// box.
    pub fn new(cloth: &Cloth, desc: &SkinDesc) -> Result<Self> {
        desc.check()?;
        let world = &cloth.world;
        let capacity = world.allocated_particles();
        let mut surface = InterpolatedSurface::with_capacity(capacity);
        let [mut positions, mut normals] =
            [Vec::with_capacity(capacity), Vec::with_capacity(capacity)];
        let mesh = with_float_env(|| {
            surface.update(world, 1.0, None);
            interleave(world.particles.x.iter(), &mut positions);
            interleave(surface.normals.iter(), &mut normals);
            let mut nearest = ClothSurface::new(
                &world.mesh.triangles,
                &positions,
                &normals,
                world.mean_edge,
                desc.smoothness,
            );
            BoundMesh::new(world, &mut nearest, desc)
        })?;
        let mut skin = Self {
            mesh,
            smoothness: desc.smoothness,
            cloth: ClothIdentity::of(world),
            seen: MeshRevision::of(cloth),
            topology_revision: 1,
            state_revision: 0,
            surface,
            particle_positions: positions,
            particle_normals: normals,
            positions: Vec::new(),
            normals: Vec::new(),
        };
        skin.update(cloth)?;
        Ok(skin)
    }

    /// Moves the vertices to where the cloth is now, and follows its tears and cuts.
    ///
    /// Call it once per frame, before the lists are read. [`Skin::write_vertices`] does not need
    /// it.
    ///
    /// # Errors
    /// [`Error::BadHandle`] if the skin was made for another cloth; the skin is unchanged.
    pub fn update(&mut self, cloth: &Cloth) -> Result<()> {
        self.follow(cloth)?;
        let world = &cloth.world;
        with_float_env(|| {
            self.load_particles(world, 1.0);
            let count = self.mesh.sources.len();
            self.positions.resize(count, Vec3::ZERO);
            self.normals.resize(count, Vec3::ZERO);
            let mut block = SkinBlock::default();
            for first in (0..count).step_by(BLOCK) {
                let range = first..count.min(first + BLOCK);
                self.evaluate_block(world, first, false, &mut block);
                copy_block(&block.position, world.origin, &mut self.positions[range.clone()]);
                copy_block(&block.normal, Vec3::ZERO, &mut self.normals[range]);
            }
        });
        self.state_revision = cloth.state_revision;
        Ok(())
    }

    /// As [`Skin::update`], but only if the cloth changed since the last update. For bindings, where
    /// a skin has one cloth for life: two cloths may have the same revisions.
    ///
    /// # Errors
    /// As [`Skin::update`].
    #[doc(hidden)]
    pub fn refresh(&mut self, cloth: &Cloth) -> Result<()> {
        let is_current =
            self.state_revision == cloth.state_revision && self.seen == MeshRevision::of(cloth);
        if is_current && self.cloth == ClothIdentity::of(&cloth.world) {
            return Ok(());
        }
        self.update(cloth)
    }

    /// Follows tears, cuts and resets of the cloth.
    fn follow(&mut self, cloth: &Cloth) -> Result<()> {
        let world = &cloth.world;
        if self.cloth != ClothIdentity::of(world) {
            return Err(Error::BadHandle { what: "skin" });
        }
        let now = MeshRevision::of(cloth);
        if self.seen != now {
            if with_float_env(|| self.mesh.update(world))? {
                self.topology_revision = self.topology_revision.wrapping_add(1);
            }
            self.seen = now;
            self.surface.reserve(world.allocated_particles(), 0);
        }
        Ok(())
    }

    /// Loads positions and normals of the particles at `blend` (0: last tick, 1: current tick).
    fn load_particles(&mut self, world: &World, blend: f32) {
        self.surface.invalidate_positions();
        self.surface.update(world, blend, None);
        let positions: &Columns = self.surface.positions(world, blend);
        interleave(positions.iter(), &mut self.particle_positions);
        interleave(self.surface.normals.iter(), &mut self.particle_normals);
    }

    /// Evaluates the block of vertices from `first` on, a multiple of `BLOCK`.
    fn evaluate_block(
        &self,
        world: &World,
        first: usize,
        with_tangents: bool,
        block: &mut SkinBlock,
    ) {
        let particles =
            ParticlePoints { positions: &self.particle_positions, normals: &self.particle_normals };
        let columns = &self.mesh.columns;
        evaluate(world.level, particles, columns, first, self.smoothness, with_tangents, block);
    }

    /// Returns the positions of the vertices at the last update [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns the unit normals of the vertices at the last update.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Returns the texture coordinates of the vertices; zeros if the descriptor had none.
    pub fn uvs(&self) -> &[Vec2] {
        &self.mesh.uvs
    }

    /// Returns three vertices per triangle. Triangles keep their numbers.
    pub fn indices(&self) -> &[u32] {
        &self.mesh.indices
    }

    /// Returns the vertex of the descriptor that each vertex came from. Vertices of the descriptor
    /// keep their numbers; copies that tears and cuts need follow.
    pub fn source_vertices(&self) -> &[u32] {
        &self.mesh.sources
    }

    /// Returns whether each vertex is on an edge that a tear or cut opened.
    pub fn frayed(&self) -> &[bool] {
        &self.mesh.frayed
    }

    /// Returns the largest number of vertices that the skin may ever have. The number of indices
    /// never changes.
    pub fn vertex_capacity(&self) -> u32 {
        self.mesh.vertex_capacity() as u32
    }

    /// Returns a number that changes whenever vertices are added or removed, or the indices change.
    /// It starts at 1.
    pub fn topology_revision(&self) -> u32 {
        self.topology_revision
    }

    /// Returns [`Cloth::state_revision`] at the last update.
    pub fn state_revision(&self) -> u32 {
        self.state_revision
    }

    /// Returns whether any of these addresses lies in a list of the skin. For bindings whose
    /// callers pass plain pointers.
    pub fn lends(&self, addresses: &Range<usize>) -> bool {
        fn meets<T>(list: &[T], addresses: &Range<usize>) -> bool {
            let start = list.as_ptr().addr();
            start < addresses.end && addresses.start < start + size_of_val(list)
        }
        [&self.positions, &self.normals].into_iter().any(|list| meets(list, addresses))
            || [&self.mesh.sources, &self.mesh.indices]
                .into_iter()
                .any(|list| meets(list, addresses))
            || meets(&self.mesh.uvs, addresses)
            || meets(&self.mesh.frayed, addresses)
    }
}

/// Copies the vectors of a block, moved by `origin`.
fn copy_block([x, y, z]: &[[f32; BLOCK]; 3], origin: Vec3, out: &mut [Vec3]) {
    for (k, out) in out.iter_mut().enumerate().take(BLOCK) {
        *out = Vec3::new(x[k], y[k], z[k]) + origin;
    }
}
