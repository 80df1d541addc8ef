//! Stage `Stretch`, once a substep: every line of links is solved as a whole.
//!
//! The links of a line are coupled only to their neighbours in it, so their multipliers are those of
//! a tridiagonal system, which is solved in one way there and one back (Thomas):
//!
//! ```text
//! (w₋ + w₊ + α̃) λ − w₋ (n₋·n) λ₋ − w₊ (n·n₊) λ₊ = C
//! ```
//! So a load at one end is borne by the whole line at once. Eight lines go side by side; each lane is
//! a line of its own, so that lanes change no bits.

use super::World;
use super::packed;
use crate::fabric::lines::Lines;
use crate::fabric::links::Links;
use crate::math::simd::{LANES, Lanes, gather, leveled, scatter};
use crate::math::{TINY, max};
use crate::mesh::NONE;
use core::ops::Range;

/// What a taut line gives way by, as a share of its weight: pulled from both ends its system has no
/// solution.
const GIVE: f32 = 1.0e-6;

/// Columns of a block's links, step by step, eight lanes each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    /// The particles that they run from and to: x, y, z and inverse mass.
    from: [Vec<Lanes>; 4],
    to: [Vec<Lanes>; 4],
    /// 1 where a link begins where the one before ends.
    joins: Vec<Lanes>,
    /// Their directions, then what they pull with.
    n: [Vec<Lanes>; 3],
    /// The system's diagonal, and its least pivot.
    weight: Vec<Lanes>,
    least: Vec<Lanes>,
    /// What the link before has to do with it.
    before: Vec<Lanes>,
    /// The system's right side, then its solution.
    right: Vec<Lanes>,
    /// One over the pivots.
    inverse: Vec<Lanes>,
    /// How far each `to` goes [m].
    way: [Vec<Lanes>; 3],
}

impl Scratch {
    /// Room for a block of so many steps.
    pub fn new(steps: usize) -> Self {
        let list = || vec![[0.0; LANES]; steps];
        Self {
            from: [list(), list(), list(), list()],
            to: [list(), list(), list(), list()],
            joins: list(),
            n: [list(), list(), list()],
            weight: list(),
            least: list(),
            before: list(),
            right: list(),
            inverse: list(),
            way: [list(), list(), list()],
        }
    }
}

/// Some steps of a column as one list.
#[inline(always)]
fn flat(list: &[Lanes], steps: Range<usize>) -> &[f32] {
    list[steps].as_flattened()
}

#[inline(always)]
fn flat_mut(list: &mut [Lanes], steps: Range<usize>) -> &mut [f32] {
    list[steps].as_flattened_mut()
}

/// Solves all lines.
pub(crate) fn solve(world: &mut World, is_rigid: bool) {
    let scheme = world.settings.scheme();
    let scale = 1.0 / (scheme.step * scheme.step);
    let is_columns = !world.scratch.packed.is_current;
    if is_columns {
        packed::pack(world);
    }
    let (lines, links) = (&world.weave.lines, &mut world.weave.links);
    let (points, scratch) = (&mut world.scratch.packed.points, &mut world.scratch.lines);
    if is_rigid {
        solve_rigid(world.level, lines, links, points, scratch, scale);
    } else {
        solve_soft(world.level, lines, links, points, scratch, scale);
    }
    if is_columns {
        packed::unpack(world);
    }
}

leveled! {
    fn solve_rigid(
        lines: &Lines, links: &mut Links, points: &mut [[f32; 4]], s: &mut Scratch, scale: f32,
    ) = solve_all::<false, false>, solve_all::<false, true>
}

leveled! {
    fn solve_soft(
        lines: &Lines, links: &mut Links, points: &mut [[f32; 4]], s: &mut Scratch, scale: f32,
    ) = solve_all::<true, false>, solve_all::<true, true>
}

#[inline(always)]
fn solve_all<const SOFT: bool, const FAST: bool>(
    lines: &Lines,
    links: &mut Links,
    points: &mut [[f32; 4]],
    s: &mut Scratch,
    scale: f32,
) {
    for block in &lines.blocks {
        let steps = block.len();
        fetch::<FAST>(lines, block.clone(), points, s);
        measure(&lines.rest[block.clone()], s, steps);
        if SOFT {
            soften(lines.links[block.clone()].as_flattened(), links, s, scale);
        }
        couple(s, steps);
        eliminate(s, steps);
        substitute(s, steps);
        if SOFT {
            remember(lines.links[block.clone()].as_flattened(), links, s);
        }
        pull(&lines.rest[block.clone()], s, steps);
        put::<FAST>(lines, block.clone(), points, s);
    }
}

/// Looks up the particles of a block.
#[inline(always)]
fn fetch<const FAST: bool>(
    lines: &Lines,
    block: Range<usize>,
    points: &[[f32; 4]],
    s: &mut Scratch,
) {
    let (mut last, mut end) = ([[0.0; LANES]; 4], [lines.nobody; LANES]);
    let steps = block.len();
    let begins = s.from.each_mut().map(|list| &mut list[..steps]);
    let ends = s.to.each_mut().map(|list| &mut list[..steps]);
    let (joins, own) = (&mut s.joins[..steps], lines.from[block.clone()].iter());
    for (k, (from, to)) in own.zip(&lines.to[block]).enumerate() {
        joins[k] = [1.0; LANES];
        if *from != end {
            last = gather::<FAST>(points, from);
            (0..LANES).for_each(|i| joins[k][i] = if from[i] == end[i] { 1.0 } else { 0.0 });
        }
        (0..4).for_each(|number| begins[number][k] = last[number]);
        (last, end) = (gather::<FAST>(points, to), *to);
        (0..4).for_each(|number| ends[number][k] = last[number]);
    }
}

/// Directions, how far each link is from its length, and the diagonal.
#[inline(always)]
fn measure(rest: &[Lanes], s: &mut Scratch, steps: usize) {
    let count = LANES * steps;
    let [xa, ya, za, wa] = s.from.each_ref().map(|list| flat(list, 0..steps));
    let [xb, yb, zb, wb] = s.to.each_ref().map(|list| flat(list, 0..steps));
    let [nx, ny, nz] = s.n.each_mut().map(|list| flat_mut(list, 0..steps));
    let (right, weight) = (flat_mut(&mut s.right, 0..steps), flat_mut(&mut s.weight, 0..steps));
    let (least, rest) = (flat_mut(&mut s.least, 0..steps), flat(rest, 0..steps));
    for i in 0..count {
        let (dx, dy, dz) = (xb[i] - xa[i], yb[i] - ya[i], zb[i] - za[i]);
        let length = max((dx * dx + dy * dy + dz * dz).sqrt(), TINY);
        let over = 1.0 / length;
        (nx[i], ny[i], nz[i]) = (dx * over, dy * over, dz * over);
        right[i] = length - rest[i];
        let both = wa[i] + wb[i];
        weight[i] = both * (1.0 + GIVE);
        // Between two that are held there is nothing to solve.
        least[i] = if both > 0.0 { max(both * GIVE, TINY) } else { f32::INFINITY };
    }
}

/// Soft links give way by their compliance.
#[inline(always)]
fn soften(own: &[u32], links: &Links, s: &mut Scratch, scale: f32) {
    let (weight, right) = (s.weight.as_flattened_mut(), s.right.as_flattened_mut());
    for (i, link) in own.iter().enumerate().filter(|(_, link)| **link != NONE) {
        let softness = links.compliance[*link as usize] * scale;
        weight[i] += softness;
        right[i] += softness * links.lambda[*link as usize];
    }
}

/// What each link has to do with the one before.
#[inline(always)]
fn couple(s: &mut Scratch, steps: usize) {
    s.before[0] = [0.0; LANES];
    let (last, rest) = (0..steps - 1, 1..steps);
    let [px, py, pz] = s.n.each_ref().map(|list| flat(list, last.clone()));
    let [nx, ny, nz] = s.n.each_ref().map(|list| flat(list, rest.clone()));
    let (w, joins) = (flat(&s.from[3], rest.clone()), flat(&s.joins, rest.clone()));
    let before = flat_mut(&mut s.before, rest);
    for i in 0..before.len() {
        let along = nx[i] * px[i] + ny[i] * py[i] + nz[i] * pz[i];
        before[i] = -(w[i] * along) * joins[i];
    }
}

/// The way there: every link gets rid of what the one before has to do with it.
#[inline(always)]
fn eliminate(s: &mut Scratch, steps: usize) {
    let (mut inverse, mut right) = ([0.0; LANES], [0.0; LANES]);
    let (before, weight, least) = (&s.before[..steps], &s.weight[..steps], &s.least[..steps]);
    let (rights, inverses) = (&mut s.right[..steps], &mut s.inverse[..steps]);
    for k in 0..steps {
        let own = rights[k];
        for i in 0..LANES {
            let share = before[k][i] * inverse[i];
            inverse[i] = 1.0 / max(weight[k][i] - share * before[k][i], least[k][i]);
            right[i] = own[i] - share * right[i];
        }
        (inverses[k], rights[k]) = (inverse, right);
    }
}

/// The way back: multipliers from the last to the first.
#[inline(always)]
fn substitute(s: &mut Scratch, steps: usize) {
    let (mut after, mut coupling) = ([0.0; LANES], [0.0; LANES]);
    let (before, inverse) = (&s.before[..steps], &s.inverse[..steps]);
    let right = &mut s.right[..steps];
    for k in (0..steps).rev() {
        for i in 0..LANES {
            after[i] = (right[k][i] - coupling[i] * after[i]) * inverse[k][i];
        }
        (coupling, right[k]) = (before[k], after);
    }
}

/// Soft links remember what they bear.
#[inline(always)]
fn remember(own: &[u32], links: &mut Links, s: &Scratch) {
    for (link, after) in own.iter().zip(s.right.as_flattened()).filter(|(link, _)| **link != NONE) {
        links.lambda[*link as usize] -= after;
    }
}

/// What multipliers do to the particles: where two links meet, what is left of both pulls.
#[inline(always)]
fn pull(most: &[Lanes], s: &mut Scratch, steps: usize) {
    let (after, w) = (flat(&s.right, 0..steps), flat(&s.to[3], 0..steps));
    let (most, joins) = (flat(most, 0..steps), flat(&s.joins, 1..steps));
    for (n, way) in s.n.iter_mut().zip(&mut s.way) {
        let (n, way) = (flat_mut(n, 0..steps), flat_mut(way, 0..steps));
        for i in 0..n.len() {
            n[i] *= after[i];
        }
        let next = &n[LANES..];
        for i in 0..next.len() {
            way[i] = (next[i] * joins[i] - n[i]) * w[i];
        }
        for i in next.len()..n.len() {
            way[i] = -n[i] * w[i];
        }
    }
    let [x, y, z] = s.way.each_mut().map(|list| flat_mut(list, 0..steps));
    let over = flat_mut(&mut s.least, 0..steps);
    for i in 0..over.len() {
        over[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i] - most[i] * most[i];
    }
    let mut far = [0.0; LANES];
    for over in &s.least[..steps] {
        for i in 0..LANES {
            far[i] = max(over[i], far[i]);
        }
    }
    if far != [0.0; LANES] {
        for i in 0..most.len() {
            [x[i], y[i], z[i]] = limit([x[i], y[i], z[i]], most[i]);
        }
    }
}

/// A way that is no longer than `most`: lines that cannot be right would fling their particles.
#[inline(always)]
fn limit([x, y, z]: [f32; 3], most: f32) -> [f32; 3] {
    let length2 = x * x + y * y + z * z;
    let share = if length2 > most * most { most / length2.sqrt() } else { 1.0 };
    [x * share, y * share, z * share]
}

/// Puts the particles of a block where they belong.
#[inline(always)]
fn put<const FAST: bool>(
    lines: &Lines,
    block: Range<usize>,
    points: &mut [[f32; 4]],
    s: &mut Scratch,
) {
    let steps = block.len();
    for (to, way) in s.to.iter_mut().zip(&s.way) {
        let (to, way) = (flat_mut(to, 0..steps), flat(way, 0..steps));
        for i in 0..to.len() {
            to[i] += way[i];
        }
    }
    let mut end = [lines.nobody; LANES];
    let [x, y, z, w] = s.to.each_ref().map(|list| &list[..steps]);
    let own = lines.from[block.clone()].iter().zip(&lines.to[block.clone()]);
    for (k, (from, to)) in own.enumerate() {
        if *from != end {
            begin(k, from, &end, &lines.rest[block.start + k], points, s);
        }
        scatter::<FAST>(points, to, &[x[k], y[k], z[k], w[k]]);
        end = *to;
    }
}

/// Where lines begin, the pull of their first links is all there is.
#[inline(always)]
fn begin(
    k: usize,
    from: &[u32; LANES],
    end: &[u32; LANES],
    most: &Lanes,
    points: &mut [[f32; 4]],
    s: &Scratch,
) {
    for i in (0..LANES).filter(|i| from[*i] != end[*i]) {
        let w = s.from[3][k][i];
        let way = limit([0, 1, 2].map(|axis| s.n[axis][k][i] * w), most[i]);
        let point = &mut points[from[i] as usize];
        for axis in 0..3 {
            point[axis] += way[axis];
        }
    }
}
