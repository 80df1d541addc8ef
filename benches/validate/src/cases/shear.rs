//! A square of cloth that is held by one vertical edge and sags in its plane.

use super::G;
use crate::player::DAMPING;
use crate::references::membrane;
use crate::run::Outcome;
use crate::strip::Strip;
use crate::trial::{Case, Quantity, Trial};
use muslin::glam::DVec3;
use muslin::{Material, Preset};

pub fn sag() -> Case {
    let trials = vec![
        square("cotton, 0.3 m", Preset::Cotton, 0.3, G),
        square("denim, 0.3 m", Preset::Denim, 0.3, G),
        square("silk, 0.37 m, 7.3 m/s²", Preset::Silk, 0.37, 7.3),
    ];
    Case {
        name: "shear",
        about: "a square held by one vertical edge; mean sag of the free edge",
        source: "plane stress, ½ K (εx² + εy²) + ½ G γ² per area, small strains: bilinear finite \
                 elements, 64 × 64 (Zienkiewicz, The Finite Element Method)",
        trials,
        is_default: true,
    }
}

fn square(name: &str, preset: Preset, length: f64, gravity: f64) -> Trial {
    let material = Material { drag: 0.0, lift: 0.0, ..Material::preset(preset) };
    let stretch = f64::from(material.stretch_stiffness_warp);
    let load = f64::from(material.density) * gravity;
    let sag = membrane::edge_sag(length, stretch, f64::from(material.shear_stiffness), load);
    let quantity = Quantity::relative(format!("sag of {name} [mm]"), 1.0e3 * sag, [0.05, 0.15]);
    Trial::new([quantity], move |run| {
        let sheet = Strip {
            columns: run.nodes,
            rows: run.nodes,
            spacing: length / f64::from(run.nodes - 1),
            along: DVec3::X,
            across: DVec3::NEG_Y,
            material: material.clone(),
            settings: run.settings(gravity, DAMPING),
        };
        let mut player = sheet.pinned(&[0])?;
        let edge = |player: &_| sheet.at(player, run.nodes - 1).y;
        let start = edge(&player);
        player.settle(length);
        Ok(Outcome::of(&player, [1.0e3 * (start - edge(&player))]))
    })
}
