//! Scenes with pins, grabs and rays.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, GridDesc, Material, Preset, Result, Settings};

/// Many pins move a cloth, some are removed, and the rest stretch it past its strain limit.
pub fn procession_of_pins(trace: &mut Trace) -> Result<()> {
    let (columns, rows) = (7, 12);
    let mut cloth = Cloth::grid(&GridDesc {
        columns,
        rows,
        spacing: 0.125,
        material: Material::preset(Preset::Silk),
        settings: Settings { max_stretch: 0.05, ..Settings::default() },
        ..GridDesc::default()
    })?;
    let pinned: Vec<u32> = (0..rows).flat_map(|row| [row * columns, row * columns + 6]).collect();
    let rest_position = |particle: u32| {
        let (row, column) = (particle / columns, particle % columns);
        Vec3::new(column as f32, -(row as f32), 0.0) * 0.125
    };
    for i in 1..=20 {
        let step = Vec3::new(0.015625, 0.0, 0.03125);
        let targets: Vec<_> = pinned.iter().map(|p| along(rest_position(*p), step, i)).collect();
        cloth.set_pin_targets(&pinned, &targets)?;
        trace.step(&mut cloth, 1);
    }
    for particle in pinned.iter().filter(|p| **p % columns == 6 && **p > columns) {
        cloth.unpin(*particle)?;
    }
    trace.step(&mut cloth, 20);
    cloth.pin(40, None)?;
    cloth.pin(6, Some(Vec3::new(2.5, 0.0, 0.625)))?;
    trace.step(&mut cloth, 20);
    cloth.unpin_all();
    cloth.set_position(3, Vec3::new(1.5, 0.25, 2.0))?;
    trace.step(&mut cloth, 20);
    trace.record_outputs(&mut cloth);
    assert!(trace.count_of(EventKind::HeldApart) >= 1, "the pins did not pull");
    Ok(())
}

/// Rays sweep over a cloth; two grabs start from rays, one of them beside the edge of the cloth.
pub fn rays_and_grabs(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc { columns: 26, rows: 15, ..GridDesc::default() })?;
    trace.step(&mut cloth, 10);
    let (eye, ahead) = (Vec3::new(0.625, -0.5, 4.0), Vec3::new(0.0, 0.0, -3.0));
    let first = cloth.grab_ray(eye, ahead, 0.125)?;
    let (first, _) = first.expect("the ray points at the middle of the cloth");
    // Beside the lower right corner: the corner is only within the radius.
    let second = cloth.grab_ray(Vec3::new(1.28125, -0.734375, 4.0), ahead, 0.125)?;
    let (second, at) = second.expect("the corner is within the radius");
    trace.record_floats(&at.to_array());
    let mut hits = 0;
    for i in 1..=80 {
        cloth.move_grab(first, along(Vec3::new(0.625, -0.5, 0.0), Vec3::Z * 0.015625, i))?;
        cloth.move_grab(second, along(Vec3::new(1.25, -0.75, 0.0), Vec3::X * -0.0078125, i))?;
        trace.step(&mut cloth, 1);
        let direction = along(Vec3::new(-0.25, 0.125, -1.0), Vec3::new(0.0078125, 0.0, 0.0), i);
        let hit = cloth.raycast(eye, direction, 100.0)?;
        hits += u32::from(hit.is_some());
        trace.record_hit(hit);
        trace.record_hit(cloth.raycast(eye, direction, 3.0)?);
    }
    assert!(hits >= 30, "only {hits} rays hit the cloth");
    cloth.release(second)?;
    trace.step(&mut cloth, 20);
    cloth.release(first)?;
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    Ok(())
}
