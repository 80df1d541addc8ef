//! Construction of all links of a cloth from its mesh.
//!
//! ```text
//! grid:   stretch along weft and warp      mesh:  stretch along every edge
//!         shear along both diagonals              bend across every inner edge
//!         bend over two cells
//!         4 colours per kind                      greedy colours
//! ```
//! Spring constants of edges: Van Gelder, "Approximate simulation of elastic membranes by
//! triangulated spring meshes", JGT 1998.
//!
//! Reads `Mesh` and rest positions; writes `Constraints`. `dynamic_links` and `cut_links` update
//! them after tears and cuts.
//!
//! Invariant: links of one batch share no particle, so the order inside a batch does not change the
//! result.

use crate::math::heap_bytes::heap_bytes;
use crate::math::shared::Shared;
use crate::math::sort::sort_groups;
use crate::mesh::{Corner, Mesh, NONE, next_corner, prev_corner, triangle_of};
use crate::model::chains::Chains;
use crate::model::coloring;
use crate::model::coloring::Coloring;
use crate::model::grid_rows::GridRows;
use crate::model::hinges::Hinges;
use crate::model::links::{LinkBatch, LinkKind, LinkSpec, LinkSupport, Links, ThreadDirection};
use crate::model::maps::Maps;
use crate::model::material::Material;
use crate::model::sparse_links::SparseLinks;
use core::ops::Range;
use glam::Vec3;

/// All links of a cloth, with indices over them.
#[derive(Clone, Debug)]
pub(crate) struct Constraints {
    /// Links created with the cloth, batch by batch.
    pub links: Links,
    /// Batches of `links`, sorted by kind.
    pub batches: Vec<LinkBatch>,
    /// The links of a grid as rows.
    pub rows: Option<GridRows>,
    /// The stretch links as chains.
    pub chains: Chains,
    /// Hinges, which resist bending on a mesh that is not a grid.
    pub hinges: Hinges,
    /// Whether the definition of a link in `links` has changed since creation.
    pub(super) is_changed: Shared<Vec<bool>>,
    /// Links added by tears and cuts, in order of creation, see `dynamic_links`.
    pub dynamic: Links,
    /// Active dynamic links by colour; valid after `rebuild_sparse`.
    pub sparse: SparseLinks,
    /// Scratch for the colouring of dynamic links.
    pub(super) coloring: Coloring,
    /// Sites that each dynamic link depends on; `NONE` if there are fewer.
    pub(super) dynamic_sites: Vec<[u32; 4]>,
    /// Number of the link along the edge that starts at each corner, see `dynamic_links`; `NONE` on
    /// the second side of an inner edge.
    pub(super) link_of_edge: Shared<Vec<u32>>,
    /// Links that depend on each original vertex (CSR):
    /// `links_by_site[first_of_site[v]..first_of_site[v + 1]]`. Empty until the cloth can tear.
    pub(super) first_of_site: Shared<Vec<u32>>,
    pub(super) links_by_site: Shared<Vec<u32>>,
    /// Dynamic links of each site, as linked lists.
    pub(super) dynamic_head: Vec<u32>,
    pub(super) dynamic_next: Vec<[u32; 4]>,
    /// Unit vectors along weft and warp of a grid at rest; `None` for other meshes.
    pub(super) thread_directions: Option<[Vec3; 2]>,
}

heap_bytes!(
    Constraints {
        links, batches, rows, chains, hinges, is_changed, dynamic, sparse, coloring,
        dynamic_sites, link_of_edge, first_of_site, links_by_site, dynamic_head, dynamic_next,
    } plain { thread_directions }
);

/// A link before sorting by colour.
struct LinkDraft {
    spec: LinkSpec,
    rest: f32,
    color: u32,
}

impl Constraints {
    /// Creates the links of a regular grid, with four colours per kind. Allocates for
    /// `opening_capacity` dynamic links.
    pub fn from_grid(
        columns: u32,
        rows: u32,
        spacing: f32,
        mesh: &Mesh,
        opening_capacity: usize,
    ) -> Self {
        let edges = EdgeIndex::new(mesh);
        let at = |row: u32, column: u32| row * columns + column;
        let border_scale = |at_border: bool| if at_border { 0.5 } else { 1.0 };
        let mut drafts = Vec::new();
        for (thread, base) in [(ThreadDirection::Weft, 0), (ThreadDirection::Warp, 2)] {
            for_each_grid_link(columns, rows, thread, 1, |along, at_border, a, b| {
                let (edge, stiffness_scale) = (edges.edge_between(a, b), border_scale(at_border));
                let spec =
                    edge_link(mesh, edge, [a, b], LinkKind::Stretch, thread, stiffness_scale);
                drafts.push(LinkDraft { spec, rest: spacing, color: base + along % 2 });
            });
        }
        let diagonal = spacing * 2.0_f32.sqrt();
        for (base, falls) in [(4, true), (6, false)] {
            for row in 0..rows - 1 {
                for column in 0..columns - 1 {
                    let (a, b) = if falls {
                        (at(row, column), at(row + 1, column + 1))
                    } else {
                        (at(row, column + 1), at(row + 1, column))
                    };
                    let first = 2 * (row * (columns - 1) + column);
                    let is_edge = (row + column).is_multiple_of(2) == falls;
                    let spec = if is_edge {
                        edge_link(
                            mesh,
                            edges.edge_between(a, b),
                            [a, b],
                            LinkKind::Shear,
                            ThreadDirection::Warp,
                            1.0,
                        )
                    } else {
                        let edge = edge_between_triangles(mesh, first, first + 1);
                        let (ta, tb) = if mesh.corner_in(first, a).is_some() {
                            (first, first + 1)
                        } else {
                            (first + 1, first)
                        };
                        let ends = [corner(mesh, ta, a), corner(mesh, tb, b)];
                        let support = LinkSupport::AcrossEdge(edge);
                        LinkSpec {
                            kind: LinkKind::Shear,
                            direction: ThreadDirection::Warp,
                            ends,
                            support,
                            stiffness_scale: 1.0,
                        }
                    };
                    drafts.push(LinkDraft { spec, rest: diagonal, color: base + row % 2 });
                }
            }
        }
        for (thread, base) in [(ThreadDirection::Weft, 8), (ThreadDirection::Warp, 10)] {
            for_each_grid_link(columns, rows, thread, 2, |along, at_border, a, b| {
                let middle = (a + b) / 2;
                let (left, right) = (edges.edge_between(a, middle), edges.edge_between(middle, b));
                let spec = LinkSpec {
                    kind: LinkKind::Bend,
                    direction: thread,
                    ends: [corner(mesh, left / 3, a), corner(mesh, right / 3, b)],
                    support: LinkSupport::TwoEdges([
                        corner(mesh, left / 3, middle),
                        corner(mesh, right / 3, middle),
                    ]),
                    stiffness_scale: border_scale(at_border)
                        * bend_link_stiffness(spacing, 2.0 * spacing),
                };
                drafts.push(LinkDraft { spec, rest: 2.0 * spacing, color: base + along / 2 % 2 });
            });
        }
        let mut constraints = Self::from_drafts(mesh, drafts, opening_capacity);
        let starts: Vec<usize> = constraints.batches.iter().map(|batch| batch.first).collect();
        let mut rows = GridRows::new(
            columns,
            [&constraints.links.a, &constraints.links.b],
            &constraints.links.rest,
            &starts,
        );
        if opening_capacity > 0 {
            rows.reserve();
        }
        constraints.rows = Some(rows);
        constraints
    }

    /// Creates the links of any mesh: a stretch link along every edge, a bend link across every
    /// inner edge. Allocates for `opening_capacity` dynamic links.
    pub fn from_mesh(mesh: &Mesh, rest: &[Vec3], opening_capacity: usize) -> Self {
        let edges: Vec<Corner> = mesh.edges().collect();
        let distance = |a: u32, b: u32| (rest[a as usize] - rest[b as usize]).length();
        let area = |triangle: usize| {
            let [a, b, c] = mesh.triangles[triangle].map(|v| rest[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        let mut drafts = Vec::new();
        for edge in &edges {
            let (a, b) = (mesh.vertex(*edge), mesh.vertex(next_corner(*edge)));
            let length = distance(a, b);
            let beyond = mesh.across(*edge);
            let both_areas =
                area(triangle_of(*edge)) + if beyond == NONE { 0.0 } else { area(beyond as usize) };
            // Van Gelder 1998, see the module doc.
            let stiffness_scale = both_areas / (length * length);
            let spec = edge_link(
                mesh,
                *edge,
                [a, b],
                LinkKind::Stretch,
                ThreadDirection::Warp,
                stiffness_scale,
            );
            drafts.push(LinkDraft { spec, rest: length, color: 0 });
        }
        for edge in edges.iter().filter(|edge| mesh.across(**edge) != NONE) {
            let beyond = mesh.across(*edge);
            let (a, b) = (mesh.vertex(*edge), mesh.vertex(next_corner(*edge)));
            let opposite = prev_corner(*edge);
            let far =
                (3 * beyond..3 * beyond + 3).find(|c| mesh.vertex(*c) != a && mesh.vertex(*c) != b);
            let ends = [opposite, far.unwrap_or(opposite)];
            let length = distance(mesh.vertex(ends[0]), mesh.vertex(ends[1]));
            let stiffness_scale = bend_link_stiffness(distance(a, b), length.max(1.0e-6));
            let support = LinkSupport::AcrossEdge(*edge);
            let spec = LinkSpec {
                kind: LinkKind::Bend,
                direction: ThreadDirection::Warp,
                ends,
                support,
                stiffness_scale,
            };
            if mesh.vertex(ends[0]) != mesh.vertex(ends[1]) {
                drafts.push(LinkDraft { spec, rest: length, color: 0 });
            }
        }
        let pairs: Vec<[u32; 2]> =
            drafts.iter().map(|d| d.spec.ends.map(|c| mesh.vertex(c))).collect();
        let of_kind = |draft: &LinkDraft| draft.spec.kind as u32;
        let bend = drafts.iter().position(|draft| of_kind(draft) == 2).unwrap_or(drafts.len());
        let count = mesh.vertex_count();
        let mut colors = coloring::color_greedily(&pairs[..bend], count);
        let stretch_colors = colors.iter().max().map_or(0, |most| most + 1);
        colors.extend(
            coloring::color_greedily(&pairs[bend..], count).iter().map(|c| c + stretch_colors),
        );
        for (draft, color) in drafts.iter_mut().zip(colors) {
            draft.color = color;
        }
        Self::from_drafts(mesh, drafts, opening_capacity)
    }

    /// Sorts drafts by colour into batches, and builds the indices over the links.
    fn from_drafts(mesh: &Mesh, drafts: Vec<LinkDraft>, opening_capacity: usize) -> Self {
        // Links of one colour keep the order in which they were created.
        let mut order: Vec<[u32; 2]> =
            drafts.iter().zip(0..).map(|(draft, at)| [draft.color, at]).collect();
        sort_groups(&mut order, |[color, _]| *color);
        let mut links = Links::default();
        links.reserve(drafts.len());
        let mut batches: Vec<LinkBatch> = Vec::new();
        let mut last_color = u32::MAX;
        for (at, [_, draft]) in order.into_iter().enumerate() {
            let draft = &drafts[draft as usize];
            if draft.color != last_color {
                batches.push(LinkBatch { kind: draft.spec.kind, first: at, count: 0 });
                last_color = draft.color;
            }
            if let Some(batch) = batches.last_mut() {
                batch.count += 1;
            }
            links.push(mesh, draft.spec, draft.rest);
        }
        let mut link_of_edge = vec![NONE; 3 * mesh.triangles.len()];
        for (at, spec) in links.spec.iter().enumerate() {
            if spec.support == LinkSupport::Edge {
                link_of_edge[edge_of(spec.ends) as usize] = at as u32;
            }
        }
        let is_changed = vec![false; links.len()];
        let mut dynamic = Links::default();
        dynamic.reserve(opening_capacity);
        let (mut sparse, mut coloring) = (SparseLinks::default(), Coloring::default());
        if opening_capacity > 0 {
            sparse.reserve(opening_capacity);
            coloring.reserve(opening_capacity, mesh.source.capacity());
        }
        Self {
            links,
            batches,
            rows: None,
            chains: Chains::default(),
            hinges: Hinges::none(),
            is_changed: Shared::new(is_changed),
            dynamic,
            sparse,
            coloring,
            dynamic_sites: Vec::with_capacity(opening_capacity),
            link_of_edge: Shared::new(link_of_edge),
            first_of_site: Shared::default(),
            links_by_site: Shared::default(),
            dynamic_head: vec![NONE; mesh.original_count as usize],
            dynamic_next: Vec::with_capacity(opening_capacity),
            thread_directions: None,
        }
    }

    /// Finds for each original vertex the links that depend on it, unless they are known. `mesh` must
    /// not be torn.
    #[inline(never)]
    pub fn index_links_by_site(&mut self, mesh: &Mesh) {
        if !self.first_of_site.is_empty() {
            return;
        }
        let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(4 * self.links.len());
        for (at, spec) in self.links.spec.iter().enumerate() {
            pairs.extend(spec.dependent_corners().map(|corner| [mesh.vertex(corner), at as u32]));
        }
        sort_groups(&mut pairs, |[vertex, _]| *vertex);
        pairs.dedup();
        let mut first = vec![0u32; mesh.original_count as usize + 1];
        for [vertex, _] in &pairs {
            first[*vertex as usize + 1] += 1;
        }
        for vertex in 1..first.len() {
            first[vertex] += first[vertex - 1];
        }
        let mut of_sites = Vec::with_capacity(pairs.len());
        of_sites.extend(pairs.iter().map(|[_, link]| *link));
        (self.first_of_site, self.links_by_site) = (Shared::new(first), Shared::new(of_sites));
    }

    /// Makes all that damping changes unique.
    pub fn make_lengths_unique(&mut self) {
        self.links.make_lengths_unique();
        self.dynamic.make_lengths_unique();
        self.chains.blocks.make_unique();
    }

    /// Makes all that tears change unique.
    pub fn make_unique(&mut self) {
        self.links.make_unique();
        self.is_changed.make_unique();
        self.link_of_edge.make_unique();
        self.chains.blocks.make_unique();
        if let Some(rows) = &mut self.rows {
            rows.mask.make_unique();
        }
    }

    /// Computes the compliances of all links from the material and the painted stretch.
    pub fn update_compliances(&mut self, material: &Material, maps: &Maps) {
        for links in [&mut self.links, &mut self.dynamic] {
            (0..links.len()).for_each(|link| links.update_compliance(link, material, maps));
        }
    }

    /// The batches of a kind, which are consecutive.
    pub fn batches_of(&self, kind: LinkKind) -> Range<usize> {
        let first = self.batches.partition_point(|batch| batch.kind < kind);
        first..self.batches.partition_point(|batch| batch.kind <= kind)
    }

    /// The active links of a kind that left their grid row; none without rows.
    #[cfg(feature = "parallel")]
    pub fn irregular_links_of(&self, kind: LinkKind) -> &[u32] {
        let batches = &self.batches[self.batches_of(kind)];
        let (Some(rows), Some(first), Some(last)) = (&self.rows, batches.first(), batches.last())
        else {
            return &[];
        };
        rows.irregular_in(first.first..last.first + last.count)
    }

    /// All active links: particle, particle and kind.
    pub fn active_links(&self) -> impl Iterator<Item = (u32, u32, LinkKind)> + '_ {
        [&self.links, &self.dynamic].into_iter().flat_map(|links| {
            let active = (0..links.len()).filter(|link| links.active[*link]);
            active.map(|link| (links.a[link], links.b[link], links.kind(link)))
        })
    }
}

/// Spring constant, relative to the bending rigidity D, of a bend link of length `span` across an
/// edge of length `width`.
///
/// A fold by θ shortens the link by span·θ²/8 and stores ½·D·θ²·(2·width/span) in the sheet. Equal
/// energies at a fold of half a radian give 512·width/span³.
pub(super) fn bend_link_stiffness(width: f32, span: f32) -> f32 {
    512.0 * width / (span * span * span)
}

/// Calls `visit(along, at_border, a, b)` for every link over `span` cells in a thread direction.
/// `along` counts cells from the start of the thread; `at_border` tells whether the thread is a
/// border of the grid.
fn for_each_grid_link(
    columns: u32,
    rows: u32,
    thread: ThreadDirection,
    span: u32,
    mut visit: impl FnMut(u32, bool, u32, u32),
) {
    let (last_row, last_column, step) = match thread {
        ThreadDirection::Weft => (rows, columns.saturating_sub(span), 1),
        ThreadDirection::Warp => (rows.saturating_sub(span), columns, columns),
    };
    for row in 0..last_row {
        for column in 0..last_column {
            let a = row * columns + column;
            let (along, across, chains) = match thread {
                ThreadDirection::Weft => (column, row, rows),
                ThreadDirection::Warp => (row, column, columns),
            };
            visit(along, across == 0 || across == chains - 1, a, a + span * step);
        }
    }
}

/// Definition of a link along an edge, from `ends[0]` to `ends[1]`.
fn edge_link(
    mesh: &Mesh,
    edge: Corner,
    ends: [u32; 2],
    kind: LinkKind,
    thread: ThreadDirection,
    stiffness_scale: f32,
) -> LinkSpec {
    let ends = ends.map(|end| if mesh.vertex(edge) == end { edge } else { next_corner(edge) });
    LinkSpec { kind, direction: thread, ends, support: LinkSupport::Edge, stiffness_scale }
}

/// The edge between two corners of one triangle: the corner where it starts.
pub(super) fn edge_of(ends: [Corner; 2]) -> Corner {
    if next_corner(ends[0]) == ends[1] { ends[0] } else { ends[1] }
}

/// The corner of `vertex` in `triangle`, which must exist.
fn corner(mesh: &Mesh, triangle: u32, vertex: u32) -> Corner {
    let found = mesh.corner_in(triangle, vertex);
    debug_assert!(found.is_some(), "vertex {vertex} is a corner of triangle {triangle}");
    found.unwrap_or(3 * triangle)
}

/// The shared edge of two triangles, which must exist.
fn edge_between_triangles(mesh: &Mesh, triangle: u32, other: u32) -> Corner {
    let found = (3 * triangle..3 * triangle + 3).find(|edge| mesh.across(*edge) == other);
    debug_assert!(found.is_some(), "triangles {triangle} and {other} share an edge");
    found.unwrap_or(3 * triangle)
}

/// Lookup of edges by their two vertices.
struct EdgeIndex {
    sorted: Vec<([u32; 2], Corner)>,
}

impl EdgeIndex {
    fn new(mesh: &Mesh) -> Self {
        let ends = |edge: Corner| <[u32; 2]>::from(mesh.ends(edge));
        let mut sorted: Vec<_> = mesh.edges().map(|edge| (ends(edge), edge)).collect();
        sort_groups(&mut sorted, |([low, _], _)| *low);
        Self { sorted }
    }

    /// The corner where the edge starts in its first triangle.
    fn edge_between(&self, a: u32, b: u32) -> Corner {
        let ends = [a.min(b), a.max(b)];
        let found = self.sorted.binary_search_by_key(&ends, |(ends, _)| *ends);
        debug_assert!(found.is_ok(), "{ends:?} is an edge");
        self.sorted[found.unwrap_or(0)].1
    }
}
