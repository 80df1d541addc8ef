//! Tears and cuts of cloth that crumples.

use crate::play::{Play, Scene, Setup};
use crate::shapes::{floor, upright_sheet, with_bound, with_surface};
use muslin::glam::Vec3;
use muslin::{GridDesc, PinMode, Result};

pub fn scenes() -> Vec<Scene> {
    vec![
        Scene::new("cut-while-crumpling", 180, cuts),
        Scene::new("tear-while-crumpling", 180, tears).short(90),
        Scene::new("tear-by-grabs-bound", 180, torn_by_grabs),
    ]
}

/// A sheet of 0.8 m that stands on its edge over a floor.
fn standing(side: u32) -> Result<Play> {
    let mut desc = GridDesc { origin: Vec3::new(-0.4, 0.83, 0.0), ..upright_sheet(side, 0.8) };
    desc.extra_particles = 4 * side * side;
    let mut play = Play::grid(&with_surface(desc))?;
    play.add(floor(0.0))?;
    play.set_velocities(|x| Vec3::Z * (0.3 * (7.0 * x.x + 1.0).sin() * (5.0 * x.y + 2.0).sin()))?;
    Ok(play)
}

/// Blades cut through the crumpling sheet every 20 ticks.
fn cuts() -> Result<Setup> {
    Ok(Setup::from(standing(24)?).drive(|play, tick| {
        if tick >= 20 && tick.is_multiple_of(20) {
            let x = -0.35 + 0.09 * (tick / 20) as f32;
            let from = Vec3::new(x, -0.1, -1.0);
            play.cloth.cut(from, from.with_z(1.0), Vec3::new(0.03, 0.35, 0.0))?;
        }
        Ok(())
    }))
}

/// Edges of the crumpling sheet are torn every 5 ticks.
fn tears() -> Result<Setup> {
    Ok(Setup::from(standing(24)?).drive(|play, tick| {
        if tick >= 20 && tick.is_multiple_of(5) {
            let row = 2 + tick / 9 % 20;
            let column = 3 + tick / 5 % 18;
            let particle = row * 24 + column;
            // An edge that is torn already is no edge any more, which is refused.
            play.cloth.tear_edge(particle, particle + 1).ok();
        }
        Ok(())
    }))
}

/// Grabs tear a sheet with a bound that is pinned by its corners.
fn torn_by_grabs() -> Result<Setup> {
    let mut desc = with_bound(with_surface(upright_sheet(22, 0.63)), 0.3);
    desc.pin_mode = PinMode::Corners;
    desc.settings.tearing = true;
    (desc.material.tear_stretch, desc.material.tear_variation) = (1.2, 0.5);
    let mut play = Play::grid(&desc)?;
    play.grab(7 * 22 + 7)?;
    play.grab(14 * 22 + 15)?;
    let starts = play.grabs.iter().map(|(_, particle)| play.cloth.position(*particle));
    let starts: Vec<Vec3> = starts.map(Option::unwrap_or_default).collect();
    Ok(Setup::from(play).drive(move |play, tick| {
        let pull = 0.6 * (tick as f32 / 100.0).min(1.0);
        for (index, (grab, _)) in play.grabs.clone().into_iter().enumerate() {
            let side = if index == 0 { 1.0 } else { -1.0 };
            play.cloth.move_grab(grab, starts[index] + Vec3::new(-0.3, 0.0, side) * pull)?;
        }
        Ok(())
    }))
}
