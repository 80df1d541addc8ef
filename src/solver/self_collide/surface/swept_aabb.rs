//! Where something is, and how far it may go: what can be told apart cheaply although it moves.
//!
//! ```text
//!   ┌────┐ ways            Both go on at once, so what counts is how one goes against the other:
//!   │    │────►  ┌────┐    layers that travel together never meet.
//!   └────┘       │    │────►
//!                └────┘
//! ```

use crate::math::simd::{Baseline, Float, Simd};
use crate::math::wide4::Float4;
use crate::math::{max, min};

/// Things that are tested at once.
pub(crate) const LANES: usize = 8;

/// A box around places, and one around the ways from there to where they may be in the end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    pub low: Float4,
    pub high: Float4,
    pub from: Float4,
    pub to: Float4,
}

impl Sweep {
    /// Nothing.
    pub const EMPTY: Self = Self {
        low: [f32::INFINITY; 4],
        high: [f32::NEG_INFINITY; 4],
        from: [f32::INFINITY; 4],
        to: [f32::NEG_INFINITY; 4],
    };

    /// Grows to hold something else.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        for k in 0..4 {
            self.low[k] = min(self.low[k], other.low[k]);
            self.high[k] = max(self.high[k], other.high[k]);
            self.from[k] = min(self.from[k], other.from[k]);
            self.to[k] = max(self.to[k], other.to[k]);
        }
    }

    /// What holds some particles: where they are, and from where to where they go.
    #[inline(always)]
    pub fn around(particles: &[u32], [places, from, to]: [&[Float4]; 3]) -> Self {
        let (simd, mut all) = (Baseline::new(), Self::EMPTY);
        for k in (0..4).step_by(Baseline::LANES) {
            let [none, endless] = [f32::INFINITY, f32::NEG_INFINITY].map(|end| simd.splat(end));
            let ([mut low, mut first], [mut high, mut last]) = ([none; 2], [endless; 2]);
            for particle in particles {
                let load = |spots: &[Float4]| simd.load(&spots[*particle as usize], k);
                let place = load(places);
                (low, high) = (Float::min(low, place), Float::max(high, place));
                (first, last) = (Float::min(first, load(from)), Float::max(last, load(to)));
            }
            simd.store(&mut all.low, k, low);
            simd.store(&mut all.high, k, high);
            simd.store(&mut all.from, k, first);
            simd.store(&mut all.to, k, last);
        }
        all
    }

    /// Whether some point of one may come nearer than `gap` to one of the other. What is not a number is
    /// everywhere.
    #[inline(always)]
    pub fn meets(&self, other: &Self, gap: f32) -> bool {
        let (simd, a, b) = (Baseline::new(), self, other);
        let (zero, gap) = (simd.splat(0.0), simd.splat(gap));
        let mut apart = 0;
        for k in (0..4).step_by(Baseline::LANES) {
            let load = |all: &Float4| simd.load(all, k);
            let down = Float::min(load(&a.from) - load(&b.to), zero);
            let up = Float::max(load(&a.to) - load(&b.from), zero);
            let below = load(&a.low) + down - (load(&b.high) + gap);
            let above = load(&b.low) - gap - (load(&a.high) + up);
            apart |= (simd.positive_mask(below) | simd.positive_mask(above)) << k;
        }
        // Inverse masses are no places.
        apart & 0b111 == 0
    }

    /// The most that parts of it move against each other, along an axis.
    pub fn most_against(&self) -> f32 {
        let along = |k: usize| self.to[k] - self.from[k];
        max(along(0), max(along(1), along(2)))
    }

    /// The most that one moves against the other.
    #[inline(always)]
    pub fn way_against(&self, other: &Self) -> f32 {
        let mut sum = 0.0;
        for k in 0..3 {
            let way = max(self.to[k] - other.from[k], other.to[k] - self.from[k]);
            sum += way * way;
        }
        sum.sqrt()
    }
}

/// Some of them, numbers of one kind together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweeps {
    low: [[f32; LANES]; 3],
    high: [[f32; LANES]; 3],
    from: [[f32; LANES]; 3],
    to: [[f32; LANES]; 3],
}

impl Sweeps {
    /// Nothing.
    pub const EMPTY: Self = Self {
        low: [[f32::INFINITY; LANES]; 3],
        high: [[f32::NEG_INFINITY; LANES]; 3],
        from: [[0.0; LANES]; 3],
        to: [[0.0; LANES]; 3],
    };

    #[inline(always)]
    pub fn set(&mut self, lane: usize, sweep: &Sweep) {
        for k in 0..3 {
            self.low[k][lane] = sweep.low[k];
            self.high[k][lane] = sweep.high[k];
            self.from[k][lane] = sweep.from[k];
            self.to[k][lane] = sweep.to[k];
        }
    }

    /// Which of them may come nearer than `gap` to one: a bit for each.
    #[inline(always)]
    pub fn meet(&self, one: &Sweep, gap: f32) -> u32 {
        let simd = Baseline::new();
        let zero = simd.splat(0.0);
        let mut bits = 0;
        for lane in (0..LANES).step_by(Baseline::LANES) {
            let mut clear = simd.splat(f32::NEG_INFINITY);
            for k in 0..3 {
                let back = simd.load(&self.to[k], lane) - simd.splat(one.from[k]);
                let ahead = simd.splat(one.to[k]) - simd.load(&self.from[k], lane);
                let above = simd.splat(one.low[k] - gap) - simd.load(&self.high[k], lane);
                let below = simd.load(&self.low[k], lane) - simd.splat(one.high[k] + gap);
                let (above, below) =
                    (above - Float::max(back, zero), below - Float::max(ahead, zero));
                clear = Float::max(Float::max(above, below), clear);
            }
            if simd.any_positive(zero - clear) {
                let mut each = [0.0; LANES];
                simd.store(&mut each, 0, clear);
                for (at, clear) in each[..Baseline::LANES].iter().enumerate() {
                    bits |= u32::from(*clear < 0.0) << (lane + at);
                }
            }
        }
        bits
    }
}

/// Which of so many, in blocks of lanes, may come nearer than `gap` to one: a bit for each.
#[inline(always)]
pub(crate) fn meet(blocks: &[Sweeps], count: u32, one: &Sweep, gap: f32) -> u32 {
    let mut bits = 0;
    for block in (0..count.div_ceil(LANES as u32)).rev() {
        bits = bits << LANES | blocks[block as usize].meet(one, gap);
    }
    // What is not a number meets lanes as well that nothing is in.
    bits & ((1 << count) - 1)
}

/// The places of bits, from the lowest on.
pub(crate) fn places_of(mut bits: u32) -> impl Iterator<Item = u32> {
    core::iter::from_fn(move || {
        let place = bits.trailing_zeros();
        (bits != 0).then(|| {
            bits &= bits - 1;
            place
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thing(at: f32, way: f32) -> Sweep {
        Sweep { low: [at; 4], high: [at + 1.0; 4], from: [way - 0.1; 4], to: [way + 0.1; 4] }
    }

    #[test]
    fn what_travels_together_never_meets() {
        let (one, other) = (thing(0.0, 5.0), thing(2.0, 5.0));
        assert!(!one.meets(&other, 0.5) && one.meets(&other, 0.81));
        let slow = thing(2.0, 0.0);
        assert!(one.meets(&slow, 0.0) && slow.meets(&one, 0.0), "one runs into the other");
        let away = thing(2.0, 9.0);
        assert!(!one.meets(&away, 0.5), "one runs away from the other");
    }

    #[test]
    fn lanes_that_nothing_is_in_meet_nothing() {
        let mut all = Sweeps::EMPTY;
        all.set(0, &thing(0.0, 1.0));
        for far in [f32::INFINITY, f32::NAN] {
            let one = Sweep { from: [-far; 4], to: [far; 4], ..thing(0.0, 0.0) };
            assert_eq!(meet(&[all], 1, &one, 0.1), 1, "{far}");
        }
    }

    #[test]
    fn many_at_once_are_as_each_alone() {
        let mut all = Sweeps::EMPTY;
        let things: Vec<_> =
            (0..LANES - 1).map(|i| thing(0.7 * i as f32, 2.0 - i as f32)).collect();
        things.iter().enumerate().for_each(|(lane, thing)| all.set(lane, thing));
        let one = thing(2.5, 0.5);
        for gap in [0.0, 0.3, 1.0] {
            let each = things.iter().enumerate();
            let bits = each.map(|(lane, thing)| u32::from(thing.meets(&one, gap)) << lane);
            assert_eq!(all.meet(&one, gap), bits.sum::<u32>(), "{gap}");
        }
    }
}
