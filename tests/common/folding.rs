//! Strips that hands fold and let go.

use super::strip::speed;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, PinMode, Settings};

/// How long a strip is, and a sheet wide [m].
pub const SIZE: f32 = 0.2;

/// Half of what is between the hands that fold a strip, so that it all counts as one fold [m].
pub const ARC: f32 = 0.012;

/// A sheet of something like paper in the x–z plane, in no gravity.
pub fn sheet(nodes: u32, across: u32, yield_angle: f32) -> GridDesc {
    let material = Material {
        bend_stiffness: 4.0e-4,
        density: 0.08,
        drag: 0.0,
        yield_angle,
        fold_length: 0.03,
        ..Material::default()
    };
    let settings = Settings { gravity: Vec3::ZERO, damping: 6.0, ..Settings::default() };
    GridDesc {
        columns: nodes,
        rows: across,
        spacing: spacing(nodes),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material,
        settings,
        ..GridDesc::default()
    }
}

/// Between neighbours on a strip of so many [m].
pub fn spacing(nodes: u32) -> f32 {
    SIZE / (nodes - 1) as f32
}

/// Where a particle is on the flat strip.
fn place(nodes: u32, i: u32) -> Vec3 {
    Vec3::new((i % nodes) as f32, 0.0, (i / nodes) as f32) * spacing(nodes)
}

/// Folds a strip by turning what is farther than `arc` from its middle, slowly, from one angle to another.
pub fn fold(cloth: &mut Cloth, nodes: u32, arc: f32, [from, to]: [f32; 2]) {
    let middle = SIZE / 2.0;
    let count = cloth.positions().len() as u32;
    let held: Vec<u32> = (0..count).filter(|i| (place(nodes, *i).x - middle).abs() > arc).collect();
    for tick in 0..=240 {
        let turned = from + (to - from) * (tick as f32 / 240.0);
        let targets: Vec<Vec3> = held
            .iter()
            .map(|i| {
                let at = place(nodes, *i) - Vec3::X * middle;
                // Along an arc between the hands the sheet is as long as it was.
                let half = 0.5 * turned;
                let side = if at.x > 0.0 { 1.0 } else { -1.0 };
                let (reach, lift) = if half.abs() > 1.0e-4 {
                    let radius = arc / half;
                    (radius * half.sin(), radius * (1.0 - half.cos()))
                } else {
                    (arc, 0.0)
                };
                let beyond = at.x.abs() - arc;
                let x = side * (reach + beyond * half.cos());
                Vec3::new(middle + x, lift + beyond * half.sin(), at.z)
            })
            .collect();
        cloth.set_pin_targets(&held, &targets).unwrap();
        cloth.step(1);
    }
}

/// Lets a strip go until it rests, then says by how much its ends are turned against each other.
pub fn release(cloth: &mut Cloth, nodes: u32) -> f32 {
    cloth.unpin_all();
    let mut ticks = 0;
    while ticks < 60 || (speed(cloth) > 1.0e-3 && ticks < 900) {
        cloth.step(1);
        ticks += 1;
    }
    let at = |column: u32| cloth.positions()[(nodes + column) as usize];
    let left = at(0) - at(3);
    let right = at(nodes - 1) - at(nodes - 4);
    core::f32::consts::PI - left.angle_between(right)
}

/// Folds a strip from where it lies flat, and lets go.
pub fn fold_and_release(cloth: &mut Cloth, nodes: u32, arc: f32, angle: f32) -> f32 {
    fold(cloth, nodes, arc, [0.0, angle]);
    release(cloth, nodes)
}
