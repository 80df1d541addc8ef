//! Strips that bend under their weight: between clamps, closed to a ring, and as cantilevers.

use super::G;
use crate::noise::Noise;
use crate::player::{DAMPING, Player};
use crate::references::{elastica, slack_elastica};
use crate::run::{Outcome, Run};
use crate::strip::{ROWS, Strip, bending, horizontal};
use crate::trial::{Case, Quantity, Trial};
use muslin::glam::DVec3;
use muslin::{Cloth, MeshDesc};
use std::f64::consts::TAU;

/// Density of the strips [kg/m²].
const DENSITY: f64 = 0.15;

/// Tolerances of heights, as shares of the length.
const HEIGHT: [f64; 2] = [0.02, 0.06];

/// Span between the clamps of a slack strip, over its length.
const SPAN: f64 = 0.8;

/// A strip of gravito-bending number `gamma` = σ g L³ / D.
#[derive(Clone, Copy)]
struct HeavyStrip {
    gamma: f64,
    /// Free length [m].
    length: f64,
    gravity: f64,
    /// Angle of the strip to the x axis [degrees].
    turn: f64,
}

impl HeavyStrip {
    const fn new(gamma: f64) -> Self {
        Self { gamma, length: 0.2, gravity: G, turn: 0.0 }
    }

    const fn odd(gamma: f64) -> Self {
        Self { gamma, length: 0.37, gravity: 7.3, turn: 33.0 }
    }

    fn name(&self) -> String {
        let Self { gamma, length, gravity, turn } = self;
        if *turn == 0.0 {
            format!("Γ = {gamma}")
        } else {
            format!("Γ = {gamma}, {length} m, {gravity} m/s², turned by {turn}°")
        }
    }

    /// A strip whose free part has `free_cells` cells.
    fn strip(&self, run: &Run, free_cells: u32) -> Strip {
        let [along, across] = horizontal(self.turn);
        let stiffness = DENSITY * self.gravity * self.length.powi(3) / self.gamma;
        Strip {
            columns: run.nodes,
            rows: ROWS,
            spacing: self.length / f64::from(free_cells),
            along,
            across,
            material: bending(DENSITY, stiffness),
            settings: run.settings(self.gravity, DAMPING),
        }
    }
}

pub fn slack() -> Case {
    let mut trials: Vec<Trial> =
        [1.0, 10.0, 100.0, 1000.0].map(HeavyStrip::new).map(between).into();
    trials.push(between(HeavyStrip::odd(30.0)));
    trials.extend([1.0, 10.0, 100.0, 1000.0].map(HeavyStrip::new).map(ring));
    trials.push(ring(HeavyStrip::odd(30.0)));
    Case {
        name: "slack",
        about: "inextensible strips of length L: between level clamps that were moved together to \
                0.8 L; closed to a ring that hangs from its clamp",
        source: "heavy elastica θ'' = h sin θ − γ s cos θ between two clamps, by shooting (Love, A \
                 Treatise on the Mathematical Theory of Elasticity, chapter XIX)",
        trials,
        is_default: true,
    }
}

fn between(heavy: HeavyStrip) -> Trial {
    let sag = slack_elastica::level_clamps(heavy.gamma, SPAN);
    let quantity =
        Quantity::absolute(format!("sag over L between clamps, {}", heavy.name()), sag, HEIGHT);
    Trial::new([quantity], move |run| {
        let last = run.nodes - 1;
        let strip = heavy.strip(run, run.nodes - 3);
        let mut player = strip.pinned(&[0, 1, last - 1, last])?;
        // It starts with a little sag: a stiff strip could buckle upwards too.
        let mut points = vec![[-strip.spacing, 0.0], [0.0, 0.0]];
        for cell in 0..run.nodes - 3 {
            let s = (f64::from(cell) + 0.5) / f64::from(run.nodes - 3);
            push_point(&mut points, strip.spacing, -0.3 * (TAU * s).sin());
        }
        push_point(&mut points, strip.spacing, 0.0);
        strip.place(&mut player, &points)?;
        let span = points[points.len() - 2][0];
        strip.push_end(&mut player, 2, SPAN * heavy.length - span, 2.0)?;
        player.settle(heavy.length);
        let lowest = (0..run.nodes).map(|column| strip.at(&player, column).y);
        let sag = strip.at(&player, 1).y - lowest.fold(f64::INFINITY, f64::min);
        Ok(Outcome::of(&player, [sag / heavy.length]))
    })
}

/// Appends the point at the distance `spacing` [m] from the last one, in the direction `slope`
/// [rad].
fn push_point(points: &mut Vec<[f64; 2]>, spacing: f64, slope: f64) {
    let [x, y] = points.last().copied().unwrap_or_default();
    points.push([x + spacing * slope.cos(), y + spacing * slope.sin()]);
}

fn ring(heavy: HeavyStrip) -> Trial {
    let height = slack_elastica::hanging_ring(heavy.gamma);
    let quantity =
        Quantity::absolute(format!("height over L of a ring, {}", heavy.name()), height, HEIGHT);
    Trial::new([quantity], move |run| {
        let last = run.nodes - 1;
        let cells = run.nodes - 3;
        let strip = heavy.strip(run, cells);
        let mut player = strip.pinned(&[0, 1, last - 1, last])?;
        // The free part starts as a regular polygon; the clamps continue it straight.
        let mut points = vec![[-strip.spacing, 0.0], [0.0, 0.0]];
        for cell in 0..cells {
            let s = (f64::from(cell) + 0.5) / f64::from(cells);
            push_point(&mut points, strip.spacing, -TAU * s);
        }
        push_point(&mut points, strip.spacing, 0.0);
        strip.place(&mut player, &points)?;
        player.settle(heavy.length);
        let lowest = (0..run.nodes).map(|column| strip.at(&player, column).y);
        Ok(Outcome::of(&player, [-lowest.fold(f64::INFINITY, f64::min) / heavy.length]))
    })
}

pub fn cantilever() -> Case {
    let strips =
        [1.0, 8.0042, 30.0, 100.0].map(HeavyStrip::new).into_iter().chain([HeavyStrip::odd(10.0)]);
    let mut trials: Vec<Trial> = strips
        .map(|heavy| {
            Trial::new(drop_and_reach(&heavy), move |run| {
                let strip = heavy.strip(run, run.nodes - 2);
                let mut player = strip.pinned(&[0, 1])?;
                player.settle(heavy.length);
                let hung = strip.at(&player, run.nodes - 1) - strip.at(&player, 1);
                Ok(Outcome::of(&player, [-hung.y, hung.dot(strip.along)].map(|x| x / heavy.length)))
            })
        })
        .collect();
    trials.push(peirce());
    Case {
        name: "cantilever",
        about: "grids clamped level at one end: drop H and reach W of the tip; Peirce's test",
        source: "heavy elastica θ'' = −Γ (1 − s) cos θ (Bickley 1934, Phil. Mag. 17); at a chord \
                 of 41.5° the length is 2.0003 bending lengths (BS 3356, ASTM D1388, ISO 9073-7)",
        trials,
        is_default: true,
    }
}

fn drop_and_reach(heavy: &HeavyStrip) -> [Quantity; 2] {
    let tip = elastica::tip(heavy.gamma);
    [
        Quantity::absolute(format!("H over L, {}", heavy.name()), tip.drop, HEIGHT),
        Quantity::absolute(format!("W over L, {}", heavy.name()), tip.span, HEIGHT),
    ]
}

/// Measures the bending length as the cantilever test does.
fn peirce() -> Trial {
    let heavy = HeavyStrip::new(8.0042);
    // Logarithms of H / W around the expected one, and the length over the bending length there.
    let table: Vec<[f64; 2]> = (-8..=8)
        .map(|step| {
            let gamma = heavy.gamma * 1.1_f64.powi(step);
            let tip = elastica::tip(gamma);
            [(tip.drop / tip.span).ln(), gamma.cbrt()]
        })
        .collect();
    let quantity = Quantity::relative("length over bending length at 41.5°", 2.0003, [0.02, 0.06]);
    Trial::new([quantity], move |run| {
        let strip = heavy.strip(run, run.nodes - 2);
        let mut player = strip.pinned(&[0, 1])?;
        player.settle(heavy.length);
        let hung = strip.at(&player, run.nodes - 1) - strip.at(&player, 1);
        let ratio = (-hung.y / hung.dot(strip.along)).ln();
        let next = table.partition_point(|[x, _]| *x < ratio).clamp(1, table.len() - 1);
        let [[low, a], [high, b]] = [table[next - 1], table[next]];
        Ok(Outcome::of(&player, [a + (b - a) * (ratio - low) / (high - low)]))
    })
}

pub fn cantilever_mesh() -> Case {
    let strips = [
        HeavyStrip::new(1.0),
        HeavyStrip::new(8.0042),
        HeavyStrip::new(100.0),
        HeavyStrip::odd(10.0),
    ];
    let trials = strips.map(|heavy| {
        Trial::new(drop_and_reach(&heavy), move |run| {
            let strip = heavy.strip(run, run.nodes - 2);
            let mut player = irregular(&strip)?;
            player.settle(heavy.length);
            let hung = strip.at(&player, run.nodes - 1) - strip.at(&player, 1);
            Ok(Outcome::of(&player, [-hung.y, hung.dot(strip.along)].map(|x| x / heavy.length)))
        })
    });
    Case {
        name: "mesh",
        about: "the same cantilever as a triangle mesh: all diagonals one way, inner vertices \
                moved at random by up to 0.3 cells",
        source: "heavy elastica, as for grids",
        trials: trials.into(),
        is_default: true,
    }
}

/// A mesh on the nodes of `strip`, with the columns of the clamp pinned.
fn irregular(strip: &Strip) -> muslin::Result<Player> {
    let [columns, rows] = [strip.columns, strip.rows];
    let mut desc = MeshDesc {
        material: strip.material.clone(),
        settings: strip.settings.clone(),
        extra_particles: 0,
        ..MeshDesc::default()
    };
    let mut noise = Noise::new(1);
    for row in 0..rows {
        for column in 0..columns {
            let mut at = [f64::from(column), f64::from(row)];
            // The clamp, the tip and the borders stay straight.
            if (2..columns - 1).contains(&column) {
                at[0] += 0.3 * noise.next();
                at[1] += if (1..rows - 1).contains(&row) { 0.3 * noise.next() } else { 0.0 };
            }
            let [along, across] = at.map(|x| x * strip.spacing);
            let x: DVec3 = strip.along * along + strip.across * across;
            desc.positions.push(x.as_vec3());
        }
    }
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = row * columns + column;
            let [b, c, d] = [a + 1, a + columns, a + columns + 1];
            desc.indices.extend([a, c, d, a, d, b]);
        }
    }
    desc.pinned = [0, 1].into_iter().flat_map(|column| strip.column(column)).collect();
    Ok(Player::new(Cloth::mesh(&desc)?))
}
