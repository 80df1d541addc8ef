//! Tests of sleep: a cloth at rest keeps its state bit for bit, and wakes on every input that
//! changes something.

use crate::common::bare_grid;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Settings, Shape, Wind, WindModel};

/// A sheet pinned at its top corners that falls asleep below `sleep_speed` [m/s].
fn hanging_sheet(sleep_speed: f32) -> GridDesc {
    let mut desc = GridDesc { columns: 12, rows: 10, ..GridDesc::default() };
    desc.pin_mode = PinMode::TopCorners;
    desc.settings = Settings { sleep_speed, damping: 2.0, ..Settings::default() };
    desc
}

/// A sheet above a floor that it does not touch, stepped until it sleeps.
fn sleeping_cloth() -> Cloth {
    let mut cloth = Cloth::grid(&hanging_sheet(0.005)).unwrap();
    cloth
        .add_collider(&ColliderDesc { position: Vec3::Y * -5.0, ..ColliderDesc::default() })
        .unwrap();
    (60..120).for_each(|i| cloth.set_velocity(i, Vec3::Z * 0.5).unwrap());
    let ticks = (0..3600).find(|_| {
        cloth.step(1);
        cloth.stats().asleep
    });
    assert!(ticks.is_some_and(|ticks| ticks > 60), "it swings before it sleeps: {ticks:?}");
    // Later ticks take the short way of an idle cloth.
    cloth.step(1);
    cloth
}

#[test]
fn a_sleeping_cloth_keeps_its_state_while_time_runs() {
    let mut cloth = sleeping_cloth();
    let (before, normals) = (cloth.positions().to_vec(), cloth.normals().to_vec());
    let (revision, ticks, time) = (cloth.state_revision(), cloth.stats().ticks, cloth.time());
    cloth.step(600);
    assert_eq!(cloth.positions(), before);
    assert_eq!(cloth.normals(), normals);
    assert_eq!(cloth.state_revision(), revision, "a renderer has nothing to redraw");
    assert_eq!(cloth.stats().ticks, ticks + 600);
    assert!((cloth.time() - time - 10.0).abs() < 1e-3);
    let stats = cloth.stats();
    assert!(stats.asleep && stats.kinetic_energy == 0.0 && stats.max_speed == 0.0);
}

#[test]
fn waking_up_moves_no_particle_by_three_millimetres() {
    let mut cloth = sleeping_cloth();
    let before = cloth.positions().to_vec();
    let settings = Settings { sleep_speed: 0.0, ..cloth.settings().clone() };
    cloth.set_settings(settings).unwrap();
    for _ in 0..120 {
        cloth.step(1);
        let moved = cloth.positions().iter().zip(&before).map(|(x, last)| (*x - *last).length());
        assert!(moved.fold(0.0, f32::max) < 0.003);
        let fastest = (0..120).map(|i| cloth.velocity(i).unwrap().length()).fold(0.0, f32::max);
        assert!(fastest < 0.01 && fastest == cloth.stats().max_speed);
    }
}

#[test]
fn every_input_that_changes_something_wakes_the_cloth() {
    type Input = fn(&mut Cloth);
    let inputs: [(&str, Input); 18] = [
        ("a moved pin", |cloth| cloth.pin(0, Some(Vec3::Y * 0.1)).unwrap()),
        ("a pin moved by set_pin_targets", |cloth| {
            cloth.set_pin_targets(&[0], &[Vec3::Y]).unwrap();
        }),
        ("a new pin", |cloth| cloth.pin(50, None).unwrap()),
        ("a removed pin", |cloth| cloth.unpin(0).unwrap()),
        ("all pins removed", Cloth::unpin_all),
        ("a grab", |cloth| assert!(cloth.grab_particle(60).is_ok())),
        ("a set position", |cloth| cloth.set_position(60, Vec3::X).unwrap()),
        ("a set velocity", |cloth| cloth.set_velocity(60, Vec3::Z).unwrap()),
        ("wind", |cloth| {
            cloth.set_wind(Wind { velocity: Vec3::Z * 3.0, ..Wind::default() }).unwrap();
        }),
        ("another material", |cloth| {
            let mut material = cloth.material().clone();
            material.density *= 2.0;
            cloth.set_material(material).unwrap();
        }),
        ("another gravity", |cloth| {
            let settings = Settings { gravity: Vec3::X, ..cloth.settings().clone() };
            cloth.set_settings(settings).unwrap();
        }),
        ("a new collider", |cloth| {
            let ball =
                ColliderDesc { shape: Shape::Sphere, radius: 0.1, ..ColliderDesc::default() };
            cloth.add_collider(&ball).unwrap();
        }),
        ("a cut", |cloth| {
            let from = Vec3::new(0.31, -0.2, -1.0);
            assert!(cloth.cut(from, from - Vec3::Y * 9.0, Vec3::Z * 2.0).unwrap() > 0);
        }),
        ("a tear", |cloth| assert!(cloth.tear_edge(64, 76).unwrap())),
        ("a crease", |cloth| cloth.crease(Vec3::ZERO, Vec3::new(0.5, -0.5, 0.0), 1.0).unwrap()),
        ("a reset", Cloth::reset),
        ("a released grab", |cloth| {
            let grab = cloth.grab_particle(60).unwrap();
            cloth.step(60);
            assert!(cloth.stats().asleep, "a grab at rest lets the cloth sleep");
            cloth.release(grab).unwrap();
        }),
        ("a moved grab", |cloth| {
            let grab = cloth.grab_particle(60).unwrap();
            cloth.step(60);
            let at = cloth.positions()[60];
            cloth.move_grab(grab, at).unwrap();
            cloth.step(1);
            assert!(cloth.stats().asleep, "a grab moved to its own position lets the cloth sleep");
            cloth.move_grab(grab, at + Vec3::Z * 0.1).unwrap();
        }),
    ];
    for (name, input) in inputs {
        let mut cloth = sleeping_cloth();
        input(&mut cloth);
        cloth.step(1);
        assert!(!cloth.stats().asleep, "{name}");
    }
}

#[test]
fn a_collider_wakes_the_cloth_when_it_moves_and_when_it_is_removed() {
    let mut desc = bare_grid(8, 8, 0.05, PinMode::None);
    desc.settings = Settings { sleep_speed: 0.01, damping: 1.0, ..desc.settings };
    desc.down = Vec3::Z;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = ColliderDesc { position: Vec3::Y * -0.2, ..ColliderDesc::default() };
    let floor = cloth.add_collider(&floor).unwrap();
    cloth.step(300);
    assert!(cloth.stats().asleep);
    let weight = cloth.collider_impulse(floor).unwrap();
    cloth.move_collider(floor, Vec3::Y * -0.2, Quat::IDENTITY).unwrap();
    cloth.step(5);
    assert!(cloth.stats().asleep, "the floor did not move");
    assert_eq!(
        cloth.collider_impulse(floor).unwrap(),
        weight,
        "the floor still reports the weight"
    );
    let height = cloth.positions()[20].y;
    cloth.move_collider(floor, Vec3::Y * -0.1, Quat::IDENTITY).unwrap();
    cloth.step(1);
    assert!(!cloth.stats().asleep && cloth.positions()[20].y > height + 0.05);
    cloth.step(300);
    assert!(cloth.stats().asleep);
    cloth.remove_collider(floor).unwrap();
    cloth.step(30);
    assert!(cloth.positions()[20].y < height - 0.5, "the cloth falls");
}

#[test]
fn inputs_that_change_nothing_do_not_wake_the_cloth() {
    let mut cloth = sleeping_cloth();
    let pin = cloth.positions()[0];
    cloth.set_settings(cloth.settings().clone()).unwrap();
    cloth.set_material(cloth.material().clone()).unwrap();
    cloth.set_wind(cloth.wind().clone()).unwrap();
    cloth.pin(0, Some(pin)).unwrap();
    cloth.set_pin_targets(&[0], &[pin]).unwrap();
    assert!(cloth.pin(500, None).is_err());
    cloth.step(1);
    assert!(cloth.stats().asleep);
}

#[test]
fn slow_pins_and_changing_wind_keep_the_cloth_awake() {
    let mut cloth = sleeping_cloth();
    for tick in 1..=90 {
        let drift = Vec3::X * (2.0e-5 * tick as f32);
        let pins: Vec<u32> = cloth.pinned().collect();
        let targets: Vec<Vec3> =
            pins.iter().map(|i| Vec3::X * (0.05 * (*i % 12) as f32) + drift).collect();
        cloth.set_pin_targets(&pins, &targets).unwrap();
        cloth.step(1);
        assert!(!cloth.stats().asleep, "tick {tick}");
    }
    for wind in [
        Wind { gust: 0.2, velocity: Vec3::Z * 1.0e-3, ..Wind::default() },
        Wind { model: WindModel::SineField, velocity: Vec3::Z * 1.0e-3, ..Wind::default() },
    ] {
        let mut cloth = sleeping_cloth();
        cloth.set_wind(wind).unwrap();
        for _ in 0..120 {
            cloth.step(1);
            assert!(!cloth.stats().asleep);
        }
    }
}

#[test]
fn a_restored_sleeping_cloth_continues_with_the_same_bits() {
    let mut cloth = sleeping_cloth();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    assert!(restored.stats().asleep);
    for cloth in [&mut cloth, &mut restored] {
        cloth.step(10);
        cloth.set_velocity(60, Vec3::Z).unwrap();
        cloth.step(30);
    }
    assert_eq!(cloth.state_hash(), restored.state_hash());
    let mut cloth = Cloth::grid(&hanging_sheet(0.005)).unwrap();
    while !cloth.stats().asleep {
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        for cloth in [&mut cloth, &mut restored] {
            cloth.step(16);
        }
        assert_eq!(cloth.stats().asleep, restored.stats().asleep);
        assert_eq!(cloth.state_hash(), restored.state_hash());
    }
}

#[test]
fn a_cloth_with_sleep_speed_zero_never_sleeps() {
    let mut cloth = Cloth::grid(&hanging_sheet(0.0)).unwrap();
    cloth.step(1200);
    assert!(!cloth.stats().asleep);
}
