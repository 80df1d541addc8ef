//! A cloth without self-collision that was thrown about intersects itself, so that its links cannot
//! all reach their rest lengths. It comes to rest nevertheless, as does any sheet after wind.

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode, Wind};

/// Highest speed that counts as rest [m/s].
const REST: f32 = 1.0e-3;

/// Number of random sequences of throws.
const SEEDS: u32 = 4;
/// Number of sequences for cloths with many iterations, which take long.
const FEW_SEEDS: u32 = 2;

/// Runs two seconds and returns the RMS speed over them, weighted by mass [m/s].
fn rms_speed_over_two_seconds(cloth: &mut Cloth) -> f32 {
    let mass: f32 = (0..cloth.positions().len() as u32).map(|i| cloth.mass(i).unwrap()).sum();
    let ticks = (2.0 / cloth.settings().tick) as u32;
    let mut sum = 0.0;
    for _ in 0..ticks {
        cloth.step(1);
        sum += 2.0 * cloth.stats().kinetic_energy / mass;
    }
    (sum / ticks as f32).sqrt()
}

fn sheet(side: u32, pin_mode: PinMode) -> GridDesc {
    let spacing = 1.95 / (side - 1) as f32;
    GridDesc { columns: side, rows: side, spacing, pin_mode, ..GridDesc::default() }
}

/// A cloth that a grab threw about in strong wind and that then hung freely for 28 s.
fn self_intersecting_cloth(mut desc: GridDesc, iterations: u32, seed: u32) -> Cloth {
    desc.settings.gravity = Vec3::NEG_Y * 20.0;
    desc.settings.iterations = iterations;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let velocity = Vec3::new(1.0, 1.0, 3.0) * 6.0;
    let storm = Wind { velocity, gust: 1.0, wander: 3.0, turbulence: 1.0, ..Wind::default() };
    cloth.set_wind(Wind { seed, ..storm }).unwrap();
    for throw in 0..20 {
        let chosen = (100 * throw + 7919 * seed).wrapping_mul(2_654_435_761);
        let grab = cloth.grab_particle(chosen % cloth.positions().len() as u32).unwrap();
        for tick in 0..100 {
            let t = (100 * (throw + seed) + tick) as f32;
            let thrown = Vec3::new((t * 0.9).sin(), (t * 0.53).cos(), (t * 0.71).sin()) * 6.0;
            cloth.move_grab(grab, thrown).unwrap();
            cloth.step(1);
        }
        cloth.release(grab).unwrap();
    }
    cloth.set_wind(Wind::default()).unwrap();
    cloth.step(1680);
    cloth
}

/// Asserts that cloths that were thrown about come to rest, and that at least one stays stretched
/// by its intersections: a cloth that only swings would come to rest in any case.
fn assert_intersecting_cloths_rest(side: u32, pin_mode: PinMode, iterations: u32) {
    let mut most_stretch: f32 = 0.0;
    let seeds = if iterations > 2 { FEW_SEEDS } else { SEEDS };
    for seed in 0..seeds {
        let mut cloth = self_intersecting_cloth(sheet(side, pin_mode), iterations, seed);
        let speed = rms_speed_over_two_seconds(&mut cloth);
        assert!(
            speed < REST,
            "{side}² by {pin_mode:?} with {iterations} iterations, seed {seed}: {speed} m/s"
        );
        most_stretch = most_stretch.max(cloth.stats().max_stretch);
    }
    assert!(most_stretch > 0.02, "no cloth is entangled: the largest stretch is {most_stretch}");
}

#[test]
fn a_coarse_self_intersecting_sheet_comes_to_rest() {
    assert_intersecting_cloths_rest(24, PinMode::TopEdge, 2);
}

#[test]
fn a_coarse_self_intersecting_sheet_with_many_iterations_comes_to_rest() {
    assert_intersecting_cloths_rest(24, PinMode::TopEdge, 12);
}

#[test]
fn a_self_intersecting_sheet_comes_to_rest() {
    assert_intersecting_cloths_rest(40, PinMode::TopEdge, 2);
}

#[test]
fn a_self_intersecting_sheet_with_many_iterations_comes_to_rest() {
    assert_intersecting_cloths_rest(40, PinMode::TopEdge, 12);
}

#[test]
fn a_self_intersecting_sheet_pinned_at_two_corners_comes_to_rest() {
    assert_intersecting_cloths_rest(24, PinMode::TopCorners, 2);
    assert_intersecting_cloths_rest(40, PinMode::TopCorners, 2);
}

#[test]
fn a_sheet_comes_to_rest_after_wind_at_any_resolution_and_tick_length() {
    for (side, rate) in [(24, 60), (40, 60), (56, 30), (96, 60)] {
        let mut desc = sheet(side, PinMode::TopEdge);
        desc.settings.tick = 1.0 / rate as f32;
        let mut cloth = Cloth::grid(&desc).unwrap();
        cloth.set_wind(Wind { velocity: Vec3::Z * 2.0, ..Wind::default() }).unwrap();
        cloth.step(5 * rate);
        cloth.set_wind(Wind::default()).unwrap();
        cloth.step(24 * rate);
        let speed = rms_speed_over_two_seconds(&mut cloth);
        assert!(speed < REST, "{side}² at {rate} Hz still moves at {speed} m/s");
    }
}
