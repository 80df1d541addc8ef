//! What a tick of the receipt costs, normals included, in all that hands and wind do to it, against real time.

use crate::Effort;
use crate::measure::{in_turn, seconds};
use crate::table::{Table, number};
use muslin::Cloth;
use muslin::glam::Vec3;
use muslin_scenes::receipt::FULL;
use muslin_scenes::{Sheet, Squeeze};
use std::hint::black_box;

/// Ticks a second.
const RATE: f32 = 120.0;
/// Ticks in a round, and rounds.
const TICKS: u32 = 30;
const ROUNDS: u32 = 15;

/// One after the other: seconds before it is timed, and what happens to it.
const STATES: [(&str, f32, Deed); 5] = [
    ("at rest", 2.0, Deed::Nothing),
    ("in wind", 2.0, Deed::Wind),
    ("dragged about by its hem", 1.0, Deed::Drag),
    ("crumpled in a fist", 1.0, Deed::Fist),
    ("crumpled, let go, on the floor", 4.0, Deed::Nothing),
];

#[derive(Clone, Copy)]
enum Deed {
    Nothing,
    Wind,
    Drag,
    Fist,
}

pub fn print(effort: Effort) {
    let mut table =
        Table::new(&["receipt", "what it does"], &["ms a tick", "median", "x real time"]);
    for (name, sheet) in [("the brief's links", Sheet::Brief), ("paper", Sheet::Paper)] {
        let mut cloth = sheet.hang(false).expect("the scene's own sheet");
        for (what, settles, deed) in STATES {
            let mut row = vec![name.into(), what.into()];
            row.extend(measure(&mut cloth, sheet, settles, deed, effort));
            table.push(row);
        }
    }
    println!(
        "\nReceipt: ms of one thread for a whole tick of 1/{RATE} s with normals, of 40 x 60 particles, where the \
         brief's push each other\napart and paper keeps from itself by its surface; least and median of \
         {ROUNDS} rounds of {TICKS} ticks,\none state after the other.\n"
    );
    println!("{table}");
}

fn measure(
    cloth: &mut Cloth,
    sheet: Sheet,
    settles: f32,
    deed: Deed,
    effort: Effort,
) -> [String; 3] {
    let (settled, ticks, rounds) = match effort {
        Effort::Timed => ((settles * RATE) as u32, TICKS, ROUNDS),
        Effort::Once => (2, 1, 1),
    };
    let blows = matches!(deed, Deed::Wind);
    cloth.set_wind(sheet.wind(blows)).expect("the scene's own wind");
    let [columns, rows] = FULL;
    let hem = (rows - 1) * columns + columns / 2;
    let grab = matches!(deed, Deed::Drag)
        .then(|| (cloth.grab_particle(hem).expect("it hangs"), cloth.positions()[hem as usize]));
    let mut fist = matches!(deed, Deed::Fist).then(|| {
        cloth.unpin_all();
        Squeeze::new(cloth, sheet.unit()).expect("no hand holds it")
    });
    let mut seconds_gone = 0.0_f32;
    let mut run = |cloth: &mut Cloth, count: u32| {
        for _ in 0..count {
            seconds_gone += 1.0 / RATE;
            if let Some((grab, from)) = grab {
                let turned = std::f32::consts::TAU * seconds_gone / 1.5;
                let way =
                    Vec3::new(1.5 * turned.sin(), 1.5 - 1.5 * turned.cos(), (2.0 * turned).sin());
                cloth.move_grab(grab, from + way * sheet.unit()).expect("it holds");
            }
            // Closed, the fingers only stay where they are.
            if let Some(fist) = &mut fist
                && seconds_gone < Squeeze::CLOSING
            {
                fist.tick(1.0 / RATE, cloth).expect("it holds");
            }
            cloth.step(1);
            black_box(cloth.view());
        }
    };
    run(cloth, settled);
    let mut round = || 1.0e3 * seconds(|| run(cloth, ticks)) / f64::from(ticks);
    let [times] = in_turn(rounds, [&mut round]);
    if let Some((grab, _)) = grab {
        cloth.release(grab).expect("it holds");
    }
    if let Some(fist) = fist {
        fist.release(cloth).expect("it holds");
    }
    let real = 1.0e3 / f64::from(RATE);
    [number(times.min(), 3), number(times.median(), 3), number(real / times.median(), 1)]
}
