//! Scenes with colliders of every shape.

use super::along;
use crate::Trace;
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, GridDesc, Material, PinMode, Result, Shape};

/// A horizontal, unpinned sheet with a corner at `origin`.
fn horizontal_sheet(columns: u32, rows: u32, origin: Vec3) -> Result<Cloth> {
    Cloth::grid(&GridDesc {
        columns,
        rows,
        spacing: 0.0625,
        origin,
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material: Material { restitution: 0.25, ..Material::default() },
        ..GridDesc::default()
    })
}

/// Records the impulse of a cloth on a collider.
fn record_impulse(trace: &mut Trace, cloth: &Cloth, collider: Collider) -> Result<()> {
    let impulse = cloth.collider_impulse(collider)?;
    trace.record_floats(&impulse.linear.to_array());
    trace.record_floats(&impulse.angular.to_array());
    Ok(())
}

/// A sheet falls on a ball that rises and turns, a tapered capsule, a tilted box and a pyramid,
/// then on a floor after these are removed.
pub fn draped_over_solids(trace: &mut Trace) -> Result<()> {
    let mut cloth = horizontal_sheet(25, 23, Vec3::new(-0.75, 0.5, -0.6875))?;
    let start = Vec3::new(-0.375, 0.0, -0.25);
    let solids = [
        ColliderDesc { shape: Shape::Sphere, radius: 0.25, position: start, ..Default::default() },
        ColliderDesc {
            shape: Shape::Capsule,
            radius: 0.125,
            top_radius: 0.03125,
            half_height: 0.25,
            position: Vec3::new(0.375, 0.0, -0.25),
            rotation: Quat::from_xyzw(0.0, 0.0, 0.6, 0.8),
            ..Default::default()
        },
        ColliderDesc {
            shape: Shape::Box,
            half_extents: Vec3::new(0.125, 0.25, 0.1875),
            position: Vec3::new(-0.375, 0.0, 0.375),
            rotation: Quat::from_xyzw(0.28, 0.0, 0.0, 0.96),
            friction: 0.75,
            ..Default::default()
        },
        ColliderDesc {
            shape: Shape::Convex,
            positions: vec![
                Vec3::Y * 0.375,
                Vec3::new(0.25, -0.125, 0.25),
                Vec3::new(-0.25, -0.125, 0.25),
                Vec3::new(-0.25, -0.125, -0.25),
                Vec3::new(0.25, -0.125, -0.25),
            ],
            position: Vec3::new(0.375, 0.0, 0.375),
            thickness: 0.0078125,
            ..Default::default()
        },
        ColliderDesc {
            position: Vec3::Y * -1.0,
            tangential_restitution: 0.75,
            ..Default::default()
        },
        ColliderDesc {
            shape: Shape::Sphere,
            radius: 0.03125,
            position: Vec3::new(0.015625, 0.125, 0.03125),
            ..Default::default()
        },
    ];
    let mut handles = Vec::new();
    for desc in &solids {
        handles.push(cloth.add_collider(desc)?);
    }
    trace.step(&mut cloth, 60);
    for i in 1..=60 {
        // Nearly of unit length; the cloth normalises it.
        let turn = Quat::from_xyzw(0.0, i as f32 * 0.0009765625, 0.0, 1.0);
        cloth.move_collider(handles[0], along(start, Vec3::Y * 0.00390625, i), turn)?;
        trace.step(&mut cloth, 1);
        record_impulse(trace, &cloth, handles[0])?;
    }
    let supported = cloth.positions().iter().filter(|x| x.y > -0.5).count();
    assert!(supported > 300, "only {supported} particles are still up");
    let mut cloth = Cloth::restore(&cloth.save())?;
    for handle in handles.iter().take(4) {
        record_impulse(trace, &cloth, *handle)?;
        cloth.remove_collider(*handle)?;
        trace.step(&mut cloth, 15);
    }
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A sheet is thrown on a heightfield, where a triangle mesh slides into it and a box rotates above
/// it.
pub fn thrown_on_hills(trace: &mut Trace) -> Result<()> {
    let mut cloth = horizontal_sheet(19, 17, Vec3::new(-0.5, 0.5, -0.5))?;
    for particle in 0..19 * 17 {
        cloth.set_velocity(particle, Vec3::new(0.5, -6.0, 0.25))?;
    }
    let heights = (0..9 * 7).map(|i| (i * 5 % 8) as f32 * 0.03125).collect();
    let (columns, rows, spacing) = (9, 7, 0.375);
    let position = Vec3::new(-1.5, -0.25, -1.125);
    let shape = Shape::Heightfield;
    cloth.add_collider(&ColliderDesc {
        shape,
        position,
        columns,
        rows,
        spacing,
        heights,
        ..Default::default()
    })?;
    let from = Vec3::new(-1.0, 0.0, 0.0);
    let wedge = cloth.add_collider(&ColliderDesc {
        shape: Shape::Mesh,
        positions: vec![
            Vec3::new(-0.25, 0.0, -0.5),
            Vec3::new(-0.25, 0.0, 0.5),
            Vec3::new(0.25, 0.0, -0.5),
            Vec3::new(0.25, 0.0, 0.5),
            Vec3::new(0.0, 0.375, -0.5),
            Vec3::new(0.0, 0.375, 0.5),
        ],
        indices: vec![0, 1, 4, 1, 5, 4, 4, 5, 2, 5, 3, 2],
        position: from,
        ..Default::default()
    })?;
    let beam = cloth.add_collider(&ColliderDesc {
        shape: Shape::Box,
        half_extents: Vec3::new(1.0, 0.03125, 0.03125),
        position: Vec3::Y * 0.75,
        ..Default::default()
    })?;
    trace.step(&mut cloth, 20);
    for i in 1..=80 {
        let at = along(from, Vec3::X * 0.015625, i);
        cloth.move_collider(wedge, at, Quat::IDENTITY)?;
        let turn = Quat::from_xyzw(0.0, i as f32 * 0.015625, 0.0, 1.0);
        let is_unit = i * i <= 9;
        let turn = if is_unit { turn } else { Quat::from_xyzw(0.0, 0.28, 0.0, 0.96) };
        cloth.move_collider(beam, along(Vec3::Y * 0.75, Vec3::Y * -0.0078125, i), turn)?;
        trace.step(&mut cloth, 1);
        record_impulse(trace, &cloth, wedge)?;
    }
    let up = cloth.positions().iter().filter(|x| x.y > -0.25).count();
    assert!(up > 200, "only {up} particles are still on the ground");
    trace.record_outputs(&mut cloth);
    Ok(())
}
