//! What one projection of one constraint costs.

use crate::Effort;
use crate::cases::{Cases, KernelCase, rounds};
use crate::measure::{in_turn, now, seconds};
use crate::table::{Table, times};
use muslin::{Cloth, GridDesc, Material, MeshDesc, PinMode, Settings, Stage};
use muslin_plain::{Order, PlainSheet, Size};
use muslin_scenes::HangingSheet;

/// Sweeps of a tick: many, so that the links are nearly all that is done.
const SWEEPS: u32 = 16;

/// How often ticks are run again that others disturbed, by a greater share than this.
const TRIES: u32 = 20;
const CALM: f64 = 0.02;

/// How far links give way: the membrane and shear stiffness [N/m], 0 for not at all. Those that do keep a
/// multiplier from sweep to sweep. Links over two cells are rigid, since otherwise sweeps leave bending to
/// a stage of its own.
const LAWS: [(&str, [f32; 2]); 2] = [("cotton's threads", [2.0e3, 50.0]), ("all rigid", [0.0; 2])];

pub fn print(effort: Effort) {
    let cases = Cases::read().kernels;
    let mut table = Table::new(
        &["sheet", "links"],
        &["by particle", "by kind", "mesh", "grid", "mesh is faster", "grid is faster"],
    );
    for case in &cases {
        for (law, stiffness) in LAWS {
            let rounds = if effort == Effort::Once { 1 } else { case.rounds };
            table.push(measure(case, law, stiffness, rounds));
        }
    }
    println!(
        "\nKernels: ns of one thread for a projection of one constraint; the least, and in brackets the \
         median, of {}.\nby particle, by kind: the plain loop over Vec3, its list row by row in two \
         orders; mesh: the sheet given to Muslin as any triangle mesh; grid: as a grid.\n\
         faster: than the plain loop by particle, and by kind; the median of the rounds' ratios.\n",
        rounds(cases.iter().map(|case| case.rounds))
    );
    println!("{table}");
}

fn measure(case: &KernelCase, law: &str, stiffness: [f32; 2], rounds: u32) -> Vec<String> {
    let (desc, [mut grid, mut mesh]) = cloths(case.side, stiffness);
    let side = desc.columns as usize;
    let size = Size { columns: side, rows: side, spacing: desc.spacing, by_corners: false };
    let mut sheets = [Order::ByParticle, Order::ByKind].map(|order| PlainSheet::hang(size, order));
    let [by_particle, by_kind] = &mut sheets;
    let figures = in_turn(
        rounds,
        [
            &mut || plain_ns(by_particle, desc.settings.tick),
            &mut || plain_ns(by_kind, desc.settings.tick),
            &mut || sweep_ns(&mut mesh, case.ticks),
            &mut || sweep_ns(&mut grid, case.ticks),
        ],
    );
    let mut row = vec![format!("{0} x {0}", case.side), law.into()];
    row.extend(figures.iter().map(|one| format!("{:.2} ({:.2})", one.min(), one.median())));
    let [by_particle, by_kind, ours @ ..] = &figures;
    row.extend(ours.iter().map(|one| {
        format!("{} {}", times(one.times_below(by_particle)), times(one.times_below(by_kind)))
    }));
    row
}

/// Runs sweeps of the plain loop over a sheet that moves, and tells what a projection took [ns].
fn plain_ns(sheet: &mut PlainSheet, h: f32) -> f64 {
    sheet.predict(h);
    let spent = seconds(|| (0..SWEEPS).for_each(|_| sheet.sweep()));
    1.0e9 * spent / (f64::from(SWEEPS) * sheet.link_count() as f64)
}

/// The descriptor of a sheet, and the sheet as a grid and as a mesh of the same triangles.
fn cloths(side: u32, [membrane, shear]: [f32; 2]) -> (GridDesc, [Cloth; 2]) {
    let mut desc = HangingSheet::desc(side, PinMode::TopEdge);
    // Tethers are another stage, and with them goes the solving of whole lines.
    desc.settings =
        Settings { substeps: 1, iterations: SWEEPS, tethers: false, ..Settings::default() };
    desc.material = Material {
        stretch_stiffness_warp: membrane,
        stretch_stiffness_weft: membrane,
        shear_stiffness: shear,
        bend_stiffness: 1.0,
        ..desc.material
    };
    let grid = Cloth::grid(&desc).expect("a grid of the benchmark's own");
    // In another order, or it would be found to be the grid.
    let mut indices = grid.indices().to_vec();
    indices.rotate_left(3);
    let mesh = Cloth::mesh(&MeshDesc {
        positions: grid.positions().to_vec(),
        indices,
        pinned: grid.pinned().collect(),
        material: desc.material.clone(),
        settings: desc.settings.clone(),
        ..MeshDesc::default()
    });
    let mut cloths = [grid, mesh.expect("a mesh of the benchmark's own")];
    for cloth in &mut cloths {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the scene's own wind");
        cloth.set_clock(Some(now));
    }
    (desc, cloths)
}

/// Runs some ticks, and tells what a projection took by the cloth's own clock [ns]. That clock goes on
/// while others have the processor, so of some tries the least disturbed one counts.
fn sweep_ns(cloth: &mut Cloth, ticks: u32) -> f64 {
    let (mut least, mut ns) = (f64::INFINITY, f64::NAN);
    for _ in 0..TRIES {
        let start = now();
        let spent = seconds(|| cloth.step(ticks));
        let disturbed = (now() - start) / spent - 1.0;
        if disturbed < least {
            let stats = cloth.stats();
            let took = |stage: Stage| f64::from(stats.seconds[stage as usize]);
            let links = took(Stage::Stretch) + took(Stage::Shear) + took(Stage::Bend);
            least = disturbed;
            ns = 1.0e9 * links / f64::from(ticks * SWEEPS * stats.constraints);
        }
        if disturbed < CALM {
            break;
        }
    }
    ns
}
