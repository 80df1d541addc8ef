//! Material parameters compared with closed forms: cases S, A4 and B4 of the validation list,
//! damping, and changes of the material during motion.

use crate::common::{bare_grid, elastica, rms_speed};
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, Material, MeshDesc, PinMode, Settings, Wind};

const G: f32 = 9.81;

/// Steps until the RMS speed has been at most 1 mm/s for 60 ticks, or `most_ticks` ticks have run.
fn step_until_rest(cloth: &mut Cloth, most_ticks: u32) {
    let (mut ticks, mut calm_ticks) = (0, 0);
    while calm_ticks < 60 && ticks < most_ticks {
        cloth.step(1);
        ticks += 1;
        calm_ticks = if rms_speed(cloth) > 1.0e-3 { 0 } else { calm_ticks + 1 };
    }
}

#[test]
fn a_soft_hanging_strip_stretches_by_its_weight_over_its_stiffness() {
    for rows in [24_u32, 40, 56] {
        let (length, stiffness) = (1.0, 60.0);
        let mut desc = bare_grid(4, rows, length / (rows - 1) as f32, PinMode::TopEdge);
        desc.settings.damping = 4.0;
        desc.material.stretch_stiffness_warp = stiffness;
        desc.material.stretch_stiffness_weft = stiffness;
        // Nearly no shear stiffness: only links parallel or perpendicular to the load take part.
        desc.material.shear_stiffness = 0.01;
        desc.material.bend_stiffness = 0.0;
        let load = desc.material.density * G / stiffness;
        let mut cloth = Cloth::grid(&desc).unwrap();
        step_until_rest(&mut cloth, 1200);
        let at = |row: u32| -cloth.positions()[(4 * row + 1) as usize].y;
        let exact = load * length * length / 2.0;
        let found = at(rows - 1) - length;
        println!("S3 {rows} rows: stretched by {found:.5} m, reference {exact:.5} m");
        assert!((found / exact - 1.0).abs() < 0.005, "S3 {rows} rows: {found} m, exact {exact} m");
        for row in 0..rows {
            let s = length * row as f32 / (rows - 1) as f32;
            let exact_stretch = load * (length * s - s * s / 2.0);
            assert!(
                (at(row) - s - exact_stretch).abs() < 0.005 * exact,
                "S3 row {row} is off the parabola"
            );
        }
    }
}

#[test]
fn a_taut_strip_sags_as_its_stretch_stiffness_gives() {
    for (stiffness, sag) in
        [(10.0_f32, 0.1728), (30.0, 0.1178), (100.0, 0.0782), (300.0, 0.0540), (1000.0, 0.0361)]
    {
        let (columns, span) = (41_u32, 1.0);
        let mut desc = bare_grid(columns, 4, span / (columns - 1) as f32, PinMode::None);
        desc.down = Vec3::Z;
        desc.settings.damping = 3.0;
        desc.settings.substeps = 16;
        desc.material.stretch_stiffness_weft = stiffness * desc.material.density * G * span;
        desc.material.stretch_stiffness_warp = desc.material.stretch_stiffness_weft;
        desc.material.shear_stiffness = 0.01;
        desc.material.bend_stiffness = 0.0;
        let mut cloth = Cloth::grid(&desc).unwrap();
        for row in 0..4 {
            cloth.pin(row * columns, None).unwrap();
            cloth.pin((row + 1) * columns - 1, None).unwrap();
        }
        step_until_rest(&mut cloth, 1200);
        let found = -cloth.positions()[(columns + columns / 2) as usize].y / span;
        println!("S2 stiffness {stiffness} times its weight: sag {found:.5}, reference {sag}");
        // The softest strip is off by 2 %.
        assert!((found / sag - 1.0).abs() < 0.03, "S2 {stiffness}: sag {found}, exact {sag}");
    }
}

#[test]
fn wind_tilts_a_hanging_strip_by_the_ratio_of_drag_to_weight() {
    for (k, degrees) in [(0.1_f32, 5.68_f32), (0.5, 24.47), (1.0, 38.17), (2.0, 51.33)] {
        let mut desc = bare_grid(4, 24, 0.5 / 23.0, PinMode::TopEdge);
        // Nearly limp: without any bend stiffness the hem would flutter.
        desc.material.bend_stiffness = 1.0e-6;
        desc.material.drag = 1.0;
        desc.settings.damping = 2.0;
        let mut cloth = Cloth::grid(&desc).unwrap();
        let speed2 = k * 2.0 * desc.material.density * G / 1.2;
        cloth.set_wind(Wind { velocity: Vec3::Z * speed2.sqrt(), ..Wind::default() }).unwrap();
        step_until_rest(&mut cloth, 1800);
        // In the strongest wind the hem keeps fluttering a little, so the mean of 240 ticks is
        // measured.
        let mut sums = vec![Vec3::ZERO; 24];
        for _ in 0..240 {
            cloth.step(1);
            (0..24).for_each(|row| sums[row] += cloth.positions()[4 * row + 1] / 240.0);
        }
        let at = |row: usize| sums[row];
        let hung = at(23) - at(0);
        let found = hung.z.atan2(-hung.y).to_degrees();
        let rest = rms_speed(&cloth);
        println!("A4 K = {k}: {found:.2}°, reference {degrees}°, at {rest:.4} m/s");
        assert!((found - degrees).abs() < 1.5, "A4 K = {k}: {found}°, exact {degrees}°");
        for row in 1..23 {
            let off = (at(row) - at(0)).cross(hung.normalize()).length();
            assert!(off < 0.005, "A4 K = {k}: row {row} is {off} m off the straight line");
        }
    }
}

/// The triangulation of a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pattern {
    /// Squares along the strip with alternating diagonals.
    Alternating,
    /// Squares along the strip, all divided by the diagonal from the first corner.
    FirstDiagonal,
    /// Squares along the strip, all divided by the other diagonal.
    SecondDiagonal,
    /// Squares at 45° to the strip with all diagonals along it.
    Rotated,
    /// Squares at 45° to the strip with alternating diagonals.
    RotatedAlternating,
    Equilateral,
    /// Squares along the strip, corners displaced by up to a third of a step, with mixed diagonals.
    Uneven,
}

const PATTERNS: [Pattern; 7] = [
    Pattern::Alternating,
    Pattern::FirstDiagonal,
    Pattern::SecondDiagonal,
    Pattern::Rotated,
    Pattern::RotatedAlternating,
    Pattern::Equilateral,
    Pattern::Uneven,
];

/// Rows of particles in a strip.
const ROWS: u32 = 9;

/// Returns a strip of triangles along x, free over `length` [m] beyond its clamp, and its mean free
/// length [m].
fn strip_mesh(pattern: Pattern, cells: u32, length: f32) -> (MeshDesc, f32) {
    let step = length / cells as f32;
    let (mut positions, mut pinned) = (Vec::new(), Vec::new());
    let count = cells + 2;
    let height = step
        * match pattern {
            Pattern::Rotated | Pattern::RotatedAlternating => 0.5,
            Pattern::Equilateral => 0.75_f32.sqrt(),
            _ => 1.0,
        };
    // The other patterns shift every second row by half a step.
    let is_square = matches!(
        pattern,
        Pattern::Alternating | Pattern::FirstDiagonal | Pattern::SecondDiagonal | Pattern::Uneven
    );
    for row in 0..ROWS {
        for k in 0..count {
            let shift = if is_square || row % 2 == 0 { 0.0 } else { 0.5 };
            let mut at = Vec3::new((k as f32 - 1.0 + shift) * step, 0.0, row as f32 * height);
            if k < 2 {
                pinned.push(positions.len() as u32);
            } else if pattern == Pattern::Uneven && k + 1 < count && row > 0 && row + 1 < ROWS {
                let off = (row * count + k) as f32;
                at += Vec3::new((off * 12.99).sin(), 0.0, (off * 78.23).sin()) * (0.25 * step);
            }
            positions.push(at);
        }
    }
    let uvs: Vec<Vec2> = positions.iter().map(|x| Vec2::new(x.x, x.z)).collect();
    // Every second row starts half a step later, so the mean length is a quarter step shorter.
    let mean_length = if is_square { length } else { length - 0.25 * step };
    let material = Material { drag: 0.0, density: 0.15, ..Material::default() };
    // 16 substeps let the links converge under the load; with the default 4, strips of the finer
    // mesh bend more.
    let settings = Settings { damping: 4.0, substeps: 16, ..Settings::default() };
    let indices = strip_triangles(pattern, count);
    (
        MeshDesc { positions, indices, uvs, pinned, material, settings, ..MeshDesc::default() },
        mean_length,
    )
}

fn strip_triangles(pattern: Pattern, count: u32) -> Vec<u32> {
    let mut indices = Vec::new();
    let at = |row: u32, k: u32| row * count + k;
    for row in 0..ROWS {
        for k in 0..count - 1 {
            let (a, b) = (at(row, k), at(row, k + 1));
            if pattern == Pattern::RotatedAlternating {
                // The square whose diagonal is the edge from a to b.
                let above = (row + 1 < ROWS).then(|| at(row + 1, k + row % 2));
                let below = (row > 0).then(|| at(row - 1, k + row % 2));
                match (above, below) {
                    (Some(above), Some(below)) if row % 2 == 1 => {
                        indices.extend([a, above, below, below, above, b]);
                    }
                    _ => {
                        above.into_iter().for_each(|above| indices.extend([a, above, b]));
                        below.into_iter().for_each(|below| indices.extend([a, b, below]));
                    }
                }
            } else if row + 1 < ROWS {
                let (c, d) = (a + count, b + count);
                let is_first = match pattern {
                    Pattern::Alternating => (row + k) % 2 == 0,
                    Pattern::FirstDiagonal => true,
                    Pattern::SecondDiagonal => false,
                    Pattern::Uneven => (7 * row + 3 * k) % 5 < 2,
                    _ => row % 2 == 1,
                };
                if is_first {
                    indices.extend([a, c, d, a, d, b]);
                } else {
                    indices.extend([a, c, b, b, c, d]);
                }
            }
        }
        if pattern == Pattern::RotatedAlternating && row > 0 && row + 1 < ROWS {
            // The triangle at the end of the row, where no square fits.
            let k = if row % 2 == 1 { 0 } else { count - 1 };
            let ends = if k == 0 { [row - 1, row, row + 1] } else { [row - 1, row + 1, row] };
            indices.extend(ends.map(|row| at(row, k)));
        }
    }
    indices
}

/// Returns the drop and the reach of a strip's tip at rest, divided by the strip's length.
fn tip_drop_and_reach(pattern: Pattern, cells: u32, gamma: f32) -> (f32, f32) {
    let (mut desc, length) = strip_mesh(pattern, cells, 0.2);
    desc.material.bend_stiffness = desc.material.density * G * length.powi(3) / gamma;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    step_until_rest(&mut cloth, 1200);
    let count = cells as usize + 2;
    let tips = (0..ROWS as usize).map(|row| cloth.positions()[row * count + count - 1]);
    let tip = tips.sum::<Vec3>() / (ROWS as f32 * length);
    (-tip.y, tip.x)
}

#[test]
fn a_strip_of_any_triangulation_droops_as_its_bend_stiffness_gives() {
    let mut misses = Vec::new();
    let mut check = |row: String, off: f32, most: f32| {
        let verdict = if off.abs() > most { "  MISSED" } else { "" };
        println!("{row}{verdict}");
        if !verdict.is_empty() {
            misses.push(row);
        }
    };
    // The bending length is measured at gamma 8, where strips hang as in a cantilever test.
    for (gamma, all_cells) in [(8.0_f32, &[16, 24][..]), (30.0, &[16])] {
        let exact = elastica::tip(f64::from(gamma)).drop as f32;
        let mut lengths = Vec::new();
        let hung = PATTERNS.map(|pattern| {
            std::thread::spawn(move || {
                all_cells
                    .iter()
                    .map(|cells| (*cells, tip_drop_and_reach(pattern, *cells, gamma)))
                    .collect::<Vec<_>>()
            })
        });
        for (pattern, hung) in PATTERNS.into_iter().zip(hung) {
            for (cells, (drop, reach)) in hung.join().unwrap() {
                let row = format!(
                    "B4 {pattern:?}, {cells} cells, gamma {gamma}, drop: {drop:.4}, reference {exact:.4}"
                );
                check(row, drop - exact, 0.04);
                let shown = elastica::gamma_of((drop / reach).into()) as f32;
                lengths.push((gamma / shown).cbrt());
            }
        }
        let least = lengths.iter().copied().fold(f32::MAX, f32::min);
        let most = lengths.iter().copied().fold(0.0, f32::max);
        if gamma == 8.0 {
            let row = format!(
                "B4 gamma {gamma}, bending length over the material's: {least:.3} to {most:.3}, reference 1"
            );
            check(row, (most - 1.0).max(1.0 - least), 0.05);
        }
    }
    assert!(misses.is_empty(), "B4 missed:\n{}", misses.join("\n"));
}

#[test]
fn bend_damping_reduces_bending_and_stretch_damping_reduces_stretching() {
    let energy = |bend_damping: f32, stretch_damping: f32, bends: bool| {
        let mut desc = bare_grid(24, 4, 0.01, PinMode::None);
        desc.down = Vec3::Z;
        desc.settings.gravity = Vec3::ZERO;
        desc.material = Material {
            bend_stiffness: 5.0e-4,
            stretch_stiffness_warp: 0.5,
            stretch_stiffness_weft: 0.5,
            bend_damping,
            stretch_damping,
            ..desc.material
        };
        let mut cloth = Cloth::grid(&desc).unwrap();
        let swing: Vec<Vec3> = (0..24 * 4)
            .map(|i| (i % 24) as f32 / 23.0 - 0.5)
            .map(|s| if bends { Vec3::Y * (s * s * 4.0) } else { Vec3::X * s })
            .collect();
        let masses = (0..24 * 4).map(|i| cloth.mass(i).unwrap());
        let weighed =
            masses.zip(&swing).fold((0.0, Vec3::ZERO), |(sum, p), (m, v)| (sum + m, p + *v * m));
        let mean = weighed.1 / weighed.0;
        for (i, v) in swing.iter().enumerate() {
            cloth.set_velocity(i as u32, (*v - mean) * 0.2).unwrap();
        }
        // It swings at about 4 Hz, so 18 ticks contain a peak of the kinetic energy.
        cloth.step(18);
        let energies = (0..18).map(|_| {
            cloth.step(1);
            cloth.stats().kinetic_energy
        });
        energies.fold(0.0, f32::max)
    };
    let (bent, braked) = (energy(0.0, 0.0, true), energy(0.05, 0.0, true));
    assert!(braked < 0.3 * bent, "bending keeps {braked} J of {bent} J");
    let (stretched, slow) = (energy(0.0, 0.0, false), energy(0.0, 0.05, false));
    assert!(slow < 0.5 * stretched, "stretch keeps {slow} J of {stretched} J");
}

#[test]
fn changing_the_bend_stiffness_of_a_hanging_cloth_causes_no_jerk() {
    let mut desc = bare_grid(20, 20, 0.02, PinMode::TopCorners);
    desc.settings.damping = 2.0;
    let mut cloth = Cloth::grid(&desc).unwrap();
    step_until_rest(&mut cloth, 1200);
    for bend_stiffness in [1.0e-6, 1.0e-3, 2.0e-2, 1.0e-5] {
        cloth.set_material(Material { bend_stiffness, ..cloth.material().clone() }).unwrap();
        let mut fastest = 0.0_f32;
        for _ in 0..60 {
            cloth.step(1);
            fastest = fastest.max(rms_speed(&cloth));
        }
        assert!(fastest < 1.0, "a change to {bend_stiffness} N·m accelerates it to {fastest} m/s");
    }
}
