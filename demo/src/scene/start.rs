//! Start of a scene: the folds that cloth is made with, and its state in the first frame.
//!
//! Method: the silk sheet, which most visitors see first, starts in a stored pose, so that a page
//! does not wait for it. Other sheets and the flags run some ticks before the first frame.
//!
//! Reads [`Settings`]; writes the positions and velocities of a cloth.
//!
//! Invariant: no link starts stretched, and layers of the stored pose do not cross.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use muslin::{Cloth, Result, Wind};
use muslin_scenes::{Flag, SceneInstance};

use super::grid::{grid_size, spacing};
use super::self_collision;
use crate::fabric::Fabric;
use crate::scene_kind::SceneKind;
use crate::settings::{Pinning, Settings};

/// Most ticks before the first frame, and most ticks times particles, so that a fine cloth does
/// not start late.
const SETTLING_TICKS: u32 = 110;
const SETTLING_WORK: u32 = 180_000;
/// Substeps, and iterations in each, of the sheet in these ticks, which decide how long a page
/// takes to start; the last ones have those of the settings, so that it does not start stretched.
const SETTLING_STEPS: [u32; 2] = [2, 3];
const FIRM_TICKS: u32 = 12;
/// Factor of the wind in the gust before the first frame.
const GUST: f32 = 1.9;
/// Pose of the silk sheet in a gust. Of each particle below the pinned row it has the position, in
/// [`POSITION_STEP`], as three little-endian 16-bit integers, and the velocity, in
/// [`VELOCITY_STEP`], as three 8-bit integers. With `MUSLIN_BLESS=1` the tests write it.
static STORED_POSE: &[u8] = include_bytes!("silk-in-a-gust.bin");
/// Number of particles along a side of the sheet with the stored pose.
const STORED_RESOLUTION: u32 = 40;
/// Bytes of one particle in the stored pose.
const STORED_BYTES: usize = 9;
/// Step of the stored positions [m], and of the stored velocities [m/s].
const POSITION_STEP: f32 = 1.0 / 16384.0;
const VELOCITY_STEP: f32 = 1.0 / 32.0;

/// Sets the start positions: every row follows the curve of [`pleats`].
pub(super) fn fold(cloth: &mut Cloth, settings: &Settings) -> Result<()> {
    let places = pleats(settings);
    for particle in 0..cloth.particle_count() {
        let place = places[particle as usize % places.len()];
        let height = cloth.positions()[particle as usize].y;
        cloth.set_position(particle, Vec3::new(place.x, height, place.y))?;
    }
    Ok(())
}

/// Returns x and z of the particles of a row at the start: folds for the sheet, an arch between its
/// corners, waves for the flag.
///
/// The arc length of the curve equals the length of the row, so no link is stretched. A function
/// gives the direction of the curve by arc length, and the positions are its running sum.
pub(super) fn pleats(settings: &Settings) -> Vec<Vec2> {
    let columns = grid_size(settings).map_or(1, |[columns, _]| columns);
    let step = spacing(settings);
    let direction = |u: f32| match (settings.scene, settings.pinning) {
        // Depth and phase vary, so that no two folds are alike.
        (SceneKind::Sheet, Pinning::TopEdge) => {
            let depth = 0.66 + 0.20 * (1.3 * TAU * u + 1.0).sin();
            let phase = 4.3 * u + 0.20 * (TAU * u).sin() + 0.10 * (2.3 * TAU * u).cos();
            depth * (TAU * phase).sin()
        }
        (SceneKind::Flag, _) => 0.7 * u.sqrt() * (TAU * 1.6 * u).sin(),
        _ => 0.75 * (1.0 - 2.0 * u),
    };
    let mut curve = vec![Vec2::ZERO];
    for i in 1..columns {
        let turn = direction((i as f32 - 0.5) / (columns - 1) as f32);
        curve.push(curve[i as usize - 1] + Vec2::from_angle(turn) * step);
    }
    let start = match settings.scene {
        SceneKind::Flag => Vec2::new(Flag::HOIST.x, Flag::HOIST.z),
        _ => -0.5 * (curve[0] + curve[columns as usize - 1]),
    };
    curve.iter().map(|place| *place + start).collect()
}

/// Brings sheet and flags out of the folds that they were made with, before the first frame: by the
/// stored pose, or by ticks that end in a gust. With `reduced_motion` there is no gust.
///
/// # Errors
/// As [`Cloth::set_wind`] and [`Cloth::set_settings`]; what a scene has causes none.
pub fn settle(
    instance: &mut SceneInstance,
    settings: &Settings,
    reduced_motion: bool,
) -> Result<()> {
    if !matches!(settings.scene, SceneKind::Sheet | SceneKind::Flag | SceneKind::Storm) {
        return Ok(());
    }
    if has_stored_pose(settings) {
        return set_stored_pose(&mut instance.cloths[0], reduced_motion);
    }
    // Self-collision would take most of the time here, and hardly changes the drape.
    let live = instance.cloths[0].settings().clone();
    self_collision::drop(instance, settings)?;
    let particles = instance.cloths[0].particle_count().max(1);
    let ticks = (SETTLING_WORK / particles).min(SETTLING_TICKS);
    let gust = ticks / 3;
    let firm = instance.cloths[0].settings().clone();
    // Flags would take no less: they limit the stretch more often.
    if settings.scene == SceneKind::Sheet {
        let [substeps, iterations] = SETTLING_STEPS;
        let iterations = firm.iterations.min(iterations);
        instance.cloths[0].set_settings(muslin::Settings {
            substeps,
            iterations,
            ..firm.clone()
        })?;
    }
    instance.step(ticks - gust);
    let wind = instance.cloths[0].wind().clone();
    let factor = if reduced_motion { 1.0 } else { GUST };
    instance.cloths[0].set_wind(Wind { velocity: wind.velocity * factor, ..wind.clone() })?;
    instance.step(gust.saturating_sub(FIRM_TICKS));
    instance.cloths[0].set_settings(firm)?;
    instance.step(gust.min(FIRM_TICKS));
    instance.cloths[0].set_wind(wind)?;
    instance.cloths[0].set_settings(live)
}

/// Whether the sheet starts in the stored pose.
fn has_stored_pose(settings: &Settings) -> bool {
    settings.scene == SceneKind::Sheet
        && settings.pinning == Pinning::TopEdge
        && settings.fabric == Fabric::Silk
        && settings.resolution == STORED_RESOLUTION
}

/// Puts the sheet into the stored pose; with `reduced_motion` it starts at rest.
fn set_stored_pose(cloth: &mut Cloth, reduced_motion: bool) -> Result<()> {
    let particles = STORED_POSE.chunks_exact(STORED_BYTES);
    let position = |p: &[u8]| {
        let axis = |i: usize| f32::from(i16::from_le_bytes([p[2 * i], p[2 * i + 1]]));
        Vec3::from_array([0, 1, 2].map(axis)) * POSITION_STEP
    };
    let velocity = |p: &[u8]| {
        let axis = |i: usize| f32::from(i8::from_le_bytes([p[6 + i]]));
        Vec3::from_array([0, 1, 2].map(axis)) * VELOCITY_STEP
    };
    let positions: Vec<_> = particles.clone().map(position).collect();
    cloth.set_positions(STORED_RESOLUTION, &positions)?;
    if reduced_motion {
        return Ok(());
    }
    cloth.set_velocities(STORED_RESOLUTION, &particles.map(velocity).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::super::build;
    use super::*;
    use crate::crossings::crossing_count;

    #[test]
    fn the_ticks_before_the_first_frame_leave_no_more_stretch_than_later_ones() {
        for scene in [SceneKind::Sheet, SceneKind::Flag] {
            let settings = Settings { scene, ..Settings::default() };
            let mut instance = build(&settings, false).unwrap();
            let live = instance.cloths[0].settings().clone();
            settle(&mut instance, &settings, false).unwrap();
            assert_eq!(instance.cloths[0].settings(), &live);
            let stretch = |instance: &SceneInstance| instance.cloths[0].stats().max_stretch;
            let first = stretch(&instance);
            let later = (0..60).map(|_| {
                instance.step(1);
                stretch(&instance)
            });
            let most = later.fold(0.0, f32::max);
            assert!(first < 1.3 * most, "{scene:?}: {first}, later at most {most}");
        }
    }

    #[test]
    fn no_layers_of_the_stored_pose_cross_and_it_moves_on_without_a_jump() {
        let settings = Settings::default();
        let mut instance = build(&settings, false).unwrap();
        settle(&mut instance, &settings, false).unwrap();
        assert_eq!(crossing_count(&instance.cloths[0]), 0);
        let start = instance.cloths[0].positions().to_vec();
        let fastest = instance.cloths[0].velocities().map(Vec3::length).fold(0.0, f32::max);
        assert!(fastest > 0.5, "at most {fastest} m/s");
        instance.step(1);
        let moved = start.iter().zip(instance.cloths[0].positions()).map(|(a, b)| a.distance(*b));
        let farthest = moved.fold(0.0, f32::max);
        assert!(farthest < 2.0 * fastest / 60.0, "a particle jumps by {farthest} m");
        assert_eq!(crossing_count(&instance.cloths[0]), 0);
    }

    #[test]
    fn with_reduced_motion_the_sheet_starts_at_rest() {
        let settings = Settings::default();
        let mut instance = build(&settings, true).unwrap();
        settle(&mut instance, &settings, true).unwrap();
        assert!(instance.cloths[0].velocities().all(|velocity| velocity == Vec3::ZERO));
    }

    /// Ticks of the stored pose: calm ones, and those in the gust.
    const STORED_TICKS: [u32; 2] = [110, 14];

    #[test]
    fn the_stored_pose_is_that_of_the_sheet_after_its_ticks() {
        let mut instance = build(&Settings::default(), false).unwrap();
        instance.step(STORED_TICKS[0]);
        let cloth = &mut instance.cloths[0];
        let wind = cloth.wind().clone();
        cloth.set_wind(Wind { velocity: wind.velocity * GUST, ..wind }).unwrap();
        cloth.step(STORED_TICKS[1]);
        let below = STORED_RESOLUTION as usize;
        if std::env::var_os("MUSLIN_BLESS").is_some() {
            let mut bytes = Vec::new();
            for (at, velocity) in cloth.positions().iter().zip(cloth.velocities()).skip(below) {
                let steps = (*at / POSITION_STEP).round().to_array();
                bytes.extend(steps.iter().flat_map(|step| (*step as i16).to_le_bytes()));
                let steps = (velocity / VELOCITY_STEP).round().to_array();
                bytes.extend(steps.iter().map(|step| *step as i8 as u8));
            }
            let file = concat!(env!("CARGO_MANIFEST_DIR"), "/src/scene/silk-in-a-gust.bin");
            std::fs::write(file, bytes).unwrap();
            return;
        }
        // After a change of the solver its folds may be others, but the sheet hangs and blows alike.
        let now = cloth.positions().to_vec();
        set_stored_pose(cloth, false).unwrap();
        assert_eq!(STORED_POSE.len(), (now.len() - below) * STORED_BYTES);
        let off = now.iter().zip(cloth.positions()).map(|(a, b)| a.distance(*b)).sum::<f32>();
        let mean = off / now.len() as f32;
        assert!(mean < 0.1, "a particle is {mean} m off on average");
    }
}
