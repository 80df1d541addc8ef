//! Tests of mass scales: factors on the mass of single particles.

use crate::common::bare_grid;
use muslin::glam::Vec3;
use muslin::{Cloth, Error, GridDesc, Material, MeshDesc, PinMode, Preset};

const SHEET: (u32, u32) = (12, 16);

/// A sheet of cotton hung by its top edge, after `change` of its descriptor.
fn cotton_sheet(change: impl FnOnce(&mut GridDesc)) -> Cloth {
    let (columns, rows) = SHEET;
    let mut desc = GridDesc { columns, rows, spacing: 0.03, ..GridDesc::default() };
    desc.material = Material::preset(Preset::Cotton);
    change(&mut desc);
    Cloth::grid(&desc).unwrap()
}

/// The mass of each particle [kg].
fn masses(cloth: &Cloth) -> Vec<f32> {
    (0..cloth.stats().particles).map(|i| cloth.mass(i).unwrap()).collect()
}

/// The particles of the last row.
fn hem_particles() -> Vec<u32> {
    (SHEET.0 * (SHEET.1 - 1)..SHEET.0 * SHEET.1).collect()
}

#[test]
fn a_mass_scale_multiplies_the_mass_and_stays_when_the_density_changes() {
    let mut cloth = cotton_sheet(|_| ());
    let plain = masses(&cloth);
    cloth.set_mass_scales(&hem_particles(), &[5.0; 12]).unwrap();
    cloth.set_material(Material { density: 0.36, ..cloth.material().clone() }).unwrap();
    for (at, (now, plain)) in masses(&cloth).iter().zip(&plain).enumerate() {
        let exact = plain * 2.0 * if at >= 180 { 5.0 } else { 1.0 };
        assert!((now / exact - 1.0).abs() < 1e-5, "particle {at} weighs {now} kg, not {exact}");
    }
    cloth.set_mass_scales(&hem_particles(), &[1.0; 12]).unwrap();
    cloth.set_material(Material { density: 0.18, ..cloth.material().clone() }).unwrap();
    assert_eq!(masses(&cloth), plain);
}

#[test]
fn soft_pins_sag_by_the_weight_of_the_cloth_and_its_hem() {
    for scale in [0.01, 20.0, 200.0] {
        let mut cloth = cotton_sheet(|desc| desc.settings.damping = 3.0);
        let start = cloth.positions().to_vec();
        cloth.set_mass_scales(&hem_particles(), &[scale; 12]).unwrap();
        let pins: Vec<u32> = cloth.pinned().collect();
        cloth.set_pin_stiffness(&pins, 100.0).unwrap();
        cloth.step(2400);
        let below: f32 =
            pins.iter().map(|p| start[*p as usize].y - cloth.positions()[*p as usize].y).sum();
        let exact = masses(&cloth).iter().sum::<f32>() * 9.81 / 100.0;
        println!(
            "hem scaled by {scale}: pins sag by {below:.6} m in total, reference {exact:.6} m"
        );
        assert!((below / exact - 1.0).abs() < 0.03, "the pins sag by {below} m, not {exact} m");
    }
}

#[test]
fn a_cloth_with_mass_ratios_of_one_hundred_hangs_at_rest() {
    for preset in [Preset::Silk, Preset::Leather, Preset::Paper] {
        let mut cloth = cotton_sheet(|desc| desc.material = Material::preset(preset));
        let all: Vec<u32> = (0..192).collect();
        let scales: Vec<f32> = all.iter().map(|i| [0.1, 1.0, 10.0][(i * 7 % 3) as usize]).collect();
        cloth.set_mass_scales(&all, &scales).unwrap();
        let mut fastest = 0.0_f32;
        for _ in 0..600 {
            cloth.step(1);
            fastest = fastest.max(cloth.stats().max_speed);
        }
        let stats = cloth.stats();
        println!("{preset:?}: {fastest} m/s, then {} m/s", stats.max_speed);
        // The sheet starts in its rest shape, so nothing should move it.
        assert!(fastest < 0.1 && stats.max_speed < 0.005, "{preset:?}: {fastest} m/s");
        assert!(stats.max_stretch < 0.01, "{preset:?}: stretched by {}", stats.max_stretch);
    }
}

#[test]
fn scaling_all_masses_by_one_factor_does_not_change_the_motion() {
    // Links of the default material are rigid and there is no air, so mass does not matter.
    let positions_at_scale = |scale: f32| {
        let mut cloth = Cloth::grid(&bare_grid(8, 8, 0.05, PinMode::TopCorners)).unwrap();
        cloth.set_mass_scales(&(0..64).collect::<Vec<_>>(), &[scale; 64]).unwrap();
        cloth.step(200);
        cloth.positions().to_vec()
    };
    let (one, eight) = (positions_at_scale(1.0), positions_at_scale(8.0));
    let off = one.iter().zip(&eight).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    println!("the positions differ by {off:.1e} m");
    assert!(off < 0.02, "the positions differ by {off} m");
}

/// The drop of the free end of a strip of a mesh, clamped at its other end [m], when all masses are
/// multiplied by `scale` and gravity is divided by it.
fn drop_of_mesh_strip(scale: f32) -> f32 {
    let (columns, rows, cell) = (25_u32, 4_u32, 0.01);
    let mut desc = MeshDesc::default();
    for at in 0..columns * rows {
        let (column, row) = (at % columns, at / columns);
        // Shifted, so that the mesh is no grid.
        let shift = if row % 2 == 1 && column > 1 { 0.4 } else { 0.0 };
        desc.positions.push(Vec3::new(column as f32 + shift, 0.0, row as f32) * cell);
        if column < 2 {
            desc.pinned.push(at);
        }
        if column + 1 < columns && row + 1 < rows {
            let [a, b, c, d] = [at, at + 1, at + columns, at + columns + 1];
            desc.indices.extend([a, c, b, b, c, d]);
        }
    }
    desc.material = Material { bend_stiffness: 1.0e-3, drag: 0.0, lift: 0.0, ..desc.material };
    desc.settings.gravity = Vec3::NEG_Y * (9.81 / scale);
    desc.settings.damping = 3.0;
    let mut cloth = Cloth::mesh(&desc).unwrap();
    assert!(!cloth.mesh_report().is_grid);
    let all: Vec<u32> = (0..columns * rows).collect();
    cloth.set_mass_scales(&all, &vec![scale; all.len()]).unwrap();
    cloth.step((600.0 * scale.sqrt()) as u32);
    -cloth.positions()[columns as usize - 1].y
}

#[test]
fn heavy_particles_of_a_mesh_bend_as_stiffly_as_light_ones() {
    let [light, heavy] = [1.0, 100.0].map(drop_of_mesh_strip);
    println!("the strip drops by {light:.4} m, and {heavy:.4} m with a hundredfold mass");
    assert!(light > 0.02 && (heavy / light - 1.0).abs() < 0.03, "{heavy} m instead of {light} m");
}

#[test]
fn a_cut_keeps_the_total_mass_and_save_and_clone_keep_the_mass_scales() {
    let mut cloth = cotton_sheet(|_| ());
    let all: Vec<u32> = (0..192).collect();
    cloth.set_mass_scales(&all, &[3.0; 192]).unwrap();
    let before: f32 = masses(&cloth).iter().sum();
    let from = Vec3::new(0.1, -0.1, -1.0);
    assert!(cloth.cut(from, from - Vec3::new(-0.05, 1.0, 0.0), Vec3::Z * 2.0).unwrap() > 5);
    let after: f32 = masses(&cloth).iter().sum();
    assert!((after / before - 1.0).abs() < 1e-5, "the cut changed {before} kg to {after} kg");
    let mut others = [Cloth::restore(&cloth.save()).unwrap(), cloth.clone()];
    let denser = Material { density: 0.3, ..cloth.material().clone() };
    cloth.set_material(denser.clone()).unwrap();
    cloth.step(30);
    for other in &mut others {
        other.set_material(denser.clone()).unwrap();
        other.step(30);
        assert_eq!(other.state_hash(), cloth.state_hash());
        assert_eq!(masses(other), masses(&cloth));
    }
    cloth.reset();
    let plain = masses(&cotton_sheet(|desc| desc.material = denser));
    assert_eq!(masses(&cloth), plain);
}

#[test]
fn invalid_mass_scales_are_refused_and_change_nothing() {
    let mut cloth = cotton_sheet(|_| ());
    let before = cloth.save();
    for scale in [0.0, -1.0, 1e-4, 1e4, f32::NAN, f32::INFINITY] {
        let refused = cloth.set_mass_scales(&[1, 2], &[2.0, scale]);
        assert_eq!(
            refused,
            Err(Error::BadValue { field: "scales", must: "be from 0.001 to 1000" })
        );
    }
    let refused = cloth.set_mass_scales(&[1, 2], &[2.0]);
    assert_eq!(
        refused,
        Err(Error::BadValue { field: "scales", must: "have as many entries as `particles`" })
    );
    let refused = cloth.set_mass_scales(&[1, 192], &[2.0; 2]);
    assert_eq!(refused, Err(Error::BadIndex { field: "particles", index: 192, count: 192 }));
    assert_eq!(cloth.save(), before);
}
