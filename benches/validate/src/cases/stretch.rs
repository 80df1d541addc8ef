//! Strips that hang between two ends, and that hang down and stretch.

use super::G;
use crate::player::DAMPING;
use crate::references::catenary as reference;
use crate::run::{Outcome, Run};
use crate::strip::{ROWS, Strip, elastic, horizontal, limp};
use crate::trial::{Case, Quantity, Trial};
use muslin::Material;
use muslin::glam::DVec3;

/// Density of the strips [kg/m²].
const DENSITY: f64 = 0.18;

/// Shear stiffness of elastic strips [N/m]: nearly none, so that diagonal links carry no load.
const NO_SHEAR: f32 = 0.01;

/// A strip of length `length` [m] from one pinned column to the last one.
fn strip(run: &Run, length: f64, along: [DVec3; 2], material: &Material, gravity: f64) -> Strip {
    Strip {
        columns: run.nodes,
        rows: ROWS,
        spacing: length / f64::from(run.nodes - 1),
        along: along[0],
        across: along[1],
        material: material.clone(),
        settings: run.settings(gravity, DAMPING),
    }
}

pub fn catenary() -> Case {
    let mut trials: Vec<Trial> =
        [1.01, 1.05, 1.2, 1.5, 2.0].map(|ratio| hang(ratio, 1.0, G, 0.0)).into();
    trials.push(hang(1.1, 0.37, 7.3, 33.0));
    Case {
        name: "catenary",
        about: "limp strips of length L between two pinned ends, S apart",
        source: "L = 2 a sinh(S / 2a), sag = a (cosh(S / 2a) − 1)",
        trials,
        is_default: true,
    }
}

fn hang(ratio: f64, span: f64, gravity: f64, turn: f64) -> Trial {
    let odd =
        if turn == 0.0 { String::new() } else { format!(", {span} m, {gravity} m/s², {turn}°") };
    let sag = Quantity::absolute(
        format!("sag over S, L/S = {ratio}{odd}"),
        reference::sag(ratio),
        [0.01, 0.03],
    );
    Trial::new([sag], move |run| {
        let strip = strip(run, ratio * span, horizontal(turn), &limp(DENSITY), gravity);
        let mut player = strip.pinned(&[0, run.nodes - 1])?;
        strip.push_end(&mut player, 1, (1.0 - ratio) * span, 2.0)?;
        player.settle(span);
        let sag = strip.at(&player, 0).y - strip.middle(&player).y;
        Ok(Outcome::of(&player, [sag / span]))
    })
}

pub fn taut() -> Case {
    let trials = [10.0, 100.0, 1000.0].map(|stiffness| {
        let sag = Quantity::relative(
            format!("sag over S, Ks = {stiffness} σ g S"),
            reference::elastic_sag(stiffness),
            [0.02, 0.06],
        );
        Trial::new([sag], move |run| {
            // The threads across a taut strip would share its load if it could shear.
            let stiffness = stiffness * DENSITY * G;
            let material = Material { shear_stiffness: NO_SHEAR, ..elastic(DENSITY, stiffness) };
            let strip = strip(run, 1.0, horizontal(0.0), &material, G);
            let mut player = strip.pinned(&[0, run.nodes - 1])?;
            player.settle(1.0);
            Ok(Outcome::of(&player, [strip.at(&player, 0).y - strip.middle(&player).y]))
        })
    });
    Case {
        name: "taut",
        about: "elastic strips as long as the span S between their pinned ends",
        source: "elastic catenary (Irvine, Cable Structures, 1981, section 1.3)",
        trials: trials.into(),
        is_default: true,
    }
}

pub fn hanging() -> Case {
    let trials = vec![
        own_weight(1.0, G, 0.0),
        own_weight(0.37, 7.3, 0.0),
        own_weight(1.0, G, 1.0 / 3.0),
        end_load(),
        inextensible(1.0, G),
        inextensible(0.37, 7.3),
    ];
    Case {
        name: "hanging",
        about: "strips of length L that hang from one end: under their weight, with a load at the \
                end, and with rigid links",
        source: "Hooke's law: u(s) = σ g (L s − s²/2) / Ks, δ = P L / (Ks w); rigid: no stretch",
        trials,
        is_default: true,
    }
}

const DOWN: [DVec3; 2] = [DVec3::NEG_Y, DVec3::X];

/// Strain at the top of an elastic strip.
const STRAIN: f64 = 0.02;

/// `shear`: shear stiffness over stretch stiffness, such as 1/3 of leather; it should not matter.
fn own_weight(length: f64, gravity: f64, shear: f64) -> Trial {
    let sheared =
        if shear > 0.0 { format!(", shear stiffness {shear:.2} Ks") } else { String::new() };
    let name = format!("{length} m, {gravity} m/s²{sheared}");
    let quantities = [
        Quantity::relative(
            format!("stretch by own weight, {name} [mm]"),
            500.0 * STRAIN * length,
            [0.02, 0.08],
        ),
        Quantity::absolute(
            format!("RMS distance from the parabola over δ, {name}"),
            0.0,
            [0.02, 0.08],
        ),
    ];
    Trial::new(quantities, move |run| {
        let stiffness = DENSITY * gravity * length / STRAIN;
        let material = Material {
            shear_stiffness: (shear * stiffness).max(f64::from(NO_SHEAR)) as f32,
            ..elastic(DENSITY, stiffness)
        };
        let strip = strip(run, length, DOWN, &material, gravity);
        let mut player = strip.pinned(&[0])?;
        player.settle(length);
        let stretch = |column: u32| {
            let rest = strip.spacing * f64::from(column);
            (-strip.at(&player, column).y - rest, rest)
        };
        let exact = 0.5 * STRAIN * length;
        let off = (0..run.nodes).map(|column| {
            let (stretch, s) = stretch(column);
            (stretch - STRAIN * (s - s * s / (2.0 * length))).powi(2)
        });
        let rms = (off.sum::<f64>() / f64::from(run.nodes)).sqrt() / exact;
        Ok(Outcome::of(&player, [1.0e3 * stretch(run.nodes - 1).0, rms]))
    })
}

/// Weight at the end over that of the strip.
const LOAD: f64 = 5.0;

fn end_load() -> Trial {
    let exact = STRAIN * (1.0 + 0.5 / LOAD);
    let quantity = Quantity::relative(
        "stretch by five times its weight at the end [mm]",
        1.0e3 * exact,
        [0.02, 0.08],
    );
    Trial::new([quantity], move |run| {
        let stiffness = LOAD * DENSITY * G / STRAIN;
        let material = Material { shear_stiffness: NO_SHEAR, ..elastic(DENSITY, stiffness) };
        let strip = strip(run, 1.0, DOWN, &material, G);
        let mut player = strip.pinned(&[0])?;
        let last: Vec<u32> = strip.column(run.nodes - 1).collect();
        // The last column has the mass of half a cell.
        let scale = (1.0 + LOAD * 2.0 * f64::from(run.nodes - 1)) as f32;
        player.cloth.set_mass_scales(&last, &vec![scale; last.len()])?;
        player.settle(1.0);
        Ok(Outcome::of(&player, [1.0e3 * (-strip.at(&player, run.nodes - 1).y - 1.0)]))
    })
}

fn inextensible(length: f64, gravity: f64) -> Trial {
    let name = format!("stretch with rigid links, {length} m, {gravity} m/s² [%]");
    Trial::new([Quantity::absolute(name, 0.0, [0.5, 2.0])], move |run| {
        let strip = strip(run, length, DOWN, &limp(DENSITY), gravity);
        let mut player = strip.pinned(&[0])?;
        player.settle(length);
        Ok(Outcome::of(&player, [100.0 * (-strip.at(&player, run.nodes - 1).y / length - 1.0)]))
    })
}
