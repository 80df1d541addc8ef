//! Mixing integers: hashes of state, and numbers that look random but are always the same.

/// A running 64-bit hash of words; order matters.
///
/// Multiply and rotate, finished by the avalanche of splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
#[derive(Clone, Copy, Debug)]
pub(crate) struct StateHasher(u64);

impl StateHasher {
    pub fn new(seed: u64) -> Self {
        Self(seed ^ 0x9e37_79b9_7f4a_7c15)
    }

    #[inline(always)]
    pub fn write_u32(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0xff51_afd7_ed55_8ccd).rotate_left(29);
    }

    pub fn write_f32(&mut self, value: f32) {
        self.write_u32(value.to_bits());
    }

    #[inline(never)]
    pub fn write_f32s(&mut self, values: &[f32]) {
        values.iter().for_each(|v| self.write_f32(*v));
    }

    #[inline(never)]
    pub fn write_u32s(&mut self, values: &[u32]) {
        values.iter().for_each(|v| self.write_u32(*v));
    }

    pub fn finish(self) -> u64 {
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// A number in 0..1 that belongs to these words for ever.
pub(crate) fn unit(seed: u32, words: &[u32]) -> f32 {
    let mut hasher = StateHasher::new(u64::from(seed));
    hasher.write_u32s(words);
    (hasher.finish() >> 40) as f32 / (1u32 << 24) as f32
}
