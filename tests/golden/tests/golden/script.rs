//! The same script in every language: Rust here, C in `tests/c/script.c`, JavaScript in `tests/js`.
//! All must end with the hash in `tests/script.hash`.

use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, EventKind, GridDesc, Wind};

/// A changed hash means a changed simulation: give the reason in CHANGELOG.md, then replace the
/// number in the file.
const GOLDEN: &str = include_str!("../../../script.hash");

/// Runs 630 ticks: a sheet hangs in the wind, is dragged by a grab until it tears, is torn by a
/// call, released, cut, dropped on a floor and lifted by a corner.
fn cloth_after_script() -> Cloth {
    let mut desc = GridDesc::default();
    desc.settings.tearing = true;
    desc.material.tear_stretch = 1.5;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth
        .set_wind(Wind {
            velocity: Vec3::new(0.25, 0.0, 1.0),
            gust: 0.5,
            wander: 0.25,
            turbulence: 0.25,
            seed: 7,
            ..Wind::default()
        })
        .unwrap();
    let floor = ColliderDesc { position: Vec3::new(0.0, -2.5, 0.0), ..ColliderDesc::default() };
    cloth.add_collider(&floor).unwrap();
    cloth.step(120);

    let (eye, ahead) = (Vec3::new(1.0, -1.0, 5.0), Vec3::new(0.0, 0.0, -1.0));
    let (grab, at) = cloth.grab_ray(eye, ahead, 0.1).unwrap().unwrap();
    for i in 1..=120 {
        let pull = Vec3::new(0.015625, 0.0, 0.03125) * i as f32;
        cloth.move_grab(grab, at + pull).unwrap();
        cloth.step(1);
    }
    cloth.tear_edge(820, 860).unwrap();
    cloth.release(grab).unwrap();
    cloth.step(180);
    let (from, to) = (Vec3::new(-1.0, -0.59375, -9.0), Vec3::new(3.0, -0.78125, -9.0));
    let edges = cloth.cut(from, to, Vec3::Z * 18.0).unwrap();
    assert!(edges > 40, "the blade must cut through the sheet, but opened {edges} edges");
    cloth.step(30);

    cloth.unpin_all();
    cloth.step(120);
    cloth.pin(0, Some(Vec3::new(0.0, 0.0, 0.5))).unwrap();
    cloth.step(59);
    assert_eq!(cloth.advance(1.0 / 60.0).unwrap(), 1);
    cloth
}

#[test]
fn the_script_ends_with_the_golden_hash() {
    let mut cloth = cloth_after_script();
    let torn = core::iter::from_fn(|| cloth.next_event())
        .filter(|event| event.kind == EventKind::EdgeTorn)
        .count();
    assert!(torn >= 10, "the script must tear the cloth, but tore {torn} edges");
    let (hash, golden) = (cloth.state_hash(), GOLDEN.trim());
    assert_eq!(format!("{hash:#018x}"), golden, "a changed hash means a changed simulation");
}

#[test]
fn the_script_gives_the_same_hash_twice() {
    assert_eq!(cloth_after_script().state_hash(), cloth_after_script().state_hash());
}

#[test]
fn restored_and_cloned_cloths_continue_with_the_same_bits() {
    let mut straight = cloth_after_script();
    let mut restored = Cloth::restore(&straight.save()).unwrap();
    let mut cloned = straight.clone();
    assert_eq!(restored.state_hash(), straight.state_hash());
    for cloth in [&mut straight, &mut restored, &mut cloned] {
        cloth.step(60);
        let [a, b] = [cloth.indices()[0], cloth.indices()[1]];
        cloth.tear_edge(a, b).unwrap();
        cloth.step(60);
    }
    assert_eq!(restored.state_hash(), straight.state_hash());
    assert_eq!(cloned.state_hash(), straight.state_hash());
    assert_eq!(restored.save(), straight.save());
}

#[test]
fn a_reset_cloth_behaves_like_a_new_cloth() {
    let mut old = cloth_after_script();
    old.reset();
    let mut new = Cloth::grid(&GridDesc {
        settings: old.settings().clone(),
        material: old.material().clone(),
        ..GridDesc::default()
    })
    .unwrap();
    new.set_wind(old.wind().clone()).unwrap();
    let floor = ColliderDesc { position: Vec3::new(0.0, -2.5, 0.0), ..ColliderDesc::default() };
    new.add_collider(&floor).unwrap();
    for cloth in [&mut old, &mut new] {
        cloth.step(100);
    }
    assert_eq!(old.state_hash(), new.state_hash());
}
