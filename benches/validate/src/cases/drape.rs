//! Drape of discs on a drapemeter with a support of 9 cm. Slow: played only by name.

use super::G;
use crate::player::{DAMPING, Player};
use crate::run::{Outcome, Quality, Run};
use crate::trial::{Case, Quantity, Trial};
use muslin::{Cloth, Material, MeshDesc, Preset, Settings};
use muslin_scenes::disc::Disc;
use muslin_scenes::shadow::drape_coefficient;

/// Radii of the disc and of the support [m].
const RADIUS: f32 = 0.15;
const SUPPORT: f32 = 0.09;

/// Rings of the mesh, so that one ring is at the edge of the support.
const RINGS: [u32; 3] = [15, 20, 25];

/// Settings of a run; drape takes twice the substeps of other accurate runs.
fn settings(run: &Run) -> Settings {
    let settings = run.settings(G, DAMPING);
    let factor = if run.quality == Quality::Accurate { 2 } else { 1 };
    Settings { substeps: factor * settings.substeps, ..settings }
}

pub fn drape() -> Case {
    let bands = [
        ("silk", Preset::Silk, [20.0, 40.0]),
        ("cotton", Preset::Cotton, [60.0, 76.0]),
        ("denim", Preset::Denim, [70.0, 90.0]),
    ];
    let trials = bands.map(|(name, preset, [low, high])| {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let name = format!("drape coefficient of {name}, measured {low} to {high} [%]");
        let quantity = Quantity::absolute(name, middle, [half, half + 6.0]);
        let mut trial = Trial::new([quantity], move |run| {
            let disc = Disc::new(RADIUS, run.nodes, 0.0);
            let is_held = |x: f32| x < SUPPORT + 1.0e-5;
            let lengths: Vec<f32> = disc.positions.iter().map(|x| x.length()).collect();
            let pinned = (0..).zip(&lengths).filter(|(_, x)| is_held(**x)).map(|(at, _)| at);
            let mut desc = MeshDesc {
                pinned: pinned.collect(),
                positions: disc.positions,
                indices: disc.indices,
                uvs: disc.uvs,
                material: Material { drag: 0.0, lift: 0.0, ..Material::preset(preset) },
                settings: settings(run),
                ..MeshDesc::default()
            };
            // A small unevenness; without it, no direction of folding would be preferred.
            for (at, x) in desc.positions.iter_mut().enumerate() {
                x.y = if is_held(lengths[at]) { 0.0 } else { 1.0e-4 * (at as f32 * 2.399).sin() };
            }
            let mut player = Player::new(Cloth::mesh(&desc)?);
            player.settle(f64::from(RADIUS));
            let found = 100.0 * f64::from(drape_coefficient(&player.cloth, SUPPORT, RADIUS));
            Ok(Outcome::of(&player, [found]))
        });
        trial.nodes = &RINGS;
        trial
    });
    Case {
        name: "drape",
        about: "discs of 30 cm on a support of 18 cm; nodes are the rings of the mesh, and \
                accurate has 32 substeps",
        source: "bands of measured drape coefficients (BS 5058, ISO 9073-9): Matsudaira and Yang \
                 2003 (silk), Gan et al. 1991 (cotton); that of denim has no named publication",
        trials: trials.into(),
        is_default: false,
    }
}
