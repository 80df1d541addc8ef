//! Writing of vertices and indices for buffers of the page.
//!
//! The core writes into staging memory of the module, and `package/write.js` copies from there to
//! the caller's buffers, which the module cannot reach itself:
//!
//! ```text
//! core ──▶ staging (module memory) ──▶ caller's ArrayBuffer
//! ```

use crate::RawCloth;
use crate::error::{Result, to_js_error};
use crate::packing::{Reader, Writer};
use core::cell::Cell;
use glam::{Affine3, Mat3, Vec3};
use muslin::{Attribute, Cloth, IndexFormat, MAX_STREAMS, Stream, VertexFormat, WriteDesc};
use wasm_bindgen::prelude::wasm_bindgen;

/// Alignment of the staging memory [B]. An offset in it is aligned as the same offset in a buffer
/// of the page.
const ALIGNMENT: usize = 8;

#[wasm_bindgen]
impl RawCloth {
    /// Grows the staging memory to at least `size` bytes, and returns its address.
    pub fn reserve_staging(&mut self, size: usize) -> *mut u8 {
        self.staging.resize(self.staging.len().max(size + ALIGNMENT), 0);
        let start = self.staging_start();
        self.staging[start..].as_mut_ptr()
    }

    fn staging_start(&self) -> usize {
        self.staging.as_ptr().align_offset(ALIGNMENT)
    }

    /// Writes vertices into the staging memory. Each stream is attribute, format, stride, offset in
    /// the staging memory and length [B].
    pub fn write_vertices(&mut self, streams: &[f64], desc: &[f64]) -> Result<()> {
        self.write_staged(streams, desc, &mut |cloth, streams, desc| {
            cloth.write_vertices(streams, desc)
        })
    }

    /// Writes 16-bit or 32-bit indices to the start of the staging memory.
    pub fn write_indices(&mut self, is_wide: bool, flip: bool, base_vertex: u32) -> Result<()> {
        let format = if is_wide { IndexFormat::U32 } else { IndexFormat::U16 };
        let start = self.staging_start();
        let bytes = &mut self.staging[start..];
        self.cloth.write_indices(bytes, format, flip, base_vertex).map_err(to_js_error)
    }
}

/// Writes the streams of the cloth or of a skin.
type WriteStreams<'a> =
    &'a mut dyn FnMut(&mut Cloth, &[Stream<'_>], &WriteDesc) -> muslin::Result<()>;

impl RawCloth {
    /// Runs `write` with streams into the staging memory, see `write_vertices`.
    pub(crate) fn write_staged(
        &mut self,
        streams: &[f64],
        desc: &[f64],
        write: WriteStreams<'_>,
    ) -> Result<()> {
        let (start, mut staging) = (self.staging_start(), core::mem::take(&mut self.staging));
        let bytes = &Cell::from_mut(&mut staging[..]).as_slice_of_cells()[start..];
        let read = |numbers: &[f64; 5]| {
            let mut numbers = Reader::new(numbers);
            let attribute = Attribute::ALL[numbers.count() as usize];
            let format = VertexFormat::ALL[numbers.count() as usize];
            let stride = numbers.count();
            let (first, size) = (numbers.count() as usize, numbers.count() as usize);
            Stream { attribute, format, stride, bytes: &bytes[first..first + size] }
        };
        // One stream more than the maximum is enough for the core to refuse.
        let streams = streams.as_chunks::<5>().0.iter().take(MAX_STREAMS + 1);
        let streams: Vec<Stream<'_>> = streams.map(read).collect();
        let result = write(&mut self.cloth, &streams, &unpack_write(desc));
        self.staging = staging;
        result.map_err(to_js_error)
    }
}

/// Returns the bytes that an attribute takes per vertex; 0 if the format does not hold it.
#[wasm_bindgen]
pub fn vertex_width(attribute: usize, format: usize) -> usize {
    VertexFormat::ALL[format].width(Attribute::ALL[attribute]).unwrap_or(0)
}

/// Returns the default `WriteDesc`: all vertices of the current tick, untransformed.
#[wasm_bindgen]
pub fn default_write() -> Vec<f64> {
    let desc = WriteDesc::default();
    let mut list = Writer::default();
    list.counts(&[desc.first_vertex, desc.vertex_count]);
    list.number(desc.blend);
    let [x, y, z] = [0, 1, 2].map(|row| desc.transform.matrix3.row(row));
    let t = desc.transform.translation;
    list.numbers(&[x.x, x.y, x.z, t.x, y.x, y.y, y.z, t.y, z.x, z.y, z.z, t.z]);
    list.counts(&[desc.flip_normals.into()]);
    list.number(desc.offset);
    list.counts(&[desc.relative.into()]);
    list.0
}

/// Reads a `WriteDesc` in the order of `default_write`.
fn unpack_write(list: &[f64]) -> WriteDesc {
    let mut list = Reader::new(list);
    let (first_vertex, vertex_count, blend) = (list.count(), list.count(), list.number());
    let t: [f32; 12] = core::array::from_fn(|_| list.number());
    let column = |at: usize| Vec3::new(t[at], t[at + 4], t[at + 8]);
    WriteDesc {
        first_vertex,
        vertex_count,
        blend,
        transform: Affine3 {
            matrix3: Mat3::from_cols(column(0), column(1), column(2)),
            translation: column(3),
        },
        flip_normals: list.count() == 1,
        offset: list.number(),
        relative: list.count() == 1,
    }
}
