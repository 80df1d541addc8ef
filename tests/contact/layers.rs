//! Clothes in layers: a cloth that collides with another one, and both as one cloth.

use crate::common::crossings::{crossing_count, crossings_between};
use crate::common::shapes::{Tube, free_sheet, swung, tube};
use muslin::glam::Vec3;
use muslin::{
    Cloth, Collider, ColliderDesc, Error, GridDesc, Material, MeshDesc, SelfCollision, Settings,
    Shape,
};
use std::f32::consts::TAU;

const TICK: f32 = 1.0 / 60.0;

/// Vertices around and rows of a skirt.
const SKIRT: [u32; 2] = [40, 20];

/// A tube of cloth that is pinned from `waist` upwards.
fn skirt(radius: f32, ends: [f32; 2], waist: f32) -> MeshDesc {
    let [around, rows] = SKIRT;
    let (positions, indices) = tube(around, rows, radius, ends);
    let pinned = (0..around * rows).filter(|v| positions[*v as usize].y > waist).collect();
    MeshDesc { positions, indices, pinned, ..MeshDesc::default() }
}

/// A leg of 40 x 50 vertices, which kicks to and fro once a second.
struct Leg {
    rest: Vec<Vec3>,
    indices: Vec<u32>,
}

impl Leg {
    fn new() -> Self {
        let (rest, indices) = tube(40, 50, 0.15, [-0.6, 0.6]);
        Self { rest, indices }
    }

    fn add_to(&self, cloth: &mut Cloth) -> Collider {
        let desc = ColliderDesc {
            shape: Shape::Mesh,
            positions: self.rest.clone(),
            indices: self.indices.clone(),
            ..ColliderDesc::default()
        };
        cloth.add_collider(&desc).unwrap()
    }

    fn at(&self, tick: u32) -> Vec<Vec3> {
        let time = tick as f32 * TICK;
        swung(&self.rest, 25.0_f32.to_radians() * time.min(1.0) * (TAU * time).sin())
    }
}

/// Runs one tick of both cloths, the inner one first.
fn step_layers(inner: &mut Cloth, outer: &mut Cloth, layer: &mut Option<Collider>) {
    inner.step(1);
    *layer = Some(outer.collide_with(inner, *layer).unwrap());
    outer.step(1);
}

/// A sheet whose particles are all pinned.
fn held_sheet(nodes: u32, width: f32, height: f32) -> Cloth {
    let mut cloth = Cloth::grid(&free_sheet(nodes, width, height)).unwrap();
    (0..cloth.particle_count()).for_each(|i| cloth.pin(i, None).unwrap());
    cloth
}

/// Sets the targets of all pins to the rest positions, each moved by `shift` of it.
fn move_pins(cloth: &mut Cloth, shift: &dyn Fn(Vec3) -> Vec3) {
    let particles: Vec<u32> = (0..cloth.particle_count()).collect();
    let targets: Vec<Vec3> = cloth.rest_positions().map(|x| x + shift(x)).collect();
    cloth.set_pin_targets(&particles, &targets).unwrap();
}

/// The least height of a particle of a sheet over another one, whose height depends on x only [m].
fn least_height(outer: &Cloth, inner: &Cloth, columns: usize) -> f32 {
    let line = &inner.positions()[..columns];
    let height = |x: &Vec3| {
        let at = line.partition_point(|p| p.x < x.x).clamp(1, columns - 1);
        let (a, b) = (line[at - 1], line[at]);
        x.y - (a.y + (b.y - a.y) * (x.x - a.x) / (b.x - a.x))
    };
    outer.positions().iter().map(height).fold(f32::INFINITY, f32::min)
}

#[test]
fn a_sheet_stays_above_another_one_that_waves() {
    let mut inner = held_sheet(25, 0.72, 0.0);
    let mut outer = Cloth::grid(&free_sheet(12, 0.33, 0.02)).unwrap();
    let mut layer = None;
    for tick in 1..=180 {
        let time = tick as f32 * TICK;
        let wave = |x: Vec3| {
            let height = 0.03 * time.min(1.0) * (TAU * (x.x / 0.36 - 1.5 * time)).sin();
            Vec3::Y * height
        };
        move_pins(&mut inner, &wave);
        step_layers(&mut inner, &mut outer, &mut layer);
        let height = least_height(&outer, &inner, 25);
        let crossings = crossings_between(&inner, &outer);
        assert!(height > 0.0 && crossings == 0, "tick {tick}: {height} m, {crossings} crossings");
    }
    let mean = outer.positions().iter().map(|x| x.y).sum::<f32>() / 144.0;
    assert!(mean < 0.035, "the outer sheet lies on the inner one: {mean} m");
    let push = -outer.collider_impulse(layer.unwrap()).unwrap().linear.y;
    assert!(push > 0.0, "{push} N·s");
}

#[test]
fn an_inner_sheet_that_tears_in_fast_motion_lets_nothing_through() {
    let mut inner = held_sheet(16, 0.6, 0.0);
    let mut outer = Cloth::grid(&free_sheet(10, 0.3, 0.01)).unwrap();
    let first = outer.collide_with(&inner, None).unwrap();
    let mut layer = Some(first);
    for tick in 1..=12 {
        // 6 m/s: ten times the distance of both per tick.
        let height = 0.1 * tick as f32;
        if tick >= 4 {
            let a = 16 * 7 + tick - 4;
            inner.unpin(a).unwrap();
            assert!(inner.tear_edge(a, a + 1).unwrap());
            (0..inner.particle_count()).for_each(|i| inner.pin(i, None).unwrap());
        }
        move_pins(&mut inner, &|_| Vec3::Y * height);
        step_layers(&mut inner, &mut outer, &mut layer);
        assert_eq!(layer, Some(first), "the handle stays");
        let lowest = outer.positions().iter().map(|x| x.y).fold(f32::INFINITY, f32::min);
        assert!(lowest > height, "tick {tick}: {lowest} m, the inner sheet at {height} m");
        assert_eq!(crossings_between(&inner, &outer), 0, "tick {tick}");
    }
    assert!(inner.particle_count() == 256 + 9, "{} particles", inner.particle_count());
}

#[test]
fn an_outer_sheet_falls_with_a_half_that_is_cut_off_the_inner_one() {
    let mut inner = held_sheet(16, 0.6, 0.0);
    let mut desc = free_sheet(5, 0.1, 0.002);
    desc.origin.z += 0.15;
    let mut outer = Cloth::grid(&desc).unwrap();
    let mut layer = None;
    (0..30).for_each(|_| step_layers(&mut inner, &mut outer, &mut layer));
    let lowest = |cloth: &Cloth| cloth.positions().iter().map(|x| x.y).fold(1.0, f32::min);
    assert!(lowest(&outer) > 0.0);
    inner.cut(Vec3::new(-0.4, -0.1, 0.013), Vec3::new(0.4, -0.1, -0.017), Vec3::Y * 0.2).unwrap();
    assert_eq!(inner.stats().pieces, 2);
    for i in 0..inner.particle_count() {
        if inner.position(i).unwrap().z > 0.02 {
            inner.unpin(i).unwrap();
        }
    }
    for tick in 0..40 {
        step_layers(&mut inner, &mut outer, &mut layer);
        assert_eq!(crossings_between(&inner, &outer), 0, "tick {tick}");
    }
    assert!(lowest(&inner) < -0.5 && lowest(&outer) < -0.5, "{}", lowest(&outer));
}

/// A sheet with self-collision. Between folds that cross, another layer would have no room.
fn folding_sheet(nodes: u32, width: f32, height: f32) -> Cloth {
    let mut desc = free_sheet(nodes, width, height);
    desc.settings.self_collision = SelfCollision::Surface;
    Cloth::grid(&desc).unwrap()
}

#[test]
fn two_sheets_dropped_on_a_ball_lie_on_each_other() {
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.25, ..ColliderDesc::default() };
    let mut inner = folding_sheet(24, 0.7, 0.27);
    let mut outer = folding_sheet(20, 0.6, 0.29);
    inner.add_collider(&ball).unwrap();
    let mut layer = None;
    for tick in 1..=180 {
        step_layers(&mut inner, &mut outer, &mut layer);
        assert_eq!(crossings_between(&inner, &outer), 0, "tick {tick}");
    }
    let nearest =
        |x: &Vec3| inner.positions().iter().map(|y| x.distance(*y)).fold(f32::INFINITY, f32::min);
    let farthest = outer.positions().iter().map(nearest).fold(0.0, f32::max);
    assert!(farthest < 0.06, "a part of the outer sheet is {farthest} m away");
    let top = |cloth: &Cloth| cloth.positions().iter().map(|x| x.y).fold(0.0, f32::max);
    assert!(top(&outer) > top(&inner) && top(&inner) > 0.25);
}

#[test]
fn two_skirts_on_a_leg_stay_in_order() {
    let leg = Leg::new();
    let mesh = |desc: MeshDesc| {
        let settings = Settings { self_collision: SelfCollision::Surface, ..desc.settings };
        Cloth::mesh(&MeshDesc { settings, ..desc }).unwrap()
    };
    let mut inner = mesh(skirt(0.17, [-0.35, 0.25], 0.15));
    let mut outer = mesh(skirt(0.185, [-0.25, 0.2], 0.18));
    let body = leg.add_to(&mut inner);
    let mut layer = None;
    for tick in 1..=180 {
        inner.update_collider(body, &leg.at(tick)).unwrap();
        step_layers(&mut inner, &mut outer, &mut layer);
        assert_eq!(crossings_between(&inner, &outer), 0, "tick {tick}");
    }
}

#[test]
fn two_skirts_as_one_cloth_stay_in_order() {
    let leg = Leg::new();
    let mut desc = skirt(0.17, [-0.35, 0.25], 0.15);
    let outer = skirt(0.185, [-0.25, 0.2], 0.18);
    let count = desc.positions.len() as u32;
    desc.positions.extend(outer.positions);
    desc.indices.extend(outer.indices.iter().map(|v| v + count));
    desc.pinned.extend(outer.pinned.iter().map(|v| v + count));
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let body = leg.add_to(&mut cloth);
    let indices = cloth.indices()[..cloth.indices().len() / 2].to_vec();
    for tick in 1..=180 {
        cloth.update_collider(body, &leg.at(tick)).unwrap();
        cloth.step(1);
        let (inner, outer) = cloth.positions().split_at(count as usize);
        let inner = Tube::new(inner, &indices);
        let deepest = outer.iter().map(|x| inner.depth(*x)).fold(0.0, f32::max);
        let crossings = crossing_count(&cloth);
        assert!(crossings == 0 && deepest < 2.0e-4, "tick {tick}: {crossings}, {deepest} m deep");
    }
}

#[test]
fn layers_are_half_of_each_thickness_apart_and_share_their_friction() {
    let desc = |nodes, height, thickness, friction| GridDesc {
        material: Material { thickness, friction, ..Material::default() },
        ..free_sheet(nodes, 0.03 * (nodes - 1) as f32, height)
    };
    // Slides on a slope of 0.4 with friction of 0.35, and not with 0.45, whichever layer has it.
    for (frictions, slides) in [([0.7, 0.0], true), ([0.2, 0.7], false), ([0.7, 0.2], false)] {
        let mut inner = Cloth::grid(&desc(20, 0.0, 0.014, frictions[0])).unwrap();
        let mut outer = Cloth::grid(&desc(8, 0.012, 0.006, frictions[1])).unwrap();
        let gravity = Vec3::new(0.4, -1.0, 0.0).normalize() * 9.81;
        outer.set_settings(Settings { gravity, ..outer.settings().clone() }).unwrap();
        (0..inner.particle_count()).for_each(|i| inner.pin(i, None).unwrap());
        let start = outer.mass_properties().center.x;
        let mut layer = None;
        (0..40).for_each(|_| step_layers(&mut inner, &mut outer, &mut layer));
        let path = outer.mass_properties().center.x - start;
        assert_eq!(path > 0.03, slides, "{frictions:?}: {path} m");
        let heights = outer.positions().iter().map(|x| x.y);
        let [low, high] = heights.fold([1.0_f32, 0.0_f32], |[l, h], y| [l.min(y), h.max(y)]);
        assert!(low > 0.0099 && high < 0.0105, "{low} m to {high} m");
    }
}

#[test]
fn layers_far_from_zero_move_as_near_it() {
    let run = |start: Vec3| {
        let mut desc = free_sheet(12, 0.44, 0.0);
        desc.origin += start;
        let mut inner = Cloth::grid(&desc).unwrap();
        (0..144).for_each(|i| inner.pin(i, None).unwrap());
        let mut desc = free_sheet(8, 0.24, 0.004);
        desc.origin += start;
        let mut outer = Cloth::grid(&desc).unwrap();
        let mut layer = Some(outer.collide_with(&inner, None).unwrap());
        let mut origins = Vec::new();
        for tick in 1..=360_u16 {
            // To 1.5 m/s along x, and up and down.
            let time = f32::from(tick) * TICK;
            let x = 1.5 * (time - 0.5 + 0.5 * (1.0 - time.min(1.0)).powi(2));
            let path = Vec3::new(x, 0.0625 * (6.0 * time).sin(), 0.0);
            move_pins(&mut inner, &|_| path);
            step_layers(&mut inner, &mut outer, &mut layer);
            origins.push(inner.origin());
        }
        origins.dedup();
        (outer.mass_properties().center - start, origins.len())
    };
    let (near, _) = run(Vec3::ZERO);
    let (far, origins) = run(Vec3::new(4096.0, 512.0, -2048.0));
    assert!(origins >= 3, "the origin moves along: {origins}");
    assert!(near.x > 8.0 && near.distance(far) < 0.02, "{near} and {far}");
    assert!((near.y - far.y).abs() < 1.0e-4, "{near} and {far}");
}

#[test]
fn saved_and_cloned_layers_go_on_with_the_same_bits() {
    let leg = Leg::new();
    let mut inner = Cloth::mesh(&skirt(0.17, [-0.35, 0.25], 0.15)).unwrap();
    let mut outer = Cloth::mesh(&skirt(0.185, [-0.25, 0.2], 0.18)).unwrap();
    let body = leg.add_to(&mut inner);
    let mut layer = None;
    let run = |from: u32, count: u32, cloths: [&mut Cloth; 2], layer: &mut Option<Collider>| {
        let [inner, outer] = cloths;
        for tick in from..from + count {
            inner.update_collider(body, &leg.at(tick)).unwrap();
            if tick % 5 == 0 {
                inner.tear_edge(tick, tick + SKIRT[0]).unwrap();
            }
            step_layers(inner, outer, layer);
        }
        [inner.state_hash(), outer.state_hash()]
    };
    run(0, 8, [&mut inner, &mut outer], &mut layer);
    // Between the call and the tick.
    inner.step(1);
    outer.collide_with(&inner, layer).unwrap();
    let restored = [&inner, &outer].map(|cloth| Cloth::restore(&cloth.save()).unwrap());
    let copies = [inner.clone(), outer.clone()];
    let expected = run(8, 14, [&mut inner, &mut outer], &mut layer);
    for [mut inner, mut outer] in [restored, copies] {
        let mut layer = layer;
        assert_eq!(run(8, 14, [&mut inner, &mut outer], &mut layer), expected);
    }
}

#[test]
fn a_wrong_layer_is_refused_and_changes_nothing() {
    let inner = Cloth::grid(&free_sheet(4, 0.3, 0.0)).unwrap();
    let mut outer = Cloth::grid(&free_sheet(4, 0.3, 0.1)).unwrap();
    let floor = outer.add_collider(&ColliderDesc::default()).unwrap();
    let triangle = ColliderDesc {
        shape: Shape::Mesh,
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        indices: vec![0, 1, 2],
        ..ColliderDesc::default()
    };
    let body = outer.add_collider(&triangle).unwrap();
    let layer = outer.collide_with(&inner, None).unwrap();
    let removed = outer.collide_with(&inner, None).unwrap();
    outer.remove_collider(removed).unwrap();
    let before = outer.state_hash();
    let mut refused = |inner: &Cloth, layer: Option<Collider>, text: &str| {
        let error = outer.collide_with(inner, layer).unwrap_err();
        assert_eq!((error.to_string().as_str(), outer.state_hash()), (text, before));
        error
    };
    let text = "`collider` must be one that `collide_with` returned";
    refused(&inner, Some(floor), text);
    refused(&inner, Some(body), text);
    let text = "`collider` must be a live collider of this cloth";
    let error = refused(&inner, Some(removed), text);
    assert!(matches!(error, Error::BadHandle { .. }));
    let mut far = inner.clone();
    far.set_position(7, Vec3::X * 3.0e6).unwrap();
    let text = "`other.positions[7]` must be between -1e6 and 1e6";
    for layer in [None, Some(layer)] {
        let error = refused(&far, layer, text);
        assert!(matches!(error, Error::BadEntry { .. }));
    }
    let mut point = inner.clone();
    (0..16).for_each(|i| point.set_position(i, Vec3::ONE).unwrap());
    refused(&point, None, "`collider.indices` must hold a triangle with an area");
    for _ in 0..1021 {
        outer.add_collider(&ColliderDesc::default()).unwrap();
    }
    let before = outer.state_hash();
    assert!(matches!(outer.collide_with(&inner, None), Err(Error::Full { .. })));
    assert_eq!(outer.state_hash(), before);
}
