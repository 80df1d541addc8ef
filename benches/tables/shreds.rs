//! What a tick costs once a sheet is torn to shreds, beside the same sheet whole.

use crate::Effort;
use crate::measure::{in_turn, seconds};
use crate::table::{Table, number, times};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc};
use std::hint::black_box;

const SIDE: u32 = 128;

/// Vertices that are split before anything is measured.
const SPLITS: usize = 2000;

pub fn print(effort: Effort) {
    let (rounds, splits) = if effort == Effort::Once { (1, 100) } else { (25, SPLITS) };
    let (mut whole, mut torn) = (sheet(), shreds(splits));
    let (old, new) = (whole.positions().len(), torn.positions().len());
    let a_tick = |cloth: &mut Cloth| {
        1.0e3
            * seconds(|| {
                cloth.step(1);
                black_box(cloth.view());
            })
    };
    let [whole_ms, torn_ms] =
        in_turn(rounds, [&mut || a_tick(&mut whole), &mut || a_tick(&mut torn)]);
    let mut table =
        Table::new(&["sheet"], &["splits", "pieces", "whole ms", "torn ms", "as long as whole"]);
    table.push(vec![
        format!("{SIDE} x {SIDE}"),
        (new - old).to_string(),
        torn.stats().pieces.to_string(),
        number(whole_ms.min(), 3),
        number(torn_ms.min(), 3),
        times(torn_ms.min() / whole_ms.min()),
    ]);
    println!(
        "\nShreds: ms of one thread for a whole tick with normals, of a sheet in which {splits} vertices or \
         more were split; the least of {rounds} rounds in turn.\n"
    );
    println!("{table}");
}

fn sheet() -> Cloth {
    let mut desc = GridDesc { columns: SIDE, rows: SIDE, ..GridDesc::default() };
    desc.spacing = 2.0 / SIDE as f32;
    desc.settings.tearing = true;
    let mut cloth = Cloth::grid(&desc).expect("a grid of the benchmark's own");
    // What falls off comes to rest again.
    let floor = ColliderDesc { position: Vec3::NEG_Y * 2.25, ..ColliderDesc::default() };
    cloth.add_collider(&floor).expect("a floor of the benchmark's own");
    cloth.step(60);
    cloth
}

/// The same sheet with slits everywhere.
fn shreds(splits: usize) -> Cloth {
    let mut cloth = sheet();
    let old = cloth.positions().len();
    let mut pick = 1_u32;
    while cloth.positions().len() < old + splits {
        pick = pick.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let corner = (pick >> 8) as usize % cloth.indices().len();
        let triangle = corner - corner % 3;
        let (a, b) = (cloth.indices()[corner], cloth.indices()[triangle + (corner + 1) % 3]);
        // An end that is held does not give way; there are others.
        let _ = cloth.tear_edge(a, b).expect("two ends of an edge, and room");
    }
    cloth.step(120);
    cloth
}
