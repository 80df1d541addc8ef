//! A scene with a garment as an artist exports it.

use super::along;
use crate::Trace;
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, EventKind, Material, MeshDesc, Preset, Result};

/// A vest: front and back are separate in the texture and are welded along both sides. The mesh has
/// duplicate triangles, triangles that face inwards, a third triangle on an edge, and a vertex
/// without triangles.
fn vest() -> MeshDesc {
    let mut desc = MeshDesc { weld_distance: 1.0 / 1024.0, ..MeshDesc::default() };
    let (columns, rows) = (13, 16);
    for side in [1.0, -1.0] {
        let first = desc.positions.len() as u32;
        for row in 0..rows {
            for column in 0..columns {
                let at_side = column == 0 || column == columns - 1;
                let depth = if at_side { 1.0 / 4096.0 } else { 1.0 / 16.0 };
                let (x, y) = (column as f32 / 16.0, row as f32 / 16.0);
                desc.positions.push(Vec3::new(x, -y, side * depth));
                desc.uvs.push(Vec2::new(x + 1.0 - side, y));
            }
        }
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let a = first + row * columns + column;
                let (b, c, d) = (a + 1, a + columns, a + columns + 1);
                // Front and back have the same winding, so that the back faces inwards.
                desc.indices.extend([a, c, d, a, d, b]);
            }
        }
    }
    desc.indices.extend_from_within(60..66);
    desc.indices.extend([100, 101, 416, 5, 5, 6]);
    desc.positions.extend([Vec3::new(0.59375, -0.5, 0.25), Vec3::ONE]);
    desc.uvs.extend([Vec2::ZERO; 2]);
    desc.pinned = vec![1, 3, 9, 11, 209, 219];
    desc
}

/// A grab pulls the vest at a side seam until it tears; then a cut crosses it.
pub fn vest_ripped_at_a_seam(trace: &mut Trace) -> Result<()> {
    let mut desc = vest();
    desc.settings.tearing = true;
    desc.material =
        Material { tear_stretch: 1.25, tear_variation: 0.5, ..Material::preset(Preset::Cotton) };
    let mut cloth = Cloth::mesh(&desc)?;
    let report = *cloth.mesh_report();
    assert_eq!((report.welded_vertices, report.split_edges, report.pieces), (32, 1, 2));
    assert_eq!(report.turned_triangles, 360, "{report:?}");
    trace.step(&mut cloth, 40);
    let seam = cloth.vertex_particles()[8 * 13 + 12];
    let grab = cloth.grab_particle(seam)?;
    for i in 1..=60 {
        let start = Vec3::new(0.75, -0.5, 0.0);
        cloth.move_grab(grab, along(start, Vec3::new(0.03125, 0.0, 0.015625), i))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    let (from, to) = (Vec3::new(-1.0, -0.28125, -4.0), Vec3::new(2.0, -0.34375, -4.0));
    trace.record_word(u64::from(cloth.cut(from, to, Vec3::Z * 8.0)?));
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    cloth.vertex_particles().iter().for_each(|particle| trace.record_word(u64::from(*particle)));
    let torn = trace.count_of(EventKind::EdgeTorn);
    assert!(torn >= 5, "the grab and the blade opened only {torn} edges");
    let mut restored = Cloth::restore(&cloth.save())?;
    trace.step(&mut restored, 20);
    trace.record_outputs(&mut restored);
    Ok(())
}
