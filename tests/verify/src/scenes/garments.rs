//! Garments on moving bodies.

#[allow(dead_code)]
#[path = "../../../common/garments.rs"]
mod meshes;

use crate::play::{Play, Scene, Setup};
use crate::shapes::{capsule, floor, round_mesh, tube};
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, MeshDesc, Result, SelfCollision};
use std::f32::consts::{FRAC_PI_2, TAU};

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("skirt-walk", 240, || skirt(25.0, 1.0, false)),
        Scene::new("skirt-walk-surface", 240, || skirt(25.0, 1.0, true)).short(60),
        Scene::new("skirt-kick", 120, || skirt(44.0, 2.5, false)),
        Scene::new("skirt-walk-skinned", 120, || skinned_skirt(25.0, 1.0, false)).short(70),
        Scene::new("skirt-walk-skinned-surface", 120, || skinned_skirt(25.0, 1.0, true)).short(20),
        // Triangles that one leg pushes into the other one pierce it from tick 107 on.
        Scene::new("skirt-kick-skinned", 120, || skinned_skirt(44.0, 2.5, false)).short(110),
        Scene::new("shirt-on-torso", 180, shirt),
        Scene::new("sleeve-on-arm", 180, sleeve),
        Scene::new("shirt-heap", 240, || shirt_heap(meshes::shirt())),
        Scene::new("shirt-heap-dense", 120, || shirt_heap(meshes::dense_shirt(3))),
    ]
}

/// A skirt with a bound that hangs from its waist.
fn skirt_mesh(is_surface: bool) -> MeshDesc {
    let mut desc = tube(64, 26, |ring| {
        let share = ring as f32 / 25.0;
        (0.15 + 0.15 * share, -0.5 * share)
    });
    desc.pinned = (0..64).collect();
    desc.settings.max_stretch = 0.05;
    if is_surface {
        desc.settings.self_collision = SelfCollision::Surface;
    }
    desc
}

/// A skirt over the skinned meshes of two legs, which turn about x at the hip as those of `skirt` do.
fn skinned_skirt(degrees: f32, rate: f32, is_surface: bool) -> Result<Setup> {
    let mut play = Play::mesh(&skirt_mesh(is_surface))?;
    let leg = leg_mesh();
    let pose = {
        let rest = leg.positions.clone();
        move |side: f32, angle: f32| -> Vec<Vec3> {
            let rotation = Quat::from_rotation_x(side * angle);
            let hip = Vec3::X * (0.075 * side);
            rest.iter().map(|x| hip + rotation * (*x - Vec3::Y * 0.28)).collect()
        }
    };
    for side in [-1.0, 1.0] {
        play.add(ColliderDesc { positions: pose(side, 0.0), ..leg.clone() })?;
    }
    Ok(Setup::from(play).drive(move |play, tick| {
        let angle = degrees.to_radians() * (TAU * rate * (tick + 1) as f32 / 60.0).sin();
        play.deform_body(0, pose(-1.0, angle))?;
        play.deform_body(1, pose(1.0, angle))
    }))
}

/// A leg around the origin, as long and wide as the capsules of `skirt`.
fn leg_mesh() -> ColliderDesc {
    round_mesh(24, 20, |_, _| Vec3::new(0.08, 0.28, 0.08))
}

/// A skirt with a bound over two legs that turn about x at the hip, to `degrees`, at `rate` [Hz].
fn skirt(degrees: f32, rate: f32, is_surface: bool) -> Result<Setup> {
    let mut play = Play::mesh(&skirt_mesh(is_surface))?;
    let pose = move |side: f32, angle: f32| {
        let rotation = Quat::from_rotation_x(side * angle);
        (Vec3::X * (0.075 * side) + rotation * Vec3::NEG_Y * 0.28, rotation)
    };
    for side in [-1.0, 1.0] {
        let (position, rotation) = pose(side, 0.0);
        play.add(ColliderDesc { rotation, ..capsule(0.08, 0.2, position) })?;
    }
    Ok(Setup::from(play).drive(move |play, tick| {
        let angle = degrees.to_radians() * (TAU * rate * (tick + 1) as f32 / 60.0).sin();
        for (index, side) in [(0, -1.0), (1, 1.0)] {
            let (position, rotation) = pose(side, angle);
            play.move_body(index, position, rotation)?;
        }
        Ok(())
    }))
}

/// A shirt that hangs from its shoulders over a thin torso, which swings by 25° at 1 Hz.
fn shirt() -> Result<Setup> {
    let mut desc = meshes::shirt();
    desc.settings.self_collision = SelfCollision::Surface;
    let mut play = Play::mesh(&desc)?;
    let middle = Vec3::new(0.44, -0.4, 0.0);
    play.add(capsule(0.02, 0.2, middle))?;
    Ok(Setup::from(play).drive(move |play, tick| {
        let angle = 25.0_f32.to_radians() * (TAU * (tick + 1) as f32 / 60.0).sin();
        play.move_body(0, middle, Quat::from_rotation_x(angle))
    }))
}

/// A sleeve around an arm that swings by 25° at 1 Hz.
fn sleeve() -> Result<Setup> {
    let mut desc = meshes::sleeve();
    desc.settings.self_collision = SelfCollision::Surface;
    desc.settings.max_stretch = 0.05;
    let mut play = Play::mesh(&desc)?;
    play.add(capsule(0.06, 0.25, Vec3::NEG_Y * 0.25))?;
    Ok(Setup::from(play).drive(|play, tick| {
        let rotation =
            Quat::from_rotation_z(25.0_f32.to_radians() * (TAU * (tick + 1) as f32 / 60.0).sin());
        play.move_body(0, rotation * Vec3::NEG_Y * 0.25, rotation)
    }))
}

/// A shirt that falls in a heap.
fn shirt_heap(mut desc: MeshDesc) -> Result<Setup> {
    desc.settings.self_collision = SelfCollision::Surface;
    desc.pinned.clear();
    let turn = Quat::from_rotation_x(0.3 * FRAC_PI_2);
    desc.positions.iter_mut().for_each(|x| *x = turn * *x);
    let mut play = Play::mesh(&desc)?;
    let lowest = play.cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
    play.add(floor(lowest - 0.05))?;
    Ok(play.into())
}
