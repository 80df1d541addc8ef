//! Layers of a cloth go through each other, so that a cloth thrown about hangs in a tangle whose links
//! cannot all have their lengths. It comes to rest all the same, as does any sheet after wind.

use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode, Wind};

/// The most that still counts as rest [m/s].
const REST: f32 = 1.0e-3;

/// Different ways to be thrown about.
const SEEDS: u32 = 6;

/// Root mean square speed of the next two seconds [m/s].
fn speed(cloth: &mut Cloth) -> f32 {
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

/// A cloth that was thrown about by a hand in a storm, then left alone.
fn tangled(mut desc: GridDesc, iterations: u32, seed: u32) -> Cloth {
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

/// A mere swing would come to rest as well, so some of them must be tangles indeed.
fn assert_tangles_rest(side: u32, pin_mode: PinMode, iterations: u32) {
    let mut most_stretch: f32 = 0.0;
    for seed in 0..SEEDS {
        let mut cloth = tangled(sheet(side, pin_mode), iterations, seed);
        let speed = speed(&mut cloth);
        assert!(
            speed < REST,
            "{side}² by {pin_mode:?} with {iterations} sweeps, {seed}: {speed} m/s"
        );
        most_stretch = most_stretch.max(cloth.stats().max_stretch);
    }
    assert!(most_stretch > 0.02, "no tangle: stretched by {most_stretch}");
}

#[test]
fn a_coarse_tangle_comes_to_rest() {
    assert_tangles_rest(24, PinMode::TopEdge, 2);
}

#[test]
fn a_coarse_tangle_of_many_sweeps_comes_to_rest() {
    assert_tangles_rest(24, PinMode::TopEdge, 12);
}

#[test]
fn a_tangle_comes_to_rest() {
    assert_tangles_rest(40, PinMode::TopEdge, 2);
}

#[test]
fn a_tangle_of_many_sweeps_comes_to_rest() {
    assert_tangles_rest(40, PinMode::TopEdge, 12);
}

#[test]
fn a_tangle_hung_by_two_corners_comes_to_rest() {
    assert_tangles_rest(24, PinMode::TopCorners, 2);
    assert_tangles_rest(40, PinMode::TopCorners, 2);
}

#[test]
fn a_sheet_comes_to_rest_after_wind_however_fine_it_is_and_coarse_its_ticks() {
    for (side, rate) in [(24, 60), (40, 60), (56, 30), (128, 60)] {
        let mut desc = sheet(side, PinMode::TopEdge);
        desc.settings.tick = 1.0 / rate as f32;
        let mut cloth = Cloth::grid(&desc).unwrap();
        cloth.set_wind(Wind { velocity: Vec3::Z * 2.0, ..Wind::default() }).unwrap();
        cloth.step(5 * rate);
        cloth.set_wind(Wind::default()).unwrap();
        cloth.step(24 * rate);
        let speed = speed(&mut cloth);
        assert!(speed < REST, "{side}² at {rate} Hz still moves at {speed} m/s");
    }
}
