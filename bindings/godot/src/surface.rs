//! The mesh that Godot draws: one surface with the vertices of the cloth.
//!
//! Reads the cloth; writes its vertices into a byte array in the layout of Godot's vertex buffer,
//! which is sent as a whole. A tear or cut makes the surface anew.
//!
//! ```text
//! vertex buffer: x y z | x y z | …    then    n n [t t] | n n [t t] | …    n, t: octahedral, 16 bits
//! ```
//! Invariant: between tears and cuts, no frame allocates memory on this side.

use core::cell::Cell;
use godot::builtin::{
    Aabb, PackedByteArray, PackedInt32Array, PackedVector2Array, PackedVector3Array, Rid, VarArray,
    Vector2, Vector3,
};
use godot::classes::base_material_3d::CullMode;
use godot::classes::mesh::{ArrayFormat, ArrayType, PrimitiveType};
use godot::classes::{ArrayMesh, Material, RenderingServer, StandardMaterial3D};
use godot::meta::ToGodot;
use godot::obj::{EngineBitfield, EngineEnum, Gd, NewGd, Singleton};
use muslin::glam::Affine3;
use muslin::{Attribute, Cloth, Stream, VertexFormat, WriteDesc};

/// The drawn mesh.
#[derive(Default)]
pub struct Surface {
    mesh: Option<Gd<ArrayMesh>>,
    /// The vertex buffer, as it is sent.
    bytes: PackedByteArray,
    layout: Layout,
    /// Vertices and topology revision of the surface; none if the cloth is another one.
    shown: Option<(usize, u32)>,
    bounds: Aabb,
}

/// Where the vertex buffer holds positions and normals.
#[derive(Clone, Copy, Default)]
struct Layout {
    position_stride: u32,
    normal_offset: usize,
    normal_stride: u32,
}

impl Surface {
    /// Forgets the cloth, so that the next update makes the surface anew.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// Removes what is drawn.
    pub fn clear(&mut self) {
        self.forget();
        if let Some(mesh) = &mut self.mesh {
            mesh.clear_surfaces();
        }
    }

    /// The box around the cloth, in the space of the node.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The mesh.
    pub fn mesh(&self) -> Option<Gd<ArrayMesh>> {
        self.mesh.clone()
    }

    /// The mesh, for Godot's renderer.
    pub fn rid(&self) -> Rid {
        self.mesh.as_ref().map_or(Rid::Invalid, |mesh| mesh.get_rid())
    }

    /// Sets the material; without one, the cloth gets a white one that shows both sides.
    pub fn set_material(&mut self, material: Option<Gd<Material>>) {
        let Some(mesh) = &mut self.mesh else { return };
        let material = material.unwrap_or_else(|| {
            let mut both_sides = StandardMaterial3D::new_gd();
            both_sides.set_cull_mode(CullMode::DISABLED);
            both_sides.upcast()
        });
        mesh.surface_set_material(0, &material);
    }

    /// Draws the cloth at `blend` between its last two ticks, in the space of the node. Returns
    /// whether the mesh has a new surface, which has no material yet.
    pub fn update(&mut self, cloth: &mut Cloth, from_world: Affine3, blend: f32) -> bool {
        let desc = WriteDesc { blend, transform: from_world, ..WriteDesc::default() };
        let now = (cloth.positions().len(), cloth.topology_revision());
        let is_new = self.shown != Some(now);
        if is_new {
            self.make(cloth, &desc);
            self.shown = Some(now);
        } else {
            self.send(cloth, &desc);
        }
        if let Some(mesh) = &mut self.mesh {
            mesh.set_custom_aabb(self.bounds);
        }
        is_new
    }

    /// Makes the surface, with its triangles and texture coordinates.
    fn make(&mut self, cloth: &mut Cloth, desc: &WriteDesc) {
        let count = cloth.positions().len();
        let (mut positions, mut normals) = (PackedVector3Array::new(), PackedVector3Array::new());
        positions.resize(count);
        normals.resize(count);
        let streams = [
            stream(Attribute::Position, VertexFormat::F32, 12, cells(positions.as_mut_slice())),
            stream(Attribute::Normal, VertexFormat::F32, 12, cells(normals.as_mut_slice())),
        ];
        write(cloth, &streams, desc);
        self.bounds = bounds(positions.as_slice().iter().copied());
        let uvs = cloth.uvs().iter().map(|uv| Vector2::new(uv.x, uv.y));
        let triangles = cloth.indices().chunks_exact(3);
        let indices = triangles.flat_map(|t| [t[0], t[2], t[1]].map(|i| i as i32));
        let mut arrays = VarArray::new();
        arrays.resize(ArrayType::MAX.ord() as usize, &godot::builtin::Variant::nil());
        let mut set = |kind: ArrayType, list: godot::builtin::Variant| {
            arrays.set(kind.ord() as usize, &list);
        };
        set(ArrayType::VERTEX, positions.to_variant());
        set(ArrayType::NORMAL, normals.to_variant());
        set(ArrayType::TEX_UV, uvs.collect::<PackedVector2Array>().to_variant());
        set(ArrayType::INDEX, indices.collect::<PackedInt32Array>().to_variant());
        let mesh = self.mesh.get_or_insert_with(ArrayMesh::new_gd);
        mesh.clear_surfaces();
        mesh.add_surface_from_arrays_ex(PrimitiveType::TRIANGLES, &arrays)
            .flags(ArrayFormat::FLAG_USE_DYNAMIC_UPDATE)
            .done();
        let format = mesh.surface_get_format(0);
        self.layout = Layout::of(format, count);
        self.bytes.resize(self.layout.size(count));
    }

    /// Sends positions and normals to the surface.
    fn send(&mut self, cloth: &mut Cloth, desc: &WriteDesc) {
        let Layout { position_stride, normal_offset, normal_stride } = self.layout;
        let bytes = self.bytes.as_mut_slice();
        let cells = Cell::from_mut(&mut *bytes).as_slice_of_cells();
        let (normal, octahedral) = (Attribute::Normal, VertexFormat::Octahedral16);
        let streams = [
            stream(Attribute::Position, VertexFormat::F32, position_stride, cells),
            stream(normal, octahedral, normal_stride, &cells[normal_offset..]),
        ];
        write(cloth, &streams, desc);
        // Muslin's 16-bit numbers are signed, from −32767 to 32767; Godot's are from 0 to 65535.
        for normal in bytes[normal_offset..].chunks_mut(normal_stride as usize) {
            normal[1] ^= 0x80;
            normal[3] ^= 0x80;
        }
        let number = |at: &[u8]| f32::from_ne_bytes([at[0], at[1], at[2], at[3]]);
        let points = bytes[..normal_offset].chunks_exact(position_stride as usize);
        let point = |at: &[u8]| Vector3::new(number(at), number(&at[4..]), number(&at[8..]));
        self.bounds = bounds(points.map(point));
        if let Some(mesh) = &mut self.mesh {
            mesh.surface_update_vertex_region(0, 0, &self.bytes);
        }
    }
}

impl Layout {
    fn of(format: ArrayFormat, count: usize) -> Self {
        let server = RenderingServer::singleton();
        let bits = godot::classes::rendering_server::ArrayFormat::from_ord(format.ord());
        let normal = godot::classes::rendering_server::ArrayType::NORMAL.ord();
        let count = count as i32;
        Self {
            position_stride: server.mesh_surface_get_format_vertex_stride(bits, count),
            normal_offset: server.mesh_surface_get_format_offset(bits, count, normal) as usize,
            normal_stride: server.mesh_surface_get_format_normal_tangent_stride(bits, count),
        }
    }

    fn size(&self, count: usize) -> usize {
        count * (self.position_stride + self.normal_stride) as usize
    }
}

/// The box around points.
fn bounds(points: impl Iterator<Item = Vector3>) -> Aabb {
    let empty = (Vector3::splat(f32::INFINITY), Vector3::splat(f32::NEG_INFINITY));
    let (low, high) = points.fold(empty, |(low, high), p| (low.coord_min(p), high.coord_max(p)));
    if low.is_finite() { Aabb::new(low, high - low) } else { Aabb::default() }
}

fn stream(
    attribute: Attribute,
    format: VertexFormat,
    stride: u32,
    bytes: &[Cell<u8>],
) -> Stream<'_> {
    Stream { attribute, format, stride, bytes }
}

/// The bytes of vectors.
fn cells(vectors: &mut [Vector3]) -> &[Cell<u8>] {
    let size = size_of_val(vectors);
    // SAFETY: a `Vector3` is three floats without padding, so that its bytes may be read, and any
    // bytes are valid floats; the borrow of `vectors` lasts as long as the cells.
    unsafe { core::slice::from_raw_parts(vectors.as_mut_ptr().cast::<Cell<u8>>(), size) }
}

/// Writes vertices; the streams fit the cloth, and the transform can be inverted.
fn write(cloth: &mut Cloth, streams: &[Stream<'_>], desc: &WriteDesc) {
    if let Err(error) = cloth.write_vertices(streams, desc) {
        godot::global::godot_error!("MuslinCloth3D: {error}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convert::to_godot;
    use muslin::glam::Vec3;

    #[test]
    fn the_box_holds_all_points_and_none_is_empty() {
        let points = [Vec3::new(1.0, -2.0, 3.0), Vec3::new(-1.0, 0.0, 3.5)];
        let found = bounds(points.into_iter().map(to_godot));
        assert_eq!(found.position, Vector3::new(-1.0, -2.0, 3.0));
        assert_eq!(found.size, Vector3::new(2.0, 2.0, 0.5));
        assert_eq!(bounds(core::iter::empty()), Aabb::default());
    }
}
