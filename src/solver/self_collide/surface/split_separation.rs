//! The two sides of a fresh slit part by a hair.
//!
//! ```text
//!      ╲   │   ╱                ╲   │   ╱       The copies of a vertex that was split begin at the same
//!       ╲  │  ╱                  ╲  │  ╱        place, where no direction tells the sides apart. Each
//!   ──── ●=●=● ────    ─▶    ──── ● ● ● ────    goes a hair towards what it has left, along directions
//!       ╱  │  ╲              ──── ● ● ● ────    that tell each of its triangles apart from each of the
//!      ╱   │   ╲                 ╱  │  ╲        others', however the cloth is folded.
//! ```

use crate::math::sort::sort_by;
use crate::math::{TINY, min};
use crate::mesh::{Fan, next_corner, prev_corner};
use crate::solver::world::World;
use glam::Vec3;

/// How far sides part, in mean rest lengths, and at most in lengths of the shortest edge that they have.
pub(crate) const HAIR: f32 = 0.001;
const SHORT: f32 = 0.02;

/// How often ways are gone over until all triangles part, how much of a hair may be missing then, and how many
/// hairs a vertex goes at most.
const ROUNDS: u32 = 16;
const MISSING: f32 = 0.05;
const FAR: f32 = 4.0;

/// A direction tells triangles apart if no edge leads to the other side of it by more than this (a sine), which
/// covers rounding; one that is shorter than this is too inexact.
const HARDLY: f32 = 1.0e-5;
const SHORTEST: f32 = 1.0e-4;

/// The most directions that are looked at for two triangles.
const LOOKS: usize = 13;

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slits {
    /// The copies of split vertices by the place that they were split from, and how far each goes [m].
    copies: Vec<u32>,
    ways: Vec<Vec3>,
    /// Of the copies at one place, the triangles, and what parts them.
    wedges: Vec<Wedge>,
    partings: Vec<Parting>,
    fan: Fan,
}

/// A corner of a triangle: which copy's it is, and where its two edges lead, a unit long each.
#[derive(Clone, Copy, Debug)]
struct Wedge {
    copy: usize,
    edges: [Vec3; 2],
}

/// Directions that each tell a triangle of one copy apart from a triangle of another one. The copies are to part
/// along any one of them.
#[derive(Clone, Copy, Debug)]
struct Parting {
    copies: [usize; 2],
    /// How far edges lead away from the other side at least (a sine), and the direction.
    along: [(f32, Vec3); LOOKS],
    count: usize,
}

impl Slits {
    pub fn new(capacity: usize) -> Self {
        let (corners, spokes) = (Vec::with_capacity(64), Vec::with_capacity(65));
        Self {
            copies: Vec::with_capacity(capacity),
            ways: Vec::with_capacity(capacity),
            wedges: Vec::with_capacity(64),
            partings: Vec::with_capacity(64),
            fan: Fan { corners, ring: spokes, is_closed: false },
        }
    }

    pub fn bytes(&self) -> usize {
        let fan = self.fan.corners.capacity() + self.fan.ring.capacity();
        size_of::<Vec3>() * self.ways.capacity()
            + size_of::<Wedge>() * self.wedges.capacity()
            + size_of::<Parting>() * self.partings.capacity()
            + 4 * (self.copies.capacity() + fan)
    }

    /// Finds which way each of the vertices at one place goes; what is held does not.
    fn find_ways(&mut self, world: &World, vertices: &[u32]) {
        let first = self.ways.len();
        self.ways.extend(vertices.iter().map(|_| Vec3::ZERO));
        if vertices.len() < 2 {
            return;
        }
        let hair = self.find_wedges(world, vertices);
        self.find_partings();
        let w = |copy: usize| world.particles.w[vertices[copy] as usize];
        let ways = &mut self.ways[first..];
        for round in 0..ROUNDS {
            let mut is_done = true;
            for parting in &self.partings {
                let [one, other] = parting.copies;
                let (way, sum) = (ways[one] - ways[other], w(one) + w(other));
                let n = if round == 0 { parting.clearest() } else { parting.farthest(way) };
                let missing = hair - n.dot(way);
                if missing > MISSING * hair && sum > 0.0 {
                    ways[one] += n * (missing * w(one) / sum);
                    ways[other] -= n * (missing * w(other) / sum);
                    is_done = false;
                }
            }
            if is_done {
                break;
            }
        }
        // All by the same share, so that nothing gets momentum.
        let farthest = ways.iter().map(|way| way.length()).fold(0.0, crate::math::max);
        let share = min(1.0, FAR * hair / (farthest + TINY));
        ways.iter_mut().for_each(|way| *way *= share);
    }

    /// Finds the triangles of vertices at one place, and how far they are to part [m].
    fn find_wedges(&mut self, world: &World, vertices: &[u32]) -> f32 {
        let (mesh, x) = (&world.mesh, &world.particles.x);
        let mut hair = world.mean_edge * HAIR;
        self.wedges.clear();
        for (copy, vertex) in vertices.iter().enumerate() {
            mesh.gather_fan(mesh.corner_of[*vertex as usize], &mut self.fan);
            let at = x.at(*vertex as usize);
            for corner in &self.fan.corners {
                let edges = [next_corner(*corner), prev_corner(*corner)].map(|end| {
                    let edge = x.at(mesh.vertex(end) as usize) - at;
                    let length = edge.length();
                    hair = min(hair, length * SHORT);
                    edge * (1.0 / (length + TINY))
                });
                self.wedges.push(Wedge { copy, edges });
            }
        }
        hair
    }

    /// Finds what parts each triangle from each of the other copies.
    fn find_partings(&mut self) {
        self.partings.clear();
        for (at, one) in self.wedges.iter().enumerate() {
            for other in self.wedges[at + 1..].iter().filter(|other| other.copy != one.copy) {
                let parting = Parting::new(one, other);
                if parting.count > 0 {
                    self.partings.push(parting);
                }
            }
        }
    }
}

impl Parting {
    fn new(one: &Wedge, other: &Wedge) -> Self {
        let copies = [one.copy, other.copy];
        let mut parting = Self { copies, along: [(0.0, Vec3::ZERO); LOOKS], count: 0 };
        let ([a, b], [c, d]) = (one.edges, other.edges);
        let sides = [one.edges, other.edges];
        // Beside an edge that was one, from the one triangle to the other: so at both of its ends.
        for (edge, inner) in [(a, b), (b, a)] {
            for (same, beyond) in [(c, d), (d, c)] {
                if edge == same {
                    parting.look(sides, across(edge, inner) - across(edge, beyond));
                }
            }
        }
        if parting.count > 0 {
            return parting;
        }
        parting.look(sides, a + b - c - d);
        for normal in [a.cross(b), c.cross(d), a.cross(c), a.cross(d), b.cross(c), b.cross(d)] {
            parting.look(sides, normal);
            parting.look(sides, -normal);
        }
        parting
    }

    /// Adds a direction if it tells the sides apart.
    fn look(&mut self, [[a, b], [c, d]]: [[Vec3; 2]; 2], way: Vec3) {
        let length = way.length();
        if length < SHORTEST {
            return;
        }
        let n = way * (1.0 / length);
        let clear = min(min(n.dot(a), n.dot(b)), min(-n.dot(c), -n.dot(d)));
        if clear > -HARDLY {
            self.along[self.count] = (clear, n);
            self.count += 1;
        }
    }

    /// The direction that edges lead farthest away from.
    fn clearest(&self) -> Vec3 {
        first_most(self.along[..self.count].iter().copied())
    }

    /// The direction that a way leads farthest along.
    fn farthest(&self, way: Vec3) -> Vec3 {
        first_most(self.along[..self.count].iter().map(|(_, n)| (n.dot(way), *n)))
    }
}

/// Where an edge leads away from another one, a unit long.
fn across(edge: Vec3, other: Vec3) -> Vec3 {
    let across = other - edge * other.dot(edge);
    across * (1.0 / (across.length() + TINY))
}

/// The vector with the greatest number; of equals the first.
fn first_most(all: impl Iterator<Item = (f32, Vec3)>) -> Vec3 {
    all.fold((f32::MIN, Vec3::ZERO), |most, next| if next.0 > most.0 { next } else { most }).1
}

/// Parts those of `vertices` that are at the same place since one of them was split. Momentum stays.
pub(crate) fn part(world: &mut World, vertices: impl Iterator<Item = u32>) {
    let Some(mut layers) = world.surface_collision.take() else {
        return;
    };
    let slits = &mut layers.slits;
    let mut copies = core::mem::take(&mut slits.copies);
    copies.clear();
    copies.extend(vertices);
    let (sources, x) = (&world.mesh.source, &world.particles.x);
    let place = |vertex: u32| {
        let bits = x.at(vertex as usize).to_array().map(f32::to_bits);
        (sources[vertex as usize], bits)
    };
    sort_by(&mut copies, |a, b| (place(*a), *a).cmp(&(place(*b), *b)));
    copies.dedup();
    // All ways before anything moves.
    slits.ways.clear();
    for vertices in copies.chunk_by(|a, b| place(*a) == place(*b)) {
        slits.find_ways(world, vertices);
    }
    let ways = core::mem::take(&mut slits.ways);
    world.surface_collision = Some(layers);
    if ways.iter().any(|way| *way != Vec3::ZERO) {
        // What else is near gives way.
        crate::solver::self_collide::surface::begin(world);
        for (vertex, way) in copies.iter().zip(&ways) {
            world.particles.x.add(*vertex as usize, *way);
            world.particles.x_prev_tick.add(*vertex as usize, *way);
        }
        crate::solver::self_collide::surface::follow(world);
        crate::solver::self_collide::surface::hold(world);
    }
    if let Some(layers) = &mut world.surface_collision {
        (layers.slits.copies, layers.slits.ways) = (copies, ways);
    }
}
