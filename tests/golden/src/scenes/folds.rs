//! Scenes with plastic folds and creases.

use super::{along, mesh};
use crate::Trace;
use muslin::glam::Vec3;
use muslin::{Cloth, EventKind, GridDesc, Material, PinMode, Preset, Result, Settings};

const COLUMNS: u32 = 24;
const ROWS: u32 = 11;

/// Paper without gravity is bent between two pinned edges, released, creased and torn, and finally
/// gets the material cotton.
pub fn paper_folded_and_creased(trace: &mut Trace) -> Result<()> {
    let paper = Material { yield_angle: 0.25, drag: 0.25, ..Material::preset(Preset::Paper) };
    let mut cloth = Cloth::grid(&GridDesc {
        columns: COLUMNS,
        rows: ROWS,
        spacing: 0.015625,
        down: Vec3::Z,
        pin_mode: PinMode::None,
        material: paper.clone(),
        settings: Settings { gravity: Vec3::ZERO, damping: 2.0, ..Settings::default() },
        ..GridDesc::default()
    })?;
    for row in 0..ROWS {
        for column in [0, 1, COLUMNS - 2, COLUMNS - 1] {
            cloth.pin(row * COLUMNS + column, None)?;
        }
    }
    let right: Vec<(u32, Vec3)> = (0..ROWS)
        .flat_map(|row| [COLUMNS - 2, COLUMNS - 1].map(|column| row * COLUMNS + column))
        .map(|i| (i, cloth.positions()[i as usize]))
        .collect();
    for tick in 1..=64 {
        for (i, from) in &right {
            let to = along(*from, Vec3::new(-0.00390625, 0.001953125, 0.0), tick);
            cloth.set_pin_targets(&[*i], &[to])?;
        }
        trace.step(&mut cloth, 1);
    }
    cloth.unpin_all();
    trace.step(&mut cloth, 40);
    let ends = [0, COLUMNS as usize - 1].map(|i| cloth.positions()[i]);
    let flat = 0.015625 * (COLUMNS - 1) as f32;
    assert!(ends[0].distance(ends[1]) < 0.9 * flat, "the paper must stay bent");

    cloth.crease(Vec3::new(0.0625, 0.0, -0.125), Vec3::new(0.1875, 0.0, 0.25), 1.0)?;
    cloth.set_material(Material { bend_damping: 0.015625, ..paper.clone() })?;
    trace.step(&mut cloth, 30);
    cloth.tear_edge(2 * COLUMNS + 12, 3 * COLUMNS + 12)?;
    cloth.tear_edge(3 * COLUMNS + 12, 4 * COLUMNS + 12)?;
    trace.step(&mut cloth, 20);
    let cotton = Material::preset(Preset::Cotton);
    cloth.set_material(Material { stretch_damping: 0.0078125, ..cotton })?;
    trace.step(&mut cloth, 30);
    trace.record_outputs(&mut cloth);
    assert!(trace.count_of(EventKind::EdgeTorn) >= 2, "the paper must tear");
    Ok(())
}

/// An irregular leather mesh that is bent at rest is creased and cut, and then gets a lower bend
/// stiffness.
pub fn patch_creased(trace: &mut Trace) -> Result<()> {
    let mut desc = mesh::irregular_mesh(13, 12);
    desc.settings.damping = 1.0;
    let leather = Material { yield_angle: 0.5, ..Material::preset(Preset::Leather) };
    desc.material = Material { bend_stiffness: 0.25, ..leather.clone() };
    let mut cloth = Cloth::mesh(&desc)?;
    trace.step(&mut cloth, 30);
    cloth.crease(Vec3::new(-0.125, -0.25, 0.0), Vec3::new(1.0, -0.375, 0.0), -1.25)?;
    trace.step(&mut cloth, 40);
    let (from, to) = (Vec3::new(0.25, -0.5, -1.0), Vec3::new(0.5625, -0.5, -1.0));
    let edges = cloth.cut(from, to, Vec3::Z * 2.0)?;
    assert!(edges > 0, "the blade must cut");
    trace.step(&mut cloth, 30);
    cloth.set_material(Material { bend_damping: 0.03125, ..leather })?;
    trace.step(&mut cloth, 40);
    trace.record_outputs(&mut cloth);
    Ok(())
}

/// A grid and an irregular mesh of paper harden and weaken where they are folded, creased, torn and
/// cut.
pub fn folds_worn(trace: &mut Trace) -> Result<()> {
    let (yield_hardening, yield_weakening) = (0.5, 2.0);
    let paper = Material { yield_angle: 0.25, drag: 0.25, ..Material::preset(Preset::Paper) };
    let paper = Material { yield_hardening, yield_weakening, ..paper };
    let mut grid = Cloth::grid(&GridDesc {
        columns: COLUMNS,
        rows: ROWS,
        spacing: 0.015625,
        down: Vec3::Z,
        material: paper.clone(),
        settings: Settings { damping: 2.0, ..Settings::default() },
        ..GridDesc::default()
    })?;
    grid.crease(Vec3::new(0.0625, 0.0, -0.125), Vec3::new(0.1875, 0.0, 0.25), 1.0)?;
    trace.step(&mut grid, 60);
    grid.tear_edge(2 * COLUMNS + 12, 3 * COLUMNS + 12)?;
    trace.step(&mut grid, 30);

    let mut desc = mesh::irregular_mesh(13, 12);
    desc.settings.damping = 1.0;
    desc.material = Material { bend_stiffness: 0.25, density: 0.5, ..paper };
    let mut leaf = Cloth::mesh(&desc)?;
    trace.step(&mut leaf, 30);
    leaf.crease(Vec3::new(-0.125, -0.25, 0.0), Vec3::new(1.0, -0.375, 0.0), -1.25)?;
    trace.step(&mut leaf, 30);
    let (from, to) = (Vec3::new(0.25, -0.5, -1.0), Vec3::new(0.5625, -0.5, -1.0));
    leaf.cut(from, to, Vec3::Z * 2.0)?;
    trace.step(&mut leaf, 30);

    for mut cloth in [grid, leaf] {
        let mut restored = Cloth::restore(&cloth.save())?;
        let firm = Material { yield_weakening: 0.0, ..cloth.material().clone() };
        let hash = cloth.state_hash();
        for cloth in [&mut cloth, &mut restored] {
            cloth.set_material(firm.clone())?;
            trace.step(cloth, 20);
        }
        assert_eq!(cloth.state_hash(), restored.state_hash(), "a save must keep the weakening");
        assert_ne!(cloth.state_hash(), hash, "the cloth must keep moving");
        trace.record_outputs(&mut cloth);
    }
    Ok(())
}
