//! Layers push each other apart and rub on each other.

use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};
use crate::math::wide4::Float4;
use crate::math::wide4::Four;
use crate::math::{max, min};
use crate::solver::particle_stage::interleaved::push;
use crate::solver::self_collide::surface::contact::{Contact, along};
use crate::solver::self_collide::surface::warm_start::{Finder, WarmStart};
use glam::Vec3;

/// How often contacts are gone over in a substep, to and fro in turn.
const SWEEPS: usize = 6;

/// How much of its inverse mass counts of what touches a collider, which bears what lies on it.
pub(crate) const BORNE: f32 = 0.02;

/// Sides that did not push before and come faster than what falls so long hit each other, and begin a new history
/// [substeps].
const HIT: f32 = 2.0;

/// What is farther apart than this, in gaps, as a substep begins and before pushes, does not push: of vertices and
/// triangles, and of edges, which have little to do where surfaces lie on each other.
pub(crate) const NEAR: [f32; 2] = [1.1, 1.02];

/// The share of what sides are too near that they come apart by in a substep, which is no motion; at most
/// so fast [m/s].
const PART: f32 = 0.05;
const RISE: f32 = 0.25;

/// How long it takes about until sides that push each other move as one [s].
const REST: f32 = 0.01;

/// Where only such particles give way that count for next to nothing beside what is held, they are taken to make
/// this share of an inverse mass, so that none is flung away.
const SLIGHT: f32 = 0.005;

/// The inverse mass of a particle [1/kg], and how much of it counts against the other side of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weight {
    pub w: f32,
    pub yields: f32,
}

/// How a contact pushes in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push {
    pub contact: u32,
    /// How far its sides are at least in the end, by their own motion [m].
    aim: f32,
    /// How far a push of 1 takes each particle, against the direction on the second side [1/kg].
    weights: [f32; 4],
    /// 1 over what all of that makes; 0 if nothing gives way.
    give: f32,
    /// How sides were pushed apart, per inverse mass, and along the surface.
    pub push: f32,
    pub rub: Vec3,
    /// Whether they did not push each other in the substep before.
    is_new: bool,
    /// Whether they stick to each other.
    sticks: bool,
}

impl Push {
    /// Finds out how a contact gives way, which changes with what touches a collider.
    #[inline(always)]
    fn new(at: u32, contact: &Contact, aim: f32, weights: &[Weight]) -> Self {
        let all = contact.ids.map(|id| weights[id as usize]);
        let mut sides = [0.0; 2];
        for (k, (share, weight)) in contact.share.iter().zip(all).enumerate() {
            sides[usize::from(k >= contact.first as usize)] += share.abs() * weight.yields;
        }
        let most = max(sides[0], sides[1]);
        let (mut sum, mut heaviest, mut weights) = (0.0, 0.0, [0.0; 4]);
        for k in 0..4 {
            let (side, share) = (sides[usize::from(k >= contact.first as usize)], contact.share[k]);
            let w = all[k].w * (side / most);
            weights[k] = share * w;
            sum += w * share * share;
            heaviest = max(heaviest, w);
        }
        let give = if sum > 0.0 { 1.0 / max(sum, heaviest * SLIGHT) } else { 0.0 };
        let (push, rub) = (0.0, Vec3::ZERO);
        Self { contact: at, aim, weights, give, push, rub, is_new: true, sticks: false }
    }

    /// Moves the particles of its contact along `by`, by how they count.
    #[inline(always)]
    fn press(&self, contact: &Contact, x: &mut [Float4], by: Four) {
        for (id, weight) in contact.ids.into_iter().zip(self.weights) {
            push(&mut x[id as usize], by.times(weight));
        }
    }
}

/// Lists what may push.
pub(crate) fn list(
    contacts: &[Contact],
    active: &mut Vec<Push>,
    weights: &[Weight],
    start: &[Float4],
    x: &[Float4],
) {
    active.clear();
    for (at, contact) in contacts.iter().enumerate() {
        let near = contact.gap * NEAR[contact.first as usize - 1];
        let before = along(start, contact);
        if min(before, along(x, contact)) < near {
            active.push(Push::new(at as u32, contact, min(before, contact.gap), weights));
        }
    }
}

/// Ends approach, and rubs, from what bore on what in the substep before. `force` is what a push of a kilogram by a
/// metre takes in a substep [1/s²].
pub(crate) fn solve(
    level: Level,
    contacts: &[Contact],
    active: &mut [Push],
    (loads, finder): (&mut WarmStart, &mut Finder),
    start: &[Float4],
    x: &mut [Float4],
    friction: f32,
    force: f32,
) {
    finder.sort(loads);
    for push in &mut *active {
        let contact = &contacts[push.contact as usize];
        if let Some(load) = finder.find(contact, loads) {
            let rub = load.rub - contact.n * load.rub.dot(contact.n);
            (push.push, push.rub) = (load.push / force, rub * (1.0 / force));
            push.is_new = false;
            push.press(contact, x, Four::way(contact.n * push.push + push.rub));
        }
    }
    part_all(level, contacts, active, x);
    for push in &mut *active {
        rub(&contacts[push.contact as usize], push, start, x, friction);
    }
    loads.keep(contacts, active, force);
}

leveled! {
    /// Ends approach.
    fn part_all(contacts: &[Contact], active: &mut [Push], x: &mut [Float4]) = part_each
}

#[inline(always)]
fn part_each(contacts: &[Contact], active: &mut [Push], x: &mut [Float4]) {
    for _ in 0..SWEEPS / 2 {
        for push in &mut *active {
            part(&contacts[push.contact as usize], push, x);
        }
        for push in active.iter_mut().rev() {
            part(&contacts[push.contact as usize], push, x);
        }
    }
}

#[inline(always)]
fn part(contact: &Contact, push: &mut Push, x: &mut [Float4]) {
    let missing = push.aim - along(x, contact);
    let new = max(push.push + missing * push.give, 0.0);
    let by = new - push.push;
    if by != 0.0 {
        push.push = new;
        push.press(contact, x, Four::way(contact.n).times(by));
    }
}

/// What slid along the other side slides less, by what friction can hold.
#[inline(always)]
fn rub(contact: &Contact, push: &mut Push, start: &[Float4], x: &mut [Float4], friction: f32) {
    if push.push <= 0.0 && push.rub == Vec3::ZERO {
        return;
    }
    let wanted = push.rub - slid(contact, start, x) * push.give;
    let (length, most) = (wanted.length(), friction * push.push);
    push.sticks = length <= most;
    let rub = if push.sticks { wanted } else { wanted * (most / length) };
    let by = rub - push.rub;
    push.rub = rub;
    push.press(contact, x, Four::way(by));
}

/// How the closest points moved against each other along the surface.
#[inline(always)]
fn slid(contact: &Contact, start: &[Float4], x: &[Float4]) -> Vec3 {
    let mut way = Four::all(0.0);
    for (id, share) in contact.ids.iter().zip(contact.share) {
        let [x, start] = [x, start].map(|all| Four::of(&all[*id as usize]));
        way = way + (x - start).times(share);
    }
    let way = way.vector();
    way - contact.n * way.dot(contact.n)
}

/// What is too near comes apart, without getting velocity from it.
pub(crate) fn spread(
    contacts: &[Contact],
    active: &[Push],
    x: &mut [Float4],
    predicted: &mut Columns,
    h: f32,
) {
    for Push { contact, weights, give, .. } in active {
        let contact = &contacts[*contact as usize];
        let missing = contact.gap - along(x, contact);
        if missing <= 0.0 {
            continue;
        }
        let by = min(missing * PART, RISE * h) * give;
        for (id, weight) in contact.ids.iter().zip(weights) {
            let by = contact.n * (by * weight);
            push(&mut x[*id as usize], Four::way(by));
            predicted.add(*id as usize, by);
        }
    }
}

/// Finds the contacts whose sides hit each other, with the velocities that they have; what falls for a substep
/// gets a `speed`.
pub(crate) fn find_hits(
    contacts: &[Contact],
    active: &[Push],
    v: &Columns,
    speed: f32,
    hits: &mut Vec<u32>,
) {
    let fast = (HIT * speed) * (HIT * speed);
    let is_hit = |push: &Push| {
        let speed = || against(&contacts[push.contact as usize], v);
        push.push > 0.0 && push.is_new && speed().length_squared() > fast
    };
    hits.clear();
    hits.extend((0..).zip(active).filter(|(_, push)| is_hit(push)).map(|(at, _)| at));
}

/// How sides move against each other.
#[inline(always)]
fn against(contact: &Contact, motion: &Columns) -> Vec3 {
    let mut v = Vec3::ZERO;
    for (id, share) in contact.ids.iter().zip(contact.share) {
        v += motion.at(*id as usize) * share;
    }
    v
}

/// Sides that hit each other have no velocity against each other but along the surface, and none at all where they
/// stick.
pub(crate) fn calm(contacts: &[Contact], active: &[Push], hits: &[u32], motion: &mut Columns) {
    for push in hits.iter().map(|at| &active[*at as usize]) {
        let contact = &contacts[push.contact as usize];
        let v = against(contact, motion);
        let v = if push.sticks { v } else { contact.n * v.dot(contact.n) };
        let by = v * -push.give;
        for (id, weight) in contact.ids.iter().zip(push.weights) {
            motion.add(*id as usize, by * weight);
        }
    }
}

/// Sides that push each other come to rest against each other, as cloth does that is full of air and of fibres that
/// rub: they come no nearer nor part, and where they stick move as one. With `turns` they do not turn by themselves
/// either, which gives their spin to what holds or bears the cloth. `v` is how particles move against the whole cloth,
/// in some unit, `h` the length of the substep [s].
pub(crate) fn soothe(
    contacts: &[Contact],
    active: &[Push],
    weights: &[Weight],
    v: &mut [Float4],
    h: f32,
    turns: bool,
) {
    let share = h / (h + REST);
    for push in active {
        if push.push <= 0.0 {
            continue;
        }
        let contact = &contacts[push.contact as usize];
        if turns {
            let (one, other) = contact.ids.split_at(contact.first as usize);
            [one, other].into_iter().for_each(|side| join(side, weights, v, share));
        }
        let way = way_against(contact, v);
        let n = Four::way(contact.n);
        let way = if push.sticks { way } else { n.times(way.dot(n)) };
        push.press(contact, v, way.times(-push.give * share));
    }
}

/// How some particles move comes nearer to how their middle does.
#[inline(always)]
fn join(side: &[u32], weights: &[Weight], v: &mut [Float4], share: f32) {
    let (mut sum, mut mass) = (Four::all(0.0), 0.0);
    for id in side {
        let w = weights[*id as usize].w;
        if w <= 0.0 {
            return;
        }
        sum = sum + Four::of(&v[*id as usize]).times(1.0 / w);
        mass += 1.0 / w;
    }
    let mean = sum.times(1.0 / mass);
    for id in side {
        let spot = &mut v[*id as usize];
        push(spot, (mean - Four::of(spot)).times(share));
    }
}

/// How the closest points move against each other.
#[inline(always)]
fn way_against(contact: &Contact, v: &[Float4]) -> Four {
    let mut way = Four::all(0.0);
    for (id, share) in contact.ids.iter().zip(contact.share) {
        way = way + Four::of(&v[*id as usize]).times(share);
    }
    way
}
