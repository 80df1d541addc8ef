//! Table `receipt`: the cost of a tick of the receipt scene with normals, in several situations,
//! and its ratio to real time.

use crate::Effort;
use crate::measure::{cpu_time, measure_interleaved};
use crate::table::{Table, format_number};
use muslin::Cloth;
use muslin::glam::Vec3;
use muslin_scenes::receipt::FULL;
use muslin_scenes::{Sheet, Squeeze};
use std::hint::black_box;

/// Ticks per second.
const RATE: f32 = 120.0;
/// Ticks per round.
const TICKS: u32 = 30;
const ROUNDS: u32 = 15;

/// The situations, one after the other: name, seconds before it is measured, what is done.
const SITUATIONS: [(&str, f32, Action); 5] = [
    ("at rest", 2.0, Action::Nothing),
    ("in wind", 2.0, Action::Wind),
    ("dragged by its hem", 1.0, Action::Drag),
    ("being crumpled", 1.0, Action::Crumple),
    ("crumpled, released, on the floor", 4.0, Action::Nothing),
];

#[derive(Clone, Copy)]
enum Action {
    Nothing,
    Wind,
    Drag,
    Crumple,
}

pub fn print(effort: Effort) {
    let mut table =
        Table::new(&["receipt", "situation"], &["ms per tick", "median", "x real time"]);
    for (name, sheet) in [("links of the brief", Sheet::Brief), ("paper", Sheet::Paper)] {
        let mut cloth = sheet.hang(false).expect("the sheet of the scene is valid");
        for (situation, settle_time, action) in SITUATIONS {
            let mut row = vec![name.into(), situation.into()];
            row.extend(measure(&mut cloth, sheet, settle_time, action, effort));
            table.push(row);
        }
    }
    println!(
        "\nReceipt: ms per tick of 1/{RATE} s on one thread with normals, 40 x 60 particles; \
         the links of the brief with\nparticle collision, paper with surface collision; minimum and \
         median of {ROUNDS} rounds of {TICKS} ticks,\none situation after the other.\n"
    );
    println!("{table}");
}

fn measure(
    cloth: &mut Cloth,
    sheet: Sheet,
    settle_time: f32,
    action: Action,
    effort: Effort,
) -> [String; 3] {
    let (settle_ticks, ticks, rounds) = match effort {
        Effort::Full => ((settle_time * RATE) as u32, TICKS, ROUNDS),
        Effort::Smoke => (2, 1, 1),
    };
    let is_windy = matches!(action, Action::Wind);
    cloth.set_wind(sheet.wind(is_windy)).expect("the wind of the scene is valid");
    let [columns, rows] = FULL;
    let hem = (rows - 1) * columns + columns / 2;
    let grab = matches!(action, Action::Drag).then(|| {
        (cloth.grab_particle(hem).expect("the hem is free"), cloth.positions()[hem as usize])
    });
    let mut squeeze = matches!(action, Action::Crumple).then(|| {
        cloth.unpin_all();
        Squeeze::new(cloth, sheet.unit()).expect("the cloth has room for the palms")
    });
    let mut elapsed = 0.0_f32;
    let mut run = |cloth: &mut Cloth, count: u32| {
        for _ in 0..count {
            elapsed += 1.0 / RATE;
            if let Some((grab, start)) = grab {
                let angle = std::f32::consts::TAU * elapsed / 1.5;
                let displacement =
                    Vec3::new(1.5 * angle.sin(), 1.5 - 1.5 * angle.cos(), (2.0 * angle).sin());
                cloth
                    .move_grab(grab, start + displacement * sheet.unit())
                    .expect("the grab is live");
            }
            // After closing, the palms stay where they are.
            if let Some(squeeze) = &mut squeeze
                && elapsed < Squeeze::CLOSING
            {
                squeeze.tick(1.0 / RATE, cloth).expect("the palms are live");
            }
            cloth.step(1);
            black_box(cloth.view());
        }
    };
    run(cloth, settle_ticks);
    let mut round = || 1.0e3 * cpu_time(|| run(cloth, ticks)) / f64::from(ticks);
    let [times] = measure_interleaved(rounds, [&mut round]);
    if let Some((grab, _)) = grab {
        cloth.release(grab).expect("the grab is live");
    }
    if let Some(squeeze) = squeeze {
        squeeze.release(cloth).expect("the palms are live");
    }
    let real_time = 1.0e3 / f64::from(RATE);
    [
        format_number(times.min(), 3),
        format_number(times.median(), 3),
        format_number(real_time / times.median(), 1),
    ]
}
