//! Cloth far from zero moves, collides and rests as near zero.

use crate::common::crossings::crossing_pairs_at;
use core::cell::Cell;
use muslin::glam::{Affine3, DVec3, Quat, Vec3};
use muslin::{
    Attribute, Cloth, ColliderDesc, EventKind, GridDesc, Material, MeshDesc, PinMode,
    SelfCollision, Settings, Shape, Stream, VertexFormat, Wind, WriteDesc,
};

const TICK: f64 = 1.0 / 60.0;

/// A level sheet of 12 x 12 particles, 0.31 m above `center`.
fn level_sheet(center: Vec3, settings: Settings) -> GridDesc {
    GridDesc {
        columns: 12,
        rows: 12,
        origin: center + Vec3::new(-0.275, 0.31, -0.275),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        settings,
        ..GridDesc::default()
    }
}

fn sheet_on_a_sphere(x: f32, self_collision: SelfCollision) -> Cloth {
    let (center, settings) =
        (Vec3::new(x, 0.0, 0.0), Settings { self_collision, ..Settings::default() });
    let mut cloth = Cloth::grid(&level_sheet(center, settings)).unwrap();
    let sphere = ColliderDesc {
        shape: Shape::Sphere,
        position: center,
        radius: 0.3,
        ..ColliderDesc::default()
    };
    cloth.add_collider(&sphere).unwrap();
    cloth
}

/// The largest speed of a particle in the next seconds [m/s].
fn max_speed_in(seconds: u32, cloth: &mut Cloth) -> f32 {
    (0..seconds * 60).fold(0.0, |most, _| {
        cloth.step(1);
        cloth.stats().max_speed.max(most)
    })
}

fn crossing_count(cloth: &mut Cloth) -> usize {
    let positions = cloth.relative_positions().to_vec();
    crossing_pairs_at(cloth, &positions).len()
}

/// Absolute positions in f64.
fn exact_positions(cloth: &mut Cloth) -> Vec<DVec3> {
    let origin = cloth.origin().as_dvec3();
    cloth.relative_positions().iter().map(|x| origin + x.as_dvec3()).collect()
}

#[test]
fn a_sheet_rests_on_a_sphere_100_m_away_as_calmly_as_at_zero() {
    // A sheet near zero creeps for a while too, and for how long depends on where it lies.
    let speeds_at_rest = |x: f32| {
        let mut cloth = sheet_on_a_sphere(x, SelfCollision::None);
        cloth.step(600);
        let in_11th_second = max_speed_in(1, &mut cloth);
        cloth.step(1140);
        [in_11th_second, max_speed_in(10, &mut cloth)]
    };
    // 104.5 m is 0.5 m from the origin of its sheet, so it has the resolution of -0.5 m.
    let [at_zero, at_half] = [0.0, -0.5].map(speeds_at_rest);
    assert!(at_zero[0] < 1.0e-3, "{} m/s near zero in the 11th second", at_zero[0]);
    for (x, near) in [(100.0, at_zero), (104.5, at_half), (5000.0, at_zero)] {
        let far = speeds_at_rest(x);
        let is_calm = far[0] <= (1.5 * near[0]).max(1.0e-3) && far[1] <= 1.5 * near[1];
        assert!(is_calm, "{far:?} m/s at {x} m, and {near:?} m/s near zero");
    }
}

#[test]
fn a_sheet_5_km_away_does_not_cross_itself() {
    let [mut near, mut far] = [0.0, 5000.0].map(|x| sheet_on_a_sphere(x, SelfCollision::Surface));
    near.step(600);
    for tick in 0..600 {
        far.step(1);
        if tick < 120 || tick % 60 == 59 {
            assert_eq!(crossing_count(&mut far), 0, "tick {tick}");
        }
    }
    let speeds = [near, far].each_mut().map(|cloth| max_speed_in(1, cloth));
    assert!(speeds[1] <= 2.0 * speeds[0] + 1.0e-3, "{speeds:?} m/s");
}

#[test]
fn the_origin_is_zero_while_the_cloth_stays_within_16_m() {
    for x in [0.0, 10.0, -15.7] {
        let mut cloth = sheet_on_a_sphere(x, SelfCollision::None);
        cloth.step(30);
        assert_eq!(cloth.origin(), Vec3::ZERO);
        assert_eq!(cloth.positions().to_vec(), cloth.relative_positions());
    }
    let mut cloth = sheet_on_a_sphere(-100.4, SelfCollision::None);
    assert_eq!(cloth.origin(), Vec3::new(-100.0, 0.0, 0.0));
    let origin = cloth.origin();
    let absolute: Vec<Vec3> = cloth.relative_positions().iter().map(|x| origin + *x).collect();
    assert_eq!(cloth.positions(), absolute);
}

#[test]
fn a_sheet_rests_calmly_on_colliders_whose_frames_are_far_away() {
    let mesh = |x: f32| {
        let corner = |[a, y, z]: [f32; 3]| Vec3::new(x + a, y, z);
        let corners = [[0.0, 0.13, 0.0], [2.0, -0.3, 2.0], [2.0, -0.3, -2.0], [-2.0, -0.3, -2.0]];
        ColliderDesc {
            shape: Shape::Mesh,
            friction: 1.0,
            positions: corners.into_iter().chain([[-2.0, -0.3, 2.0]]).map(corner).collect(),
            indices: vec![0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1],
            ..ColliderDesc::default()
        }
    };
    let floor = |_| ColliderDesc::default();
    let slope = |_| ColliderDesc {
        rotation: Quat::from_rotation_z(0.5_f32.atan()),
        friction: 1.0,
        ..ColliderDesc::default()
    };
    let large_box = |_| ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(1.0e4, 1.0, 1.0e4),
        position: Vec3::NEG_Y,
        ..ColliderDesc::default()
    };
    let kinds: [(&dyn Fn(f32) -> ColliderDesc, f32); 4] =
        [(&floor, 0.0), (&slope, 0.5), (&large_box, 0.0), (&mesh, 0.0)];
    for (desc, rise) in kinds {
        for self_collision in [SelfCollision::None, SelfCollision::Surface] {
            let speeds = [0.0, 100.0, 5000.0].map(|x| {
                let settings = Settings { self_collision, ..Settings::default() };
                let center = Vec3::new(x, rise * x, 0.0);
                let mut cloth = Cloth::grid(&level_sheet(center, settings)).unwrap();
                cloth.add_collider(&desc(x)).unwrap();
                cloth.step(600);
                max_speed_in(1, &mut cloth)
            });
            let [at_zero, far @ ..] = speeds;
            let are_calm = far.iter().all(|speed| *speed <= 2.0 * at_zero + 2.0e-5);
            assert!(are_calm, "{:?}, {self_collision:?}: {speeds:?} m/s", desc(0.0).shape);
        }
    }
}

#[test]
fn a_floor_carries_a_sheet_far_away_as_at_zero() {
    let ride = |x: f32| {
        let sheet = level_sheet(Vec3::new(x, -0.2, 0.0), Settings::default());
        let mut cloth = Cloth::grid(&sheet).unwrap();
        let tilt = Quat::from_rotation_x(0.05);
        let floor = ColliderDesc { friction: 1.0, rotation: tilt, ..ColliderDesc::default() };
        let floor = cloth.add_collider(&floor).unwrap();
        cloth.step(120);
        let start = exact_positions(&mut cloth)[0];
        for tick in 1..=240 {
            let to = Vec3::new(0.0078125, 0.00390625, 0.0) * tick as f32;
            cloth.move_collider(floor, to, tilt).unwrap();
            cloth.step(1);
        }
        (exact_positions(&mut cloth)[0] - start).as_vec3()
    };
    let (near, far) = (ride(0.0), ride(5000.0));
    assert!((near - far).length() < 1.0e-3, "{near} m at zero, {far} m at 5 km");
}

#[test]
fn attachments_and_frames_at_zero_hold_cloth_at_5_km_in_place() {
    let mut cloth = Cloth::grid(&GridDesc {
        origin: Vec3::new(5000.0, 3.1, 0.0),
        spacing: 0.03,
        pin_mode: PinMode::None,
        ..GridDesc::default()
    })
    .unwrap();
    let before = cloth.relative_positions().to_vec();
    let edge: Vec<u32> = (0..40).collect();
    let root = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap();
    cloth.teleport(Vec3::Y * 0.25, Quat::IDENTITY).unwrap();
    cloth.move_attachment(root, Vec3::Y * 0.5, Quat::IDENTITY).unwrap();
    cloth.step(1);
    let after = cloth.relative_positions();
    for (before, after) in before.iter().zip(after).take(40) {
        assert!(before.distance(*after - Vec3::Y * 0.5) < 1.0e-6, "{before} to {after}");
    }
}

/// Plays everything that takes or returns positions about `place`, whose coordinates are whole
/// numbers, and returns the relative positions after every tick and other lengths.
fn play(place: Vec3, self_collision: SelfCollision) -> Vec<Vec3> {
    let settings = Settings { self_collision, max_stretch: 0.1, ..Settings::default() };
    let desc = GridDesc { spacing: 0.0625, ..level_sheet(place, settings) };
    let desc = GridDesc { origin: place + Vec3::new(-0.375, 0.25, -0.375), ..desc };
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.set_wind(Wind { velocity: Vec3::new(1.0, 0.0, 0.5), ..Wind::default() }).unwrap();
    let at = |x: f32, y: f32, z: f32| place + Vec3::new(x, y, z);
    let sphere = ColliderDesc {
        shape: Shape::Sphere,
        position: at(0.0, -0.25, 0.0),
        radius: 0.25,
        ..ColliderDesc::default()
    };
    let sphere = cloth.add_collider(&sphere).unwrap();
    let floor = ColliderDesc { position: at(0.0, -0.5, 0.0), ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    let pole = cloth.attach(&[0, 1], at(-0.5, 0.25, -0.5), Quat::IDENTITY).unwrap();
    cloth.pin(11, None).unwrap();
    cloth.pin(132, Some(at(-0.5, 0.5, 0.25))).unwrap();
    cloth.set_anchors(&[143], &[at(0.375, 0.25, 0.375)], &[Vec3::Y]).unwrap();
    cloth.set_max_distances(&[143], &[0.125]).unwrap();
    cloth.set_backstops(&[143], &[0.0625], &[1.0]).unwrap();
    let mut trace = Vec::new();
    let relative = |x: Vec3| x - place;
    for tick in 0..90 {
        let share = tick as f32 / 64.0;
        let turned = Quat::from_rotation_y(0.25 * share);
        cloth.move_attachment(pole, at(-0.5, 0.25 + 0.25 * share, -0.5), turned).unwrap();
        cloth.move_collider(sphere, at(0.25 * share, -0.25, 0.0), Quat::IDENTITY).unwrap();
        match tick {
            20 => {
                let hit = cloth.raycast(at(0.125, 2.0, 0.0625), Vec3::NEG_Y, 9.0).unwrap().unwrap();
                trace.push(Vec3::new(hit.distance, hit.u, hit.particle as f32));
                assert!((relative(hit.position).y - (2.0 - hit.distance)).abs() < 1.0e-3);
                cloth.grab_ray(at(0.125, 2.0, 0.0625), Vec3::NEG_Y, 0.0).unwrap().unwrap();
            }
            40 => {
                let (from, to) = (at(0.03125, -1.0, -1.0), at(0.03125, -1.0, 0.0));
                trace.push(Vec3::splat(cloth.cut(from, to, Vec3::Y * 4.0).unwrap() as f32));
                cloth.crease(at(-0.5, 0.25, 0.125), at(0.5, 0.25, 0.125), 0.5).unwrap();
            }
            50 => {
                cloth.set_frame(place, Quat::IDENTITY).unwrap();
                cloth.move_frame(at(0.25, 0.0, 0.0), Quat::IDENTITY, 0.5).unwrap();
            }
            60 => cloth.teleport(at(0.0, 0.125, 0.0), Quat::from_rotation_y(0.25)).unwrap(),
            70 => cloth.set_position(66, at(0.0, 0.5, 0.0)).unwrap(),
            80 => cloth.set_pin_targets(&[11], &[at(0.375, 0.5, -0.5)]).unwrap(),
            _ => (),
        }
        cloth.step(1);
        while let Some(event) = cloth.next_event() {
            let is_near = relative(event.position).length() < 2.0;
            assert!(is_near, "{event:?} is not near {place}");
        }
        trace.extend_from_slice(cloth.relative_positions());
        trace.extend_from_slice(cloth.normals());
    }
    let particle = (0..cloth.particle_count()).map(|i| cloth.position(i).unwrap());
    assert!(particle.zip(cloth.positions()).all(|(x, drawn)| x == *drawn));
    assert_eq!(cloth.origin(), place);
    trace
}

#[test]
fn everything_moves_far_away_bit_by_bit_as_at_zero() {
    for self_collision in [SelfCollision::None, SelfCollision::Particles, SelfCollision::Surface] {
        let near = play(Vec3::ZERO, self_collision);
        let far = play(Vec3::new(5000.0, -300.0, 40.0), self_collision);
        let first = near.iter().zip(&far).position(|(near, far)| near != far);
        assert_eq!((first, near.len()), (None, far.len()), "{self_collision:?}");
    }
}

#[test]
fn a_sheet_falls_600_m_without_deforming_and_lands_on_the_floor() {
    let ground = 100.3;
    let settings = Settings { damping: 0.0, ..Settings::default() };
    let place = Vec3::new(0.0, 600.0 - 0.31, 0.0);
    let material = Material { drag: 0.0, lift: 0.0, ..Material::default() };
    let mut cloth = Cloth::grid(&GridDesc { material, ..level_sheet(place, settings) }).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * ground, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    let start = exact_positions(&mut cloth);
    cloth.step(590);
    let (time, mut error) = (590.0 * TICK, 0.0_f64);
    for (x, from) in exact_positions(&mut cloth).iter().zip(&start) {
        let exact = *from - DVec3::Y * (0.5 * 9.81 * time * time);
        error = error.max((*x - exact).length());
    }
    assert!(error < 0.05, "off by {error} m");
    assert!(cloth.stats().max_stretch < 1.0e-4, "stretched by {}", cloth.stats().max_stretch);
    cloth.step(60);
    cloth.set_settings(Settings::default()).unwrap();
    cloth.set_material(Material::default()).unwrap();
    cloth.step(600);
    let lowest = exact_positions(&mut cloth).iter().fold(f64::INFINITY, |low, x| low.min(x.y));
    let gap = lowest - f64::from(ground);
    assert!(gap > 0.9 * f64::from(cloth.material().thickness) && gap < 0.05, "a gap of {gap} m");
    let speed = max_speed_in(1, &mut cloth);
    assert!(speed < 0.02, "{speed} m/s");
}

#[test]
fn a_flag_rides_200_m_and_comes_to_rest_as_one_that_stays() {
    let ride = |length: f32| {
        let mut cloth = Cloth::grid(&GridDesc {
            columns: 12,
            rows: 12,
            pin_mode: PinMode::None,
            settings: Settings { self_collision: SelfCollision::Surface, ..Settings::default() },
            ..GridDesc::default()
        })
        .unwrap();
        let edge: Vec<u32> = (0..12).collect();
        let train = cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY).unwrap();
        let mut most_stretch = 0.0_f32;
        for tick in 1..=600 {
            // Speeds up, drives at 25 m/s, slows down.
            let share = tick as f32 / 600.0;
            let x = length * share * share * (3.0 - 2.0 * share);
            cloth.move_attachment(train, Vec3::X * x, Quat::IDENTITY).unwrap();
            cloth.step(1);
            assert_eq!(cloth.position(0).unwrap(), Vec3::X * x, "tick {tick}");
            assert_eq!(crossing_count(&mut cloth), 0, "tick {tick}");
            most_stretch = most_stretch.max(cloth.stats().max_stretch);
        }
        cloth.step(600);
        (cloth.origin().x, most_stretch, max_speed_in(1, &mut cloth))
    };
    let (origin, stretch, speed) = ride(200.0);
    let (_, _, speed_of_one_that_stays) = ride(0.0);
    assert!((origin - 200.0).abs() <= 2.0, "origin at {origin}");
    assert!(stretch < 0.05, "stretched by {stretch}");
    assert!(speed <= 2.0 * speed_of_one_that_stays + 2.0e-3, "{speed} m/s");
}

#[test]
fn a_teleport_to_5_km_and_back_changes_no_bits() {
    let mut cloth = sheet_on_a_sphere(0.0, SelfCollision::Surface);
    cloth.step(40);
    let (before, hash) = (cloth.positions().to_vec(), cloth.state_hash());
    cloth.teleport(Vec3::new(5000.0, 0.0, -200.0), Quat::IDENTITY).unwrap();
    assert_eq!(cloth.origin(), Vec3::new(5000.0, 0.0, -200.0));
    assert_eq!(cloth.relative_positions(), before);
    assert_ne!(cloth.state_hash(), hash);
    cloth.teleport(Vec3::ZERO, Quat::IDENTITY).unwrap();
    assert_eq!(cloth.origin(), Vec3::ZERO);
    assert_eq!(cloth.positions(), before);
}

#[test]
fn positions_that_are_set_near_zero_are_exact_after_a_stay_far_away() {
    let mut cloth = sheet_on_a_sphere(0.0, SelfCollision::None);
    let before = cloth.positions().to_vec();
    let place = |cloth: &mut Cloth, by: Vec3| {
        for (i, x) in (0..).zip(&before) {
            cloth.set_position(i, *x + by).unwrap();
            cloth.set_velocity(i, Vec3::ZERO).unwrap();
        }
    };
    place(&mut cloth, Vec3::X * 5000.0);
    cloth.step(1);
    assert_eq!(cloth.origin(), Vec3::X * 5000.0);
    place(&mut cloth, Vec3::ZERO);
    assert_eq!(cloth.positions(), before);
}

#[test]
fn a_cloth_5_km_away_continues_with_the_same_bits_after_a_restore() {
    let mut cloth = sheet_on_a_sphere(5000.0, SelfCollision::Surface);
    cloth.set_wind(Wind { velocity: Vec3::X, turbulence: 0.5, ..Wind::default() }).unwrap();
    cloth.grab_particle(5).unwrap();
    // It falls off the sphere and away, so that the origin moves.
    for _ in 0..6 {
        cloth.step(37);
        let mut copies = [Cloth::restore(&cloth.save()).unwrap(), cloth.clone()];
        assert_eq!(copies[0].state_hash(), cloth.state_hash());
        assert_eq!(copies[0].origin(), cloth.origin());
        copies.iter_mut().for_each(|copy| copy.step(40));
        let mut same = cloth.clone();
        same.step(40);
        assert!(copies.iter().all(|copy| copy.state_hash() == same.state_hash()));
    }
    cloth.reset();
    assert_eq!(cloth.origin(), Vec3::X * 5000.0);
}

#[test]
fn a_falling_cloth_restores_with_the_same_bits_at_every_tick() {
    let settings = Settings { self_collision: SelfCollision::Surface, ..Settings::default() };
    let mut cloth = Cloth::grid(&level_sheet(Vec3::new(0.0, 40.0, 0.0), settings)).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * 20.3, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for _ in 0..240 {
        cloth.step(1);
        restored.step(1);
        assert_eq!(restored.state_hash(), cloth.state_hash());
        restored = Cloth::restore(&restored.save()).unwrap();
    }
    assert!(cloth.origin().y < 38.0, "it did not fall");
}

#[test]
fn a_mesh_far_away_becomes_the_same_cloth_as_at_zero() {
    let desc = |place: Vec3| {
        let corners = [[0, 0], [1, 0], [2, 1], [0, 2], [1, 2], [3, 3]];
        let positions =
            corners.map(|[x, z]| place + Vec3::new(0.25 * x as f32, 0.5, 0.25 * z as f32));
        let indices = vec![0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4];
        MeshDesc { positions: positions.to_vec(), indices, ..MeshDesc::default() }
    };
    let [mut near, mut far] =
        [Vec3::ZERO, Vec3::new(0.0, 4096.0, -5000.0)].map(|x| Cloth::mesh(&desc(x)).unwrap());
    let offset = near.relative_positions()[0] - far.relative_positions()[0];
    assert!(far.origin().y >= 4096.0 && offset.abs().max_element() <= 1.0);
    for (near, far) in near.relative_positions().iter().zip(far.relative_positions()) {
        assert_eq!(*near, *far + offset);
    }
}

#[test]
fn the_origin_stays_with_most_of_a_cloth_when_a_piece_falls_off() {
    let desc = GridDesc { columns: 12, rows: 12, ..GridDesc::default() };
    let desc = GridDesc { origin: Vec3::new(300.0, 50.0, 0.0), ..desc };
    let mut cloth = Cloth::grid(&desc).unwrap();
    let (from, to) = (Vec3::new(299.0, 49.62, -1.0), Vec3::new(301.0, 49.62, -1.0));
    assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 0);
    cloth.step(300);
    assert!(cloth.positions().iter().any(|x| x.y < 30.0), "nothing fell");
    assert!((cloth.origin() - Vec3::new(300.0, 50.0, 0.0)).abs().max_element() <= 1.0);
    let is_detached = |event: muslin::Event| event.kind == EventKind::PieceDetached;
    let detached = core::iter::from_fn(|| cloth.next_event()).find(|e| is_detached(*e)).unwrap();
    assert!((detached.position - Vec3::new(300.3, 49.5, 0.0)).length() < 1.0);
}

/// Writes positions with a transform.
fn written(cloth: &mut Cloth, desc: &WriteDesc) -> Vec<Vec3> {
    let mut buffer = vec![0.0_f32; 3 * cloth.positions().len()];
    let bytes = Cell::from_mut(bytemuck_like(&mut buffer)).as_slice_of_cells();
    let stream =
        Stream { attribute: Attribute::Position, format: VertexFormat::F32, stride: 0, bytes };
    cloth.write_vertices(&[stream], desc).unwrap();
    buffer.as_chunks::<3>().0.iter().map(|x| Vec3::from_array(*x)).collect()
}

/// The bytes of a list of numbers.
fn bytemuck_like(numbers: &mut [f32]) -> &mut [u8] {
    // SAFETY: every byte pattern is a valid f32, and bytes have no alignment.
    unsafe { core::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), 4 * numbers.len()) }
}

#[test]
fn written_vertices_are_absolute_or_relative_and_transforms_lose_no_digits() {
    let mut cloth = sheet_on_a_sphere(5000.0, SelfCollision::None);
    cloth.step(45);
    let relative = cloth.relative_positions().to_vec();
    let absolute = cloth.positions().to_vec();
    assert_eq!(written(&mut cloth, &WriteDesc::default()), absolute);
    assert_eq!(
        written(&mut cloth, &WriteDesc { relative: true, ..WriteDesc::default() }),
        relative
    );
    let to_camera = Affine3::from_translation(Vec3::new(-5000.0, 0.0, 0.0));
    let desc = WriteDesc { transform: to_camera, ..WriteDesc::default() };
    assert_eq!(written(&mut cloth, &desc), relative);
}

#[test]
fn a_blend_across_a_move_of_the_origin_is_smooth() {
    let settings = Settings { damping: 0.0, ..Settings::default() };
    let mut cloth = Cloth::grid(&level_sheet(Vec3::new(40.0, 0.0, 0.0), settings)).unwrap();
    for i in 0..cloth.particle_count() {
        cloth.set_velocity(i, Vec3::new(60.0, 0.0, 0.0)).unwrap();
    }
    let mut moves = 0;
    for _ in 0..60 {
        let (before, origin) = (cloth.positions()[0], cloth.origin());
        cloth.step(1);
        moves += u32::from(cloth.origin() != origin);
        let half = written(&mut cloth, &WriteDesc { blend: 0.5, ..WriteDesc::default() })[0];
        let middle = (before + cloth.positions()[0]) * 0.5;
        assert!(half.distance(middle) < 2.0e-5, "{half} instead of {middle}");
    }
    assert!(moves >= 2, "{moves} moves of the origin");
}

#[test]
fn a_sleeping_cloth_far_away_sleeps_on() {
    let settings = Settings { sleep_speed: 0.05, ..Settings::default() };
    let mut cloth = Cloth::grid(&level_sheet(Vec3::new(-700.0, 20.0, 0.0), settings)).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * 20.0, ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    cloth.step(600);
    assert!(cloth.stats().asleep);
    let (origin, positions) = (cloth.origin(), cloth.relative_positions().to_vec());
    cloth.step(60);
    assert!(cloth.stats().asleep && cloth.origin() == origin);
    assert_eq!(cloth.relative_positions(), positions);
}
