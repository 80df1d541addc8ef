//! Whole poses at once, and cheap questions about a cloth.

use crate::common::irregular_mesh;
use muslin::glam::{DVec3, Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, PinMode, SelfCollision, Settings, Shape, Wind};

fn flag() -> Cloth {
    let mut desc = GridDesc { columns: 12, rows: 9, ..GridDesc::default() };
    desc.settings.self_collision = SelfCollision::Surface;
    desc.settings.tethers = true;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.set_wind(Wind { velocity: Vec3::new(0.5, 0.0, 3.0), ..Wind::default() }).unwrap();
    cloth.step(40);
    cloth
}

/// A pose that differs from the rest shape everywhere.
fn bent(cloth: &Cloth, offset: Vec3) -> Vec<Vec3> {
    let wave = |x: Vec3| Vec3::new(x.x, x.y, 0.1 * (7.0 * x.x).sin()) + offset;
    cloth.rest_positions().map(wave).collect()
}

#[test]
fn a_bulk_call_has_the_bits_of_calls_for_single_particles() {
    for offset in [Vec3::ZERO, Vec3::new(4000.3, -2.1, 0.7)] {
        let mut bulk = flag();
        let body = bulk.attach(&[100, 107], Vec3::X, Quat::IDENTITY).unwrap();
        bulk.move_attachment(body, Vec3::Y, Quat::IDENTITY).unwrap();
        let mut single = bulk.clone();
        let positions = bent(&bulk, offset);
        let velocities: Vec<Vec3> = positions.iter().map(|x| *x * 0.1 - offset * 0.1).collect();
        let (first, half) = (30_u32, 30..90_usize);
        bulk.set_positions(first, &positions[half.clone()]).unwrap();
        bulk.set_velocities(first, &velocities[half.clone()]).unwrap();
        for i in half.clone() {
            single.set_position(i as u32, positions[i]).unwrap();
        }
        for i in half {
            single.set_velocity(i as u32, velocities[i]).unwrap();
        }
        assert_eq!(bulk.state_hash(), single.state_hash());
        bulk.set_positions(0, &positions).unwrap();
        for (i, x) in (0..).zip(&positions) {
            single.set_position(i, *x).unwrap();
        }
        assert_eq!(bulk.state_hash(), single.state_hash());
        assert_eq!(bulk.positions(), positions, "absolute positions");
        for cloth in [&mut bulk, &mut single] {
            cloth.step(30);
        }
        assert_eq!(bulk.state_hash(), single.state_hash());
        assert_ne!(bulk.positions(), positions);
    }
}

#[test]
fn a_recorded_pose_with_its_velocities_goes_on_nearly_as_the_recording_did() {
    let mut cloth = flag();
    let (positions, velocities) = (cloth.positions().to_vec(), Vec::from_iter(cloth.velocities()));
    assert!(velocities.iter().any(|v| v.length() > 0.1));
    cloth.step(2);
    let after = cloth.positions().to_vec();
    cloth.step(60);
    cloth.set_positions(0, &positions).unwrap();
    cloth.set_velocities(0, &velocities).unwrap();
    assert_eq!(cloth.positions(), positions);
    assert!(cloth.velocities().eq(velocities));
    cloth.step(2);
    let off = cloth.positions().iter().zip(&after).map(|(a, b)| a.distance(*b));
    let moved = after.iter().zip(&positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    let off = off.fold(0.0, f32::max);
    assert!(off < 0.3 * moved && moved > 0.01, "{off} m of {moved} m");
}

#[test]
fn a_pose_keeps_pins_wakes_the_cloth_and_raises_one_revision() {
    let mut desc = GridDesc { columns: 12, rows: 9, ..GridDesc::default() };
    desc.settings = Settings { sleep_speed: 0.01, damping: 4.0, ..Settings::default() };
    let mut cloth = Cloth::grid(&desc).unwrap();
    assert!((0..3600).any(|_| {
        cloth.step(1);
        cloth.is_asleep()
    }));
    assert!(cloth.stats().asleep);
    let (revision, pose) = (cloth.state_revision(), bent(&cloth, Vec3::Y));
    cloth.set_positions(0, &pose).unwrap();
    assert!(!cloth.is_asleep());
    assert_eq!(cloth.state_revision(), revision + 1);
    cloth.step(1);
    let [pins, rest] = [0..12, 12..108].map(|range| {
        let moved = range.map(|i: usize| cloth.positions()[i].distance(pose[i]));
        moved.fold(0.0, f32::max)
    });
    assert!(pins == 0.0 && rest > 1e-4, "{pins} {rest}");
    assert_eq!(cloth.pin_target(3), Ok(Some(pose[3])));
}

#[test]
fn a_wrong_entry_is_named_with_its_index_and_nothing_changes() {
    let mut cloth = flag();
    let (hash, revision) = (cloth.state_hash(), cloth.state_revision());
    let mut list = bent(&cloth, Vec3::ZERO);
    list[71].y = f32::NAN;
    list[90].z = f32::INFINITY;
    let entry = |field| Err(Error::BadEntry { field, index: 71, must: "be finite" });
    assert_eq!(cloth.set_positions(0, &list), entry("positions"));
    assert_eq!(cloth.set_velocities(0, &list), entry("velocities"));
    let message = cloth.set_positions(0, &list).unwrap_err().to_string();
    assert_eq!(message, "`positions[71]` must be finite");
    let message = cloth.set_positions(1, &bent(&cloth, Vec3::ZERO)).unwrap_err().to_string();
    assert!(message.starts_with("`positions` must have at most"), "{message}");
    let beyond = Err(Error::BadIndex { field: "first", index: 108, count: 108 });
    assert_eq!(cloth.set_velocities(108, &[Vec3::ZERO]), beyond);
    assert_eq!(cloth.set_positions(108, &[]), Ok(()));
    assert!(cloth.set_positions(109, &[]).is_err());
    assert!(cloth.set_positions(u32::MAX, &[Vec3::ZERO; 2]).is_err());
    assert_eq!((cloth.state_hash(), cloth.state_revision()), (hash, revision));
}

#[test]
fn time_blend_and_ticks_say_what_advance_has_run() {
    let mut cloth = flag();
    assert_eq!((cloth.ticks(), cloth.stats().ticks), (40, 40));
    cloth.advance(0.04).unwrap();
    assert_eq!(cloth.ticks(), 42);
    assert!((cloth.time() - 42.0 / 60.0).abs() < 1e-6, "{}", cloth.time());
    assert!((cloth.blend() - 0.4).abs() < 1e-3, "{}", cloth.blend());
    cloth.reset();
    assert_eq!((cloth.ticks(), cloth.time(), cloth.blend()), (0, 0.0, 0.0));
}

#[test]
fn a_collider_is_at_its_pose_after_the_tick_that_takes_it_there() {
    let far = Vec3::new(4096.5, 3.0, -2.0);
    for home in [Vec3::ZERO, far] {
        let mut desc = GridDesc { columns: 8, rows: 8, ..GridDesc::default() };
        desc.origin = home;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let (start, end) = (home + Vec3::Z * 3.0, home + Vec3::new(0.5, 0.0, 2.0));
        let turn = Quat::from_rotation_x(0.5);
        let ball = ColliderDesc {
            shape: Shape::Capsule,
            radius: 0.2,
            half_height: 0.3,
            position: start,
            ..ColliderDesc::default()
        };
        let ball = cloth.add_collider(&ball).unwrap();
        assert_eq!(cloth.collider_pose(ball), Ok((start, Quat::IDENTITY)));
        cloth.move_collider(ball, end, turn).unwrap();
        // The part of the body's motion that is not felt moves no collider.
        cloth.move_frame(Vec3::Y, Quat::IDENTITY, 0.0).unwrap();
        assert_eq!(cloth.collider_pose(ball), Ok((start, Quat::IDENTITY)));
        assert_eq!(cloth.advance(0.0), Ok(0));
        assert_eq!(cloth.collider_pose(ball), Ok((start, Quat::IDENTITY)));
        let saved = Cloth::restore(&cloth.save()).unwrap();
        assert_eq!(cloth.advance(0.051), Ok(3));
        let (position, rotation) = cloth.collider_pose(ball).unwrap();
        assert_eq!(position, end);
        assert!(rotation.angle_between(turn) < 1e-3);
        let same = Cloth::restore(&cloth.save()).unwrap().collider_pose(ball).unwrap();
        assert!(same.0.distance(end) < 1e-3 && same.1 == rotation, "{same:?}");
        assert!(saved.collider_pose(ball).is_ok());
        cloth.teleport_collider(ball, start, turn).unwrap();
        assert_eq!(cloth.collider_pose(ball).unwrap().0, start);
        cloth.remove_collider(ball).unwrap();
        assert_eq!(cloth.collider_pose(ball), Err(Error::BadHandle { what: "collider" }));
    }
}

#[test]
fn mass_properties_are_the_sums_over_the_particles() {
    for offset in [Vec3::ZERO, Vec3::new(4000.0, 0.0, 0.0)] {
        let mut cloth = flag();
        cloth.set_positions(0, &bent(&cloth, offset)).unwrap();
        cloth.set_mass_scales(&[5, 60], &[20.0, 50.0]).unwrap();
        let (mut total, mut moment, mut momentum) = (0.0, DVec3::ZERO, DVec3::ZERO);
        for i in 0..cloth.particle_count() {
            let mass = f64::from(cloth.mass(i).unwrap());
            total += mass;
            moment += mass * cloth.position(i).unwrap().as_dvec3();
            momentum += mass * cloth.velocity(i).unwrap().as_dvec3();
        }
        let found = cloth.mass_properties();
        assert!((f64::from(found.total) / total - 1.0).abs() < 1e-6);
        assert!(found.center.as_dvec3().distance(moment / total) < 4e-4);
        assert!(found.momentum.as_dvec3().distance(momentum) < 1e-6 * momentum.length());
        assert!(momentum.length() > 1e-3);
    }
}

#[test]
fn rest_positions_are_those_of_the_descriptor_also_after_tears_and_resets() {
    let desc = irregular_mesh();
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let rest = |cloth: &Cloth| -> Vec<Vec3> {
        let rest: Vec<Vec3> = cloth.rest_positions().collect();
        cloth.vertex_particles().iter().map(|particle| rest[*particle as usize]).collect()
    };
    let start: Vec<Vec3> = cloth.positions().to_vec();
    assert_eq!(rest(&cloth), start);
    cloth.step(30);
    assert_ne!(cloth.positions(), start);
    assert_eq!(rest(&cloth), start);
    let mut far = GridDesc { columns: 9, rows: 9, ..GridDesc::default() };
    far.origin = Vec3::new(0.0, 1000.0, 0.0);
    let mut cloth = Cloth::grid(&far).unwrap();
    let start = cloth.positions().to_vec();
    cloth.tear_edge(40, 41).unwrap();
    cloth.step(5);
    assert!(cloth.particle_count() > 81);
    let sources = cloth.source_vertices().iter().map(|source| start[*source as usize]);
    assert!(cloth.rest_positions().eq(sources));
}

#[test]
fn pin_targets_are_readable_for_plain_and_attached_pins() {
    let mut cloth =
        Cloth::grid(&GridDesc { pin_mode: PinMode::None, ..GridDesc::default() }).unwrap();
    assert_eq!(cloth.pin_target(4), Ok(None));
    cloth.pin(4, Some(Vec3::ONE)).unwrap();
    assert_eq!(cloth.pin_target(4), Ok(Some(Vec3::ONE)));
    let body = cloth.attach(&[7], Vec3::ZERO, Quat::IDENTITY).unwrap();
    let place = cloth.position(7).unwrap();
    cloth.move_attachment(body, Vec3::Y, Quat::IDENTITY).unwrap();
    assert_eq!(cloth.pin_target(7), Ok(Some(place + Vec3::Y)));
    assert!(cloth.pinned().eq([4, 7]));
    assert!(matches!(cloth.pin_target(1600), Err(Error::BadIndex { .. })));
}
