//! Layers push each other apart and rub on each other.

use super::contacts::{Contact, Weight, along, places};
use super::loads::{Finder, Loads};
use super::spots::{Spot, place, shift};
use crate::math::columns::Columns;
use crate::math::{max, min};
use glam::Vec3;

/// How often contacts are gone over in a substep, to and fro in turn.
const SWEEPS: usize = 6;

/// How much of its inverse mass counts of what touches a collider, which bears what lies on it.
pub(super) const BORNE: f32 = 0.02;

/// Sides that did not push before and come faster than what falls so long hit each other, and begin a new history
/// [substeps].
const HIT: f32 = 2.0;

/// What is farther apart than this, in gaps, as a substep begins and before pushes, does not push: of vertices and
/// triangles, and of edges, which have little to do where surfaces lie on each other.
pub(super) const NEAR: [f32; 2] = [1.1, 1.02];

/// The share of what sides are too near that they come apart by in a substep, which is no motion; at most
/// so fast [m/s].
const PART: f32 = 0.05;
const RISE: f32 = 0.25;

/// How long it takes about until sides that push each other move as one [s].
const REST: f32 = 0.01;

/// Moves the particles of a contact along `by`, by how they count.
#[inline(always)]
fn press(x: &mut [Spot], contact: &Contact, by: Vec3) {
    for (id, weight) in contact.ids.iter().zip(contact.weights) {
        shift(&mut x[*id as usize], by * weight);
    }
}

/// Ends approach, and rubs, from what bore on what in the substep before; `active` gets the contacts that may push.
/// `force` is what a push of a kilogram by a metre takes in a substep [1/s²].
pub(super) fn solve(
    contacts: &mut [Contact],
    active: &mut Vec<u32>,
    (loads, finder): (&mut Loads, &mut Finder),
    weights: &[Weight],
    start: &[Spot],
    x: &mut [Spot],
    friction: f32,
    force: f32,
) {
    active.clear();
    for (at, contact) in contacts.iter_mut().enumerate() {
        contact.push = 0.0;
        let near = contact.gap * NEAR[contact.first as usize - 1];
        let before = along(places(start, contact.ids), contact);
        if min(before, along(places(x, contact.ids), contact)) < near {
            contact.aim = min(before, contact.gap);
            contact.weigh(weights);
            active.push(at as u32);
        }
    }
    finder.sort(loads);
    for at in &*active {
        let contact = &mut contacts[*at as usize];
        if let Some(load) = finder.find(contact, loads) {
            let rub = load.rub - contact.n * load.rub.dot(contact.n);
            (contact.push, contact.rub) = (load.push / force, rub * (1.0 / force));
            contact.is_new = false;
            press(x, contact, contact.n * contact.push + contact.rub);
        }
    }
    for sweep in 0..SWEEPS {
        if sweep % 2 == 0 {
            active.iter().for_each(|at| part(&mut contacts[*at as usize], x));
        } else {
            active.iter().rev().for_each(|at| part(&mut contacts[*at as usize], x));
        }
    }
    active.iter().for_each(|at| rub(&mut contacts[*at as usize], start, x, friction));
    loads.keep(contacts, active, force);
}

#[inline(always)]
fn part(contact: &mut Contact, x: &mut [Spot]) {
    let missing = contact.aim - along(places(x, contact.ids), contact);
    let push = max(contact.push + missing * contact.give, 0.0);
    let by = push - contact.push;
    if by != 0.0 {
        contact.push = push;
        press(x, contact, contact.n * by);
    }
}

/// What slid along the other side slides less, by what friction can hold.
#[inline(always)]
fn rub(contact: &mut Contact, start: &[Spot], x: &mut [Spot], friction: f32) {
    if contact.push <= 0.0 && contact.rub == Vec3::ZERO {
        return;
    }
    let wanted = contact.rub - slid(contact, start, x) * contact.give;
    let (length, most) = (wanted.length(), friction * contact.push);
    contact.sticks = length <= most;
    let rub = if contact.sticks { wanted } else { wanted * (most / length) };
    let by = rub - contact.rub;
    contact.rub = rub;
    press(x, contact, by);
}

/// How the closest points moved against each other along the surface.
#[inline(always)]
fn slid(contact: &Contact, start: &[Spot], x: &[Spot]) -> Vec3 {
    let mut way = Vec3::ZERO;
    for (id, share) in contact.ids.iter().zip(contact.share) {
        way += (place(&x[*id as usize]) - place(&start[*id as usize])) * share;
    }
    way - contact.n * way.dot(contact.n)
}

/// What is too near comes apart, without getting velocity from it.
pub(super) fn spread(
    contacts: &[Contact],
    active: &[u32],
    x: &mut [Spot],
    predicted: &mut Columns,
    h: f32,
) {
    for contact in active.iter().map(|at| &contacts[*at as usize]) {
        let missing = contact.gap - along(places(x, contact.ids), contact);
        if missing <= 0.0 {
            continue;
        }
        let by = min(missing * PART, RISE * h) * contact.give;
        for (id, weight) in contact.ids.iter().zip(contact.weights) {
            let by = contact.n * (by * weight);
            shift(&mut x[*id as usize], by);
            predicted.add(*id as usize, by);
        }
    }
}

/// Finds the contacts whose sides hit each other, with the velocities that they have; what falls for a substep
/// gets a `speed`.
pub(super) fn find_hits(
    contacts: &[Contact],
    active: &[u32],
    v: &Columns,
    speed: f32,
    hits: &mut Vec<u32>,
) {
    let fast = (HIT * speed) * (HIT * speed);
    let is_hit = |at: &&u32| {
        let contact = &contacts[**at as usize];
        contact.push > 0.0 && contact.is_new && against(contact, v).length_squared() > fast
    };
    hits.clear();
    hits.extend(active.iter().filter(is_hit));
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
pub(super) fn calm(contacts: &[Contact], hits: &[u32], motion: &mut Columns) {
    for contact in hits.iter().map(|at| &contacts[*at as usize]) {
        let v = against(contact, motion);
        let v = if contact.sticks { v } else { contact.n * v.dot(contact.n) };
        let by = v * -contact.give;
        for (id, weight) in contact.ids.iter().zip(contact.weights) {
            motion.add(*id as usize, by * weight);
        }
    }
}

/// Sides that push each other come to rest against each other, as cloth does that is full of air and of fibres that
/// rub: they come no nearer nor part, and where they stick move as one. With `turns` they do not turn by themselves
/// either, which gives their spin to what holds or bears the cloth. `v` is how particles move against the whole cloth,
/// in some unit, `h` the length of the substep [s].
pub(super) fn soothe(
    contacts: &[Contact],
    active: &[u32],
    weights: &[Weight],
    v: &mut [Spot],
    h: f32,
    turns: bool,
) {
    let share = h / (h + REST);
    for contact in active.iter().map(|at| &contacts[*at as usize]) {
        if contact.push <= 0.0 {
            continue;
        }
        if turns {
            let (one, other) = contact.ids.split_at(contact.first as usize);
            [one, other].into_iter().for_each(|side| join(side, weights, v, share));
        }
        let way = way_against(contact, v);
        let way = if contact.sticks { way } else { contact.n * way.dot(contact.n) };
        press(v, contact, way * (-contact.give * share));
    }
}

/// How some particles move comes nearer to how their middle does.
#[inline(always)]
fn join(side: &[u32], weights: &[Weight], v: &mut [Spot], share: f32) {
    let (mut sum, mut mass) = (Vec3::ZERO, 0.0);
    for id in side {
        let w = weights[*id as usize].w;
        if w <= 0.0 {
            return;
        }
        sum += place(&v[*id as usize]) * (1.0 / w);
        mass += 1.0 / w;
    }
    let mean = sum * (1.0 / mass);
    for id in side {
        let spot = &mut v[*id as usize];
        shift(spot, (mean - place(spot)) * share);
    }
}

/// How the closest points move against each other.
#[inline(always)]
fn way_against(contact: &Contact, v: &[Spot]) -> Vec3 {
    let mut way = Vec3::ZERO;
    for (id, share) in contact.ids.iter().zip(contact.share) {
        way += place(&v[*id as usize]) * share;
    }
    way
}
