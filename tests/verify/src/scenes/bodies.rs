//! Cloth on bodies: meshes, boxes, a ball that rolls through a curtain, closing boxes.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{
    box_mesh, cuboid, head_with_ears, level_sheet, lumpy_mesh, sphere, upright_sheet, with_surface,
};
use muslin::glam::{Quat, Vec3};
use muslin::{ColliderDesc, GridDesc, PinMode, Result};
use muslin_scenes::Curtain;

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("mesh-body", 120, || drape(level_sheet(40, 1.17, 0.4), lumpy_mesh())).short(40),
        Scene::new("mesh-body-surface", 120, || {
            drape(with_surface(level_sheet(40, 1.17, 0.4)), lumpy_mesh())
        }),
        Scene::new("mesh-ears", 60, || drape(level_sheet(40, 1.17, 0.5), head_with_ears())),
        Scene::new("box-mesh-surface", 120, || {
            let sheet = with_surface(level_sheet(49, 0.9, 0.25));
            drape(sheet, box_mesh(Vec3::new(0.25, 0.2, 0.25), 6))
        }),
        Scene::new("box-surface", 120, || {
            let sheet = with_surface(level_sheet(49, 0.9, 0.25));
            drape(sheet, cuboid(Vec3::new(0.25, 0.2, 0.25), Vec3::ZERO))
        }),
        Scene::new("curtain-and-ball", 240, || curtain(30)),
        Scene::new("curtain-and-ball-16", 240, || curtain(16)).short(90),
        Scene::new("closing-boxes", 180, || closing_boxes(true)),
        Scene::new("closing-boxes-no-surface", 180, || closing_boxes(false)),
    ]
}

/// A sheet that falls on a body.
fn drape(desc: GridDesc, body: ColliderDesc) -> Result<Setup> {
    let mut play = Play::grid(&desc)?;
    play.add(body)?;
    Ok(play.into())
}

/// The demo's curtain on rings, through which a ball rolls.
fn curtain(particles_across: u32) -> Result<Setup> {
    let desc = Curtain::desc(particles_across);
    let flat = muslin::Cloth::grid(&desc)?;
    let mut play = Play::new(flat);
    play.cloth = Curtain::hang_on_rings(&desc)?;
    let (position, rotation) = Curtain::BALL.pose_at(0.0);
    play.add(ColliderDesc { rotation, ..sphere(Curtain::BALL.radius, position) })?;
    Ok(Setup::from(play).drive(|play, tick| {
        let (position, rotation) = Curtain::BALL.pose_at((tick + 1) as f32 / 60.0);
        play.move_body(0, position, rotation)
    }))
}

/// A hung sheet that is caught between two boxes, which stop four thicknesses apart.
fn closing_boxes(is_surface: bool) -> Result<Setup> {
    let desc = GridDesc { pin_mode: PinMode::TopEdge, ..upright_sheet(32, 0.6) };
    let mut play = Play::grid(&if is_surface { with_surface(desc) } else { desc })?;
    play.set_velocities(|x| Vec3::Z * (0.5 * (9.0 * x.x).sin() * (0.3 - x.y)))?;
    let gap = 4.0 * play.cloth.material().thickness;
    let half = Vec3::new(0.2, 0.15, 0.05);
    let at = move |side: f32, share: f32| {
        let distance = 0.2 + share * (0.5 * gap - 0.2);
        Vec3::new(0.0, -0.05, side * (distance + half.z))
    };
    for side in [-1.0, 1.0] {
        play.add(cuboid(half, at(side, 0.0)))?;
    }
    Ok(Setup::from(play).drive(move |play, tick| {
        let share = ((tick + 1) as f32 / 60.0).min(1.0);
        play.move_body(0, at(-1.0, share), Quat::IDENTITY)?;
        play.move_body(1, at(1.0, share), Quat::IDENTITY)
    }))
}
