//! Descriptors: the grid or the triangle mesh that a cloth is made from.
//!
//! Reads nothing; `cloth::build` turns a descriptor into a `World`.
//! Invariant: a descriptor that passed `check` can be built; only a mesh may still fail, with
//! [`Error::BadMesh`](crate::Error::BadMesh).

use crate::error::{Result, check, check_finite, check_index};
use crate::model::material::Material;
use crate::state::settings::Settings;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Value of `extra_particles` that reserves as many particles again as the cloth starts with.
pub const AS_MANY_AGAIN: u32 = u32::MAX;

/// Largest number of particles at creation; with the reserve, twice as many.
pub(crate) const MAX_PARTICLES: u64 = 1 << 22;

/// Largest distance of a grid from zero along an axis [spacings].
const FARTHEST: f32 = 2097152.0;

/// Which particles of a new grid are pinned at their positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum PinMode {
    /// No particle: the cloth falls.
    None = 0,
    /// All particles of the first row.
    #[default]
    TopEdge = 1,
    /// The two ends of the first row.
    TopCorners = 2,
    /// All four corners.
    Corners = 3,
}

/// A regular grid of particles. The particle at `row` and `column` has the index `row · columns +
/// column`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GridDesc {
    /// Particles per row. Default 40; at least 2.
    pub columns: u32,
    /// Number of rows. Default 40; at least 2. A grid has at most 4194304 particles.
    pub rows: u32,
    /// Distance between neighbours [m]. Default 0.05; from 1e-6 to 1e6.
    pub spacing: f32,
    /// Position of particle (0, 0), the top left corner [m]. Default 0, 0, 0; within 2097152 times
    /// `spacing` of zero along each axis.
    pub origin: Vec3,
    /// Unit direction along a row. Default +x.
    pub right: Vec3,
    /// Unit direction along a column, perpendicular to `right`. Default −y.
    pub down: Vec3,
    /// Particles that are pinned from the start. Default: the top edge.
    pub pin_mode: PinMode,
    /// Particles to reserve for tears and cuts. Default [`AS_MANY_AGAIN`]. Memory for them is
    /// allocated with [`Settings::tearing`], or by the first tear or cut.
    pub extra_particles: u32,
    /// The material.
    pub material: Material,
    /// The settings.
    pub settings: Settings,
}

impl Default for GridDesc {
    fn default() -> Self {
        Self {
            columns: 40,
            rows: 40,
            spacing: 0.05,
            origin: Vec3::ZERO,
            right: Vec3::X,
            down: Vec3::NEG_Y,
            pin_mode: PinMode::TopEdge,
            extra_particles: AS_MANY_AGAIN,
            material: Material::default(),
            settings: Settings::default(),
        }
    }
}

impl GridDesc {
    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the first invalid field and its rule.
    pub(crate) fn check(&self) -> Result<()> {
        check(self.columns >= 2, "columns", "be at least 2")?;
        check(self.rows >= 2, "rows", "be at least 2")?;
        let count = u64::from(self.columns) * u64::from(self.rows);
        check(count <= MAX_PARTICLES, "columns", "give at most 4194304 particles with `rows`")?;
        check((1.0e-6..=1.0e6).contains(&self.spacing), "spacing", "be from 0.000001 to 1000000")?;
        check_finite(self.origin, "origin")?;
        // Farther away, f32 cannot resolve the distance between neighbours.
        let near = self.origin.abs().max_element() <= FARTHEST * self.spacing;
        check(near, "origin", "be within 2097152 times `spacing` of zero along each axis")?;
        let unit = |v: Vec3| (v.length_squared() - 1.0).abs() < 1.0e-3;
        check(unit(self.right), "right", "be a unit vector")?;
        check(unit(self.down), "down", "be a unit vector")?;
        check(self.right.dot(self.down).abs() < 1.0e-3, "down", "be perpendicular to `right`")?;
        check_extra(self.extra_particles, count)?;
        self.material.check()?;
        self.settings.check()
    }

    /// Returns the largest number of particles that the cloth may ever have.
    pub(crate) fn capacity(&self) -> usize {
        capacity((self.columns * self.rows) as usize, self.extra_particles)
    }

    /// Returns the particles that `pin_mode` pins, in ascending order.
    pub(crate) fn pinned(&self) -> Vec<u32> {
        let (last, count) = (self.columns - 1, self.columns * self.rows);
        match self.pin_mode {
            PinMode::None => Vec::new(),
            PinMode::TopEdge => (0..self.columns).collect(),
            PinMode::TopCorners => vec![0, last],
            PinMode::Corners => vec![0, last, count - self.columns, count - 1],
        }
    }
}

/// Any triangle mesh, as modelling tools export them.
///
/// Defects are repaired in this order, and [`Cloth::mesh_report`](crate::Cloth::mesh_report) counts
/// the repairs:
///
/// - duplicate vertices are welded (see `weld_distance`);
/// - triangles without an area and repeated triangles are dropped;
/// - where more than two triangles share an edge, the flattest pair stays joined and the others get
///   an edge of their own;
/// - sheets that touch in a single vertex are separated there;
/// - within each piece, triangles are turned to face as most of them do;
/// - if `simplify_below` is above 0, short edges are collapsed.
///
/// Vertices that no triangle uses stay where they are.
///
/// A mesh that is a regular grid, with vertices and triangles in the order of [`GridDesc`], is
/// simulated as that grid, with identical bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeshDesc {
    /// Rest positions of the vertices [m]; from 3 to 4194304. If nothing is welded, split or
    /// collapsed, vertex `i` is particle `i`; otherwise see
    /// [`Cloth::vertex_particles`](crate::Cloth::vertex_particles).
    pub positions: Vec<Vec3>,
    /// Three vertices per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Texture coordinates, one entry per vertex, or empty for none.
    pub uvs: Vec<Vec2>,
    /// Vertices whose particles are pinned from the start.
    pub pinned: Vec<u32>,
    /// Vertices at most this far apart share one particle [m]. Default −1.
    ///
    /// 0 welds vertices at exactly the same position; a negative value welds nothing. Vertices are
    /// processed in order: each joins the nearest earlier vertex that was not welded itself.
    /// Corners of one triangle are never welded together. Choose a value well below the shortest
    /// edge.
    pub weld_distance: f32,
    /// Particles to reserve for tears and cuts. Default [`AS_MANY_AGAIN`]. Memory for them is
    /// allocated with [`Settings::tearing`], or by the first tear or cut.
    pub extra_particles: u32,
    /// The material.
    pub material: Material,
    /// The settings.
    pub settings: Settings,
    /// Edges shorter than this are collapsed [m]. Default 0: none; at most the mean length of the
    /// edges.
    ///
    /// One end of such an edge moves to the other, with its vertices, and the triangles at the edge
    /// are removed. Triangles that are lower than this get another diagonal where that makes them
    /// higher. Borders, seams of texture coordinates and their corners stay, a pinned vertex moves
    /// to pinned ones only, and the topology stays; [`MeshReport`](crate::MeshReport) counts the
    /// edges that are short nevertheless. A tenth to a third of the mean edge removes the slivers of
    /// most meshes.
    pub simplify_below: f32,
}

impl Default for MeshDesc {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            indices: Vec::new(),
            uvs: Vec::new(),
            pinned: Vec::new(),
            weld_distance: -1.0,
            extra_particles: AS_MANY_AGAIN,
            material: Material::default(),
            settings: Settings::default(),
            simplify_below: 0.0,
        }
    }
}

impl MeshDesc {
    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) or [`Error::BadIndex`](crate::Error::BadIndex)
    /// names the first invalid field and its rule.
    pub(crate) fn check(&self) -> Result<()> {
        let count = self.positions.len() as u64;
        check(count >= 3, "positions", "hold at least 3 vertices")?;
        check(count <= MAX_PARTICLES, "positions", "hold at most 4194304 vertices")?;
        self.positions.iter().try_for_each(|position| check_finite(*position, "positions"))?;
        let triples = !self.indices.is_empty() && self.indices.len().is_multiple_of(3);
        check(triples, "indices", "hold three entries for each of one or more triangles")?;
        check(
            self.uvs.is_empty() || self.uvs.len() == self.positions.len(),
            "uvs",
            "have as many entries as `positions`, or none",
        )?;
        let finite = self.uvs.iter().all(|uv| uv.is_finite());
        check(finite, "uvs", "be finite")?;
        for vertex in &self.pinned {
            check_index(*vertex, self.positions.len(), "pinned")?;
        }
        check(self.weld_distance.is_finite(), "weld_distance", "be finite")?;
        let is_length = self.simplify_below.is_finite() && self.simplify_below >= 0.0;
        check(is_length, "simplify_below", "be finite and at least 0")?;
        check_extra(self.extra_particles, count)?;
        self.material.check()?;
        self.settings.check()
    }

    /// Returns the largest number of particles that a cloth may ever have that starts with
    /// `particles`.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if the repaired mesh has too many particles.
    pub(crate) fn capacity(&self, particles: usize) -> Result<usize> {
        let fits = particles as u64 <= MAX_PARTICLES;
        check(fits, "indices", "give at most 4194304 particles")?;
        Ok(capacity(particles, self.extra_particles))
    }
}

fn check_extra(extra: u32, count: u64) -> Result<()> {
    let fits = extra == AS_MANY_AGAIN || count + u64::from(extra) <= 2 * MAX_PARTICLES;
    check(fits, "extra_particles", "allow at most 8388608 particles in total")
}

fn capacity(count: usize, extra: u32) -> usize {
    count + if extra == AS_MANY_AGAIN { count } else { extra as usize }
}
