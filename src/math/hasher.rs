//! A 64-bit hash of the simulation state, and pseudo-random numbers made from it.
//!
//! ```text
//! h ← rotl₂₉((h ⊕ word) · c)      finish: the avalanche of splitmix64
//! ```
//! Multiply and rotate; Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
//! OOPSLA 2014, for the avalanche. Not cryptographic.
//!
//! Reads words in the order in which they are written; keeps one `u64`.
//! Invariant: the same words give the same hash on every platform.

/// A running 64-bit hash of 32-bit words; their order matters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StateHasher(u64);

impl StateHasher {
    /// Starts a hash from a seed.
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

    /// Returns the hash of all words so far.
    pub fn finish(self) -> u64 {
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Returns a pseudo-random number in 0..1 that depends only on the seed and the words.
pub(crate) fn unit(seed: u32, words: &[u32]) -> f32 {
    let mut hasher = StateHasher::new(u64::from(seed));
    hasher.write_u32s(words);
    (hasher.finish() >> 40) as f32 / (1u32 << 24) as f32
}
