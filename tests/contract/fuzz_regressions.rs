//! Bugs found by the fuzzer of the C library, each reduced to a minimal case.

use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, Error, GridDesc, Impulse, PinMode, SelfCollision};

/// A grid of 7 × 7 particles.
fn small_grid() -> GridDesc {
    GridDesc { columns: 7, rows: 7, ..GridDesc::default() }
}

/// A buffer of `max_tears_per_tick` entries would exceed any machine's memory.
#[test]
fn an_unlimited_number_of_tears_per_tick_needs_no_extra_memory() {
    let mut desc = small_grid();
    desc.settings.tearing = true;
    desc.settings.max_tears_per_tick = u32::MAX;
    let mut cloth = Cloth::grid(&desc).unwrap();
    assert!(cloth.stats().bytes < 1 << 20, "{} bytes", cloth.stats().bytes);
    cloth.set_settings(desc.settings.clone()).unwrap();
    cloth.reset();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    // A load on every link may tear every link in one tick.
    for cloth in [&mut cloth, &mut restored] {
        for particle in 14..49 {
            cloth.set_position(particle, Vec3::new(0.0, -9.0 * particle as f32, 0.0)).unwrap();
        }
        cloth.step(1);
        assert!(cloth.stats().particles > 60, "{} particles", cloth.stats().particles);
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
}

/// Neighbouring particles would round to the same position, and a save could not be restored.
#[test]
fn a_grid_too_far_from_the_origin_for_its_spacing_is_refused() {
    let far = |y: f32| GridDesc { origin: Vec3::Y * y, ..small_grid() };
    let refused = Cloth::grid(&far(4.0e37)).err();
    assert!(matches!(refused, Some(Error::BadValue { field: "origin", .. })), "{refused:?}");
    let cloth = Cloth::grid(&far(1.0e5)).unwrap();
    Cloth::restore(&cloth.save()).unwrap();
}

#[test]
fn normals_are_finite_wherever_a_particle_is_placed() {
    for far in [1.0e12, 1.0e20, 3.0e38] {
        let mut cloth = Cloth::grid(&small_grid()).unwrap();
        cloth.set_position(24, Vec3::new(far, -far, far)).unwrap();
        assert!(cloth.normals().iter().all(|normal| normal.is_finite()), "at {far} m");
    }
}

/// The original cloth kept its pin distances over a teleport, while the restored cloth measured
/// them again with other rounding.
#[test]
fn a_cloth_saved_after_a_teleport_continues_with_the_same_bits() {
    let mut cloth = Cloth::grid(&small_grid()).unwrap();
    cloth.step(20);
    cloth.teleport(Vec3::new(7.6, 7.6, 7.6), Quat::from_xyzw(0.0, 0.6, 0.0, 0.8)).unwrap();
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for cloth in [&mut cloth, &mut restored] {
        cloth.step(1);
    }
    assert_eq!(restored.state_hash(), cloth.state_hash());
}

/// A moved pin ends its tick at its target up to rounding. The original cloth kept the pin
/// distances from that tick, while the restored cloth measured them from the positions of the next
/// tick.
#[test]
fn a_cloth_saved_after_pins_moved_continues_with_the_same_bits() {
    for case in 0..40 {
        let mut cloth = Cloth::grid(&small_grid()).unwrap();
        let coordinate = |i: u32| ((37 * i + 11 * case) % 41) as f32 * 0.0731 - 1.5;
        for pin in 0..3 {
            let target =
                Vec3::new(coordinate(pin), coordinate(pin + 7), coordinate(pin + 13)) * 3.0;
            cloth.pin(16 * pin + 5, Some(target)).unwrap();
        }
        cloth.step(2);
        let mut restored = Cloth::restore(&cloth.save()).unwrap();
        for cloth in [&mut cloth, &mut restored] {
            cloth.step(2);
        }
        assert_eq!(restored.state_hash(), cloth.state_hash(), "case {case}");
    }
}

/// Long ticks tear a sheet into pieces that collide; a restored cloth rebuilds its pair cache.
#[test]
fn a_cloth_with_long_ticks_and_surface_collision_restores_to_the_same_bits() {
    let mut desc =
        GridDesc { columns: 11, rows: 12, pin_mode: PinMode::TopCorners, ..GridDesc::default() };
    let material = &mut desc.material;
    (material.stretch_stiffness_warp, material.stretch_stiffness_weft) = (0.0, 0.0);
    (material.shear_stiffness, material.tear_stretch) = (0.0, 4.0);
    let settings = &mut desc.settings;
    (settings.tick, settings.substeps, settings.iterations) = (0.828_125, 1, 1);
    (settings.self_collision, settings.tearing) = (SelfCollision::Surface, true);
    settings.max_tears_per_tick = 1_065_091_072;
    let mut cloth = Cloth::grid(&desc).unwrap();
    cloth.step(2);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for tick in 0..3 {
        assert_eq!(restored.state_hash(), cloth.state_hash(), "after {tick} ticks");
        cloth.step(1);
        restored.step(1);
    }
}

/// The torque of such a distant contact overflowed, and a save could not be restored.
#[test]
fn collider_impulses_are_finite_for_distant_contacts() {
    let mut desc = small_grid();
    desc.material.density = 1.0e3;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let floor = cloth.add_collider(&ColliderDesc::default()).unwrap();
    cloth.set_position(24, Vec3::new(3.0e38, -1.0, 3.0e38)).unwrap();
    cloth.step(1);
    let Impulse { linear, angular } = cloth.collider_impulse(floor).unwrap();
    assert!(linear.is_finite() && angular.is_finite(), "{linear} {angular}");
    Cloth::restore(&cloth.save()).unwrap();
}

/// The strain limit acts on a particle placed near the largest finite number.
#[test]
fn positions_stay_finite_wherever_a_particle_is_placed() {
    for (far, max_stretch) in [(f32::MAX, 0.0), (f32::MAX, 0.078), (2.0e38, 0.078), (1.0e20, 0.078)]
    {
        for particle in [0, 5] {
            let mut desc = GridDesc { columns: 4, pin_mode: PinMode::Corners, ..small_grid() };
            desc.settings.iterations = 2;
            desc.settings.max_stretch = max_stretch;
            let mut cloth = Cloth::grid(&desc).unwrap();
            cloth.set_position(particle, Vec3::new(-6.8, 0.6, far)).unwrap();
            for tick in 0..3 {
                let is_finite = cloth.positions().iter().all(|x| x.is_finite());
                assert!(
                    is_finite,
                    "{far} m, at most {max_stretch}, particle {particle}, tick {tick}"
                );
                cloth.step(1);
            }
        }
    }
}

#[test]
fn a_frame_move_that_would_overflow_positions_is_refused() {
    let far = Vec3::splat(-3.0e38);
    let mut cloth = Cloth::grid(&small_grid()).unwrap();
    cloth.step(2);
    cloth.set_frame(far, Quat::IDENTITY).unwrap();
    let before = cloth.state_hash();
    let turned = Quat::from_xyzw(0.0, 0.6, 0.0, 0.8);
    for refused in [cloth.move_frame(-far, turned, 0.5), cloth.teleport(-far, turned)] {
        assert!(matches!(refused, Err(Error::BadValue { field: "position", .. })), "{refused:?}");
    }
    assert_eq!(cloth.state_hash(), before);
    cloth.teleport(far, Quat::IDENTITY).unwrap();
}

/// The velocity and the change by gravity are finite, but their sum overflows.
#[test]
fn a_cloth_with_the_largest_velocity_and_gravity_can_be_restored() {
    let mut cloth = Cloth::grid(&small_grid()).unwrap();
    let mut settings = cloth.settings().clone();
    settings.gravity = Vec3::Y * f32::MAX;
    (settings.tick, settings.substeps) = (1.0, 1);
    cloth.set_settings(settings).unwrap();
    cloth.set_velocity(40, Vec3::Y * f32::MAX).unwrap();
    Cloth::restore(&cloth.save()).unwrap();
}

/// The difference of two finite positions can overflow.
#[test]
fn an_attachment_across_the_range_of_floats_can_be_restored() {
    let far = Vec3::splat(-3.0e38);
    let mut cloth = Cloth::grid(&small_grid()).unwrap();
    cloth.set_position(30, -far).unwrap();
    let attachment = cloth.attach(&[30, 31], far, Quat::IDENTITY).unwrap();
    Cloth::restore(&cloth.save()).unwrap();
    cloth.move_attachment(attachment, -far, Quat::IDENTITY).unwrap();
    cloth.set_position(31, far).unwrap();
    Cloth::restore(&cloth.save()).unwrap();
    cloth.step(2);
    Cloth::restore(&cloth.save()).unwrap();
}

/// The cut divides an edge whose length overflows.
#[test]
fn cutting_an_edge_across_the_range_of_floats_gives_finite_positions() {
    let far = Vec3::X * 3.0e38;
    for flip in [1.0, -1.0] {
        let mut cloth = Cloth::grid(&GridDesc { extra_particles: 200, ..small_grid() }).unwrap();
        for i in 0..cloth.positions().len() as u32 {
            let side = if i % 7 < 3 { flip } else { -flip };
            cloth.set_position(i, far * side + Vec3::Y * (0.01 * i as f32)).unwrap();
        }
        let corner = Vec3::new(0.0, -9.0, -1.0);
        let opened = cloth.cut(corner, corner + Vec3::Y * 18.0, Vec3::Z * 2.0).unwrap();
        assert!(opened > 0, "nothing was cut");
        assert!(cloth.positions().iter().all(|x| x.is_finite()), "flip {flip}");
    }
}

/// A hinge whose angle was not finite when it was torn must not stay non-finite.
#[test]
fn a_torn_fold_with_an_overflowed_angle_restores_to_the_same_bits() {
    let mut cloth = Cloth::grid(&GridDesc { extra_particles: 200, ..small_grid() }).unwrap();
    let [left, right] = [21, 27].map(|particle| cloth.positions()[particle]);
    cloth.crease(left, right, 1.0).unwrap();
    cloth.step(5);
    let before = cloth.positions().to_vec();
    cloth.set_position(24, Vec3::splat(3.0e38)).unwrap();
    cloth.step(1);
    for (particle, there) in before.into_iter().enumerate() {
        cloth.set_position(particle as u32, there).unwrap();
    }
    for particle in 22..27 {
        assert!(cloth.tear_edge(particle, particle + 7).unwrap(), "{particle}");
    }
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    for tick in 0..30 {
        cloth.step(1);
        restored.step(1);
        assert_eq!(restored.state_hash(), cloth.state_hash(), "tick {tick}");
    }
    assert!(cloth.stats().max_speed > 0.0, "nothing moves");
}
