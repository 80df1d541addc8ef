//! Table `kernels`: the cost of one projection of one distance constraint.
//!
//! Muslin's time is that of its stages stretch, shear and bend, by the clock of the cloth; that of
//! the plain loop is processor time of its sweeps.

use crate::Effort;
use crate::cases::{Cases, KernelCase, describe_rounds};
use crate::measure::{clock, cpu_time, measure_interleaved};
use crate::table::{Table, format_ratio};
use muslin::{Cloth, GridDesc, Material, MeshDesc, PinMode, Settings, Stage};
use muslin_plain::{Order, PlainSheet, Size};
use muslin_scenes::HangingSheet;

/// Sweeps per tick: many, so that nearly all time is spent on links.
const SWEEPS: u32 = 16;

/// The largest number of repetitions of a measurement that other processes disturbed.
const MAX_TRIES: u32 = 20;
/// Share of wall time beyond processor time up to which a measurement counts as undisturbed.
const MAX_DISTURBANCE: f64 = 0.02;

/// Membrane and shear stiffness of the links [N/m]; 0 is rigid. Soft links keep a Lagrange
/// multiplier from sweep to sweep. Bend links over two cells are rigid in both: with a lower
/// bending stiffness another stage would do the bending.
const LAWS: [(&str, [f32; 2]); 2] = [("cotton's threads", [2.0e3, 50.0]), ("all rigid", [0.0; 2])];

pub fn print(effort: Effort) {
    let cases = Cases::read().kernels;
    let mut table = Table::new(
        &["sheet", "links"],
        &["by particle", "by kind", "mesh", "grid", "mesh is faster", "grid is faster"],
    );
    for case in &cases {
        for (law, stiffness) in LAWS {
            let rounds = if effort == Effort::Smoke { 1 } else { case.rounds };
            table.push(measure(case, law, stiffness, rounds));
        }
    }
    println!(
        "\nKernels: ns of one thread for a projection of one constraint; minimum, and in \
         brackets median, of {}.\nby particle, by kind: the plain loop over Vec3 with its links \
         in two orders; mesh: the sheet as a triangle mesh; grid: the sheet as a grid.\n\
         faster: than the plain loop by particle and by kind; \
         median of the ratios of the rounds.\n",
        describe_rounds(cases.iter().map(|case| case.rounds))
    );
    println!("{table}");
}

fn measure(case: &KernelCase, law: &str, stiffness: [f32; 2], rounds: u32) -> Vec<String> {
    let (desc, [mut grid, mut mesh]) = cloths(case.side, stiffness);
    let side = desc.columns as usize;
    let size = Size { columns: side, rows: side, spacing: desc.spacing, only_corners: false };
    let mut sheets = [Order::ByParticle, Order::ByKind].map(|order| PlainSheet::hang(size, order));
    let [by_particle, by_kind] = &mut sheets;
    let figures = measure_interleaved(
        rounds,
        [
            &mut || plain_ns(by_particle, desc.settings.tick),
            &mut || plain_ns(by_kind, desc.settings.tick),
            &mut || sweep_ns(&mut mesh, case.ticks),
            &mut || sweep_ns(&mut grid, case.ticks),
        ],
    );
    let mut row = vec![format!("{0} x {0}", case.side), law.into()];
    row.extend(
        figures.iter().map(|samples| format!("{:.2} ({:.2})", samples.min(), samples.median())),
    );
    let [by_particle, by_kind, ours @ ..] = &figures;
    row.extend(ours.iter().map(|samples| {
        format!(
            "{} {}",
            format_ratio(samples.speedup_over(by_particle)),
            format_ratio(samples.speedup_over(by_kind))
        )
    }));
    row
}

/// Runs sweeps of the plain loop over a moving sheet, and returns the time of one projection [ns].
fn plain_ns(sheet: &mut PlainSheet, h: f32) -> f64 {
    sheet.predict(h);
    let spent = cpu_time(|| (0..SWEEPS).for_each(|_| sheet.sweep()));
    1.0e9 * spent / (f64::from(SWEEPS) * sheet.link_count() as f64)
}

/// Returns the descriptor of a sheet, and the sheet as a grid and as a mesh of the same triangles.
fn cloths(side: u32, [membrane, shear]: [f32; 2]) -> (GridDesc, [Cloth; 2]) {
    let mut desc = HangingSheet::desc(side, PinMode::TopEdge);
    // Without tethers there is no line solver either.
    desc.settings =
        Settings { substeps: 1, iterations: SWEEPS, tethers: false, ..Settings::default() };
    desc.material = Material {
        stretch_stiffness_warp: membrane,
        stretch_stiffness_weft: membrane,
        shear_stiffness: shear,
        bend_stiffness: 1.0,
        ..desc.material
    };
    let grid = Cloth::grid(&desc).expect("a grid is valid");
    // In another order: otherwise the mesh would be recognised as the grid.
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
    let mut cloths = [grid, mesh.expect("a mesh is valid")];
    for cloth in &mut cloths {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the wind of the scene is valid");
        cloth.set_clock(Some(clock));
    }
    (desc, cloths)
}

/// Runs ticks, and returns the time of one projection by the clock of the cloth [ns]. That clock
/// also counts the time of other processes, so the least disturbed of several tries is used.
fn sweep_ns(cloth: &mut Cloth, ticks: u32) -> f64 {
    let (mut least_disturbed, mut ns) = (f64::INFINITY, f64::NAN);
    for _ in 0..MAX_TRIES {
        let start = clock();
        let spent = cpu_time(|| cloth.step(ticks));
        let disturbed = (clock() - start) / spent - 1.0;
        if disturbed < least_disturbed {
            let stats = cloth.stats();
            let stage_time = |stage: Stage| f64::from(stats.seconds[stage as usize]);
            let links =
                stage_time(Stage::Stretch) + stage_time(Stage::Shear) + stage_time(Stage::Bend);
            least_disturbed = disturbed;
            ns = 1.0e9 * links / f64::from(ticks * SWEEPS * stats.constraints);
        }
        if disturbed < MAX_DISTURBANCE {
            break;
        }
    }
    ns
}
