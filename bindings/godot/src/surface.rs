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
    Aabb, PackedByteArray, PackedFloat32Array, PackedInt32Array, PackedVector2Array,
    PackedVector3Array, Rid, VarArray, Vector2, Vector3,
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
    /// Tangents as Muslin writes them, eight bytes each; empty if the surface has none.
    tangents: Vec<u8>,
    /// Vertices and topology revision of the surface, and whether it has tangents; none if the cloth
    /// is another one.
    shown: Option<(usize, u32, bool)>,
    /// State revision, transform and blend that the vertices have.
    sent: Option<(u32, Affine3, f32)>,
    bounds: Aabb,
    /// The material of a cloth that has no other.
    both_sides: Option<Gd<Material>>,
}

/// Where the vertex buffer holds positions and normals; a tangent is behind each normal.
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
        let both_sides = self.both_sides.get_or_insert_with(|| {
            let mut both_sides = StandardMaterial3D::new_gd();
            both_sides.set_cull_mode(CullMode::DISABLED);
            both_sides.upcast()
        });
        if let Some(mesh) = &mut self.mesh {
            mesh.surface_set_material(0, material.as_ref().unwrap_or(both_sides));
        }
    }

    /// Draws the cloth, unless it is drawn so already, at `blend` between its last two ticks, in the space of the node, with
    /// tangents if so wanted. Returns whether the mesh has a new surface, which has no material yet.
    pub fn update(
        &mut self,
        cloth: &mut Cloth,
        from_world: Affine3,
        blend: f32,
        with_tangents: bool,
    ) -> bool {
        let desc = WriteDesc { blend, transform: from_world, ..WriteDesc::default() };
        let count = cloth.positions().len();
        self.tangents.resize(if with_tangents { 8 * count } else { 0 }, 0);
        let now = (count, cloth.topology_revision(), with_tangents);
        let is_new = self.shown != Some(now);
        let sent = Some((cloth.state_revision(), from_world, blend));
        if !is_new && self.sent == sent {
            return false;
        }
        self.sent = sent;
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
        let mut tangents = PackedFloat32Array::new();
        if !self.tangents.is_empty() {
            tangents.resize(4 * count);
            let cells = cells(tangents.as_mut_slice());
            write(cloth, &[stream(Attribute::Tangent, VertexFormat::F32, 16, cells)], desc);
            // Godot's bitangent points up in the texture, where v is smaller.
            tangents.as_mut_slice().chunks_exact_mut(4).for_each(|t| t[3] = -t[3]);
        }
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
        if !tangents.is_empty() {
            set(ArrayType::TANGENT, tangents.to_variant());
        }
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
        for normal in bytes[normal_offset..].chunks_exact_mut(normal_stride as usize) {
            encode_normal(normal);
        }
        if !self.tangents.is_empty() {
            let cells = Cell::from_mut(&mut self.tangents[..]).as_slice_of_cells();
            write(cloth, &[stream(Attribute::Tangent, octahedral, 8, cells)], desc);
            let normals = bytes[normal_offset..].chunks_exact_mut(normal_stride as usize);
            for (to, tangent) in normals.zip(self.tangents.chunks_exact(8)) {
                to[4..].copy_from_slice(&encoded_tangent(tangent));
            }
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

/// Turns a normal of Muslin, two numbers from −32767 to 32767, into one of Godot: from 0 to 65535.
fn encode_normal(normal: &mut [u8]) {
    for number in normal[..4].chunks_exact_mut(2) {
        number.copy_from_slice(&unsigned(number).to_ne_bytes());
    }
}

/// The number from 0 to 65535 for one from −32767 to 32767.
fn unsigned(number: &[u8]) -> u16 {
    u16::from_ne_bytes([number[0], number[1]]) ^ 0x8000
}

/// Turns a tangent of Muslin, octahedral u v and handedness, into one of Godot, where the upper or
/// the lower half of the range of v tells the handedness, which is the opposite one.
fn encoded_tangent(tangent: &[u8]) -> [u8; 4] {
    let (u, v) = (unsigned(tangent), unsigned(&tangent[2..]));
    let upper = 0x8000 + v.max(2) / 2;
    let is_mirrored = i16::from_ne_bytes([tangent[4], tangent[5]]) > 0;
    let v = if is_mirrored { u16::MAX - upper } else { upper };
    let ([a, b], [c, d]) = (u.to_ne_bytes(), v.to_ne_bytes());
    [a, b, c, d]
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

/// Numbers without padding, of which any bytes are valid.
trait Floats {}
impl Floats for f32 {}
impl Floats for Vector3 {}

/// The bytes of numbers.
fn cells<T: Floats>(numbers: &mut [T]) -> &[Cell<u8>] {
    let size = size_of_val(numbers);
    // SAFETY: floats have no padding, so that their bytes may be read, and any bytes are valid
    // floats; the borrow of `numbers` lasts as long as the cells.
    unsafe { core::slice::from_raw_parts(numbers.as_mut_ptr().cast::<Cell<u8>>(), size) }
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
    fn directions_are_encoded_over_the_whole_range() {
        let bytes = |numbers: &[i16]| numbers.iter().flat_map(|n| n.to_ne_bytes()).collect();
        let mut normal: Vec<u8> = bytes(&[-32767, 0]);
        encode_normal(&mut normal);
        assert_eq!([unsigned(&normal) ^ 0x8000, unsigned(&normal[2..]) ^ 0x8000], [1, 0x8000]);
        let numbers = |tangent: [i16; 4]| {
            let bytes: Vec<u8> = bytes(&tangent);
            let [a, b, c, d] = encoded_tangent(&bytes);
            [u16::from_ne_bytes([a, b]), u16::from_ne_bytes([c, d])]
        };
        assert_eq!(numbers([32767, 32767, -32767, 0]), [65535, 65535]);
        assert_eq!(numbers([32767, 32767, 32767, 0]), [65535, 0]);
        assert_eq!(numbers([0, -32767, -32767, 0]), [0x8000, 0x8001]);
    }

    #[test]
    fn the_box_holds_all_points_and_none_is_empty() {
        let points = [Vec3::new(1.0, -2.0, 3.0), Vec3::new(-1.0, 0.0, 3.5)];
        let found = bounds(points.into_iter().map(to_godot));
        assert_eq!(found.position, Vector3::new(-1.0, -2.0, 3.0));
        assert_eq!(found.size, Vector3::new(2.0, 2.0, 0.5));
        assert_eq!(bounds(core::iter::empty()), Aabb::default());
    }
}
