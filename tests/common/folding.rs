//! Strips that are folded by moving pins and then released, to measure plastic bending.

use super::rms_speed;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Material, PinMode, Settings};

/// Length of a strip and width of a sheet [m].
pub const STRIP_LENGTH: f32 = 0.2;

/// Half the length of the free part between the two pinned parts of a strip [m]: short enough to
/// count as one fold.
pub const ARC_HALF_LENGTH: f32 = 0.012;

/// A paper-like sheet of `nodes` by `across` particles in the x–z plane, without gravity.
pub fn paper_sheet_desc(nodes: u32, across: u32, yield_angle: f32) -> GridDesc {
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
        spacing: node_spacing(nodes),
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material,
        settings,
        ..GridDesc::default()
    }
}

/// Distance between neighbours on a strip of `nodes` particles [m].
pub fn node_spacing(nodes: u32) -> f32 {
    STRIP_LENGTH / (nodes - 1) as f32
}

/// Position of particle `i` on the flat strip.
fn flat_position(nodes: u32, i: u32) -> Vec3 {
    Vec3::new((i % nodes) as f32, 0.0, (i / nodes) as f32) * node_spacing(nodes)
}

/// Folds a strip over 240 ticks: pins every particle farther than `arc` [m] from the middle and
/// turns the two ends against each other from one angle to another [rad].
pub fn fold_strip(cloth: &mut Cloth, nodes: u32, arc: f32, [from, to]: [f32; 2]) {
    let middle = STRIP_LENGTH / 2.0;
    let count = cloth.positions().len() as u32;
    let pinned: Vec<u32> =
        (0..count).filter(|i| (flat_position(nodes, *i).x - middle).abs() > arc).collect();
    for tick in 0..=240 {
        let turned = from + (to - from) * (tick as f32 / 240.0);
        let targets: Vec<Vec3> = pinned
            .iter()
            .map(|i| {
                let at = flat_position(nodes, *i) - Vec3::X * middle;
                // The free part follows a circular arc, so its length does not change.
                let half = 0.5 * turned;
                let side = if at.x > 0.0 { 1.0 } else { -1.0 };
                let (span, lift) = if half.abs() > 1.0e-4 {
                    let radius = arc / half;
                    (radius * half.sin(), radius * (1.0 - half.cos()))
                } else {
                    (arc, 0.0)
                };
                let beyond = at.x.abs() - arc;
                let x = side * (span + beyond * half.cos());
                Vec3::new(middle + x, lift + beyond * half.sin(), at.z)
            })
            .collect();
        cloth.set_pin_targets(&pinned, &targets).unwrap();
        cloth.step(1);
    }
}

/// Ticks for which a strip at rest has been slow. A strip that opens vibrates with a period of about
/// 12 ticks, and is slow too where it turns back: there its angle is up to 0.8° from that at rest.
const TICKS_AT_REST: u32 = 30;

/// Releases all pins, steps until the strip is at rest, and returns the angle between its two ends
/// [rad]; 0 is flat.
pub fn residual_angle(cloth: &mut Cloth, nodes: u32) -> f32 {
    cloth.unpin_all();
    let (mut ticks, mut ticks_at_rest) = (0, 0);
    while ticks_at_rest < TICKS_AT_REST && ticks < 900 {
        cloth.step(1);
        ticks += 1;
        ticks_at_rest = if rms_speed(cloth) > 1.0e-3 { 0 } else { ticks_at_rest + 1 };
    }
    assert!(ticks < 900, "{nodes} nodes: the strip does not come to rest");
    let at = |column: u32| cloth.positions()[(nodes + column) as usize];
    let left = at(0) - at(3);
    let right = at(nodes - 1) - at(nodes - 4);
    core::f32::consts::PI - left.angle_between(right)
}

/// Folds a flat strip to `angle` [rad], releases it, and returns the angle that remains [rad].
pub fn residual_angle_after_fold(cloth: &mut Cloth, nodes: u32, arc: f32, angle: f32) -> f32 {
    fold_strip(cloth, nodes, arc, [0.0, angle]);
    residual_angle(cloth, nodes)
}
