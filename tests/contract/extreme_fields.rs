//! Fields of material, settings and wind with extreme values: the cloth stays finite and near its
//! pins, and ticks stay short.

use std::time::Duration;

use cpu_time::ThreadTime;
use muslin::glam::Vec3;
use muslin::{
    Cloth, ColliderDesc, EventKind, GridDesc, Material, Result, SelfCollision, Settings, Shape,
    Wind,
};

/// From the smallest denormal number to the largest.
const VALUES: [f32; 9] =
    [1.0e-45, 1.0e-38, 1.0e-30, 1.0e-20, 1.0e-10, 1.0e10, 1.0e20, 1.0e30, f32::MAX];

/// The longest time of a tick. Ordinary ticks take 0.1 ms here. The slowest take 70 ms: gravity of
/// 1e10 m/s² presses all layers together.
const LONGEST_TICK: Duration = Duration::from_millis(500);

type Field<T> = (&'static str, fn(&mut T) -> &mut f32);

const MATERIAL: [Field<Material>; 19] = [
    ("density", |m| &mut m.density),
    ("thickness", |m| &mut m.thickness),
    ("stretch_stiffness_warp", |m| &mut m.stretch_stiffness_warp),
    ("stretch_stiffness_weft", |m| &mut m.stretch_stiffness_weft),
    ("shear_stiffness", |m| &mut m.shear_stiffness),
    ("bend_stiffness", |m| &mut m.bend_stiffness),
    ("bend_damping", |m| &mut m.bend_damping),
    ("stretch_damping", |m| &mut m.stretch_damping),
    ("friction", |m| &mut m.friction),
    ("restitution", |m| &mut m.restitution),
    ("drag", |m| &mut m.drag),
    ("lift", |m| &mut m.lift),
    ("tear_stretch", |m| &mut m.tear_stretch),
    ("tear_variation", |m| &mut m.tear_variation),
    ("yield_angle", |m| &mut m.yield_angle),
    ("yield_creep", |m| &mut m.yield_creep),
    ("fold_length", |m| &mut m.fold_length),
    ("yield_hardening", |m| &mut m.yield_hardening),
    ("yield_weakening", |m| &mut m.yield_weakening),
];

const SETTINGS: [Field<Settings>; 9] = [
    ("tick", |s| &mut s.tick),
    ("damping", |s| &mut s.damping),
    ("max_displacement", |s| &mut s.max_displacement),
    ("max_stretch", |s| &mut s.max_stretch),
    ("self_distance", |s| &mut s.self_distance),
    ("sleep_speed", |s| &mut s.sleep_speed),
    ("pressure", |s| &mut s.pressure),
    ("gravity.x", |s| &mut s.gravity.x),
    ("gravity.y", |s| &mut s.gravity.y),
];

const WIND: [Field<Wind>; 5] = [
    ("velocity.z", |w| &mut w.velocity.z),
    ("gust", |w| &mut w.gust),
    ("wander", |w| &mut w.wander),
    ("turbulence", |w| &mut w.turbulence),
    ("air_density", |w| &mut w.air_density),
];

/// Returns a cloth in wind that hangs in front of a ball, with surface collision.
fn cloth_in_wind() -> Cloth {
    let mut desc = GridDesc { columns: 10, rows: 8, spacing: 0.1, ..GridDesc::default() };
    desc.settings.self_collision = SelfCollision::Surface;
    let mut cloth = Cloth::grid(&desc).unwrap();
    let ball = ColliderDesc { shape: Shape::Sphere, radius: 0.2, ..ColliderDesc::default() };
    let position = Vec3::new(0.45, -0.5, 0.25);
    cloth.add_collider(&ColliderDesc { position, ..ball }).unwrap();
    cloth.set_wind(Wind { velocity: Vec3::Z * 3.0, ..Wind::default() }).unwrap();
    cloth
}

/// Plays ten ticks with one extreme value, if `change` accepts it. Fails if a particle is not where
/// a cloth can be or a tick takes too long; returns whether particles had to be restored.
fn restores(name: &str, change: impl FnOnce(&mut Cloth) -> Result<()>) -> bool {
    let mut cloth = cloth_in_wind();
    if change(&mut cloth).is_err() {
        return false;
    }
    for tick in 0..10 {
        let start = ThreadTime::now();
        cloth.step(1);
        let took = start.elapsed();
        assert!(took < LONGEST_TICK, "{name}: tick {tick} takes {took:?}");
        let far = cloth.positions().iter().map(|x| x.length()).fold(0.0, f32::max);
        let is_finite = cloth.positions().iter().all(|x| x.is_finite());
        assert!(is_finite && far < 3.0, "{name}: a particle is {far} m away at tick {tick}");
    }
    std::iter::from_fn(|| cloth.next_event()).any(|event| event.kind == EventKind::Recovered)
}

/// Sets each field to a value in a cloth of its own, and returns the fields by which particles had
/// to be restored.
fn restoring<T>(
    fields: &[Field<T>],
    value: f32,
    read: impl Fn(&Cloth) -> T,
    write: impl Fn(&mut Cloth, T) -> Result<()>,
) -> Vec<(&'static str, f32)> {
    let has_restored = |(name, field): &&Field<T>| {
        restores(&format!("{name} = {value:e}"), |cloth| {
            let mut all = read(cloth);
            *field(&mut all) = value;
            write(cloth, all)
        })
    };
    fields.iter().filter(has_restored).map(|(name, _)| (*name, value)).collect()
}

#[test]
fn no_accepted_number_makes_the_cloth_explode_or_ticks_slow() {
    let mut found = Vec::new();
    for value in VALUES.into_iter().chain(VALUES.map(|value| -value)) {
        found.extend(restoring(&MATERIAL, value, |c| c.material().clone(), Cloth::set_material));
        found.extend(restoring(&SETTINGS, value, |c| c.settings().clone(), Cloth::set_settings));
        found.extend(restoring(&WIND, value, |c| c.wind().clone(), Cloth::set_wind));
    }
    // Accelerations that no position can hold; a mass and a time of which the inverse is infinite.
    for (name, value) in found {
        let is_beyond = match name {
            "gravity.x" | "gravity.y" => value.abs() >= 1.0e20,
            "velocity.z" => value.abs() >= 1.0e10,
            "density" | "tick" => value <= 1.0e-38,
            _ => false,
        };
        assert!(is_beyond, "{name} = {value:e}: particles were restored");
    }
}
