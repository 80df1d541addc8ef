//! Scenes with surface collision.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, SelfCollision, Settings};

/// A sheet falls on its lower edge and crumples, is cut and torn, and is lifted by a corner. The
/// restored cloth falls again.
pub fn crumpled_in_layers(trace: &mut Trace) -> Result<()> {
    let (columns, rows) = (15, 19);
    let mut desc = GridDesc { columns, rows, spacing: 0.0625, ..GridDesc::default() };
    desc.pin_mode = PinMode::None;
    desc.settings.self_collision = SelfCollision::Surface;
    desc.material.thickness = 0.002;
    let mut cloth = Cloth::grid(&desc)?;
    cloth.add_collider(&ColliderDesc { position: Vec3::Y * -1.25, ..ColliderDesc::default() })?;
    for particle in (0..columns * rows).step_by(7) {
        let velocity = along(Vec3::Z * -0.125, Vec3::Z * 0.0625, particle % 5);
        cloth.set_velocity(particle, velocity)?;
    }
    trace.step(&mut cloth, 15);
    let from = Vec3::new(0.25, -0.75, -1.0);
    cloth.cut(from, from + Vec3::X * 0.375, Vec3::Z * 2.0)?;
    trace.step(&mut cloth, 45);
    let low = cloth.positions().iter().filter(|x| x.y < -0.75).count();
    assert!(low > 200, "only {low} particles lie low");
    cloth.tear_edge(140, 141)?;
    let grab = cloth.grab_particle(0)?;
    cloth.set_settings(Settings { self_distance: 0.0078125, ..desc.settings })?;
    for i in 1..=20 {
        cloth.move_grab(grab, along(Vec3::Y * -1.0, Vec3::Y * 0.03125, i))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    let mut copy = Cloth::restore(&cloth.save())?;
    trace.step(&mut copy, 30);
    trace.record_outputs(&mut copy);
    Ok(())
}

/// A sheet falls on its lower edge and intersects itself, is untangled, is saved meanwhile, and a
/// corner is placed elsewhere.
pub fn drawn_out_of_itself(trace: &mut Trace) -> Result<()> {
    let (columns, rows) = (13, 15);
    let mut desc = GridDesc { columns, rows, spacing: 0.0625, ..GridDesc::default() };
    desc.pin_mode = PinMode::None;
    let mut cloth = Cloth::grid(&desc)?;
    cloth.add_collider(&ColliderDesc { position: -Vec3::Y, ..ColliderDesc::default() })?;
    for particle in (0..columns * rows).step_by(7) {
        let velocity = along(Vec3::Z * -0.125, Vec3::Z * 0.0625, particle % 5);
        cloth.set_velocity(particle, velocity)?;
    }
    trace.step(&mut cloth, 45);
    desc.settings.self_collision = SelfCollision::Surface;
    cloth.set_settings(desc.settings)?;
    trace.step(&mut cloth, 4);
    let mut copy = Cloth::restore(&cloth.save())?;
    assert_eq!(copy.state_hash(), cloth.state_hash());
    trace.step(&mut copy, 30);
    for particle in [0, 1, columns, columns + 1, 2 * columns] {
        // Integer multiples of 1/1024 m, whose sums are exact in every rounding mode.
        let rounded = (copy.positions()[particle as usize] * 1024.0).round() / 1024.0;
        copy.set_position(particle, rounded + Vec3::new(0.125, -0.25, 0.0625))?;
    }
    trace.step(&mut copy, 30);
    trace.record_outputs(&mut copy);
    Ok(())
}
