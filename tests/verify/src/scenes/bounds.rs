//! Cloth with a bound of stretch that self-collision, wind or held ends act against.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{floor, upright_sheet, with_bound, with_surface};
use muslin::glam::{Quat, Vec3};
use muslin::{GridDesc, PinMode, Result, Wind};

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("shaken-strip", 300, || shaken(2, 8)).short(300),
        Scene::new("shaken-scarf", 240, || shaken(5, 40)),
        Scene::new("wind-bound", 240, || wind(true)).short(60),
        Scene::new("wind-bound-no-surface", 240, || wind(false)),
        Scene::new("twist", 240, || twist(0.0)),
        Scene::new("twist-bound", 240, || twist(0.05)),
        Scene::new("crumple-bound", 240, crumple_bound),
        Scene::new("flag", 240, flag),
    ]
}

/// A strip or scarf whose attached end is moved to and fro by 5 cm a tick.
fn shaken(columns: u32, rows: u32) -> Result<Setup> {
    let desc =
        GridDesc { columns, rows, spacing: 0.025, pin_mode: PinMode::None, ..GridDesc::default() };
    let mut play = Play::grid(&with_surface(with_bound(desc, 0.05)))?;
    let edge: Vec<u32> = (0..columns).collect();
    let attachment = play.cloth.attach(&edge, Vec3::ZERO, Quat::IDENTITY)?;
    let mut x = 0.0;
    Ok(Setup::from(play).drive(move |play, tick| {
        x += if (tick / 15).is_multiple_of(2) { 0.05 } else { -0.05 };
        play.cloth.move_attachment(attachment, Vec3::X * x, Quat::IDENTITY)
    }))
}

/// A hung sheet in 8 m/s of wind.
fn wind(is_surface: bool) -> Result<Setup> {
    let desc = with_bound(GridDesc { columns: 20, rows: 20, ..GridDesc::default() }, 0.02);
    let mut play = Play::grid(&if is_surface { with_surface(desc) } else { desc })?;
    play.cloth.set_wind(Wind { velocity: Vec3::Z * 8.0, ..Wind::default() })?;
    Ok(play.into())
}

/// A sheet whose two edges turn against each other by two turns and come closer.
fn twist(max_stretch: f32) -> Result<Setup> {
    let desc = GridDesc { columns: 24, rows: 36, ..upright_sheet(24, 0.46) };
    let mut play = Play::grid(&with_bound(with_surface(desc), max_stretch))?;
    let (top, bottom): (Vec<u32>, Vec<u32>) = ((0..24).collect(), (35 * 24..36 * 24).collect());
    let top = play.cloth.attach(&top, Vec3::ZERO, Quat::IDENTITY)?;
    let bottom = play.cloth.attach(&bottom, Vec3::ZERO, Quat::IDENTITY)?;
    Ok(Setup::from(play).drive(move |play, tick| {
        let share = (tick as f32 / 200.0).min(1.0);
        let turn = Quat::from_rotation_y(std::f32::consts::TAU * share);
        play.cloth.move_attachment(top, Vec3::ZERO, turn)?;
        play.cloth.move_attachment(bottom, Vec3::Y * 0.35 * share, turn.inverse())
    }))
}

/// A sheet with a bound that crumples on the floor.
fn crumple_bound() -> Result<Setup> {
    let desc = GridDesc { origin: Vec3::new(-0.5, 1.05, 0.0), ..upright_sheet(28, 1.0) };
    let mut play = Play::grid(&with_bound(with_surface(desc), 0.03))?;
    play.add(floor(0.0))?;
    play.set_velocities(|x| Vec3::Z * (0.3 * (7.0 * x.x + 1.0).sin() * (5.0 * x.y + 2.0).sin()))?;
    Ok(play.into())
}

/// A flag in a gusty wind.
fn flag() -> Result<Setup> {
    let desc = with_surface(muslin_scenes::Flag::desc(40));
    let mut play = Play::new(muslin_scenes::Flag::hoist(&desc, false)?);
    play.cloth.set_wind(muslin_scenes::Flag::wind(9.0))?;
    Ok(play.into())
}
