//! Cloth that falls on a floor and on itself.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{
    cuboid, floor, level_sheet, push_patch, upright_sheet, with_bound, with_surface,
};
use muslin::glam::Vec3;
use muslin::{GridDesc, Material, MeshDesc, PinMode, Preset, Result, SelfCollision};

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("strip-on-plane", 300, strip).short(120),
        Scene::new("crumple-40", 300, || crumple(40)),
        Scene::new("crumple-64", 600, || crumple(64)),
        Scene::new("crumple-16", 240, || crumple(16)).short(90),
        Scene::new("drop", 180, || drop(drop_desc(), floor(0.0))).short(60),
        Scene::new("drop-level", 180, || {
            drop(with_surface(level_sheet(40, 0.585, 0.635)), floor(0.0))
        }),
        Scene::new("drop-on-box", 180, || {
            drop(drop_desc(), cuboid(Vec3::splat(0.5), -Vec3::Y * 0.5))
        }),
        Scene::new("drop-silk", 180, || drop(of_material(Preset::Silk), floor(0.0))),
        Scene::new("drop-paper", 180, || drop(of_material(Preset::Paper), floor(0.0))),
        Scene::new("drop-bound", 180, || drop(with_bound(drop_desc(), 0.02), floor(0.0))),
        Scene::new("unpinned-over-plane", 120, unpinned).short(60),
        Scene::new("heap-of-strips", 300, heap_of_strips),
        Scene::new("folded-sheets", 240, folded_sheets),
    ]
}

/// A strip that is dropped on its end and folds onto itself.
fn strip() -> Result<Setup> {
    let (sin, cos) = 10.0_f32.to_radians().sin_cos();
    let mut play = Play::grid(&with_surface(GridDesc {
        columns: 2,
        rows: 51,
        spacing: 0.01,
        origin: Vec3::new(0.0, 0.6, 0.0),
        right: Vec3::new(sin, 0.0, cos),
        pin_mode: PinMode::None,
        ..GridDesc::default()
    }))?;
    play.add(floor(0.0))?;
    Ok(play.into())
}

/// A sheet of 2 m that stands on its edge and crumples.
fn crumple(side: u32) -> Result<Setup> {
    let desc = GridDesc { origin: Vec3::new(-1.0, 2.05, 0.0), ..upright_sheet(side, 2.0) };
    let mut play = Play::grid(&with_surface(desc))?;
    play.add(floor(0.0))?;
    play.set_velocities(|x| Vec3::Z * (0.3 * (7.0 * x.x + 1.0).sin() * (5.0 * x.y + 2.0).sin()))?;
    Ok(play.into())
}

/// A sheet in the x–y plane whose lower edge is 5 cm above y = 0.
fn drop_desc() -> GridDesc {
    let sheet = upright_sheet(40, 0.585);
    with_surface(GridDesc { origin: sheet.origin.with_y(0.635), ..sheet })
}

fn of_material(preset: Preset) -> GridDesc {
    GridDesc { material: Material::preset(preset), ..drop_desc() }
}

/// A sheet that is dropped with waves.
fn drop(desc: GridDesc, body: muslin::ColliderDesc) -> Result<Setup> {
    let mut play = Play::grid(&desc)?;
    play.add(body)?;
    play.set_velocities(|x| Vec3::Z * (0.05 * (7.0 * x.x + 5.0 * x.y).sin()))?;
    Ok(play.into())
}

/// A hung sheet that is released 5 cm above the floor.
fn unpinned() -> Result<Setup> {
    let mut play = Play::grid(&with_surface(GridDesc::default()))?;
    let lowest = play.cloth.positions().iter().map(|x| x.y).fold(f32::MAX, f32::min);
    play.add(floor(lowest - 0.05))?;
    Ok(Setup::from(play).drive(|play, tick| {
        if tick == 30 {
            play.cloth.unpin_all();
        }
        Ok(())
    }))
}

/// Twelve strips across each other that fall between two walls.
fn heap_of_strips() -> Result<Setup> {
    let mut desc = MeshDesc::default();
    for strip in 0..12 {
        let turn = strip as f32 * 0.9;
        let (sine, cosine) = turn.sin_cos();
        let height = 0.15 + 0.03 * strip as f32;
        push_patch(&mut desc, 31, 4, |i, j| {
            let (x, z) = (0.02 * (i as f32 - 15.0), 0.02 * (j as f32 - 1.5));
            Vec3::new(x * cosine - z * sine, height + 0.02 * (9.0 * x).sin(), x * sine + z * cosine)
        });
    }
    desc.settings.self_collision = SelfCollision::Surface;
    let mut play = Play::mesh(&desc)?;
    play.add(floor(0.0))?;
    for side in [-1.0, 1.0] {
        play.add(cuboid(Vec3::new(0.05, 0.3, 0.5), Vec3::new(0.4 * side, 0.3, 0.0)))?;
    }
    Ok(play.into())
}

/// Three zigzag-folded sheets on top of each other that fall flat.
fn folded_sheets() -> Result<Setup> {
    let mut desc = MeshDesc::default();
    for sheet in 0..3 {
        push_patch(&mut desc, 16, 41, |i, j| {
            Vec3::new(i as f32, sheet as f32 * 40.0, j as f32) * 0.02
        });
    }
    desc.settings.self_collision = SelfCollision::Surface;
    let mut play = Play::mesh(&desc)?;
    play.add(floor(0.0))?;
    // Folds of 0.16 m, layers 12 mm apart at their open ends, sheets 60 mm apart.
    for particle in 0..play.cloth.particle_count() {
        let (sheet, i, j) = (particle / (16 * 41), particle % 16, particle % (16 * 41) / 16);
        let (layer, along) = (j / 8, j % 8);
        let z = if layer.is_multiple_of(2) { along } else { 8 - along };
        let lift = 0.012 * (layer as f32 + along as f32 / 8.0);
        let position = Vec3::new(
            0.02 * i as f32 + 0.05 * sheet as f32,
            0.03 + 0.09 * sheet as f32 + lift,
            0.0198 * z as f32 + 0.02 * sheet as f32,
        );
        play.cloth.set_position(particle, position)?;
    }
    Ok(play.into())
}
