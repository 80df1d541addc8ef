//! Table `layers`: what self-collision, by particles and by surface, adds to a tick.

use crate::Effort;
use crate::measure::cpu_time;
use crate::table::{Table, format_number, format_ratio};
use muslin::glam::Vec3;
use muslin::{Cloth, ColliderDesc, GridDesc, PinMode, SelfCollision, Settings, Shape};
use std::hint::black_box;

/// A sheet that falls onto a floor, or onto a ball on a floor.
struct FallCase {
    name: &'static str,
    columns: u32,
    rows: u32,
    spacing: f32,
    down: Vec3,
    /// Initial height of its first particle [m].
    height: f32,
    /// Radius of a ball on the floor under its centre [m]; 0 for none.
    ball: f32,
    settings: fn() -> Settings,
    /// The measured parts of the fall: name, first tick, last tick.
    parts: [(&'static str, u32, u32); 2],
}

const FALLS: [FallCase; 4] = [
    FallCase {
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
    FallCase {
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
    FallCase {
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
    FallCase {
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
                .map(|self_collision| fall.measure(self_collision, effort));
        for (index, (part, ..)) in fall.parts.iter().enumerate() {
            let adds = |with: f64| format_ratio((with - without[index]) / without[index]);
            table.push(vec![
                fall.name.into(),
                (*part).into(),
                format_number(without[index], 3),
                format_number(particles[index], 3),
                adds(particles[index]),
                format_number(surface[index], 3),
                adds(surface[index]),
            ]);
        }
    }
    println!(
        "\nLayers: ms per tick on one thread, mean over a part of a fall; \
         adds: what self-collision adds, as a multiple of the tick without it.\n"
    );
    println!("{table}");
}

impl FallCase {
    /// Returns the time per tick in each part [ms].
    fn measure(&self, self_collision: SelfCollision, effort: Effort) -> [f64; 2] {
        let mut cloth = self.build(self_collision);
        let mut tick = 0;
        self.parts.map(|(_, from, to)| {
            let (from, to) = if effort == Effort::Smoke { (tick, tick + 1) } else { (from, to) };
            cloth.step(from - tick);
            tick = to;
            let spent = cpu_time(|| {
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
        .expect("a grid is valid");
        cloth.add_collider(&ColliderDesc::default()).expect("a floor is valid");
        if self.ball > 0.0 {
            let centre = 0.5 * self.spacing * (self.columns - 1) as f32;
            let ball = ColliderDesc {
                shape: Shape::Sphere,
                radius: self.ball,
                position: Vec3::new(centre, self.ball, centre),
                ..ColliderDesc::default()
            };
            cloth.add_collider(&ball).expect("a ball is valid");
        }
        // Small velocities out of the plane: a perfectly flat sheet would crumple within its own
        // plane.
        for i in (0..self.columns * self.rows).step_by(7) {
            let velocity = Vec3::Z * (0.05 * ((i % 5) as f32 - 2.0));
            cloth.set_velocity(i, velocity).expect("the particle exists");
        }
        cloth
    }
}
