//! The links of a grid on several threads.
//!
//! Each thread takes a band of the grid's rows through all colours of a kind. What a colour joins
//! to other bands it leaves undone, and in the colours after that whatever hangs on it:
//!
//! ```text
//! colour 1  ─────────╮╭─────────      each sign is a row of the grid
//!        2  ────────╮  ╭────────      ─  at first, all bands at once
//!        3  ──────╮      ╭──────         then what is left between two bands, all gaps at once
//! ```
//! So every link is solved once, and after all those before it that share a particle with it, as in
//! one colour after the other: the bits are the same. This is known as time skewing.

use crate::math::simd::Level;
use crate::math::threads::Split;
use crate::model::grid_rows::Row;
use crate::solver::stretch::grid_links::{Sheet, solve_rows};
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::world::World;
use core::ops::Range;

/// The most colours that go together: those of one kind.
const COLORS: usize = 4;

/// Links that one thread solves at least.
const LINKS: usize = 32_768;

/// Rows of a band at least, about: colours take four from it on each side, and then reach two more.
const ROWS: usize = 16;

/// Bands begin at multiples of so many rows, where most first colours join nothing.
const GRAIN: usize = 4;

/// Solves batches of rows, one colour after the other, if it pays to have several threads at that;
/// else does nothing and says so. Among the links of more than one batch there must be no strays.
pub(crate) fn solve<const LAW: u8>(
    world: &mut World,
    batches: Range<usize>,
    order: SweepOrder,
    scale: f32,
) -> bool {
    let (constraints, p) = (&mut world.constraints, &mut world.particles);
    let batches = &constraints.batches[batches];
    let (Some(grid), Some(cells), 1..=COLORS) =
        (&constraints.rows, &world.grid_cells, batches.len())
    else {
        return false;
    };
    let count = batches.iter().map(|batch| batch.count).sum();
    let parts = world.threads.parts(count, LINKS).min(cells.rows / ROWS);
    if parts < 2 {
        return false;
    }
    let mut colors: [Color<'_>; COLORS] = Default::default();
    let mut lambda: [&mut [f32]; COLORS] = Default::default();
    let (mut others, mut before) = (&mut constraints.links.lambda[..], 0);
    for (at, batch) in batches.iter().enumerate() {
        let slot = if order == SweepOrder::Forward { at } else { batches.len() - 1 - at };
        let end = batch.first + batch.count;
        colors[slot] = Color { rows: &grid.rows[grid.between(batch.first..end)], end: end as u32 };
        let (own, left) = others.split_at_mut(end - before);
        lambda[slot] = &mut own[batch.first - before..];
        (others, before) = (left, end);
    }
    let sweep = Sweep {
        level: world.level,
        scale,
        columns: cells.columns as u32,
        colors: &colors[..batches.len()],
        w: &p.w,
        mask: &grid.mask,
        rest: &constraints.links.rest,
        compliance: &constraints.links.compliance,
        ends: world.scratch.end_weights.ends.each_ref().map(|list| &list[..]),
    };
    let (rows, columns) = (cells.rows, cells.columns);
    let row = |part: usize| if part == parts { rows } else { rows * part / parts / GRAIN * GRAIN };
    let band = |part: usize| columns * row(part);
    // Gaps are looked for between the middles of bands.
    let gap = |part: usize| if part == 0 { 0 } else { columns * ((row(part) + row(part + 1)) / 2) };
    let zone = |part: usize| Zone { from: band(part) as u32, end: band(part + 1) as u32 };
    let [x, y, z] = p.x.all_mut().map(|column| &mut column[..rows * columns]);
    let mut part = Part { sweep: &sweep, first_particle: 0, x, y, z, lambda };
    world.threads.parallel_for_parts(parts, part.all(), band, |at, mut part| {
        part.solve_band::<LAW>(zone(at))
    });
    world.threads.parallel_for_parts(parts - 1, part, gap, |at, mut part| {
        part.solve_gap::<LAW>(zone(at), zone(at + 1));
    });
    true
}

/// Links of one colour.
#[derive(Clone, Copy, Default)]
struct Color<'a> {
    rows: &'a [Row],
    /// Behind the last one.
    end: u32,
}

impl Color<'_> {
    /// The first link whose lower end is not before a particle.
    fn first_from(&self, particle: u32) -> u32 {
        let row = self.rows.partition_point(|row| row.count_before(particle) == row.count);
        self.rows.get(row).map_or(self.end, |row| row.first + row.count_before(particle))
    }

    /// How far its links reach.
    fn reach(&self) -> u32 {
        self.rows.first().map_or(0, |row| row.b - row.a)
    }

    /// The links that reach a particle, or one behind it, from before it.
    fn across(&self, particle: u32) -> Range<u32> {
        self.first_from(particle.saturating_sub(self.reach()))..self.first_from(particle)
    }

    /// The ends of a link.
    fn ends(&self, link: u32) -> (u32, u32) {
        let row = &self.rows[self.rows.partition_point(|row| row.first + row.count <= link)];
        row.ends(link - row.first)
    }
}

/// Particles, whole rows of them, that all colours so far have done with.
#[derive(Clone, Copy)]
struct Zone {
    from: u32,
    end: u32,
}

impl Zone {
    /// What a colour leaves of it.
    fn after(self, color: &Color<'_>, columns: u32) -> Self {
        let (low, high) = (color.across(self.from), color.across(self.end));
        let from = if low.is_empty() { self.from } else { color.ends(low.end - 1).1 + 1 };
        let end = if high.is_empty() { self.end } else { color.ends(high.start).0 };
        Self { from: from.next_multiple_of(columns), end: end / columns * columns }
    }
}

/// What all threads look at.
struct Sweep<'a> {
    level: Level,
    scale: f32,
    columns: u32,
    /// In the order in which they go.
    colors: &'a [Color<'a>],
    w: &'a [f32],
    mask: &'a [f32],
    rest: &'a [f32],
    compliance: &'a [f32],
    ends: [&'a [f32]; 2],
}

/// What one thread changes: particles from some row on, and the multipliers of links that start
/// there.
struct Part<'a> {
    sweep: &'a Sweep<'a>,
    first_particle: u32,
    x: &'a mut [f32],
    y: &'a mut [f32],
    z: &'a mut [f32],
    /// For each colour.
    lambda: [&'a mut [f32]; COLORS],
}

impl Part<'_> {
    fn all(&mut self) -> Part<'_> {
        Part {
            sweep: self.sweep,
            first_particle: self.first_particle,
            x: self.x,
            y: self.y,
            z: self.z,
            lambda: self.lambda.each_mut().map(|lambda| &mut **lambda),
        }
    }

    /// All that lies within a band and hangs on nothing outside it.
    fn solve_band<const LAW: u8>(&mut self, mut zone: Zone) {
        for (at, color) in self.sweep.colors.iter().enumerate() {
            self.solve::<LAW>(at, color.first_from(zone.from)..color.across(zone.end).start);
            zone = zone.after(color, self.sweep.columns);
        }
    }

    /// What two bands left between them.
    fn solve_gap<const LAW: u8>(&mut self, mut upper: Zone, mut lower: Zone) {
        let columns = self.sweep.columns;
        for (at, color) in self.sweep.colors.iter().enumerate() {
            self.solve::<LAW>(at, color.across(upper.end).start..color.first_from(lower.from));
            (upper, lower) = (upper.after(color, columns), lower.after(color, columns));
        }
    }

    /// Links of one colour.
    fn solve<const LAW: u8>(&mut self, at: usize, links: Range<u32>) {
        let (sweep, color) = (self.sweep, self.sweep.colors[at]);
        let lambda = &mut *self.lambda[at];
        let (first_particle, first_link) =
            (self.first_particle, color.first_from(self.first_particle));
        let (particles, all) = (first_particle as usize, first_link as usize);
        let (particles, all) = (particles..particles + self.x.len(), all..all + lambda.len());
        let mut sheet = Sheet {
            first_particle,
            first_link,
            x: self.x,
            y: self.y,
            z: self.z,
            w: &sweep.w[particles],
            mask: &sweep.mask[all.clone()],
            rest: &sweep.rest[all.clone()],
            compliance: &sweep.compliance[all.clone()],
            ends: sweep.ends.map(|list| &list[all.clone()]),
            lambda,
        };
        let from = color.rows.partition_point(|row| row.first + row.count <= links.start);
        let end = color.rows.partition_point(|row| row.first < links.end);
        let mut run = |rows: &[Row]| solve_rows::<LAW>(sweep.level, rows, &mut sheet, sweep.scale);
        match color.rows.get(from..end) {
            None | Some([]) => {}
            Some([one]) => run(&[one.part(links)]),
            Some([first, rows @ .., last]) => {
                run(&[first.part(links.clone())]);
                run(rows);
                run(&[last.part(links)]);
            }
        }
    }
}

impl Split for Part<'_> {
    fn count(&self) -> usize {
        self.x.len()
    }

    fn cut(self, mid: usize) -> (Self, Self) {
        let (sweep, first_particle) = (self.sweep, self.first_particle);
        let behind = first_particle + mid as u32;
        let ((x, x_2), (y, y_2), (z, z_2)) =
            (self.x.split_at_mut(mid), self.y.split_at_mut(mid), self.z.split_at_mut(mid));
        let mut lambda_2: [&mut [f32]; COLORS] = Default::default();
        let mut lambda = self.lambda;
        for ((lambda, lambda_2), color) in lambda.iter_mut().zip(&mut lambda_2).zip(sweep.colors) {
            let before = color.first_from(behind) - color.first_from(first_particle);
            (*lambda, *lambda_2) = core::mem::take(lambda).split_at_mut(before as usize);
        }
        (
            Self { sweep, first_particle, x, y, z, lambda },
            Self { sweep, first_particle: behind, x: x_2, y: y_2, z: z_2, lambda: lambda_2 },
        )
    }
}
