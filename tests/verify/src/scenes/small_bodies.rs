//! Bodies as small as a few cells of the mesh.

use super::impacts::is_ahead;
use crate::play::{Play, Scene, Setup};
use crate::shapes::{capsule, floor, level_sheet, sphere, with_surface};
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, GridDesc, Result};
use std::f32::consts::FRAC_PI_2;

pub fn scenes() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for (suffix, is_surface) in [("", false), ("-surface", true)] {
        let sheet = move || {
            let desc = level_sheet(40, 0.7, 0.0);
            if is_surface { with_surface(desc) } else { desc }
        };
        scenes.push(Scene::new(format!("small-sphere{suffix}"), 90, move || {
            drape(sheet(), sphere(0.03, Vec3::Y * -0.05))
        }));
        scenes.push(Scene::new(format!("small-capsule{suffix}"), 90, move || {
            let rotation = Quat::from_rotation_z(FRAC_PI_2);
            drape(sheet(), ColliderDesc { rotation, ..capsule(0.03, 0.15, Vec3::Y * -0.05) })
        }));
    }
    for speed in [1, 2, 5] {
        scenes.push(Scene::new(format!("small-ball-{speed}"), 60, move || ball(speed as f32)));
    }
    scenes
}

/// A sheet that falls on a small body above a floor.
fn drape(desc: GridDesc, body: ColliderDesc) -> Result<Setup> {
    let mut play = Play::grid(&desc)?;
    play.add(body)?;
    play.add(floor(-0.6))?;
    Ok(play.into())
}

/// A ball of 5 cm that is pushed up into a level sheet and on for 0.3 m.
fn ball(speed: f32) -> Result<Setup> {
    let mut play = Play::grid(&level_sheet(40, 0.8, 0.0))?;
    let mut y = -0.1;
    play.add(sphere(0.05, Vec3::Y * y))?;
    Ok(Setup::from(play)
        .drive(move |play, _| {
            y = (y + speed / 60.0).min(0.2);
            play.move_body(0, Vec3::Y * y, Quat::IDENTITY)
        })
        .watch(|play, tick| if tick < 30 { is_ahead(play, Vec3::Y) } else { Ok(()) }))
}
