//! What is on the stage: the cloth of the scene, made and kept as the controls say, and what it hangs
//! on.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};
use muslin::{Cloth, ColliderDesc, PinMode, Result, Wind};
use muslin_scenes::{Flag, HangingSheet, SheetOnBall};
use serde::{Deserialize, Serialize};

use crate::fabric::Fabric;
use crate::render::light::FLOOR;
use crate::render::solid::Solid;
use crate::settings::{Pinning, Settings};

/// Speed of the air at wind 1 [m/s].
const BREEZE: f32 = 1.3;
/// And where a flag flies.
const STIFF_BREEZE: f32 = 7.0;
/// And where a sheet only lies.
const BREATH: f32 = 0.6;
/// What the cloth is kept over the floor, so that it never flickers through [m].
const CLEARANCE: f32 = 0.006;
/// What the ball is drawn smaller than it is felt, since triangles cut its corners [m].
const SKIN: f32 = 0.009;
/// Radius of the flag's pole [m].
const POLE: f32 = 0.016;

/// A scene of the demo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Show {
    /// The sheet that hangs by its top edge.
    #[default]
    Sheet,
    /// The flag that streams from its pole.
    Flag,
    /// The sheet that falls on a ball.
    Ball,
}

impl Show {
    /// All of them, in the order of the panel.
    pub const ALL: [Self; 3] = [Self::Sheet, Self::Flag, Self::Ball];
    /// What the panel calls them.
    pub const NAMES: [&'static str; 3] = ["Sheet", "Flag", "Ball"];

    /// What its cloth is of when it opens.
    pub fn fabric(self) -> Fabric {
        match self {
            Self::Sheet => Fabric::Silk,
            Self::Flag => Fabric::Flag,
            Self::Ball => Fabric::Cotton,
        }
    }
}

/// Particles across and down.
pub fn weave(settings: &Settings) -> [u32; 2] {
    match settings.scene {
        Show::Sheet | Show::Ball => [settings.resolution; 2],
        Show::Flag => Flag::weave(settings.resolution),
    }
}

/// Distance between neighbouring particles [m].
pub fn spacing(settings: &Settings) -> f32 {
    let across = match settings.scene {
        Show::Sheet => HangingSheet::SIZE,
        Show::Flag => Flag::SIZE.x,
        Show::Ball => SheetOnBall::SIZE,
    };
    across / (settings.resolution - 1) as f32
}

/// Width and height of the cloth [m].
pub fn span(settings: &Settings) -> Vec2 {
    weave(settings).map(|n| (n - 1) as f32 * spacing(settings)).into()
}

/// What the cloth hangs on.
pub fn solids(settings: &Settings) -> Vec<Solid> {
    match settings.scene {
        Show::Sheet => Vec::new(),
        Show::Ball => {
            let centre = SheetOnBall::CENTRE;
            let radius = SheetOnBall::RADIUS - SKIN;
            let foot = centre.with_y(FLOOR);
            vec![
                Solid { from: centre, to: centre, radius, colour: 0x6f7f9c },
                Solid { from: foot, to: centre, radius: 0.09, colour: 0x4a5264 },
            ]
        }
        Show::Flag => {
            let foot = Vec3::new(Flag::HOIST.x - POLE, FLOOR, 0.0);
            let top = foot.with_y(Flag::HOIST.y + 0.09);
            let pole = Solid { from: foot, to: top, radius: POLE, colour: 0x8d93a3 };
            let knob = top + Vec3::Y * 0.02;
            vec![pole, Solid { from: knob, to: knob, radius: 0.034, colour: 0xd9a04a }]
        }
    }
}

/// A fresh cloth over the floor.
///
/// # Errors
/// As [`Cloth::grid`]; clamped settings give none.
pub fn build(settings: &Settings, calm: bool) -> Result<Cloth> {
    let mut desc = match settings.scene {
        Show::Sheet => HangingSheet::desc(settings.resolution, pin_mode(settings.pinning)),
        Show::Flag => Flag::desc(settings.resolution),
        Show::Ball => SheetOnBall::desc(settings.resolution),
    };
    desc.material = settings.fabric.material();
    // The stiffness slider multiplies them by up to twelve sweeps: four are smooth, and cheap.
    desc.settings.substeps = 4;
    let mut cloth = match settings.scene {
        Show::Sheet | Show::Ball => Cloth::grid(&desc)?,
        Show::Flag => Flag::hoisted(&desc, settings.pinning != Pinning::TopEdge)?,
    };
    cloth.add_collider(&ColliderDesc {
        position: Vec3::Y * (FLOOR + CLEARANCE),
        ..ColliderDesc::default()
    })?;
    if settings.scene == Show::Ball {
        SheetOnBall::put_ball(&mut cloth)?;
    } else {
        drape(&mut cloth, settings)?;
    }
    tune(&mut cloth, settings, calm)?;
    Ok(cloth)
}

fn pin_mode(pinning: Pinning) -> PinMode {
    match pinning {
        Pinning::TopEdge => PinMode::TopEdge,
        Pinning::TopCorners => PinMode::TopCorners,
        Pinning::Corners => PinMode::Corners,
    }
}

/// Gathers the flat sheet like a curtain, or arches it between its corners; lays a flag in waves.
///
/// Every row follows one curve whose arc is as long as the row, so no thread is stretched: the
/// direction of the curve is given along the arc, and the places are its running sum.
fn drape(cloth: &mut Cloth, settings: &Settings) -> Result<()> {
    let ([columns, rows], step) = (weave(settings), spacing(settings));
    let direction = |u: f32| match (settings.scene, settings.pinning) {
        // Uneven folds: the phase runs ahead and falls behind.
        (Show::Sheet, Pinning::TopEdge) => {
            0.78 * (TAU * (4.5 * u + 0.10 * (TAU * u).sin() + 0.07 * (2.3 * TAU * u).cos())).sin()
        }
        (Show::Sheet | Show::Ball, _) => 0.75 * (1.0 - 2.0 * u),
        (Show::Flag, _) => 0.7 * u.sqrt() * (TAU * 1.6 * u).sin(),
    };
    let mut curve = vec![Vec2::ZERO];
    for i in 1..columns {
        let turn = direction((i as f32 - 0.5) / (columns - 1) as f32);
        curve.push(curve[i as usize - 1] + Vec2::from_angle(turn) * step);
    }
    let start = match settings.scene {
        Show::Sheet | Show::Ball => -0.5 * (curve[0] + curve[columns as usize - 1]),
        Show::Flag => Vec2::new(Flag::HOIST.x, Flag::HOIST.z),
    };
    for row in 0..rows {
        for column in 0..columns {
            let particle = row * columns + column;
            let height = cloth.positions()[particle as usize].y;
            let place = curve[column as usize] + start;
            cloth.set_position(particle, Vec3::new(place.x, height, place.y))?;
        }
    }
    Ok(())
}

/// Brings a cloth in line with the controls; `calm` takes most of the restlessness out of the wind.
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
    let wind = match settings.scene {
        Show::Sheet => HangingSheet::wind(BREEZE * settings.wind),
        Show::Flag => Flag::wind(STIFF_BREEZE * settings.wind),
        Show::Ball => SheetOnBall::wind(BREATH * settings.wind),
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
    fn every_scene_opens_in_motion_unstretched_and_on_the_stage() {
        for scene in Show::ALL {
            for pinning in [Pinning::TopEdge, Pinning::TopCorners, Pinning::Corners] {
                let settings = Settings { scene, pinning, ..Settings::default() };
                let mut cloth = build(&settings, false).unwrap();
                let [columns, rows] = weave(&settings);
                assert_eq!(cloth.positions().len(), (columns * rows) as usize);
                let stretch = cloth.stats().max_stretch;
                assert!(stretch < 0.01, "{scene:?} opens stretched by {stretch}");
                let start = cloth.positions().to_vec();
                cloth.step(6);
                let moved = start.iter().zip(cloth.positions()).map(|(a, b)| a.distance(*b));
                let farthest = moved.fold(0.0, f32::max);
                assert!(farthest > 0.004 && farthest < 0.6, "{scene:?} moved {farthest} m");
            }
        }
    }

    #[test]
    fn a_calm_wind_is_steadier() {
        for scene in Show::ALL {
            let settings = Settings { scene, ..Settings::default() };
            let [restless, calm] = [false, true].map(|calm| {
                let cloth = build(&settings, calm).unwrap();
                cloth.wind().gust
            });
            assert!(calm < 0.5 * restless);
        }
    }
}
