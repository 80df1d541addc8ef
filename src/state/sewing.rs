//! Sewn pairs: particles that are drawn together and then held at one place.
//!
//! ```text
//! panel ──●╌╌╌╌ ≤ length ╌╌╌╌●── panel      length falls by `speed` to 0
//!         ●●                                 closed: one place, one velocity
//! ```
//! Data only; `cloth::sew` and `solver::stretch::sewn_pairs` write it.
//! Without the feature `sewing` there are no pairs, and the compiler removes what handles them.
//! Invariant: the lists that follow from the pairs are up to date after `rebuild` or
//! `refresh_groups`, and have no entries but those of the particles of the pairs.

use crate::error::{Error, Result, check};
use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::sort;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Ends a list of members.
const NO_MEMBER: u32 = u32::MAX;

/// What joins the two particles of a sewn pair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum SewKind {
    /// As if woven in one piece: never tears, and normals are smooth across.
    #[default]
    Weld = 0,
    /// A thread: tears under more than `tear_force`, and keeps the normals of both sides apart.
    Stitch = 1,
}

/// How [`Cloth::sew`](crate::Cloth::sew) joins pairs of particles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SewDesc {
    /// Speed at which the distance of each pair falls to zero [m/s], above 0. Default: 0.5.
    pub speed: f32,
    /// What joins the particles. Default: [`SewKind::Weld`].
    pub kind: SewKind,
    /// Force on one pair above which a stitch tears [N], at least 0; 0 = never. Default: 0.
    ///
    /// The force is the mean over a tick. A weld ignores it.
    pub tear_force: f32,
}

impl Default for SewDesc {
    fn default() -> Self {
        Self { speed: 0.5, kind: SewKind::Weld, tear_force: 0.0 }
    }
}

impl SewDesc {
    /// Refuses values that are out of range.
    pub(crate) fn check(&self) -> Result<()> {
        let Self { speed, tear_force, .. } = *self;
        check(speed.is_finite() && speed > 0.0, "speed", "be above 0 and finite")?;
        check(tear_force.is_finite() && tear_force >= 0.0, "tear_force", "be at least 0 and finite")
    }
}

/// How far a pair is sewn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum SewState {
    /// The distance is limited by `length`, which falls.
    Drawn,
    /// Closed in this tick.
    Closing,
    /// Closed when the tick began.
    Closed,
    /// Torn, and still so near that the sides do not collide.
    Torn,
    /// Torn and apart.
    Parted,
}

/// Two particles that are sewn together. Field order is part of the save format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SewnPair {
    pub particles: [u32; 2],
    pub kind: SewKind,
    pub state: SewState,
    /// Largest distance while drawn [m].
    pub length: f32,
    /// Speed at which `length` falls [m/s].
    pub speed: f32,
    /// Force above which a stitch tears [N]; 0 = never.
    pub tear_force: f32,
}

impl SewnPair {
    pub fn is_closed(&self) -> bool {
        matches!(self.state, SewState::Closing | SewState::Closed)
    }

    /// Whether the pair exerts forces.
    pub fn is_active(&self) -> bool {
        self.is_closed() || self.state == SewState::Drawn
    }
}

/// All sewn pairs, and their groups: particles that pairs connect.
///
/// `members` are the particles of all pairs, each once and in ascending order. The other lists have
/// one entry per member, and name a group by its first member.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sewing {
    pub pairs: Vec<SewnPair>,
    #[serde(skip)]
    pub members: Vec<u32>,
    /// The members at the ends of each pair.
    #[serde(skip)]
    pub ends: Vec<[u32; 2]>,
    /// Group of each member by closed pairs.
    #[serde(skip)]
    pub closed: Vec<u32>,
    /// Group of each member by closed welds, and the next member of that group; `NO_MEMBER` ends
    /// the list that starts at the group's first member.
    #[serde(skip)]
    welded: Vec<u32>,
    #[serde(skip)]
    next_welded: Vec<u32>,
    /// Whether a closed pair holds each member.
    #[serde(skip)]
    joined: Vec<bool>,
    /// For each particle up to the last member the first one of its group by all pairs that do not
    /// collide.
    #[serde(skip)]
    leaders: Vec<u32>,
    /// Scratch: a weighted sum and a weight per group.
    #[serde(skip)]
    pub sums: Vec<(Vec3, f32)>,
    /// Sum over the tick of what closed pairs moved each member by, over its inverse mass [kg m].
    #[serde(skip)]
    pub pulls: Vec<Vec3>,
}

heap_bytes!(
    Sewing {
        pairs, members, ends, closed, welded, next_welded, joined, leaders, sums, pulls,
    } plain {}
);

impl Sewing {
    /// All pairs; none without the feature `sewing`.
    #[inline]
    pub fn pairs(&self) -> &[SewnPair] {
        if cfg!(feature = "sewing") { &self.pairs } else { &[] }
    }

    #[inline]
    pub fn is_empty(&self) -> bool {
        self.pairs().is_empty()
    }

    /// Whether any pair is still drawn together.
    pub fn is_drawing(&self) -> bool {
        self.pairs().iter().any(|pair| pair.state == SewState::Drawn)
    }

    /// Rebuilds all lists after pairs were added or restored.
    pub fn rebuild(&mut self) {
        let Self { pairs, members, ends, .. } = self;
        members.clear();
        members.extend(pairs.iter().flat_map(|pair| pair.particles));
        sort(members);
        members.dedup();
        let member = |particle: u32| members.partition_point(|other| *other < particle) as u32;
        ends.clear();
        ends.extend(pairs.iter().map(|pair| pair.particles.map(member)));
        let count = members.len();
        self.closed.resize(count, 0);
        self.welded.resize(count, 0);
        self.next_welded.resize(count, NO_MEMBER);
        self.joined.resize(count, false);
        self.sums.resize(count, (Vec3::ZERO, 0.0));
        self.pulls.clear();
        self.pulls.resize(count, Vec3::ZERO);
        self.refresh_groups();
    }

    /// Updates the groups after the state of a pair changed.
    pub fn refresh_groups(&mut self) {
        let Self { pairs, members, ends, closed, welded, next_welded, joined, leaders, .. } = self;
        let is_weld = |pair: &SewnPair| pair.is_closed() && pair.kind == SewKind::Weld;
        connect(closed, pairs, ends, SewnPair::is_closed);
        connect(welded, pairs, ends, is_weld);
        next_welded.fill(NO_MEMBER);
        for at in (0..welded.len()).rev() {
            let first = welded[at] as usize;
            if first != at {
                next_welded[at] = core::mem::replace(&mut next_welded[first], at as u32);
            }
        }
        joined.fill(false);
        for (_, ends) in pairs.iter().zip(&*ends).filter(|(pair, _)| pair.is_closed()) {
            ends.iter().for_each(|end| joined[*end as usize] = true);
        }
        let last = members.last().map_or(0, |last| *last + 1);
        leaders.clear();
        leaders.extend(0..last);
        for pair in pairs.iter().filter(|pair| pair.state != SewState::Parted) {
            join(leaders, pair.particles);
        }
        flatten(leaders);
    }

    /// The first particle of the group of a particle that do not collide with each other; mostly
    /// the particle itself.
    #[inline]
    pub fn leader(&self, particle: u32) -> u32 {
        self.leaders.get(particle as usize).copied().unwrap_or(particle)
    }

    /// Whether a closed pair holds a particle.
    pub fn is_joined(&self, particle: u32) -> bool {
        !self.is_empty() && self.members.binary_search(&particle).is_ok_and(|at| self.joined[at])
    }

    /// The particles of each welded group of two or more.
    pub fn welds(&self) -> impl Iterator<Item = impl Iterator<Item = usize> + Clone + '_> + '_ {
        let is_member = |at: u32| (at != NO_MEMBER).then_some(at);
        let is_first = |at: &u32| self.welded[*at as usize] == *at;
        let first = (0..self.members.len() as u32).filter(is_first);
        first.filter(|at| self.next_welded[*at as usize] != NO_MEMBER).map(move |first| {
            core::iter::successors(Some(first), move |at| is_member(self.next_welded[*at as usize]))
                .map(|at| self.members[at as usize] as usize)
        })
    }

    /// Refuses pairs that were saved by a build with the feature `sewing`, in one without it.
    pub fn check_feature(&self) -> Result<()> {
        if self.pairs.len() == self.pairs().len() {
            return Ok(());
        }
        Err(Error::MissingFeature { what: "a sewn pair", feature: "sewing" })
    }

    /// Whether the pairs fit a cloth of `count` particles.
    pub fn is_valid(&self, count: usize) -> bool {
        self.pairs.iter().all(|pair| {
            let [a, b] = pair.particles;
            let desc = SewDesc { speed: pair.speed, kind: pair.kind, tear_force: pair.tear_force };
            a != b
                && pair.particles.iter().all(|particle| (*particle as usize) < count)
                && pair.length.is_finite()
                && pair.length >= 0.0
                && desc.check().is_ok()
        })
    }
}

/// Sets the group of each member by the pairs that `joins` selects.
fn connect(
    groups: &mut [u32],
    pairs: &[SewnPair],
    ends: &[[u32; 2]],
    joins: impl Fn(&SewnPair) -> bool,
) {
    (0..).zip(groups.iter_mut()).for_each(|(own, group)| *group = own);
    for (_, ends) in pairs.iter().zip(ends).filter(|(pair, _)| joins(pair)) {
        join(groups, *ends);
    }
    flatten(groups);
}

/// Joins two groups: the one with the lower root becomes the root of both.
fn join(groups: &mut [u32], ends: [u32; 2]) {
    let [a, b] = ends.map(|mut at| {
        while groups[at as usize] != at {
            at = groups[at as usize];
        }
        at
    });
    groups[a.max(b) as usize] = a.min(b);
}

/// Lets each entry name its root. Roots are lower than what refers to them.
fn flatten(groups: &mut [u32]) {
    for at in 0..groups.len() {
        groups[at] = groups[groups[at] as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saved_pairs_are_refused_without_the_feature() {
        assert_eq!(Sewing::default().check_feature(), Ok(()));
        let pair = SewnPair {
            particles: [0, 1],
            kind: SewKind::Weld,
            state: SewState::Closed,
            length: 0.0,
            speed: 1.0,
            tear_force: 0.0,
        };
        let sewing = Sewing { pairs: vec![pair], ..Sewing::default() };
        let has_feature = cfg!(feature = "sewing");
        assert_eq!(sewing.check_feature().is_ok(), has_feature);
        assert_eq!(sewing.is_empty(), !has_feature);
    }
}
