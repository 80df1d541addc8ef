//! What a tick of each of the demo's scenes costs, normals included.

use crate::Effort;
use crate::measure::{in_turn, seconds};
use crate::table::{Table, number};
use muslin::Cloth;
use muslin_scenes::{Curtain, Drapes, Flag, HangingSheet, Scene, SceneInstance, SheetOnBall};
use std::hint::black_box;

/// Ticks until a scene is itself.
const SETTLED: u32 = 300;
/// Ticks in a round, and rounds.
const TICKS: u32 = 60;
const ROUNDS: u32 = 15;

pub fn print(effort: Effort) {
    let mut table = Table::new(&["scene"], &["particles", "constraints", "ms a tick", "median"]);
    table.push(row::<HangingSheet>(effort));
    table.push(row::<Flag>(effort));
    table.push(row::<SheetOnBall>(effort));
    table.push(row::<Drapes>(effort));
    table.push(row::<Curtain>(effort));
    println!(
        "\nScenes: ms of one thread for a whole tick with normals, after {SETTLED} ticks; least and \
         median of {ROUNDS} rounds of {TICKS} ticks.\n"
    );
    println!("{table}");
}

fn row<S: Scene>(effort: Effort) -> Vec<String> {
    let (settled, ticks, rounds) = match effort {
        Effort::Timed => (SETTLED, TICKS, ROUNDS),
        Effort::Once => (2, 1, 1),
    };
    let mut cast = S::build();
    cast.step(settled);
    let stats = cast.cloths.iter().map(Cloth::stats);
    let count = stats.map(|stats| [stats.particles, stats.active_constraints]);
    let [particles, constraints] =
        count.fold([0, 0], |sum, count| [sum[0] + count[0], sum[1] + count[1]]);
    let mut round = || round(&mut cast, ticks);
    let [times] = in_turn(rounds, [&mut round]);
    vec![
        S::NAME.into(),
        particles.to_string(),
        constraints.to_string(),
        number(times.min(), 3),
        number(times.median(), 3),
    ]
}

/// Milliseconds of a tick.
fn round(cast: &mut SceneInstance, ticks: u32) -> f64 {
    let spent = seconds(|| {
        for _ in 0..ticks {
            cast.step(1);
            for cloth in &mut cast.cloths {
                black_box(cloth.view());
            }
        }
    });
    1.0e3 * spent / f64::from(ticks)
}
