//! Scenes with particle collision.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Result, SelfCollision, Settings};

/// A sheet falls on its lower edge and crumples, is cut and torn, and is lifted by a corner with a
/// larger collision distance. The restored cloth falls again, at last without self-collision.
pub fn crumpled_by_particles(trace: &mut Trace) -> Result<()> {
    let (columns, rows) = (19, 23);
    let colliding = Settings { self_collision: SelfCollision::Particles, ..Settings::default() };
    let mut cloth = Cloth::grid(&GridDesc {
        columns,
        rows,
        spacing: 0.0625,
        pin_mode: PinMode::None,
        settings: colliding.clone(),
        ..GridDesc::default()
    })?;
    cloth.add_collider(&ColliderDesc { position: Vec3::Y * -1.5, ..ColliderDesc::default() })?;
    for particle in (0..columns * rows).step_by(7) {
        let velocity = along(Vec3::Z * -0.125, Vec3::Z * 0.0625, particle % 5);
        cloth.set_velocity(particle, velocity)?;
    }
    trace.step(&mut cloth, 15);
    let from = Vec3::new(0.25, -0.75, -1.0);
    cloth.cut(from, from + Vec3::X * 0.375, Vec3::Z * 2.0)?;
    trace.step(&mut cloth, 45);
    let low = cloth.positions().iter().filter(|x| x.y < -1.0).count();
    assert!(low > 300, "only {low} particles lie low");
    cloth.tear_edge(200, 201)?;
    let grab = cloth.grab_particle(0)?;
    cloth.set_settings(Settings { self_distance: 0.0625, ..colliding.clone() })?;
    for i in 1..=20 {
        cloth.move_grab(grab, along(Vec3::Y * -1.25, Vec3::Y * 0.03125, i))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    let mut copy = Cloth::restore(&cloth.save())?;
    trace.step(&mut copy, 40);
    trace.record_outputs(&mut copy);
    copy.set_settings(Settings::default())?;
    trace.step(&mut copy, 20);
    trace.record_outputs(&mut copy);
    Ok(())
}
