//! Stage `Stretch`, once a substep: every line of links is solved as a whole.
//!
//! The links of a line are coupled only to their neighbours in it, so their multipliers are those of
//! a tridiagonal system, which is solved in one way there and one back (Thomas):
//!
//! ```text
//! (w₋ + w₊ + α̃) λ − w₋ (n₋·n) λ₋ − w₊ (n·n₊) λ₊ = C
//! ```
//! So a load at one end is borne by the whole line at once.
//!
//! What pulls then turns with the line: taut links pull along where their ends will be, not along
//! where prediction left them. With q = λ / length for those, and all else of the pull in p, the
//! particles move by the solution of a second tridiagonal system,
//!
//! ```text
//! (1 + w (q₋ + q₊)) u − w q₋ u₋ − w q₊ u₊ = w p
//! ```
//! for without it a long line whose sideways swing is faster than a substep would chatter. What a link
//! was too long or too short by when the substep began is not all put right at once: in a tangle
//! lines cannot be right, and those that insist never come to rest.
//!
//! Eight lines go side by side; each lane is a line of its own, so that lanes change no bits.

use super::World;
use super::links::is_rigid;
use crate::fabric::lines::{Lines, NOBODY};
use crate::fabric::links::{LinkKind, Links};
use crate::math::simd::{LANES, Lanes, gather, leveled, scatter};
use crate::math::{TINY, max};
use crate::mesh::NONE;

/// What a taut line gives way by, as a share of its weight: pulled from both ends its system has no
/// solution.
const GIVE: f32 = 1.0e-6;

/// The share of what a link was too long or too short by that a substep puts right.
const MEND: f32 = 0.3;

/// Loads are at least as on earth [m/s²]: wind and hands pull where there is no gravity.
const EARTH: f32 = 9.81;

/// Three columns of eight.
type Lanes3 = [Lanes; 3];

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    /// Each particle's position and inverse mass, after a seat that is nobody's.
    points: Vec<[f32; 4]>,
    /// Where each particle was when the substep began.
    starts: Vec<[f32; 4]>,
    /// What is known of each step of a block.
    steps: Vec<Step>,
}

/// Eight links side by side, and the particles that they run to.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    to: Lanes3,
    /// Inverse mass of the particles.
    w: Lanes,
    /// The links' directions, …
    n: Lanes3,
    /// … their lengths as a share of what they are to be, and one over the latter.
    ratio: Lanes,
    over: Lanes,
    /// What each link has to do with the one before.
    before: Lanes,
    /// One over its pivot, and the right side of the system.
    inverse: Lanes,
    right: Lanes,
    /// How a particle moves: by `share` of what the one before does, and by `own`.
    share: Lanes,
    own: Lanes3,
    /// How the particles move that lines begin with.
    begin: Lanes3,
}

impl Scratch {
    /// Room for blocks of so many steps, and so many particles.
    pub fn new(steps: usize, particles: usize) -> Self {
        Self {
            points: Vec::with_capacity(particles + 1),
            starts: Vec::with_capacity(particles + 1),
            steps: vec![Step::default(); steps],
        }
    }
}

/// What sweeps may leave of a line's weight as stretch before lines are solved as wholes.
const LITTLE: f32 = 1.0e-3;

/// Whether lines are solved at all. The plain scheme is sweeps and nothing else, and where substeps are
/// short enough sweeps do by themselves: n of them leave a hanging line of N links stretched by
/// g h² N / (2 n rest) on average.
pub(crate) fn are_used(world: &World) -> bool {
    let settings = &world.settings;
    let (h, sweeps) = (settings.scheme().h, settings.iterations as f32);
    let load = max(settings.gravity.length(), EARTH);
    let left = load * h * h * world.weave.lines.longest as f32 / (2.0 * sweeps * world.spacing);
    settings.tethers && settings.iterations > 1 && left > LITTLE
}

/// Solves all lines.
pub(crate) fn solve(world: &mut World) {
    let is_rigid = is_rigid(world, LinkKind::Stretch);
    take_seats(world, is_rigid);
    let step = world.settings.scheme().step;
    let (lines, links) = (&world.weave.lines, &mut world.weave.links);
    let s = &mut world.scratch.lines;
    if is_rigid {
        solve_rigid(world.level, lines, links, s, 0.0);
    } else {
        solve_soft(world.level, lines, links, s, 1.0 / (step * step));
    }
    leave_seats(world);
}

/// Copies the particles to their seats.
fn take_seats(world: &mut World, is_rigid: bool) {
    let (p, s) = (&world.particles, &mut world.scratch.lines);
    s.points.clear();
    s.points.push([0.0; 4]);
    if world.scratch.packed.is_current {
        let particles = world.scratch.packed.points.iter().zip(&p.w);
        s.points.extend(particles.map(|([x, y, z, _], w)| [*x, *y, *z, *w]));
    } else {
        let particles = p.x.x.iter().zip(&p.x.y).zip(&p.x.z).zip(&p.w);
        s.points.extend(particles.map(|(((x, y), z), w)| [*x, *y, *z, *w]));
    }
    if is_rigid {
        let (to, way) = (&world.scratch.predicted, &world.scratch.way);
        let ways = way.x.iter().zip(&way.y).zip(&way.z);
        let starts = to.x.iter().zip(&to.y).zip(&to.z).zip(ways);
        s.starts.clear();
        s.starts.push([0.0; 4]);
        s.starts.extend(
            starts.map(|(((x, y), z), ((way_x, way_y), way_z))| {
                [x - way_x, y - way_y, z - way_z, 0.0]
            }),
        );
    }
}

/// Copies them back.
fn leave_seats(world: &mut World) {
    let seats = &world.scratch.lines.points[1..];
    if world.scratch.packed.is_current {
        for (point, [x, y, z, _]) in world.scratch.packed.points.iter_mut().zip(seats) {
            *point = [*x, *y, *z, 0.0];
        }
        return;
    }
    let x = &mut world.particles.x;
    let particles = x.x.iter_mut().zip(&mut x.y).zip(&mut x.z);
    for (((x, y), z), seat) in particles.zip(seats) {
        [*x, *y, *z, _] = *seat;
    }
}

leveled! {
    fn solve_rigid(lines: &Lines, links: &mut Links, s: &mut Scratch, scale: f32)
        = solve_all::<false, false>, solve_all::<false, true>
}

leveled! {
    fn solve_soft(lines: &Lines, links: &mut Links, s: &mut Scratch, scale: f32)
        = solve_all::<true, false>, solve_all::<true, true>
}

#[inline(always)]
fn solve_all<const SOFT: bool, const FAST: bool>(
    lines: &Lines,
    links: &mut Links,
    s: &mut Scratch,
    scale: f32,
) {
    for block in &lines.blocks {
        let block = Block {
            links: &lines.links[block.clone()],
            from: &lines.from[block.clone()],
            to: &lines.to[block.clone()],
            rest: &lines.rest[block.clone()],
        };
        block.eliminate::<SOFT, FAST>(links, s, scale);
        block.pull::<SOFT, FAST>(links, s);
        block.go::<FAST>(s);
    }
}

/// Eight lines.
struct Block<'a> {
    links: &'a [[u32; LANES]],
    from: &'a [[u32; LANES]],
    to: &'a [[u32; LANES]],
    rest: &'a [Lanes],
}

impl Block<'_> {
    /// The way there: what each link has to do with the one before goes out of the first system.
    #[inline(always)]
    fn eliminate<const SOFT: bool, const FAST: bool>(
        &self,
        links: &Links,
        s: &mut Scratch,
        scale: f32,
    ) {
        let mut end = [NOBODY; LANES];
        let (mut last, mut start) = ([[0.0; LANES]; 4], [[0.0; LANES]; 4]);
        let (mut n, mut inverse, mut right) = ([[0.0; LANES]; 3], [0.0; LANES], [0.0; LANES]);
        let own = self.from.iter().zip(self.to).zip(self.rest).zip(self.links);
        for ((((from, to), rest), own), step) in own.zip(&mut s.steps) {
            let mut joins = [true; LANES];
            if *from != end {
                (0..LANES).for_each(|i| joins[i] = from[i] == end[i]);
                last = gather::<FAST>(&s.points, from);
                if !SOFT {
                    start = gather::<FAST>(&s.starts, from);
                }
            }
            let next = gather::<FAST>(&s.points, to);
            let mut aim = *rest;
            if !SOFT {
                let was = gather::<FAST>(&s.starts, to);
                aim = self::aim(&start, &was, rest);
                start = was;
            }
            let mut softness = [0.0; LANES];
            if SOFT {
                for i in (0..LANES).filter(|i| own[*i] != NONE) {
                    softness[i] = links.compliance[own[i] as usize] * scale;
                }
            }
            for i in 0..LANES {
                let [dx, dy, dz] = [0, 1, 2].map(|axis| next[axis][i] - last[axis][i]);
                let length = max((dx * dx + dy * dy + dz * dz).sqrt(), TINY);
                let over = 1.0 / length;
                let (nx, ny, nz) = (dx * over, dy * over, dz * over);
                let along = nx * n[0][i] + ny * n[1][i] + nz * n[2][i];
                (n[0][i], n[1][i], n[2][i]) = (nx, ny, nz);
                let before = if joins[i] { -(last[3][i] * along) } else { 0.0 };
                let both = last[3][i] + next[3][i];
                // Between two that are held there is nothing to solve.
                let least = if both > 0.0 { max(both * GIVE, TINY) } else { f32::INFINITY };
                let weight = both * (1.0 + GIVE) + softness[i];
                let share = before * inverse[i];
                inverse[i] = 1.0 / max(weight - share * before, least);
                right[i] = length - aim[i] - share * right[i];
                step.before[i] = before;
                step.over[i] = 1.0 / max(aim[i], TINY);
                step.ratio[i] = length * step.over[i];
            }
            (step.to, step.w) = ([next[0], next[1], next[2]], next[3]);
            (step.n, step.inverse, step.right) = (n, inverse, right);
            (last, end) = (next, *to);
        }
    }

    /// The way back: the multipliers, and with them what each particle has to do with the one after
    /// goes out of the second system.
    #[inline(always)]
    fn pull<const SOFT: bool, const FAST: bool>(&self, links: &mut Links, s: &mut Scratch) {
        let mut begin = [NOBODY; LANES];
        let (mut after, mut coupling) = ([0.0; LANES], [0.0; LANES]);
        // What the link after pulls with at its beginning: of itself, and against going there.
        let (mut m, mut hold) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for k in (0..self.to.len()).rev() {
            let step = &mut s.steps[k];
            let to = &self.to[k];
            let mut joins = [true; LANES];
            if *to != begin {
                (0..LANES).for_each(|i| joins[i] = to[i] == begin[i]);
            }
            for i in 0..LANES {
                after[i] = (step.right[i] - coupling[i] * after[i]) * step.inverse[i];
                let is_taut = after[i] > 0.0;
                let q = if is_taut { after[i] * step.over[i] } else { 0.0 };
                let tension = if is_taut { after[i] * step.ratio[i] } else { after[i] };
                let held = if joins[i] { hold[i] } else { 0.0 };
                let give = step.w[i] / (1.0 + step.w[i] * (q + held));
                let share = give * q;
                for axis in 0..3 {
                    let pull = step.n[axis][i] * tension;
                    let next = if joins[i] { m[axis][i] } else { 0.0 };
                    let own = (next - pull) * give;
                    m[axis][i] = pull + q * own;
                    step.own[axis][i] = own;
                }
                hold[i] = q * (1.0 - share);
                step.share[i] = share;
            }
            coupling = step.before;
            begin = self.from[k];
            if SOFT {
                for i in (0..LANES).filter(|i| self.links[k][*i] != NONE) {
                    links.lambda[self.links[k][i] as usize] = -after[i];
                }
            }
            if k == 0 || begin != self.to[k - 1] {
                let w = gather::<FAST>(&s.points, &begin)[3];
                for i in 0..LANES {
                    let give = w[i] / (1.0 + w[i] * hold[i]);
                    (0..3).for_each(|axis| step.begin[axis][i] = m[axis][i] * give);
                }
            }
        }
    }

    /// There again: the particles go.
    #[inline(always)]
    fn go<const FAST: bool>(&self, s: &mut Scratch) {
        let mut end = [NOBODY; LANES];
        let mut way = [[0.0; LANES]; 3];
        let own = self.from.iter().zip(self.to).zip(self.rest);
        for (number, (((from, to), most), step)) in own.zip(&s.steps).enumerate() {
            if number == 0 || *from != end {
                for i in (0..LANES).filter(|i| number == 0 || from[*i] != end[*i]) {
                    let begin = step.begin.map(|axis| axis[i]);
                    (0..3).for_each(|axis| way[axis][i] = begin[axis]);
                    let point = &mut s.points[from[i] as usize];
                    let limited = limit(begin, most[i]);
                    (0..3).for_each(|axis| point[axis] += limited[axis]);
                }
            }
            let mut is_far = false;
            for i in 0..LANES {
                let [x, y, z] =
                    [0, 1, 2].map(|axis| step.share[i] * way[axis][i] + step.own[axis][i]);
                (way[0][i], way[1][i], way[2][i]) = (x, y, z);
                is_far |= x * x + y * y + z * z > most[i] * most[i];
            }
            let mut moved = way;
            if is_far {
                for i in 0..LANES {
                    let limited = limit([way[0][i], way[1][i], way[2][i]], most[i]);
                    (0..3).for_each(|axis| moved[axis][i] = limited[axis]);
                }
            }
            for (moved, to) in moved.iter_mut().zip(&step.to) {
                (0..LANES).for_each(|i| moved[i] += to[i]);
            }
            scatter::<FAST>(&mut s.points, to, &[moved[0], moved[1], moved[2], step.w]);
            end = *to;
        }
    }
}

/// The lengths that links are to have: what they were when the substep began, mended a little.
#[inline(always)]
fn aim(from: &[Lanes; 4], to: &[Lanes; 4], rest: &Lanes) -> Lanes {
    let mut aim = *rest;
    for i in 0..LANES {
        let [dx, dy, dz] = [0, 1, 2].map(|axis| to[axis][i] - from[axis][i]);
        let was = (dx * dx + dy * dy + dz * dz).sqrt();
        aim[i] += (was - rest[i]) * (1.0 - MEND);
    }
    aim
}

/// A way that is no longer than `most`: lines that cannot be right would fling their particles.
#[inline(always)]
fn limit([x, y, z]: [f32; 3], most: f32) -> [f32; 3] {
    let length2 = x * x + y * y + z * z;
    let share = if length2 > most * most { most / length2.sqrt() } else { 1.0 };
    [x * share, y * share, z * share]
}
