//! Scenes with irregular meshes.

use super::along;
use crate::Trace;
use muslin::glam::{Vec2, Vec3};
use muslin::{Cloth, EventKind, Material, MeshDesc, Preset, Result, Settings, Wind};

/// An irregular sheet of `columns` × `rows` vertices: random offsets, diagonals in both directions,
/// a third of the triangles wound the other way, and a hole with four vertices without triangles.
pub(super) fn irregular_mesh(columns: u32, rows: u32) -> MeshDesc {
    let mut random = 0x2545_f491_u32;
    // Xorshift (Marsaglia, 2003): integers, so the same on any host.
    let mut next = move |below: u32| {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        random % below
    };
    let mut desc = MeshDesc::default();
    for row in 0..rows {
        for column in 0..columns {
            let [x, y, z] = [(64, column), (64, row), (16, 0)]
                .map(|(below, at)| (128 * at + next(below)) as f32 / 2048.0);
            desc.positions.push(Vec3::new(x, -y, z));
            desc.uvs.push(Vec2::new(column as f32 / 16.0, row as f32 / 16.0));
        }
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = row * columns + column;
            let (b, c, d) = (a + 1, a + columns, a + columns + 1);
            let halves = if next(2) == 0 { [[a, c, b], [b, c, d]] } else { [[a, c, d], [a, d, b]] };
            let is_hole = (5..8).contains(&row) && (6..9).contains(&column);
            for [p, q, r] in halves {
                let is_flipped = next(3) == 0;
                if !is_hole {
                    desc.indices.extend(if is_flipped { [q, p, r] } else { [p, q, r] });
                }
            }
        }
    }
    desc.pinned = (0..columns).step_by(3).collect();
    desc
}

/// An irregular mesh hangs in the wind until a grab tears it.
pub fn patch_torn_by_a_grab(trace: &mut Trace) -> Result<()> {
    let mut desc = irregular_mesh(16, 15);
    desc.settings.tearing = true;
    desc.material = Material {
        tear_stretch: 1.25,
        tear_variation: 0.5,
        lift: 0.25,
        ..Material::preset(Preset::FlagNylon)
    };
    let mut cloth = Cloth::mesh(&desc)?;
    let velocity = Vec3::new(1.0, 0.0, 5.0);
    cloth.set_wind(Wind { velocity, gust: 0.5, turbulence: 0.5, ..Wind::default() })?;
    trace.step(&mut cloth, 40);
    let grab = cloth.grab_particle(10 * 16 + 11)?;
    for i in 1..=60 {
        let start = Vec3::new(0.75, -0.75, 0.25);
        cloth.move_grab(grab, along(start, Vec3::new(0.015625, -0.03125, 0.03125), i))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    let torn = trace.count_of(EventKind::EdgeTorn);
    assert!(torn >= 5, "the grab tore only {torn} edges");
    Ok(())
}

/// A square tube that is pinned at one end and swings, then falls.
pub fn tube_of_leather(trace: &mut Trace) -> Result<()> {
    let (around, rings) = (20, 13);
    let mut desc = MeshDesc {
        material: Material::preset(Preset::Leather),
        settings: Settings { max_stretch: 0.03, substeps: 3, ..Settings::default() },
        ..MeshDesc::default()
    };
    for ring in 0..rings {
        for i in 0..around {
            let (side, at) = (i / 5, i % 5);
            let (x, z) = match side {
                0 => (at, 0),
                1 => (5, at),
                2 => (5 - at, 5),
                _ => (0, 5 - at),
            };
            desc.positions.push(Vec3::new(x as f32, -(ring as f32), z as f32) * 0.0625);
        }
    }
    for ring in 0..rings - 1 {
        for i in 0..around {
            let (a, b) = (ring * around + i, ring * around + (i + 1) % around);
            desc.indices.extend([a, a + around, b, b, a + around, b + around]);
        }
    }
    desc.pinned = (0..around).collect();
    let mut cloth = Cloth::mesh(&desc)?;
    for i in 0..10 {
        cloth.set_velocity((rings - 1) * around + i, Vec3::new(3.0, 0.0, 1.5))?;
    }
    trace.step(&mut cloth, 100);
    cloth.unpin_all();
    trace.step(&mut cloth, 50);
    trace.record_outputs(&mut cloth);
    Ok(())
}
