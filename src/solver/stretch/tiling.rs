//! Sweeps over a grid on several threads, with the bits of one thread (split tiling).
//!
//! Each thread takes a band of the grid's rows through all colours of a kind. It leaves out the
//! links that join its band to another, and in later colours every link that shares a particle with
//! one that was left out. A second pass solves these links, the gaps between bands:
//!
//! ```text
//! colour 1  ─────────╮╭─────────      each sign is a row of the grid
//!        2  ────────╮  ╭────────      ─      first pass: all bands at once
//!        3  ──────╮      ╭──────      blank  second pass: all gaps at once
//! ```
//! This is split tiling (Krishnamoorthy et al., "Effective automatic parallelization of stencil
//! computations", PLDI 2007) with a colour in place of a time step.
//!
//! Reads `constraints`, `grid_cells`, weights of the ends; writes positions and λ.
//! Invariant: every link is solved once, after all links of earlier colours that share a particle
//! with it, which is the order of one colour after the other.

use crate::math::simd::Level;
use crate::math::threads::Split;
use crate::model::grid_rows::LinkRow;
use crate::solver::stretch::grid_kernel::grid_slices::GridSlices;
use crate::solver::stretch::grid_links::solve_rows;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::world::World;
use core::ops::Range;

/// The largest number of colours that go together: those of one kind of link.
const MAX_COLORS: usize = 4;

/// The least number of links that is worth a thread.
const MIN_LINKS_PER_THREAD: usize = 32_768;

/// Approximate smallest number of grid rows of a band: the colours of a kind shrink it by four rows
/// at each side, and then depend on two more.
const MIN_ROWS_PER_BAND: usize = 16;

/// Bands begin at multiples of this number of rows, where no link of the first colour of most kinds
/// crosses.
const BAND_ALIGNMENT: usize = 4;

/// Solves batches of grid rows on several threads. Returns false, and changes nothing, if it is not
/// worth more than one thread.
///
/// If there is more than one batch, no active link may have left its row.
pub(crate) fn solve<const LAW: u8>(
    world: &mut World,
    batches: Range<usize>,
    order: SweepOrder,
    scale: f32,
) -> bool {
    let (constraints, p) = (&world.constraints, &mut world.particles);
    let batches = &constraints.batches[batches];
    let (Some(grid), Some(cells), 1..=MAX_COLORS) =
        (&constraints.rows, &world.grid_cells, batches.len())
    else {
        return false;
    };
    let count = batches.iter().map(|batch| batch.count).sum();
    let parts =
        world.threads.parts(count, MIN_LINKS_PER_THREAD).min(cells.rows / MIN_ROWS_PER_BAND);
    if parts < 2 {
        return false;
    }
    let mut colors: [ColorRows<'_>; MAX_COLORS] = Default::default();
    let mut lambda: [&mut [f32]; MAX_COLORS] = Default::default();
    let (mut others, mut before) = (&mut world.scratch.lambda[0][..], 0);
    for (at, batch) in batches.iter().enumerate() {
        let slot = if order == SweepOrder::Forward { at } else { batches.len() - 1 - at };
        let end = batch.first + batch.count;
        colors[slot] =
            ColorRows { rows: &grid.rows[grid.rows_of_batch(batch.first..end)], end: end as u32 };
        let (own, left) = others.split_at_mut(end - before);
        lambda[slot] = &mut own[batch.first - before..];
        (others, before) = (left, end);
    }
    let shared = SweepInput {
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
    let row = |part: usize| {
        if part == parts { rows } else { rows * part / parts / BAND_ALIGNMENT * BAND_ALIGNMENT }
    };
    let band = |part: usize| columns * row(part);
    // The gap between two bands is solved by a thread that has the second half of the one and the
    // first half of the other.
    let gap = |part: usize| if part == 0 { 0 } else { columns * ((row(part) + row(part + 1)) / 2) };
    let zone = |part: usize| SolvedZone { from: band(part) as u32, end: band(part + 1) as u32 };
    let [x, y, z] = p.x.slices_mut().map(|column| &mut column[..rows * columns]);
    let mut slices = BandSlices { shared: &shared, first_particle: 0, x, y, z, lambda };
    world.threads.parallel_for_parts(parts, slices.reborrow(), band, |at, mut slices| {
        slices.solve_band::<LAW>(zone(at));
    });
    world.threads.parallel_for_parts(parts - 1, slices, gap, |at, mut slices| {
        slices.solve_gap::<LAW>(zone(at), zone(at + 1));
    });
    true
}

/// The rows of links of one colour.
#[derive(Clone, Copy, Default)]
struct ColorRows<'a> {
    rows: &'a [LinkRow],
    /// The index behind its last link.
    end: u32,
}

impl ColorRows<'_> {
    /// The first link whose lower end is `particle` or behind it.
    fn first_from(&self, particle: u32) -> u32 {
        let row = self.rows.partition_point(|row| row.count_before(particle) == row.count);
        self.rows.get(row).map_or(self.end, |row| row.first + row.count_before(particle))
    }

    /// The distance between the two ends of a link, in particle indices.
    fn span(&self) -> u32 {
        self.rows.first().map_or(0, |row| row.b - row.a)
    }

    /// The links whose lower end is before `particle`, and whose upper end is not.
    fn crossing(&self, particle: u32) -> Range<u32> {
        self.first_from(particle.saturating_sub(self.span()))..self.first_from(particle)
    }

    /// The particles at the ends of a link.
    fn ends(&self, link: u32) -> (u32, u32) {
        let row = &self.rows[self.rows.partition_point(|row| row.first + row.count <= link)];
        row.ends(link - row.first)
    }
}

/// A range of particles, whole grid rows, all of whose links of the colours so far are solved.
#[derive(Clone, Copy)]
struct SolvedZone {
    from: u32,
    end: u32,
}

impl SolvedZone {
    /// The part of the zone that remains after another colour.
    fn after(self, color: &ColorRows<'_>, columns: u32) -> Self {
        let (low, high) = (color.crossing(self.from), color.crossing(self.end));
        let from = if low.is_empty() { self.from } else { color.ends(low.end - 1).1 + 1 };
        let end = if high.is_empty() { self.end } else { color.ends(high.start).0 };
        Self { from: from.next_multiple_of(columns), end: end / columns * columns }
    }
}

/// The data that all threads read.
struct SweepInput<'a> {
    level: Level,
    scale: f32,
    columns: u32,
    /// In the order of the sweep.
    colors: &'a [ColorRows<'a>],
    w: &'a [f32],
    mask: &'a [f32],
    rest: &'a [f32],
    compliance: &'a [f32],
    ends: [&'a [f32]; 2],
}

/// The data that one thread writes: particles from a grid row on, and λ of the links whose lower
/// ends are among them.
struct BandSlices<'a> {
    shared: &'a SweepInput<'a>,
    first_particle: u32,
    x: &'a mut [f32],
    y: &'a mut [f32],
    z: &'a mut [f32],
    /// λ of the links of each colour.
    lambda: [&'a mut [f32]; MAX_COLORS],
}

impl BandSlices<'_> {
    fn reborrow(&mut self) -> BandSlices<'_> {
        BandSlices {
            shared: self.shared,
            first_particle: self.first_particle,
            x: self.x,
            y: self.y,
            z: self.z,
            lambda: self.lambda.each_mut().map(|lambda| &mut **lambda),
        }
    }

    /// Solves all links of a band that depend on no particle of another band.
    fn solve_band<const LAW: u8>(&mut self, mut zone: SolvedZone) {
        for (at, color) in self.shared.colors.iter().enumerate() {
            self.solve::<LAW>(at, color.first_from(zone.from)..color.crossing(zone.end).start);
            zone = zone.after(color, self.shared.columns);
        }
    }

    /// Solves the links that two neighbouring bands left.
    fn solve_gap<const LAW: u8>(&mut self, mut upper: SolvedZone, mut lower: SolvedZone) {
        let columns = self.shared.columns;
        for (at, color) in self.shared.colors.iter().enumerate() {
            self.solve::<LAW>(at, color.crossing(upper.end).start..color.first_from(lower.from));
            (upper, lower) = (upper.after(color, columns), lower.after(color, columns));
        }
    }

    /// Solves a range of links of the colour number `at`.
    fn solve<const LAW: u8>(&mut self, at: usize, links: Range<u32>) {
        let (shared, color) = (self.shared, self.shared.colors[at]);
        let lambda = &mut *self.lambda[at];
        let (first_particle, first_link) =
            (self.first_particle, color.first_from(self.first_particle));
        let (particles, all) = (first_particle as usize, first_link as usize);
        let (particles, all) = (particles..particles + self.x.len(), all..all + lambda.len());
        let mut slices = GridSlices {
            first_particle,
            first_link,
            x: self.x,
            y: self.y,
            z: self.z,
            w: &shared.w[particles],
            mask: &shared.mask[all.clone()],
            rest: &shared.rest[all.clone()],
            compliance: &shared.compliance[all.clone()],
            ends: shared.ends.map(|list| &list[all.clone()]),
            lambda,
        };
        let from = color.rows.partition_point(|row| row.first + row.count <= links.start);
        let end = color.rows.partition_point(|row| row.first < links.end);
        let mut run =
            |rows: &[LinkRow]| solve_rows::<LAW>(shared.level, rows, &mut slices, shared.scale);
        match color.rows.get(from..end) {
            None | Some([]) => {}
            Some([one]) => run(&[one.slice(links)]),
            Some([first, rows @ .., last]) => {
                run(&[first.slice(links.clone())]);
                run(rows);
                run(&[last.slice(links)]);
            }
        }
    }
}

impl Split for BandSlices<'_> {
    fn count(&self) -> usize {
        self.x.len()
    }

    fn split_at_item(self, mid: usize) -> (Self, Self) {
        let (shared, first_particle) = (self.shared, self.first_particle);
        let behind = first_particle + mid as u32;
        let ((x, x_2), (y, y_2), (z, z_2)) =
            (self.x.split_at_mut(mid), self.y.split_at_mut(mid), self.z.split_at_mut(mid));
        let mut lambda_2: [&mut [f32]; MAX_COLORS] = Default::default();
        let mut lambda = self.lambda;
        for ((lambda, lambda_2), color) in lambda.iter_mut().zip(&mut lambda_2).zip(shared.colors) {
            let before = color.first_from(behind) - color.first_from(first_particle);
            (*lambda, *lambda_2) = core::mem::take(lambda).split_at_mut(before as usize);
        }
        (
            Self { shared, first_particle, x, y, z, lambda },
            Self { shared, first_particle: behind, x: x_2, y: y_2, z: z_2, lambda: lambda_2 },
        )
    }
}
