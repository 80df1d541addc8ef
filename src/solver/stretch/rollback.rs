//! Where a cloth goes back to when the stretch bound cannot be had otherwise: to where it was a tick ago, but
//! for what its pieces have moved as a whole.
//!
//! A piece that something holds goes with that, and turns with an attachment that holds it; one that nothing holds flies, falls and spins on as a solid
//! body, or as the anchors of its leashes do. Either way no link gets longer than it was then.

use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::mesh::{NONE, triangle_of};
use crate::solver::integrate::rigid_motion::RigidMotion;
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use glam::Vec3;

/// Where each particle goes back to, and room to find it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Home {
    pub places: Columns,
    /// Particles piece by piece, and where in that each piece ends.
    order: Vec<u32>,
    ends: Vec<u32>,
}

impl Home {
    /// Room for so many particles in pieces of so many triangles.
    pub fn with_capacity(particles: usize, triangles: usize) -> Self {
        Self {
            places: Columns::with_capacity(particles),
            order: Vec::with_capacity(particles),
            ends: Vec::with_capacity(triangles),
        }
    }

    /// Sees to room for pieces of so many triangles.
    pub fn reserve(&mut self, triangles: usize) {
        self.ends.reserve_exact(triangles.saturating_sub(self.ends.len()));
    }

    /// Finds the particles of each piece.
    fn sort(&mut self, world: &World) {
        let Self { order, ends, .. } = self;
        let piece = |particle: usize| match world.mesh.corner_of[particle] {
            NONE => None,
            corner => Some(world.scratch.pieces.label[triangle_of(corner)] as usize),
        };
        let pieces = || (0..world.particles.len()).filter_map(|i| piece(i).map(|piece| (i, piece)));
        ends.clear();
        ends.resize(world.pieces as usize, 0);
        pieces().for_each(|(_, piece)| ends[piece] += 1);
        let mut before = 0;
        for end in ends.iter_mut() {
            before += core::mem::replace(end, before);
        }
        order.clear();
        order.resize(before as usize, 0);
        for (particle, piece) in pieces() {
            order[ends[piece] as usize] = particle as u32;
            ends[piece] += 1;
        }
    }
}

/// Finds where all particles go back to.
pub(crate) fn find(world: &mut World) {
    let mut home = core::mem::take(&mut world.scratch.rollback);
    home.sort(world);
    let Home { places, order, ends } = &mut home;
    let (p, shift) = (&world.particles, shift_of_holds(world));
    places.copy_from(&p.x);
    let mut first = 0;
    for end in ends.iter() {
        let piece = &order[first..*end as usize];
        first = *end as usize;
        let particles = || piece.iter().map(|i| *i as usize);
        if particles().any(|i| p.w[i] <= 0.0) {
            let free = particles().filter(|i| p.w[*i] > 0.0);
            match carriage_of(world, particles()) {
                Some([last, next]) => {
                    free.for_each(|i| places.set(i, next.outward(last.inward(p.x_last.at(i)))));
                }
                None => free.for_each(|i| places.set(i, p.x_last.at(i) + shift)),
            }
        } else {
            let way = |i: usize| p.x.at(i) - p.x_last.at(i);
            let leashes = || particles().filter_map(|i| world.anchors.find(i as u32));
            let motion = if leashes().next().is_some() {
                let anchor =
                    |leash: &AnchorConstraint| (leash.from, leash.anchor - leash.from, 1.0);
                RigidMotion::of_points(|| leashes().map(anchor))
            } else {
                RigidMotion::fit(particles, &p.x_last, way, &p.mass)
            };
            particles().for_each(|i| places.set(i, motion.place(p.x_last.at(i))));
        }
    }
    world.scratch.rollback = home;
}

/// Where the attachment was and is that holds the first of some particles that one holds.
fn carriage_of(
    world: &World,
    mut particles: impl Iterator<Item = usize>,
) -> Option<[Transform; 2]> {
    if world.pins.iter().all(|pin| pin.carrier == 0) {
        return None;
    }
    let pin = particles.find_map(|i| {
        let pin = world.pins.find(i as u32)?;
        (pin.carrier != 0 && !pin.is_soft()).then_some(pin)
    })?;
    let carrier = world.attachments.get(pin.carrier, "attachment").ok()?;
    Some([carrier.last.frame(), carrier.next.frame()])
}

/// How far pins and grabs moved in this tick, on average.
fn shift_of_holds(world: &World) -> Vec3 {
    let p = &world.particles;
    let (mut sum, mut count) = (Vec3::ZERO, 0.0);
    for i in (0..p.len()).filter(|i| p.w[*i] <= 0.0) {
        sum += p.x.at(i) - p.x_last.at(i);
        count += 1.0;
    }
    if count > 0.0 { sum * (1.0 / count) } else { Vec3::ZERO }
}
