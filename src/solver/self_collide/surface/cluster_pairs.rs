//! Which patches may meet: in a tick by the tree, and of those in a substep.

use crate::math::max;
use crate::mesh::NONE;
use crate::solver::self_collide::surface::cluster_bvh::Patches;
use crate::solver::self_collide::surface::swept_aabb::Sweep;
use crate::solver::self_collide::surface::tick_bounds::Reach;

/// What covers rounding in ways.
const ROUNDING: f32 = 1.001;

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
                let own = patch.vertices[0] as usize..patch.vertices[2] as usize;
                all = Sweep::around(&self.vertices[own], reach.rooms());
            }
            self.reaches[at] = all;
        }
        let mut listed = core::mem::take(&mut self.listed);
        let mut places = core::mem::take(&mut self.places);
        places.clear();
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
                    listed.push([one.patch; 2]);
                    places.push(NONE);
                }
            } else if self.reaches[a as usize].meets(&self.reaches[b as usize], gap) {
                if one.patch != NONE && other.patch != NONE {
                    listed.push([one.patch, other.patch]);
                    places.push(self.place_beside([one.patch, other.patch]));
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
        (self.stack, self.listed, self.places) = (stack, listed, places);
    }

    /// Takes those of the listed pairs that may come nearer than `gap` in this substep; of `strays` only those that
    /// have some. `pairs` gets their places in the list.
    pub fn pair(&self, gap: f32, strays: bool, pairs: &mut Vec<u32>) {
        pairs.clear();
        for (at, ([one, other], place)) in self.listed.iter().zip(&self.places).enumerate() {
            let is_quiet = if one == other {
                self.leans.is_flat(*one)
            } else if strays {
                false
            } else {
                *place != NONE && self.leans.is_quiet(*place)
            };
            if is_quiet {
                continue;
            }
            let [a, b] = [*one as usize, *other as usize];
            if strays && !self.patches[a].has_strays && !self.patches[b].has_strays {
                continue;
            }
            if a != b && !self.sweeps[a].meets(&self.sweeps[b], gap) {
                continue;
            }
            if !strays || *place == NONE || !self.leans.is_quiet_again(*place) {
                pairs.push(at as u32);
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
        self.listed[at as usize]
    }

    /// The place of a pair among those beside each other, or `NONE`.
    fn place_beside(&self, [one, other]: [u32; 2]) -> u32 {
        let [from, to] = self.patches[one as usize].beside;
        let beside = &self.beside[from as usize..to as usize];
        beside.iter().find(|[patch, _]| *patch == other).map_or(NONE, |[_, place]| *place)
    }
}
