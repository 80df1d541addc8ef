//! Cloth that is gripped: fists of bodies and of grabs, a pull through a gap.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{
    capsule, cuboid, floor, level_sheet, sphere, upright_sheet, with_bound, with_surface,
};
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, GridDesc, PinMode, Result};
use std::f32::consts::{FRAC_PI_2, TAU};

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("fist-of-spheres", 180, fist_of_spheres).short(100),
        Scene::new("fist-of-fingers", 180, fist_of_fingers),
        Scene::new("fist-of-grabs", 180, || fist_of_grabs(0.0)).short(120),
        Scene::new("fist-of-grabs-bound", 180, || fist_of_grabs(0.05)),
        Scene::new("two-grabs-apart-bound", 120, grabs_apart),
        Scene::new("through-a-gap", 240, through_a_gap),
    ]
}

/// Position of a finger of a ring, which closes with `share` from 0 to 1.
fn around(index: u32, count: u32, open: f32, closed: f32, share: f32) -> Vec3 {
    let (sine, cosine) = (index as f32 / count as f32 * TAU).sin_cos();
    Vec3::new(cosine, 0.0, sine) * (open + (closed - open) * share)
}

/// Six spheres that close around a hung sheet, and leave room for its folds.
fn fist_of_spheres() -> Result<Setup> {
    let desc = GridDesc { pin_mode: PinMode::TopEdge, ..upright_sheet(30, 0.6) };
    let mut play = Play::grid(&with_surface(desc))?;
    let (radius, count) = (0.05, 6);
    for index in 0..count {
        play.add(sphere(radius, around(index, count, 0.4, 0.12, 0.0)))?;
    }
    Ok(Setup::from(play).drive(move |play, tick| {
        let share = (tick as f32 / 90.0).min(1.0);
        (0..count).try_for_each(|index| {
            let position = around(index, count, 0.4, 0.12, share);
            play.move_body(index as usize, position, Quat::IDENTITY)
        })
    }))
}

/// Four fingers that press a sheet on a palm, with a gap of 6 mm, and then lift it.
fn fist_of_fingers() -> Result<Setup> {
    let mut play = Play::grid(&with_surface(level_sheet(30, 0.5, 0.021)))?;
    play.add(cuboid(Vec3::new(0.06, 0.02, 0.06), Vec3::ZERO))?;
    let pose = |finger: u32, share: f32, lift: f32| {
        let x = 0.036 * (finger as f32 - 1.5);
        Vec3::new(x, 0.2 + (0.041 - 0.2) * share + lift, 0.0)
    };
    let rotation = Quat::from_rotation_x(FRAC_PI_2);
    for finger in 0..4 {
        play.add(ColliderDesc { rotation, ..capsule(0.015, 0.04, pose(finger, 0.0, 0.0)) })?;
    }
    Ok(Setup::from(play).drive(move |play, tick| {
        let share = (tick as f32 / 60.0).min(1.0);
        let lift = 0.3 * (tick.saturating_sub(60) as f32 / 60.0).min(1.0);
        play.move_body(0, Vec3::Y * lift, Quat::IDENTITY)?;
        (0..4).try_for_each(|finger| {
            play.move_body(finger as usize + 1, pose(finger, share, lift), rotation)
        })
    }))
}

/// Twelve grabs in a ring that close on each other and lift the sheet.
fn fist_of_grabs(max_stretch: f32) -> Result<Setup> {
    let mut play = Play::grid(&with_bound(with_surface(level_sheet(32, 0.62, 0.05)), max_stretch))?;
    play.add(floor(0.0))?;
    for index in 0..12 {
        let at = around(index, 12, 0.16, 0.0, 0.0);
        let (column, row) = (((at.x + 0.31) / 0.02).round(), ((at.z + 0.31) / 0.02).round());
        play.grab(row as u32 * 32 + column as u32)?;
    }
    Ok(Setup::from(play).drive(|play, tick| {
        let share = (tick as f32 / 90.0).min(1.0);
        let height = 0.05 + 0.5 * (tick as f32 / 120.0).min(1.0);
        for (index, (grab, _)) in play.grabs.clone().into_iter().enumerate() {
            let at = around(index as u32, 12, 0.16, 0.04, share);
            play.cloth.move_grab(grab, at.with_y(height))?;
        }
        Ok(())
    }))
}

/// Two grabs that pull a bounded sheet apart beyond its bound, then back.
fn grabs_apart() -> Result<Setup> {
    let mut play = Play::grid(&with_bound(with_surface(upright_sheet(16, 0.3)), 0.05))?;
    play.grab(7 * 16)?;
    play.grab(7 * 16 + 15)?;
    Ok(Setup::from(play).drive(|play, tick| {
        let apart = 0.15 + 0.1 * (TAU * tick as f32 / 120.0).sin().max(0.0);
        for ((grab, _), side) in play.grabs.clone().into_iter().zip([-1.0, 1.0]) {
            play.cloth.move_grab(grab, Vec3::new(side * apart, 0.01, 0.0))?;
        }
        Ok(())
    }))
}

/// A sheet that is pulled by one grab through the gap between two spheres, 8 cm wide.
fn through_a_gap() -> Result<Setup> {
    let mut play = Play::grid(&with_surface(level_sheet(30, 0.5, 0.0)))?;
    for side in [-1.0, 1.0] {
        play.add(sphere(0.15, Vec3::new(0.19 * side, -0.17, 0.0)))?;
    }
    play.grab(15 * 30 + 15)?;
    Ok(Setup::from(play).drive(|play, tick| {
        let (grab, _) = play.grabs[0];
        let pull = 0.8 * (tick.saturating_sub(20) as f32 / 160.0).min(1.0);
        play.cloth.move_grab(grab, Vec3::new(0.0, -pull, 0.0))
    }))
}
