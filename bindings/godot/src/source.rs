//! What a cloth is made of: the mesh of the node or a grid, and the pinned vertices.
//!
//! Reads a `Mesh` of Godot; writes positions in the space of the node, triangles that are
//! counter-clockwise seen from the front, as Muslin has them, and texture coordinates.
//! Invariant: Godot's triangles are clockwise, so every triangle is turned on its way in.

use crate::choices::PinMode;
use crate::convert::to_muslin;
use crate::refusal::{Refusal, Result, check};
use godot::builtin::{
    PackedColorArray, PackedInt32Array, PackedVector2Array, PackedVector3Array, VarArray,
};
use godot::classes::mesh::{ArrayType, PrimitiveType};
use godot::classes::{ArrayMesh, Mesh};
use godot::meta::FromGodot;
use godot::obj::{EngineEnum, Gd};
use muslin::glam::{Vec2, Vec3};

/// Most particles of a new cloth.
const MAX_PARTICLES: u64 = 1 << 22;
/// Red from which on a vertex colour pins.
const PIN_RED: f32 = 0.5;

/// Size of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridSize {
    /// Particles per row, and number of rows.
    pub columns: i64,
    pub rows: i64,
    /// Size [m].
    pub width: f32,
    pub height: f32,
}

/// Vertices, triangles and pins, in the space of the node.
#[derive(Clone, Debug, Default)]
pub struct Source {
    pub positions: Vec<Vec3>,
    pub indices: Vec<u32>,
    pub uvs: Vec<Vec2>,
    pub pinned: Vec<u32>,
}

impl Source {
    /// Makes a grid that hangs from the origin: its top edge is centred along x, it extends to
    /// −y, and its front looks along z.
    pub fn grid(size: GridSize, pin_mode: PinMode, vertices: &PackedInt32Array) -> Result<Self> {
        check(size.columns >= 2, "columns", "be at least 2")?;
        check(size.rows >= 2, "rows", "be at least 2")?;
        let count = (size.columns as u64).saturating_mul(size.rows as u64);
        check(count <= MAX_PARTICLES, "columns", "give at most 4194304 particles with `rows`")?;
        let is_size = |v: f32| v.is_finite() && v > 0.0;
        check(is_size(size.width), "width", "be above 0 and finite")?;
        check(is_size(size.height), "height", "be above 0 and finite")?;
        let (columns, rows) = (size.columns as u32, size.rows as u32);
        let (mut positions, mut uvs) = (Vec::new(), Vec::new());
        for row in 0..rows {
            for column in 0..columns {
                let (u, v) = (column as f32 / (columns - 1) as f32, row as f32 / (rows - 1) as f32);
                positions.push(Vec3::new((u - 0.5) * size.width, -v * size.height, 0.0));
                uvs.push(Vec2::new(u, v));
            }
        }
        let count = columns * rows;
        let pinned = match pin_mode {
            PinMode::None => Vec::new(),
            PinMode::TopEdge => (0..columns).collect(),
            PinMode::TopCorners => vec![0, columns - 1],
            PinMode::Corners => vec![0, columns - 1, count - columns, count - 1],
            PinMode::LeftEdge => (0..rows).map(|row| row * columns).collect(),
            PinMode::Vertices => listed(vertices)?,
            PinMode::VertexColor => {
                let must = "not be VertexColor without a `mesh`: a grid has no vertex colours";
                return Err(Refusal::new(format!("`pin_mode` must {must}")));
            }
        };
        Ok(Self { positions, indices: grid_indices(columns, rows), uvs, pinned })
    }

    /// Reads the only surface of a mesh.
    pub fn mesh(mesh: &Gd<Mesh>, pin_mode: PinMode, vertices: &PackedInt32Array) -> Result<Self> {
        let surfaces = mesh.get_surface_count();
        if surfaces != 1 {
            let must = format!("have exactly one surface, but has {surfaces}");
            return Err(Refusal::new(format!("`mesh` must {must}")));
        }
        if let Ok(mesh) = mesh.clone().try_cast::<ArrayMesh>() {
            let are_triangles = mesh.surface_get_primitive_type(0) == PrimitiveType::TRIANGLES;
            check(are_triangles, "mesh", "be made of triangles")?;
        }
        let arrays = mesh.surface_get_arrays(0);
        let points: PackedVector3Array = list(&arrays, ArrayType::VERTEX);
        let positions: Vec<_> = points.as_slice().iter().map(|v| to_muslin(*v)).collect();
        let given: PackedInt32Array = list(&arrays, ArrayType::INDEX);
        let mut indices: Vec<u32> = given.as_slice().iter().map(|i| *i as u32).collect();
        if indices.is_empty() {
            indices = (0..positions.len() as u32).collect();
        }
        indices.chunks_exact_mut(3).for_each(|triangle| triangle.swap(1, 2));
        let uvs: PackedVector2Array = list(&arrays, ArrayType::TEX_UV);
        let uvs = uvs.as_slice().iter().map(|uv| Vec2::new(uv.x, uv.y)).collect();
        let pinned = match pin_mode {
            PinMode::None => Vec::new(),
            PinMode::Vertices => listed(vertices)?,
            PinMode::VertexColor => {
                let colors: PackedColorArray = list(&arrays, ArrayType::COLOR);
                let must = "have vertex colours, since `pin_mode` is VertexColor";
                check(!colors.is_empty(), "mesh", must)?;
                let is_pinned = |i: &u32| colors.as_slice()[*i as usize].r >= PIN_RED;
                (0..colors.len() as u32).filter(is_pinned).collect()
            }
            _ => {
                let must = "be None, VertexColor or Vertices, since `mesh` is no grid";
                return Err(Refusal::new(format!("`pin_mode` must {must}")));
            }
        };
        Ok(Self { positions, indices, uvs, pinned })
    }
}

/// Returns a list of a surface, empty if the surface has none.
fn list<T: FromGodot + Default>(arrays: &VarArray, kind: ArrayType) -> T {
    arrays.get(kind.ord() as usize).and_then(|list| list.try_to().ok()).unwrap_or_default()
}

/// Returns the vertices that a property names.
fn listed(vertices: &PackedInt32Array) -> Result<Vec<u32>> {
    let number = |vertex: &i32| {
        let must = || Refusal::new(format!("`pin_vertices` must be at least 0, but is {vertex}"));
        u32::try_from(*vertex).map_err(|_| must())
    };
    vertices.as_slice().iter().map(number).collect()
}

/// Two triangles per cell, in the order in which Muslin recognises a regular grid.
fn grid_indices(columns: u32, rows: u32) -> Vec<u32> {
    let mut indices = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let (a, b) = (row * columns + column, row * columns + column + 1);
            let (c, d) = (a + columns, b + columns);
            indices.extend(if (row + column) % 2 == 0 {
                [a, c, d, a, d, b]
            } else {
                [a, c, b, c, d, b]
            });
        }
    }
    indices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_triangles_of_a_grid_are_those_of_the_library() {
        let desc = muslin::GridDesc { columns: 5, rows: 4, ..muslin::GridDesc::default() };
        let cloth = muslin::Cloth::grid(&desc).unwrap();
        assert_eq!(grid_indices(5, 4), cloth.indices());
    }
}
