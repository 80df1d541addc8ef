//! Stage `SelfContacts`: the surface of a cloth keeps from itself, a material's thickness apart.
//!
//! Vertices meet triangles and edges meet edges. What may meet is listed (`list`) by a tree of patches
//! (`patches`), anew only when particles left the room that they were given. In each substep the pairs that may
//! meet get a direction that tells their sides apart (`contacts`); they push and rub (`push`); and after all
//! else moved, none gets past the other (`fence`). What is near enough to meet follows from where particles are
//! alone and pairs keep the order of the mesh, so it makes no difference to the bits when the list was made.

mod contacts;
mod fence;
mod list;
mod patches;
mod push;
pub(crate) mod slits;
mod spots;

use super::World;
use super::crowd;
use crate::math::{max, min};
use crate::state::settings::SelfCollision;
use contacts::{Contact, Span};
use glam::Vec3;
use list::List;
use patches::Patches;
use slits::Slits;
use spots::{Spot, place};

/// Gap of a cloth without thickness, in mean rest lengths; and the most that any has.
const THIN: f32 = 0.005;
pub(super) const THICK: f32 = 0.5;

/// What particles may be pushed by beyond their own ways: a share of the mean rest length, of the gap, and of
/// these ways. Those that were pushed farther are looked at again.
const SPARE: f32 = 0.02;
const SPARE_GAP: f32 = 1.0;
const SPARE_WAY: f32 = 0.25;

/// What a collider touches gives way to other layers by this share of what it would.
const BACKED: f32 = 0.02;

/// How often that is done at most.
const LOOKS: u32 = 8;

/// The layers of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Layers {
    patches: Patches,
    list: List,
    /// The pairs that may meet, where particles were when they were found, and how all moved until then in the
    /// mean; and whether they still are those that may meet.
    contacts: Vec<Contact>,
    found_at: Vec<Spot>,
    drift: Vec3,
    is_found: bool,
    /// The contacts that push in this substep.
    active: Vec<u32>,
    /// What was found late, since particles were pushed far.
    late: Vec<Contact>,
    /// Where particles were as the substep began, and where they are.
    start: Vec<Spot>,
    now: Vec<Spot>,
    /// How far each may move against the mean, and that from where it was listed [m].
    reach: Vec<f32>,
    needs: Vec<f32>,
    frozen: Vec<u32>,
    /// The piece that each site was part of before anything tore.
    pieces: Vec<u32>,
    slits: Slits,
    gap: f32,
}

impl Layers {
    fn new(world: &World) -> Self {
        let (capacity, count) = (world.capacity(), world.particles.len());
        let pieces = crowd::pieces(&world.mesh, world.rest.len());
        let triangles = world.mesh.triangles.len();
        Self {
            patches: Patches::new(&world.mesh, &world.rest, &pieces, capacity),
            list: List::new(count, capacity, triangles),
            contacts: Vec::with_capacity(24 * count),
            found_at: Vec::with_capacity(capacity),
            drift: Vec3::ZERO,
            is_found: false,
            active: Vec::with_capacity(24 * count),
            late: Vec::with_capacity(24 * count),
            start: Vec::with_capacity(capacity),
            now: Vec::with_capacity(capacity),
            reach: Vec::with_capacity(capacity),
            needs: Vec::with_capacity(capacity),
            frozen: Vec::with_capacity(capacity),
            pieces,
            slits: Slits::new(capacity),
            gap: 0.0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let spots = self.start.capacity() + self.now.capacity() + self.found_at.capacity();
        self.patches.bytes()
            + self.list.bytes()
            + self.slits.bytes()
            + size_of::<Contact>() * (self.contacts.capacity() + self.late.capacity())
            + size_of::<Spot>() * spots
            + 4 * (self.reach.capacity() + self.needs.capacity() + self.active.capacity())
            + 4 * self.pieces.capacity()
            + 4 * self.frozen.capacity()
    }

    /// Finds what may meet until particles moved farther than by now, and a little.
    fn find(&mut self, world: &World, is_late: bool) {
        self.found_at.clone_from(&self.start);
        self.drift = spots::drift(&self.start, &self.now);
        let spare = min(world.spacing * SPARE, self.gap * SPARE_GAP);
        self.reach.clear();
        for (start, now) in self.start.iter().zip(&self.now) {
            let way = (place(now) - place(start) - self.drift).length();
            self.reach.push(way * (1.0 + SPARE_WAY) + spare);
        }
        if !self.list.holds(&self.start, &self.reach, &mut self.needs) {
            let Self { list, patches, pieces, start, reach, needs, .. } = self;
            list.make(world, patches, pieces, start, reach, self.gap);
            needs.clone_from(reach);
        }
        let span =
            Span { start: &self.start, now: &self.now, reach: &self.reach, needs: &self.needs };
        let contacts = if is_late { &mut self.late } else { &mut self.contacts };
        contacts::find(&self.list.pairs, span, contacts);
        self.is_found = !is_late;
    }

    /// Whether no particle moved farther than it was thought to.
    fn is_within_reach(&self) -> bool {
        let mut is_within = true;
        for ((at, now), reach) in self.found_at.iter().zip(&self.now).zip(&self.reach) {
            let way = place(now) - place(at) - self.drift;
            is_within &= way.length_squared() <= reach * reach;
        }
        is_within
    }

    /// Those that moved farther than they were thought to go back.
    fn call_back(&mut self) {
        for ((at, now), reach) in self.found_at.iter().zip(&mut self.now).zip(&self.reach) {
            let back = place(at) + self.drift;
            if (place(now) - back).length_squared() > reach * reach && now[3] > 0.0 {
                [now[0], now[1], now[2]] = back.to_array();
            }
        }
    }

    /// Nothing crosses any more. Of a cloth that nothing holds or touches, the momentum stays.
    fn hold(&mut self, world: &World) {
        let is_free = world.scratch.contacts.touches.is_empty();
        let before = if is_free { spots::middle(&self.now) } else { None };
        if !self.fence(world) {
            return;
        }
        if let (Some(before), Some(after)) = (before, spots::middle(&self.now)) {
            let by = before - after;
            self.now.iter_mut().for_each(|spot| spots::shift(spot, by));
        }
    }

    /// Says whether anything went back to where it was.
    fn fence(&mut self, world: &World) -> bool {
        let (mut is_late, mut went_back) = (false, false);
        for look in 0..LOOKS {
            if look > 0 || !self.is_found || !self.is_within_reach() {
                self.find(world, true);
                is_late = true;
            }
            let Self { contacts, late, found_at, now, drift, frozen, .. } = self;
            let contacts = if is_late { late } else { contacts };
            went_back |= fence::hold(contacts, found_at, now, *drift, frozen);
            if self.is_within_reach() {
                return went_back;
            }
        }
        self.call_back();
        let Self { contacts, late, found_at, now, drift, frozen, .. } = self;
        let contacts = if is_late { late } else { contacts };
        fence::go_back(contacts, found_at, now, *drift, frozen);
        true
    }
}

impl World {
    /// Makes what the surface needs that keeps from itself, or drops it, as settings say.
    pub fn see_to_layers(&mut self) {
        let is_wanted = self.settings.self_collision == SelfCollision::Surface;
        self.layers = is_wanted.then(|| Box::new(Layers::new(self)));
    }

    /// How far layers keep apart [m].
    fn layer_gap(&self) -> f32 {
        let own = self.settings.self_distance;
        let gap = if own > 0.0 { own } else { self.material.thickness };
        // Not `clamp`: what that would say of limits that cannot be takes 18 kB of a page.
        min(max(gap, THIN * self.spacing), THICK * self.spacing)
    }
}

/// A tick begins, or its last part after tears, with particles where they are.
pub(crate) fn begin(world: &mut World) {
    let Some(mut layers) = world.layers.take() else {
        return;
    };
    let gap = world.layer_gap();
    if gap != layers.gap {
        layers.gap = gap;
        layers.list.forget();
    }
    layers.list.begin_tick();
    let p = &world.particles;
    if layers.start.len() != p.len() {
        layers.patches.follow(&world.mesh);
        layers.list.forget();
    }
    spots::gather(&mut layers.start, &p.x, &p.w);
    layers.now.clone_from(&layers.start);
    layers.is_found = false;
    world.layers = Some(layers);
}

/// Finds what may meet in this substep.
pub(crate) fn pair(world: &mut World) {
    let Some(mut layers) = world.layers.take() else {
        return;
    };
    spots::gather(&mut layers.now, &world.particles.x, &world.particles.w);
    for touch in &world.scratch.contacts.touches {
        layers.now[touch.particle as usize][3] =
            world.particles.w[touch.particle as usize] * BACKED;
    }
    if !layers.is_found || !layers.is_within_reach() {
        layers.find(world, false);
    }
    world.layers = Some(layers);
}

/// Layers push and rub, once and in a fixed order.
pub(crate) fn solve(world: &mut World) {
    let (h, friction) = (world.settings.scheme().h, world.material.friction);
    let Some(layers) = &mut world.layers else {
        return;
    };
    let Layers { contacts, active, found_at, drift, start, now, .. } = &mut **layers;
    let way = 2.0 * spots::farthest(found_at, now, *drift);
    push::solve(contacts, active, start, now, way, friction);
    push::spread(contacts, active, now, &mut world.scratch.predicted, h);
    spots::scatter(now, &mut world.particles.x);
}

/// After all else moved, nothing crosses.
pub(crate) fn hold(world: &mut World) {
    let Some(mut layers) = world.layers.take() else {
        return;
    };
    for (spot, x) in layers.now.iter_mut().zip(world.particles.x.iter()) {
        [spot[0], spot[1], spot[2]] = x.to_array();
    }
    layers.hold(world);
    spots::scatter(&layers.now, &mut world.particles.x);
    let Layers { start, now, .. } = &mut *layers;
    start.clone_from(now);
    world.layers = Some(layers);
}

/// Once more at the end of a tick, after other stages moved particles; what leashes pulled stays where that is.
pub(crate) fn hold_at_last(world: &mut World) {
    let (pulled, w) = (&world.scratch.pulled, &world.particles.w);
    if let Some(layers) = &mut world.layers {
        for (spot, w) in layers.now.iter_mut().zip(w.iter()) {
            spot[3] = *w;
        }
        pulled.iter().for_each(|i| layers.now[*i as usize][3] = 0.0);
    }
    hold(world);
}

/// After velocities were derived, those of layers that touch agree.
pub(crate) fn calm(world: &mut World) {
    let Some(layers) = &world.layers else {
        return;
    };
    let p = &mut world.particles;
    for motion in [&mut p.v, &mut p.v_ahead, &mut p.moved] {
        push::calm(&layers.contacts, &layers.active, &layers.now, motion);
    }
}
