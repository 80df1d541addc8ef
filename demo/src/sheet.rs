//! The hanging sheet of the first scene, made and kept as the controls say.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, PinMode, Result, Wind};
use muslin_scenes::HangingSheet;

use crate::render::light::FLOOR;
use crate::settings::{Pinning, Settings};

/// Speed of the air at wind 1 [m/s].
const BREEZE: f32 = 1.5;
/// What the cloth is kept over the floor, so that it never flickers through [m].
const CLEARANCE: f32 = 0.006;

/// Distance between neighbouring particles [m].
pub fn spacing(settings: &Settings) -> f32 {
    HangingSheet::SIZE / (settings.resolution - 1) as f32
}

/// Width and height of the sheet [m].
pub fn span(_settings: &Settings) -> Vec2 {
    Vec2::splat(HangingSheet::SIZE)
}

/// A fresh sheet over its floor.
///
/// # Errors
/// As [`Cloth::grid`]; clamped settings give none.
pub fn build(settings: &Settings, calm: bool) -> Result<Cloth> {
    let pin_mode = match settings.pinning {
        Pinning::TopEdge => PinMode::TopEdge,
        Pinning::TopCorners => PinMode::TopCorners,
        Pinning::Corners => PinMode::Corners,
    };
    let mut desc = HangingSheet::desc(settings.resolution, pin_mode);
    desc.material = settings.fabric.material();
    // The stiffness slider multiplies them by up to twelve sweeps: four are smooth, and cheap.
    desc.settings.substeps = 4;
    let mut cloth = Cloth::grid(&desc)?;
    cloth.add_collider(&ColliderDesc {
        position: Vec3::Y * (FLOOR + CLEARANCE),
        ..ColliderDesc::default()
    })?;
    drape(&mut cloth, settings)?;
    tune(&mut cloth, settings, calm)?;
    Ok(cloth)
}

/// Gathers the flat sheet like a curtain, or arches it between its corners.
///
/// Every row follows one curve whose arc is as long as the row, so no thread is stretched: the
/// direction of the curve is given along the arc, and the places are its running sum.
fn drape(cloth: &mut Cloth, settings: &Settings) -> Result<()> {
    let (n, step) = (settings.resolution, spacing(settings));
    let direction = |u: f32| match settings.pinning {
        // Uneven folds: the phase runs ahead and falls behind.
        Pinning::TopEdge => {
            0.78 * (TAU * (4.5 * u + 0.10 * (TAU * u).sin() + 0.07 * (2.3 * TAU * u).cos())).sin()
        }
        Pinning::TopCorners | Pinning::Corners => 0.75 * (1.0 - 2.0 * u),
    };
    let mut curve = vec![Vec2::ZERO];
    for i in 1..n {
        let turn = direction((i as f32 - 0.5) / (n - 1) as f32);
        curve.push(curve[i as usize - 1] + Vec2::from_angle(turn) * step);
    }
    let middle = 0.5 * (curve[0] + curve[n as usize - 1]);
    for row in 0..n {
        for column in 0..n {
            let particle = row * n + column;
            let height = cloth.positions()[particle as usize].y;
            let place = curve[column as usize] - middle;
            cloth.set_position(particle, Vec3::new(place.x, height, place.y))?;
        }
    }
    Ok(())
}

/// Brings a sheet in line with the controls; `calm` takes most of the restlessness out of the wind.
///
/// # Errors
/// As [`Cloth::set_settings`] and [`Cloth::set_wind`]; clamped settings give none.
pub fn tune(cloth: &mut Cloth, settings: &Settings, calm: bool) -> Result<()> {
    let mut live = cloth.settings().clone();
    live.iterations = settings.stiffness;
    live.gravity = Vec3::NEG_Y * settings.gravity;
    live.damping = settings.damping_rate();
    live.tearing = settings.tearing;
    cloth.set_settings(live)?;
    let restless = if calm { 0.3 } else { 1.0 };
    let wind = HangingSheet::wind(BREEZE * settings.wind);
    cloth.set_wind(Wind {
        gust: wind.gust * restless,
        wander: wind.wander * restless,
        turbulence: wind.turbulence * restless,
        ..wind
    })
}
