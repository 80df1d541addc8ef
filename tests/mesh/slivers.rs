//! Meshes with near-slivers and very short edges, as exporters of garments write them: they hang
//! and fall like any other mesh.

use crate::common::rms_speed;
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, Material, MeshDesc, Preset, Shape};

/// Cells along each side, and size of a cell [m].
const CELLS: u32 = 24;
pub(crate) const CELL: f32 = 0.0072;
/// Distance of an added vertex from a corner or an edge of its triangle [m].
const NEAR: f32 = 9.0e-5;

/// A standing square of cotton in which every eleventh triangle has a vertex next to a corner, and
/// every eleventh one next to the middle of an edge.
pub(crate) fn slivered_sheet() -> MeshDesc {
    let mut desc = MeshDesc { material: Material::preset(Preset::Cotton), ..MeshDesc::default() };
    for row in 0..=CELLS {
        for column in 0..=CELLS {
            // Shifted, so that the mesh is no grid.
            let shift = 0.2 * ((row * 7 + column * 3) % 5) as f32;
            let at = Vec3::new(column as f32 + shift, -(row as f32) - 0.3 * shift, 0.0);
            desc.positions.push(at * CELL);
        }
    }
    desc.pinned = (0..=CELLS).collect();
    for row in 0..CELLS {
        for column in 0..CELLS {
            let a = row * (CELLS + 1) + column;
            let [b, c, d] = [a + 1, a + CELLS + 1, a + CELLS + 2];
            for corners in [[a, c, b], [b, c, d]] {
                push_triangle(&mut desc, corners);
            }
        }
    }
    desc
}

/// Adds a triangle, or three around a vertex that is near its corner or edge.
fn push_triangle(desc: &mut MeshDesc, [a, b, c]: [u32; 3]) {
    let [x, y, z] = [a, b, c].map(|vertex| desc.positions[vertex as usize]);
    let added = match desc.indices.len() / 3 % 11 {
        3 => x + ((y + z) * 0.5 - x).normalize() * NEAR,
        7 => (x + y) * 0.5 + (z - (x + y) * 0.5).normalize() * NEAR,
        _ => return desc.indices.extend([a, b, c]),
    };
    let d = desc.positions.len() as u32;
    desc.positions.push(added);
    desc.indices.extend([a, b, d, b, c, d, c, a, d]);
}

#[test]
fn a_sheet_with_slivers_hangs_still() {
    for preset in [Preset::Silk, Preset::Cotton, Preset::Denim, Preset::Leather] {
        let mut desc = slivered_sheet();
        desc.material = Material::preset(preset);
        let mut cloth = Cloth::mesh(&desc).unwrap();
        assert!(!cloth.mesh_report().is_grid);
        let start = cloth.positions().to_vec();
        cloth.step(720);
        let speed = rms_speed(&cloth);
        let moved = cloth.positions().iter().zip(&start).map(|(x, from)| x.distance(*from));
        let moved = moved.fold(0.0, f32::max);
        println!("{preset:?}: {speed:.6} m/s, moved by {moved:.5} m at most");
        assert!(speed < 0.01, "{preset:?} moves at {speed} m/s after twelve seconds");
        assert!(moved < 0.06 * CELLS as f32 * CELL, "{preset:?} moved by {moved} m");
    }
}

/// Drops a hung sheet on a floor for three seconds, and returns it and its highest speed [m/s]. It
/// falls through 0.35 m: 2.6 m/s.
pub fn drop_on_floor(mut desc: MeshDesc) -> (Cloth, f32) {
    desc.pinned.clear();
    desc.positions.iter_mut().for_each(|x| *x = Vec3::new(x.x, 0.3 - 0.2 * x.y, x.y));
    let mut cloth = Cloth::mesh(&desc).unwrap();
    let plane = ColliderDesc { shape: Shape::Plane, ..ColliderDesc::default() };
    cloth.add_collider(&plane).unwrap();
    let mut fastest = 0.0_f32;
    for _ in 0..180 {
        cloth.step(1);
        fastest = fastest.max(cloth.stats().max_speed);
    }
    (cloth, fastest)
}

#[test]
fn a_sheet_with_slivers_falls_on_a_floor_without_bursting() {
    let (cloth, fastest) = drop_on_floor(slivered_sheet());
    println!("fastest {fastest} m/s, at the end {} m/s", rms_speed(&cloth));
    assert!(fastest < 5.0, "a particle moved at {fastest} m/s");
    assert!(rms_speed(&cloth) < 0.02, "{} m/s after three seconds", rms_speed(&cloth));
    let highest = cloth.positions().iter().map(|x| x.y).fold(0.0, f32::max);
    assert!(highest < 0.1, "a particle is at {highest} m");
}

#[test]
fn a_moving_mesh_continues_from_a_save_with_the_same_bits() {
    let mut cloth = Cloth::mesh(&slivered_sheet()).unwrap();
    cloth.step(20);
    let mut restored = Cloth::restore(&cloth.save()).unwrap();
    assert_eq!(restored.state_hash(), cloth.state_hash());
    for tick in 0..20 {
        [&mut cloth, &mut restored].into_iter().for_each(|cloth| {
            cloth.step(1);
        });
        assert_eq!(restored.state_hash(), cloth.state_hash(), "{tick} ticks later");
    }
}
