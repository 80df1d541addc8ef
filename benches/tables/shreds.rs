//! Table `shreds`: the cost of a tick of a sheet with thousands of tears, compared with the intact
//! sheet.

use crate::Effort;
use crate::measure::{cpu_time, measure_interleaved};
use crate::table::{Table, format_number, format_ratio};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc};
use std::hint::black_box;

const SIDE: u32 = 128;

/// Vertices that are split before measuring.
const SPLITS: usize = 2000;

pub fn print(effort: Effort) {
    let (rounds, splits) = if effort == Effort::Smoke { (1, 100) } else { (25, SPLITS) };
    let (mut intact, mut torn) = (create_sheet(), create_torn_sheet(splits));
    let (old, new) = (intact.positions().len(), torn.positions().len());
    let time_tick = |cloth: &mut Cloth| {
        1.0e3
            * cpu_time(|| {
                cloth.step(1);
                black_box(cloth.view());
            })
    };
    let [intact_ms, torn_ms] =
        measure_interleaved(rounds, [&mut || time_tick(&mut intact), &mut || time_tick(&mut torn)]);
    let mut table =
        Table::new(&["sheet"], &["splits", "pieces", "intact ms", "torn ms", "torn / intact"]);
    table.push(vec![
        format!("{SIDE} x {SIDE}"),
        (new - old).to_string(),
        torn.stats().pieces.to_string(),
        format_number(intact_ms.min(), 3),
        format_number(torn_ms.min(), 3),
        format_ratio(torn_ms.min() / intact_ms.min()),
    ]);
    println!(
        "\nShreds: ms per tick on one thread with normals; \
         at least {splits} vertices of the torn sheet were split; minimum of {rounds} interleaved rounds.\n"
    );
    println!("{table}");
}

fn create_sheet() -> Cloth {
    let mut desc = GridDesc { columns: SIDE, rows: SIDE, ..GridDesc::default() };
    desc.spacing = 2.0 / SIDE as f32;
    desc.settings.tearing = true;
    let mut cloth = Cloth::grid(&desc).expect("a grid is valid");
    // Pieces that come off come to rest on it.
    let floor = ColliderDesc { position: Vec3::NEG_Y * 2.25, ..ColliderDesc::default() };
    cloth.add_collider(&floor).expect("a floor is valid");
    cloth.step(60);
    cloth
}

/// Creates the same sheet with tears everywhere, at pseudorandom edges.
fn create_torn_sheet(splits: usize) -> Cloth {
    let mut cloth = create_sheet();
    let old = cloth.positions().len();
    let mut random = 1_u32;
    while cloth.positions().len() < old + splits {
        random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let corner = (random >> 8) as usize % cloth.indices().len();
        let triangle = corner - corner % 3;
        let (a, b) = (cloth.indices()[corner], cloth.indices()[triangle + (corner + 1) % 3]);
        // A pinned end does not split; other edges follow.
        let _ = cloth
            .tear_edge(a, b)
            .expect("the particles share an edge and the reserve is not used up");
    }
    cloth.step(120);
    cloth
}
