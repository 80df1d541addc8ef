//! Table `ticks`: the cost of whole ticks with normals, and the stretch and speed of the cloth
//! after a while. With feature `parallel` also a table of one and two threads.

use crate::Effort;
use crate::cases::{Cases, TickCase, describe_rounds};
#[cfg(feature = "parallel")]
use crate::measure::wall_time;
use crate::measure::{cpu_time, measure_interleaved};
use crate::table::{Table, format_number, format_percent, format_ratio, no_value};
#[cfg(feature = "parallel")]
use muslin::MeshDesc;
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode};
use muslin_plain::{Order, PlainSheet, Size};
use muslin_scenes::HangingSheet;
use std::hint::black_box;

/// Variants of each case: name, pins, whether there is wind.
const VARIANTS: [(&str, PinMode, bool); 4] = [
    ("top edge", PinMode::TopEdge, false),
    ("top edge, wind", PinMode::TopEdge, true),
    ("top corners", PinMode::TopCorners, false),
    ("top corners, wind", PinMode::TopCorners, true),
];

pub fn print(effort: Effort) {
    let cases = Cases::read().ticks;
    let mut table = Table::new(
        &["sheet", "tick", "sweeps", "pins"],
        &[
            "ms per tick",
            "median",
            "ns per projection",
            "x real time",
            "plain ms",
            "faster",
            "simulated",
            "max stretch",
            "mean",
            "plain max",
            "rms mm/s",
        ],
    );
    let rounds = describe_rounds(cases.iter().map(|case| case.rounds));
    for mut case in cases {
        if effort == Effort::Smoke {
            case = TickCase { seconds: 2.0 * case.settings.tick, ticks: 1, rounds: 1, ..case };
        }
        for (pins, pin_mode, is_windy) in VARIANTS {
            table.push(measure(&case, pins, pin_mode, is_windy));
        }
    }
    println!(
        "\nTicks: ms per tick on one thread with normals, after the simulated time; \
         minimum and median of {rounds}.\nplain: Verlet with the plain loop by kind \
         (the faster order; by particle it does not come to rest), as many sweeps, normals; no wind, no floor.\n\
         x real time, faster: from medians. Stretch is that of the stretch links.\n"
    );
    println!("{table}");
    #[cfg(feature = "parallel")]
    print_threads(effort);
}

/// Prints the table of whole ticks of large sheets on one and on two threads.
#[cfg(feature = "parallel")]
fn print_threads(effort: Effort) {
    let cases = Cases::read().threads;
    let mut table =
        Table::new(&["sheet", "as", "pins"], &["one thread", "two", "faster", "median"]);
    let rounds = describe_rounds(cases.iter().map(|case| case.rounds));
    for mut case in cases {
        if effort == Effort::Smoke {
            case = TickCase { seconds: 2.0 * case.settings.tick, ticks: 1, rounds: 1, ..case };
        }
        for (pins, pin_mode, is_windy) in VARIANTS {
            for is_grid in [true, false] {
                table.push(measure_threads(&case, is_grid, pins, pin_mode, is_windy));
            }
        }
    }
    println!(
        "\nThreads: ms of wall time per tick with normals, on one and on two threads; minimum of \
         {rounds}.\nfaster: from minima, and median of the ratios of the rounds. \
         Wall time includes other processes.\n"
    );
    println!("{table}");
}

#[cfg(feature = "parallel")]
fn measure_threads(
    case: &TickCase,
    is_grid: bool,
    pins: &str,
    pin_mode: PinMode,
    is_windy: bool,
) -> Vec<String> {
    let desc = case.desc(pin_mode);
    let grid = Cloth::grid(&desc).expect("a grid is valid");
    let mut cloth = if is_grid { grid } else { as_mesh(&desc, &grid) };
    if is_windy {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the wind of the scene is valid");
    }
    cloth.step((case.seconds / desc.settings.tick).round() as u32);
    let mut cloths = [1, 2].map(|threads| {
        let mut copy = cloth.clone();
        copy.set_threads(threads).expect("1 and 2 are valid numbers of threads");
        copy
    });
    let ms_per_tick = 1.0e3 / f64::from(case.ticks);
    let [one, two] = cloths.each_mut().map(|cloth| {
        move || {
            ms_per_tick
                * wall_time(|| {
                    for _ in 0..case.ticks {
                        cloth.step(1);
                        black_box(cloth.view());
                    }
                })
        }
    });
    let (mut one, mut two) = (one, two);
    let [one, two] = measure_interleaved(case.rounds, [&mut one, &mut two]);
    let [hash_one, hash_two] = cloths.map(|cloth| cloth.state_hash());
    assert_eq!(hash_one, hash_two, "the number of threads changed the state");
    vec![
        format!("{} x {}", desc.columns, desc.rows),
        if is_grid { "grid" } else { "mesh" }.into(),
        pins.into(),
        format_number(one.min(), 3),
        format_number(two.min(), 3),
        format_ratio(one.min() / two.min()),
        format_ratio(two.speedup_over(&one)),
    ]
}

/// Returns the same sheet as a triangle mesh.
#[cfg(feature = "parallel")]
fn as_mesh(desc: &GridDesc, grid: &Cloth) -> Cloth {
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
    mesh.expect("a mesh is valid")
}

fn measure(case: &TickCase, pins: &str, pin_mode: PinMode, is_windy: bool) -> Vec<String> {
    let desc = case.desc(pin_mode);
    let mut cloth = Cloth::grid(&desc).expect("a grid is valid");
    if case.floor {
        cloth.add_collider(&floor_below(&desc)).expect("a floor is valid");
    }
    if is_windy {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the wind of the scene is valid");
    }
    let settings = &desc.settings;
    let ticks = (case.seconds / settings.tick).round() as u32;
    cloth.step(ticks);
    let (stats, speed) = (cloth.stats(), rms_speed(&cloth));

    let ms_per_tick = 1.0e3 / f64::from(case.ticks);
    let mut run_muslin = || {
        ms_per_tick
            * cpu_time(|| {
                for _ in 0..case.ticks {
                    cloth.step(1);
                    black_box(cloth.view());
                }
            })
    };
    let (muslin, plain_cells, plain_stretch) = if is_windy {
        let [muslin] = measure_interleaved(case.rounds, [&mut run_muslin]);
        (muslin, [no_value(), no_value()], no_value())
    } else {
        let mut sheet = PlainSheet::hang(plain_size(&desc), Order::ByKind);
        let run = |sheet: &mut PlainSheet, ticks: u32| {
            for _ in 0..ticks {
                sheet.tick(settings.tick, settings.substeps, settings.iterations);
            }
        };
        run(&mut sheet, ticks);
        let plain_stretch = format_percent(sheet.max_stretch());
        let mut run_plain = || ms_per_tick * cpu_time(|| run(&mut sheet, case.ticks));
        let [muslin, plain] = measure_interleaved(case.rounds, [&mut run_muslin, &mut run_plain]);
        let plain_cells =
            [format_number(plain.min(), 3), format_ratio(muslin.speedup_over(&plain))];
        (muslin, plain_cells, plain_stretch)
    };

    let projections = f64::from(settings.substeps * settings.iterations * stats.constraints);
    let floor = if case.floor { ", floor" } else { "" };
    let mut row = vec![
        format!("{} x {}{floor}", desc.columns, desc.rows),
        format!("1/{:.0} s", 1.0 / settings.tick),
        format!("{} x {}", settings.substeps, settings.iterations),
        pins.into(),
        format_number(muslin.min(), 3),
        format_number(muslin.median(), 3),
        format_number(1.0e6 * muslin.min() / projections, 2),
        format_number(1.0e3 * f64::from(settings.tick) / muslin.median(), 1),
    ];
    row.extend(plain_cells);
    row.extend([
        format!("{:.1} s", case.seconds),
        format_percent(stats.max_stretch),
        format_percent(stats.mean_stretch),
        plain_stretch,
        format_number(1.0e3 * speed, 2),
    ]);
    row
}

impl TickCase {
    fn desc(&self, pin_mode: PinMode) -> GridDesc {
        let sheet = HangingSheet::desc(self.columns, pin_mode);
        let spacing = self.spacing.unwrap_or(sheet.spacing);
        GridDesc { rows: self.rows, spacing, settings: self.settings.clone(), ..sheet }
    }
}

/// Returns a floor below the sheet, at a distance of a twentieth of its length.
fn floor_below(desc: &GridDesc) -> ColliderDesc {
    let length = desc.spacing * (desc.rows - 1) as f32;
    ColliderDesc { position: desc.origin - Vec3::Y * (1.05 * length), ..ColliderDesc::default() }
}

fn plain_size(desc: &GridDesc) -> Size {
    Size {
        columns: desc.columns as usize,
        rows: desc.rows as usize,
        spacing: desc.spacing,
        only_corners: desc.pin_mode == PinMode::TopCorners,
    }
}

/// Returns the root mean square speed of the particles [m/s].
fn rms_speed(cloth: &Cloth) -> f64 {
    let count = cloth.positions().len();
    let squares = (0..count as u32).filter_map(|particle| cloth.velocity(particle));
    let sum: f64 = squares.map(|v| f64::from(v.length_squared())).sum();
    (sum / count as f64).sqrt()
}
