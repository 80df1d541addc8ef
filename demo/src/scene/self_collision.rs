//! Self-collision of the hanging sheet, on machines that are fast enough for it.
//!
//! Reads [`Settings`]; writes the settings of a cloth.
//!
//! Invariant: no other scene is changed here.

use muslin::{GridDesc, Result, SelfCollision};
use muslin_scenes::SceneInstance;

use crate::scene_kind::SceneKind;
use crate::settings::Settings;

/// Most particles of a sheet that keeps from itself in real time, also on a page, and the distance
/// between its layers [m].
const MAX_SELF_COLLIDING: u32 = 2500;
const SELF_DISTANCE: f32 = 0.004;

/// Lets the layers of the sheet keep from each other, unless it is too fine.
pub fn set(desc: &mut GridDesc, settings: &Settings) {
    if settings.scene == SceneKind::Sheet && desc.columns * desc.rows <= MAX_SELF_COLLIDING {
        desc.settings.self_collision = SelfCollision::Surface;
        desc.settings.self_distance = SELF_DISTANCE;
    }
}

/// Lets the layers of the sheet pass through each other: a machine that is too slow for it moves
/// better so.
///
/// # Errors
/// As [`muslin::Cloth::set_settings`]; the settings of a scene cause none.
pub fn drop(instance: &mut SceneInstance, settings: &Settings) -> Result<()> {
    let cloth = &mut instance.cloths[0];
    let live = cloth.settings().clone();
    if settings.scene != SceneKind::Sheet || live.self_collision == SelfCollision::None {
        return Ok(());
    }
    cloth.set_settings(muslin::Settings { self_collision: SelfCollision::None, ..live })
}
