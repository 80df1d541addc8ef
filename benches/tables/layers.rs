//! What collision of a cloth with itself, by particles and by its surface, adds to a tick.

use crate::Effort;
use crate::measure::seconds;
use crate::table::{Table, number, times};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision, Settings, Shape};
use std::hint::black_box;

/// A sheet that falls on a floor, or on a ball on it.
struct Fall {
    name: &'static str,
    columns: u32,
    rows: u32,
    spacing: f32,
    down: Vec3,
    /// The height that it hangs at before it falls [m].
    height: f32,
    /// The radius of a ball under its middle, which stands on the floor [m]; 0 for none.
    ball: f32,
    settings: fn() -> Settings,
    /// The parts of the fall that are measured, in ticks.
    parts: [(&'static str, u32, u32); 2],
}

const FALLS: [Fall; 4] = [
    Fall {
        name: "64 x 64 on a ball",
        columns: 64,
        rows: 64,
        spacing: 1.0 / 64.0,
        down: Vec3::Z,
        height: 0.6,
        ball: 0.25,
        settings: Settings::default,
        parts: [("falling and draping", 0, 60), ("coming to rest", 60, 300)],
    },
    Fall {
        name: "64 x 64 on its side",
        columns: 64,
        rows: 64,
        spacing: 1.0 / 64.0,
        down: Vec3::new(0.0, -0.5, 0.866),
        height: 0.6,
        ball: 0.0,
        settings: Settings::default,
        parts: [("falling and landing", 0, 40), ("lying", 100, 140)],
    },
    Fall {
        name: "64 x 64 on its edge",
        columns: 64,
        rows: 64,
        spacing: 1.0 / 64.0,
        down: Vec3::NEG_Y,
        height: 1.02,
        ball: 0.0,
        settings: Settings::default,
        parts: [("crumpling", 0, 40), ("lying", 200, 220)],
    },
    Fall {
        name: "receipt",
        columns: 40,
        rows: 60,
        spacing: 0.12,
        down: Vec3::NEG_Y,
        height: 7.6,
        ball: 0.0,
        settings: || Settings {
            tick: 1.0 / 120.0,
            substeps: 8,
            iterations: 6,
            ..Settings::default()
        },
        parts: [("falling", 0, 30), ("crumpling", 60, 120)],
    },
];

pub fn print(effort: Effort) {
    let mut table = Table::new(
        &["sheet", "part"],
        &["without ms", "particles ms", "adds", "surface ms", "adds"],
    );
    for fall in FALLS {
        let [without, particles, surface] =
            [SelfCollision::None, SelfCollision::Particles, SelfCollision::Surface]
                .map(|way| fall.measure(way, effort));
        for (at, (part, ..)) in fall.parts.iter().enumerate() {
            let adds = |with: f64| times((with - without[at]) / without[at]);
            table.push(vec![
                fall.name.into(),
                (*part).into(),
                number(without[at], 3),
                number(particles[at], 3),
                adds(particles[at]),
                number(surface[at], 3),
                adds(surface[at]),
            ]);
        }
    }
    println!(
        "\nLayers: ms of one thread for a whole tick, a mean over part of a fall; what collision of the cloth \
         with itself adds, as a multiple of the tick without.\n"
    );
    println!("{table}");
}

impl Fall {
    /// Milliseconds of a tick in each part.
    fn measure(&self, self_collision: SelfCollision, effort: Effort) -> [f64; 2] {
        let mut cloth = self.build(self_collision);
        let mut tick = 0;
        self.parts.map(|(_, from, to)| {
            let (from, to) = if effort == Effort::Once { (tick, tick + 1) } else { (from, to) };
            cloth.step(from - tick);
            tick = to;
            let spent = seconds(|| {
                cloth.step(to - from);
                black_box(cloth.positions());
            });
            1.0e3 * spent / f64::from(to - from)
        })
    }

    fn build(&self, self_collision: SelfCollision) -> Cloth {
        let mut cloth = Cloth::grid(&GridDesc {
            columns: self.columns,
            rows: self.rows,
            spacing: self.spacing,
            origin: Vec3::Y * self.height,
            down: self.down,
            pin_mode: PinMode::None,
            settings: Settings { self_collision, ..(self.settings)() },
            ..GridDesc::default()
        })
        .expect("a grid of the benchmark's own");
        cloth.add_collider(&ColliderDesc::default()).expect("a floor of the benchmark's own");
        if self.ball > 0.0 {
            let middle = 0.5 * self.spacing * (self.columns - 1) as f32;
            let ball = ColliderDesc {
                shape: Shape::Sphere,
                radius: self.ball,
                position: Vec3::new(middle, self.ball, middle),
                ..ColliderDesc::default()
            };
            cloth.add_collider(&ball).expect("a ball of the benchmark's own");
        }
        // Nothing is so flat that it crumples in its own plane.
        for i in (0..self.columns * self.rows).step_by(7) {
            let away = Vec3::Z * (0.05 * ((i % 5) as f32 - 2.0));
            cloth.set_velocity(i, away).expect("a particle of the cloth");
        }
        cloth
    }
}
