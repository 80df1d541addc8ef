//! Layers push each other apart and rub on each other.

use super::contacts::{Contact, along, places};
use super::spots::{Spot, place, shift};
use crate::math::columns::Columns;
use crate::math::{max, min};
use glam::Vec3;

/// How often contacts are gone over in a substep, to and fro in turn.
const SWEEPS: usize = 6;

/// How much of its inverse mass counts of what touches a collider, of what lies on that, and so on.
const LEVELS: [f32; 4] = [0.02, 0.06, 0.18, 0.5];

/// The level of what nothing bears.
pub(super) const FREE: u8 = u8::MAX;

/// What is farther apart than this, in gaps, does not push: of vertices and triangles, and of edges, which have
/// little to do where surfaces lie on each other.
const NEAR: [f32; 2] = [1.25, 1.02];

/// The share of what sides are too near that they come apart by in a substep, which is no motion; at most
/// so fast [m/s].
const PART: f32 = 0.3;
const RISE: f32 = 0.25;

/// Moves the particles of a contact along `by`, by how they count.
#[inline(always)]
fn press(x: &mut [Spot], contact: &Contact, by: Vec3) {
    for (id, share) in contact.ids.iter().zip(contact.share) {
        let spot = &mut x[*id as usize];
        let weight = spot[3] * share;
        shift(spot, by * weight);
    }
}

/// Ends approach, and rubs; `active` gets the contacts that may push.
pub(super) fn solve(
    contacts: &mut [Contact],
    active: &mut Vec<u32>,
    order: &mut Vec<u32>,
    levels: &mut [u8],
    start: &[Spot],
    x: &mut [Spot],
    friction: f32,
) {
    active.clear();
    for (at, contact) in contacts.iter_mut().enumerate() {
        contact.push = 0.0;
        contact.sticks = false;
        let near = contact.gap * NEAR[contact.first as usize - 1];
        if along(places(x, contact.ids), contact) < near {
            contact.aim = min(along(places(start, contact.ids), contact), contact.gap);
            active.push(at as u32);
        }
    }
    bear(contacts, active, order, x, levels);
    for sweep in 0..SWEEPS {
        if sweep % 2 == 0 {
            active.iter().for_each(|at| part(&mut contacts[*at as usize], x));
        } else {
            active.iter().rev().for_each(|at| part(&mut contacts[*at as usize], x));
        }
    }
    active.iter().for_each(|at| rub(&mut contacts[*at as usize], start, x, friction));
}

/// What lies on something that bears it gives way less than what lies on top of that, so that layers find their
/// places from below up; `levels` says how many contacts each is from what bears it all.
fn bear(
    contacts: &mut [Contact],
    active: &mut [u32],
    order: &mut Vec<u32>,
    x: &mut [Spot],
    levels: &mut [u8],
) {
    for pass in 0..LEVELS.len() {
        let mut raise = |at: &u32| {
            let ids = contacts[*at as usize].ids;
            let least = ids.iter().map(|id| levels[*id as usize]).min().unwrap_or(FREE);
            let next = least.saturating_add(1);
            ids.iter().for_each(|id| levels[*id as usize] = levels[*id as usize].min(next));
        };
        if pass % 2 == 0 {
            active.iter().for_each(&mut raise);
        } else {
            active.iter().rev().for_each(&mut raise);
        }
    }
    for (spot, level) in x.iter_mut().zip(&*levels) {
        if let Some(scale) = LEVELS.get(*level as usize) {
            spot[3] *= scale;
        }
    }
    order.clear();
    let most = LEVELS.len() as u8;
    for level in 0..=most {
        let is_of = |at: &u32| {
            let ids = contacts[*at as usize].ids;
            let least = ids.iter().fold(most, |least, id| levels[*id as usize].min(least));
            least == level
        };
        order.extend(active.iter().copied().filter(is_of));
    }
    active.copy_from_slice(order);
    active.iter().for_each(|at| contacts[*at as usize].weigh(x));
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
    if contact.push <= 0.0 {
        return;
    }
    let slid = slid(contact, start, x);
    let (length, most) = (slid.length(), friction * contact.push);
    let needed = length * contact.give;
    if needed <= most {
        contact.sticks = true;
        press(x, contact, slid * -contact.give);
    } else {
        press(x, contact, slid * (-most / length));
    }
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
        for (id, share) in contact.ids.iter().zip(contact.share) {
            let spot = &mut x[*id as usize];
            let by = contact.n * (by * spot[3] * share);
            shift(spot, by);
            predicted.add(*id as usize, by);
        }
    }
}

/// Sides that were pushed apart have no velocity against each other but along the surface, and none at all
/// where they stick.
pub(super) fn calm(contacts: &[Contact], active: &[u32], x: &[Spot], motion: &mut Columns) {
    for contact in active.iter().map(|at| &contacts[*at as usize]) {
        if contact.push <= 0.0 {
            continue;
        }
        let mut v = Vec3::ZERO;
        for (id, share) in contact.ids.iter().zip(contact.share) {
            v += motion.at(*id as usize) * share;
        }
        let v = if contact.sticks { v } else { contact.n * v.dot(contact.n) };
        let by = v * -contact.give;
        for (id, share) in contact.ids.iter().zip(contact.share) {
            motion.add(*id as usize, by * (share * x[*id as usize][3]));
        }
    }
}
