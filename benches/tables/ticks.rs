//! What whole ticks cost, normals included, and how the cloth hangs after a while.

use crate::Effort;
use crate::measure::{in_turn, seconds};
use crate::table::{Table, none, number, percent, times};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, Settings};
use muslin_plain::{Order, PlainSheet, Size};
use muslin_scenes::HangingSheet;
use std::hint::black_box;

/// A sheet, and how its time runs.
struct Case {
    columns: u32,
    rows: u32,
    /// `None` for the default.
    settings: Option<Settings>,
    /// For how long it hangs before it is looked at [s].
    seconds: f32,
    /// Whether the plain loop hangs that long too: the large ones take minutes.
    plain_hangs: bool,
    /// Whether there is a floor a little below, as in the brief of the receipt.
    has_floor: bool,
    /// Ticks of a round.
    ticks: u32,
    rounds: u32,
}

const AIRS: [&str; 2] = ["still", "wind"];
const PINS: [(&str, PinMode); 2] =
    [("top edge", PinMode::TopEdge), ("top corners", PinMode::TopCorners)];

fn cases() -> [Case; 5] {
    let default = Settings::default;
    let one_by_six = Settings { substeps: 1, iterations: 6, ..default() };
    let receipt = Settings { tick: 1.0 / 120.0, substeps: 8, iterations: 6, ..default() };
    let sheet = |columns, rows, settings, ticks| Case {
        columns,
        rows,
        settings,
        seconds: 10.0,
        plain_hangs: true,
        has_floor: false,
        ticks,
        rounds: 15,
    };
    [
        sheet(40, 40, Some(one_by_six), 8),
        sheet(40, 40, None, 8),
        Case { has_floor: true, ..sheet(40, 60, Some(receipt), 2) },
        sheet(128, 128, None, 2),
        Case { seconds: 3.0, plain_hangs: false, rounds: 7, ..sheet(256, 256, None, 1) },
    ]
}

pub fn print(effort: Effort) {
    let mut table = Table::new(
        &["sheet", "tick", "sweeps", "pinned by", "air"],
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
    for case in cases() {
        let case = match effort {
            Effort::Timed => case,
            Effort::Once => Case { seconds: 0.0, ticks: 1, rounds: 1, ..case },
        };
        for (pinned_by, pin_mode) in PINS {
            for air in AIRS {
                table.push(measure(&case, pinned_by, pin_mode, air));
            }
        }
    }
    println!(
        "\nTicks: ms of one thread for a whole tick with normals, after the sheet hung for a while; \
         least and median of {} to {} rounds in turn.\nplain: Verlet, the natural-order loop with as \
         many sweeps, normals; it knows neither \
         wind nor floor. Stretch is that of the threads.\n",
        cases()[4].rounds,
        cases()[0].rounds
    );
    println!("{table}");
}

fn measure(case: &Case, pinned_by: &str, pin_mode: PinMode, air: &str) -> Vec<String> {
    let desc = case.desc(pin_mode);
    let mut cloth = Cloth::grid(&desc).expect("a grid of the benchmark's own");
    if case.has_floor {
        cloth.add_collider(&case.floor(&desc)).expect("a floor of the benchmark's own");
    }
    let settings = &desc.settings;
    let mut sheet = PlainSheet::hang(case.plain_size(&desc), Order::ByParticle);
    let is_still = air == "still";
    if !is_still {
        cloth.set_wind(HangingSheet::wind(2.0)).expect("the scene's own wind");
    }
    let ticks = (case.seconds / settings.tick).round() as u32;
    cloth.step(ticks);
    let (stats, speed) = (cloth.stats(), rms_speed(&cloth));
    let plain_tick =
        |sheet: &mut PlainSheet| sheet.tick(settings.tick, settings.substeps, settings.iterations);
    let plain_stretch = if is_still && case.plain_hangs {
        (0..ticks).for_each(|_| plain_tick(&mut sheet));
        percent(sheet.max_stretch())
    } else {
        none()
    };

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
    let mut plain = || a_tick * seconds(|| (0..case.ticks).for_each(|_| plain_tick(&mut sheet)));
    let projections = f64::from(settings.substeps * settings.iterations * stats.constraints);
    let (ours, beside) = if is_still {
        let [ours, plain] = in_turn(case.rounds, [&mut ours, &mut plain]);
        let beside = [number(plain.min(), 3), times(ours.times_below(&plain))];
        (ours, beside)
    } else {
        let [ours] = in_turn(case.rounds, [&mut ours]);
        (ours, [none(), none()])
    };
    let floor = if case.has_floor { ", floor" } else { "" };
    let mut row = vec![
        format!("{} x {}{floor}", desc.columns, desc.rows),
        format!("1/{:.0} s", 1.0 / settings.tick),
        format!("{} x {}", settings.substeps, settings.iterations),
        pinned_by.into(),
        air.into(),
        number(ours.min(), 3),
        number(ours.median(), 3),
        number(1.0e6 * ours.min() / projections, 2),
        number(1.0e3 * f64::from(settings.tick) / ours.median(), 1),
    ];
    row.extend(beside);
    row.extend([
        format!("{} s", case.seconds),
        percent(stats.max_stretch),
        percent(stats.mean_stretch),
        plain_stretch,
        number(1.0e3 * speed, 2),
    ]);
    row
}

impl Case {
    fn desc(&self, pin_mode: PinMode) -> GridDesc {
        let sheet = HangingSheet::desc(self.columns, pin_mode);
        let settings = self.settings.clone().unwrap_or_default();
        GridDesc { rows: self.rows, settings, ..sheet }
    }

    /// A floor under the sheet, by a twentieth of its length.
    fn floor(&self, desc: &GridDesc) -> ColliderDesc {
        let length = desc.spacing * (self.rows - 1) as f32;
        let position = desc.origin - Vec3::Y * (1.05 * length);
        ColliderDesc { position, ..ColliderDesc::default() }
    }

    fn plain_size(&self, desc: &GridDesc) -> Size {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let by_corners = desc.pin_mode == PinMode::TopCorners;
        Size { columns, rows, spacing: desc.spacing, by_corners }
    }
}

/// Root of the mean square speed of the particles [m/s].
fn rms_speed(cloth: &Cloth) -> f64 {
    let count = cloth.positions().len();
    let squares = (0..count as u32).filter_map(|particle| cloth.velocity(particle));
    let sum: f64 = squares.map(|v| f64::from(v.length_squared())).sum();
    (sum / count as f64).sqrt()
}
