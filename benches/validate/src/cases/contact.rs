//! Friction, restitution and rest on a floor.

use super::G;
use crate::player::{DAMPING, Player};
use crate::run::{Outcome, Run};
use crate::strip::{Strip, horizontal, limp};
use crate::trial::{Case, Quantity, Trial};
use muslin::glam::Vec3;
use muslin::{ColliderDesc, Material};

const DENSITY: f64 = 0.18;

/// A level sheet of 0.3 m with a quarter of the nodes along its other side, `height` [m] above the
/// floor.
fn sheet(run: &Run, height: f64, damping: f32, material: Material) -> muslin::Result<Player> {
    let [along, across] = horizontal(0.0);
    let sheet = Strip {
        columns: run.nodes,
        rows: run.nodes / 4,
        spacing: 0.3 / f64::from(run.nodes - 1),
        along,
        across,
        material,
        settings: run.settings(G, damping),
    };
    let mut player = sheet.pinned(&[])?;
    let lift = Vec3::Y * (height + f64::from(player.cloth.material().thickness)) as f32;
    let lifted: Vec<Vec3> = player.cloth.positions().iter().map(|x| *x + lift).collect();
    player.cloth.set_positions(0, &lifted)?;
    player.cloth.add_collider(&ColliderDesc::default())?;
    Ok(player)
}

/// The sheet on the floor, with this coefficient of friction.
fn sliding(run: &Run, friction: f64) -> muslin::Result<Player> {
    sheet(run, 0.0, 0.0, Material { friction: friction as f32, ..limp(DENSITY) })
}

fn middle_x(player: &Player) -> f64 {
    player.mean(0..player.cloth.particle_count()).x
}

/// Turns gravity to the slope of `degrees`.
fn tilt(player: &mut Player, degrees: f64) -> muslin::Result<()> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let mut settings = player.cloth.settings().clone();
    settings.gravity = Vec3::new((G * sine) as f32, (-G * cosine) as f32, 0.0);
    player.cloth.set_settings(settings)
}

pub fn friction() -> Case {
    let trials = vec![
        threshold(0.2),
        threshold(0.5),
        threshold(1.0),
        slide(0.3, 30.0),
        stop(0.5, 2.0),
        stop(0.2, 2.0),
        stop(0.37, 1.3),
    ];
    Case {
        name: "friction",
        about: "a sheet on a plane: the slope at which it starts to slide, the way down a slope, \
                and the way until it stops on the level",
        source: "Coulomb: tan θ = µ; a = g (sin θ − µ cos θ); v² / (2 µ g)",
        trials,
        is_default: true,
    }
}

/// The slope grows by 1° a second until the sheet has slid by 1 mm.
fn threshold(friction: f64) -> Trial {
    let exact = friction.atan().to_degrees();
    let name = format!("slope at which it slides, µ = {friction} [°]");
    Trial::new([Quantity::absolute(name, exact, [1.0, 3.0])], move |run| {
        let mut player = sliding(run, friction)?;
        let start = middle_x(&player);
        let first = exact - 4.0;
        for tick in 0..player.ticks_in(10.0) {
            let degrees = first + f64::from(tick) / f64::from(run.rate);
            tilt(&mut player, degrees)?;
            player.step(1);
            if middle_x(&player) - start > 1.0e-3 {
                return Ok(Outcome::of(&player, [degrees]));
            }
        }
        Ok(Outcome::of(&player, [f64::NAN]))
    })
}

fn slide(friction: f64, degrees: f64) -> Trial {
    let angle = degrees.to_radians();
    let exact = 0.5 * G * (angle.sin() - friction * angle.cos());
    let name = format!("way in 1 s, {degrees}°, µ = {friction} [m]");
    Trial::new([Quantity::relative(name, exact, [0.03, 0.1])], move |run| {
        let mut player = sliding(run, friction)?;
        tilt(&mut player, degrees)?;
        let start = middle_x(&player);
        player.play(1.0);
        Ok(Outcome::of(&player, [middle_x(&player) - start]))
    })
}

fn stop(friction: f64, speed: f64) -> Trial {
    let exact = speed * speed / (2.0 * friction * G);
    let name = format!("way until it stops, {speed} m/s, µ = {friction} [m]");
    Trial::new([Quantity::relative(name, exact, [0.05, 0.15])], move |run| {
        let mut player = sliding(run, friction)?;
        let count = player.cloth.particle_count() as usize;
        player.cloth.set_velocities(0, &vec![Vec3::X * speed as f32; count])?;
        let start = middle_x(&player);
        player.play(1.5 * speed / (friction * G));
        Ok(Outcome::of(&player, [middle_x(&player) - start]))
    })
}

pub fn restitution() -> Case {
    let trials = [0.0, 0.5].map(|restitution| {
        let exact = restitution * restitution * 0.5;
        let name = format!("rebound from 0.5 m, e = {restitution} [m]");
        Trial::new([Quantity::absolute(name, exact, [0.01, 0.05])], move |run| {
            let material = Material { restitution: restitution as f32, ..limp(DENSITY) };
            let mut player = sheet(run, 0.5, 0.0, material)?;
            let floor = f64::from(player.cloth.material().thickness);
            let height = |player: &Player| player.mean(0..player.cloth.particle_count()).y - floor;
            let (mut last, mut has_hit, mut highest) = (height(&player), false, 0.0_f64);
            for _ in 0..player.ticks_in(0.8) {
                player.step(1);
                let now = height(&player);
                has_hit |= now > last || now < 2.0e-3;
                highest = if has_hit { highest.max(now) } else { highest };
                last = now;
            }
            Ok(Outcome::of(&player, [highest]))
        })
    });
    Case {
        name: "rebound",
        about: "a level sheet that falls on a floor from 0.5 m",
        source: "Newton's law of restitution: the height e² h",
        trials: trials.into(),
        is_default: true,
    }
}

pub fn rest_noise() -> Case {
    let quantities = [
        Quantity::absolute("greatest RMS speed in 10 s at rest [mm/s]", 0.0, [1.0, 5.0]),
        Quantity::absolute("drift in these 10 s [mm]", 0.0, [1.0, 5.0]),
    ];
    let trial = Trial::new(quantities, |run| {
        let mut player = sheet(run, 0.05, DAMPING, limp(DENSITY))?;
        player.settle(0.3);
        let start = player.mean(0..player.cloth.particle_count());
        let mut fastest = 0.0_f64;
        for _ in 0..player.ticks_in(10.0) {
            player.step(1);
            fastest = fastest.max(player.rms_speed());
        }
        let drift = player.mean(0..player.cloth.particle_count()).distance(start);
        Ok(Outcome::of(&player, [fastest, drift].map(|x| 1.0e3 * x)))
    });
    Case {
        name: "rest",
        about: "a sheet that has come to rest on a floor",
        source: "what rests does not move",
        trials: vec![trial],
        is_default: true,
    }
}
