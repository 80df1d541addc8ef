//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), the pairs in them are listed as they come near (`quads`),
//! and told apart many at once (`candidates`). Of what is left, what is near enough to push is found closely
//! (`near`), and the rest is left to the fence (`distant`). All goes by where particles are, in the order of the
//! mesh; when something was listed makes no difference.

use super::candidates::{Candidate, Candidates};
use super::contacts::{Contact, EDGES, Kind, VERTEX};
use super::distant::Distant;
use super::motion::Motion;
use super::near::Near;
use super::patches::Patches;
use super::push::NEAR;
use super::quads::{Quads, Run};
use super::reach::Reach;
use super::sweep::LANES;
use super::weave::Weave;

/// So many strays are judged together; two patches make at most `MANY` more.
const TOGETHER: usize = 1024;
const MANY: usize = (3 * LANES) * (3 * LANES);

/// Room for strays.
pub(super) fn room_for_strays() -> Candidates {
    Candidates::new(TOGETHER + MANY)
}

/// A look at where particles are.
pub(super) struct Sift<'a> {
    pub weave: Weave<'a>,
    pub patches: &'a mut Patches,
    pub motion: &'a Motion,
    pub reach: &'a Reach,
}

/// What may meet: what is near enough to push, and what is not.
pub(super) struct Found<'a> {
    pub contacts: &'a mut Vec<Contact>,
    pub distant: &'a mut Vec<Distant>,
}

impl Sift<'_> {
    /// Finds all that may meet. `pairs` and `near` are room to work in.
    pub fn find(&mut self, pairs: &mut Vec<u32>, near: &mut [Near; 2], found: &mut Found<'_>) {
        found.contacts.clear();
        found.distant.clear();
        let Weave { world, gap, .. } = self.weave;
        self.patches.fit(&world.mesh, self.motion, world.spacing);
        self.patches.pair(gap, false, pairs);
        for at in &*pairs {
            self.run(*at);
        }
        let Quads { vertices, edges, .. } = &mut self.patches.quads;
        vertices.judge::<VERTEX>(world.level, self.motion, gap);
        edges.judge::<EDGES>(world.level, self.motion, gap);
        for at in &*pairs {
            let Run { vertices: [from, to], edges: [first, end] } = self.run(*at);
            let Quads { vertices, edges, .. } = &self.patches.quads;
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
        self.patches.follow_strays(&self.weave.world.mesh, self.motion);
        self.patches.pair(self.weave.gap, true, pairs);
        for at in &*pairs {
            self.run(*at);
        }
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
        let Weave { world, gap, .. } = self.weave;
        for (number, at) in pairs.iter().enumerate() {
            let run = self.run(*at);
            let Quads { vertices, edges, .. } = &self.patches.quads;
            let (all, [from, to]) =
                if FIRST == VERTEX { (vertices, run.vertices) } else { (edges, run.edges) };
            for at in from..to {
                let (ids, gap) = all.pair(at as usize);
                if ids.iter().any(|id| self.motion.strays(*id)) {
                    strays.push(ids, gap);
                }
            }
            if strays.len() > TOGETHER || number + 1 == pairs.len() {
                let count = strays.len() as u32;
                strays.judge::<FIRST>(world.level, self.motion, gap);
                distant.extend(strays.meeting(0, count).map(|stray| stray.as_distant(FIRST)));
                strays.clear();
            }
        }
    }

    /// What may meet of a listed pair of patches.
    fn run(&mut self, at: u32) -> Run {
        self.patches.run(at, &self.weave, self.reach)
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
