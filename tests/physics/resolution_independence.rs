//! Results depend on the size and the material of a cloth, not on its resolution or step size:
//! cases I and M7 of the validation list.

use crate::common::bare_grid;
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, PinMode};

/// Tick rates [Hz].
const RATES: [u32; 4] = [30, 60, 120, 240];

/// Particles along the side of a sheet.
const SIDES: [u32; 4] = [24, 40, 56, 96];

/// Sample points along a side at which shapes are compared.
const SAMPLES: usize = 24;

/// A square sheet of 1 m with `side` particles along each side.
fn sheet(side: u32, pin_mode: PinMode) -> GridDesc {
    let mut desc = bare_grid(side, side, 1.0 / (side - 1) as f32, pin_mode);
    desc.settings.damping = 2.0;
    desc
}

/// The sheet at rest. A small start velocity keeps it from staying in the balance of its plane.
fn settled_cloth(desc: &GridDesc) -> Cloth {
    let mut cloth = Cloth::grid(desc).unwrap();
    for i in 0..cloth.positions().len() as u32 {
        let x = cloth.positions()[i as usize];
        cloth.set_velocity(i, Vec3::Z * 0.3 * (3.0 * x.x).sin() * x.y).unwrap();
    }
    cloth.step((10.0 / desc.settings.tick) as u32);
    cloth
}

/// Positions at the same sample points of the sheet at any resolution.
fn sample_positions(cloth: &Cloth, side: u32) -> Vec<Vec3> {
    let x = cloth.positions();
    let at = |k: usize| k as f32 * (side - 1) as f32 / (SAMPLES - 1) as f32;
    let mut found = Vec::new();
    for row in (0..SAMPLES).map(at) {
        for column in (0..SAMPLES).map(at) {
            let (r, c) =
                (row.min((side - 2) as f32).floor(), column.min((side - 2) as f32).floor());
            let of = |dr: u32, dc: u32| x[((r as u32 + dr) * side + c as u32 + dc) as usize];
            let (v, u) = (row - r, column - c);
            found.push(of(0, 0).lerp(of(0, 1), u).lerp(of(1, 0).lerp(of(1, 1), u), v));
        }
    }
    found
}

/// Root mean square distance of two shapes [m].
fn rms_distance(a: &[Vec3], b: &[Vec3]) -> f32 {
    let sum: f32 = a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).sum();
    (sum / a.len() as f32).sqrt()
}

/// Checks that the settled sheet is less than `most` [m] off the reference shape, which has 40 × 40
/// particles, 60 ticks per second, and 4 substeps of 2 iterations.
fn assert_same_shape(row: &str, desc: &GridDesc, reference: &[Vec3], most: f32) {
    let cloth = settled_cloth(desc);
    let off = rms_distance(&sample_positions(&cloth, desc.columns), reference);
    println!("{row}, {:?}: off by {off:.5} m, reference 0", desc.pin_mode);
    assert!(off < most, "{off} m off: {desc:?}");
}

#[test]
fn the_settled_shape_does_not_depend_on_resolution_tick_or_sweeps() {
    for pin_mode in [PinMode::TopEdge, PinMode::TopCorners] {
        let reference = sample_positions(&settled_cloth(&sheet(40, pin_mode)), 40);
        for side in SIDES.into_iter().filter(|side| *side != 40) {
            assert_same_shape(
                &format!("I1 {side} nodes"),
                &sheet(side, pin_mode),
                &reference,
                0.01,
            );
        }
        for rate in RATES.into_iter().filter(|rate| *rate != 60) {
            let mut desc = sheet(40, pin_mode);
            desc.settings.tick = 1.0 / rate as f32;
            assert_same_shape(&format!("I2 {rate} Hz"), &desc, &reference, 0.01);
        }
        for (substeps, iterations) in [(2, 2), (8, 2), (4, 1), (4, 4), (8, 6)] {
            let mut desc = sheet(40, pin_mode);
            (desc.settings.substeps, desc.settings.iterations) = (substeps, iterations);
            let row = format!("I3 {substeps} substeps of {iterations} iterations");
            assert_same_shape(&row, &desc, &reference, 0.01);
        }
    }
}

/// The first mode of a hanging strip of length 1 m, `s` up from its lower end: J0(2.4048 √s).
fn first_mode(s: f32) -> f32 {
    let q = (2.4048 * s.max(0.0).sqrt() / 2.0).powi(2);
    1.0 - q + q * q / 4.0 - q.powi(3) / 36.0 + q.powi(4) / 576.0
}

/// The period of a limp strip of `rows` rows whose tip swings by 3° to either side [s].
fn swing_period(rows: u32, rate: u32) -> f32 {
    let mut desc = bare_grid(3, rows, 1.0 / (rows - 1) as f32, PinMode::TopEdge);
    desc.settings.tick = 1.0 / rate as f32;
    desc.material.bend_stiffness = 0.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    for i in 3..3 * rows {
        let s = 1.0 + cloth.positions()[i as usize].y;
        cloth.set_velocity(i, Vec3::Z * 0.2 * first_mode(s)).unwrap();
    }
    let tip = 3 * (rows as usize - 1);
    let (mut last, mut passages, mut tick) = (0.0, Vec::new(), 0);
    while passages.len() < 5 && tick < 20 * rate {
        cloth.step(1);
        tick += 1;
        let z = cloth.positions()[tip].z;
        if (z < 0.0) != (last < 0.0) {
            passages.push((tick as f32 - z / (z - last)) / rate as f32);
        }
        last = z;
    }
    (passages[4] - passages[0]) / 2.0
}

#[test]
fn a_hanging_strip_swings_at_the_exact_period_of_its_first_mode() {
    let exact = 5.2255 / 9.81_f32.sqrt();
    for rows in SIDES {
        for rate in RATES {
            let off = swing_period(rows, rate) / exact - 1.0;
            assert!(off.abs() < 0.003, "{rows} rows at {rate} Hz: off by {off}");
        }
    }
}

#[test]
fn without_tethers_more_sweeps_make_the_cloth_stiffer() {
    let stretch = |substeps: u32, iterations: u32| {
        let mut desc = sheet(40, PinMode::TopEdge);
        (desc.settings.substeps, desc.settings.iterations) = (substeps, iterations);
        desc.settings.tethers = false;
        settled_cloth(&desc).stats().max_stretch
    };
    let by_iterations = [1, 2, 4, 8, 12].map(|iterations| stretch(1, iterations));
    assert!(by_iterations.is_sorted_by(|a, b| *a > 1.2 * *b), "{by_iterations:?}");
    let by_substeps = [1, 2, 4, 8].map(|substeps| stretch(substeps, 2));
    assert!(by_substeps.is_sorted_by(|a, b| *a > 1.5 * *b), "{by_substeps:?}");
}
