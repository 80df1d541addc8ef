//! Scenes with tears and cuts.

use super::along;
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{
    Cloth, EventKind, GridDesc, Material, MeshDesc, PinMode, Preset, Result, Settings, Wind,
};

/// A sheet that tears easily, pinned by its corners.
fn thin_sheet(columns: u32, rows: u32) -> GridDesc {
    GridDesc {
        columns,
        rows,
        spacing: 0.0625,
        pin_mode: PinMode::Corners,
        material: Material { tear_stretch: 1.25, tear_variation: 0.75, ..Material::default() },
        settings: Settings { tearing: true, max_tears_per_tick: 16, ..Settings::default() },
        ..GridDesc::default()
    }
}

/// Three grabs tear a sheet, `tear_edge` tears more edges, and the remaining pieces fall.
pub fn sheet_torn_to_pieces(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&thin_sheet(23, 18))?;
    cloth.set_wind(Wind {
        velocity: Vec3::new(0.5, 0.25, 2.0),
        turbulence: 0.5,
        ..Wind::default()
    })?;
    trace.step(&mut cloth, 20);
    let starts = [(6, 5, 0.0625), (17, 9, -0.0625), (11, 14, 0.125)];
    let mut grabs = Vec::new();
    for (column, row, pull) in starts {
        let at = Vec3::new(column as f32 * 0.0625, row as f32 * -0.0625, 0.0);
        grabs.push((cloth.grab_particle(row * 23 + column)?, at, pull));
    }
    for i in 1..=60 {
        for (grab, at, pull) in &grabs {
            cloth.move_grab(*grab, along(*at, Vec3::new(0.0, -0.0078125, *pull), i))?;
        }
        trace.step(&mut cloth, 1);
    }
    for (grab, ..) in grabs {
        cloth.release(grab)?;
    }
    for (a, b) in [(30, 53), (53, 76), (76, 99), (99, 122)] {
        trace.record_word(cloth.tear_edge(a, b).map_or(2, u64::from));
    }
    trace.step(&mut cloth, 40);
    cloth.unpin_all();
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    let pieces = cloth.stats().pieces;
    assert!(pieces >= 3, "the sheet is in {pieces} pieces");
    assert!(trace.count_of(EventKind::PieceDetached) >= 2, "too few `PieceDetached` events");
    Ok(())
}

/// Blades cut a grid and a mesh in the wind, next to pins and twice in the same place; then a grab
/// tears them further.
pub fn cut_by_blades(trace: &mut Trace) -> Result<()> {
    let mut cloth = Cloth::grid(&thin_sheet(19, 21))?;
    let mut mesh = Cloth::mesh(&uneven_mesh())?;
    for cloth in [&mut cloth, &mut mesh] {
        cloth.set_wind(Wind { velocity: Vec3::new(0.5, 0.0, 1.5), ..Wind::default() })?;
        trace.step(cloth, 25);
        let mut opened = 0;
        for (from, to) in [([0.28125, 0.5], [0.34375, -0.5]), ([-0.5, -0.40625], [0.875, -0.59375])]
        {
            let at = |[x, y]: [f32; 2]| Vec3::new(x, y, -4.0);
            for _ in 0..2 {
                opened += cloth.cut(at(from), at(to), Vec3::Z * 8.0)?;
                trace.record_word(u64::from(opened));
            }
            trace.step(cloth, 15);
        }
        assert!(opened > 20, "only {opened} edges were cut");
        let grab = cloth.grab_particle(40)?;
        for i in 1..=30 {
            let start = Vec3::new(0.25, -0.25, 0.0);
            cloth.move_grab(grab, along(start, Vec3::new(0.0, -0.015625, 0.03125), i))?;
            trace.step(cloth, 1);
        }
        cloth.release(grab)?;
        cloth.unpin_all();
        trace.step(cloth, 20);
        trace.record_outputs(cloth);
    }
    assert!(trace.count_of(EventKind::EdgeDivided) > 20, "too few edges were divided");
    assert!(trace.count_of(EventKind::PieceDetached) >= 2, "too few pieces were cut off");
    Ok(())
}

/// An uneven mesh of 9 × 9 vertices with alternating diagonals, pinned at two corners.
fn uneven_mesh() -> MeshDesc {
    let uneven = |k: u32| (k * 37 % 16) as f32 * 0.0009765625;
    let at = |i: u32| {
        let (column, row) = ((i % 9) as f32, (i / 9) as f32);
        Vec3::new(column * 0.09375 + uneven(i), row * -0.125 - uneven(i + 5), uneven(i + 3))
    };
    let quads = (0..64).map(|i| i / 8 * 9 + i % 8);
    let indices = quads.flat_map(|a| {
        let (b, c, d) = (a + 1, a + 9, a + 10);
        if a % 3 == 0 { [a, c, b, c, b, d] } else { [a, c, d, a, d, b] }
    });
    MeshDesc {
        positions: (0..81).map(at).collect(),
        indices: indices.collect(),
        pinned: vec![0, 8],
        material: Material { tear_stretch: 1.5, ..Material::preset(Preset::Silk) },
        settings: Settings { tearing: true, ..Settings::default() },
        ..MeshDesc::default()
    }
}

/// Hundreds of random tears and cuts of grids and meshes.
pub fn tears_and_cuts_at_random(trace: &mut Trace) -> Result<()> {
    let mut random = 0x1f12_3bb5_u32;
    // Xorshift (Marsaglia, 2003): integers, so the same on any host.
    let mut next = move |below: u32| {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        random % below
    };
    let mut split = 0;
    for round in 0..8 {
        let mut cloth = if round % 2 == 0 {
            let desc = thin_sheet(4 + next(12), 4 + next(12));
            Cloth::grid(&GridDesc { extra_particles: 400, ..desc })?
        } else {
            Cloth::mesh(&MeshDesc { extra_particles: 400, ..uneven_mesh() })?
        };
        let before = cloth.positions().len();
        for _ in 0..60 {
            if next(8) == 0 {
                let [a, b, c, d] = [0; 4].map(|_| next(96) as f32 / 64.0 - 0.25);
                let (from, to) = (Vec3::new(a, -b, -4.0), Vec3::new(c, -d, -4.0));
                trace.record_word(cloth.cut(from, to, Vec3::Z * 8.0).map_or(1000, u64::from));
            } else {
                let corner = next(cloth.indices().len() as u32) as usize;
                let end = corner - corner % 3 + (corner + 1) % 3;
                let ends = [cloth.indices()[corner], cloth.indices()[end]];
                trace.record_word(cloth.tear_edge(ends[0], ends[1]).map_or(2, u64::from));
            }
            if next(3) == 0 {
                trace.step(&mut cloth, 1);
            }
        }
        trace.step(&mut cloth, 10);
        trace.record_outputs(&mut cloth);
        split += cloth.positions().len() - before;
    }
    assert!(split > 400, "only {split} vertices were split");
    Ok(())
}

/// Tearing stops when the reserve of particles is used up, and reports an event.
pub fn tears_use_up_their_room(trace: &mut Trace) -> Result<()> {
    let desc = GridDesc { extra_particles: 6, ..thin_sheet(9, 10) };
    let mut cloth = Cloth::grid(&desc)?;
    let grab = cloth.grab_particle(4 * 9 + 4)?;
    for i in 1..=80 {
        cloth.move_grab(grab, along(Vec3::new(0.25, -0.25, 0.0), Vec3::Z * 0.0625, i))?;
        trace.step(&mut cloth, 1);
    }
    cloth.release(grab)?;
    trace.step(&mut cloth, 30);
    trace.record_outputs(&mut cloth);
    assert_eq!(trace.count_of(EventKind::ReserveUsedUp), 1, "the reserve must be used up once");
    Ok(())
}
