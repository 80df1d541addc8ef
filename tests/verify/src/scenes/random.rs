//! Scenes from random numbers: sheets and tubes, pinned, grabbed or free, over a floor, in wind,
//! among bodies of every shape that come and go and turn.
//!
//! The seed is the number in the name; `cargo xtask verify random-123` plays a scene that is not in
//! the list too. A body that would leave the cloth no room (beside another body, the floor, a pin or
//! a grab) is left out: no solver could keep the guarantees there.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{box_mesh, capsule, cuboid, floor, round_mesh, sphere, tube};
use muslin::glam::{Quat, Vec3};
use muslin::{
    Cloth, ColliderDesc, GridDesc, Material, MeshDesc, PinMode, Preset, Result, SelfCollision,
    Settings, Shape, Wind,
};
use std::f32::consts::TAU;

/// The first seeds, which are in the list.
const SEEDS: u32 = 48;
/// More seeds in the list: a corner of a mesh that cloth slid over once pierced a triangle (110), or was
/// taken to have passed through the triangle beside it (140), a box ended deep in a triangle that an
/// impact overstretched (186, 288), and indices of contacts that were out of date made the library panic
/// (475).
const MORE_SEEDS: [u32; 5] = [110, 140, 186, 288, 475];
const TICKS: u32 = 90;
/// Length of a tick [s].
const TICK: f32 = 1.0 / 60.0;
/// Room that must be left between two bodies, or a body and something held [m].
const ROOM: f32 = 0.04;

pub fn scenes() -> Vec<Scene> {
    let short = (0..3).chain(MORE_SEEDS).map(|seed| scene(seed).short(TICKS));
    short.chain((3..SEEDS).map(scene)).collect()
}

/// Returns the scene that is named `random-` and a number.
pub fn named(name: &str) -> Option<Scene> {
    name.strip_prefix("random-").and_then(|seed| seed.parse().ok()).map(scene)
}

fn scene(seed: u32) -> Scene {
    Scene::new(format!("random-{seed}"), TICKS, move || random(&mut Random::new(seed)))
}

/// Random numbers: SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014).
struct Random(u64);

impl Random {
    fn new(seed: u32) -> Self {
        Self(u64::from(seed))
    }

    /// A number from 0 to 1, without 1.
    fn share(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u64 << 24) as f32
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.share()
    }

    /// A number from 0 to `count`, without `count`.
    fn index(&mut self, count: u32) -> u32 {
        (self.share() * count as f32) as u32
    }

    fn is_true(&mut self, probability: f32) -> bool {
        self.share() < probability
    }

    fn pick<T: Copy, const N: usize>(&mut self, of: [T; N]) -> T {
        of[self.index(N as u32) as usize]
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::from([0; 3].map(|_| self.between(-1.0, 1.0)));
            if v.length() > 0.1 && v.length() < 1.0 {
                return v.normalize();
            }
        }
    }
}

/// A point that goes to and fro, and a rotation that does.
#[derive(Clone, Copy, Debug)]
struct Path {
    start: Vec3,
    way: Vec3,
    /// Times per second that it comes and goes.
    rate: f32,
    axis: Vec3,
    angle: f32,
    spin_rate: f32,
    /// Radius of a sphere around the start of what moves [m].
    radius: f32,
}

impl Path {
    fn still(start: Vec3, radius: f32) -> Self {
        let (way, axis) = (Vec3::ZERO, Vec3::Y);
        Self { start, way, rate: 0.0, axis, angle: 0.0, spin_rate: 0.0, radius }
    }

    fn position(&self, tick: u32) -> Vec3 {
        self.start + self.way * share(self.rate, tick)
    }

    fn rotation(&self, tick: u32) -> Quat {
        Quat::from_axis_angle(self.axis, self.angle * share(self.spin_rate, tick))
    }

    /// Whether the two leave room between them all the time.
    fn leaves_room(&self, other: &Self) -> bool {
        let least = self.radius + other.radius + ROOM;
        (0..=TICKS + 1).all(|tick| self.position(tick).distance(other.position(tick)) > least)
    }
}

/// Returns the share of its way that a point has gone, which comes and goes `rate` times per second.
fn share(rate: f32, tick: u32) -> f32 {
    0.5 - 0.5 * (TAU * rate * tick as f32 * TICK).cos()
}

fn random(random: &mut Random) -> Result<Setup> {
    let mut play = Play::new(cloth(random)?);
    let x = play.cloth.positions();
    let (low, high) = (x.iter().copied().reduce(Vec3::min), x.iter().copied().reduce(Vec3::max));
    let (low, high) = (low.unwrap_or_default(), high.unwrap_or_default());
    let mut held: Vec<Path> = play
        .cloth
        .pinned()
        .filter_map(|i| play.cloth.position(i))
        .map(|x| Path::still(x, 0.0))
        .collect();
    let ground = random.is_true(0.5).then(|| low.y - random.between(0.02, 0.3));
    if let Some(height) = ground {
        play.add(floor(height))?;
    }
    let grabbed = random.is_true(0.4).then(|| random.index(play.cloth.particle_count()));
    let grabbed = grabbed.filter(|i| !play.cloth.pinned().any(|pinned| pinned == *i));
    if let Some(particle) = grabbed {
        play.grab(particle)?;
        let start = play.cloth.position(particle).unwrap_or_default();
        // A way that stretches nothing: no farther from any pin than at rest, and not downwards.
        let is_reachable = |way: &Vec3| {
            let rest = |pin: &Path| start.distance(pin.start);
            way.y >= 0.0 && held.iter().all(|pin| (start + *way).distance(pin.start) <= rest(pin))
        };
        let ways = [0; 20].map(|_| random.direction() * random.between(0.05, 0.3));
        let way = ways.into_iter().find(is_reachable).unwrap_or_default();
        let rate = random.between(0.3, 2.0);
        held.push(Path { way, rate, ..Path::still(start, 0.0) });
    }
    let mut paths: Vec<Path> = Vec::new();
    for _ in 0..=random.index(4) {
        let desc = body(random);
        for _ in 0..40 {
            let path = path(random, &desc, low, high);
            let is_clear = |x: &Vec3| x.distance(path.start) > path.radius + ROOM;
            let lowest = path.start.y + path.way.y.min(0.0) - path.radius;
            if play.cloth.positions().iter().all(is_clear)
                && ground.is_none_or(|height| lowest > height + ROOM)
                && held.iter().chain(&paths).all(|other| path.leaves_room(other))
            {
                play.add(ColliderDesc { position: path.start, ..desc })?;
                paths.push(path);
                break;
            }
        }
    }
    if random.is_true(0.3) {
        let velocity = random.direction() * random.between(1.0, 8.0);
        play.cloth.set_wind(Wind { velocity, gust: random.share(), ..Wind::default() })?;
    }
    let first = usize::from(ground.is_some());
    let grab = grabbed.and(held.last().copied());
    Ok(Setup::from(play).drive(move |play, tick| {
        for (index, path) in paths.iter().enumerate() {
            play.move_body(first + index, path.position(tick + 1), path.rotation(tick + 1))?;
        }
        match (grab, play.grabs.first()) {
            (Some(path), Some((grab, _))) => play.cloth.move_grab(*grab, path.position(tick + 1)),
            _ => Ok(()),
        }
    }))
}

fn cloth(random: &mut Random) -> Result<Cloth> {
    let settings = Settings {
        self_collision: random.pick([SelfCollision::None, SelfCollision::Surface]),
        max_stretch: random.pick([0.0, 0.0, 0.02, 0.05, 0.1]),
        ..Settings::default()
    };
    let preset = random.pick([
        Preset::Silk,
        Preset::Cotton,
        Preset::Denim,
        Preset::Leather,
        Preset::Paper,
        Preset::FlagNylon,
    ]);
    let material = Material::preset(preset);
    if random.is_true(0.25) {
        let (around, rings) = (16 + random.index(20), 8 + random.index(12));
        let (radius, flare, height) =
            (random.between(0.12, 0.25), random.between(0.0, 0.15), random.between(0.2, 0.5));
        let mut desc: MeshDesc = tube(around, rings, |ring| {
            let share = ring as f32 / (rings - 1) as f32;
            (radius + flare * share, -height * share)
        });
        desc.pinned = (0..around).collect();
        return Cloth::mesh(&MeshDesc { settings, material, ..desc });
    }
    let (columns, rows) = (10 + random.index(18), 10 + random.index(18));
    let spacing = random.between(0.4, 0.9) / (columns.max(rows) - 1) as f32;
    let [width, height] = [columns, rows].map(|n| spacing * (n - 1) as f32);
    let is_level = random.is_true(0.4);
    Cloth::grid(&GridDesc {
        columns,
        rows,
        spacing,
        origin: Vec3::new(-0.5 * width, 0.0, if is_level { -0.5 * height } else { 0.0 }),
        down: if is_level { Vec3::Z } else { Vec3::NEG_Y },
        pin_mode: random.pick([
            PinMode::None,
            PinMode::TopEdge,
            PinMode::TopCorners,
            PinMode::Corners,
        ]),
        settings,
        material,
        ..GridDesc::default()
    })
}

/// A body at the origin.
fn body(random: &mut Random) -> ColliderDesc {
    let size = random.between(0.015, 0.2);
    let shape = random.index(5);
    let [a, b] = [0; 2].map(|_| random.between(0.4, 1.0));
    let mut desc = match shape {
        0 => sphere(size, Vec3::ZERO),
        1 => capsule(size * a, size * 1.5 * b, Vec3::ZERO),
        2 => cuboid(size * Vec3::new(1.0, a, b), Vec3::ZERO),
        3 => box_mesh(size * Vec3::new(1.0, a, b), 1 + random.index(4)),
        _ => round_mesh(6 + random.index(10), 8 + random.index(16), |_, _| {
            size * Vec3::new(1.0, a, b)
        }),
    };
    desc.friction = random.pick([0.0, 0.3, 0.8]);
    if random.is_true(0.3) {
        desc.thickness = random.between(0.0, 0.012);
    }
    desc
}

/// A way for a body among cloth between `low` and `high`.
fn path(random: &mut Random, desc: &ColliderDesc, low: Vec3, high: Vec3) -> Path {
    let radius = match desc.shape {
        Shape::Sphere => desc.radius,
        Shape::Capsule => desc.radius + desc.half_height,
        Shape::Box => desc.half_extents.length(),
        _ => desc.positions.iter().map(|x| x.length()).fold(0.0, f32::max),
    };
    let (low, high) = (low - (radius + 0.2), high + (radius + 0.2));
    let mut place = || {
        let share = Vec3::from([0; 3].map(|_| random.share()));
        low + (high - low) * share
    };
    let (start, target) = (place(), place());
    let way = target - start;
    // The greatest speed is π times way times rate.
    let speed = 0.1 * 60.0_f32.powf(random.share());
    let rate = (speed / (0.5 * TAU * way.length().max(0.01))).min(4.0);
    let (axis, angle) = (random.direction(), random.pick([0.0, 1.0, 3.0]));
    Path { start, way, rate, axis, angle, spin_rate: random.between(0.2, 2.0), radius }
}
