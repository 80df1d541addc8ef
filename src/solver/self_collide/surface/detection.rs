//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), the pairs in them are found as they come near (`quads`), those
//! picked that may have gone far enough since (`stock`), and told apart many at once (`candidates`). Of what is left, what is near enough to push is found closely
//! (`near`), and the rest is left to the fence (`distant`). All goes by where particles are, in the order of the
//! mesh; when something was listed makes no difference.

use crate::solver::self_collide::surface::cluster_bvh::Patches;
use crate::solver::self_collide::surface::contact::{Contact, EDGES, Kind, VERTEX};
use crate::solver::self_collide::surface::contact_solver::NEAR;
use crate::solver::self_collide::surface::narrow_phase::Near;
use crate::solver::self_collide::surface::rest_gap::RestGap;
use crate::solver::self_collide::surface::separation_test::{Candidate, Candidates};
use crate::solver::self_collide::surface::speculative::Distant;
use crate::solver::self_collide::surface::swept_aabb::LANES;
use crate::solver::self_collide::surface::swept_particles::Motion;

/// So many strays are judged together; two patches make at most `MANY` more.
const TOGETHER: usize = 1024;
const MANY: usize = (3 * LANES) * (3 * LANES);

/// What is farther apart than it can go, by this much, is not looked at, which covers rounding [mean rest lengths].
const HAIR: f32 = 1.0e-4;

/// Room for strays.
pub(crate) fn room_for_strays() -> Candidates {
    Candidates::new(TOGETHER + MANY)
}

/// A look at where particles are.
pub(crate) struct Sift<'a> {
    pub rest_gap: RestGap<'a>,
    pub patches: &'a mut Patches,
    pub motion: &'a Motion,
}

/// Pairs that may meet in a substep, by their kind.
#[derive(Clone, Debug)]
pub(crate) struct Picked {
    kinds: [Candidates; 2],
    /// How many of each kind come before those of each pair of patches.
    before: Vec<[u32; 2]>,
}

impl Picked {
    /// For so many particles.
    pub fn new(count: usize) -> Self {
        let kinds = [4, 12].map(|each| Candidates::new(each * count));
        Self { kinds, before: Vec::with_capacity(8 * count) }
    }

    pub fn bytes(&self) -> usize {
        let kinds: usize = self.kinds.iter().map(Candidates::bytes).sum();
        kinds + size_of::<[u32; 2]>() * self.before.capacity()
    }
}

/// What may meet: what is near enough to push, and what is not.
pub(crate) struct Found<'a> {
    pub contacts: &'a mut Vec<Contact>,
    pub distant: &'a mut Vec<Distant>,
}

impl Sift<'_> {
    /// Finds all that may meet. `pairs`, `picked` and `near` are room to work in.
    pub fn find(
        &mut self,
        pairs: &mut Vec<u32>,
        picked: &mut Picked,
        near: &mut [Near; 2],
        found: &mut Found<'_>,
    ) {
        found.contacts.clear();
        found.distant.clear();
        let RestGap { world, gap, .. } = self.rest_gap;
        self.patches.fit(world.level, self.motion, world.mean_edge);
        self.patches.spend();
        self.patches.pair(gap, false, pairs);
        self.find_runs(pairs);
        let (Picked { kinds: [vertices, edges], before }, more) = (picked, self.more());
        [&mut *vertices, edges].into_iter().for_each(Candidates::clear);
        before.clear();
        for at in &*pairs {
            before.push([vertices.len() as u32, edges.len() as u32]);
            self.patches.pick::<VERTEX>(*at, more, vertices, |_| true);
            self.patches.pick::<EDGES>(*at, more, edges, |_| true);
        }
        before.push([vertices.len() as u32, edges.len() as u32]);
        vertices.judge::<VERTEX>(world.level, self.motion, gap);
        edges.judge::<EDGES>(world.level, self.motion, gap);
        for own in before.windows(2) {
            let ([from, first], [to, end]) = (own[0], own[1]);
            sort_out::<VERTEX>(vertices.meeting(from, to), &mut near[0], found);
            sort_out::<EDGES>(edges.meeting(first, end), &mut near[1], found);
        }
        near[0].finish::<VERTEX>(world.level, self.motion, found.contacts);
        near[1].finish::<EDGES>(world.level, self.motion, found.contacts);
    }

    /// Adds to the distant what those may meet that strayed. `pairs` and `strays` are room to work in.
    pub fn find_strays(
        &mut self,
        pairs: &mut Vec<u32>,
        strays: &mut Candidates,
        distant: &mut Vec<Distant>,
    ) {
        self.patches.follow_strays(self.rest_gap.world.level, self.motion);
        self.patches.pair(self.rest_gap.gap, true, pairs);
        self.find_runs(pairs);
        // One kind after the other, so that lots make no difference to the order.
        self.judge_strays::<VERTEX>(pairs, strays, distant);
        self.judge_strays::<EDGES>(pairs, strays, distant);
    }

    fn judge_strays<const FIRST: Kind>(
        &mut self,
        pairs: &[u32],
        strays: &mut Candidates,
        distant: &mut Vec<Distant>,
    ) {
        let RestGap { world, gap, .. } = self.rest_gap;
        for (number, at) in pairs.iter().enumerate() {
            let has_strayed = |ids: &[u32; 4]| ids.iter().any(|id| self.motion.strays(*id));
            self.patches.pick::<FIRST>(*at, self.more(), strays, has_strayed);
            if strays.len() > TOGETHER || number + 1 == pairs.len() {
                let count = strays.len() as u32;
                strays.judge::<FIRST>(world.level, self.motion, gap);
                distant.extend(strays.meeting(0, count).map(|stray| stray.as_distant(FIRST)));
                strays.clear();
            }
        }
    }

    /// Finds what may meet of listed pairs of patches.
    fn find_runs(&mut self, pairs: &[u32]) {
        let more = self.more();
        for at in pairs {
            self.patches.find_run(*at, &self.rest_gap, self.motion, more);
        }
        self.patches.quads.measure(self.rest_gap.world.level, &self.motion.start);
    }

    /// What pairs may be apart beyond all ways that they can have gone, and may meet still [m].
    fn more(&self) -> f32 {
        let RestGap { world, gap, .. } = self.rest_gap;
        NEAR[0] * gap + world.mean_edge * HAIR
    }
}

/// Tells the near from the distant.
#[inline(always)]
fn sort_out<const FIRST: Kind>(
    candidates: impl Iterator<Item = Candidate>,
    near: &mut Near,
    found: &mut Found<'_>,
) {
    for candidate in candidates {
        if candidate.distance >= candidate.gap * NEAR[FIRST as usize - 1] {
            found.distant.push(candidate.as_distant(FIRST));
        } else {
            near.push(candidate.ids, FIRST, candidate.gap, found.contacts);
        }
    }
}
