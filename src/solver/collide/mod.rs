//! Stage `Contacts`: the cloth stays outside colliders, slowed by Coulomb friction.
//!
//! All is done as each collider sees it: in a frame that goes with it, where it rests. A particle has
//! gone from where it was at the start of the substep, as the collider was then, to where it is at the
//! end; so whatever moves, nothing gets through. Particles come first, then triangles against what
//! is sharp or small enough to get in between particles.

pub(crate) mod broad_phase;
pub(crate) mod collider_contact;
mod distance_cull;
mod edge_vs_feature;
mod mid_phase;
mod particle_vs_shape;
mod push_accumulator;
pub(crate) mod response;
mod triangle_vs_round;

use crate::geometry::features::Bend;
use crate::geometry::shape::CollisionShape;
use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::math::{max, min, saturate};
use crate::solver::collide::broad_phase::{Found, NearbyBlocks};
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::push_accumulator::Lifts;
use crate::solver::world::World;
use crate::state::colliders::{ColliderBody, Impulse};
use crate::state::settings::BdfScheme;
use glam::Vec3;

/// How often triangles are pushed out of a shape in a substep, each time all of them: at least, and at most
/// while some are too deep.
const ROUNDS: [u32; 2] = [2, 40];

/// How fast comes out what was inside [m/s]: faster would stretch all around it more than links can bear,
/// and fling it.
const RISE: f32 = 0.05;

/// What is deeper inside a round shape than so many mean edges got there by no motion of its own; and so in one of
/// flat facets, whose tips may be through the cloth.
const DEEP: [f32; 2] = [0.25, 0.75];

/// The share of the gap that may be left to the next substep.
const LEFT: f32 = 0.1;

/// Room for contacts, made when a collider comes.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactScratch {
    pub nearby: NearbyBlocks,
    /// What touched in this substep: by collider, then by particle. What there is no room for any more
    /// neither bounces nor pushes its collider.
    pub collider_contacts: Vec<ColliderContact>,
    /// What each live collider was pushed by in this tick.
    pub impulses: Vec<Impulse>,
    /// How far each particle is from a collider at least [m].
    clear: Vec<f32>,
    lifts: Lifts,
    /// Pairs that may touch in this substep.
    close: Vec<u32>,
    /// Particles as a collider sees them.
    seen: Vec<Vec3>,
    /// Where in `touches` each particle is.
    slots: Vec<u32>,
}

impl World {
    /// Sees to room for what its colliders may touch.
    pub(crate) fn reserve_contacts(&mut self) {
        let (bodies, particles) = (self.colliders.iter().count(), self.capacity());
        let scratch = &mut self.scratch.contacts;
        if bodies == 0 {
            return;
        }
        scratch.nearby.reserve(bodies, particles, self.triangle_capacity);
        scratch
            .collider_contacts
            .reserve_exact(particles.saturating_sub(scratch.collider_contacts.len()));
        scratch.impulses.reserve_exact(bodies.saturating_sub(scratch.impulses.len()));
        scratch.clear.reserve_exact(particles.saturating_sub(scratch.clear.len()));
        scratch.lifts.reserve(particles);
        scratch.close.reserve(self.triangle_capacity);
        scratch.seen.reserve_exact(particles.saturating_sub(scratch.seen.len()));
        scratch.slots.resize(particles, 0);
    }
}

/// A tick begins: nothing was pushed yet, and colliders sweep over new ways.
pub(crate) fn begin_tick(world: &mut World) {
    let scratch = &mut world.scratch.contacts;
    scratch.collider_contacts.clear();
    scratch.impulses.clear();
    scratch.impulses.extend(world.colliders.iter().map(|_| Impulse::default()));
    broad_phase::follow(world);
}

/// The tick is over: every collider is where it was to be, and knows what pushed it.
pub(crate) fn finish_tick(world: &mut World) {
    for (body, impulse) in world.colliders.iter_mut().zip(&world.scratch.contacts.impulses) {
        body.finish_tick();
        let Impulse { linear, angular } = *impulse;
        let angular = angular - body.next.position.cross(linear);
        body.impulse = Impulse { linear: saturate(linear), angular: saturate(angular) };
    }
}

/// Pushes particles out of every collider as it is at the end of the tick, and does nothing else to them, after
/// something moved them from `scratch.predicted`.
pub(crate) fn project_out(world: &mut World) {
    if world.scratch.contacts.impulses.is_empty() {
        return;
    }
    broad_phase::refresh(world);
    touch(world, &|body| [body.next.to_transform(); 2], true);
    world.scratch.contacts.collider_contacts.clear();
}

/// Pushes what is free out of every collider, as it is at the end of substep `number`.
pub(crate) fn solve(world: &mut World, number: u32) {
    world.scratch.contacts.collider_contacts.clear();
    let substeps = world.settings.substeps;
    touch(world, &|body| frames(body, number, substeps), false);
}

/// Goes over all colliders, of which `frames` tells how they stand at the start and at the end; `is_bare`
/// leaves out friction, and triangles.
fn touch(world: &mut World, frames: &dyn Fn(&ColliderBody) -> [Transform; 2], is_bare: bool) {
    let scheme = world.settings.scheme();
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let contacts = &mut scratch.contacts;
    for (at, body) in world.colliders.iter().enumerate() {
        let Some(collision_shape) = body.collision_shape() else { continue };
        let near = contacts.nearby.of(at);
        if near.blocks.is_empty() {
            continue;
        }
        let gap = gap(body, world.material.thickness);
        let mut place = Place {
            x: &mut p.x,
            v: &p.v,
            w: &p.w,
            way: &scratch.displacement,
            predicted: &scratch.predicted,
            frames: frames(body),
            feel: if is_bare {
                Feel::NONE
            } else {
                Feel::of(body, world.material.friction, world.material.restitution)
            },
            gap,
            rise: Rise {
                by: RISE * scheme.h,
                deep: DEEP[usize::from(collision_shape.steps().is_some())] * world.mean_edge,
            },
            scheme,
            body: at as u32,
            touches: &mut contacts.collider_contacts,
            slots: &mut contacts.slots,
        };
        place.gap += near.bulge;
        let (clear, lifts) = (&mut contacts.clear, &mut contacts.lifts);
        if !near.faces.is_empty() || clear.len() != place.w.len() {
            // Corners of triangles that nobody looks at are near.
            clear.clear();
            clear.resize(place.w.len(), 0.0);
        }
        particle_vs_shape::solve(
            world.level,
            collision_shape,
            &mut place,
            near.blocks,
            &near.sharp,
            clear,
        );
        if is_bare {
            continue;
        }
        if collision_shape.steps().is_some() {
            let task = edge_vs_feature::Task {
                collision_shape,
                found: near.sharp,
                gap: gap * triangle_vs_round::GAP,
                deepest: near.longest * 0.5,
            };
            edge_vs_feature::look(&task, &place, &mut contacts.seen, &mut contacts.close);
            rounds(collision_shape, &mut place, &near, gap, lifts, &|place, lifts| {
                edge_vs_feature::solve(&task, place, &contacts.close, lifts)
            });
        } else if !near.faces.is_empty() {
            rounds(collision_shape, &mut place, &near, gap, lifts, &|place, lifts| {
                triangle_vs_round::solve(
                    collision_shape,
                    place,
                    &world.mesh.triangles,
                    &near,
                    gap,
                    clear,
                    lifts,
                )
            });
        }
    }
}

/// Pushes triangles out until they are, by `push`, which says how deep the deepest was; and after each round
/// the corners that it moved.
fn rounds(
    collision_shape: &CollisionShape,
    place: &mut Place<'_>,
    near: &Found<'_>,
    gap: f32,
    lifts: &mut Lifts,
    push: &dyn Fn(&mut Place<'_>, &mut Lifts) -> f32,
) {
    for round in 1..=ROUNDS[1] {
        let deepest = push(place, lifts);
        if deepest == 0.0 {
            break;
        }
        // What pushes triangles may push their corners in elsewhere.
        for i in lifts.pushed() {
            particle_vs_shape::push(collision_shape, place, &near.sharp, *i as usize);
        }
        if round >= ROUNDS[0] && deepest <= gap * LEFT {
            break;
        }
    }
}

/// The gap that a body keeps from the cloth [m].
fn gap(body: &ColliderBody, thickness: f32) -> f32 {
    if body.desc.thickness < 0.0 { thickness } else { body.desc.thickness }
}

/// How a body stands when substep `number` starts and when it ends.
fn frames(body: &ColliderBody, number: u32, substeps: u32) -> [Transform; 2] {
    if body.last == body.next {
        return [body.next.to_transform(); 2];
    }
    [number, number + 1]
        .map(|moment| body.last.at_substep(&body.next, moment, substeps).to_transform())
}

/// How a collider and a material feel to each other.
#[derive(Clone, Copy, Debug)]
struct Feel {
    friction: f32,
    restitution: f32,
    tangential_restitution: f32,
}

impl Feel {
    const NONE: Self = Self { friction: 0.0, restitution: 0.0, tangential_restitution: 1.0 };

    fn of(body: &ColliderBody, friction: f32, restitution: f32) -> Self {
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

/// Which way out, and how far [m].
#[derive(Clone, Copy, Debug)]
struct Push {
    normal: Vec3,
    depth: f32,
    /// Whether friction leaves it alone.
    is_slick: bool,
}

impl Push {
    fn new(normal: Vec3, depth: f32) -> Self {
        Self { normal, depth, is_slick: false }
    }
}

/// How what was inside comes out in a substep [m].
#[derive(Clone, Copy, Debug)]
struct Rise {
    /// By how much.
    by: f32,
    /// What is deeper than this comes out by no more, whatever drags it in, and slides as it will: cloth that
    /// begins inside a shape goes where most of it is pushed to, and is not torn apart.
    deep: f32,
}

impl Rise {
    /// How a point is pushed that was `start` out of a shape and is `height` out of it now, if it touches.
    fn push(&self, normal: Vec3, gap: f32, start: f32, height: f32) -> Option<Push> {
        let depth = min(gap, start + self.by) - height;
        let is_slick = start < -self.deep;
        let depth = if is_slick { min(depth, self.by) } else { depth };
        (depth > 0.0).then_some(Push { normal, depth, is_slick })
    }
}

/// Particles as one collider sees them in one substep.
struct Place<'a> {
    x: &'a mut Columns,
    v: &'a Columns,
    w: &'a [f32],
    way: &'a Columns,
    predicted: &'a Columns,
    /// How the collider stands when the substep starts and when it ends.
    frames: [Transform; 2],
    feel: Feel,
    gap: f32,
    rise: Rise,
    scheme: BdfScheme,
    body: u32,
    touches: &'a mut Vec<ColliderContact>,
    slots: &'a mut [u32],
}

impl Place<'_> {
    /// Where a particle was when the substep started.
    #[inline(always)]
    fn before(&self, i: usize) -> Vec3 {
        self.frames[0].point_to_local(self.predicted.at(i) - self.way.at(i))
    }

    /// Where it is.
    #[inline(always)]
    fn now(&self, i: usize) -> Vec3 {
        self.frames[1].point_to_local(self.x.at(i))
    }

    /// The push and what friction takes back of a slide from `before` to `now`.
    fn moved(&self, before: Vec3, now: Vec3, push: Push) -> Vec3 {
        let out = push.normal * push.depth;
        if push.is_slick {
            return out;
        }
        let slide = now + out - before;
        let along = slide - push.normal * slide.dot(push.normal);
        out - along * self.feel.held_back(along.length(), push.depth)
    }

    /// How fast the collider's surface is at a point of it.
    fn surface_velocity(&self, at: Vec3) -> Vec3 {
        if self.frames[0] == self.frames[1] {
            return Vec3::ZERO;
        }
        (self.frames[1].point_to_world(at) - self.frames[0].point_to_world(at))
            * (1.0 / self.scheme.h)
    }

    /// Moves a particle that touched by itself, as the collider sees it.
    fn push_point(&mut self, i: usize, now: Vec3, normal: Vec3, moved: Vec3) {
        let (normal, moved) =
            (self.frames[1].vector_to_world(normal), self.frames[1].vector_to_world(moved));
        self.shift(i, now, normal, moved, 1.0);
    }

    /// Moves a particle by what touched it.
    fn shift(&mut self, i: usize, now: Vec3, normal: Vec3, moved: Vec3, share: f32) {
        self.x.add(i, moved);
        let slot = self.slots[i] as usize;
        if let Some(touch) = self.touches.get_mut(slot).filter(|touch| touch.is_of(i, self.body)) {
            // Once more: the larger push tells which way is out.
            if moved.length_squared() > touch.push.length_squared() {
                touch.normal = normal;
            }
            touch.push += moved;
            touch.share = max(share, touch.share);
        } else if self.touches.len() < self.touches.capacity() {
            self.slots[i] = self.touches.len() as u32;
            self.touches.push(ColliderContact {
                particle: i as u32,
                body: self.body,
                share,
                normal,
                surface_velocity: self.surface_velocity(now),
                approach: self.v.at(i),
                push: moved,
                restitution: self.feel.restitution,
                tangential_restitution: self.feel.tangential_restitution,
            });
        }
    }
}

/// Which bends of a shape are let be, and how much farther than the gap particles stay from it for that
/// [m]: so much that what lies between those of a regular grid stays outside too. Particles alone then
/// bear the cloth, and it lies still. Nothing where a cell is too large for that.
///
/// ```text
/// a chord of length L is L² / (8 R) deeper than its ends; the diagonal of a cell is √2 of its side
/// ```
fn relent(collision_shape: &CollisionShape, spacing: f32) -> (Bend, f32) {
    let over = |radius: f32| {
        if radius >= COARSEST * spacing { spacing * spacing * (0.25 * ROOM) / radius } else { 0.0 }
    };
    let bulge = match collision_shape {
        CollisionShape::Sphere(ball) => over(ball.radius),
        CollisionShape::Capsule(capsule) => over(capsule.slimmest()),
        _ => {
            let diagonal = spacing * DIAGONAL;
            let mild = collision_shape.steps().map(|steps| steps.mild(diagonal, spacing * MILD));
            let mild = mild.unwrap_or_default();
            return (mild, mild.sag(diagonal));
        }
    };
    (Bend::default(), bulge)
}

/// Room for cells that are stretched.
const ROOM: f32 = 1.25;

/// The diagonal of a cell, with room.
const DIAGONAL: f32 = 1.5;

/// Where particles stay away by this many spacings to keep what is between them out, they do.
const MILD: f32 = 0.1;

/// A round shape of fewer spacings than this is met by triangles.
const COARSEST: f32 = 1.5;

/// Whether triangles may touch a round shape where no particle does: it gets deeper in between than what is
/// let go.
fn is_pointed(collision_shape: &CollisionShape, longest_edge: f32, gap: f32, bulge: f32) -> bool {
    let chord = |radius: f32| longest_edge * longest_edge * 0.125 / radius;
    let room = gap * triangle_vs_round::GAP + bulge;
    match collision_shape {
        CollisionShape::Sphere(ball) => chord(ball.radius) > room,
        CollisionShape::Capsule(capsule) => chord(capsule.slimmest()) > room,
        _ => false,
    }
}
