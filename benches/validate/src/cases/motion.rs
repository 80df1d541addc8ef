//! Periods and energy of what swings, and the angular momentum of what spins. No damping at all.

use super::G;
use crate::player::Player;
use crate::references::oscillation;
use crate::run::{Outcome, Run};
use crate::strip::{ROWS, Strip, horizontal, limp};
use crate::trial::{Case, Quantity, Trial};
use muslin::glam::{DVec3, Vec3};
use muslin::{Cloth, MeshDesc};
use std::f64::consts::TAU;

const DENSITY: f64 = 0.18;

/// Tolerances of the energy that is left after 5 s, as a share.
const ENERGY: [f64; 2] = [0.05, 0.4];

pub fn pendulum() -> Case {
    let mut trials = vec![
        pendulum_period(30.0, 1.0, G),
        pendulum_period(90.0, 1.0, G),
        pendulum_period(60.0, 0.37, 7.3),
        pendulum_energy(30.0),
        pendulum_energy(90.0),
    ];
    trials.iter_mut().for_each(|trial| trial.nodes = &[3]);
    Case {
        name: "pendulum",
        about: "a triangle that swings about its pinned side: period, and energy after 5 s",
        source: "T = 2 π √(L / g) (2/π) K(sin² θ₀/2) (Abramowitz and Stegun, 17.3.1); energy is \
                 conserved",
        trials,
        is_default: true,
    }
}

/// A triangle with its mass at the tip, released at `degrees` to the vertical.
fn triangle(run: &Run, degrees: f64, length: f64, gravity: f64) -> muslin::Result<Player> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let tip = Vec3::new((length * sine) as f32, (-length * cosine) as f32, 0.0);
    let side = Vec3::new(0.0, 0.0, 0.05 * length as f32);
    let mut settings = run.settings(gravity, 0.0);
    settings.tethers = false;
    Ok(Player::new(Cloth::mesh(&MeshDesc {
        positions: vec![-side, side, tip],
        indices: vec![0, 1, 2],
        pinned: vec![0, 1],
        material: limp(DENSITY),
        settings,
        ..MeshDesc::default()
    })?))
}

fn pendulum_period(degrees: f64, length: f64, gravity: f64) -> Trial {
    let exact = oscillation::pendulum_ratio(degrees) * oscillation::small_swing(length, gravity);
    let name = format!("period, {degrees}°, {length} m, {gravity} m/s² [s]");
    Trial::new([Quantity::relative(name, exact, [0.005, 0.02])], move |run| {
        let mut player = triangle(run, degrees, length, gravity)?;
        let found = period(&mut player, exact, |player| f64::from(player.cloth.positions()[2].x));
        Ok(Outcome::of(&player, [found]))
    })
}

/// Mean period of an oscillation about zero [s], from five passages; NaN if they do not come in
/// twice the time that `expected` [s] gives.
fn period(player: &mut Player, expected: f64, at: impl Fn(&Player) -> f64) -> f64 {
    let tick = f64::from(player.cloth.settings().tick);
    let mut last = at(player);
    let mut passages = Vec::new();
    for count in 1..=player.ticks_in(6.0 * expected) {
        player.step(1);
        let x = at(player);
        if (x < 0.0) != (last < 0.0) {
            passages.push((f64::from(count) - x / (x - last)) * tick);
        }
        last = x;
        if passages.len() == 5 {
            return (passages[4] - passages[0]) / 2.0;
        }
    }
    f64::NAN
}

fn pendulum_energy(degrees: f64) -> Trial {
    let quantity = Quantity::absolute(format!("energy left after 5 s, {degrees}°"), 1.0, ENERGY);
    Trial::new([quantity], move |run| {
        let mut player = triangle(run, degrees, 1.0, G)?;
        let mass = f64::from(player.cloth.mass(2).unwrap_or_default());
        let energy = |player: &Player| {
            let x = f64::from(player.cloth.positions()[2].y);
            let v = f64::from(player.cloth.velocity(2).unwrap_or_default().length());
            mass * (0.5 * v * v + G * (x + 1.0))
        };
        let start = energy(&player);
        player.play(5.0);
        Ok(Outcome::of(&player, [energy(&player) / start]))
    })
}

pub fn flight() -> Case {
    let quantities = [
        Quantity::absolute("drop in 1 s of free fall [m]", 0.5 * G, [0.005, 0.02]),
        Quantity::absolute("error of the place after 1 s of flight [m]", 0.0, [0.005, 0.02]),
    ];
    let trial = Trial::new(quantities, |run| {
        let mut places = [0.0; 2];
        let mut ms = 0.0;
        for (place, thrown) in places.iter_mut().zip([DVec3::ZERO, DVec3::new(3.0, 4.0, 1.0)]) {
            let [along, across] = horizontal(33.0);
            let sheet = Strip {
                columns: run.nodes,
                rows: run.nodes / 4,
                spacing: 0.5 / f64::from(run.nodes - 1),
                along,
                across,
                material: limp(DENSITY),
                settings: run.settings(G, 0.0),
            };
            let mut player = sheet.pinned(&[])?;
            let count = player.cloth.particle_count();
            player.cloth.set_velocities(0, &vec![thrown.as_vec3(); count as usize])?;
            let start = player.mean(0..count);
            player.play(1.0);
            let way = player.mean(0..count) - start;
            let exact = thrown - DVec3::Y * (0.5 * G);
            *place = if thrown == DVec3::ZERO { -way.y } else { way.distance(exact) };
            ms += 0.5 * player.ms_of_a_tick();
        }
        Ok(Outcome { values: places.into(), settled: true, rest_speed: 0.0, ms })
    });
    Case {
        name: "flight",
        about: "a free sheet of 0.5 m in a vacuum: dropped, and thrown with (3, 4, 1) m/s",
        source: "x = v t + ½ g t²",
        trials: vec![trial],
        is_default: true,
    }
}

pub fn swing() -> Case {
    Case {
        name: "swing",
        about: "a sheet of 1 m that swings about its pinned edge: energy after 5 s, and the most \
                that it ever has",
        source: "energy is conserved",
        trials: vec![swing_energy(90.0, 33.0), swing_energy(30.0, 0.0)],
        is_default: true,
    }
}

fn swing_energy(degrees: f64, turn: f64) -> Trial {
    let quantities = [
        Quantity::absolute(format!("energy left after 5 s, {degrees}°"), 1.0, [0.1, 0.2]),
        Quantity::absolute(format!("energy gained at most in 5 s, {degrees}°"), 0.0, [0.001, 0.01]),
    ];
    Trial::new(quantities, move |run| {
        let [out, across] = horizontal(turn);
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let sheet = Strip {
            columns: run.nodes,
            rows: run.nodes,
            spacing: 1.0 / f64::from(run.nodes - 1),
            along: out * sine - DVec3::Y * cosine,
            across,
            material: limp(DENSITY),
            settings: run.settings(G, 0.0),
        };
        let mut player = sheet.pinned(&[0])?;
        let lowest: f64 = (0..player.cloth.particle_count())
            .map(|particle| {
                let below = sheet.spacing * f64::from(particle % sheet.columns);
                -f64::from(player.cloth.mass(particle).unwrap_or_default()) * G * below
            })
            .sum();
        let energy = |player: &Player| player.energy() - lowest;
        let start = energy(&player);
        let mut most = start;
        for _ in 0..player.ticks_in(5.0) {
            player.step(1);
            most = most.max(energy(&player));
        }
        Ok(Outcome::of(&player, [energy(&player) / start, most / start - 1.0]))
    })
}

pub fn hanging_period() -> Case {
    Case {
        name: "period",
        about: "a limp strip that hangs from one end and swings in its lowest mode, by 3°",
        source: "T = 4 π / j₀ √(L / g), j₀ = 2.4048 (Lamb, Hydrodynamics, art. 205)",
        trials: vec![strip_period(1.0, G, 0.0), strip_period(0.37, 7.3, 33.0)],
        is_default: true,
    }
}

fn strip_period(length: f64, gravity: f64, turn: f64) -> Trial {
    let exact = oscillation::hanging_chain(length, gravity);
    let name = format!("period, {length} m, {gravity} m/s², turned by {turn}° [s]");
    Trial::new([Quantity::relative(name, exact, [0.01, 0.03])], move |run| {
        let [side, across] = horizontal(turn);
        let strip = Strip {
            columns: run.nodes,
            rows: ROWS,
            spacing: length / f64::from(run.nodes - 1),
            along: side,
            across,
            material: limp(DENSITY),
            settings: run.settings(gravity, 0.0),
        };
        let mut player = strip.pinned(&[0])?;
        let amplitude = length * 3.0_f64.to_radians().sin();
        let mut points = vec![[0.0, 0.0]];
        for column in 1..run.nodes {
            let from_top = f64::from(column) / f64::from(run.nodes - 1);
            let x = amplitude * oscillation::chain_mode(from_top);
            let [last_x, last_y] = points[points.len() - 1];
            let dx: f64 = x - last_x;
            let dy: f64 = (strip.spacing * strip.spacing - dx * dx).sqrt();
            points.push([x, last_y - dy]);
        }
        strip.place(&mut player, &points)?;
        let found = period(&mut player, exact, |player| strip.at(player, run.nodes - 1).dot(side));
        Ok(Outcome::of(&player, [found]))
    })
}

pub fn spin() -> Case {
    let quantity = Quantity::absolute(
        "angular momentum left after 10 turns, 0.5 m sheet at 2 turns/s",
        1.0,
        [0.005, 0.05],
    );
    let trial = Trial::new([quantity], |run| {
        let side = 0.5;
        let sheet = Strip {
            columns: run.nodes,
            rows: run.nodes,
            spacing: side / f64::from(run.nodes - 1),
            along: DVec3::X,
            across: DVec3::NEG_Y,
            material: limp(DENSITY),
            settings: run.settings(0.0, 0.0),
        };
        let mut player = sheet.pinned(&[])?;
        let middle = player.mean(0..run.nodes * run.nodes).as_vec3();
        let spin = Vec3::Z * (2.0 * TAU) as f32;
        let speeds: Vec<Vec3> =
            player.cloth.positions().iter().map(|x| spin.cross(*x - middle)).collect();
        player.cloth.set_velocities(0, &speeds)?;
        let momentum = |player: &Player| {
            let middle = player.mean(0..run.nodes * run.nodes);
            let of = |(particle, x): (u32, &Vec3)| {
                let mass = f64::from(player.cloth.mass(particle).unwrap_or_default());
                let speed = player.cloth.velocity(particle).unwrap_or_default().as_dvec3();
                mass * (x.as_dvec3() - middle).cross(speed).z
            };
            (0..).zip(player.cloth.positions()).map(of).sum::<f64>()
        };
        let start = momentum(&player);
        player.play(5.0);
        Ok(Outcome::of(&player, [momentum(&player) / start]))
    });
    Case {
        name: "spin",
        about: "a free sheet with rigid links that spins about its normal, without gravity",
        source: "angular momentum is conserved",
        trials: vec![trial],
        is_default: true,
    }
}
