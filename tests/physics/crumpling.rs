//! Plastic bending of a crumpled sheet: case P7 of the validation list, also with hardening folds.

use crate::common::folding::{STRIP_LENGTH, node_spacing, paper_sheet_desc};
use crate::common::rms_speed;
use muslin::glam::Vec3;
use muslin::{Cloth, Material, Preset, SelfCollision};

const NODES: u32 = 41;

/// Distance of the particles that are held while a sheet is crumpled, in cells.
const HOLDS: u32 = 8;

/// The position of a particle on the flat sheet [m].
fn flat_position(i: u32) -> Vec3 {
    Vec3::new((i % NODES) as f32, 0.0, (i / NODES) as f32) * node_spacing(NODES)
}

/// A pseudo-random number from −1 to 1 for each particle, the same in each run.
fn noise(i: u32) -> f32 {
    let mixed = (i + 1).wrapping_mul(0x9e37_79b9) >> 16;
    mixed as f32 / 32768.0 - 1.0
}

/// Paper without drag, plastic or elastic.
fn paper_material(is_plastic: bool) -> Material {
    let paper = Material { drag: 0.0, ..Material::preset(Preset::Paper) };
    if is_plastic { paper } else { Material { yield_angle: 0.0, ..paper } }
}

fn paper_sheet(material: Material) -> Cloth {
    let mut desc = paper_sheet_desc(NODES, NODES, 0.0);
    desc.material = material;
    desc.settings.substeps = 8;
    desc.settings.self_collision = SelfCollision::Particles;
    desc.settings.self_distance = 0.003;
    Cloth::grid(&desc).unwrap()
}

/// Moves the pinned particles `held` to their targets at constant speed, within `ticks` ticks.
fn move_pins(cloth: &mut Cloth, held: &[u32], ticks: u32, to: impl Fn(u32) -> Vec3) {
    let from: Vec<Vec3> = held.iter().map(|i| cloth.positions()[*i as usize]).collect();
    for tick in 1..=ticks {
        let share = tick as f32 / ticks as f32;
        let target = |(i, from): (&u32, &Vec3)| from.lerp(to(*i), share);
        let targets: Vec<Vec3> = held.iter().zip(&from).map(target).collect();
        cloth.set_pin_targets(held, &targets).unwrap();
        cloth.step(1);
    }
}

/// Removes all pins and steps until the sheet is at rest, for at most 900 ticks.
fn unpin_and_rest(cloth: &mut Cloth) {
    cloth.unpin_all();
    let mut ticks = 0;
    while ticks < 120 || (rms_speed(cloth) > 1.0e-3 && ticks < 900) {
        cloth.step(1);
        ticks += 1;
    }
}

/// Moves particles all over the sheet inward, each to its own height, then releases them.
fn crumple(cloth: &mut Cloth) {
    let is_held = |i: &u32| (i % NODES).is_multiple_of(HOLDS) && (i / NODES).is_multiple_of(HOLDS);
    let held: Vec<u32> = (0..NODES * NODES).filter(is_held).collect();
    let middle = Vec3::new(0.5, 0.0, 0.5) * STRIP_LENGTH;
    move_pins(cloth, &held, 240, |i| {
        middle + (flat_position(i) - middle) * 0.6 + Vec3::Y * (0.2 * STRIP_LENGTH * noise(i))
    });
    unpin_and_rest(cloth);
}

/// Pulls a sheet flat by its whole border, holds it for a second, then releases it.
fn pull_flat(cloth: &mut Cloth) {
    let is_end = |at: u32| at == 0 || at == NODES - 1;
    let held: Vec<u32> =
        (0..NODES * NODES).filter(|i| is_end(i % NODES) || is_end(i / NODES)).collect();
    move_pins(cloth, &held, 240, flat_position);
    cloth.step(60);
    unpin_and_rest(cloth);
}

/// Returns the mean angle between the normals of the two triangles of a cell [rad], and the mean
/// distance of the midpoints of opposite borders, divided by its flat value.
fn fold_angle_and_width(cloth: &Cloth) -> (f32, f32) {
    let normals: Vec<Vec3> = crate::common::triangles(cloth)
        .into_iter()
        .map(|triangle| {
            let [a, b, c] = triangle.map(|i| cloth.positions()[i as usize]);
            (b - a).cross(c - a).normalize()
        })
        .collect();
    let pairs = normals.chunks_exact(2).map(|pair| pair[0].angle_between(pair[1]));
    let bent = pairs.clone().sum::<f32>() / pairs.count() as f32;
    let at = |i: u32| cloth.positions()[i as usize];
    let half = NODES / 2;
    let across = at(half * NODES).distance(at(half * NODES + NODES - 1));
    let down = at(half).distance(at((NODES - 1) * NODES + half));
    (bent, (across + down) / (2.0 * STRIP_LENGTH))
}

#[test]
fn a_crumpled_sheet_stays_crumpled_and_pulling_flattens_it_only_partly() {
    let (yield_angle, yield_hardening, yield_weakening) = (0.4, 0.25, 1.0);
    let hardening =
        Material { yield_angle, yield_hardening, yield_weakening, ..paper_material(true) };
    let found = [paper_material(false), paper_material(true), hardening].map(|material| {
        let mut cloth = paper_sheet(material);
        crumple(&mut cloth);
        let crumpled = fold_angle_and_width(&cloth);
        pull_flat(&mut cloth);
        (crumpled, fold_angle_and_width(&cloth))
    });
    for (crumpled, flattened) in found {
        println!(
            "P7: fold angle and width, crumpled {crumpled:.3?}, pulled flat and released {flattened:.3?}"
        );
    }
    let [(elastic, _), (crumpled, flattened), (hardened, pulled)] = found;
    assert!(
        elastic.0 < 0.01 && elastic.1 > 0.98,
        "an elastic sheet becomes flat again: {elastic:?}"
    );
    assert!(crumpled.0 > 0.2 && crumpled.1 < 0.85, "it does not stay crumpled: {crumpled:?}");
    assert!(flattened.0 < 0.9 * crumpled.0, "it does not flatten: {crumpled:?} {flattened:?}");
    assert!(flattened.1 > crumpled.1 + 0.05, "it does not flatten: {crumpled:?} {flattened:?}");
    assert!(
        flattened.0 > 0.5 * crumpled.0 && flattened.1 < 0.95,
        "it flattens completely: {flattened:?}"
    );
    // A hardening sheet keeps less of each fold, and pulling it flat does not remove that part.
    assert!(hardened.0 > 0.05 && hardened.0 < crumpled.0, "it does not harden: {hardened:?}");
    assert!(
        (pulled.0 - hardened.0).abs() < 0.01,
        "its folds yield too early: {hardened:?} {pulled:?}"
    );
}
