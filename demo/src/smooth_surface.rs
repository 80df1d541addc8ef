//! Smooth surface of a cloth for drawing: a finer mesh, its normals, and how deep each vertex lies
//! in a fold.
//!
//! ```text
//! p ──── a ──•── b ──── q     • = (a + b) / 2 − mean (p − 2a + b, a − 2b + q) / 8      along threads
//! a ──•── b                   • = (a + b) / 2 + bulge of both tangent planes      other meshes
//! ```
//! Method: one round of interpolating subdivision. Edges along the threads of a grid get the
//! four-point rule (Dyn, Levin, Gregory, CAGD 1987) with a limited mean of the second differences, as
//! in the PPH scheme (Amat, Dadourian, Liandrat, 2011): beside a sharp fold it does not overshoot,
//! and layers that nearly touch do not pass through each other. The middle of a cell is the Coons
//! patch of its four sides; edges of other meshes get the middle of a PN triangle's edge (Vlachos et al., I3D
//! 2001). Fold depths are distances to the surface after smoothing by means of neighbours.
//!
//! Reads positions, normals and triangles of a cloth; writes its own lists.
//!
//! Invariant: vertices of the cloth keep their index and their position, and an edge uses only
//! vertices of its own side of a tear.

use glam::{Vec2, Vec3};
use muslin::View;

/// A cloth with more vertices is drawn as it is.
const MAX_REFINED: usize = 4500;
/// Radius of the smoothing that measures fold depths, in drawn metres, and most rounds of it.
const FOLD_RADIUS: f32 = 0.09;
const MAX_ROUNDS: u32 = 12;
/// Marks a neighbour that a border or a tear has no vertex for.
const NONE: u32 = u32::MAX;

/// Rule for the middle of an edge.
#[derive(Clone, Copy, Debug)]
enum Middle {
    /// Four-point rule: the vertex before the edge, its ends, the vertex after it.
    Thread([u32; 4]),
    /// Coons patch: ends of the diagonal, the two other corners, the middles of the four sides.
    Cell([u32; 8]),
    /// PN triangle: the two ends.
    Curved([u32; 2]),
}

/// How a cloth is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weave {
    /// Distance between neighbouring particles [m].
    pub spacing: f32,
    /// Length in the simulation of one drawn metre [m].
    pub unit: f32,
    /// Whether the edges of the mesh follow threads.
    pub is_grid: bool,
    /// Whether to make the mesh finer.
    pub refine: bool,
}

/// A cloth as it is drawn.
#[derive(Debug, Default)]
pub struct SmoothSurface {
    built_for: Option<(u64, Weave)>,
    /// Edges of the cloth, sorted; edge `i` has the vertex `coarse + i`.
    edges: Vec<[u32; 2]>,
    middles: Vec<Middle>,
    /// Number of edges at each vertex of the cloth.
    valence: Vec<f32>,
    smoothed: [Vec<Vec3>; 2],
    is_refined: bool,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    frayed: Vec<bool>,
    hollows: Vec<f32>,
    indices: Vec<u32>,
    coarse_indices: Vec<u32>,
}

impl SmoothSurface {
    /// Updates the surface to the present state of a cloth, as `weave` describes it; `revision`
    /// changes with its triangles.
    pub fn update(&mut self, view: &View<'_>, weave: Weave, revision: u64) {
        if self.built_for != Some((revision, weave)) {
            self.built_for = Some((revision, weave));
            self.rebuild(view, weave);
        }
        self.measure_folds(view, weave);
        self.positions.clear();
        self.normals.clear();
        self.positions.extend_from_slice(view.positions);
        self.normals.extend_from_slice(view.normals);
        if self.is_refined {
            self.refine(view);
        }
    }

    /// Returns the positions [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns the unit normals of the front.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Returns the texture coordinates.
    pub fn uvs(&self) -> &[Vec2] {
        &self.uvs
    }

    /// Returns whether each vertex lies on a torn or cut edge.
    pub fn frayed(&self) -> &[bool] {
        &self.frayed
    }

    /// Returns how far each vertex lies behind its surroundings, as seen from the front [m];
    /// negative on ridges.
    pub fn hollows(&self) -> &[f32] {
        &self.hollows
    }

    /// Returns three vertex indices per triangle.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Returns three vertex indices per triangle of the cloth.
    pub fn coarse_indices(&self) -> &[u32] {
        &self.coarse_indices
    }

    /// Rebuilds all that follows from the triangles.
    fn rebuild(&mut self, view: &View<'_>, weave: Weave) {
        let coarse = view.positions.len() as u32;
        self.edges.clear();
        for [a, b, c] in triangles(view.indices) {
            self.edges.extend([[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]));
        }
        self.edges.sort_unstable();
        let mut sides = self.edges.chunk_by(PartialEq::eq).map(<[_]>::len).collect::<Vec<_>>();
        self.edges.dedup();
        self.valence.clear();
        self.valence.resize(coarse as usize, 0.0);
        for end in self.edges.as_flattened() {
            self.valence[*end as usize] += 1.0;
        }
        self.uvs.clear();
        self.frayed.clear();
        self.indices.clear();
        self.middles.clear();
        self.coarse_indices.clear();
        self.coarse_indices.extend_from_slice(view.indices);
        self.uvs.extend_from_slice(view.uvs);
        self.frayed.extend_from_slice(view.frayed);
        self.is_refined = weave.refine && view.positions.len() <= MAX_REFINED;
        if !self.is_refined {
            self.indices.extend_from_slice(view.indices);
            return;
        }
        for ([a, b], sides) in self.edges.iter().zip(sides.drain(..)) {
            let [a, b] = [*a as usize, *b as usize];
            self.uvs.push(0.5 * (view.uvs[a] + view.uvs[b]));
            self.frayed.push(sides == 1 && view.frayed[a] && view.frayed[b]);
        }
        self.middles.extend(self.edges.iter().map(|ends| Middle::Curved(*ends)));
        if weave.is_grid {
            self.find_threads(view);
        }
        for [a, b, c] in triangles(view.indices) {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|edge| self.middle_of(coarse, edge));
            self.indices.extend([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]);
        }
    }

    /// Sets the rules of a grid: edges along the threads, and diagonals of whole cells.
    fn find_threads(&mut self, view: &View<'_>) {
        let coarse = view.positions.len() as u32;
        let mut neighbours: Vec<[u32; 2]> =
            self.edges.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]).collect();
        neighbours.sort_unstable();
        let after = |a: u32, b: u32| {
            let [from, to] = [a, b].map(|i| view.uvs[i as usize]);
            let first = neighbours.partition_point(|[at, _]| *at < b);
            let around = neighbours[first..].iter().take_while(|[at, _]| *at == b);
            let near = 0.1 * from.distance(to);
            let ahead = |i: &u32| view.uvs[*i as usize].distance(2.0 * to - from) < near;
            around.map(|[_, i]| *i).find(ahead).unwrap_or(NONE)
        };
        for (middle, [a, b]) in self.middles.iter_mut().zip(&self.edges) {
            let side = (view.uvs[*b as usize] - view.uvs[*a as usize]).abs();
            if side.min_element() < 0.1 * side.max_element() {
                *middle = Middle::Thread([after(*b, *a), *a, *b, after(*a, *b)]);
            }
        }
        // Third corners of the triangles at each diagonal.
        let mut others = vec![[NONE; 2]; self.edges.len()];
        for triangle in triangles(view.indices) {
            for i in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|j| triangle[(i + j) % 3]);
                let other = &mut others[(self.middle_of(coarse, [a, b]) - coarse) as usize];
                other[usize::from(other[0] != NONE)] = c;
            }
        }
        for (i, [c, d]) in others.into_iter().enumerate() {
            if !matches!(self.middles[i], Middle::Curved(_)) || d == NONE {
                continue;
            }
            let [a, b] = self.edges[i];
            let sides = [[a, c], [c, b], [b, d], [d, a]].map(|edge| self.middle_of(coarse, edge));
            // Beside a cut, cells are not whole.
            let is_thread =
                |side: &u32| matches!(self.middles[(*side - coarse) as usize], Middle::Thread(_));
            if sides.iter().all(is_thread) {
                let [p, q, r, s] = sides;
                self.middles[i] = Middle::Cell([a, b, c, d, p, q, r, s]);
            }
        }
    }

    /// Returns the vertex in the middle of an edge.
    fn middle_of(&self, coarse: u32, [a, b]: [u32; 2]) -> u32 {
        let place = self.edges.binary_search(&[a.min(b), a.max(b)]);
        coarse + place.unwrap_or_default() as u32
    }

    /// Measures the fold depths of the vertices of the cloth, and of the middles of edges.
    fn measure_folds(&mut self, view: &View<'_>, weave: Weave) {
        let [now, next] = &mut self.smoothed;
        now.clear();
        now.extend_from_slice(view.positions);
        let cells = FOLD_RADIUS * weave.unit / weave.spacing.max(1.0e-4);
        // Each round spreads by two thirds of a squared cell.
        let rounds = (1.5 * cells * cells).round().clamp(1.0, MAX_ROUNDS as f32) as u32;
        for _ in 0..rounds {
            next.clear();
            next.resize(now.len(), Vec3::ZERO);
            for [a, b] in &self.edges {
                let [a, b] = [*a as usize, *b as usize];
                next[a] += now[b];
                next[b] += now[a];
            }
            for ((next, now), valence) in next.iter_mut().zip(now.iter()).zip(&self.valence) {
                *next = if *valence > 0.0 { *next / *valence } else { *now };
            }
            std::mem::swap(now, next);
        }
        self.hollows.clear();
        let around = now.iter().zip(view.positions).zip(view.normals);
        self.hollows.extend(around.map(|((mean, at), normal)| (*mean - *at).dot(*normal)));
        if self.is_refined {
            let hollows = &mut self.hollows;
            hollows.reserve(self.edges.len());
            for [a, b] in &self.edges {
                hollows.push(0.5 * (hollows[*a as usize] + hollows[*b as usize]));
            }
        }
    }

    /// Appends the middles of the edges to positions and normals.
    fn refine(&mut self, view: &View<'_>) {
        subdivide(&self.middles, &mut self.positions, |positions, [a, b]| {
            let [m, n] = [a, b].map(|i| view.normals[i as usize]);
            let side = positions[b as usize] - positions[a as usize];
            let middle = 0.5 * (positions[a as usize] + positions[b as usize]);
            middle + 0.125 * (side.dot(n) * n - side.dot(m) * m)
        });
        subdivide(&self.middles, &mut self.normals, |normals, [a, b]| {
            let sum = normals[a as usize] + normals[b as usize];
            // The mean is mirrored at the plane through the middle of the edge.
            let side =
                (view.positions[b as usize] - view.positions[a as usize]).normalize_or_zero();
            sum - 2.0 * side.dot(sum) * side
        });
        for normal in &mut self.normals[view.normals.len()..] {
            *normal = normal.normalize_or_zero();
        }
    }
}

/// Appends to `values` one for each of `middles`; `curved` has the rule of PN triangles.
fn subdivide(
    middles: &[Middle],
    values: &mut Vec<Vec3>,
    curved: impl Fn(&[Vec3], [u32; 2]) -> Vec3,
) {
    let coarse = values.len();
    values.resize(coarse + middles.len(), Vec3::ZERO);
    for (i, middle) in middles.iter().enumerate() {
        let at = |i: u32| values[i as usize];
        values[coarse + i] = match *middle {
            // Beyond a border the curve goes on as a parabola.
            Middle::Thread([NONE, a, b, NONE]) => 0.5 * (at(a) + at(b)),
            Middle::Thread([NONE, a, b, c]) | Middle::Thread([c, b, a, NONE]) => {
                0.375 * at(a) + 0.75 * at(b) - 0.125 * at(c)
            }
            Middle::Thread([p, a, b, q]) => {
                let [p, a, b, q] = [p, a, b, q].map(at);
                0.5 * (a + b) - 0.125 * limited_mean(p - 2.0 * a + b, a - 2.0 * b + q)
            }
            Middle::Curved(ends) => curved(values, ends),
            Middle::Cell(_) => Vec3::ZERO,
        };
    }
    for (i, middle) in middles.iter().enumerate() {
        if let Middle::Cell([a, b, c, d, p, q, r, s]) = *middle {
            let sum = |four: [u32; 4]| four.iter().map(|i| values[*i as usize]).sum::<Vec3>();
            values[coarse + i] = 0.5 * sum([p, q, r, s]) - 0.25 * sum([a, b, c, d]);
        }
    }
}

/// Mean of two second differences in which the smaller one outweighs the larger one; zero where they
/// point to opposite sides.
fn limited_mean(a: Vec3, b: Vec3) -> Vec3 {
    let (aa, bb) = (a.length_squared(), b.length_squared());
    if a.dot(b) > 0.0 { (a * bb + b * aa) / (aa + bb) } else { Vec3::ZERO }
}

fn triangles(indices: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    indices.as_chunks::<3>().0.iter().copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::{Cloth, GridDesc, Result};

    /// A cloth of 9 × 9 particles, 0.1 m apart, with its particles moved to `place`.
    fn cloth(place: impl Fn(Vec3) -> Vec3) -> Result<Cloth> {
        let desc = GridDesc { columns: 9, rows: 9, spacing: 0.1, ..GridDesc::default() };
        let mut cloth = Cloth::grid(&desc)?;
        for i in 0..81 {
            let at = cloth.positions()[i as usize];
            cloth.set_position(i, place(at))?;
        }
        Ok(cloth)
    }

    fn smooth(cloth: &mut Cloth, is_grid: bool) -> SmoothSurface {
        let mut smooth = SmoothSurface::default();
        let weave = Weave { spacing: 0.1, unit: 1.0, is_grid, refine: true };
        smooth.update(&cloth.view(), weave, 1);
        smooth
    }

    #[test]
    fn a_flat_cloth_stays_flat_and_keeps_its_vertices() {
        let mut cloth = cloth(|at| at).unwrap();
        let surface = smooth(&mut cloth, true);
        let view = cloth.view();
        assert_eq!(surface.positions()[..81], *view.positions);
        assert_eq!(surface.indices().len(), 4 * view.indices.len());
        let plane = view.positions[0].z;
        for (at, normal) in surface.positions().iter().zip(surface.normals()) {
            assert!(
                (at.z - plane).abs() < 1.0e-6 && normal.z.abs() > 1.0 - 1.0e-6,
                "{at} {normal}"
            );
        }
        let uneven = surface.indices().as_chunks::<3>().0.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|i| surface.positions()[i as usize]);
            ((b - a).cross(c - a).length() - 0.05 * 0.05).abs()
        });
        assert!(uneven.fold(0.0, f32::max) < 1.0e-6);
        let [low, high] =
            [f32::min, f32::max].map(|of| surface.hollows().iter().copied().fold(0.0, of));
        assert!(high - low < 1.0e-6);
    }

    #[test]
    fn between_particles_on_a_cylinder_the_surface_is_round() {
        let radius = 0.2;
        let bend = |at: Vec3| {
            let (sin, cos) = (at.x / radius).sin_cos();
            Vec3::new(radius * sin, at.y, -radius * cos)
        };
        let mut cloth = cloth(bend).unwrap();
        for is_grid in [true, false] {
            let surface = smooth(&mut cloth, is_grid);
            let sagitta = radius * (1.0 - (0.05 / radius).cos());
            let vertices = surface.positions().iter().zip(surface.normals()).zip(surface.uvs());
            for ((at, normal), uv) in vertices {
                let axis = Vec3::new(at.x, 0.0, at.z);
                let off = (axis.length() - radius).abs();
                // A particle on the border has the normal of the triangles on its one side.
                if uv.x > 0.2 && uv.x < 0.8 {
                    let along = normal.dot(axis.normalize()).abs();
                    assert!(off < 0.12 * sagitta, "{off} m off the cylinder, grid: {is_grid}");
                    assert!(along > 0.999, "{normal} at {at}, grid: {is_grid}");
                } else if is_grid {
                    assert!(off < 0.30 * sagitta, "{off} m off the cylinder at the border");
                }
            }
        }
    }

    #[test]
    fn beside_a_sharp_fold_the_surface_stays_flat() {
        let mut cloth = cloth(|at| at.with_z(2.0 * (at.x - 0.4).abs())).unwrap();
        for at in smooth(&mut cloth, true).positions() {
            assert!((at.z - 2.0 * (at.x - 0.4).abs()).abs() < 1.0e-5, "{at} is off its side");
        }
    }

    #[test]
    fn a_trough_is_hollow_on_the_front_and_a_crest_on_the_back() {
        let mut cloth = cloth(|at| at.with_z(0.05 * (at.x * 16.0).cos())).unwrap();
        let surface = smooth(&mut cloth, true);
        let view = cloth.view();
        let inner = (9..72).filter(|i| i % 9 > 1 && i % 9 < 7);
        for i in inner {
            let hollow = surface.hollows()[i] * view.normals[i].z.signum();
            let height = view.positions[i].z;
            assert!(height.abs() < 0.03 || hollow * height < 0.0, "{hollow} m at height {height}");
        }
    }

    #[test]
    fn beside_a_cut_no_middle_is_far_from_its_edge() {
        let mut cloth = cloth(|at| at).unwrap();
        let middle = cloth.positions()[40];
        let [from, to] = [Vec3::new(-0.9, 0.13, -1.0), Vec3::new(0.31, -0.22, -1.0)];
        cloth.cut(middle + from, middle + to, Vec3::Z * 2.0).unwrap();
        let surface = smooth(&mut cloth, true);
        let count = cloth.positions().len();
        assert!(count > 90, "{count} vertices: nothing is cut");
        for (middle, ends) in surface.positions()[count..].iter().zip(&surface.edges) {
            let [a, b] = ends.map(|i| cloth.positions()[i as usize]);
            let far = middle.distance(0.5 * (a + b));
            assert!(far < 0.3 * a.distance(b), "{middle} is {far} m off the middle of {a} and {b}");
        }
    }

    #[test]
    fn a_tear_does_not_bend_the_surface_of_its_sides() {
        // Two strips of three vertices with a gap; the texture coordinates go on across it.
        let column = [0.0, 1.0, 2.0, 2.0, 3.0, 4.0];
        let positions: Vec<_> = [0.0, 1.0]
            .iter()
            .flat_map(|y| column.map(|x| Vec3::new(x, *y, if x > 2.0 { 5.0 } else { 0.0 })))
            .collect();
        let mut positions = positions;
        positions[3].z = 5.0;
        positions[9].z = 5.0;
        let uvs: Vec<_> =
            [0.0, 1.0].iter().flat_map(|y| column.map(|x| Vec2::new(x, *y) / 4.0)).collect();
        let cells = [0, 1, 3, 4];
        let indices: Vec<u32> =
            cells.iter().flat_map(|i| [*i, i + 6, i + 1, i + 1, i + 6, i + 7]).collect();
        let normals = vec![Vec3::Z; 12];
        let frayed: Vec<_> = (0..12).map(|i| i % 6 == 2 || i % 6 == 3).collect();
        let numbers: Vec<u32> = (0..12).collect();
        let view = View {
            positions: &positions,
            normals: &normals,
            uvs: &uvs,
            indices: &indices,
            source_vertices: &numbers,
            particles: &numbers,
            frayed: &frayed,
            vertex_capacity: 12,
            index_capacity: 24,
            topology_revision: 1,
            state_revision: 1,
        };
        let mut surface = SmoothSurface::default();
        surface.update(&view, Weave { spacing: 1.0, unit: 1.0, is_grid: true, refine: true }, 1);
        assert!(surface.positions().iter().all(|at| at.z == 0.0 || at.z == 5.0));
        let torn = surface.frayed()[12..].iter().filter(|torn| **torn).count();
        assert_eq!(torn, 2, "one middle on each side of the tear");
    }
}
