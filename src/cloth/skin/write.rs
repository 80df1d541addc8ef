//! Public calls that write a skin into the caller's own buffers.
//!
//! ```text
//! for each block of vertices:   evaluate  ▶  for each stream:   transform  ▶  pack  ▶  write
//! ```
//! Reads `Cloth` and `Skin`; writes only the caller's bytes.
//! Invariant: all checks come first, so a refused call leaves the buffers untouched.

use crate::cloth::Cloth;
use crate::cloth::skin::Skin;
use crate::cloth::skin::evaluate::SkinBlock;
use crate::cloth::vertex_stream::{Attribute, Stream, WriteDesc, check_all};
use crate::cloth::write_vertices::{BlockScratch, IndexFormat, write_indices, write_transform};
use crate::error::Result;
use crate::math::float_env::with_float_env;
use crate::math::pack::BLOCK;
use crate::solver::output::vertex_transform::{VertexBlock, VertexTransform};
use core::ops::Range;

impl Skin {
    /// Writes vertices into the caller's buffers, as [`Cloth::write_vertices`] does. The blend, the
    /// transform and the offset apply to the skin; positions may be relative to the origin of the
    /// cloth.
    ///
    /// Buffers for [`Skin::vertex_capacity`] vertices are always large enough. Follows tears and
    /// cuts first, so compare [`Skin::topology_revision`] after the call. The first call with a
    /// blend below 1 allocates memory.
    ///
    /// # Errors
    /// Those of [`Cloth::write_vertices`], and [`Error::BadHandle`](crate::Error::BadHandle) if the
    /// skin was made for another cloth. The buffers are untouched then.
    pub fn write_vertices(
        &mut self,
        cloth: &Cloth,
        streams: &[Stream<'_>],
        desc: &WriteDesc,
    ) -> Result<()> {
        self.follow(cloth)?;
        let vertices = desc.check(self.mesh.sources.len())?;
        check_all(streams, vertices.len())?;
        let transform = write_transform(&cloth.world, streams, desc)?;
        with_float_env(|| {
            self.load_particles(&cloth.world, desc.blend);
            self.write_blocks(cloth, streams, vertices, &transform);
        });
        Ok(())
    }

    /// Writes the indices of all triangles to the start of `buffer`, as [`Cloth::write_indices`]
    /// does, for the triangles at the last update.
    ///
    /// # Errors
    /// Those of [`Cloth::write_indices`]. The buffer is untouched then.
    pub fn write_indices(
        &self,
        buffer: &mut [u8],
        format: IndexFormat,
        flip: bool,
        base_vertex: u32,
    ) -> Result<()> {
        let (indices, vertices) = (&self.mesh.indices, self.mesh.sources.len());
        write_indices(indices, vertices, buffer, format, flip, base_vertex)
    }

    fn write_blocks(
        &self,
        cloth: &Cloth,
        streams: &[Stream<'_>],
        vertices: Range<usize>,
        transform: &VertexTransform,
    ) {
        let with_tangents = streams.iter().any(|stream| stream.attribute == Attribute::Tangent);
        let (mut block, mut scratch) = (SkinBlock::default(), BlockScratch::default());
        let mut first = vertices.start - vertices.start % BLOCK;
        while first < vertices.end {
            // The part of this block that is written.
            let part = vertices.start.max(first)..vertices.end.min(first + BLOCK);
            self.evaluate_block(&cloth.world, first, with_tangents, &mut block);
            for stream in streams {
                let attribute = stream.attribute;
                self.load_attribute(attribute, &part, &block, transform, &mut scratch);
                scratch.write(cloth.world.level, stream, part.start - vertices.start, part.len());
            }
            first += BLOCK;
        }
    }

    /// Loads one attribute of a part of a block into `scratch`.
    fn load_attribute(
        &self,
        attribute: Attribute,
        part: &Range<usize>,
        block: &SkinBlock,
        transform: &VertexTransform,
        scratch: &mut BlockScratch,
    ) {
        let mesh = &self.mesh;
        let (skipped, count) = (part.start % BLOCK, part.len());
        let load = |from: &VertexBlock, to: &mut VertexBlock| {
            for (to, from) in to.iter_mut().zip(from) {
                to[..count].copy_from_slice(&from[skipped..skipped + count]);
            }
        };
        let BlockScratch { vector, w, normals, .. } = scratch;
        load(&block.normal, normals);
        match attribute {
            Attribute::Position => {
                load(&block.position, vector);
                transform.transform_positions(vector, normals);
                w.fill(1.0);
            }
            Attribute::Normal => {
                *vector = *normals;
                transform.transform_normals(vector);
                w.fill(0.0);
            }
            Attribute::Tangent => {
                load(&block.tangent, vector);
                w[..count].copy_from_slice(&mesh.handedness[part.clone()]);
                transform.transform_tangents(vector, normals, w);
            }
            Attribute::Uv => {
                let [u, v, ..] = vector;
                for ((u, v), uv) in u.iter_mut().zip(v).zip(&mesh.uvs[part.clone()]) {
                    (*u, *v) = (uv.x, uv.y);
                }
            }
            Attribute::Frayed => {
                let [frayed, padding, _] = vector;
                let is_frayed = frayed.iter_mut().zip(&mesh.frayed[part.clone()]);
                is_frayed.for_each(|(to, is)| *to = f32::from(*is));
                padding.fill(0.0);
            }
        }
    }
}
