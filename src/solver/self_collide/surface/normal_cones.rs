//! How the triangles of patches lean: of those that lean much alike none can meet, in a patch or in two beside each
//! other. Eight patches go side by side, and so do eight pairs of them.

use crate::math::min;
use crate::math::simd::{
    Float, Level, Scalar, Simd, gather_transpose, scatter_transpose, vectored,
};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::V;
use crate::solver::self_collide::surface::cluster_bvh::PATCH;

/// Patches, or pairs of them, that are looked at together.
const LANES: usize = 8;

/// What leans no farther than this from one direction lies beside each other as seen from there, and cannot meet
/// (cosine of 60°).
const STEEP: f32 = 0.5;

/// The mean normal of a patch's triangles, and the least cosine that one makes with it; -1 where nothing is known.
type Lean = Float4;

/// Eight patches.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// The corners of their triangles, the first of each patch, then the second. Who has fewer repeats one.
    corners: [[[u32; LANES]; 3]; PATCH],
    /// How many each has; 0 if its triangles may meet however they lean.
    counts: [f32; LANES],
    /// Above 0 for those whose triangles turn within a substep.
    turning: [f32; LANES],
}

/// Eight pairs of patches beside each other, and which is between those that share no more than a vertex.
type Pairs = [[u32; LANES]; 3];

/// How all patches lean.
#[derive(Clone, Debug)]
pub(crate) struct Leans {
    blocks: Vec<Block>,
    /// How patches lean as a substep begins, and as it ends.
    ends: [Vec<Lean>; 2],
    /// Pairs that share edges, then those with one between them, from a block on.
    pairs: Vec<Pairs>,
    first_parted: usize,
    /// Which pairs lean so little that they cannot meet: a bit for each.
    quiet: Vec<u8>,
}

impl Leans {
    /// For so many patches. `beside` are pairs of them, and which one is between, if there is one; each gets the
    /// place that it has here.
    pub fn new(patches: usize, beside: &mut [([u32; 2], Option<u32>, u32)]) -> Self {
        let block = Block {
            corners: [[[0; LANES]; 3]; PATCH],
            counts: [0.0; LANES],
            turning: [0.0; LANES],
        };
        let (mut pairs, mut first_parted) = (Vec::new(), 0);
        for is_parted in [false, true] {
            first_parted = pairs.len();
            let own = beside.iter_mut().filter(|(_, between, _)| between.is_some() == is_parted);
            for (at, ([one, other], between, place)) in own.enumerate() {
                if at % LANES == 0 {
                    pairs.push([[0; LANES]; 3]);
                }
                let (lane, last) = (at % LANES, pairs.len() - 1);
                for (list, patch) in
                    pairs[last].iter_mut().zip([*one, *other, between.unwrap_or(0)])
                {
                    list[lane] = patch;
                }
                *place = (last * LANES + lane) as u32;
            }
        }
        let blocks = patches.div_ceil(LANES);
        Self {
            blocks: vec![block; blocks],
            ends: [(); 2].map(|()| vec![[0.0, 0.0, 0.0, -1.0]; blocks * LANES]),
            quiet: vec![0; pairs.len()],
            pairs,
            first_parted,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let patches = size_of::<Block>() + 2 * LANES * size_of::<Lean>();
        patches * self.blocks.len() + (size_of::<Pairs>() + 1) * self.pairs.len()
    }

    /// Takes the corners of a patch's triangles; none if these may meet however they lean.
    pub fn set(&mut self, patch: usize, triangles: impl ExactSizeIterator<Item = [u32; 3]>) {
        let (block, lane) = (&mut self.blocks[patch / LANES], patch % LANES);
        let count = triangles.len();
        block.counts[lane] = count as f32;
        for (at, corners) in triangles.enumerate() {
            // The last one again in all places behind.
            let places = at..if at + 1 == count { PATCH } else { at + 1 };
            for triangle in &mut block.corners[places] {
                for (list, corner) in triangle.iter_mut().zip(corners) {
                    list[lane] = corner;
                }
            }
        }
    }

    /// Whether the triangles of a patch turn within a substep.
    pub fn set_turning(&mut self, patch: usize, turns: bool) {
        self.blocks[patch / LANES].turning[patch % LANES] = if turns { 1.0 } else { 0.0 };
    }

    /// Finds how all patches lean, with particles as the substep begins and now.
    pub fn find(&mut self, level: Level, start: &[Float4], now: &[Float4]) {
        let [first, last] = &mut self.ends;
        find_leans(level, &self.blocks, start, first, false);
        last.clone_from(first);
        let mut blocks = self.blocks.iter();
        let are_turning = blocks.any(|block| block.turning.iter().any(|turns| *turns > 0.0));
        if are_turning {
            find_leans(level, &self.blocks, now, last, true);
        }
        let ends = [&self.ends[0][..], &self.ends[1]];
        let ends = if are_turning { &ends[..] } else { &ends[..1] };
        find_quiet(level, &self.pairs, self.first_parted, ends, &mut self.quiet);
    }

    /// Finds anew how those lean that are set to turn, with particles as they are now.
    pub fn find_again(&mut self, level: Level, now: &[Float4]) {
        find_leans(level, &self.blocks, now, &mut self.ends[1], true);
    }

    /// Whether triangles of a patch cannot meet each other.
    #[inline(always)]
    pub fn is_flat(&self, patch: u32) -> bool {
        let [start, end] = &self.ends;
        min(start[patch as usize][3], end[patch as usize][3]) > STEEP
    }

    /// Whether triangles of a pair cannot meet, as it was found.
    #[inline(always)]
    pub fn is_quiet(&self, pair: u32) -> bool {
        self.quiet[pair as usize / LANES] & (1 << (pair as usize % LANES)) != 0
    }

    /// Whether triangles of a pair cannot meet, as patches lean since they were found anew.
    pub fn is_quiet_again(&self, pair: u32) -> bool {
        let (block, lane) = (pair as usize / LANES, pair as usize % LANES);
        let own = self.pairs[block].map(|list| {
            let mut own = [0; LANES];
            own[0] = list[lane];
            own
        });
        let mut quiet = [0];
        let first_parted = usize::from(block < self.first_parted);
        look(Scalar, &[own], first_parted, &[&self.ends[0], &self.ends[1]], &mut quiet);
        quiet[0] & 1 != 0
    }
}

vectored! {
    fn find_leans(blocks: &[Block], x: &[Float4], leans: &mut [Lean], turning: bool)
        = lean, Avx2, find_leans_apart
}

vectored! {
    fn find_quiet(pairs: &[Pairs], first_parted: usize, ends: &[&[Lean]], quiet: &mut [u8])
        = look, Avx2, find_quiet_apart
}

fn find_leans_apart(blocks: &[Block], x: &[Float4], leans: &mut [Lean], turning: bool) {
    lean(Scalar, blocks, x, leans, turning);
}

fn find_quiet_apart(pairs: &[Pairs], first_parted: usize, ends: &[&[Lean]], quiet: &mut [u8]) {
    look(Scalar, pairs, first_parted, ends, quiet);
}

/// Finds how patches lean, or only those that turn.
#[inline(always)]
fn lean<S: Simd>(s: S, blocks: &[Block], x: &[Float4], leans: &mut [Lean], only_turning: bool) {
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    for (number, block) in blocks.iter().enumerate() {
        for at in (0..LANES).step_by(S::LANES) {
            let turning = s.load(&block.turning, at);
            if only_turning && !s.any_positive(turning) {
                continue;
            }
            let counts = s.load(&block.counts, at);
            let nothing = V { x: zero, y: zero, z: zero };
            let (mut normals, mut sum) = ([nothing; PATCH], nothing);
            for (k, normal) in normals.iter_mut().enumerate() {
                let [a, b, c] = [0, 1, 2]
                    .map(|corner| V::new(gather_transpose(s, x, &block.corners[k][corner][at..])));
                let doubled = b.minus(a).cross(c.minus(a));
                *normal = doubled.times(one / doubled.dot(doubled).sqrt());
                let (more, is_own) = (sum.plus(*normal), counts - s.splat(k as f32));
                sum = V {
                    x: s.select(is_own, more.x, sum.x),
                    y: s.select(is_own, more.y, sum.y),
                    z: s.select(is_own, more.z, sum.z),
                };
            }
            let mean = sum.times(one / sum.dot(sum).sqrt());
            let mut cone = one;
            for normal in normals {
                cone = Float::min(normal.dot(mean), cone);
            }
            // Where there is no mean, nothing is known.
            let is_known = Float::min(counts, mean.dot(mean));
            let cone = s.select(is_known, cone, zero - one);
            let ids: [u32; LANES] =
                core::array::from_fn(|lane| (number * LANES + at + lane) as u32);
            let mut found = [mean.x, mean.y, mean.z, cone];
            if only_turning {
                let before = gather_transpose(s, leans, &ids);
                for (found, before) in found.iter_mut().zip(before) {
                    *found = s.select(turning, *found, before);
                }
            }
            scatter_transpose(s, leans, &ids, found);
        }
    }
}

/// Finds which pairs cannot meet: all normals lean little as seen from amid the means of both.
#[inline(always)]
fn look<S: Simd>(s: S, pairs: &[Pairs], first_parted: usize, ends: &[&[Lean]], quiet: &mut [u8]) {
    let all = (1 << S::LANES) - 1;
    for (number, ([one, other, between], quiet)) in pairs.iter().zip(quiet).enumerate() {
        let mut bits = 0;
        for at in (0..LANES).step_by(S::LANES) {
            let mut are_quiet = all;
            for leans in ends {
                if are_quiet == 0 {
                    break;
                }
                let (one, other) = (
                    gather_transpose(s, leans, &one[at..]),
                    gather_transpose(s, leans, &other[at..]),
                );
                let (a, b) = (V::new(one), V::new(other));
                are_quiet &= are_alike(s, [a, b], Float::min(one[3], other[3]));
                if number >= first_parted {
                    // Around a common vertex all may lean alike that lie on each other, if what is between them is
                    // turned over.
                    let between = gather_transpose(s, leans, &between[at..]);
                    are_quiet &= faces(s, V::new(between), between[3], a.plus(b));
                }
            }
            bits |= are_quiet << at;
        }
        *quiet = bits as u8;
    }
}

/// Which pairs have all normals lean little, seen from amid two means: by the half of what those are apart, and what
/// normals lean from them.
#[inline(always)]
fn are_alike<S: Simd>(s: S, [a, b]: [V<S::F>; 2], cone: S::F) -> u32 {
    let (half, one) = (s.splat(0.5), s.splat(1.0));
    let amid = Float::min((one + a.dot(b)) * half, one).sqrt();
    let steep = s.splat(STEEP);
    s.positive_mask(cone - steep) & s.positive_mask(cosine_of_sum(s, amid, cone) - steep)
}

/// Which have all normals on the side that a way leads to.
#[inline(always)]
fn faces<S: Simd>(s: S, normal: V<S::F>, cone: S::F, way: V<S::F>) -> u32 {
    let cosine = normal.dot(way) / way.dot(way).sqrt();
    let sum = cosine_of_sum(s, Float::min(cosine, s.splat(1.0)), cone);
    s.positive_mask(cosine) & s.positive_mask(cone) & s.positive_mask(sum)
}

/// The cosine of the sum of two angles up to a right one, of their cosines.
#[inline(always)]
fn cosine_of_sum<S: Simd>(s: S, a: S::F, b: S::F) -> S::F {
    let one = s.splat(1.0);
    a * b - ((one - a * a) * (one - b * b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Patches side by side along a strip, a square of two triangles each, the square after each turned by an
    /// angle [rad] against it; each pair of neighbours is beside each other.
    fn strip(turns: &[f32]) -> (Leans, Vec<Float4>) {
        let (mut x, mut angle, mut at) = (Vec::new(), 0.0_f32, [0.0, 0.0]);
        for turn in [0.0].iter().chain(turns) {
            x.extend([[at[0], at[1], 0.0, 1.0], [at[0], at[1], 1.0, 1.0]]);
            angle += turn;
            at = [at[0] + angle.cos(), at[1] + angle.sin()];
        }
        x.extend([[at[0], at[1], 0.0, 1.0], [at[0], at[1], 1.0, 1.0]]);
        let count = turns.len() + 1;
        let mut beside: Vec<_> = (1..count as u32).map(|i| ([i - 1, i], None, u32::MAX)).collect();
        let mut leans = Leans::new(count, &mut beside);
        assert!(beside.iter().enumerate().all(|(at, (.., place))| *place == at as u32));
        for patch in 0..count {
            let a = 2 * patch as u32;
            leans.set(patch, [[a, a + 1, a + 2], [a + 3, a + 2, a + 1]].into_iter());
        }
        (leans, x)
    }

    #[test]
    fn what_leans_alike_is_quiet_and_what_is_bent_is_not() {
        for level in Level::all() {
            let (mut leans, x) = strip(&[0.0, 0.5, 1.5, 2.5, 0.1, 0.0, 0.0, 2.0, 0.0, 0.0]);
            leans.find(level, &x, &x);
            let quiet: Vec<bool> = (0..10).map(|pair| leans.is_quiet(pair)).collect();
            let expected = [0.0, 0.5, 1.5, 2.5, 0.1, 0.0, 0.0, 2.0, 0.0, 0.0]
                .map(|angle: f32| angle < 2.0 * STEEP.acos());
            assert_eq!(quiet, expected, "{level:?}");
            assert!((0..10).all(|pair| leans.is_quiet_again(pair) == quiet[pair as usize]));
            assert!((0..11).all(|patch| leans.is_flat(patch)), "{level:?}");
        }
    }

    #[test]
    fn a_patch_that_turns_within_a_substep_is_seen_as_it_ends() {
        for level in Level::all() {
            let (mut leans, start) = strip(&[0.0, 0.0]);
            let (_, end) = strip(&[3.0, 0.0]);
            leans.find(level, &start, &end);
            assert!(leans.is_quiet(0), "none is said to turn at {level:?}");
            leans.set_turning(1, true);
            leans.find(level, &start, &end);
            assert!(!leans.is_quiet(0) && !leans.is_quiet_again(0), "{level:?}");
            leans.find(level, &start, &start);
            leans.find_again(level, &end);
            assert!(leans.is_quiet(0) && !leans.is_quiet_again(0), "{level:?}");
        }
    }

    #[test]
    fn of_triangles_without_an_area_nothing_is_known() {
        for level in Level::all() {
            let (mut leans, mut x) = strip(&[0.0, 0.0, 0.0]);
            x[2] = x[0];
            leans.find(level, &x, &x);
            assert!(!leans.is_flat(0) && !leans.is_quiet(0), "{level:?}");
            assert!(leans.is_flat(2) && leans.is_quiet(2), "{level:?}");
            let (mut leans, x) = strip(&[0.0]);
            leans.set(0, [].into_iter());
            leans.find(level, &x, &x);
            assert!(!leans.is_flat(0) && !leans.is_quiet(0) && leans.is_flat(1), "{level:?}");
        }
    }
}
