//! Scenes with wind and aerodynamic forces.

use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, PinMode, Preset, Result, Settings, Wind, WindModel};

/// The default sheet in a wind that uses every wind parameter.
pub fn hanging_in_gusts(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc::default())?;
    cloth.set_wind(Wind {
        velocity: Vec3::new(0.25, 0.125, 2.0),
        gust: 0.5,
        wander: 0.25,
        turbulence: 0.5,
        seed: 7,
        ..Wind::default()
    })?;
    trace.step(&mut cloth, 150);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A sheet pinned at two corners, first with lift in turbulent wind, then in the sine field. Its
/// row length is no multiple of any SIMD width, so that the scalar tails of rows run too.
pub fn two_corners_in_waves(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 23,
        rows: 18,
        pin_mode: PinMode::TopCorners,
        material: Material { lift: 0.75, drag: 0.5, ..Material::default() },
        ..GridDesc::default()
    })?;
    let velocity = Vec3::new(3.0, 0.5, 1.0);
    cloth.set_wind(Wind { velocity, turbulence: 0.25, seed: 3, ..Wind::default() })?;
    trace.step(&mut cloth, 80);
    let model = WindModel::SineField;
    cloth.set_wind(Wind { model, velocity: Vec3::new(0.0, 0.0, 4.0), ..Wind::default() })?;
    trace.step(&mut cloth, 80);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// Soft links under a load that only the strain limit can carry.
pub fn cotton_in_a_storm(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 19,
        rows: 21,
        pin_mode: PinMode::TopCorners,
        material: Material::preset(Preset::Cotton),
        settings: Settings { max_stretch: 0.02, ..Settings::default() },
        ..GridDesc::default()
    })?;
    cloth.set_wind(Wind {
        velocity: Vec3::new(4.0, 0.0, 14.0),
        gust: 1.0,
        wander: 1.0,
        turbulence: 1.0,
        seed: 11,
        ..Wind::default()
    })?;
    trace.step(&mut cloth, 150);
    trace.record_outputs(&mut cloth);
    assert!(cloth.stats().max_stretch > 0.01, "the wind hardly stretches the cloth");
    Ok(())
}
