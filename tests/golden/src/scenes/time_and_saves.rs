//! Scenes with other time steps, saves, resets and changes of settings.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{
    Cloth, ColliderDesc, GridDesc, Material, PinMode, Preset, Result, Settings, Wind, WindModel,
};

/// One iteration per substep, without tethers.
pub fn first_order(trace: &mut Trace) -> Result<()> {
    let settings = Settings { iterations: 1, substeps: 7, tethers: false, ..Settings::default() };
    let desc = GridDesc { columns: 11, rows: 20, settings, ..GridDesc::default() };
    let mut cloth = Cloth::grid(&desc)?;
    let velocity = Vec3::new(-1.0, 0.0, 2.0);
    cloth.set_wind(Wind { velocity, turbulence: 0.75, seed: 1, ..Wind::default() })?;
    trace.step(&mut cloth, 150);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// The settings of the receipt scene: 120 ticks per second, eight substeps of six iterations, its
/// wind and its floor.
pub fn receipt(trace: &mut Trace) -> Result<()> {
    let tick = 1.0 / 120.0;
    let settings =
        Settings { tick, substeps: 8, iterations: 6, damping: 0.25, ..Settings::default() };
    let mut cloth =
        Cloth::grid(&GridDesc { columns: 40, rows: 60, settings, ..GridDesc::default() })?;
    let (model, velocity) = (WindModel::SineField, Vec3::Z * 2.0);
    cloth.set_wind(Wind { model, velocity, ..Wind::default() })?;
    cloth.add_collider(&ColliderDesc {
        position: Vec3::Y * -2.5,
        friction: 0.0,
        restitution: 0.2,
        tangential_restitution: 0.8,
        ..ColliderDesc::default()
    })?;
    trace.step(&mut cloth, 20);
    cloth.unpin_all();
    trace.step(&mut cloth, 20);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A cloth is saved while it tears in the wind with a grab, restored, cloned and continued; then it
/// is reset and runs again. The saved bytes are the same on every platform.
pub fn saved_and_reset(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 17,
        rows: 13,
        pin_mode: PinMode::TopCorners,
        material: Material { tear_stretch: 1.2, ..Material::preset(Preset::Denim) },
        settings: Settings { tearing: true, ..Settings::default() },
        ..GridDesc::default()
    })?;
    let velocity = Vec3::new(0.5, 0.0, 3.0);
    cloth.set_wind(Wind { velocity, gust: 0.5, seed: 2, ..Wind::default() })?;
    let grab = cloth.grab_particle(6 * 17 + 8)?;
    for i in 1..=50 {
        cloth.move_grab(grab, along(Vec3::new(0.375, -0.25, 0.0), Vec3::Z * 0.0625, i))?;
        trace.step(&mut cloth, 1);
    }
    let bytes = cloth.save();
    trace.record_bytes(&bytes);
    let mut restored = Cloth::restore(&bytes)?;
    let mut copy = restored.clone();
    for one in [&mut cloth, &mut restored, &mut copy] {
        one.release(grab)?;
        trace.step(one, 20);
        trace.record_outputs(one);
    }
    assert_eq!(copy.state_hash(), cloth.state_hash(), "copies must continue with the same bits");
    cloth.reset();
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// Frames of uneven length while settings and material change.
pub fn changed_in_flight(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 18,
        rows: 18,
        pin_mode: PinMode::TopCorners,
        ..GridDesc::default()
    })?;
    cloth.set_wind(Wind { velocity: Vec3::new(1.0, 0.0, 1.0), ..Wind::default() })?;
    let plain = Settings::default();
    let changes = [
        (plain.clone(), Preset::Silk),
        (Settings { iterations: 1, damping: 2.0, ..plain.clone() }, Preset::Denim),
        (Settings { gravity: Vec3::new(4.0, -4.0, 0.0), ..plain.clone() }, Preset::Leather),
        (Settings { tick: 0.03125, max_stretch: 0.01, ..plain.clone() }, Preset::Paper),
        (Settings { max_displacement: 0.0625, substeps: 9, ..plain }, Preset::Cotton),
    ];
    for (settings, preset) in changes {
        cloth.set_settings(settings)?;
        cloth.set_material(Material::preset(preset))?;
        for i in 0..24 {
            trace.advance(&mut cloth, (i % 5) as f32 * 0.0078125)?;
        }
    }
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// Damping reduces the velocity through the subnormal range to zero. A host that flushes subnormal
/// numbers to zero would get other bits.
pub fn fading_to_nothing(trace: &mut Trace) -> Result<()> {
    let still = Settings { gravity: Vec3::ZERO, damping: 60.0, ..Settings::default() };
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 9,
        rows: 7,
        pin_mode: PinMode::None,
        material: Material { drag: 0.0, ..Material::default() },
        settings: still,
        ..GridDesc::default()
    })?;
    for particle in 0..63 {
        cloth.set_velocity(particle, Vec3::Z * 0.5)?;
    }
    let mut subnormal = 0;
    for _ in 0..120 {
        trace.step(&mut cloth, 1);
        let speed = cloth.velocity(31).map_or(0.0, |v| v.z);
        subnormal += u32::from(speed.is_subnormal());
    }
    trace.record_outputs(&mut cloth);
    assert!(subnormal > 0, "the velocity must pass through the subnormal range");
    Ok(())
}
