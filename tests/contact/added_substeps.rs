//! Substeps that ticks add where cloth and colliders move fast relative to each other.

use crate::common::shapes::free_sheet;
use muslin::glam::{DVec3, Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, GridDesc, PinMode, Shape};

const TICK: f32 = 1.0 / 60.0;

/// 21 x 21 particles, 1 m wide, flat at a height of zero, without gravity, air and damping.
fn sheet_in_vacuum() -> Cloth {
    let mut desc = free_sheet(21, 1.0, 0.0);
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.damping = 0.0;
    (desc.material.drag, desc.material.lift) = (0.0, 0.0);
    Cloth::grid(&desc).unwrap()
}

fn ball(radius: f32, position: Vec3) -> ColliderDesc {
    ColliderDesc { shape: Shape::Sphere, radius, position, ..ColliderDesc::default() }
}

/// The middle of the particles [m].
fn center(cloth: &Cloth) -> Vec3 {
    cloth.positions().iter().sum::<Vec3>() / cloth.positions().len() as f32
}

fn set_velocities(cloth: &mut Cloth, v: Vec3) {
    (0..cloth.particle_count()).for_each(|i| cloth.set_velocity(i, v).unwrap());
}

/// Momentum over mass [m/s].
fn mean_velocity(cloth: &Cloth) -> Vec3 {
    let (mut momentum, mut mass) = (DVec3::ZERO, 0.0);
    for i in 0..cloth.particle_count() {
        let one = f64::from(cloth.mass(i).unwrap());
        momentum += cloth.velocity(i).unwrap().as_dvec3() * one;
        mass += one;
    }
    (momentum / mass).as_vec3()
}

/// Mean square of the velocities relative to their mean [m²/s²].
fn vibration(cloth: &Cloth) -> f32 {
    let mean = mean_velocity(cloth);
    let speed2 = |i: u32| cloth.velocity(i).unwrap().distance_squared(mean);
    (0..cloth.particle_count()).map(speed2).sum::<f32>() / cloth.particle_count() as f32
}

/// Moves a ball upwards through the place of a sheet at `speed` [m/s] and returns the number of
/// substeps of each tick.
fn substeps_at(speed: f32, substeps: u32, max_stretch: f32) -> Vec<u32> {
    let mut cloth = sheet_in_vacuum();
    let settings = muslin::Settings { substeps, max_stretch, ..cloth.settings().clone() };
    cloth.set_settings(settings).unwrap();
    let mut at = center(&cloth) - Vec3::Y * 0.5;
    let body = cloth.add_collider(&ball(0.2, at)).unwrap();
    (0..20)
        .map(|_| {
            at.y += speed * TICK;
            cloth.move_collider(body, at, Quat::IDENTITY).unwrap();
            cloth.step(1);
            cloth.stats().substeps
        })
        .collect()
}

/// Returns the largest number of substeps.
fn most_substeps_at(speed: f32, substeps: u32) -> u32 {
    substeps_at(speed, substeps, 0.0).into_iter().fold(0, u32::max)
}

#[test]
fn a_fast_body_adds_substeps_and_stats_tell_their_number() {
    let counts = [3.0, 5.0, 15.0, 50.0].map(|speed| most_substeps_at(speed, 4));
    assert_eq!(counts[..2], [4, 4], "slow bodies");
    assert!((8..=12).contains(&counts[2]), "{} substeps at 15 m/s", counts[2]);
    assert!((16..=24).contains(&counts[3]), "{} substeps at 50 m/s", counts[3]);
}

#[test]
fn a_bound_of_stretch_adds_substeps_from_a_fifth_of_the_speed_on() {
    // The tick of the impact is the first one that adds any.
    let counts = [2.0, 5.0, 10.0, 15.0, 50.0].map(|speed| {
        let counts = substeps_at(speed, 4, 0.05);
        counts.into_iter().find(|count| *count > 4).unwrap_or(4)
    });
    assert_eq!(counts, [4, 12, 20, 28, 32]);
}

#[test]
fn the_number_of_added_substeps_is_bounded_at_any_speed() {
    let speed = 1.0e6;
    assert_eq!(most_substeps_at(speed, 1), 8);
    assert_eq!(most_substeps_at(speed, 4), 32);
    assert_eq!(most_substeps_at(speed, 10), 60);
    assert_eq!(most_substeps_at(speed, 100), 100);
}

#[test]
fn a_body_at_rest_in_or_beside_a_cloth_at_rest_adds_no_substeps() {
    let mut cloth = sheet_in_vacuum();
    let at = center(&cloth);
    cloth.add_collider(&ball(0.2, at - Vec3::Y * 0.21)).unwrap();
    cloth.add_collider(&ball(0.002, at + Vec3::Y * 0.1)).unwrap();
    for _ in 0..10 {
        cloth.step(1);
        assert_eq!(cloth.stats().substeps, 4);
    }
}

#[test]
fn a_fast_body_far_from_the_cloth_adds_no_substeps() {
    let mut cloth = sheet_in_vacuum();
    let mut at = center(&cloth) + Vec3::new(-10.0, 0.5, 0.0);
    let body = cloth.add_collider(&ball(0.2, at)).unwrap();
    for _ in 0..24 {
        at.x += 50.0 * TICK;
        cloth.move_collider(body, at, Quat::IDENTITY).unwrap();
        cloth.step(1);
        assert_eq!(cloth.stats().substeps, 4, "with the body at {at}");
    }
    assert!(at.x > center(&cloth).x + 9.0, "the body has passed above");
}

#[test]
fn a_body_that_flies_along_with_the_cloth_adds_no_substeps() {
    let mut cloth = sheet_in_vacuum();
    let mut at = center(&cloth) - Vec3::Y * 0.21;
    let body = cloth.add_collider(&ball(0.2, at)).unwrap();
    let v = Vec3::new(30.0, 10.0, 20.0);
    set_velocities(&mut cloth, v);
    for _ in 0..30 {
        at += v * TICK;
        cloth.move_collider(body, at, Quat::IDENTITY).unwrap();
        cloth.step(1);
        assert_eq!(cloth.stats().substeps, 4);
    }
}

#[test]
fn a_cloth_that_flies_fast_onto_a_body_at_rest_adds_substeps() {
    let floor = ColliderDesc { position: Vec3::NEG_Y, ..ColliderDesc::default() };
    for body in [floor, ball(0.3, Vec3::NEG_Y)] {
        let mut cloth = sheet_in_vacuum();
        cloth.add_collider(&ColliderDesc { position: center(&cloth) - Vec3::Y, ..body }).unwrap();
        set_velocities(&mut cloth, Vec3::NEG_Y * 20.0);
        let counts: Vec<u32> = (0..6)
            .map(|_| {
                cloth.step(1);
                cloth.stats().substeps
            })
            .collect();
        assert_eq!(counts[0], 4, "not near yet: {counts:?}");
        assert!(counts.iter().any(|count| *count >= 8), "{counts:?}");
    }
}

#[test]
fn a_sheet_of_64_by_64_that_falls_one_metre_onto_a_ball_needs_no_added_substeps() {
    for spacing in [0.02, 0.05] {
        let mut desc = free_sheet(64, 63.0 * spacing, 0.0);
        desc.settings.damping = 0.0;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let radius = 0.2 * 63.0 * spacing;
        let at = center(&cloth) - Vec3::Y * (1.0 + radius);
        cloth.add_collider(&ball(radius, at)).unwrap();
        for _ in 0..60 {
            cloth.step(1);
            assert_eq!(cloth.stats().substeps, 4, "with cells of {spacing} m");
        }
    }
}

/// Turns a body, and moves it to the other side of a hung sheet in every third tick.
fn drive(cloth: &mut Cloth, body: Collider, tick: u32) {
    let z = if tick % 6 < 3 { -0.5 } else { 0.4 };
    let turn = Quat::from_rotation_y(tick as f32 * 0.4);
    cloth.move_collider(body, Vec3::new(0.5, -0.5, z), turn).unwrap();
    cloth.step(1);
}

/// A hung sheet with a soft pin, and a box in front of it.
fn hung_sheet_and_box() -> (Cloth, Collider) {
    let desc = GridDesc {
        columns: 21,
        rows: 21,
        spacing: 0.05,
        pin_mode: PinMode::TopEdge,
        ..GridDesc::default()
    };
    let mut cloth = Cloth::grid(&desc).unwrap();
    let free = cloth.particle_count() - 1;
    cloth.pin(free, None).unwrap();
    cloth.set_pin_stiffness(&[free], 50.0).unwrap();
    let body = ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(0.2, 0.1, 0.15),
        position: Vec3::new(0.5, -0.5, -0.5),
        ..ColliderDesc::default()
    };
    let body = cloth.add_collider(&body).unwrap();
    (cloth, body)
}

#[test]
fn a_restored_cloth_continues_with_the_same_bits_while_a_fast_body_passes() {
    let (mut cloth, body) = hung_sheet_and_box();
    let mut counts = Vec::new();
    for tick in 0..24 {
        let mut copy = Cloth::restore(&cloth.save()).unwrap();
        assert_eq!(copy.state_hash(), cloth.state_hash());
        assert_eq!(copy.stats().substeps, cloth.stats().substeps);
        for after in tick..tick + 4 {
            drive(&mut copy, body, after);
        }
        let mut other = cloth.clone();
        for after in tick..tick + 4 {
            drive(&mut other, body, after);
        }
        assert_eq!(copy.state_hash(), other.state_hash(), "saved before tick {tick}");
        drive(&mut cloth, body, tick);
        counts.push(cloth.stats().substeps);
    }
    assert!(counts.contains(&4) && counts.iter().any(|count| *count > 4), "{counts:?}");
}

#[test]
fn the_mean_velocity_does_not_jump_when_the_number_of_substeps_changes() {
    let mut cloth = sheet_in_vacuum();
    let v = Vec3::new(1.0, 0.5, -2.0);
    for i in 0..cloth.particle_count() {
        // Waves, so that links pull while the number changes.
        let wave = Vec3::Y * (0.3 * (i as f32 * 0.7).sin());
        cloth.set_velocity(i, v + wave).unwrap();
    }
    cloth.step(5);
    let (before, vibration_before) = (mean_velocity(&cloth), vibration(&cloth));
    // The ball passes beside the sheet, near enough to count, and touches nothing.
    let body = cloth.add_collider(&ball(0.1, Vec3::NEG_Y * 9.0)).unwrap();
    let mut counts = Vec::new();
    for tick in 0..128 {
        let edge = cloth.positions().iter().fold(Vec3::NEG_INFINITY, |most, x| most.max(*x));
        let beside = Vec3::new(edge.x + 0.13, center(&cloth).y, center(&cloth).z);
        let side = if tick % 16 < 8 { -0.5 } else { 0.5 };
        cloth.move_collider(body, beside + Vec3::Z * side, Quat::IDENTITY).unwrap();
        cloth.step(1);
        assert_eq!(cloth.collider_impulse(body).unwrap().linear, Vec3::ZERO);
        counts.push(cloth.stats().substeps);
        let jump = mean_velocity(&cloth).distance(before);
        assert!(jump < 5.0e-4, "tick {tick}, {counts:?}: {jump} m/s");
        assert!(vibration(&cloth) < 3.0 * vibration_before, "tick {tick}, {counts:?}");
    }
    let changes = counts.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(changes >= 6, "{counts:?}");
}

#[test]
fn a_velocity_that_is_set_after_a_change_of_the_tick_or_the_substeps_stays_as_it_is() {
    for (tick, substeps) in [(1.0 / 60.0, 8), (1.0 / 120.0, 4), (1.0 / 30.0, 3)] {
        let mut cloth = sheet_in_vacuum();
        cloth.step(2);
        let settings = muslin::Settings { tick, substeps, ..cloth.settings().clone() };
        cloth.set_settings(settings).unwrap();
        let v = Vec3::new(3.0, -1.0, 2.0);
        set_velocities(&mut cloth, v);
        let start = center(&cloth);
        cloth.step(1);
        let moved = center(&cloth) - start;
        assert!((moved - v * tick).length() < 1.0e-5, "{moved} instead of {}", v * tick);
        assert!(mean_velocity(&cloth).distance(v) < 1.0e-4, "{}", mean_velocity(&cloth));
    }
}

#[test]
fn a_ball_at_fifty_metres_per_second_takes_a_sheet_at_rest_along() {
    let mut cloth = sheet_in_vacuum();
    cloth.step(10);
    let mut at = center(&cloth) - Vec3::Y * 0.5;
    let body = cloth.add_collider(&ball(0.2, at)).unwrap();
    for _ in 0..10 {
        at.y += 50.0 * TICK;
        cloth.move_collider(body, at, Quat::IDENTITY).unwrap();
        cloth.step(1);
    }
    let (v, stretch) = (mean_velocity(&cloth), cloth.stats().max_stretch);
    assert!(v.distance(Vec3::Y * 50.0) < 1.5, "the sheet flies at {v} m/s");
    assert!(stretch < 0.15, "{stretch}");
    assert!(cloth.positions().iter().any(|x| x.y > at.y + 0.19), "the ball has passed");
}
