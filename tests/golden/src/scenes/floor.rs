//! Scenes with moving planes.

use super::along;
use crate::Trace;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, ColliderDesc, GridDesc, Material, PinMode, Result};

/// A horizontal sheet falls on a plane with restitution that tilts, rises and is removed above
/// another plane.
pub fn dropped_on_a_tilting_floor(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc {
        columns: 21,
        rows: 17,
        spacing: 0.0625,
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material: Material { friction: 0.25, restitution: 0.5, ..Material::default() },
        ..GridDesc::default()
    })?;
    for particle in 0..21 {
        cloth.set_velocity(particle, Vec3::new(1.0, 0.5, -0.5))?;
    }
    let low = ColliderDesc { position: Vec3::Y * -1.5, friction: 1.0, ..ColliderDesc::default() };
    cloth.add_collider(&low)?;
    let start = Vec3::Y * -0.5;
    let tray = cloth.add_collider(&ColliderDesc {
        position: start,
        rotation: Quat::from_xyzw(0.0, 0.28, 0.0, 0.96),
        restitution: 0.25,
        tangential_restitution: 0.875,
        ..ColliderDesc::default()
    })?;
    trace.step(&mut cloth, 60);
    for i in 1..=80 {
        // Nearly of unit length; the cloth normalises it.
        let tilt = Quat::from_xyzw(i as f32 * 0.0009765625, 0.0, i as f32 * -0.00048828125, 1.0);
        cloth.move_collider(tray, along(start, Vec3::new(0.0078125, 0.00390625, 0.0), i), tilt)?;
        trace.step(&mut cloth, 1);
    }
    let on_tray = cloth.positions().iter().filter(|x| x.y > -1.0).count();
    assert!(on_tray > 100, "only {on_tray} particles are still on the tray");
    cloth.remove_collider(tray)?;
    trace.step(&mut cloth, 80);
    trace.record_outputs(&mut cloth);
    Ok(())
}
