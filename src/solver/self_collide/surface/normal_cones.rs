//! Normal cones of triangle clusters, used to cull self-collision pairs.
//!
//! ```text
//!        ▲ mean normal m          cone of a cluster: m, and c = min over triangles of cos(n, m)
//!      ╲ │ ╱  half angle
//!   ────╲│╱──── cluster           If all its normals lie within 60° of one direction, it is
//!                                 a height field along that direction and cannot touch itself.
//! ```
//! Curvature culling after Volino and Magnenat-Thalmann, "Efficient self-collision detection on
//! smoothly discretized surface animations using geometrical shape regularity", 1994, and Provot,
//! "Collision and self-collision handling in cloth model dedicated to design garments", 1997 (cones
//! of normals). It culls a cluster against itself, and against its neighbours: the combined cone is
//! taken around the bisector of both means, with cosine √((1 + m₁·m₂) / 2), widened by the larger
//! of both half angles.
//!
//! Eight clusters are processed at once, and eight pairs. Cones are computed at the start of a
//! substep and at its end; a pair must be culled at both. Clusters that hardly deform keep the cone
//! of the start.
//!
//! Reads positions; writes its own lists.
//!
//! Invariant: a cluster or pair is culled only if its cones are known. A degenerate triangle, a
//! torn cluster or NaN gives the cosine −1, which is never culled.

use crate::math::min;
use crate::math::simd::{
    Float, Level, Scalar, Simd, gather_transpose, scatter_transpose, vectored,
};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::Vec3Lanes;
use crate::solver::self_collide::surface::cluster::CLUSTER_SIZE;

/// Clusters, or pairs of them, that are processed together.
const LANES: usize = 8;

/// Least cosine between a normal and the common direction of a culled cluster or pair: 60°.
const MIN_COSINE: f32 = 0.5;

/// The unit mean normal of a cluster's triangles, and the least cosine of a normal with it; −1 if
/// unknown.
type NormalCone = Float4;

/// A pair of neighbouring clusters, the cluster between them if they share only a vertex, and the
/// index that [`NormalCones::new`] gives the pair.
pub(crate) type NeighbourPair = ([u32; 2], Option<u32>, u32);

/// Eight clusters in columns.
#[derive(Clone, Copy, Debug)]
struct ConeBlock {
    /// Corners of the first triangle of each cluster, then of the second, … Clusters with fewer
    /// triangles repeat their last one.
    corners: [[[u32; LANES]; 3]; CLUSTER_SIZE],
    /// Number of triangles; 0 if the cone of the cluster is to be unknown.
    counts: [f32; LANES],
    /// Above 0 if the cone changes within the substep.
    turning: [f32; LANES],
}

/// Eight pairs of neighbours in columns: the first clusters, the second ones, and those between
/// them.
type ConePairBlock = [[u32; LANES]; 3];

/// Normal cones of all clusters, and which pairs of neighbours they cull.
#[derive(Clone, Debug)]
pub(crate) struct NormalCones {
    blocks: Vec<ConeBlock>,
    /// Cones at the start of the substep, and at its end.
    cones: [Vec<NormalCone>; 2],
    /// Pairs that share an edge; from block `first_vertex_block` on, pairs that share only a
    /// vertex.
    pairs: Vec<ConePairBlock>,
    first_vertex_block: usize,
    /// A bit for each pair: set if its triangles cannot meet.
    culled: Vec<u8>,
    /// The same before the last [`Self::update_turning`], and whether each cluster was flat then.
    was_culled: Vec<u8>,
    was_flat: Vec<bool>,
}

impl NormalCones {
    /// Allocates cones for `clusters` clusters and stores all neighbour pairs; writes the index of
    /// each pair to its third entry.
    pub fn new(clusters: usize, neighbours: &mut [NeighbourPair]) -> Self {
        let block = ConeBlock {
            corners: [[[0; LANES]; 3]; CLUSTER_SIZE],
            counts: [0.0; LANES],
            turning: [0.0; LANES],
        };
        let (mut pairs, mut first_vertex_block) = (Vec::new(), 0);
        for has_between in [false, true] {
            first_vertex_block = pairs.len();
            let own =
                neighbours.iter_mut().filter(|(_, between, _)| between.is_some() == has_between);
            for (i, ([one, other], between, index)) in own.enumerate() {
                if i % LANES == 0 {
                    pairs.push([[0; LANES]; 3]);
                }
                let (lane, last) = (i % LANES, pairs.len() - 1);
                for (list, cluster) in
                    pairs[last].iter_mut().zip([*one, *other, between.unwrap_or(0)])
                {
                    list[lane] = cluster;
                }
                *index = (last * LANES + lane) as u32;
            }
        }
        let blocks = clusters.div_ceil(LANES);
        Self {
            blocks: vec![block; blocks],
            cones: [(); 2].map(|()| vec![[0.0, 0.0, 0.0, -1.0]; blocks * LANES]),
            culled: vec![0; pairs.len()],
            was_culled: vec![0; pairs.len()],
            was_flat: vec![false; clusters],
            pairs,
            first_vertex_block,
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let per_block = size_of::<ConeBlock>() + 2 * LANES * size_of::<NormalCone>();
        per_block * self.blocks.len()
            + (size_of::<ConePairBlock>() + 2) * self.pairs.len()
            + self.was_flat.len()
    }

    /// Sets the corners of a cluster's triangles. With no triangles its cone is unknown.
    pub fn set_triangles(
        &mut self,
        cluster: usize,
        triangles: impl ExactSizeIterator<Item = [u32; 3]>,
    ) {
        let (block, lane) = (&mut self.blocks[cluster / LANES], cluster % LANES);
        let count = triangles.len();
        block.counts[lane] = count as f32;
        for (i, corners) in triangles.enumerate() {
            // The last triangle fills all slots behind it.
            let slots = i..if i + 1 == count { CLUSTER_SIZE } else { i + 1 };
            for triangle in &mut block.corners[slots] {
                for (list, corner) in triangle.iter_mut().zip(corners) {
                    list[lane] = corner;
                }
            }
        }
    }

    /// Sets whether the cone of a cluster changes within the substep.
    pub fn set_turning(&mut self, cluster: usize, is_turning: bool) {
        self.blocks[cluster / LANES].turning[cluster % LANES] = if is_turning { 1.0 } else { 0.0 };
    }

    /// Computes all cones from the positions at the start and now, and which pairs they cull.
    pub fn update(&mut self, level: Level, start: &[Float4], now: &[Float4]) {
        let [first, last] = &mut self.cones;
        compute_cones(level, &self.blocks, start, first, false);
        last.clone_from(first);
        let mut blocks = self.blocks.iter();
        let any_turning = blocks.any(|block| block.turning.iter().any(|turning| *turning > 0.0));
        if any_turning {
            compute_cones(level, &self.blocks, now, last, true);
        }
        let cones = [&self.cones[0][..], &self.cones[1]];
        let cones = if any_turning { &cones[..] } else { &cones[..1] };
        cull_pairs(level, &self.pairs, self.first_vertex_block, cones, &mut self.culled);
    }

    /// Computes the end cones of turning clusters anew, and which pairs they cull.
    pub fn update_turning(&mut self, level: Level, now: &[Float4]) {
        for (was_flat, cluster) in self.was_flat.iter_mut().zip(0..) {
            *was_flat = is_flat(&self.cones, cluster);
        }
        self.was_culled.clone_from(&self.culled);
        compute_cones(level, &self.blocks, now, &mut self.cones[1], true);
        let cones = [&self.cones[0][..], &self.cones[1]];
        cull_pairs(level, &self.pairs, self.first_vertex_block, &cones, &mut self.culled);
    }

    /// Whether triangles of a cluster cannot meet each other.
    #[inline(always)]
    pub fn is_flat(&self, cluster: u32) -> bool {
        is_flat(&self.cones, cluster)
    }

    /// Whether triangles of a pair cannot meet.
    #[inline(always)]
    pub fn is_culled(&self, pair: u32) -> bool {
        has_bit(&self.culled, pair)
    }

    /// Whether triangles of a cluster could not meet each other before the last
    /// [`Self::update_turning`], and can now.
    #[inline(always)]
    pub fn has_folded(&self, cluster: u32) -> bool {
        self.was_flat[cluster as usize] && !self.is_flat(cluster)
    }

    /// Whether triangles of a pair could not meet before the last [`Self::update_turning`], and can
    /// now.
    #[inline(always)]
    pub fn has_folded_pair(&self, pair: u32) -> bool {
        has_bit(&self.was_culled, pair) && !self.is_culled(pair)
    }
}

#[inline(always)]
fn is_flat([start, end]: &[Vec<NormalCone>; 2], cluster: u32) -> bool {
    min(start[cluster as usize][3], end[cluster as usize][3]) > MIN_COSINE
}

#[inline(always)]
fn has_bit(bits: &[u8], pair: u32) -> bool {
    bits[pair as usize / LANES] & (1 << (pair as usize % LANES)) != 0
}

vectored! {
    fn compute_cones(
        blocks: &[ConeBlock], x: &[Float4], cones: &mut [NormalCone], only_turning: bool,
    ) = compute_cones_lanes, compute_cones_scalar
}

vectored! {
    fn cull_pairs(
        pairs: &[ConePairBlock], first_vertex_block: usize, cones: &[&[NormalCone]],
        culled: &mut [u8],
    ) = cull_pairs_lanes, cull_pairs_scalar
}

fn compute_cones_scalar(
    blocks: &[ConeBlock],
    x: &[Float4],
    cones: &mut [NormalCone],
    only_turning: bool,
) {
    compute_cones_lanes(Scalar, blocks, x, cones, only_turning);
}

fn cull_pairs_scalar(
    pairs: &[ConePairBlock],
    first_vertex_block: usize,
    cones: &[&[NormalCone]],
    culled: &mut [u8],
) {
    cull_pairs_lanes(Scalar, pairs, first_vertex_block, cones, culled);
}

/// Computes the cones of all clusters, or only of those that turn.
#[inline(always)]
fn compute_cones_lanes<S: Simd>(
    s: S,
    blocks: &[ConeBlock],
    x: &[Float4],
    cones: &mut [NormalCone],
    only_turning: bool,
) {
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    for (number, block) in blocks.iter().enumerate() {
        for lane in (0..LANES).step_by(S::LANES) {
            let turning = s.load(&block.turning, lane);
            if only_turning && !s.any_positive(turning) {
                continue;
            }
            let counts = s.load(&block.counts, lane);
            let zero3 = Vec3Lanes { x: zero, y: zero, z: zero };
            let (mut normals, mut sum) = ([zero3; CLUSTER_SIZE], zero3);
            for (k, normal) in normals.iter_mut().enumerate() {
                let [a, b, c] = [0, 1, 2].map(|corner| {
                    Vec3Lanes::new(gather_transpose(s, x, &block.corners[k][corner][lane..]))
                });
                let doubled = b.minus(a).cross(c.minus(a));
                *normal = doubled.times(one / doubled.dot(doubled).sqrt());
                let (more, is_own) = (sum.plus(*normal), counts - s.splat(k as f32));
                sum = Vec3Lanes {
                    x: s.select(is_own, more.x, sum.x),
                    y: s.select(is_own, more.y, sum.y),
                    z: s.select(is_own, more.z, sum.z),
                };
            }
            let mean = sum.times(one / sum.dot(sum).sqrt());
            let mut cosine = one;
            for normal in normals {
                cosine = Float::min(normal.dot(mean), cosine);
            }
            // Without triangles or without a mean normal the cone is unknown.
            let is_known = Float::min(counts, mean.dot(mean));
            let cosine = s.select(is_known, cosine, zero - one);
            let ids: [u32; LANES] = core::array::from_fn(|i| (number * LANES + lane + i) as u32);
            let mut cone = [mean.x, mean.y, mean.z, cosine];
            if only_turning {
                let before = gather_transpose(s, cones, &ids);
                for (new, before) in cone.iter_mut().zip(before) {
                    *new = s.select(turning, *new, before);
                }
            }
            scatter_transpose(s, cones, &ids, cone);
        }
    }
}

/// Sets a bit for each pair whose triangles cannot meet, by the cones at all times in `cones`.
#[inline(always)]
fn cull_pairs_lanes<S: Simd>(
    s: S,
    pairs: &[ConePairBlock],
    first_vertex_block: usize,
    cones: &[&[NormalCone]],
    culled: &mut [u8],
) {
    let all = (1 << S::LANES) - 1;
    for (number, ([one, other, between], culled)) in pairs.iter().zip(culled).enumerate() {
        let mut bits = 0;
        for lane in (0..LANES).step_by(S::LANES) {
            let mut are_culled = all;
            for cones in cones {
                if are_culled == 0 {
                    break;
                }
                let (one, other) = (
                    gather_transpose(s, cones, &one[lane..]),
                    gather_transpose(s, cones, &other[lane..]),
                );
                let (a, b) = (Vec3Lanes::new(one), Vec3Lanes::new(other));
                are_culled &= is_height_field(s, [a, b], Float::min(one[3], other[3]));
                if number >= first_vertex_block {
                    // Two clusters that share only a vertex may have similar normals and still
                    // overlap, if the cluster between them is folded over. So that one must face
                    // the same way.
                    let between = gather_transpose(s, cones, &between[lane..]);
                    are_culled &= faces(s, Vec3Lanes::new(between), between[3], a.plus(b));
                }
            }
            bits |= are_culled << lane;
        }
        *culled = bits as u8;
    }
}

/// A bit for each lane: set if all normals lie within the limit of the bisector of two mean
/// normals. `cosine` is that of the larger half angle of both cones.
#[inline(always)]
fn is_height_field<S: Simd>(s: S, [a, b]: [Vec3Lanes<S::F>; 2], cosine: S::F) -> u32 {
    let (half, one) = (s.splat(0.5), s.splat(1.0));
    let bisector = Float::min((one + a.dot(b)) * half, one).sqrt();
    let least = s.splat(MIN_COSINE);
    s.positive_mask(cosine - least) & s.positive_mask(cosine_of_sum(s, bisector, cosine) - least)
}

/// A bit for each lane: set if all normals of a cone point to the side of `direction`.
#[inline(always)]
fn faces<S: Simd>(s: S, mean: Vec3Lanes<S::F>, cosine: S::F, direction: Vec3Lanes<S::F>) -> u32 {
    let to_mean = mean.dot(direction) / direction.dot(direction).sqrt();
    let sum = cosine_of_sum(s, Float::min(to_mean, s.splat(1.0)), cosine);
    s.positive_mask(to_mean) & s.positive_mask(cosine) & s.positive_mask(sum)
}

/// cos(α + β) = cos α cos β − √((1 − cos² α) (1 − cos² β)), for angles up to 90°.
#[inline(always)]
fn cosine_of_sum<S: Simd>(s: S, a: S::F, b: S::F) -> S::F {
    let one = s.splat(1.0);
    a * b - ((one - a * a) * (one - b * b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of clusters: each is a unit square of two triangles, turned by an angle [rad]
    /// against the square before it. Pair i joins squares i and i + 1.
    fn strip(angles: &[f32]) -> (NormalCones, Vec<Float4>) {
        let (mut x, mut angle, mut at) = (Vec::new(), 0.0_f32, [0.0, 0.0]);
        for turn in [0.0].iter().chain(angles) {
            x.extend([[at[0], at[1], 0.0, 1.0], [at[0], at[1], 1.0, 1.0]]);
            angle += turn;
            at = [at[0] + angle.cos(), at[1] + angle.sin()];
        }
        x.extend([[at[0], at[1], 0.0, 1.0], [at[0], at[1], 1.0, 1.0]]);
        let count = angles.len() + 1;
        let mut pairs: Vec<_> = (1..count as u32).map(|i| ([i - 1, i], None, u32::MAX)).collect();
        let mut cones = NormalCones::new(count, &mut pairs);
        assert!(pairs.iter().enumerate().all(|(i, (.., index))| *index == i as u32));
        for cluster in 0..count {
            let a = 2 * cluster as u32;
            let triangles = [[a, a + 1, a + 2], [a + 3, a + 2, a + 1]];
            cones.set_triangles(cluster, triangles.into_iter());
        }
        (cones, x)
    }

    #[test]
    fn flat_neighbours_are_culled_and_folded_neighbours_are_not() {
        for level in Level::available() {
            let angles = [0.0, 0.5, 1.5, 2.5, 0.1, 0.0, 0.0, 2.0, 0.0, 0.0];
            let (mut cones, x) = strip(&angles);
            cones.update(level, &x, &x);
            let culled: Vec<bool> = (0..10).map(|pair| cones.is_culled(pair)).collect();
            let expected = angles.map(|angle: f32| angle < 2.0 * MIN_COSINE.acos());
            assert_eq!(culled, expected, "{level:?}");
            assert!((0..11).all(|cluster| cones.is_flat(cluster)), "{level:?}");
        }
    }

    #[test]
    fn a_turning_cluster_is_tested_at_its_end_position_too() {
        for level in Level::available() {
            let (mut cones, start) = strip(&[0.0, 0.0]);
            let (_, end) = strip(&[3.0, 0.0]);
            cones.update(level, &start, &end);
            assert!(cones.is_culled(0), "no cluster is set to turn at {level:?}");
            cones.set_turning(1, true);
            cones.update(level, &start, &end);
            assert!(!cones.is_culled(0), "{level:?}");
            cones.update(level, &start, &start);
            assert!(cones.is_culled(0), "{level:?}");
            cones.update_turning(level, &end);
            assert!(!cones.is_culled(0) && cones.has_folded_pair(0), "{level:?}");
            cones.update_turning(level, &end);
            assert!(!cones.has_folded_pair(0), "it folded before, at {level:?}");
        }
    }

    #[test]
    fn a_degenerate_triangle_prevents_culling() {
        for level in Level::available() {
            let (mut cones, mut x) = strip(&[0.0, 0.0, 0.0]);
            x[2] = x[0];
            cones.update(level, &x, &x);
            assert!(!cones.is_flat(0) && !cones.is_culled(0), "{level:?}");
            assert!(cones.is_flat(2) && cones.is_culled(2), "{level:?}");
            let (mut cones, x) = strip(&[0.0]);
            cones.set_triangles(0, [].into_iter());
            cones.update(level, &x, &x);
            assert!(!cones.is_flat(0) && !cones.is_culled(0) && cones.is_flat(1), "{level:?}");
        }
    }
}
