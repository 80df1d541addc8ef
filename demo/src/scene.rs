//! Scene setup: builds the cloths of a scene, and applies the settings to them.
//!
//! Method: the descriptors of `muslin_scenes` with the fabric, resolution and pinning of
//! [`Settings`].
//!
//! Reads [`Settings`]; writes a [`SceneInstance`].
//!
//! Invariant: clamped settings always build a scene.

pub mod grid;
pub mod self_collision;
pub mod solids;
pub mod start;

use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, Material, PinMode, Result, Wind};
use muslin_scenes::disc::Disc;
use muslin_scenes::figure::garments::SKIRT_SPAN;
use muslin_scenes::{
    Curtain, Doorway, Drapes, Figure, Flag, GlassBalls, HangingSheet, SceneInstance, SheetOnBall,
    TornFlag,
};

use crate::camera::{CameraRig, UprightView};
use crate::fabric::{self, Appearance, Fabric};
use crate::render::light::FLOOR;
use crate::scene_kind::SceneKind;
use crate::settings::{Pinning, Settings};
use grid::{across_disc, grid_size, spacing};

/// Air speed of the hanging sheet at wind 1 [m/s].
const SHEET_WIND: f32 = 1.3;
/// Air speed of the flag at wind 1 [m/s].
const FLAG_WIND: f32 = 7.0;
/// Air speed of the torn flag at wind 1 [m/s].
const STORM_WIND: f32 = 16.0;
/// Speed of falling rain [m/s].
const RAIN: f32 = 7.0;
/// Air speed of draped sheets and of curtains at wind 1 [m/s].
const DRAPED_WIND: f32 = 0.6;
/// Air speed of the discs at wind 1 [m/s].
const DISC_WIND: f32 = 0.25;
/// Height of the floor collider over the drawn floor, which avoids z-fighting [m].
const CLEARANCE: f32 = 0.006;
/// Fabrics of the discs.
const DISC_FABRICS: [Fabric; 3] = [Fabric::Silk, Fabric::Cotton, Fabric::Denim];
/// Returns the length in the simulation of one drawn metre [m].
pub fn unit(scene: SceneKind) -> f32 {
    match scene {
        SceneKind::Discs => Drapes::UNIT,
        _ => 1.0,
    }
}

/// Returns the appearance of each drawn surface, see [`surfaces`](crate::surfaces).
pub fn appearances(settings: &Settings) -> Vec<Appearance> {
    match settings.scene {
        SceneKind::Discs => DISC_FABRICS.map(Fabric::appearance).to_vec(),
        SceneKind::Figure => {
            let skirt = fabric::skirt(settings.fabric);
            vec![skirt, fabric::shirt(), fabric::mannequin(), skirt]
        }
        SceneKind::Doorway => vec![settings.fabric.appearance(); 2],
        _ => vec![settings.fabric.appearance()],
    }
}

/// Returns start pose and limits of the camera.
pub fn camera_rig(scene: SceneKind) -> CameraRig {
    let usual = CameraRig::default();
    match scene {
        SceneKind::Sheet | SceneKind::Flag | SceneKind::Ball | SceneKind::Storm => usual,
        SceneKind::Glass => CameraRig {
            target: Vec3::new(0.05, -0.82, 0.1),
            radius: 1.5..=12.0,
            start: [0.30, 1.24, 3.9],
            half_width: 1.35,
            upright: Some(UprightView { start: [0.90, 1.05], half_width: 0.95 }),
            ..usual
        },
        SceneKind::Doorway => CameraRig {
            target: Vec3::new(0.0, -0.40, 0.0),
            start: [0.58, 1.22, 5.1],
            half_width: 1.35,
            ..usual
        },
        SceneKind::Discs => CameraRig {
            target: Vec3::new(0.0, -0.78, 0.0),
            radius: 1.5..=12.0,
            start: [0.18, 1.14, 3.3],
            half_width: 1.45,
            upright: Some(UprightView { start: [1.22, 0.90], half_width: 0.86 }),
            ..usual
        },
        SceneKind::Curtain => CameraRig {
            target: Vec3::new(0.0, -0.2, 0.0),
            start: [0.52, 1.30, 4.9],
            half_width: 1.4,
            ..usual
        },
        SceneKind::Figure => CameraRig {
            target: Vec3::new(0.0, -0.56, 0.0),
            radius: 2.0..=12.0,
            start: [0.35, 1.36, 3.9],
            half_width: 1.2,
            upright: Some(UprightView { start: [0.35, 1.36], half_width: 0.56 }),
            ..usual
        },
    }
}

/// Returns the velocity of the rain [m/s], in the scene that has some.
pub fn rain(settings: &Settings) -> Option<Vec3> {
    let wind = TornFlag::wind(STORM_WIND * settings.wind).velocity;
    (settings.scene == SceneKind::Storm).then(|| 0.7 * wind + Vec3::NEG_Y * RAIN)
}

/// Returns width and height of a cloth, in drawn metres.
pub fn span(settings: &Settings) -> Vec2 {
    if settings.scene == SceneKind::Figure {
        return SKIRT_SPAN;
    }
    let size =
        grid_size(settings).map(|grid_size| grid_size.map(|n| (n - 1) as f32 * spacing(settings)));
    size.map_or(Vec2::splat(2.0 * Drapes::RADIUS), Vec2::from) / unit(settings.scene)
}

/// Builds the cloths of the scene over a floor, with the settings applied.
///
/// # Errors
/// As [`Cloth::grid`] and [`Cloth::mesh`]; clamped settings cause none.
pub fn build(settings: &Settings, reduced_motion: bool) -> Result<SceneInstance> {
    let mut instance = match settings.scene {
        SceneKind::Discs => discs(settings)?.into(),
        SceneKind::Curtain => {
            let mut desc = Curtain::desc(settings.resolution);
            desc.material = settings.fabric.material();
            let mut curtain = Curtain::hang_on_rings(&desc)?;
            add_floor(&mut curtain)?;
            SceneInstance::with_ball(curtain, Curtain::BALL)?
        }
        SceneKind::Doorway => {
            let mut desc = Doorway::desc(settings.resolution);
            desc.material = settings.fabric.material();
            Doorway::hang(&desc, CLEARANCE)?
        }
        SceneKind::Figure => figure(settings)?,
        _ => SceneInstance::from(sheet(settings)?),
    };
    apply_settings(&mut instance, settings, reduced_motion)?;
    Ok(instance)
}

/// Builds the cloth of a scene with one grid: sheet, flag, torn flag, or a sheet on balls.
fn sheet(settings: &Settings) -> Result<Cloth> {
    let mut desc = match settings.scene {
        SceneKind::Flag | SceneKind::Storm => Flag::desc(settings.resolution),
        SceneKind::Ball => SheetOnBall::desc(settings.resolution),
        SceneKind::Glass => GlassBalls::desc(settings.resolution),
        _ => HangingSheet::desc(settings.resolution, pin_mode(settings.pinning)),
    };
    desc.material = settings.fabric.material();
    // The stiffness control sets up to twelve iterations per substep, so four substeps are enough.
    desc.settings.substeps = 4;
    self_collision::set(&mut desc, settings);
    let mut cloth = match settings.scene {
        SceneKind::Flag | SceneKind::Storm => {
            Flag::hoist(&desc, settings.pinning != Pinning::TopEdge)?
        }
        _ => Cloth::grid(&desc)?,
    };
    add_floor(&mut cloth)?;
    match settings.scene {
        SceneKind::Ball => SheetOnBall::add_ball(&mut cloth)?,
        SceneKind::Glass => GlassBalls::add_balls(&mut cloth)?,
        // The rips are cut while the flag is flat, and the wind folds it.
        SceneKind::Storm => TornFlag::rip(&mut cloth)?,
        _ => start::fold(&mut cloth, settings)?,
    }
    Ok(cloth)
}

/// Builds the discs on their pedestals. Shear and bending set the drape, so each disc uses the
/// unchanged stiffness of its preset.
fn discs(settings: &Settings) -> Result<Vec<Cloth>> {
    let rings = Disc::rings(across_disc(settings));
    let disc = |(fabric, place): (Fabric, Vec3)| {
        let preset = Material::preset(fabric.preset());
        let material = Material { tear_stretch: fabric.material().tear_stretch, ..preset };
        let mut cloth = Cloth::mesh(&Drapes::desc(rings, place, material))?;
        Drapes::add_pedestal(&mut cloth, place)?;
        Drapes::add_floor(&mut cloth, CLEARANCE)?;
        Ok(cloth)
    };
    DISC_FABRICS.into_iter().zip(Drapes::CENTRES).map(disc).collect()
}

/// Builds the figure with its clothes.
fn figure(settings: &Settings) -> Result<SceneInstance> {
    let mut instance = Figure::dress(settings.fabric.material(), Figure::settings())?;
    add_floor(&mut instance.cloths[0])?;
    Ok(instance)
}

fn add_floor(cloth: &mut Cloth) -> Result<()> {
    let position = Vec3::Y * (FLOOR + CLEARANCE);
    cloth.add_collider(&ColliderDesc { position, ..ColliderDesc::default() }).map(|_| ())
}

fn pin_mode(pinning: Pinning) -> PinMode {
    match pinning {
        Pinning::TopEdge => PinMode::TopEdge,
        Pinning::TopCorners => PinMode::TopCorners,
        Pinning::Corners => PinMode::Corners,
    }
}

/// Applies the settings to all cloths; `reduced_motion` weakens gusts, wander and turbulence of the
/// wind, and lets the walker stand until it is sent somewhere.
///
/// # Errors
/// As [`Cloth::set_settings`] and [`Cloth::set_wind`]; clamped settings cause none.
pub fn apply_settings(
    instance: &mut SceneInstance,
    settings: &Settings,
    reduced_motion: bool,
) -> Result<()> {
    if let Some(walker) = instance.walker_mut() {
        walker.set_restless(!reduced_motion);
    }
    instance
        .cloths
        .iter_mut()
        .try_for_each(|cloth| apply_settings_to(cloth, settings, reduced_motion))
}

fn apply_settings_to(cloth: &mut Cloth, settings: &Settings, reduced_motion: bool) -> Result<()> {
    let mut live = cloth.settings().clone();
    // For the small discs, substeps set the stiffness instead of iterations.
    (live.substeps, live.iterations) = match settings.scene {
        SceneKind::Discs => ((4 * settings.stiffness).div_ceil(3), 2),
        SceneKind::Figure => (live.substeps, settings.stiffness.div_ceil(3)),
        _ => (live.substeps, settings.stiffness),
    };
    live.gravity = Vec3::NEG_Y * settings.gravity;
    live.damping = settings.damping_rate();
    live.tearing = settings.tearing;
    cloth.set_settings(live)?;
    let restless = if reduced_motion { 0.3 } else { 1.0 };
    let wind = match settings.scene {
        SceneKind::Sheet => HangingSheet::wind(SHEET_WIND * settings.wind),
        SceneKind::Flag => Flag::wind(FLAG_WIND * settings.wind),
        SceneKind::Storm => TornFlag::wind(STORM_WIND * settings.wind),
        SceneKind::Ball | SceneKind::Glass => SheetOnBall::wind(DRAPED_WIND * settings.wind),
        SceneKind::Discs => SheetOnBall::wind(DISC_WIND * settings.wind),
        SceneKind::Curtain | SceneKind::Doorway | SceneKind::Figure => {
            HangingSheet::wind(DRAPED_WIND * settings.wind)
        }
    };
    cloth.set_wind(Wind {
        gust: wind.gust * restless,
        wander: wind.wander * restless,
        turbulence: wind.turbulence * restless,
        ..wind
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_starts_unstretched_in_motion_and_within_the_stage() {
        for scene in SceneKind::ALL {
            for pinning in [Pinning::TopEdge, Pinning::TopCorners, Pinning::Corners] {
                let settings = Settings { scene, pinning, ..Settings::default() };
                let mut instance = build(&settings, false).unwrap();
                if instance.figure().is_none() {
                    assert_eq!(instance.cloths.len(), appearances(&settings).len());
                }
                let start: Vec<_> =
                    instance.cloths.iter().map(|cloth| cloth.positions().to_vec()).collect();
                for cloth in &instance.cloths {
                    let stretch = cloth.stats().max_stretch;
                    assert!(stretch < 0.01, "{scene:?} opens stretched by {stretch}");
                }
                instance.step(6);
                for (start, cloth) in start.iter().zip(&instance.cloths) {
                    let grid = grid_size(&settings).map(|[columns, rows]| columns * rows);
                    let count = cloth.particle_count();
                    // Rips split particles.
                    let is_torn = scene == SceneKind::Storm;
                    assert_eq!(count > grid.unwrap_or(count), is_torn, "{scene:?} has {count}");
                    let moved = start.iter().zip(cloth.positions()).map(|(a, b)| a.distance(*b));
                    let farthest = moved.fold(0.0, f32::max);
                    assert!(farthest > 0.002 && farthest < 0.6, "{scene:?} moved {farthest} m");
                    let place = |x: &Vec3| *x / unit(scene);
                    let off = cloth.positions().iter().map(place).map(Vec3::length);
                    assert!(off.fold(0.0, f32::max) < 2.0, "{scene:?} is off the stage");
                }
            }
        }
    }

    #[test]
    fn reduced_motion_weakens_the_gusts() {
        for scene in SceneKind::ALL {
            let settings = Settings { scene, ..Settings::default() };
            let [restless, reduced_motion] = [false, true].map(|reduced_motion| {
                let instance = build(&settings, reduced_motion).unwrap();
                instance.cloths[0].wind().gust
            });
            assert!(reduced_motion < 0.5 * restless);
        }
    }
}
