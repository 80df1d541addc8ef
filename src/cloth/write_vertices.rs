//! Writing into the caller's own buffers.

use crate::cloth::Cloth;
use crate::cloth::blended_surface::BlendedSurface;
use crate::cloth::vertex_stream::{Attribute, Stream, VertexFormat, WriteDesc, check_all};
use crate::error::{Result, check};
use crate::math::float_env::with_float_env;
use crate::math::pack;

use crate::math::pack::{BLOCK, FloatBlock, HalfBlock};
use crate::math::simd::Level;
use crate::solver::output::normals;
use crate::solver::output::vertex_transform;
use crate::solver::stage::Stage;

use crate::solver::output::vertex_transform::{VertexBlock, VertexTransform};
use core::ops::Range;
use glam::Vec2;

/// How wide the indices of a buffer are.
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
    /// Bytes of one index.
    pub fn size(self) -> usize {
        self as usize / 8
    }
}

impl Cloth {
    /// Writes the indices of all triangles to the beginning of `buffer`, as the machine keeps numbers of
    /// that width: each with `base_vertex` added, and every triangle turned round if `flip` is set. Give
    /// `buffer` room for the view's `index_capacity` indices, and it fits for ever.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) unless the indices fit `buffer` and the greatest fits
    /// `format`; of 16 bits the greatest number is left out, since many hosts restart there. `buffer`
    /// is untouched then.
    pub fn write_indices(
        &self,
        buffer: &mut [u8],
        format: IndexFormat,
        flip: bool,
        base_vertex: u32,
    ) -> Result<()> {
        let indices = self.indices();
        let fits = buffer.len() >= indices.len() * format.size();
        check(fits, "buffer", "have room for all indices")?;
        let last = u64::from(base_vertex) + self.positions().len() as u64 - 1;
        check(
            format == IndexFormat::U32 || last < u64::from(u16::MAX),
            "index_format",
            "be 32 where an index is above 65534",
        )?;
        check(last < u64::from(u32::MAX), "base_vertex", "leave every index below 4294967295")?;
        let moved = |index: u32| index + base_vertex;
        match format {
            IndexFormat::U16 => turn(buffer, indices, flip, |i| (moved(i) as u16).to_ne_bytes()),
            IndexFormat::U32 => turn(buffer, indices, flip, |i| moved(i).to_ne_bytes()),
        }
        Ok(())
    }

    /// Writes vertices into the caller's buffers, each attribute in the format, at the place and at the
    /// distances that its stream says: separate, interleaved or one behind the other. Nothing else in the
    /// buffers is touched. With room for the view's `vertex_capacity` vertices they fit for ever.
    ///
    /// The first call that asks for tangents, or for normals between two ticks, makes room for them;
    /// otherwise nothing is allocated.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a field of `desc` that cannot be, unless there are 1
    /// to 16 streams, or if normals or tangents are asked for with a transform that cannot be inverted;
    /// [`Error::BadStream`](crate::Error::BadStream) names the stream and its field: a format that its
    /// attribute is not written in, a stride or place that its numbers do not fit, bytes that another
    /// stream writes too; [`Error::SmallStream`](crate::Error::SmallStream) if the vertices do not fit.
    /// The buffers are untouched then.
    pub fn write_vertices(&mut self, streams: &[Stream<'_>], desc: &WriteDesc) -> Result<()> {
        let vertices = desc.check(self.positions().len())?;
        check_all(streams, vertices.len())?;
        let has = |attribute| streams.iter().any(|stream| stream.attribute == attribute);
        let (normals, tangents) = (has(Attribute::Normal), has(Attribute::Tangent));
        let start = self.world.profile.start();
        let (world, outputs) = (&self.world, &mut self.outputs);
        let placing = with_float_env(|| {
            VertexTransform::new(desc.blend, desc.offset, desc.flip_normals, desc.transform)
        });
        let can_turn = placing.can_transform_directions() || !(normals || tangents);
        check(can_turn, "transform", "be one that can be inverted, for normals or tangents")?;
        if normals || tangents || placing.is_offset() {
            world.threads.run_in_pool(world.particles.len(), || {
                with_float_env(|| outputs.follow_drawn(world, desc.blend, tangents));
            });
        }
        let (uvs, frayed) = (self.uvs(), self.frayed());
        let particles = world.seams.as_ref().map(|_| self.vertex_particles());
        let writer = Writer {
            level: world.level,
            placing,
            x: world.particles.x.all(),
            last: world.particles.x_prev_tick.all(),
            drawn: &self.outputs.drawn,
            particles,
            uvs,
            frayed,
        };
        with_float_env(|| writer.write(streams, vertices));
        self.world.profile.book(Stage::Outputs, start);
        Ok(())
    }
}

/// Writes the corners of triangles, turned round or not.
fn turn<const SIZE: usize>(
    buffer: &mut [u8],
    indices: &[u32],
    flip: bool,
    bytes_of: impl Fn(u32) -> [u8; SIZE],
) {
    let (second, third) = if flip { (2, 1) } else { (1, 2) };
    let places = buffer.as_chunks_mut().0.as_chunks_mut::<3>().0;
    for (place, corners) in places.iter_mut().zip(indices.as_chunks::<3>().0) {
        *place = [0, second, third].map(|k| bytes_of(corners[k]));
    }
}

/// What vertices are written from.
struct Writer<'a> {
    level: Level,
    placing: VertexTransform,
    x: [&'a [f32]; 3],
    last: [&'a [f32]; 3],
    drawn: &'a BlendedSurface,
    /// The particle of each vertex, unless that has its number.
    particles: Option<&'a [u32]>,
    uvs: &'a [Vec2],
    frayed: &'a [bool],
}

impl Writer<'_> {
    /// All streams block by block, so that what they share stays at hand.
    fn write(&self, streams: &[Stream<'_>], vertices: Range<usize>) {
        let mut room = Room::default();
        for first in vertices.clone().step_by(BLOCK) {
            let block = first..vertices.end.min(first + BLOCK);
            for stream in streams {
                self.find(stream.attribute, block.clone(), &mut room);
                room.put(self.level, stream, first - vertices.start, block.len());
            }
        }
    }

    /// Finds an attribute of a block of vertices.
    fn find(&self, attribute: Attribute, block: Range<usize>, room: &mut Room) {
        let Room { vector, fourth: last, normals, from, .. } = room;
        let load = |to: &mut [FloatBlock], columns: &[&[f32]]| {
            vertex_transform::load(to, columns, block.start, block.len());
        };
        // What particles have.
        let load_of = |to: &mut [FloatBlock], columns: &[&[f32]]| match self.particles {
            Some(particles) => vertex_transform::gather(to, columns, &particles[block.clone()]),
            None => load(to, columns),
        };
        let needs_normals = match attribute {
            Attribute::Position => self.placing.is_offset(),
            attribute => attribute == Attribute::Tangent,
        };
        if needs_normals {
            load_of(normals, &self.drawn.normals.all());
        }
        match attribute {
            Attribute::Position => {
                load_of(vector, &self.x);
                if self.placing.share != 1.0 {
                    load_of(from, &self.last);
                    blend(self.level, vector, from, block.len(), self.placing.share);
                }
                self.placing.transform_positions(self.level, vector, normals);
                last.fill(1.0);
            }
            Attribute::Normal => {
                load_of(vector, &self.drawn.normals.all());
                self.placing.transform_normals(self.level, vector);
                last.fill(0.0);
            }
            Attribute::Tangent => {
                // Whoever asked for them had them made.
                let Some(tangents) = &self.drawn.tangents else { return };
                let (sums, hands) = tangents.columns();
                load(vector, &sums);
                load(core::slice::from_mut(last), &[hands]);
                self.placing.transform_tangents(self.level, vector, normals, last);
            }
            Attribute::Uv => {
                let [u, v, ..] = vector;
                for ((u, v), uv) in u.iter_mut().zip(v).zip(&self.uvs[block]) {
                    (*u, *v) = (uv.x, uv.y);
                }
            }
            Attribute::Frayed => {
                let [frayed, rest, _] = vector;
                let is_frayed = frayed.iter_mut().zip(&self.frayed[block]);
                is_frayed.for_each(|(to, is)| *to = f32::from(*is));
                rest.fill(0.0);
            }
        }
    }
}

/// Goes back towards the last tick.
fn blend(level: Level, x: &mut VertexBlock, last: &VertexBlock, count: usize, share: f32) {
    for (x, last) in x.iter_mut().zip(last) {
        normals::blend(level, &mut x[..count], &last[..count], share);
    }
}

/// Room for a block of vertices.
struct Room {
    /// What is written: up to three numbers, and a fourth.
    vector: VertexBlock,
    fourth: FloatBlock,
    /// What they are packed into.
    halves: [HalfBlock; 4],
    normals: VertexBlock,
    /// Where they were a tick ago.
    from: VertexBlock,
}

impl Default for Room {
    fn default() -> Self {
        let [vector, normals, from] = [[[0.0; BLOCK]; 3]; 3];
        Self { vector, fourth: [0.0; BLOCK], halves: [[0; BLOCK]; 4], normals, from }
    }
}

impl Room {
    /// Writes what was found, in the format of the stream.
    fn put(&mut self, level: Level, stream: &Stream<'_>, first: usize, count: usize) {
        let ([x, y, z], w) = (&mut self.vector, &mut self.fourth);
        let to = match stream.format {
            VertexFormat::F32 => {
                return put(stream, first, count, [x, y, z, w], f32::to_ne_bytes);
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
            to(level, numbers, halves);
        }
        put(stream, first, count, self.halves.each_ref(), u16::to_ne_bytes);
    }
}

fn put<T: Copy, const SIZE: usize>(
    stream: &Stream<'_>,
    first: usize,
    count: usize,
    [x, y, z, w]: [&[T; BLOCK]; 4],
    bytes: impl Fn(T) -> [u8; SIZE],
) {
    match stream.width() / SIZE {
        1 => stream.put(first, count, [x], bytes),
        2 => stream.put(first, count, [x, y], bytes),
        3 => stream.put(first, count, [x, y, z], bytes),
        _ => stream.put(first, count, [x, y, z, w], bytes),
    }
}
