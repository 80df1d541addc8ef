//! Which patches may meet: in a tick by the tree, and of those in a substep.

use super::patches::{Lean, Patches};
use super::reach::Reach;
use super::sweep::Sweep;
use crate::math::{max, min};
use crate::mesh::NONE;
use glam::Vec3;

/// The bit of a listed pair whose patches are beside each other, or the same.
const BESIDE: u32 = 1 << 31;

/// What covers rounding in ways.
const ROUNDING: f32 = 1.001;

/// What leans no farther than this from one direction lies beside each other as seen from there, and cannot meet
/// (cosine of 60°).
const STEEP: f32 = 0.5;

impl Patches {
    /// Lists the pairs of patches that may come nearer than `gap` in this tick, the lower first: always in the same
    /// order. Patches are listed with themselves as well.
    pub fn list(&mut self, reach: &Reach, gap: f32) {
        for at in (0..self.nodes.len()).rev() {
            let node = self.nodes[at];
            let mut all;
            if node.patch == NONE {
                all = self.reaches[at + 1];
                all.join(&self.reaches[node.second as usize]);
            } else {
                let patch = &self.patches[node.patch as usize];
                all = Sweep::EMPTY;
                let own = patch.vertices[0] as usize..patch.vertices[2] as usize;
                self.vertices[own].iter().for_each(|v| reach.add_to(&mut all, *v));
            }
            self.reaches[at] = all;
        }
        let mut listed = core::mem::take(&mut self.listed);
        self.quads.begin_list(&mut listed);
        let mut stack = core::mem::take(&mut self.stack);
        stack.clear();
        stack.push([0, 0]);
        while let Some([a, b]) = stack.pop() {
            let (one, other) = (self.nodes[a as usize], self.nodes[b as usize]);
            if a == b {
                if one.patch == NONE {
                    stack.push([one.second, one.second]);
                    stack.push([a + 1, one.second]);
                    stack.push([a + 1, a + 1]);
                } else {
                    listed.push([one.patch, one.patch | BESIDE]);
                }
            } else if self.reaches[a as usize].meets(&self.reaches[b as usize], gap) {
                if one.patch != NONE && other.patch != NONE {
                    let beside = self.are_beside([one.patch, other.patch]);
                    listed.push([one.patch, other.patch | if beside { BESIDE } else { 0 }]);
                } else if one.patch == NONE && one.count >= other.count {
                    stack.push([one.second, b]);
                    stack.push([a + 1, b]);
                } else {
                    stack.push([a, other.second]);
                    stack.push([a, b + 1]);
                }
            }
        }
        self.quads.end_list(&listed, self.patches.len());
        (self.stack, self.listed) = (stack, listed);
    }

    /// Takes those of the listed pairs that may come nearer than `gap` in this substep; of `strays` only those that
    /// have some. `pairs` gets their places in the list.
    pub fn pair(&self, gap: f32, strays: bool, pairs: &mut Vec<u32>) {
        pairs.clear();
        for at in 0..self.listed.len() as u32 {
            let pair = self.listed_pair(at);
            let are_beside = self.listed[at as usize][1] & BESIDE != 0;
            let [a, b] = pair.map(|at| at as usize);
            if strays && !self.patches[a].has_strays && !self.patches[b].has_strays {
                continue;
            }
            if a != b && !self.sweeps[a].meets(&self.sweeps[b], gap) {
                continue;
            }
            if !are_beside || !self.is_quiet(pair) {
                pairs.push(at);
            }
        }
    }

    /// The most that what is in a listed pair goes against each other in this substep, together with `more` [m].
    #[inline(always)]
    pub fn ways_of(&self, at: u32, more: f32) -> f32 {
        let [one, other] = self.listed_pair(at).map(|at| at as usize);
        let ways = self.sweeps[one].way_against(&self.sweeps[other]) * ROUNDING + more;
        if ways < f32::INFINITY { ways } else { f32::INFINITY }
    }

    /// The most that what is in a listed pair went against each other since patches were fitted before [m].
    #[inline(always)]
    pub fn step_of(&self, at: u32) -> f32 {
        let [one, other] = self.listed_pair(at).map(|at| at as usize);
        let ([from, to], [least, most]) = (&self.steps[one], &self.steps[other]);
        let mut sum = 0.0;
        for k in 0..3 {
            let way = max(to[k] - least[k], most[k] - from[k]);
            sum += way * way;
        }
        sum.sqrt() * ROUNDING
    }

    /// The patches of listed pair `at`.
    #[inline(always)]
    pub fn listed_pair(&self, at: u32) -> [u32; 2] {
        let [one, other] = self.listed[at as usize];
        [one, other & !BESIDE]
    }

    /// Whether triangles cannot meet of a patch or of two neighbours, since they lean little as a substep begins and
    /// as it ends.
    fn is_quiet(&self, [one, other]: [u32; 2]) -> bool {
        let leans = |patch: u32| &self.patches[patch as usize].leans;
        let (ours, theirs) = (leans(one), leans(other));
        if one == other {
            return ours.iter().all(|lean| lean.cone > STEEP);
        }
        if !ours.iter().zip(theirs).all(|(a, b)| a.is_along(b)) {
            return false;
        }
        // Around a common vertex all may lean alike that lie on each other, if what is between them is turned over.
        let between = self.between([one, other]);
        between == NONE
            || ours
                .iter()
                .zip(theirs)
                .zip(leans(between))
                .all(|((a, b), c)| c.faces(a.normal + b.normal))
    }

    fn are_beside(&self, [one, other]: [u32; 2]) -> bool {
        one == other || self.beside(one).iter().any(|[patch, _]| *patch == other)
    }

    /// The patch between two that share no more than a vertex.
    fn between(&self, [one, other]: [u32; 2]) -> u32 {
        let beside = self.beside(one).iter().find(|[patch, _]| *patch == other);
        beside.map_or(NONE, |[_, between]| *between)
    }

    fn beside(&self, patch: u32) -> &[[u32; 2]] {
        let [from, to] = self.patches[patch as usize].beside;
        &self.beside[from as usize..to as usize]
    }
}

impl Lean {
    /// Whether all normals lean little, seen from amid two means: by the half of what those are apart, and what normals
    /// lean from them.
    fn is_along(&self, other: &Self) -> bool {
        let cone = min(self.cone, other.cone);
        let half = min((1.0 + self.normal.dot(other.normal)) * 0.5, 1.0);
        cone > STEEP && cosine_of_sum(half.sqrt(), cone) > STEEP
    }

    /// Whether all normals are on the side that a way leads to.
    fn faces(&self, way: Vec3) -> bool {
        let cosine = self.normal.dot(way) / way.length();
        cosine > 0.0 && self.cone > 0.0 && cosine_of_sum(min(cosine, 1.0), self.cone) > 0.0
    }
}

/// The cosine of the sum of two angles up to a right one, of their cosines.
fn cosine_of_sum(a: f32, b: f32) -> f32 {
    a * b - ((1.0 - a * a) * (1.0 - b * b)).sqrt()
}
