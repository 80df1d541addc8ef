//! The hinges of any mesh: one implicit step of bending for all at once.
//!
//! With K the matrix of the bending energy, a substep of length h is to end at M d = −h² K (x + d), where d
//! is what bending moves the particles by. K is symmetric and, as the hinges are quadratic, the same wherever
//! the mesh is. So d comes of a few explicit steps where the mesh is soft, see `descent`, and else by
//! conjugate gradients (Hestenes and Stiefel 1952), with the diagonal as their preconditioner. Each step is
//! one pass over K (see `stiffness`), and as many of them as the root of the stiffness over mass are enough,
//! where sweeps over hinges would take as many as itself.

use crate::math::TINY;
use crate::model::bend_elements::{PAIRS, TriangleStiffness};
use crate::model::hardening::Softening;
use crate::model::hinge::{Hinge, hinge_normal};
use crate::model::hinges::Hinges;
use crate::solver::bend::chebyshev::ChebyshevSteps;
use crate::solver::bend::hinge::HingeStep;
use crate::solver::bend::stiffness_matrix::StiffnessMatrix;
use crate::solver::particle_stage::access::ParticleAccess;
use glam::{Vec3, Vec4};

/// The most steps of conjugate gradients that a round makes.
const MOST_STEPS: f32 = 48.0;

/// From this stiffness over mass on a second round pays.
const TWICE: f32 = 0.25;

/// A descent is made for so many times the most stiffness over mass that there is: what it leaves of the stiffest
/// shapes, it leaves in each substep, and at the very end of what it is made for discs of cotton did not rest.
const ROOM: f32 = 2.0;

/// Steps end when what is left has so much of the square of what there was.
const LEFT: f32 = 1.0e-8;

/// Room to work in: a number or a vector for each particle.
#[derive(Clone, Debug, Default)]
pub(crate) struct MeshBendScratch {
    /// As long as links and what is held stay: what triangles resist, and that as a matrix.
    elements: Vec<TriangleStiffness>,
    stiffness: StiffnessMatrix,
    revision: u32,
    /// Of what made triangles softer.
    softer: Option<(u32, f32)>,
    /// The steps that are enough as long as masses and `of_stiffness` stay too; none if there are too many.
    descent: Option<ChebyshevSteps>,
    of_stiffness: f32,
    /// What each hinge is bent by at rest, where some are [m].
    bow: Vec<Vec4>,
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

impl MeshBendScratch {
    /// Room for so many triangles, hinges and particles.
    pub fn new(triangles: usize, hinges: usize, capacity: usize) -> Self {
        let numbers = || Vec::with_capacity(capacity);
        let vectors = || Vec::with_capacity(capacity);
        Self {
            elements: Vec::with_capacity(triangles),
            stiffness: StiffnessMatrix::with_capacity(capacity),
            revision: 0,
            softer: None,
            descent: None,
            of_stiffness: 0.0,
            bow: Vec::with_capacity(hinges),
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
}

/// The hinges as they are now.
#[derive(Clone, Copy)]
pub(crate) struct MeshBend<'a> {
    pub hinges: &'a Hinges,
    /// Which links hold.
    pub active: &'a [bool],
    /// What folds add to how each is bent at rest [m]; none if there are none.
    pub folds: Option<&'a [f32]>,
    /// How much softer triangles are by what gave way, if they are.
    pub softening: Option<Softening<'a>>,
    pub step: HingeStep,
    /// StiffnessMatrix over mass of hinges as far apart as edges are long.
    pub stiffness_over_mass: f32,
    /// Whether it is the first round of the substep.
    pub is_first: bool,
}

impl MeshBend<'_> {
    /// Bends `count` particles for one round; the second one only where it pays. `start` is where the
    /// substep began.
    pub fn solve<S: ParticleAccess>(
        &self,
        room: &mut MeshBendScratch,
        count: usize,
        start: impl Fn(usize) -> Vec3,
        spots: &mut S,
    ) {
        if !self.is_first && (self.stiffness_over_mass < TWICE || room.descent.is_some()) {
            return;
        }
        let is_new = self.make_room(room, count);
        if self.seat(room, start, spots) || is_new {
            self.take_up(room, count);
        }
        room.stiffness.add_pulls(&room.x, &mut room.force);
        self.add_rest(room, spots);
        match room.descent {
            Some(descent) => descend(room, &descent),
            None => self.solve_conjugate_gradients(room),
        }
        for (i, (given, change)) in room.given.iter_mut().zip(&room.change).enumerate() {
            let (x, w) = spots.particle(i);
            if w > 0.0 {
                spots.set_position(i, x + change.truncate());
                *given += *change;
            }
        }
    }

    /// Room for so many particles; whether they, links or stiffness have changed.
    fn make_room(&self, room: &mut MeshBendScratch, count: usize) -> bool {
        let (revision, stiffness) = (self.hinges.revision, self.step.stiffness);
        let softer = self.softening.map(|softening| softening.key());
        let known = (room.revision, room.of_stiffness, room.softer);
        if known == (revision, stiffness, softer) && room.w.len() == count {
            return false;
        }
        for numbers in [&mut room.w, &mut room.mass, &mut room.over] {
            numbers.resize(count, 0.0);
        }
        let vectors = [&mut room.x, &mut room.given, &mut room.force];
        let more = [&mut room.change, &mut room.way, &mut room.pull];
        vectors.into_iter().chain(more).for_each(|vectors| vectors.resize(count, Vec4::ZERO));
        room.bow.resize(self.hinges.all.len(), Vec4::ZERO);
        (room.revision, room.of_stiffness, room.softer) = (revision, stiffness, softer);
        true
    }

    /// Takes up links, stiffness and what is held.
    fn take_up(&self, room: &mut MeshBendScratch, count: usize) {
        let MeshBendScratch { elements, stiffness, w, mass, over, .. } = room;
        let all = &self.hinges.all;
        let holds = |hinge: usize| self.active[self.hinges.links[hinge] as usize];
        let left = |triangle: usize| match &self.softening {
            Some(softening) => softening.stiffness_scale(softening.curvature[triangle]),
            None => 1.0,
        };
        let is_held = |vertex: u32| w[vertex as usize] == 0.0;
        self.hinges.elements.compute_stiffness(all, holds, is_held, left, elements);
        stiffness.assemble(all, elements, self.step.stiffness, count);
        let each = over.iter_mut().zip(&*w).zip(&*mass).zip(stiffness.own());
        for (((over, w), mass), own) in each {
            *over = if *w > 0.0 { 1.0 / (mass + own) } else { 0.0 };
        }
        room.descent = ChebyshevSteps::new(ROOM * stiffness.bound(w));
    }

    /// Sees where particles are; whether they weigh something else than they did.
    fn seat<S: ParticleAccess>(
        &self,
        room: &mut MeshBendScratch,
        start: impl Fn(usize) -> Vec3,
        spots: &S,
    ) -> bool {
        let before = self.step.start_share;
        let mut has_changed = false;
        let known = room.w.iter_mut().zip(&mut room.mass);
        for (i, (seat, (known, mass))) in room.x.iter_mut().zip(known).enumerate() {
            let (x, w) = spots.particle(i);
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
    fn add_rest<S: ParticleAccess>(&self, room: &mut MeshBendScratch, spots: &S) {
        if !self.hinges.are_bent && self.folds.is_none() {
            return;
        }
        let hinges = &self.hinges.all;
        for (at, (hinge, bow)) in hinges.iter().zip(&mut room.bow).enumerate() {
            let rest = hinge.rest + self.folds.map_or(0.0, |folds| folds[at]);
            *bow = if rest == 0.0 {
                Vec4::ZERO
            } else {
                let corners = hinge.particles.map(|vertex| spots.particle(vertex as usize).0);
                let rest = rest * (1.0 - self.step.start_share) * self.step.stiffness;
                (hinge_normal(corners) * rest).extend(0.0)
            };
        }
        for element in &room.elements {
            push(hinges, element, &room.bow, &mut room.force);
        }
    }

    /// Conjugate gradients for what the force changes.
    fn solve_conjugate_gradients(&self, room: &mut MeshBendScratch) {
        let MeshBendScratch { stiffness, mass, over, change, force, way, pull, .. } = room;
        let steps = (2.0 * (1.0 + 64.0 * self.stiffness_over_mass).sqrt()).min(MOST_STEPS) as u32;
        change.fill(Vec4::ZERO);
        way.fill(Vec4::ZERO);
        lead(way, force, over, 0.0);
        let mut left = dot(way, force);
        let enough = left * LEFT;
        for _ in 0..steps {
            if left <= enough || left <= TINY * TINY {
                return;
            }
            for ((pull, way), mass) in pull.iter_mut().zip(&*way).zip(&*mass) {
                *pull = -*way * *mass;
            }
            stiffness.add_pulls(way, pull);
            let far = left / -dot(way, pull);
            let next = go_on(far, [change, force], [way, pull], over);
            lead(way, force, over, next / left);
            left = next;
        }
    }
}

/// A few explicit steps for what the force changes.
fn descend(room: &mut MeshBendScratch, descent: &ChebyshevSteps) {
    let MeshBendScratch { stiffness, w, mass, change, force, way, .. } = room;
    change.fill(Vec4::ZERO);
    for (at, [keep, take]) in descent.steps().iter().enumerate() {
        if at > 0 {
            stiffness.add_pulls(way, force);
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

/// Pushes the particles of a triangle's hinges that are bent so much at rest: all together by naught.
fn push(hinges: &[Hinge], element: &TriangleStiffness, bow: &[Vec4], force: &mut [Vec4]) {
    let own = [0, 1, 2].map(|slot| {
        if element.own[slot] > 0.0 { bow[element.hinges[slot] as usize] } else { Vec4::ZERO }
    });
    if own == [Vec4::ZERO; 3] {
        return;
    }
    let mut push = own;
    for (push, by) in push.iter_mut().zip(element.own) {
        *push *= by;
    }
    for ([p, q], by) in PAIRS.into_iter().zip(element.between) {
        push[p] += own[q] * by;
        push[q] += own[p] * by;
    }
    for (slot, push) in push.into_iter().enumerate() {
        if element.own[slot] > 0.0 {
            let Hinge { particles: at, weight: [_, q, a, b], .. } =
                hinges[element.hinges[slot] as usize];
            let mut sum = Vec4::ZERO;
            for (vertex, weight) in at[1..].iter().zip([q, a, b]) {
                let push = push * weight;
                force[*vertex as usize] += push;
                sum += push;
            }
            force[at[0] as usize] -= sum;
        }
    }
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
