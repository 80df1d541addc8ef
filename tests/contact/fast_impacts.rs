//! Fast impacts and moving colliders: no particle passes through, and friction carries the cloth.

use crate::common::shapes::{free_sheet, hilly_heightfield, octahedron, signed_distance};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Shape};

/// Impact speeds [m/s].
fn impact_speeds() -> [f32; 4] {
    [2.0, 5.0, 10.0, 20.0]
}

/// Throws a sheet at the collider below it, or moves the collider into the sheet, at `speed` [m/s],
/// and asserts that no particle passes through.
fn assert_no_tunnelling(desc: &ColliderDesc, speed: f32, is_cloth_moving: bool) {
    let mut cloth = Cloth::grid(&free_sheet(12, 0.4, 0.3)).unwrap();
    let handle: Collider = cloth.add_collider(desc).unwrap();
    let mut at = desc.clone();
    if is_cloth_moving {
        (0..144).for_each(|i| cloth.set_velocity(i, Vec3::NEG_Y * speed).unwrap());
    }
    for _ in 0..30 {
        if !is_cloth_moving {
            at.position.y += speed / 60.0;
            cloth.move_collider(handle, at.position, at.rotation).unwrap();
        }
        cloth.step(1);
        for x in cloth.positions() {
            let outside = signed_distance(&at, *x);
            let above = x.y - at.position.y;
            let beside = desc.shape != Shape::Plane
                && (at.rotation.inverse() * (*x - at.position)).abs().x > desc.half_extents.x;
            assert!(
                outside > -2.0e-5 && (above > 0.0 || beside),
                "at {speed} m/s a vertex is {outside} m outside, {above} m above {:?}",
                desc.shape
            );
        }
    }
}

#[test]
fn planes_and_thin_boxes_stop_particles_at_twenty_metres_per_second() {
    for speed in impact_speeds() {
        for is_cloth_moving in [true, false] {
            assert_no_tunnelling(&ColliderDesc::default(), speed, is_cloth_moving);
            for half in [0.00005, 0.0005, 0.0025] {
                let plate = ColliderDesc {
                    shape: Shape::Box,
                    half_extents: Vec3::new(1.0, half, 1.0),
                    ..Default::default()
                };
                assert_no_tunnelling(&plate, speed, is_cloth_moving);
            }
        }
    }
}

#[test]
fn every_collider_shape_stops_particles_at_twenty_metres_per_second() {
    // Each is wider than the sheet, so a particle below it has passed through.
    let flat = |half: f32| {
        let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|z| Vec3::new(x, 0.0, z)));
        let plates =
            [half, -half].map(|y| corners.as_flattened().iter().map(move |x| *x + Vec3::Y * y));
        ColliderDesc {
            shape: Shape::Convex,
            positions: plates.into_iter().flatten().collect(),
            half_extents: Vec3::ONE,
            ..Default::default()
        }
    };
    let two_triangles = ColliderDesc {
        shape: Shape::Mesh,
        positions: vec![
            Vec3::new(-1.0, 0.0, -1.0),
            Vec3::new(-1.0, 0.0, 1.0),
            Vec3::new(1.0, 0.0, 1.0),
            Vec3::new(1.0, 0.0, -1.0),
        ],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Default::default()
    };
    for speed in impact_speeds() {
        for is_cloth_moving in [true, false] {
            for desc in
                [&flat(0.001), &two_triangles, &hilly_heightfield(20, 2.0), &octahedron(1.5)]
            {
                let mut cloth = Cloth::grid(&free_sheet(12, 0.4, 1.7)).unwrap();
                let handle = cloth.add_collider(desc).unwrap();
                if is_cloth_moving {
                    (0..144).for_each(|i| cloth.set_velocity(i, Vec3::NEG_Y * speed).unwrap());
                }
                let mut at = desc.clone();
                for _ in 0..40 {
                    if !is_cloth_moving {
                        at.position.y += speed / 60.0;
                        cloth.move_collider(handle, at.position, at.rotation).unwrap();
                    }
                    cloth.step(1);
                    for x in cloth.positions() {
                        let beside = (*x - at.position).with_y(0.0).abs().max_element() > 0.98;
                        let up = if desc.shape == Shape::Mesh {
                            x.y - at.position.y
                        } else {
                            signed_distance(&at, *x)
                        };
                        assert!(up > -1.0e-4 || beside, "{:?} at {speed} m/s: {up} m", desc.shape);
                    }
                }
            }
        }
    }
}

#[test]
fn a_fast_sphere_smaller_than_a_cell_pushes_the_sheet() {
    for speed in impact_speeds() {
        let mut cloth = Cloth::grid(&free_sheet(9, 0.8, 0.3)).unwrap();
        cloth
            .set_settings(muslin::Settings { gravity: Vec3::ZERO, ..cloth.settings().clone() })
            .unwrap();
        let radius = 0.03;
        let desc = ColliderDesc {
            shape: Shape::Sphere,
            radius,
            position: Vec3::new(0.02, 0.0, 0.03),
            ..Default::default()
        };
        let ball: Collider = cloth.add_collider(&desc).unwrap();
        let mut at = desc.position;
        while at.y < 0.8 {
            at.y += speed / 60.0;
            cloth.move_collider(ball, at, Quat::IDENTITY).unwrap();
            cloth.step(1);
            // If the ball has not passed through, some vertex is above it.
            let highest = cloth.positions().iter().map(|x| x.y).fold(f32::NEG_INFINITY, f32::max);
            assert!(highest > at.y, "{speed} m/s: ball at {} m, sheet at most {highest} m", at.y);
        }
    }
}

#[test]
fn a_swinging_plate_does_not_pass_through_the_sheet() {
    let mut cloth = Cloth::grid(&free_sheet(12, 0.4, 0.0)).unwrap();
    cloth
        .set_settings(muslin::Settings { gravity: Vec3::ZERO, ..cloth.settings().clone() })
        .unwrap();
    // It turns by 0.25 rad per tick about an axis 0.65 m away: about 10 m/s at the sheet.
    let pivot = Vec3::X * -0.65;
    let plate = |angle: f32| {
        let rotation = Quat::from_rotation_z(angle);
        (pivot + rotation * Vec3::X * 0.65, rotation)
    };
    let (position, rotation) = plate(-1.0);
    let desc = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(0.6, 0.002, 0.6),
        position,
        rotation,
        ..Default::default()
    };
    let racket = cloth.add_collider(&desc).unwrap();
    for i in 1..=10 {
        let (position, rotation) = plate(-1.0 + i as f32 * 0.25);
        cloth.move_collider(racket, position, rotation).unwrap();
        cloth.step(1);
        for x in cloth.positions() {
            let local = rotation.inverse() * (*x - position);
            let beside = local.x.abs() > 0.6 || local.z.abs() > 0.6;
            assert!(local.y > 0.0 || beside, "tick {i}: {local}");
        }
    }
}

#[test]
fn friction_makes_a_sheet_turn_with_a_turntable() {
    let mut cloth = Cloth::grid(&free_sheet(12, 0.3, 0.001)).unwrap();
    cloth.set_material(muslin::Material { friction: 1.0, ..cloth.material().clone() }).unwrap();
    let desc = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(1.0, 0.1, 1.0),
        position: Vec3::Y * -0.1,
        ..Default::default()
    };
    let table = cloth.add_collider(&desc).unwrap();
    cloth.step(30);
    let before = cloth.positions().to_vec();
    // 1 rad/s is slow enough for friction to carry the sheet.
    for i in 1..=60 {
        let turn = Quat::from_rotation_y(i as f32 / 60.0);
        cloth.move_collider(table, desc.position, turn).unwrap();
        cloth.step(1);
    }
    let turned = Quat::from_rotation_y(1.0);
    let slip =
        cloth.positions().iter().zip(&before).map(|(now, then)| (*now - turned * *then).length());
    let most = slip.fold(0.0, f32::max);
    assert!(most < 2.0e-3, "the sheet slipped by {most} m");
}
