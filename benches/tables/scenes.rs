//! Table `scenes`: the cost of a tick of each scene of the demo, normals included.

use crate::Effort;
use crate::measure::{cpu_time, measure_interleaved};
use crate::table::{Table, format_number};
use muslin::Cloth;
use muslin_scenes::{Curtain, Drapes, Flag, HangingSheet, Scene, SceneInstance, SheetOnBall};
use std::hint::black_box;

/// Ticks before a scene is measured.
const SETTLE_TICKS: u32 = 300;
/// Ticks per round.
const TICKS: u32 = 60;
const ROUNDS: u32 = 15;

pub fn print(effort: Effort) {
    let mut table = Table::new(&["scene"], &["particles", "constraints", "ms per tick", "median"]);
    table.push(measure::<HangingSheet>(effort));
    table.push(measure::<Flag>(effort));
    table.push(measure::<SheetOnBall>(effort));
    table.push(measure::<Drapes>(effort));
    table.push(measure::<Curtain>(effort));
    println!(
        "\nScenes: ms per tick on one thread with normals, after {SETTLE_TICKS} ticks; minimum and \
         median of {ROUNDS} rounds of {TICKS} ticks.\n"
    );
    println!("{table}");
}

fn measure<S: Scene>(effort: Effort) -> Vec<String> {
    let (settle_ticks, ticks, rounds) = match effort {
        Effort::Full => (SETTLE_TICKS, TICKS, ROUNDS),
        Effort::Smoke => (2, 1, 1),
    };
    let mut instance = S::build();
    instance.step(settle_ticks);
    let stats = instance.cloths.iter().map(Cloth::stats);
    let count = stats.map(|stats| [stats.particles, stats.active_constraints]);
    let [particles, constraints] =
        count.fold([0, 0], |sum, count| [sum[0] + count[0], sum[1] + count[1]]);
    let mut round = || time_per_tick(&mut instance, ticks);
    let [times] = measure_interleaved(rounds, [&mut round]);
    vec![
        S::NAME.into(),
        particles.to_string(),
        constraints.to_string(),
        format_number(times.min(), 3),
        format_number(times.median(), 3),
    ]
}

/// Runs ticks, and returns the time per tick [ms].
fn time_per_tick(instance: &mut SceneInstance, ticks: u32) -> f64 {
    let spent = cpu_time(|| {
        for _ in 0..ticks {
            instance.step(1);
            for cloth in &mut instance.cloths {
                black_box(cloth.view());
            }
        }
    });
    1.0e3 * spent / f64::from(ticks)
}
