//! Tests: grid kernels, mesh kernels, every SIMD level and every number of threads give the same
//! bits.

use crate::cloth::Cloth;
use crate::cloth::desc::{GridDesc, PinMode};
use crate::math::simd::Level;
use crate::model::material::{Material, Preset};
use crate::state::wind::Wind;
use glam::Vec3;

/// Simulates a grid in the wind, with a grab that tears it, a cut and a free fall. Returns the
/// state hash after every tick, a hash of the normals, and the final state hash.
fn simulate(
    material: &Material,
    columns: u32,
    rows: u32,
    prepare: impl Fn(&mut Cloth),
) -> Vec<u64> {
    let mut desc = GridDesc { columns, rows, pin_mode: PinMode::TopCorners, ..GridDesc::default() };
    desc.material = material.clone();
    desc.material.tear_stretch = 1.15;
    desc.settings.tearing = true;
    let mut cloth = Cloth::grid(&desc).unwrap();
    prepare(&mut cloth);
    let velocity = Vec3::new(0.5, 0.25, 3.0);
    let wind = Wind { velocity, turbulence: 0.5, gust: 0.5, ..Wind::default() };
    cloth.set_wind(wind).unwrap();
    let mut hashes = Vec::new();
    let particle = rows / 2 * columns + columns / 2;
    let grab = cloth.grab_particle(particle).unwrap();
    let from = cloth.positions()[particle as usize];
    for tick in 1..=40 {
        cloth.move_grab(grab, from + Vec3::new(0.02, 0.01, 0.05) * tick as f32).unwrap();
        cloth.step(1);
        if tick == 20 {
            let blade = [Vec3::new(0.21, 0.5, -9.0), Vec3::new(0.26, -9.0, -9.0)];
            assert!(
                cloth.cut(blade[0], blade[1], Vec3::Z * 18.0).unwrap() > 0,
                "the blade opened no edge"
            );
        }
        hashes.push(cloth.state_hash());
    }
    cloth.release(grab).unwrap();
    cloth.unpin_all();
    cloth.step(20);
    let normals = cloth.normals().iter().flat_map(|n| n.to_array());
    hashes.push(normals.fold(0, |hash: u64, n| hash.rotate_left(7) ^ u64::from(n.to_bits())));
    assert!(cloth.positions().len() > (columns * rows) as usize, "the grab tore no edge");
    hashes.push(cloth.state_hash());
    hashes
}

/// Compares grid and mesh kernels at every SIMD level with the scalar mesh kernels.
fn assert_equal_bits(material: &Material) {
    // Sizes with whole chunks, remainders of rows, pairs and quads over odd rows, and rows that
    // are too short for a chunk.
    for (columns, rows) in [(16, 9), (23, 18), (11, 20), (7, 12)] {
        let general = simulate(material, columns, rows, |cloth| {
            (cloth.world.constraints.rows, cloth.world.grid_cells) = (None, None);
        });
        for level in Level::available() {
            let grid = simulate(material, columns, rows, |cloth| cloth.world.level = level);
            assert_eq!(grid, general, "{columns} x {rows} at {level:?}");
            let packed = simulate(material, columns, rows, |cloth| {
                (cloth.world.constraints.rows, cloth.world.grid_cells) = (None, None);
                cloth.world.level = level;
            });
            assert_eq!(packed, general, "{columns} x {rows} as a mesh at {level:?}");
        }
    }
}

/// Compares 2, 3 and 4 threads with one thread, on grids with several bands of rows and with rows
/// that are too short for chunks.
#[cfg(feature = "parallel")]
fn assert_equal_bits_on_threads(material: &Material) {
    for (columns, rows) in [(16, 64), (23, 49), (12, 50), (13, 83), (5, 52)] {
        for is_grid in [true, false] {
            let prepare = |cloth: &mut Cloth, threads: u32| {
                if !is_grid {
                    (cloth.world.constraints.rows, cloth.world.grid_cells) = (None, None);
                }
                cloth.set_threads_eagerly(threads).unwrap();
            };
            let alone = simulate(material, columns, rows, |cloth| prepare(cloth, 1));
            for threads in [2, 3, 4] {
                let shared = simulate(material, columns, rows, |cloth| prepare(cloth, threads));
                assert_eq!(
                    shared, alone,
                    "{columns} x {rows}, {threads} threads, grid kernels: {is_grid}"
                );
            }
        }
    }
}

#[cfg(feature = "parallel")]
#[test]
fn soft_links_give_equal_bits_on_any_number_of_threads() {
    assert_equal_bits_on_threads(&Material::preset(Preset::Cotton));
}

#[cfg(feature = "parallel")]
#[test]
fn rigid_links_give_equal_bits_on_any_number_of_threads() {
    let (lift, bend_stiffness) = (0.5, 1.0);
    assert_equal_bits_on_threads(&Material { bend_stiffness, lift, ..Material::default() });
}

#[test]
fn soft_links_give_equal_bits_in_all_kernels() {
    assert_equal_bits(&Material::preset(Preset::Cotton));
}

#[test]
fn rigid_links_give_equal_bits_in_all_kernels() {
    let lift = 0.5;
    assert_equal_bits(&Material { bend_stiffness: 0.0, lift, ..Material::default() });
}

#[test]
fn rows_of_every_length_give_equal_bits_in_all_kernels() {
    let wind = Wind { velocity: Vec3::new(0.5, 0.25, 9.0), ..Wind::default() };
    for material in [Material::default(), Material::preset(Preset::Cotton)] {
        // A bend stiffness of 1 or more gives rigid links over two cells.
        let material = Material { bend_stiffness: 1.0, ..material };
        for columns in (2..=41).chain([64, 96]) {
            let mut desc = GridDesc { columns, rows: 7, ..GridDesc::default() };
            (desc.material, desc.pin_mode) = (material.clone(), PinMode::TopCorners);
            let simulate = |level: Level, is_grid: bool| {
                let mut cloth = Cloth::grid(&desc).unwrap();
                cloth.world.level = level;
                if !is_grid {
                    (cloth.world.constraints.rows, cloth.world.grid_cells) = (None, None);
                }
                cloth.set_wind(wind.clone()).unwrap();
                cloth.step(4);
                cloth.state_hash()
            };
            let general = simulate(Level::Scalar, false);
            for level in Level::available() {
                assert_eq!(simulate(level, true), general, "{columns} columns at {level:?}");
            }
        }
    }
}
