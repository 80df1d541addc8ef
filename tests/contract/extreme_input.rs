//! Extreme input: positions stay finite, and the cloth comes to rest again.

use crate::common::assert_tear_invariants;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode, Wind};

/// Largest distance of any particle from the middle of the pins [m].
fn largest_distance(cloth: &Cloth) -> f32 {
    cloth.positions().iter().map(|x| (*x - Vec3::new(1.0, 0.0, 0.0)).length()).fold(0.0, f32::max)
}

/// A hanging sheet with every slider of the demo's panel at its extreme.
fn sheet_at_slider_limits(tearing: bool, iterations: u32) -> Cloth {
    let mut desc = GridDesc::default();
    desc.settings.gravity = Vec3::NEG_Y * 20.0;
    desc.settings.iterations = iterations;
    desc.settings.tearing = tearing;
    desc.settings.damping = -(1.0_f32 - 0.06).ln() * 60.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let velocity = Vec3::new(1.0, 1.0, 3.0) * 6.0;
    let wind = Wind { velocity, gust: 1.0, wander: 3.0, turbulence: 1.0, ..Wind::default() };
    cloth.set_wind(wind).unwrap();
    cloth
}

#[test]
fn a_sheet_at_the_slider_limits_stays_finite_and_comes_to_rest() {
    for (tearing, iterations) in [(false, 12), (false, 1), (true, 12)] {
        let mut cloth = sheet_at_slider_limits(tearing, iterations);
        let before = cloth.clone();
        let mut grab = None;
        for tick in 0..1_500_u32 {
            if tick % 100 == 0 {
                if let Some(previous) = grab.take() {
                    cloth.release(previous).unwrap();
                }
                let particle = tick.wrapping_mul(2_654_435_761) % cloth.positions().len() as u32;
                grab = Some(cloth.grab_particle(particle).unwrap());
            }
            // Move the grab far away and back within a few ticks.
            let t = tick as f32;
            let thrown = Vec3::new((t * 0.9).sin(), (t * 0.53).cos(), (t * 0.71).sin()) * 6.0;
            cloth.move_grab(grab.unwrap(), thrown).unwrap();
            cloth.step(1);
            assert!(cloth.positions().iter().all(|x| x.is_finite()), "tick {tick}");
            // The sheet is 1.95 m high and wide; the grab moves up to 6·√3 m away. Torn pieces may
            // fly farther.
            assert!(
                tearing || largest_distance(&cloth) < 6.0 * 1.74 + 1.95,
                "tick {tick}: {}",
                largest_distance(&cloth)
            );
        }
        cloth.release(grab.unwrap()).unwrap();
        assert_tear_invariants(&cloth, &before);
        if tearing {
            continue;
        }
        cloth.set_wind(Wind::default()).unwrap();
        cloth.step(1800);
        let mass: f32 = (0..1600).map(|i| cloth.mass(i).unwrap()).sum();
        let speed = (2.0 * cloth.stats().kinetic_energy / mass).sqrt();
        assert!(
            speed < 1.0e-3,
            "with {iterations} iterations the sheet still moves at {speed} m/s"
        );
        assert!(largest_distance(&cloth) < 2.3);
    }
}

#[test]
fn a_cloth_with_non_finite_positions_recovers_and_reports_an_event() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    cloth.step(10);
    for particle in [500, 501, 900] {
        cloth.set_velocity(particle, Vec3::splat(f32::MAX)).unwrap();
    }
    cloth.step(300);
    let event = cloth.next_event().expect("an event");
    assert_eq!(event.kind, muslin::EventKind::Recovered);
    assert!(event.count >= 1);
    assert!(cloth.positions().iter().all(|x| x.is_finite()));
    assert!(largest_distance(&cloth) < 2.5, "{}", largest_distance(&cloth));
}

#[test]
fn a_grabbed_particle_reaches_its_target_exactly_within_the_speed_limit() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    cloth.step(60);
    let grabs = [(420, Vec3::new(0.3, -0.5, 0.4)), (1430, Vec3::new(1.5, -1.6, -0.4))];
    let handles: Vec<_> = grabs.iter().map(|(i, _)| cloth.grab_particle(*i).unwrap()).collect();
    for (grab, (_, target)) in handles.iter().zip(grabs) {
        cloth.move_grab(*grab, target).unwrap();
    }
    let most = 0.5 * 0.05 * cloth.settings().substeps as f32;
    for _ in 0..60 {
        let before: Vec<Vec3> = grabs.iter().map(|(i, _)| cloth.positions()[*i as usize]).collect();
        cloth.step(1);
        for ((i, _), before) in grabs.iter().zip(before) {
            let moved = (cloth.positions()[*i as usize] - before).length();
            assert!(moved <= most * 1.001, "the particle moved {moved} m in one tick");
        }
    }
    for (i, target) in grabs {
        assert_eq!(cloth.positions()[i as usize], target);
    }
    for grab in handles {
        cloth.release(grab).unwrap();
    }
}

#[test]
fn a_released_particle_keeps_the_velocity_of_its_grab() {
    let mut desc = GridDesc { columns: 6, rows: 6, pin_mode: PinMode::None, ..GridDesc::default() };
    desc.settings.gravity = Vec3::ZERO;
    desc.material.drag = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let grabs: Vec<_> = (0..36).map(|i| cloth.grab_particle(i).unwrap()).collect();
    let start = cloth.positions().to_vec();
    for tick in 1..=30 {
        for (grab, x) in grabs.iter().zip(&start) {
            cloth.move_grab(*grab, *x + Vec3::X * (tick as f32 / 60.0)).unwrap();
        }
        cloth.step(1);
    }
    for grab in grabs {
        cloth.release(grab).unwrap();
    }
    cloth.step(1);
    let v = cloth.velocity(14).unwrap();
    assert!((v - Vec3::X).length() < 0.05, "{v}");
}

#[test]
fn pinned_particles_reach_their_targets_in_the_same_tick() {
    let mut cloth = Cloth::grid(&GridDesc::default()).unwrap();
    let top: Vec<u32> = (0..40).collect();
    let start = cloth.positions()[..40].to_vec();
    for tick in 1..=120 {
        let shift = Vec3::new((tick as f32 * 0.1).sin(), 0.0, (tick as f32 * 0.07).sin()) * 0.5;
        let targets: Vec<Vec3> = start.iter().map(|x| *x + shift).collect();
        cloth.set_pin_targets(&top, &targets).unwrap();
        cloth.step(1);
        for (x, target) in cloth.positions().iter().zip(&targets) {
            assert!((*x - *target).length() < 1.0e-6);
        }
    }
    cloth.unpin_all();
    let y = cloth.positions()[0].y;
    cloth.step(60);
    let fallen = y - cloth.positions()[0].y;
    assert!(fallen > 0.5, "the unpinned sheet fell only {fallen} m");
}

#[test]
fn advance_runs_the_due_ticks_and_drops_the_backlog() {
    let mut cloth = Cloth::grid(&GridDesc { columns: 4, rows: 4, ..GridDesc::default() }).unwrap();
    assert_eq!(cloth.advance(0.0), Ok(0));
    assert_eq!(cloth.advance(0.010), Ok(0));
    assert!((cloth.blend() - 0.6).abs() < 1.0e-4);
    assert_eq!(cloth.advance(0.010), Ok(1));
    assert_eq!(cloth.advance(10.0), Ok(5));
    assert!(cloth.blend() < 1.0);
    assert_eq!(cloth.stats().ticks, 6);
}
