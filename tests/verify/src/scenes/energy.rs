//! Cloth that must come to rest, or keep its momentum.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{level_sheet, sphere, upright_sheet, with_bound, with_surface, without_losses};
use muslin::glam::{DVec3, Vec3};
use muslin::{GridDesc, MeshDesc, PinMode, Result, Wind};
use std::f32::consts::{PI, TAU};

pub fn scenes() -> Vec<Scene> {
    let mut scenes = vec![
        Scene::new("one-pin", 4800, one_pin),
        Scene::new("switching-tick", 360, switching_tick).short(360),
        Scene::new("small-ticks", 1000, small_ticks).short(1000),
        Scene::new("stiff-irregular-mesh", 60, irregular_fall).short(60),
        Scene::new("free-crumple", 240, || free_crumple(0.0)).short(120),
        Scene::new("free-crumple-bound", 240, || free_crumple(0.05)),
        Scene::new("rest-at-100-m", 660, || far(100.0, false)),
        Scene::new("far-5000-m-surface", 180, || far(5000.0, true)),
    ];
    for (name, stiffness) in [("2.5e-5", 2.5e-5), ("1e-3", 1.0e-3), ("1e-2", 1.0e-2), ("0.1", 0.1)]
    {
        let scene = Scene::new(format!("shell-{name}"), 60, move || shell(stiffness));
        scenes.push(if stiffness < 0.1 { scene } else { scene.short(60) });
    }
    scenes
}

/// A sheet on one pin, whose far corner is given a push; at rest in the end.
fn one_pin() -> Result<Setup> {
    let desc = GridDesc { columns: 20, rows: 20, pin_mode: PinMode::None, ..GridDesc::default() };
    let mut play = Play::grid(&desc)?;
    play.cloth.pin(0, None)?;
    play.cloth.set_velocity(399, Vec3::Z * 0.1)?;
    Ok(Setup::from(play).watch(|play, tick| match play.rms_speed() {
        speed if tick + 1 == 4800 && speed > 1.0e-3 => Err(format!("it moves at {speed} m/s")),
        _ => Ok(()),
    }))
}

/// A hung sheet whose tick is switched between 1/60 s and 1/600 s.
fn switching_tick() -> Result<Setup> {
    let play = Play::grid(&GridDesc { columns: 8, rows: 8, ..GridDesc::default() })?;
    let mut last = 0.0_f32;
    let setup = Setup::from(play).drive(|play, tick| {
        let is_short = tick >= 120 && !tick.is_multiple_of(2);
        let settings = play.cloth.settings().clone();
        let tick = if is_short { 1.0 / 600.0 } else { 1.0 / 60.0 };
        play.cloth.set_settings(muslin::Settings { tick, ..settings })
    });
    Ok(setup.watch(move |play, _| {
        let (speed, most) = (play.max_speed(), 9.81 * play.cloth.settings().tick);
        let jump = speed - std::mem::replace(&mut last, speed);
        if jump > most * 1.01 { Err(format!("a particle is {jump} m/s faster")) } else { Ok(()) }
    }))
}

/// A free sheet of four particles that falls in ticks of 0.1 ms.
fn small_ticks() -> Result<Setup> {
    let mut desc = without_losses(GridDesc {
        columns: 2,
        rows: 2,
        pin_mode: PinMode::None,
        ..GridDesc::default()
    });
    desc.settings.tick = 1.0e-4;
    let mut play = Play::grid(&desc)?;
    play.cloth.set_wind(Wind { air_density: 0.0, ..Wind::default() })?;
    let watch = |play: &Play, tick: u32| {
        let exact = Vec3::NEG_Y * (9.81e-4 * (tick + 1) as f32);
        let mean = (0..4).filter_map(|i| play.cloth.velocity(i)).sum::<Vec3>() / 4.0;
        let error = (mean - exact).length();
        if error > 1.0e-3 { Err(format!("the velocity is {error} m/s off")) } else { Ok(()) }
    };
    Ok(Setup::from(play).watch(watch).free())
}

/// A stiff irregular mesh with much damping of stretch that falls in vacuum.
fn irregular_fall() -> Result<Setup> {
    let mut desc = MeshDesc::default();
    let noise = |i: u32, j: u32, k: u32| {
        let mixed = (i * 31 + j * 17 + k * 101 + 1).wrapping_mul(0x9e37_79b9) >> 16;
        mixed as f32 / 32768.0 - 1.0
    };
    crate::shapes::push_patch(&mut desc, 31, 31, |i, j| {
        Vec3::new(i as f32 + 0.3 * noise(i, j, 0), 0.0, j as f32 + 0.3 * noise(i, j, 1)) * 0.03
    });
    desc.settings.damping = 0.0;
    (desc.material.drag, desc.material.lift) = (0.0, 0.0);
    desc.material.stretch_stiffness_warp = 1.0e4;
    desc.material.stretch_stiffness_weft = 1.0e4;
    desc.material.stretch_damping = 1.0;
    let play = Play::mesh(&desc)?;
    let start = center(&play);
    let watch = move |play: &Play, _| {
        let drift = (center(play) - start).with_y(0.0).length();
        if drift > 1.0e-5 { Err(format!("the centroid is {drift} m off")) } else { Ok(()) }
    };
    Ok(Setup::from(play).watch(watch).free())
}

/// Centre of mass [m].
fn center(play: &Play) -> DVec3 {
    let (mut sum, mut mass) = (DVec3::ZERO, 0.0);
    for i in 0..play.cloth.particle_count() {
        if let (Some(m), Some(x)) = (play.cloth.mass(i), play.cloth.position(i)) {
            sum += x.as_dvec3() * f64::from(m);
            mass += f64::from(m);
        }
    }
    sum / mass
}

/// A free sheet without gravity whose waves fold it onto itself.
fn free_crumple(max_stretch: f32) -> Result<Setup> {
    let mut desc = with_bound(with_surface(without_losses(upright_sheet(24, 0.6))), max_stretch);
    desc.settings.gravity = Vec3::ZERO;
    let mut play = Play::grid(&desc)?;
    play.set_velocities(|x| {
        let wave = (9.0 * x.x + 1.0).sin() * (7.0 * x.y + 2.0).sin();
        Vec3::new(-3.0 * x.x, -2.0 * x.y, 2.0 * wave)
    })?;
    Ok(Setup::from(play).free())
}

/// A closed ellipsoid at rest without gravity; it must stay where it is.
fn shell(bend_stiffness: f32) -> Result<Setup> {
    let mut desc = MeshDesc::default();
    let (rings, around) = (12, 24);
    let size = Vec3::new(0.12, 0.04, 0.12);
    desc.positions.push(Vec3::Y * size.y);
    for (ring, k) in (1..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))) {
        let (sine, cosine) = (ring as f32 / rings as f32 * PI).sin_cos();
        let (s, c) = (k as f32 / around as f32 * TAU).sin_cos();
        desc.positions.push(Vec3::new(sine * c, cosine, sine * s) * size);
    }
    desc.positions.push(Vec3::NEG_Y * size.y);
    let last = desc.positions.len() as u32 - 1;
    let at = |ring: u32, k: u32| match ring {
        0 => 0,
        ring if ring == rings => last,
        ring => 1 + (ring - 1) * around + k % around,
    };
    for (ring, k) in (0..rings).flat_map(|ring| (0..around).map(move |k| (ring, k))) {
        let (a, b, c, d) = (at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1));
        if ring > 0 {
            desc.indices.extend([a, b, c]);
        }
        if ring + 1 < rings {
            desc.indices.extend([b, d, c]);
        }
    }
    desc.settings.gravity = Vec3::ZERO;
    desc.settings.damping = 0.0;
    desc.material.bend_stiffness = bend_stiffness;
    let mut play = Play::mesh(&desc)?;
    play.cloth.set_wind(Wind { air_density: 0.0, ..Wind::default() })?;
    let start = center(&play);
    let watch = move |play: &Play, _| {
        let drift = (center(play) - start).length();
        if drift > 1.0e-5 { Err(format!("the centroid is {drift} m off")) } else { Ok(()) }
    };
    Ok(Setup::from(play).watch(watch).free())
}

/// A sheet that comes to rest on a ball far from the origin.
fn far(x: f32, is_surface: bool) -> Result<Setup> {
    let mut desc = level_sheet(12, 0.55, 0.31);
    desc.origin.x += x;
    let mut play = Play::grid(&if is_surface { with_surface(desc) } else { desc })?;
    play.add(sphere(0.3, Vec3::X * x))?;
    Ok(Setup::from(play).watch(|play, tick| match play.rms_speed() {
        speed if tick >= 600 && speed > 1.0e-3 => Err(format!("it moves at {speed} m/s")),
        _ => Ok(()),
    }))
}
