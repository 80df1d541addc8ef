//! Cloth in the wind and in still air.

use super::G;
use crate::player::{DAMPING, Player};
use crate::references::catenary;
use crate::run::{Outcome, Run};
use crate::strip::{ROWS, Strip, horizontal, limp};
use crate::trial::{Case, Quantity, Trial};
use muslin::glam::{DVec3, Vec3};
use muslin::{Material, Preset, Wind};

/// Density of the air [kg/m³].
const AIR: f64 = 1.2;

pub fn bulge() -> Case {
    Case {
        name: "bulge",
        about: "a silk sheet between two pinned sides, 1 m apart, that faces the wind, without \
                gravity and lift; a quarter as wide",
        source: "pressure ½ ρ C U² cos² θ along the normal: a catenary of constant tension",
        trials: [5.0, 10.0].map(bulge_at).into(),
        is_default: true,
    }
}

fn bulge_at(speed: f64) -> Trial {
    let silk = Material::preset(Preset::Silk);
    let stiffness = f64::from(silk.stretch_stiffness_warp);
    let pressure = 0.5 * AIR * f64::from(silk.drag) * speed * speed;
    let exact = catenary::wind_sag(stiffness / pressure);
    let name = format!("bulge over the span at {speed} m/s");
    Trial::new([Quantity::relative(name, exact, [0.03, 0.08])], move |run| {
        let material = Material { lift: 0.0, ..silk.clone() };
        let strip = Strip {
            columns: run.nodes,
            // A narrow strip would turn out of the wind.
            rows: run.nodes / 4,
            spacing: 1.0 / f64::from(run.nodes - 1),
            along: DVec3::X,
            across: DVec3::NEG_Y,
            material,
            settings: run.settings(0.0, DAMPING),
        };
        let mut player = strip.pinned(&[0, run.nodes - 1])?;
        let velocity = Vec3::Z * speed as f32;
        player.cloth.set_wind(Wind { velocity, ..Wind::default() })?;
        player.settle(1.0);
        Ok(Outcome::of(&player, [strip.middle(&player).z]))
    })
}

pub fn terminal_speed() -> Case {
    let trials = [(0.08, 1.17), (0.15, 1.28), (0.3, 1.28)].map(|(density, drag)| {
        let exact = (2.0 * density * G / (AIR * drag)).sqrt();
        let name = format!("speed after 3 s, {density} kg/m², drag {drag} [m/s]");
        Trial::new([Quantity::relative(name, exact, [0.02, 0.08])], move |run| {
            let material = Material { drag: drag as f32, ..limp(density) };
            let mut player = sheet(run, material).pinned(&[])?;
            let height = |player: &Player| player.mean(0..player.cloth.particle_count()).y;
            player.play(3.0);
            let start = height(&player);
            player.play(0.1);
            Ok(Outcome::of(&player, [(start - height(&player)) / 0.1]))
        })
    });
    Case {
        name: "fall",
        about: "a level sheet of 0.5 m that falls in still air",
        source: "terminal speed √(2 σ g / (ρ C))",
        trials: trials.into(),
        is_default: true,
    }
}

/// A level sheet of 0.5 m with a quarter of the nodes along its other side.
fn sheet(run: &Run, material: Material) -> Strip {
    let [along, across] = horizontal(0.0);
    Strip {
        columns: run.nodes,
        rows: run.nodes / 4,
        spacing: 0.5 / f64::from(run.nodes - 1),
        along,
        across,
        material,
        settings: run.settings(G, 0.0),
    }
}

pub fn tilt() -> Case {
    let trials = [(0.1, 0.0), (0.5, 0.0), (1.0, 33.0), (2.0, 0.0)];
    Case {
        name: "tilt",
        about: "a strip of 0.5 m that hangs from one end in a level wind; mean of 4 s",
        source: "straight, at the angle p to the vertical with sin p = K cos² p, K = ρ C U² / (2 σ \
                 g)",
        trials: trials.map(|(k, turn)| tilt_at(k, turn)).into(),
        is_default: true,
    }
}

fn tilt_at(k: f64, turn: f64) -> Trial {
    // The root of k sin² p + sin p − k = 0.
    let exact = ((-1.0 + (1.0 + 4.0 * k * k).sqrt()) / (2.0 * k)).asin().to_degrees();
    let name = format!("angle, K = {k}, wind turned by {turn}° [°]");
    Trial::new([Quantity::absolute(name, exact, [1.5, 5.0])], move |run| {
        let density = 0.18;
        // Without any bend stiffness the hem would flutter.
        let material = Material { drag: 1.0, bend_stiffness: 1.0e-6, ..limp(density) };
        let [downwind, across] = horizontal(turn);
        let strip = Strip {
            columns: run.nodes,
            rows: ROWS,
            spacing: 0.5 / f64::from(run.nodes - 1),
            along: DVec3::NEG_Y,
            across,
            material,
            settings: run.settings(G, DAMPING),
        };
        let mut player = strip.pinned(&[0])?;
        let speed = (2.0 * k * density * G / AIR).sqrt();
        let velocity = (downwind * speed).as_vec3();
        player.cloth.set_wind(Wind { velocity, ..Wind::default() })?;
        player.play(8.0);
        let mut mean = DVec3::ZERO;
        let ticks = player.ticks_in(4.0);
        for _ in 0..ticks {
            player.step(1);
            let hung = strip.at(&player, run.nodes - 1) - strip.at(&player, 0);
            mean += hung / f64::from(ticks);
        }
        Ok(Outcome::of(&player, [mean.dot(downwind).atan2(-mean.y).to_degrees()]))
    })
}
