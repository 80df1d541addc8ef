//! Colliders, non-crossing and the stretch bound hold together, not only one at a time.
//!
//! The cases come from trials in which each guarantee held alone and broke beside another one.

use crate::common::crossings::crossing_count;
use crate::common::shapes::tube;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Shape, Wind};

/// Depth below y = 0 that counts as penetration [m].
const TOLERANCE: f32 = 1.0e-4;

fn lowest(cloth: &Cloth) -> f32 {
    cloth.positions().iter().map(|p| p.y).fold(f32::MAX, f32::min)
}

#[test]
fn a_strip_that_folds_onto_itself_stays_above_the_floor() {
    let (sin, cos) = 10.0_f32.to_radians().sin_cos();
    let mut desc = GridDesc {
        columns: 2,
        rows: 51,
        spacing: 0.01,
        origin: Vec3::new(0.0, 0.6, 0.0),
        right: Vec3::new(sin, 0.0, cos),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&ColliderDesc::default()).unwrap();
    for tick in 0..200 {
        cloth.step(1);
        assert!(lowest(&cloth) > -TOLERANCE, "tick {tick}: {} m", lowest(&cloth));
    }
    assert_eq!(crossing_count(&cloth), 0);
}

#[test]
fn a_sheet_that_crumples_on_the_floor_stays_above_it_without_crossing_itself() {
    let spacing = 2.0 / 31.0;
    let mut desc = GridDesc {
        columns: 32,
        rows: 32,
        spacing,
        origin: Vec3::new(-1.0, 2.05, 0.0),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.add_collider(&ColliderDesc::default()).unwrap();
    for i in 0..cloth.particle_count() {
        let p = cloth.position(i).unwrap();
        let v = 0.3 * (7.0 * p.x + 1.0).sin() * (5.0 * p.y + 2.0).sin();
        cloth.set_velocity(i, Vec3::new(0.0, 0.0, v)).unwrap();
    }
    for tick in 0..150 {
        cloth.step(1);
        assert!(lowest(&cloth) > -TOLERANCE, "tick {tick}: {} m", lowest(&cloth));
        if tick % 25 == 24 {
            assert_eq!(crossing_count(&cloth), 0, "tick {tick}");
        }
    }
}

#[test]
fn a_hung_sheet_that_is_dropped_on_the_floor_stays_above_it() {
    let mut desc = GridDesc { columns: 24, rows: 24, ..GridDesc::default() };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = lowest(&cloth) - 0.05;
    let position = Vec3::new(0.0, floor, 0.0);
    cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).unwrap();
    cloth.step(30);
    cloth.unpin_all();
    for tick in 0..90 {
        cloth.step(1);
        let depth = floor - lowest(&cloth);
        assert!(depth < TOLERANCE, "tick {tick}: {depth} m deep");
    }
}

#[test]
fn stretch_past_the_bound_is_reported_when_self_collision_causes_it() {
    let mut desc = GridDesc {
        columns: 2,
        rows: 8,
        spacing: 0.025,
        pin_mode: PinMode::None,
        ..GridDesc::default()
    };
    desc.settings.max_stretch = 0.05;
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let attachment = cloth.attach(&[0, 1], Vec3::ZERO, Quat::IDENTITY).unwrap();
    let mut x = 0.0;
    for tick in 0..300 {
        x += if (tick / 15) % 2 == 0 { 0.05 } else { -0.05 };
        cloth.move_attachment(attachment, Vec3::new(x, 0.0, 0.0), Quat::IDENTITY).unwrap();
        cloth.step(1);
        let stats = cloth.stats();
        let holds = stats.max_stretch <= 0.0501;
        assert!(holds || stats.over_stretched > 0, "tick {tick}: {}", stats.max_stretch);
    }
}

#[test]
fn a_sheet_in_wind_keeps_its_stretch_bound_with_surface_collision() {
    let mut desc = GridDesc { columns: 20, rows: 20, ..GridDesc::default() };
    desc.settings.max_stretch = 0.02;
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.set_wind(Wind { velocity: Vec3::new(0.0, 0.0, 8.0), ..Wind::default() }).unwrap();
    for tick in 0..180 {
        cloth.step(1);
        let stats = cloth.stats();
        assert!(stats.max_stretch <= 0.0201, "tick {tick}: {}", stats.max_stretch);
    }
}

#[test]
fn a_fast_ball_carries_a_free_sheet_along_whatever_else_holds() {
    for speed in [3.0, 5.0, 15.0] {
        for max_stretch in [0.0, 0.05] {
            for self_collision in [SelfCollision::None, SelfCollision::Surface] {
                let mut desc = GridDesc {
                    columns: 20,
                    rows: 20,
                    spacing: 0.1,
                    origin: Vec3::new(-0.95, 0.95, 0.0),
                    pin_mode: PinMode::None,
                    ..GridDesc::default()
                };
                desc.settings.gravity = Vec3::ZERO;
                desc.settings.max_stretch = max_stretch;
                desc.settings.self_collision = self_collision;
                let mut cloth = Cloth::grid(&desc).unwrap();
                let mut center = Vec3::new(0.0, 0.0, -0.5);
                let ball = cloth
                    .add_collider(&ColliderDesc {
                        shape: Shape::Sphere,
                        radius: 0.3,
                        position: center,
                        ..ColliderDesc::default()
                    })
                    .unwrap();
                for tick in 0..18 {
                    center.z += speed / 60.0;
                    cloth.move_collider(ball, center, Quat::IDENTITY).unwrap();
                    cloth.step(1);
                    let nearest = cloth.positions().iter().map(|p| p.distance(center));
                    let depth = 0.3 - nearest.fold(f32::MAX, f32::min);
                    assert!(
                        depth < TOLERANCE,
                        "{speed} m/s, bound {max_stretch}, {self_collision:?}, tick {tick}: {depth} m"
                    );
                }
                let is_ahead = |p: &&Vec3| p.z > center.z;
                let ahead = cloth.positions().iter().filter(is_ahead).count();
                assert!(
                    ahead > 20,
                    "{speed} m/s, bound {max_stretch}, {self_collision:?}: {ahead}"
                );
            }
        }
    }
}

#[test]
fn a_skirt_over_legs_that_spread_wider_than_its_hem_stretches_no_more_than_they_force_it_to() {
    // A radius of 0.15 m at the waist, at y = 0, and of 0.3 m at the hem.
    let (positions, indices) = tube(64, 26, 0.15, [-0.5, 0.0]);
    let widened = |x: Vec3| Vec3::new(x.x * (1.0 - 2.0 * x.y), x.y, x.z * (1.0 - 2.0 * x.y));
    let positions: Vec<Vec3> = positions.into_iter().map(widened).collect();
    let pinned = (0..positions.len() as u32).filter(|i| positions[*i as usize].y == 0.0).collect();
    let mut desc = MeshDesc { positions, indices, pinned, ..MeshDesc::default() };
    desc.settings.max_stretch = 0.05;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let pose = |side: f32, angle: f32| {
        let rotation = Quat::from_rotation_x(side * angle);
        (Vec3::X * (0.075 * side) + rotation * Vec3::NEG_Y * 0.28, rotation)
    };
    let legs = [-1.0, 1.0].map(|side| {
        let (position, rotation) = pose(side, 0.0);
        let (shape, radius, half_height) = (Shape::Capsule, 0.08, 0.2);
        let desc =
            ColliderDesc { shape, radius, half_height, position, rotation, ..Default::default() };
        (side, cloth.add_collider(&desc).unwrap())
    });
    let (mut greatest, mut reported) = (0.0_f32, 0);
    for tick in 1..=30 {
        let angle =
            44.0_f32.to_radians() * (std::f32::consts::TAU * 2.5 * tick as f32 / 60.0).sin();
        for (side, leg) in legs {
            let (position, rotation) = pose(side, angle);
            cloth.move_collider(leg, position, rotation).unwrap();
        }
        cloth.step(1);
        let stats = cloth.stats();
        assert!(stats.max_stretch < 0.0501 || stats.over_stretched > 0, "tick {tick}");
        greatest = greatest.max(stats.max_stretch);
        reported = reported.max(stats.over_stretched);
    }
    assert!((0.06..0.3).contains(&greatest), "stretched by {greatest}");
    assert!(reported > 0);
}
