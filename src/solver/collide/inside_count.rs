//! How many particles are inside colliders.
//!
//! Stages of `collide` fill and read it; it holds numbers only.
//!
//! Invariant: `first` is the least particle that was added, once one was.

/// Particles inside a collider: how many, and the first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct InsideCount {
    pub count: u32,
    pub first: u32,
}

impl InsideCount {
    pub fn add(&mut self, particle: u32) {
        if self.count == 0 || particle < self.first {
            self.first = particle;
        }
        self.count += 1;
    }
}
