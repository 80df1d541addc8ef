//! What whole ticks cost, normals included, and how the cloth hangs after a while.

use crate::Effort;
use crate::cases::{Cases, TickCase, rounds};
#[cfg(feature = "parallel")]
use crate::measure::wall_seconds;
use crate::measure::{in_turn, seconds};
use crate::table::{Table, none, number, percent, times};
#[cfg(feature = "parallel")]
use muslin::MeshDesc;
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode};
use muslin_plain::{Order, PlainSheet, Size};
use muslin_scenes::HangingSheet;
use std::hint::black_box;

/// Ways to hang: by what, and whether there is wind.
const WAYS: [(&str, PinMode, bool); 4] = [
    ("top edge", PinMode::TopEdge, false),
    ("top edge, wind", PinMode::TopEdge, true),
    ("top corners", PinMode::TopCorners, false),
    ("top corners, wind", PinMode::TopCorners, true),
];

pub fn print(effort: Effort) {
    let cases = Cases::read().ticks;
    let mut table = Table::new(
        &["sheet", "tick", "sweeps", "hung by"],
        &[
            "ms a tick",
            "median",
            "ns a projection",
            "x real time",
            "plain ms",
            "faster",
            "hung for",
            "max stretch",
            "mean",
            "plain's max",
            "rms mm/s",
        ],
    );
    let said = rounds(cases.iter().map(|case| case.rounds));
    for mut case in cases {
        if effort == Effort::Once {
            case = TickCase { seconds: 2.0 * case.settings.tick, ticks: 1, rounds: 1, ..case };
        }
        for (hung_by, pin_mode, is_windy) in WAYS {
            table.push(measure(&case, hung_by, pin_mode, is_windy));
        }
    }
    println!(
        "\nTicks: ms of one thread for a whole tick with normals, after the sheet hung for a while; \
         least and median of {said}.\nplain: Verlet, the natural-order loop by kind (the faster order, \
         and by particle it does not come to rest) with as many sweeps, normals; no wind, no floor.\n\
         x real time and faster: by medians. Stretch is that of the threads.\n"
    );
    println!("{table}");
    #[cfg(feature = "parallel")]
    print_threads(effort);
}

/// Whole ticks of large sheets on one thread and on two.
#[cfg(feature = "parallel")]
fn print_threads(effort: Effort) {
    let cases = Cases::read().threads;
    let mut table =
        Table::new(&["sheet", "woven as", "hung by"], &["one thread", "two", "faster", "median"]);
    let said = rounds(cases.iter().map(|case| case.rounds));
    for mut case in cases {
        if effort == Effort::Once {
            case = TickCase { seconds: 2.0 * case.settings.tick, ticks: 1, rounds: 1, ..case };
        }
        for (hung_by, pin_mode, is_windy) in WAYS {
            for is_grid in [true, false] {
                table.push(measure_threads(&case, is_grid, hung_by, pin_mode, is_windy));
            }
        }
    }
    println!(
        "\nThreads: ms of wall time for a whole tick with normals, on one thread and on two; least of \
         {said}.\nfaster: by the least, and by the median of the rounds' ratios. Here a busy machine is \
         in the figures.\n"
    );
    println!("{table}");
}

#[cfg(feature = "parallel")]
fn measure_threads(
    case: &TickCase,
    is_grid: bool,
    hung_by: &str,
    pin_mode: PinMode,
    is_windy: bool,
) -> Vec<String> {
    let desc = case.desc(pin_mode);
    let grid = Cloth::grid(&desc).expect("a grid of the benchmark's own");
    let mut cloth = if is_grid { grid } else { as_mesh(&desc, &grid) };
    if is_windy {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the scene's own wind");
    }
    cloth.step((case.seconds / desc.settings.tick).round() as u32);
    let mut cloths = [1, 2].map(|threads| {
        let mut copy = cloth.clone();
        copy.set_threads(threads).expect("there is one at least");
        copy
    });
    let a_tick = 1.0e3 / f64::from(case.ticks);
    let [one, two] = cloths.each_mut().map(|cloth| {
        move || {
            a_tick
                * wall_seconds(|| {
                    for _ in 0..case.ticks {
                        cloth.step(1);
                        black_box(cloth.view());
                    }
                })
        }
    });
    let (mut one, mut two) = (one, two);
    let [one, two] = in_turn(case.rounds, [&mut one, &mut two]);
    let [on_one, on_two] = cloths.map(|cloth| cloth.state_hash());
    assert_eq!(on_one, on_two, "threads change no bit");
    vec![
        format!("{} x {}", desc.columns, desc.rows),
        if is_grid { "grid" } else { "mesh" }.into(),
        hung_by.into(),
        number(one.min(), 3),
        number(two.min(), 3),
        times(one.min() / two.min()),
        times(two.times_below(&one)),
    ]
}

/// The same triangles as any mesh.
#[cfg(feature = "parallel")]
fn as_mesh(desc: &GridDesc, grid: &Cloth) -> Cloth {
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
    mesh.expect("a mesh of the benchmark's own")
}

fn measure(case: &TickCase, hung_by: &str, pin_mode: PinMode, is_windy: bool) -> Vec<String> {
    let desc = case.desc(pin_mode);
    let mut cloth = Cloth::grid(&desc).expect("a grid of the benchmark's own");
    if case.floor {
        cloth.add_collider(&floor_below(&desc)).expect("a floor of the benchmark's own");
    }
    if is_windy {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the scene's own wind");
    }
    let settings = &desc.settings;
    let ticks = (case.seconds / settings.tick).round() as u32;
    cloth.step(ticks);
    let (stats, speed) = (cloth.stats(), rms_speed(&cloth));

    let a_tick = 1.0e3 / f64::from(case.ticks);
    let mut ours = || {
        a_tick
            * seconds(|| {
                for _ in 0..case.ticks {
                    cloth.step(1);
                    black_box(cloth.view());
                }
            })
    };
    let (ours, beside, plain_stretch) = if is_windy {
        let [ours] = in_turn(case.rounds, [&mut ours]);
        (ours, [none(), none()], none())
    } else {
        let mut sheet = PlainSheet::hang(plain_size(&desc), Order::ByKind);
        let run = |sheet: &mut PlainSheet, ticks: u32| {
            for _ in 0..ticks {
                sheet.tick(settings.tick, settings.substeps, settings.iterations);
            }
        };
        run(&mut sheet, ticks);
        let plain_stretch = percent(sheet.max_stretch());
        let mut plain = || a_tick * seconds(|| run(&mut sheet, case.ticks));
        let [ours, plain] = in_turn(case.rounds, [&mut ours, &mut plain]);
        let beside = [number(plain.min(), 3), times(ours.times_below(&plain))];
        (ours, beside, plain_stretch)
    };

    let projections = f64::from(settings.substeps * settings.iterations * stats.constraints);
    let floor = if case.floor { ", floor" } else { "" };
    let mut row = vec![
        format!("{} x {}{floor}", desc.columns, desc.rows),
        format!("1/{:.0} s", 1.0 / settings.tick),
        format!("{} x {}", settings.substeps, settings.iterations),
        hung_by.into(),
        number(ours.min(), 3),
        number(ours.median(), 3),
        number(1.0e6 * ours.min() / projections, 2),
        number(1.0e3 * f64::from(settings.tick) / ours.median(), 1),
    ];
    row.extend(beside);
    row.extend([
        format!("{:.1} s", case.seconds),
        percent(stats.max_stretch),
        percent(stats.mean_stretch),
        plain_stretch,
        number(1.0e3 * speed, 2),
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

/// A floor under the sheet, by a twentieth of its length.
fn floor_below(desc: &GridDesc) -> ColliderDesc {
    let length = desc.spacing * (desc.rows - 1) as f32;
    ColliderDesc { position: desc.origin - Vec3::Y * (1.05 * length), ..ColliderDesc::default() }
}

fn plain_size(desc: &GridDesc) -> Size {
    Size {
        columns: desc.columns as usize,
        rows: desc.rows as usize,
        spacing: desc.spacing,
        by_corners: desc.pin_mode == PinMode::TopCorners,
    }
}

/// Root of the mean square speed of the particles [m/s].
fn rms_speed(cloth: &Cloth) -> f64 {
    let count = cloth.positions().len();
    let squares = (0..count as u32).filter_map(|particle| cloth.velocity(particle));
    let sum: f64 = squares.map(|v| f64::from(v.length_squared())).sum();
    (sum / count as f64).sqrt()
}
