//! Resolution of the cloths of a scene: particles across and down, and the distance between them.
//!
//! Reads [`Settings`] and writes nothing.
//!
//! Invariant: the clothes of the figure have the same resolution whatever the settings.

use muslin_scenes::disc::Disc;
use muslin_scenes::{Curtain, Doorway, Drapes, Flag, GlassBalls, HangingSheet, SheetOnBall};

use crate::scene_kind::SceneKind;
use crate::settings::Settings;

/// Distance between neighbouring particles of the clothes, on average [m].
const GARMENT_SPACING: f32 = 0.04;

/// Returns the numbers of particles across and down; `None` for discs and clothes, which are no grid.
pub fn grid_size(settings: &Settings) -> Option<[u32; 2]> {
    match settings.scene {
        SceneKind::Sheet | SceneKind::Ball | SceneKind::Glass => Some([settings.resolution; 2]),
        SceneKind::Flag | SceneKind::Storm => Some(Flag::grid_size(settings.resolution)),
        SceneKind::Curtain => Some(Curtain::grid_size(settings.resolution)),
        SceneKind::Doorway => Some(Doorway::grid_size(settings.resolution)),
        SceneKind::Discs | SceneKind::Figure => None,
    }
}

/// Returns the distance between neighbouring particles [m].
pub fn spacing(settings: &Settings) -> f32 {
    let across = match settings.scene {
        SceneKind::Sheet => HangingSheet::SIZE,
        SceneKind::Flag | SceneKind::Storm => Flag::SIZE.x,
        SceneKind::Ball => SheetOnBall::SIZE,
        SceneKind::Glass => GlassBalls::SIZE,
        SceneKind::Doorway => return Doorway::spacing(settings.resolution),
        SceneKind::Curtain => Curtain::SIZE.x,
        SceneKind::Discs => return Drapes::RADIUS / Disc::rings(across_disc(settings)) as f32,
        SceneKind::Figure => return GARMENT_SPACING,
    };
    across / (settings.resolution - 1) as f32
}

/// Number of particles across a disc: two thirds of the resolution, because there are three discs.
pub fn across_disc(settings: &Settings) -> u32 {
    (2 * settings.resolution).div_ceil(3)
}
