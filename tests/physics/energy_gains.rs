//! Scenes in which cloth once gained energy by itself.

use crate::random_scenes::{Kind, Scene, test_energy};
use muslin::SelfCollision;

/// A grid of stiff fabric that moves without damping.
fn stiff_grid(columns: u32, rows: u32, spacing: f32, bend_stiffness: f32) -> Scene {
    Scene {
        kind: Kind::CutGrid,
        columns,
        rows,
        pieces: 1,
        spacing,
        layer_distance: 1.0,
        speed: 0.62,
        stretch_stiffness: None,
        bend_stiffness,
        iterations: 2,
        substeps: 2,
        ticks: vec![0.0131],
        tethers: false,
        gravity: -9.81,
        collision: SelfCollision::None,
        pins: 0,
        seed: 5,
    }
}

#[test]
fn bending_a_held_stiff_grid_added_energy_without_end() {
    for iterations in 1..4 {
        let stretch_stiffness = Some(17_368.0);
        let grid = stiff_grid(8, 4, 0.0045, 3.06e-4);
        let scene = Scene { iterations, stretch_stiffness, pins: 1, ..grid };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 60, 0.0).unwrap();
    }
}

#[test]
fn hinges_at_a_cut_of_stiff_cloth_added_energy() {
    for pieces in 2..4 {
        let (ticks, iterations) = (vec![0.000_376_93], 3);
        let grid = stiff_grid(5, 8, 0.008_73, 5.0e-3);
        let scene = Scene { pieces, ticks, iterations, gravity: 0.0, speed: 0.19, ..grid };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 60, 0.0).unwrap();
    }
}

#[test]
fn ticks_of_several_lengths_made_bending_and_soft_links_add_energy() {
    let bent = Scene {
        ticks: vec![0.249e-3, 0.769e-3, 0.495e-3],
        substeps: 6,
        gravity: 0.0,
        seed: 911_902_770,
        ..stiff_grid(6, 5, 0.006_03, 6.3e-4)
    };
    let stretched = Scene {
        kind: Kind::Layers,
        ticks: vec![0.115e-3, 0.223e-3, 0.153e-3],
        substeps: 6,
        stretch_stiffness: Some(10_682.0),
        ..stiff_grid(5, 8, 0.0395, 7.7e-5)
    };
    for scene in [bent, stretched] {
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 60, 0.0).unwrap();
    }
}

#[test]
fn longer_ticks_threw_layers_apart_that_had_met_in_short_ones() {
    for stretch_stiffness in [Some(15_621.0), None] {
        let scene = Scene {
            pieces: 3,
            speed: 1.4242831,
            stretch_stiffness,
            substeps: 3,
            ticks: vec![4.4416357e-3, 0.28327364e-3, 29.309005e-3],
            tethers: true,
            gravity: 0.0,
            collision: SelfCollision::Surface,
            pins: 2,
            seed: 2_222_180_427,
            ..stiff_grid(7, 6, 0.036_312_226, 7.6561184e-3)
        };
        let mut cloth = scene.build();
        scene.push(&mut cloth);
        test_energy(&scene, &mut cloth, 12, 0.0).unwrap();
    }
}
