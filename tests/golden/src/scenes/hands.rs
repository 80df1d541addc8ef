//! Cloths that are held, moved and pointed at.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, GridDesc, Material, Preset, Result, Settings};

/// Many pins walk away with a cloth, some let go, the rest stretch it past its bound.
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
    let held: Vec<u32> = (0..rows).flat_map(|row| [row * columns, row * columns + 6]).collect();
    let place = |particle: u32| {
        let (row, column) = (particle / columns, particle % columns);
        Vec3::new(column as f32, -(row as f32), 0.0) * 0.125
    };
    for i in 1..=20 {
        let step = Vec3::new(0.015625, 0.0, 0.03125);
        let targets: Vec<_> = held.iter().map(|p| along(place(*p), step, i)).collect();
        cloth.set_pin_targets(&held, &targets)?;
        trace.run(&mut cloth, 1);
    }
    for particle in held.iter().filter(|p| **p % columns == 6 && **p > columns) {
        cloth.unpin(*particle)?;
    }
    trace.run(&mut cloth, 20);
    cloth.pin(40, None)?;
    cloth.pin(6, Some(Vec3::new(2.5, 0.0, 0.625)))?;
    trace.run(&mut cloth, 20);
    cloth.unpin_all();
    cloth.set_position(3, Vec3::new(1.5, 0.25, 2.0))?;
    trace.run(&mut cloth, 20);
    trace.look(&mut cloth);
    assert!(trace.count_of(EventKind::HeldApart) >= 1, "the pins did not pull");
    Ok(())
}

/// Rays sweep over a cloth, and pointers take hold of what they point at, at the edge too.
pub fn rays_and_grabs(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&GridDesc { columns: 26, rows: 15, ..GridDesc::default() })?;
    trace.run(&mut cloth, 10);
    let (eye, ahead) = (Vec3::new(0.625, -0.5, 4.0), Vec3::new(0.0, 0.0, -3.0));
    let first = cloth.grab_ray(eye, ahead, 0.125)?;
    let (first, _) = first.expect("the ray points at the middle of the cloth");
    // Past the lower right corner: only the radius reaches it.
    let second = cloth.grab_ray(Vec3::new(1.28125, -0.734375, 4.0), ahead, 0.125)?;
    let (second, at) = second.expect("the corner is within the radius");
    trace.floats(&at.to_array());
    let mut hits = 0;
    for i in 1..=80 {
        cloth.move_grab(first, along(Vec3::new(0.625, -0.5, 0.0), Vec3::Z * 0.015625, i))?;
        cloth.move_grab(second, along(Vec3::new(1.25, -0.75, 0.0), Vec3::X * -0.0078125, i))?;
        trace.run(&mut cloth, 1);
        let direction = along(Vec3::new(-0.25, 0.125, -1.0), Vec3::new(0.0078125, 0.0, 0.0), i);
        let hit = cloth.raycast(eye, direction, 100.0)?;
        hits += u32::from(hit.is_some());
        trace.hit(hit);
        trace.hit(cloth.raycast(eye, direction, 3.0)?);
    }
    assert!(hits >= 30, "only {hits} rays hit the cloth");
    cloth.release(second)?;
    trace.run(&mut cloth, 20);
    cloth.release(first)?;
    trace.run(&mut cloth, 40);
    trace.look(&mut cloth);
    Ok(())
}
