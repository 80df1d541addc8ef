//! Particle collision: separation distance, excluded pairs, and bit identity after a restore.

use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, MeshDesc, PinMode, SelfCollision, Settings};

/// Spacing of the particles in most cloths of this file [m].
const SPACING: f32 = 0.1;

/// Settings in which only links and particle collision move particles.
fn zero_gravity_settings(self_distance: f32) -> Settings {
    Settings {
        gravity: Vec3::ZERO,
        self_collision: SelfCollision::Particles,
        self_distance,
        ..crate::common::bare().0
    }
}

/// Two triangles that point at each other across a gap of 3 cm; particles 0 and 3 are their tips.
fn opposing_triangles(pinned: &[u32]) -> Cloth {
    let triangle = |tip: f32, direction: f32| {
        let corner = |side: f32| Vec3::new(tip - direction * SPACING, side * SPACING, 0.0);
        [Vec3::X * tip, corner(0.5), corner(-0.5)]
    };
    let mut desc = MeshDesc {
        positions: [triangle(0.0, 1.0), triangle(0.03, -1.0)].concat(),
        indices: (0..6).collect(),
        pinned: pinned.to_vec(),
        ..MeshDesc::default()
    };
    desc.settings = Settings { substeps: 1, ..zero_gravity_settings(0.05) };
    Cloth::mesh(&desc).unwrap()
}

#[test]
fn each_of_two_equal_particles_corrects_four_tenths_of_the_penetration() {
    let mut cloth = opposing_triangles(&[]);
    cloth.step(1);
    let [left, right] = [0, 3].map(|tip| cloth.positions()[tip]);
    assert!((left - Vec3::X * -0.008).length() < 1.0e-6, "the left one is at {left}");
    assert!((right - Vec3::X * 0.038).length() < 1.0e-6, "the right one is at {right}");
}

#[test]
fn the_correction_is_split_by_inverse_mass_and_keeps_the_centre_of_mass() {
    let mut cloth = opposing_triangles(&[]);
    cloth.set_mass_scales(&[0, 3], &[3.0, 1.0]).unwrap();
    cloth.step(1);
    let [left, right] = [0, 3].map(|tip| cloth.positions()[tip]);
    // Eight tenths of 2 cm, split 1 to 3.
    assert!((left - Vec3::X * -0.004).length() < 1.0e-6, "the left one is at {left}");
    assert!((right - Vec3::X * 0.042).length() < 1.0e-6, "the right one is at {right}");
}

#[test]
fn a_pair_with_a_pinned_or_grabbed_particle_is_not_separated() {
    let mut cloth = opposing_triangles(&[0]);
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

/// A cloth in its rest shape does not move, whatever the collision distance.
#[test]
fn neighbours_in_the_rest_shape_do_not_collide() {
    for distance in [0.0, 0.15, 0.2] {
        let desc = crate::common::bare_grid(9, 9, SPACING, PinMode::None);
        let mut cloth =
            Cloth::grid(&GridDesc { settings: zero_gravity_settings(distance), ..desc }).unwrap();
        let start = cloth.positions().to_vec();
        cloth.step(10);
        let most = cloth.positions().iter().zip(&start).map(|(x, at)| (x - at).length());
        assert!(
            most.fold(0.0, f32::max) < 1.0e-5,
            "the sheet moved, at a distance of {distance} m"
        );
    }
}

#[test]
fn the_two_sides_of_a_cut_do_not_collide() {
    let desc = crate::common::bare_grid(9, 9, SPACING, PinMode::None);
    let mut cloth =
        Cloth::grid(&GridDesc { settings: zero_gravity_settings(0.0), ..desc }).unwrap();
    let (from, to) = (Vec3::new(-0.1, -0.33, -1.0), Vec3::new(0.61, -0.37, -1.0));
    assert!(cloth.cut(from, to, Vec3::Z * 2.0).unwrap() > 5);
    let start = cloth.positions().to_vec();
    cloth.step(10);
    let most = cloth.positions().iter().zip(&start).map(|(x, at)| (x - at).length());
    assert!(most.fold(0.0, f32::max) < 1.0e-5);
}

/// A sheet that stands on its edge over a floor and is about to crumple.
fn standing_sheet(side: u32, self_collision: SelfCollision) -> Cloth {
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

/// Number of particle pairs, at least two cells apart, that are closer than a third of the spacing.
fn close_pair_count(cloth: &Cloth, side: u32) -> usize {
    let (x, least) = (cloth.positions(), 1.0 / 3.0 / side as f32);
    let cell = |i: u32| [i / side, i % side];
    let pairs = (0..side * side).flat_map(|i| (0..i).map(move |j| (i, j)));
    let is_close = |(i, j): &(u32, u32)| {
        let cell_distances = [0, 1].map(|axis| cell(*i)[axis].abs_diff(cell(*j)[axis]));
        cell_distances.into_iter().max() > Some(1)
            && (x[*i as usize] - x[*j as usize]).length_squared() < least * least
    };
    pairs.filter(is_close).count()
}

#[test]
fn particle_collision_separates_the_particles_of_a_crumpled_sheet() {
    let side = 24;
    let modes = [SelfCollision::None, SelfCollision::Particles];
    let [without, with] = modes.map(|mode| {
        let mut cloth = standing_sheet(side, mode);
        cloth.step(60);
        (0..12)
            .map(|_| {
                cloth.step(5);
                close_pair_count(&cloth, side)
            })
            .sum::<usize>()
    });
    println!("{without} pairs without, {with} with");
    assert!(without > 100, "only {without} pairs come close");
    assert!(
        50 * with < without,
        "{with} pairs are too close, {without} without particle collision"
    );
}

/// A restored cloth rebuilds its pair list at another tick, which must not change the result.
#[test]
fn a_cloth_restored_while_it_crumples_continues_with_the_same_bits() {
    let mut cloth = standing_sheet(20, SelfCollision::Particles);
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
fn particle_collision_can_be_switched_on_and_off_at_any_time() {
    let mut cloth = standing_sheet(16, SelfCollision::None);
    cloth.step(60);
    let plain = cloth.settings().clone();
    let mut same = cloth.clone();
    let colliding = Settings { self_collision: SelfCollision::Particles, ..plain.clone() };
    cloth.set_settings(colliding.clone()).unwrap();
    assert_eq!(cloth.settings(), &colliding);
    cloth.set_settings(plain.clone()).unwrap();
    cloth.step(1);
    same.step(1);
    assert_eq!(cloth.state_hash(), same.state_hash());
    cloth.set_settings(colliding).unwrap();
    cloth.step(1);
    same.step(1);
    assert_ne!(cloth.state_hash(), same.state_hash());
}

#[test]
fn a_reset_cloth_repeats_the_same_bits() {
    let mut cloth = standing_sheet(16, SelfCollision::Particles);
    cloth.reset();
    cloth.step(90);
    let hash = cloth.state_hash();
    cloth.reset();
    cloth.step(90);
    assert_eq!(cloth.state_hash(), hash);
}
