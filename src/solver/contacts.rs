//! Stage `Contacts`: particles stay outside colliders, slowed by Coulomb friction.

use super::World;
use crate::math::simd::leveled;
use crate::state::colliders::{Body, Pose};
use glam::Vec3;

/// Particles that are looked at together: where none of them touches, that is all there is to do.
const BLOCK: usize = 64;

/// What a particle touched in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// Out of the collider; zero if the particle touched nothing.
    pub normal: Vec3,
    pub surface_velocity: Vec3,
    /// The particle's velocity before it touched [m/s]: bounces replace what the substep makes of it.
    pub approach: Vec3,
    pub restitution: f32,
    pub tangential_restitution: f32,
}

impl Touch {
    pub const NONE: Self = Self {
        normal: Vec3::ZERO,
        surface_velocity: Vec3::ZERO,
        approach: Vec3::ZERO,
        restitution: 0.0,
        tangential_restitution: 1.0,
    };

    fn is_some(&self) -> bool {
        self.normal != Vec3::ZERO
    }
}

/// What touched in a substep.
#[derive(Clone, Debug)]
pub(crate) struct Touches {
    /// What each particle touched, if anything.
    by_particle: Vec<Touch>,
    /// The particles that touched something, each once.
    touched: Vec<u32>,
}

impl Touches {
    /// Of `count` particles, with room for `capacity`.
    pub fn new(count: usize, capacity: usize) -> Self {
        let mut by_particle = Vec::with_capacity(capacity);
        by_particle.resize(count, Touch::NONE);
        Self { by_particle, touched: Vec::with_capacity(capacity) }
    }

    /// A particle more.
    pub fn grow(&mut self) {
        self.by_particle.push(Touch::NONE);
    }

    fn clear(&mut self) {
        for particle in self.touched.drain(..) {
            self.by_particle[particle as usize] = Touch::NONE;
        }
    }

    /// What a particle touches last is what counts.
    fn note(&mut self, particle: usize, touch: Touch) {
        if !self.by_particle[particle].is_some() {
            self.touched.push(particle as u32);
        }
        self.by_particle[particle] = touch;
    }

    /// The particles that touched something, and what.
    pub fn iter(&self) -> impl Iterator<Item = (usize, Touch)> + '_ {
        self.touched.iter().map(|i| (*i as usize, self.by_particle[*i as usize]))
    }
}

/// Pushes every free particle out of every collider, as it is at the end of substep `number`.
pub(crate) fn solve(world: &mut World, number: u32) {
    world.scratch.touches.clear();
    let (level, count) = (world.level, world.particles.len());
    let thickness = world.material.thickness;
    let (tick, h) = (world.settings.tick, world.settings.scheme().h);
    let share = (number + 1) as f32 / world.settings.substeps as f32;
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    for body in world.colliders.iter() {
        let pose = body.last.toward(&body.next, share);
        let plane = Plane { position: pose.position, normal: pose.turn(Vec3::Y), thickness };
        let normal = plane.normal;
        let feel = Feel::of(body, world.material.friction, world.material.restitution);
        for first in (0..count).step_by(BLOCK) {
            let block = first..(first + BLOCK).min(count);
            let mut is_one_in = false;
            let places = p.x.all().map(|column| &column[block.clone()]);
            look_for_depth(level, &plane, places, &mut is_one_in);
            if !is_one_in {
                continue;
            }
            for i in block.filter(|i| p.w[*i] > 0.0) {
                let x = p.x.at(i);
                let depth = plane.depth(x.to_array());
                if depth <= 0.0 {
                    continue;
                }
                let local = pose.turn_back(x - pose.position);
                let carried = |pose: &Pose| pose.position + pose.turn(local);
                let surface_velocity = (carried(&body.next) - carried(&body.last)) * (1.0 / tick);
                let out = x + normal * depth;
                let from = scratch.predicted.at(i) - scratch.way.at(i);
                let slide = out - from - surface_velocity * h;
                let along = slide - normal * slide.dot(normal);
                p.x.set(i, out - along * feel.held_back(along.length(), depth));
                let touch = Touch {
                    normal,
                    surface_velocity,
                    approach: p.v.at(i),
                    restitution: feel.restitution,
                    tangential_restitution: feel.tangential_restitution,
                };
                scratch.touches.note(i, touch);
            }
        }
    }
}

/// A collider's surface, and the gap that is kept from it.
struct Plane {
    position: Vec3,
    normal: Vec3,
    thickness: f32,
}

impl Plane {
    /// How far a point is within the gap or behind it.
    #[inline(always)]
    fn depth(&self, [x, y, z]: [f32; 3]) -> f32 {
        let (position, normal) = (self.position, self.normal);
        let over =
            (x - position.x) * normal.x + (y - position.y) * normal.y + (z - position.z) * normal.z;
        self.thickness - over
    }
}

leveled! {
    /// Whether any of some points is within the gap.
    fn look_for_depth(plane: &Plane, places: [&[f32]; 3], is_one_in: &mut bool)
        = look_for_depth_lanes
}

#[inline(always)]
fn look_for_depth_lanes(plane: &Plane, [x, y, z]: [&[f32]; 3], is_one_in: &mut bool) {
    // Counted rather than asked for, which a loop over lanes can do; and what is not a number counts.
    let mut outside = 0;
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        outside += u32::from(plane.depth([*x, *y, *z]) <= 0.0);
    }
    *is_one_in = outside < x.len() as u32;
}

/// The tick is over: every collider is where it was to be.
pub(crate) fn arrive(world: &mut World) {
    for body in world.colliders.iter_mut() {
        body.last = body.next;
        body.desc.position = body.next.position;
        body.desc.rotation = body.next.rotation;
    }
}

/// How a collider and a material feel to each other.
struct Feel {
    friction: f32,
    restitution: f32,
    tangential_restitution: f32,
}

impl Feel {
    fn of(body: &Body, friction: f32, restitution: f32) -> Self {
        let own = |value: f32, default: f32| if value < 0.0 { default } else { value };
        Self {
            friction: own(body.desc.friction, friction),
            restitution: own(body.desc.restitution, restitution),
            tangential_restitution: body.desc.tangential_restitution,
        }
    }

    /// The share of a slide [m] that friction takes back, pressed by a push of `depth` [m].
    fn held_back(&self, slide: f32, depth: f32) -> f32 {
        let most = self.friction * depth;
        if slide <= most { 1.0 } else { most / slide }
    }
}
