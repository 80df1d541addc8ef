//! Public calls that write vertices and indices into the caller's own buffers.
//!
//! ```text
//! for each block of vertices:
//!     for each stream:   gather or load  ▶  blend  ▶  transform  ▶  pack to the format  ▶  write
//! ```
//!
//! Reads `World` and `Outputs`; writes only the caller's bytes.
//! Invariant: all checks come first, so a refused call leaves the buffers untouched.

use crate::cloth::Cloth;
use crate::cloth::interpolated_surface::InterpolatedSurface;
use crate::cloth::vertex_stream::{Attribute, Stream, VertexFormat, WriteDesc, check_all};
use crate::error::{Result, check};
use crate::math::float_env::with_float_env;
use crate::math::pack;
use crate::math::pack::{BLOCK, FloatBlock, HalfBlock};
use crate::math::simd::Level;
use crate::solver::output::normals;
use crate::solver::output::vertex_transform;
use crate::solver::output::vertex_transform::{VertexBlock, VertexTransform};
use crate::solver::stage::Stage;
use crate::solver::world::World;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// Width of the indices in a buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum IndexFormat {
    /// 16 bits.
    U16 = 16,
    /// 32 bits.
    #[default]
    U32 = 32,
}

impl IndexFormat {
    /// Returns the size of one index [bytes].
    pub fn size(self) -> usize {
        self as usize / 8
    }
}

impl Cloth {
    /// Writes the indices of all triangles to the start of `buffer`, in the byte order of the
    /// machine.
    ///
    /// `base_vertex` is added to each index; `flip` reverses the winding of every triangle. A
    /// buffer for the view's `index_capacity` indices is always large enough.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if the indices do not fit `buffer`, or the
    /// largest index does not fit `format`. Index 65535 is refused in 16 bits, since many graphics
    /// APIs use it for primitive restart. The buffer is untouched then.
    pub fn write_indices(
        &self,
        buffer: &mut [u8],
        format: IndexFormat,
        flip: bool,
        base_vertex: u32,
    ) -> Result<()> {
        let vertices = self.positions().len();
        write_indices(self.indices(), vertices, buffer, format, flip, base_vertex)
    }

    /// Writes vertices into the caller's buffers, each attribute with the format, position and
    /// stride of its [`Stream`]: separate, interleaved or one after the other. Other bytes are
    /// untouched.
    ///
    /// Buffers for the view's `vertex_capacity` vertices are always large enough. The first call
    /// that writes tangents, or normals at a blend below 1, allocates memory for them; other calls
    /// do not allocate.
    ///
    /// # Errors
    /// - [`Error::BadValue`](crate::Error::BadValue) for an invalid field of `desc`, unless there
    ///   are 1 to 16 streams, or if normals or tangents are written with a transform that cannot be
    ///   inverted.
    /// - [`Error::BadStream`](crate::Error::BadStream) names the stream and its invalid field: the
    ///   format cannot write the attribute, stride or alignment do not fit the format, or the bytes
    ///   overlap an earlier stream.
    /// - [`Error::SmallStream`](crate::Error::SmallStream) if the vertices do not fit a buffer.
    ///
    /// The buffers are untouched then.
    pub fn write_vertices(&mut self, streams: &[Stream<'_>], desc: &WriteDesc) -> Result<()> {
        let vertices = desc.check(self.positions().len())?;
        check_all(streams, vertices.len())?;
        let has = |attribute| streams.iter().any(|stream| stream.attribute == attribute);
        let (needs_normals, needs_tangents) = (has(Attribute::Normal), has(Attribute::Tangent));
        let start = self.world.profile.start();
        let (world, outputs) = (&self.world, &mut self.outputs);
        let transform = write_transform(world, streams, desc)?;
        if needs_normals || needs_tangents || transform.is_offset() {
            world.threads.run_in_pool(world.particles.len(), || {
                with_float_env(|| outputs.update_surface(world, desc.blend, needs_tangents));
            });
        }
        let (uvs, frayed) = (self.uvs(), self.frayed());
        let particles = world.seams.as_ref().map(|_| self.vertex_particles());
        let writer = VertexWriter {
            level: world.level,
            transform,
            x: world.particles.x.slices(),
            last: world.particles.x_prev_tick.slices(),
            surface: &self.outputs.surface,
            particles,
            uvs,
            frayed,
        };
        with_float_env(|| writer.write(streams, vertices));
        self.world.profile.add(Stage::Outputs, start);
        Ok(())
    }
}

/// Checks and writes the indices of a mesh with `vertices` vertices. See [`Cloth::write_indices`].
pub(in crate::cloth) fn write_indices(
    indices: &[u32],
    vertices: usize,
    buffer: &mut [u8],
    format: IndexFormat,
    flip: bool,
    base_vertex: u32,
) -> Result<()> {
    let fits = buffer.len() >= indices.len() * format.size();
    check(fits, "buffer", "hold all indices")?;
    let last = u64::from(base_vertex) + vertices as u64 - 1;
    check(
        format == IndexFormat::U32 || last < u64::from(u16::MAX),
        "index_format",
        "be 32 bits when an index is above 65534",
    )?;
    check(last < u64::from(u32::MAX), "base_vertex", "leave every index below 4294967295")?;
    let offset = |index: u32| index + base_vertex;
    match format {
        IndexFormat::U16 => {
            write_triangles(buffer, indices, flip, |i| (offset(i) as u16).to_ne_bytes());
        }
        IndexFormat::U32 => write_triangles(buffer, indices, flip, |i| offset(i).to_ne_bytes()),
    }
    Ok(())
}

/// Returns the transform of a checked `desc`.
///
/// # Errors
/// [`Error::BadValue`](crate::Error::BadValue) if normals or tangents are written and it cannot be
/// inverted.
pub(in crate::cloth) fn write_transform(
    world: &World,
    streams: &[Stream<'_>],
    desc: &WriteDesc,
) -> Result<VertexTransform> {
    let transform = with_float_env(|| {
        let origin = if desc.relative { Vec3::ZERO } else { world.origin };
        let transform = vertex_transform::from_origin(desc.transform, origin);
        VertexTransform::new(desc.blend, desc.offset, desc.flip_normals, transform)
    });
    let is_direction =
        |stream: &Stream<'_>| matches!(stream.attribute, Attribute::Normal | Attribute::Tangent);
    check(
        transform.can_transform_directions() || !streams.iter().any(is_direction),
        "transform",
        "be one that can be inverted when normals or tangents are written",
    )?;
    Ok(transform)
}

/// Writes the indices of triangles, with reversed winding if `flip`.
fn write_triangles<const SIZE: usize>(
    buffer: &mut [u8],
    indices: &[u32],
    flip: bool,
    bytes_of: impl Fn(u32) -> [u8; SIZE],
) {
    let (second, third) = if flip { (2, 1) } else { (1, 2) };
    let triangles = buffer.as_chunks_mut().0.as_chunks_mut::<3>().0;
    for (triangle, corners) in triangles.iter_mut().zip(indices.as_chunks::<3>().0) {
        *triangle = [0, second, third].map(|k| bytes_of(corners[k]));
    }
}

/// The data that vertices are written from.
struct VertexWriter<'a> {
    level: Level,
    transform: VertexTransform,
    x: [&'a [f32]; 3],
    last: [&'a [f32]; 3],
    surface: &'a InterpolatedSurface,
    /// The particle of each vertex; `None` if vertex `i` is particle `i`.
    particles: Option<&'a [u32]>,
    uvs: &'a [Vec2],
    frayed: &'a [bool],
}

impl VertexWriter<'_> {
    /// Writes all streams block by block, so that a block's data stays in cache.
    fn write(&self, streams: &[Stream<'_>], vertices: Range<usize>) {
        let mut scratch = BlockScratch::default();
        for first in vertices.clone().step_by(BLOCK) {
            let block = first..vertices.end.min(first + BLOCK);
            for stream in streams {
                self.compute(stream.attribute, block.clone(), &mut scratch);
                scratch.write(self.level, stream, first - vertices.start, block.len());
            }
        }
    }

    /// Computes one attribute of a block of vertices into `scratch`.
    fn compute(&self, attribute: Attribute, block: Range<usize>, scratch: &mut BlockScratch) {
        let BlockScratch { vector, w, normals, last, .. } = scratch;
        let load = |to: &mut [FloatBlock], columns: &[&[f32]]| {
            vertex_transform::load(to, columns, block.start, block.len());
        };
        // Attributes of particles.
        let load_of_particles = |to: &mut [FloatBlock], columns: &[&[f32]]| match self.particles {
            Some(particles) => vertex_transform::gather(to, columns, &particles[block.clone()]),
            None => load(to, columns),
        };
        let needs_normals = match attribute {
            Attribute::Position => self.transform.is_offset(),
            attribute => attribute == Attribute::Tangent,
        };
        if needs_normals {
            load_of_particles(normals, &self.surface.normals.slices());
        }
        match attribute {
            Attribute::Position => {
                load_of_particles(vector, &self.x);
                if self.transform.share != 1.0 {
                    load_of_particles(last, &self.last);
                    blend(self.level, vector, last, block.len(), self.transform.share);
                }
                self.transform.transform_positions(vector, normals);
                w.fill(1.0);
            }
            Attribute::Normal => {
                load_of_particles(vector, &self.surface.normals.slices());
                self.transform.transform_normals(vector);
                w.fill(0.0);
            }
            Attribute::Tangent => {
                // `write_vertices` computed the tangents for this request.
                let Some(tangents) = &self.surface.tangents else { return };
                let (sums, handedness) = tangents.columns();
                load(vector, &sums);
                load(core::slice::from_mut(w), &[handedness]);
                self.transform.transform_tangents(vector, normals, w);
            }
            Attribute::Uv => {
                let [u, v, ..] = vector;
                for ((u, v), uv) in u.iter_mut().zip(v).zip(&self.uvs[block]) {
                    (*u, *v) = (uv.x, uv.y);
                }
            }
            Attribute::Frayed => {
                let [frayed, padding, _] = vector;
                let is_frayed = frayed.iter_mut().zip(&self.frayed[block]);
                is_frayed.for_each(|(to, is)| *to = f32::from(*is));
                padding.fill(0.0);
            }
        }
    }
}

/// Interpolates from the positions of the last tick to those of the current one.
fn blend(level: Level, x: &mut VertexBlock, last: &VertexBlock, count: usize, factor: f32) {
    for (x, last) in x.iter_mut().zip(last) {
        normals::blend(level, &mut x[..count], &last[..count], factor);
    }
}

/// Scratch buffers for one block of vertices.
pub(in crate::cloth) struct BlockScratch {
    /// The first three components to write.
    pub vector: VertexBlock,
    /// The fourth component.
    pub w: FloatBlock,
    /// Components packed to 16 bits.
    halves: [HalfBlock; 4],
    /// Normals of the block.
    pub normals: VertexBlock,
    /// Positions of the last tick.
    last: VertexBlock,
}

impl Default for BlockScratch {
    fn default() -> Self {
        let [vector, normals, last] = [[[0.0; BLOCK]; 3]; 3];
        Self { vector, w: [0.0; BLOCK], halves: [[0; BLOCK]; 4], normals, last }
    }
}

impl BlockScratch {
    /// Packs the computed attribute into the stream's format and writes it.
    pub fn write(&mut self, level: Level, stream: &Stream<'_>, first: usize, count: usize) {
        let ([x, y, z], w) = (&mut self.vector, &mut self.w);
        let pack = match stream.format {
            VertexFormat::F32 => {
                return write_numbers(stream, first, count, [x, y, z, w], f32::to_ne_bytes);
            }
            VertexFormat::F16 => pack::to_f16,
            VertexFormat::Snorm16 => pack::to_snorm16,
            VertexFormat::Octahedral16 => {
                pack::to_octahedral(level, x, y, z);
                *z = *w;
                w.fill(0.0);
                pack::to_snorm16
            }
        };
        let used = stream.width() / stream.format.size();
        for (halves, numbers) in self.halves.iter_mut().zip([&*x, y, z, w]).take(used) {
            pack(level, numbers, halves);
        }
        write_numbers(stream, first, count, self.halves.each_ref(), u16::to_ne_bytes);
    }
}

/// Writes as many components as the format has for the attribute.
fn write_numbers<T: Copy, const SIZE: usize>(
    stream: &Stream<'_>,
    first: usize,
    count: usize,
    [x, y, z, w]: [&[T; BLOCK]; 4],
    bytes: impl Fn(T) -> [u8; SIZE],
) {
    match stream.width() / SIZE {
        1 => stream.write(first, count, [x], bytes),
        2 => stream.write(first, count, [x, y], bytes),
        3 => stream.write(first, count, [x, y, z], bytes),
        _ => stream.write(first, count, [x, y, z, w], bytes),
    }
}
