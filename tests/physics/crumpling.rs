//! What is crumpled stays so, and flattens only partly: the P7 case of the validation list, and on from there.

use crate::common::folding::{SIZE, sheet, spacing};
use crate::common::strip::speed;
use muslin::glam::Vec3;
use muslin::{Cloth, Material, Preset, SelfCollision};

const NODES: u32 = 41;

/// Where hands hold a sheet that they crumple: so many cells apart.
const HOLDS: u32 = 8;

fn place(i: u32) -> Vec3 {
    Vec3::new((i % NODES) as f32, 0.0, (i / NODES) as f32) * spacing(NODES)
}

/// A number from −1 to 1 for each particle, the same each time.
fn odd(i: u32) -> f32 {
    let mixed = (i + 1).wrapping_mul(0x9e37_79b9) >> 16;
    mixed as f32 / 32768.0 - 1.0
}

fn material(yields: bool) -> Material {
    let paper = Material { drag: 0.0, ..Material::preset(Preset::Paper) };
    if yields { paper } else { Material { yield_angle: 0.0, ..paper } }
}

fn paper(material: Material) -> Cloth {
    let mut desc = sheet(NODES, NODES, 0.0);
    desc.material = material;
    desc.settings.substeps = 8;
    desc.settings.self_collision = SelfCollision::Particles;
    desc.settings.self_distance = 0.003;
    Cloth::grid(&desc).unwrap()
}

/// Takes some particles slowly to where they are to be.
fn lead(cloth: &mut Cloth, held: &[u32], ticks: u32, to: impl Fn(u32) -> Vec3) {
    let from: Vec<Vec3> = held.iter().map(|i| cloth.positions()[*i as usize]).collect();
    for tick in 1..=ticks {
        let share = tick as f32 / ticks as f32;
        let way = |(i, from): (&u32, &Vec3)| from.lerp(to(*i), share);
        let targets: Vec<Vec3> = held.iter().zip(&from).map(way).collect();
        cloth.set_pin_targets(held, &targets).unwrap();
        cloth.step(1);
    }
}

fn let_go(cloth: &mut Cloth) {
    cloth.unpin_all();
    let mut ticks = 0;
    while ticks < 120 || (speed(cloth) > 1.0e-3 && ticks < 900) {
        cloth.step(1);
        ticks += 1;
    }
}

/// Draws a sheet in at places all over it, each to its own height, and lets go.
fn crumple(cloth: &mut Cloth) {
    let is_held = |i: &u32| (i % NODES).is_multiple_of(HOLDS) && (i / NODES).is_multiple_of(HOLDS);
    let held: Vec<u32> = (0..NODES * NODES).filter(is_held).collect();
    let middle = Vec3::new(0.5, 0.0, 0.5) * SIZE;
    lead(cloth, &held, 240, |i| {
        middle + (place(i) - middle) * 0.6 + Vec3::Y * (0.2 * SIZE * odd(i))
    });
    let_go(cloth);
}

/// Pulls a sheet flat by all its border, holds it for a second, and lets go.
fn pull_flat(cloth: &mut Cloth) {
    let is_end = |at: u32| at == 0 || at == NODES - 1;
    let held: Vec<u32> =
        (0..NODES * NODES).filter(|i| is_end(i % NODES) || is_end(i / NODES)).collect();
    lead(cloth, &held, 240, place);
    cloth.step(60);
    let_go(cloth);
}

/// How crumpled a sheet is: the mean angle between the normals of triangles that share an edge [rad], and how wide
/// it is between the middles of its borders, over how wide it was.
fn measure(cloth: &Cloth) -> (f32, f32) {
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
    (bent, (across + down) / (2.0 * SIZE))
}

#[test]
fn a_crumple_stays_crumpled_and_flattens_only_partly() {
    let (yield_angle, yield_hardening, yield_weakening) = (0.4, 0.25, 1.0);
    let worn = Material { yield_angle, yield_hardening, yield_weakening, ..material(true) };
    let found = [material(false), material(true), worn].map(|material| {
        let mut cloth = paper(material);
        crumple(&mut cloth);
        let crumpled = measure(&cloth);
        pull_flat(&mut cloth);
        (crumpled, measure(&cloth))
    });
    for (crumpled, flattened) in found {
        println!("P7: bent by, as wide as {crumpled:.3?}, pulled flat and let go {flattened:.3?}");
    }
    let [(springs, _), (crumpled, flattened), (firm, pulled)] = found;
    assert!(springs.0 < 0.01 && springs.1 > 0.98, "what does not yield is flat again: {springs:?}");
    assert!(crumpled.0 > 0.2 && crumpled.1 < 0.85, "it does not stay crumpled: {crumpled:?}");
    assert!(flattened.0 < 0.9 * crumpled.0, "it does not flatten: {crumpled:?} {flattened:?}");
    assert!(flattened.1 > crumpled.1 + 0.05, "it does not flatten: {crumpled:?} {flattened:?}");
    assert!(flattened.0 > 0.5 * crumpled.0 && flattened.1 < 0.95, "it is ironed: {flattened:?}");
    // What hardened keeps less of each fold, but that it keeps.
    assert!(firm.0 > 0.05 && firm.0 < crumpled.0, "it does not harden: {firm:?}");
    assert!((pulled.0 - firm.0).abs() < 0.01, "it gives way too soon: {firm:?} {pulled:?}");
}
