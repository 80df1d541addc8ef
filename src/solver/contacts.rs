//! Stage `Contacts`: particles stay outside colliders, slowed by Coulomb friction.

use super::World;
use crate::state::colliders::Body;
use glam::Vec3;

/// What a particle touched in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// Out of the collider; zero if the particle touched nothing.
    pub normal: Vec3,
    pub surface_velocity: Vec3,
    /// The particle's velocity before it touched [m/s].
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

    pub fn is_some(&self) -> bool {
        self.normal != Vec3::ZERO
    }
}

/// Pushes every free particle out of every collider, as it is at the end of substep `number`.
pub(crate) fn solve(world: &mut World, number: u32) {
    if world.colliders.iter().next().is_none() {
        return;
    }
    world.scratch.touch.fill(Touch::NONE);
    let thickness = world.material.thickness;
    let tick = world.settings.tick;
    let share = (number + 1) as f32 / world.settings.substeps as f32;
    for body in world.colliders.iter() {
        let pose = body.last.toward(&body.next, share);
        let normal = pose.turn(Vec3::Y);
        let feel = Feel::of(body, world.material.friction, world.material.restitution);
        for i in 0..world.particles.len() {
            if world.particles.w[i] <= 0.0 {
                continue;
            }
            let x = world.particles.x.at(i);
            let depth = thickness - (x - pose.position).dot(normal);
            if depth <= 0.0 {
                continue;
            }
            let local = pose.turn_back(x - pose.position);
            let carried = |pose: &crate::state::colliders::Pose| pose.position + pose.turn(local);
            let surface_velocity = (carried(&body.next) - carried(&body.last)) * (1.0 / tick);
            let out = x + normal * depth;
            let from = world.scratch.predicted.at(i) - world.scratch.way.at(i);
            let surface_step = surface_velocity * world.settings.scheme().h;
            let slide = out - from - surface_step;
            let along = slide - normal * slide.dot(normal);
            world.particles.x.set(i, out - along * feel.held_back(along.length(), depth));
            world.scratch.touch[i] = Touch {
                normal,
                surface_velocity,
                approach: Vec3::ZERO,
                restitution: feel.restitution,
                tangential_restitution: feel.tangential_restitution,
            };
        }
    }
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
