//! Writing into the caller's own buffers.

use super::Cloth;
use crate::error::{Result, check};

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
        let order = if flip { [0, 2, 1] } else { [0, 1, 2] };
        let turned = indices.chunks_exact(3).flat_map(|triangle| order.map(|k| triangle[k]));
        for (bytes, index) in buffer.chunks_exact_mut(format.size()).zip(turned) {
            let index = index + base_vertex;
            match format {
                IndexFormat::U16 => bytes.copy_from_slice(&(index as u16).to_ne_bytes()),
                IndexFormat::U32 => bytes.copy_from_slice(&index.to_ne_bytes()),
            }
        }
        Ok(())
    }
}
