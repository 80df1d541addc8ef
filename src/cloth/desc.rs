//! What a cloth is made from: a grid, or any triangle mesh.

use crate::error::{Result, check, check_finite, check_index};
use crate::model::material::Material;
use crate::state::settings::Settings;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// For `extra_particles`: room for as many particles again as the cloth starts with.
pub const AS_MANY_AGAIN: u32 = u32::MAX;

/// No cloth has more particles than this, tears included.
pub(crate) const MAX_PARTICLES: u64 = 1 << 22;

/// How far a grid may be from zero [spacings].
const FARTHEST: f32 = 2097152.0;

/// Which particles of a new grid are pinned where they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum PinMode {
    /// None: it falls.
    None = 0,
    /// The whole first row.
    #[default]
    TopEdge = 1,
    /// The two ends of the first row.
    TopCorners = 2,
    /// All four corners.
    Corners = 3,
}

/// A regular grid of particles; particle = row · columns + column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GridDesc {
    /// Particles across; 40. At least 2.
    pub columns: u32,
    /// Particles down; 40. At least 2.
    pub rows: u32,
    /// Distance between neighbours [m]; 0.05. From 1e-6 to 1e6.
    pub spacing: f32,
    /// Where particle (0, 0), the top left, is [m]; the origin. Within 2097152 `spacing` of zero along each
    /// axis.
    pub origin: Vec3,
    /// Unit direction of a row; +x.
    pub right: Vec3,
    /// Unit direction of a column, square to `right`; −y.
    pub down: Vec3,
    /// What is pinned from the start; the top edge.
    pub pin_mode: PinMode,
    /// Particles that tears may add; [`AS_MANY_AGAIN`].
    pub extra_particles: u32,
    /// What it is made of.
    pub material: Material,
    /// How its time runs.
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
    pub(crate) fn check(&self) -> Result<()> {
        check(self.columns >= 2, "columns", "be at least 2")?;
        check(self.rows >= 2, "rows", "be at least 2")?;
        let count = u64::from(self.columns) * u64::from(self.rows);
        check(count <= MAX_PARTICLES, "columns", "make at most 4194304 particles with `rows`")?;
        check((1.0e-6..=1.0e6).contains(&self.spacing), "spacing", "be from 0.000001 to 1000000")?;
        check_finite(self.origin, "origin")?;
        // Farther off, numbers are too coarse to tell neighbours apart.
        let near = self.origin.abs().max_element() <= FARTHEST * self.spacing;
        check(near, "origin", "be within 2097152 `spacing` of zero along each axis")?;
        let unit = |v: Vec3| (v.length_squared() - 1.0).abs() < 1.0e-3;
        check(unit(self.right), "right", "be a unit direction")?;
        check(unit(self.down), "down", "be a unit direction")?;
        check(self.right.dot(self.down).abs() < 1.0e-3, "down", "be square to `right`")?;
        check_extra(self.extra_particles, count)?;
        self.material.check()?;
        self.settings.check()
    }

    pub(crate) fn capacity(&self) -> usize {
        capacity((self.columns * self.rows) as usize, self.extra_particles)
    }

    /// The particles that `pin_mode` pins, lowest first.
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

/// Any triangle mesh, as artists export them. What cannot be cloth in it is repaired, see
/// [`MeshReport`](crate::MeshReport): doubled vertices are welded, triangles without an area and repeated
/// ones dropped; where more than two triangles share an edge the flattest two stay joined and the others get
/// an edge of their own; sheets that meet at a mere point are parted; the triangles of a piece are turned to
/// face as most of them do. Vertices that no triangle uses stay where they are.
///
/// A mesh that is a regular grid, its vertices and triangles in the order that [`GridDesc`] has them, is
/// woven as that grid is: it moves in the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeshDesc {
    /// Where the vertices are at rest [m]. Each is the particle of its number if nothing is welded or split,
    /// see [`Cloth::vertex_particles`](crate::Cloth::vertex_particles).
    pub positions: Vec<Vec3>,
    /// Three vertices a triangle, counter-clockwise seen from its front.
    pub indices: Vec<u32>,
    /// Texture coordinates, one a vertex; or none at all.
    pub uvs: Vec<Vec2>,
    /// Vertices whose particles are pinned from the start.
    pub pinned: Vec<u32>,
    /// Vertices at most this far apart share a particle [m]; 0 joins those at the very same place, −1 (or
    /// anything below 0) leaves all apart. Vertices are taken in order, and each joins the nearest one
    /// before it that stayed apart; but the corners of a triangle stay apart, however small it is. Keep it
    /// well below the shortest edge.
    pub weld_distance: f32,
    /// Particles that tears may add; [`AS_MANY_AGAIN`].
    pub extra_particles: u32,
    /// What it is made of.
    pub material: Material,
    /// How its time runs.
    pub settings: Settings,
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
        }
    }
}

impl MeshDesc {
    pub(crate) fn check(&self) -> Result<()> {
        let count = self.positions.len() as u64;
        check(count >= 3, "positions", "hold at least 3 vertices")?;
        check(count <= MAX_PARTICLES, "positions", "hold at most 4194304 vertices")?;
        self.positions.iter().try_for_each(|position| check_finite(*position, "positions"))?;
        let triples = !self.indices.is_empty() && self.indices.len().is_multiple_of(3);
        check(triples, "indices", "hold three for each of one or more triangles")?;
        check(
            self.uvs.is_empty() || self.uvs.len() == self.positions.len(),
            "uvs",
            "be as many as `positions`, or none",
        )?;
        let finite = self.uvs.iter().all(|uv| uv.is_finite());
        check(finite, "uvs", "be finite")?;
        for vertex in &self.pinned {
            check_index(*vertex, self.positions.len(), "pinned")?;
        }
        check(self.weld_distance.is_finite(), "weld_distance", "be finite")?;
        check_extra(self.extra_particles, count)?;
        self.material.check()?;
        self.settings.check()
    }

    /// How many particles there may ever be, if it comes to so many.
    pub(crate) fn capacity(&self, particles: usize) -> Result<usize> {
        let fits = particles as u64 <= MAX_PARTICLES;
        check(fits, "indices", "make at most 4194304 particles")?;
        Ok(capacity(particles, self.extra_particles))
    }
}

fn check_extra(extra: u32, count: u64) -> Result<()> {
    let fits = extra == AS_MANY_AGAIN || count + u64::from(extra) <= 2 * MAX_PARTICLES;
    check(fits, "extra_particles", "leave at most 8388608 particles in all")
}

fn capacity(count: usize, extra: u32) -> usize {
    count + if extra == AS_MANY_AGAIN { count } else { extra as usize }
}
