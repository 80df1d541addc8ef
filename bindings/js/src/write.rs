//! Writing into buffers of the page: into room of our own first, from where `package/write.js` copies.

use crate::RawCloth;
use crate::numbers::{Reader, Writer};
use crate::refusal::{Result, refusal};
use core::cell::Cell;
use glam::{Affine3, Mat3, Vec3};
use muslin::{Attribute, IndexFormat, MAX_STREAMS, Stream, VertexFormat, WriteDesc};
use wasm_bindgen::prelude::wasm_bindgen;

/// The room begins at a multiple of this, so that places in it are aligned as those in the page's buffers.
const ALIGNMENT: usize = 8;

#[wasm_bindgen]
impl RawCloth {
    /// Makes room for so many bytes, and says where it is.
    pub fn room(&mut self, size: usize) -> *mut u8 {
        self.room.resize(self.room.len().max(size + ALIGNMENT), 0);
        let at = self.room_start();
        self.room[at..].as_mut_ptr()
    }

    fn room_start(&self) -> usize {
        self.room.as_ptr().align_offset(ALIGNMENT)
    }

    /// Writes vertices into the room; each stream is attribute, format, stride, where it begins and how long
    /// it is.
    pub fn write_vertices(&mut self, streams: &[f64], desc: &[f64]) -> Result<()> {
        let (at, mut room) = (self.room_start(), core::mem::take(&mut self.room));
        let bytes = &Cell::from_mut(&mut room[..]).as_slice_of_cells()[at..];
        let read = |numbers: &[f64; 5]| {
            let mut numbers = Reader::new(numbers);
            let attribute = Attribute::ALL[numbers.count() as usize];
            let format = VertexFormat::ALL[numbers.count() as usize];
            let stride = numbers.count();
            let (first, size) = (numbers.count() as usize, numbers.count() as usize);
            Stream { attribute, format, stride, bytes: &bytes[first..first + size] }
        };
        // One more than there may be is refused.
        let streams = streams.as_chunks::<5>().0.iter().take(MAX_STREAMS + 1);
        let streams: Vec<Stream<'_>> = streams.map(read).collect();
        let done = self.cloth.write_vertices(&streams, &read_desc(desc));
        self.room = room;
        done.map_err(refusal)
    }

    /// Writes indices of 16 or 32 bits into the room.
    pub fn write_indices(&mut self, is_wide: bool, flip: bool, base_vertex: u32) -> Result<()> {
        let format = if is_wide { IndexFormat::U32 } else { IndexFormat::U16 };
        let at = self.room_start();
        let room = &mut self.room[at..];
        self.cloth.write_indices(room, format, flip, base_vertex).map_err(refusal)
    }
}

/// Bytes that a vertex takes; 0 if the attribute is not written so.
#[wasm_bindgen]
pub fn vertex_width(attribute: usize, format: usize) -> usize {
    VertexFormat::ALL[format].width(Attribute::ALL[attribute]).unwrap_or(0)
}

/// All vertices, as they are.
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
    list.0
}

fn read_desc(list: &[f64]) -> WriteDesc {
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
    }
}
