//! Stage `Pairs`: which blocks of particles and triangles may touch which collider.
//!
//! What it finds holds until a particle moved by `margin` or a collider leaves the bounds it was looked
//! for in; so what is found late or early makes no difference to what touches. Shapes of flat facets are
//! looked at anew in every tick.

use crate::solver::collide::mid_phase;

use crate::geometry::aabb::Aabb;
use crate::geometry::features::Bend;
use crate::geometry::shape::CollisionShape;
use crate::math::columns::Columns;
use crate::math::max;
use crate::math::simd::leveled;
use crate::solver::collide::mid_phase::{Pairs, Sharp, Span};
use crate::solver::collide::{gap, is_pointed, relent};
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;
use crate::state::pose::Pose;
use glam::Vec3;

/// Particles or triangles in a block, which neighbours of a grid mostly share.
pub(super) const BLOCK: usize = 64;

/// How far particles may move before pairs are found anew, in mean rest lengths of edges.
const MARGIN: f32 = 0.5;

/// Finding anew begins a little before it must, which covers rounding.
const HASTE: f32 = 0.95;

/// Blocks near each collider.
#[derive(Clone, Debug, Default)]
pub(crate) struct NearbyBlocks {
    reaches: Vec<Reach>,
    blocks: Vec<u32>,
    /// Where particles were when this was found.
    found_at: Columns,
    particle_bounds: Vec<Aabb>,
    face_bounds: Vec<Aabb>,
    /// The longest edge at rest, and how many triangles there were when it was measured [m].
    longest_at_rest: (f32, usize),
    /// No edge was longer when this was found [m].
    longest: f32,
    is_stale: bool,
    pairs: Pairs,
}

/// What is near one collider.
#[derive(Clone, Copy, Debug)]
struct Reach {
    /// Where it is in this tick; and where it was looked for.
    now: Room,
    found: Room,
    /// Its bends that are let be, and how much farther than the gap particles stay from it for that.
    mild: Bend,
    bulge: f32,
    sharp: Span,
    /// Its entries of `blocks`: particles from `from` to `middle`, triangles from there to `end`.
    from: u32,
    middle: u32,
    end: u32,
}

/// Where a collider is during a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Room {
    Bounds(Aabb),
    /// Above neither plane, each a point and a normal.
    Below([(Vec3, Vec3); 2]),
}

/// What is near a collider.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<'a> {
    /// Blocks of particles.
    pub blocks: &'a [u32],
    /// Blocks of triangles.
    pub faces: &'a [u32],
    /// No edge is longer [m].
    pub longest: f32,
    /// How much farther than the gap particles stay from it [m].
    pub bulge: f32,
    pub sharp: Sharp<'a>,
}

impl NearbyBlocks {
    pub fn reserve(&mut self, bodies: usize, particles: usize, triangles: usize) {
        let (blocks, faces) = (particles.div_ceil(BLOCK), triangles.div_ceil(BLOCK));
        let all = bodies * (blocks + faces);
        self.reaches.reserve_exact(bodies.saturating_sub(self.reaches.len()));
        self.blocks.reserve_exact(all.saturating_sub(self.blocks.len()));
        self.found_at.reserve(particles);
        let reserve = |list: &mut Vec<Aabb>, count: usize| {
            list.reserve_exact(count.saturating_sub(list.len()));
        };
        reserve(&mut self.particle_bounds, blocks);
        reserve(&mut self.face_bounds, faces);
        self.pairs.reserve(bodies, particles, triangles);
        self.is_stale = true;
    }

    /// All is to be found anew: colliders went, or are touched otherwise.
    pub fn invalidate(&mut self) {
        self.is_stale = true;
    }

    /// What is near the live collider of this number.
    pub(super) fn of(&self, body: usize) -> Found<'_> {
        let Reach { from, middle, end, bulge, ref sharp, .. } = self.reaches[body];
        let part = |from: u32, end: u32| &self.blocks[from as usize..end as usize];
        let (blocks, faces) = (part(from, middle), part(middle, end));
        Found { blocks, faces, longest: self.longest, bulge, sharp: self.pairs.of(sharp) }
    }
}

impl Room {
    fn of(body: &ColliderBody, collision_shape: &CollisionShape, gap: f32) -> Self {
        let poses = [&body.last, &body.next];
        if let CollisionShape::HalfSpace(_) = collision_shape {
            return Self::Below(poses.map(|pose| (pose.position, pose.to_transform().axes[1])));
        }
        let shape = collision_shape.bounds();
        let mut bounds = Aabb::EMPTY;
        poses.into_iter().for_each(|pose| bounds.merge(&around(&shape, pose, body)));
        Self::Bounds(bounds.expanded(gap))
    }

    /// The same, with room to move in.
    fn expanded(self, by: f32) -> Self {
        match self {
            Self::Bounds(bounds) => Self::Bounds(bounds.expanded(by)),
            Self::Below(_) => self,
        }
    }

    fn contains(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Bounds(own), Self::Bounds(other)) => own.contains(other),
            _ => self == other,
        }
    }

    /// Whether something in `bounds` may come within `reach` of it.
    fn overlaps(&self, bounds: &Aabb, reach: f32) -> bool {
        let planes = match self {
            Self::Bounds(own) => return own.expanded(reach).overlaps(bounds),
            Self::Below(planes) => planes,
        };
        let turned = planes[0].1 != planes[1].1;
        turned
            || planes.iter().any(|(point, normal)| {
                let (center, half) = (bounds.center() - *point, bounds.half_extents());
                let size = Vec3::new(normal.x.abs(), normal.y.abs(), normal.z.abs());
                // What is not a number is near.
                let distance = center.dot(*normal) - half.dot(size);
                distance.is_nan() || distance <= reach
            })
    }
}

/// Bounds of a shape in a pose of a body; of all its turns, if it turns.
fn around(shape: &Aabb, pose: &Pose, body: &ColliderBody) -> Aabb {
    let frame = pose.to_transform();
    if body.last.rotation == body.next.rotation {
        let (center, half) = (frame.point_to_world(shape.center()), shape.half_extents());
        let size = |v: Vec3| Vec3::new(v.x.abs(), v.y.abs(), v.z.abs());
        let [u, v, w] = frame.axes.map(size);
        let half = u * half.x + v * half.y + w * half.z;
        return Aabb { low: center - half, high: center + half };
    }
    let farthest = |low: f32, high: f32| max(low.abs(), high.abs());
    let (low, high) = (shape.low, shape.high);
    let corner =
        Vec3::new(farthest(low.x, high.x), farthest(low.y, high.y), farthest(low.z, high.z));
    Aabb::from_points([pose.position]).expanded(corner.length())
}

/// A tick begins: looks where its colliders go.
pub(super) fn follow(world: &mut World) {
    let (near, thickness) = (&mut world.scratch.contacts.nearby, world.material.thickness);
    let mut count = 0;
    let is_new = near.is_stale;
    if is_new {
        near.reaches.clear();
    }
    for body in world.colliders.iter() {
        let Some(collision_shape) = body.collision_shape() else { continue };
        if count == near.reaches.len() {
            let (mild, bulge) = relent(collision_shape, world.mean_edge);
            let nowhere = Room::Bounds(Aabb::EMPTY);
            near.reaches.push(Reach {
                now: nowhere,
                found: nowhere,
                mild,
                bulge,
                sharp: Span::default(),
                from: 0,
                middle: 0,
                end: 0,
            });
        }
        let reach = &mut near.reaches[count];
        reach.now = Room::of(body, collision_shape, gap(body, thickness) + reach.bulge);
        // What got deep inside between ridges may be a pair or not, by when it was looked for: at the start of
        // every tick, so that a restored cloth goes on the same.
        near.is_stale |= collision_shape.steps().is_some() || !reach.found.contains(&reach.now);
        count += 1;
    }
}

/// Finds pairs, if what was found holds no more.
pub(crate) fn refresh(world: &mut World) {
    let near = &world.scratch.contacts.nearby;
    if near.reaches.is_empty() {
        return;
    }
    let margin = MARGIN * world.mean_edge;
    let is_other = near.found_at.x.len() != world.particles.len()
        || near.longest_at_rest.1 != world.mesh.triangles.len();
    if near.is_stale || is_other || is_one_far(world, margin * HASTE) {
        find(world, margin);
    }
}

fn is_one_far(world: &World, limit: f32) -> bool {
    let mut far = false;
    let (x, found_at) = (world.particles.x.all(), world.scratch.contacts.nearby.found_at.all());
    look_far(world.level, x, found_at, limit * limit, &mut far);
    far
}

leveled! {
    /// Whether a particle is farther away than so much squared.
    fn look_far(x: [&[f32]; 3], from: [&[f32]; 3], limit2: f32, far: &mut bool) = look_far_lanes
}

#[inline(always)]
fn look_far_lanes([x, y, z]: [&[f32]; 3], [u, v, w]: [&[f32]; 3], limit2: f32, far: &mut bool) {
    let mut found = 0_u32;
    let now = x.iter().zip(y).zip(z);
    let then = u.iter().zip(v).zip(w);
    for (((x, y), z), ((u, v), w)) in now.zip(then) {
        let (x, y, z) = (x - u, y - v, z - w);
        // What is not a number is far.
        let moved2 = x * x + y * y + z * z;
        found |= u32::from(moved2.is_nan() | (moved2 > limit2));
    }
    *far |= found != 0;
}

fn find(world: &mut World, margin: f32) {
    measure_edges(world);
    let (scratch, x) = (&mut world.scratch, &world.particles.x);
    let near = &mut scratch.contacts.nearby;
    near.found_at.copy_from(x);
    near.is_stale = false;
    // Where a particle is, and where the substep found it: a fast one is far from there already.
    let both = |i: usize| [x.at(i), scratch.predicted.at(i) - scratch.displacement.at(i)];
    let count = world.particles.len();
    near.particle_bounds.clear();
    near.particle_bounds.extend(
        (0..count)
            .step_by(BLOCK)
            .map(|first| Aabb::from_points((first..(first + BLOCK).min(count)).flat_map(both))),
    );
    near.face_bounds.clear();
    near.blocks.clear();
    near.pairs.clear();
    near.longest = 0.0;
    for (reach, body) in near.reaches.iter_mut().zip(world.colliders.iter()) {
        let Some(collision_shape) = body.collision_shape() else { continue };
        // Colliders that move get room of their own.
        let slack = if body.last == body.next { 0.0 } else { margin };
        reach.found = reach.now.expanded(slack);
        reach.sharp = Span::default();
        reach.from = near.blocks.len() as u32;
        for (block, bounds) in near.particle_bounds.iter().enumerate() {
            if reach.found.overlaps(bounds, margin) {
                near.blocks.push(block as u32);
            }
        }
        reach.middle = near.blocks.len() as u32;
        let gap = gap(body, world.material.thickness);
        let is_sharp = collision_shape.steps().is_some() && reach.middle > reach.from;
        let is_pointed = is_pointed(collision_shape, near.longest_at_rest.0, gap, reach.bulge);
        if (is_sharp || is_pointed) && near.longest == 0.0 {
            near.longest = longest(world.mesh.triangles.iter(), |i| x.at(i)) + 2.0 * margin;
        }
        if is_sharp {
            let (last, next) = (body.last.to_transform(), body.next.to_transform());
            let places = |i: usize| {
                let [now, before] = both(i);
                [
                    last.point_to_local(now),
                    last.point_to_local(before),
                    next.point_to_local(now),
                    next.point_to_local(before),
                ]
            };
            let far = margin + gap + reach.bulge + body.max_arc_deviation(collision_shape);
            let search = mid_phase::Search { reach: far, mild: reach.mild };
            reach.sharp = near.pairs.find(collision_shape, &world.mesh, count, places, search);
        }
        if is_pointed {
            if near.face_bounds.is_empty() {
                let faces = world.mesh.triangles.chunks(BLOCK);
                near.face_bounds.extend(faces.map(|faces| {
                    Aabb::from_points(faces.as_flattened().iter().flat_map(|i| both(*i as usize)))
                }));
            }
            for (block, bounds) in near.face_bounds.iter().enumerate() {
                if reach.found.overlaps(bounds, margin) {
                    near.blocks.push(block as u32);
                }
            }
        }
        reach.end = near.blocks.len() as u32;
    }
}

/// How long edges are at rest, after triangles were divided.
fn measure_edges(world: &mut World) {
    let triangles = &world.mesh.triangles;
    let near = &mut world.scratch.contacts.nearby;
    if near.longest_at_rest.1 != triangles.len() {
        let at = |i: usize| world.rest[world.mesh.source[i] as usize];
        near.longest_at_rest = (longest(triangles.iter(), at), triangles.len());
    }
}

/// The length of the longest edge.
fn longest<'a>(triangles: impl Iterator<Item = &'a [u32; 3]>, at: impl Fn(usize) -> Vec3) -> f32 {
    let mut most = 0.0;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| at(i as usize));
        for span in [b - a, c - b, a - c] {
            most = max(span.length_squared(), most);
        }
    }
    most.sqrt()
}
