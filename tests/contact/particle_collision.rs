//! Particles of a cloth that keep apart: how far, from whom, and in the same bits after saving.

use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Settings};

/// A tenth of a metre apart are the particles of most cloths here.
const SPACING: f32 = 0.1;

/// Settings under which nothing but links and particles moves anything.
fn weightless(self_distance: f32) -> Settings {
    Settings {
        gravity: Vec3::ZERO,
        self_collision: SelfCollision::Particles,
        self_distance,
        ..crate::common::bare().0
    }
}

/// Two triangles that point at each other over a gap of 3 cm; particles 0 and 3 are their tips.
fn tip_to_tip(pinned: &[u32]) -> Cloth {
    let triangle = |tip: f32, way: f32| {
        let corner = |side: f32| Vec3::new(tip - way * SPACING, side * SPACING, 0.0);
        [Vec3::X * tip, corner(0.5), corner(-0.5)]
    };
    let mut desc = MeshDesc {
        positions: [triangle(0.0, 1.0), triangle(0.03, -1.0)].concat(),
        indices: (0..6).collect(),
        pinned: pinned.to_vec(),
        ..MeshDesc::default()
    };
    desc.settings = Settings { substeps: 1, ..weightless(0.05) };
    Cloth::mesh(&desc).unwrap()
}

#[test]
fn each_of_two_particles_makes_up_four_tenths_of_what_is_missing() {
    let mut cloth = tip_to_tip(&[]);
    cloth.step(1);
    let [left, right] = [0, 3].map(|tip| cloth.positions()[tip]);
    assert!((left - Vec3::X * -0.008).length() < 1.0e-6, "the left one is at {left}");
    assert!((right - Vec3::X * 0.038).length() < 1.0e-6, "the right one is at {right}");
}

#[test]
fn of_unequal_masses_the_lighter_particle_makes_up_more_and_their_middle_stays() {
    let mut cloth = tip_to_tip(&[]);
    cloth.set_mass_scales(&[0, 3], &[3.0, 1.0]).unwrap();
    cloth.step(1);
    let [left, right] = [0, 3].map(|tip| cloth.positions()[tip]);
    // Eight tenths of 2 cm, in parts of one to three.
    assert!((left - Vec3::X * -0.004).length() < 1.0e-6, "the left one is at {left}");
    assert!((right - Vec3::X * 0.042).length() < 1.0e-6, "the right one is at {right}");
}

#[test]
fn particles_that_are_held_are_passed_by() {
    let mut cloth = tip_to_tip(&[0]);
    let start = cloth.positions().to_vec();
    cloth.step(1);
    assert_eq!(cloth.positions(), start);
    cloth.unpin(0).unwrap();
    let grab = cloth.grab_particle(3).unwrap();
    cloth.step(1);
    assert_eq!(cloth.positions(), start);
    cloth.release(grab).unwrap();
    cloth.step(1);
    assert!(cloth.positions() != start);
}

/// Whatever the distance, a cloth that lies as it was woven stays as it lies.
#[test]
fn neighbours_in_the_weave_do_not_push_each_other() {
    for distance in [0.0, 0.15, 0.2] {
        let desc = crate::common::bare_grid(9, 9, SPACING, PinMode::None);
        let mut cloth = Cloth::grid(&GridDesc { settings: weightless(distance), ..desc }).unwrap();
        let start = cloth.positions().to_vec();
        cloth.step(10);
        let most = cloth.positions().iter().zip(&start).map(|(x, at)| (x - at).length());
        assert!(most.fold(0.0, f32::max) < 1.0e-5, "it moved, at a distance of {distance} m");
    }
}

#[test]
fn the_two_sides_of_a_cut_are_neighbours_still() {
    let desc = crate::common::bare_grid(9, 9, SPACING, PinMode::None);
    let mut cloth = Cloth::grid(&GridDesc { settings: weightless(0.0), ..desc }).unwrap();
    let (from, to) = (Vec3::new(-0.1, -0.33, -1.0), Vec3::new(0.61, -0.37, -1.0));
    assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 5);
    let start = cloth.positions().to_vec();
    cloth.step(10);
    let most = cloth.positions().iter().zip(&start).map(|(x, at)| (x - at).length());
    assert!(most.fold(0.0, f32::max) < 1.0e-5);
}

/// A sheet that stands on its edge over a floor and is about to crumple.
fn standing(side: u32, self_collision: SelfCollision) -> Cloth {
    let spacing = 1.0 / side as f32;
    let settings = Settings { self_collision, ..Settings::default() };
    let desc = GridDesc { columns: side, rows: side, spacing, settings, ..GridDesc::default() };
    let mut cloth = Cloth::grid(&GridDesc { pin_mode: PinMode::None, ..desc }).unwrap();
    let position = Vec3::NEG_Y * 1.05;
    cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).unwrap();
    for i in (0..side * side).step_by(7) {
        cloth.set_velocity(i, Vec3::Z * 0.05 * ((i % 5) as f32 - 2.0)).unwrap();
    }
    cloth
}

/// How many pairs of particles, two cells apart or more, are nearer than half of their distance.
fn crowded(cloth: &Cloth, side: u32) -> usize {
    let (x, least) = (cloth.positions(), 1.0 / 3.0 / side as f32);
    let cell = |i: u32| [i / side, i % side];
    let pairs = (0..side * side).flat_map(|i| (0..i).map(move |j| (i, j)));
    let is_crowded = |(i, j): &(u32, u32)| {
        let ways = [0, 1].map(|axis| cell(*i)[axis].abs_diff(cell(*j)[axis]));
        ways.into_iter().max() > Some(1)
            && (x[*i as usize] - x[*j as usize]).length_squared() < least * least
    };
    pairs.filter(is_crowded).count()
}

#[test]
fn a_sheet_that_crumples_keeps_its_particles_apart() {
    let side = 24;
    let ways = [SelfCollision::None, SelfCollision::Particles];
    let [without, with] = ways.map(|way| {
        let mut cloth = standing(side, way);
        cloth.step(60);
        (0..12)
            .map(|_| {
                cloth.step(5);
                crowded(&cloth, side)
            })
            .sum::<usize>()
    });
    println!("{without} pairs without, {with} with");
    assert!(without > 100, "only {without} pairs come near each other");
    assert!(50 * with < without, "{with} pairs are too near, {without} without");
}

/// When pairs are listed makes no difference: a restored cloth lists them at another time.
#[test]
fn a_restored_cloth_that_crumples_goes_on_in_the_same_bits() {
    let mut cloth = standing(20, SelfCollision::Particles);
    for tick in 0..120 {
        if tick == 15 {
            let at = |x: f32| Vec3::new(x, -0.8, -1.0);
            assert!(cloth.cut(at(0.2), at(0.8), Vec3::Z * 2.0).unwrap() > 0);
        }
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        cloth.step(1);
        restored.step(1);
        assert_eq!(restored.state_hash(), cloth.state_hash(), "tick {tick}");
    }
    assert!(cloth.positions().len() > 400, "nothing was cut");
}

#[test]
fn it_can_be_switched_on_and_off_at_any_time() {
    let mut cloth = standing(16, SelfCollision::None);
    cloth.step(60);
    let plain = cloth.settings().clone();
    let mut same = cloth.clone();
    let apart = Settings { self_collision: SelfCollision::Particles, ..plain.clone() };
    cloth.set_settings(apart.clone()).unwrap();
    assert_eq!(cloth.settings(), &apart);
    cloth.set_settings(plain.clone()).unwrap();
    cloth.step(1);
    same.step(1);
    assert_eq!(cloth.state_hash(), same.state_hash());
    cloth.set_settings(apart).unwrap();
    cloth.step(1);
    same.step(1);
    assert_ne!(cloth.state_hash(), same.state_hash());
}

#[test]
fn a_reset_cloth_plays_the_same_again() {
    let mut cloth = standing(16, SelfCollision::Particles);
    cloth.reset();
    cloth.step(90);
    let hash = cloth.state_hash();
    cloth.reset();
    cloth.step(90);
    assert_eq!(cloth.state_hash(), hash);
}
