//! The hinges of any mesh: one implicit step of bending for all at once.
//!
//! With K the matrix of the bending energy, a substep of length h is to end at M d = −h² K (x + d), where d
//! is what bending moves the particles by. K is symmetric and, as the hinges are quadratic, the same wherever
//! the mesh is. So d comes of a few explicit steps where the mesh is soft, see `descent`, and else by
//! conjugate gradients (Hestenes and Stiefel 1952), with the diagonal as their preconditioner. Each step
//! costs what one sweep over the hinges would, but as many of them as the root of the stiffness over mass
//! are enough, where sweeps would take as many as itself.

use super::descent::Descent;
use super::hinges::Step;
use super::spots::Spots;
use crate::fabric::facets::Row;
use crate::fabric::hinges::{Hinges, normal};
use crate::math::{TINY, max};
use glam::{Vec3, Vec4};

/// The most steps of conjugate gradients that a round makes.
const MOST_STEPS: f32 = 48.0;

/// From this stiffness over mass on a second round pays.
const TWICE: f32 = 0.25;

/// Steps end when what is left has so much of the square of what there was.
const LEFT: f32 = 1.0e-8;

/// A hinge as a step wants it: C √k = Σ cᵢ (xᵢ − x₀), so that it does not matter where the mesh is.
#[derive(Clone, Copy, Debug)]
struct Flap {
    at: [u32; 4],
    /// All weights but the first one, which is less the sum of the others, times the root of the stiffness.
    weight: [f32; 3],
    /// The root of the stiffness; 0, as the weights, if its link does not hold.
    root: f32,
}

/// Room to work in: a number or a vector for each particle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    /// As long as links, stiffness and what is held stay: those of `stiffness` and `revision`, …
    flaps: Vec<Flap>,
    /// … how they go together, and the most that coupling adds to what they resist.
    rows: Vec<Row>,
    coupling: f32,
    /// The curvature of each, where they are coupled.
    curve: Vec<Vec4>,
    stiffness: f32,
    revision: u32,
    /// The steps that are enough as long as masses stay too; none if there are too many.
    descent: Option<Descent>,
    /// What flaps resist at most when a particle alone is moved [kg].
    own: Vec<f32>,
    w: Vec<f32>,
    /// Mass and one over the diagonal; 0 for what is held.
    mass: Vec<f32>,
    over: Vec<f32>,
    /// Where particles are seen; as all that follow x, y, z and 0, which fit a vector register.
    x: Vec<Vec4>,
    /// What bending has moved each particle by in this substep [m].
    given: Vec<Vec4>,
    change: Vec<Vec4>,
    force: Vec<Vec4>,
    way: Vec<Vec4>,
    pull: Vec<Vec4>,
}

impl Scratch {
    /// Room for so many hinges and particles.
    pub fn new(hinges: usize, capacity: usize) -> Self {
        let numbers = || Vec::with_capacity(capacity);
        let vectors = || Vec::with_capacity(capacity);
        Self {
            flaps: Vec::with_capacity(hinges),
            rows: Vec::with_capacity(hinges),
            coupling: 0.0,
            curve: Vec::with_capacity(hinges),
            stiffness: 0.0,
            revision: 0,
            descent: None,
            own: numbers(),
            w: numbers(),
            mass: numbers(),
            over: numbers(),
            x: vectors(),
            given: vectors(),
            change: vectors(),
            force: vectors(),
            way: vectors(),
            pull: vectors(),
        }
    }

    /// No shape has more stiffness over mass: that of a flap is at most four times what the flap adds to
    /// its particles' own.
    fn bound(&self) -> f32 {
        let each = self.own.iter().zip(&self.w).map(|(own, w)| own * w);
        4.0 * each.fold(0.0, |most, own| if own > most { own } else { most })
    }
}

/// The hinges as they are now.
#[derive(Clone, Copy)]
pub(crate) struct Flaps<'a> {
    pub hinges: &'a Hinges,
    /// Which links hold.
    pub active: &'a [bool],
    /// What folds add to how each is bent at rest [m]; none if there are none.
    pub folds: Option<&'a [f32]>,
    pub step: Step,
    /// Stiffness over mass of hinges as far apart as edges are long.
    pub over_mass: f32,
    /// Whether it is the first round of the substep.
    pub is_first: bool,
}

impl Flaps<'_> {
    /// Bends `count` particles for one round; the second one only where it pays. `start` is where the
    /// substep began.
    pub fn bend<S: Spots>(
        &self,
        room: &mut Scratch,
        count: usize,
        start: impl Fn(usize) -> Vec3,
        spots: &mut S,
    ) {
        if !self.is_first && (self.over_mass < TWICE || room.descent.is_some()) {
            return;
        }
        let is_new = self.make_room(room, count);
        if self.seat(room, start, spots) || is_new {
            self.take_up(room);
            room.descent = Descent::new(room.bound());
        }
        add_pulls(
            &room.flaps,
            coupled(&room.rows, room.coupling),
            &mut room.curve,
            &room.x,
            &mut room.force,
        );
        self.add_rest(room, spots);
        match room.descent {
            Some(descent) => descend(room, &descent),
            None => self.solve(room),
        }
        for (i, (given, change)) in room.given.iter_mut().zip(&room.change).enumerate() {
            let (x, w) = spots.spot(i);
            if w > 0.0 {
                spots.put(i, x + change.truncate());
                *given += *change;
            }
        }
    }

    /// Room for so many particles; whether they, links or stiffness have changed.
    fn make_room(&self, room: &mut Scratch, count: usize) -> bool {
        let (revision, stiffness) = (self.hinges.revision, self.step.stiffness);
        let is_known = (room.revision, room.stiffness) == (revision, stiffness);
        if is_known && room.own.len() == count {
            return false;
        }
        for numbers in [&mut room.w, &mut room.mass, &mut room.over, &mut room.own] {
            numbers.resize(count, 0.0);
        }
        let vectors = [&mut room.x, &mut room.given, &mut room.force];
        let more = [&mut room.change, &mut room.way, &mut room.pull];
        vectors.into_iter().chain(more).for_each(|vectors| vectors.resize(count, Vec4::ZERO));
        room.curve.resize(self.hinges.all.len(), Vec4::ZERO);
        (room.revision, room.stiffness) = (revision, stiffness);
        true
    }

    /// Takes up links, stiffness and what is held.
    fn take_up(&self, room: &mut Scratch) {
        let Scratch { rows, w, .. } = room;
        let holds = |hinge: usize| self.active[self.hinges.links[hinge] as usize];
        let is_held = |vertex: u32| w[vertex as usize] == 0.0;
        self.hinges.facets.couple(&self.hinges.all, holds, is_held, rows);
        room.own.fill(0.0);
        room.flaps.clear();
        room.coupling = 0.0;
        for (hinge, row) in self.hinges.all.iter().zip(&room.rows) {
            let root = (row.shape * self.step.stiffness).sqrt();
            let [_, q, a, b] = hinge.weight;
            let weight = [q * root, a * root, b * root];
            let first = -((weight[0] + weight[1]) + weight[2]);
            // What couples it adds at most so much to what it resists.
            let [p, q, a, b] = row.by.map(f32::abs);
            let coupling = (p + q) + (a + b);
            for (vertex, c) in hinge.at.iter().zip([first, weight[0], weight[1], weight[2]]) {
                room.own[*vertex as usize] += c * c * (1.0 + coupling);
            }
            room.flaps.push(Flap { at: hinge.at, weight, root });
            room.coupling = max(room.coupling, coupling);
        }
    }

    /// Sees where particles are; whether they weigh something else than they did.
    fn seat<S: Spots>(&self, room: &mut Scratch, start: impl Fn(usize) -> Vec3, spots: &S) -> bool {
        let before = self.step.before;
        let mut has_changed = false;
        let known = room.w.iter_mut().zip(&mut room.mass);
        for (i, (seat, (known, mass))) in room.x.iter_mut().zip(known).enumerate() {
            let (x, w) = spots.spot(i);
            let seen = if before > 0.0 { x - start(i) * before } else { x };
            *seat = seen.extend(0.0);
            if *known != w {
                (*known, *mass) = (w, if w > 0.0 { 1.0 / w } else { 0.0 });
                has_changed = true;
            }
        }
        if self.is_first {
            room.given.fill(Vec4::ZERO);
        }
        for ((force, given), mass) in room.force.iter_mut().zip(&room.given).zip(&room.mass) {
            *force = -*given * *mass;
        }
        has_changed
    }

    /// What pushes particles where hinges are bent at rest.
    fn add_rest<S: Spots>(&self, room: &mut Scratch, spots: &S) {
        if !self.hinges.are_bent && self.folds.is_none() {
            return;
        }
        let (flaps, hinges) = (room.flaps.iter(), &self.hinges.all);
        for (at, ((flap, hinge), curve)) in flaps.zip(hinges).zip(&mut room.curve).enumerate() {
            let rest = hinge.rest + self.folds.map_or(0.0, |folds| folds[at]);
            *curve = Vec4::ZERO;
            if rest == 0.0 || flap.root == 0.0 {
                continue;
            }
            let mut corners = [Vec3::ZERO; 4];
            for (corner, vertex) in corners.iter_mut().zip(flap.at) {
                *corner = spots.spot(vertex as usize).0;
            }
            let bow = normal(corners) * (-rest * (1.0 - self.step.before) * flap.root);
            *curve = bow.extend(0.0);
        }
        pull_back(&room.flaps, &room.rows, &room.curve, &mut room.force);
    }

    /// Conjugate gradients for what the force changes.
    fn solve(&self, room: &mut Scratch) {
        let Scratch { flaps, own, w, mass, over, change, force, way, pull, .. } = room;
        let (rows, curve) = (coupled(&room.rows, room.coupling), &mut room.curve[..]);
        let steps = (2.0 * (1.0 + 64.0 * self.over_mass).sqrt()).min(MOST_STEPS) as u32;
        for (((over, w), mass), own) in over.iter_mut().zip(&*w).zip(&*mass).zip(&*own) {
            *over = if *w > 0.0 { 1.0 / (mass + own) } else { 0.0 };
        }
        change.fill(Vec4::ZERO);
        way.fill(Vec4::ZERO);
        lead(way, force, over, 0.0);
        let mut left = dot(way, force);
        let enough = left * LEFT;
        for _ in 0..steps {
            if left <= enough || left <= TINY * TINY {
                return;
            }
            bring_back(flaps, rows, curve, mass, way, pull);
            let far = left / -dot(way, pull);
            let next = go_on(far, [change, force], [way, pull], over);
            lead(way, force, over, next / left);
            left = next;
        }
    }
}

/// A few explicit steps for what the force changes.
fn descend(room: &mut Scratch, descent: &Descent) {
    let Scratch { flaps, rows, coupling, curve, w, mass, change, force, way, .. } = room;
    let rows = coupled(rows, *coupling);
    change.fill(Vec4::ZERO);
    for (at, [keep, take]) in descent.steps().iter().enumerate() {
        if at > 0 {
            add_pulls(flaps, rows, curve, way, force);
        }
        let of_particles = force.iter_mut().zip(&*w).zip(&*mass);
        for ((change, way), ((force, w), mass)) in
            change.iter_mut().zip(&mut *way).zip(of_particles)
        {
            let last = if at == 0 { Vec4::ZERO } else { *way * *keep };
            *way = last + *force * (w * take);
            *change += *way;
            *force -= *way * *mass;
        }
    }
}

/// What pulls particles back once they have gone their way.
fn bring_back(
    flaps: &[Flap],
    rows: Option<&[Row]>,
    curve: &mut [Vec4],
    mass: &[f32],
    way: &[Vec4],
    pull: &mut [Vec4],
) {
    for ((pull, way), mass) in pull.iter_mut().zip(way).zip(mass) {
        *pull = -*way * *mass;
    }
    add_pulls(flaps, rows, curve, way, pull);
}

/// The rows, if they couple anything.
fn coupled(rows: &[Row], coupling: f32) -> Option<&[Row]> {
    (coupling > 0.0).then_some(rows)
}

/// Adds what flaps pull particles by that are at these places.
fn add_pulls(
    flaps: &[Flap],
    rows: Option<&[Row]>,
    curve: &mut [Vec4],
    x: &[Vec4],
    force: &mut [Vec4],
) {
    let Some(rows) = rows else {
        flaps.iter().for_each(|flap| spread(flap, curve_of(flap, x), force));
        return;
    };
    for (curve, flap) in curve.iter_mut().zip(flaps) {
        *curve = curve_of(flap, x);
    }
    pull_back(flaps, rows, curve, force);
}

#[inline(always)]
fn curve_of(flap: &Flap, x: &[Vec4]) -> Vec4 {
    let from = x[flap.at[0] as usize];
    let mut curve = Vec4::ZERO;
    for (vertex, c) in flap.at[1..].iter().zip(flap.weight) {
        curve += (x[*vertex as usize] - from) * c;
    }
    curve
}

/// Adds what flaps of these curvatures pull particles by.
fn pull_back(flaps: &[Flap], rows: &[Row], curve: &[Vec4], force: &mut [Vec4]) {
    for (own, (flap, row)) in curve.iter().zip(flaps.iter().zip(rows)) {
        let mut pull = *own;
        for (with, by) in row.with.iter().zip(row.by) {
            pull += curve[*with as usize] * by;
        }
        spread(flap, pull, force);
    }
}

/// Spreads the pull of a curvature over the particles of a flap: on all together it is naught.
#[inline(always)]
fn spread(flap: &Flap, curve: Vec4, force: &mut [Vec4]) {
    let mut sum = Vec4::ZERO;
    for (vertex, c) in flap.at[1..].iter().zip(flap.weight) {
        let pull = curve * c;
        force[*vertex as usize] -= pull;
        sum += pull;
    }
    force[flap.at[0] as usize] += sum;
}

/// The next way: where the force leads, and on by so much of the last way.
fn lead(way: &mut [Vec4], force: &[Vec4], over: &[f32], keep: f32) {
    for ((way, force), over) in way.iter_mut().zip(force).zip(over) {
        *way = *force * *over + *way * keep;
    }
}

/// The product of vectors: eight sums side by side, which are the same on every machine.
fn dot(a: &[Vec4], b: &[Vec4]) -> f32 {
    let mut sums = [Vec4::ZERO; 2];
    for (a, b) in a.chunks(2).zip(b.chunks(2)) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += *a * *b;
        }
    }
    sum(sums)
}

/// Goes on by so much of the way, which takes so much of the force; the product of what is left of it with
/// itself, weighed.
fn go_on(
    far: f32,
    [change, force]: [&mut [Vec4]; 2],
    [way, pull]: [&[Vec4]; 2],
    over: &[f32],
) -> f32 {
    let mut sums = [Vec4::ZERO; 2];
    for (at, (change, force)) in change.iter_mut().zip(force).enumerate() {
        *change += way[at] * far;
        *force += pull[at] * far;
        sums[at % 2] += *force * *force * over[at];
    }
    sum(sums)
}

fn sum([even, odd]: [Vec4; 2]) -> f32 {
    let [x, y, z, _] = (even + odd).to_array();
    (x + y) + z
}
