//! Table `crowd`: what many small cloths cost per frame, asleep and in the wind, each by its own
//! `advance` and all by one `advance_many`.

use crate::Effort;
use crate::measure::clock;
use crate::table::{Table, format_number};
use muslin::glam::Vec3;
use muslin::{Cloth, GridDesc, Settings, Wind};
use std::hint::black_box;

const SIDE: u32 = 16;
const FRAME: f32 = 1.0 / 60.0;

pub fn print(effort: Effort) {
    let (sleeping, moving, rounds) =
        if effort == Effort::Smoke { (100, 10, 1) } else { (10_000, 1_000, 21) };
    let mut table = Table::new(
        &["cloths", "state"],
        &["separate ms", "one call ms", "on all threads ms", "ns per cloth"],
    );
    let asleep = sleeping_sheet();
    let bytes = asleep.stats().bytes;
    table.push(measure(vec![asleep; sleeping], "asleep", rounds));
    table.push(measure(vec![sheet_in_wind(); moving], "in the wind", rounds));
    println!(
        "\nCrowd: ms per frame of 1/60 s for all cloths of {SIDE} x {SIDE}, without normals; \
         wall time, minimum of {rounds} interleaved rounds.\n\
         separate: each by its own `advance`; one call: `advance_many` on one thread, of which the \
         last column is the share of one cloth.\nA cloth takes {} kB.\n",
        bytes / 1000
    );
    println!("{table}");
}

fn measure(mut cloths: Vec<Cloth>, state: &str, rounds: u32) -> Vec<String> {
    let count = cloths.len();
    let pools = [1, 0].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads are started")
    });
    let mut times = [const { Vec::new() }; 3];
    let mut frame = |way: usize| {
        let start = clock();
        match way {
            0 => cloths.iter_mut().for_each(|cloth| {
                black_box(cloth.advance(FRAME)).expect("the time is valid");
            }),
            _ => pools[way - 1].install(|| {
                black_box(Cloth::advance_many(&mut cloths, FRAME)).expect("the time is valid");
            }),
        }
        1.0e3 * (clock() - start)
    };
    for _ in 0..=rounds {
        for (way, times) in times.iter_mut().enumerate() {
            times.push(frame(way));
        }
    }
    // The first round warms up.
    let [separate, one, all] =
        times.map(|times| times[1..].iter().copied().fold(f64::MAX, f64::min));
    vec![
        count.to_string(),
        state.into(),
        format_number(separate, 2),
        format_number(one, 2),
        format_number(all, 2),
        format_number(1.0e6 * one / count as f64, 0),
    ]
}

fn sheet(settings: Settings) -> Cloth {
    let spacing = 1.0 / (SIDE - 1) as f32;
    let desc = GridDesc { columns: SIDE, rows: SIDE, spacing, settings, ..GridDesc::default() };
    Cloth::grid(&desc).expect("a grid is valid")
}

fn sleeping_sheet() -> Cloth {
    let mut cloth = sheet(Settings { sleep_speed: 0.01, ..Settings::default() });
    cloth.step(120);
    assert!(cloth.is_asleep(), "a hanging sheet sleeps after a second");
    cloth
}

fn sheet_in_wind() -> Cloth {
    let mut cloth = sheet(Settings::default());
    let wind = Wind { velocity: Vec3::Z * 3.0, gust: 0.5, ..Wind::default() };
    cloth.set_wind(wind).expect("the wind is valid");
    cloth.step(60);
    cloth
}
