//! Irregular bends: bending elements of a torn grid that are no longer plate elements, packed by
//! colour.
//!
//! ```text
//! a ──── middle ──── b        curvature a − 2 · middle + b
//! ```
//! Reads bend links; writes packed columns for the solver.
//!
//! Invariant: within a coloured group no particle appears twice.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::mesh::Mesh;
use crate::model::coloring::{ColorGroup, Coloring, MAX_GROUPS};
use crate::model::links::{LinkSupport, Links, ThreadDirection};

/// All irregular bends, as of the last `rebuild`.
#[derive(Clone, Debug, Default)]
pub(crate) struct IrregularBends {
    /// Particles: the far ends of the two threads, and the particle where they meet.
    pub a: Vec<u32>,
    pub middle: Vec<u32>,
    pub b: Vec<u32>,
    /// Original plate element of each bend: the particle in its middle.
    pub element: Vec<u32>,
    /// Original area fraction of that element.
    pub area_fraction: Vec<f32>,
    /// Multiplier of each bend along x, y and z [kg m]. Stage `Bend` resets it in each substep.
    pub lambda: [Vec<f32>; 3],
    /// Bends of one colour and kind: 0 along the weft, 1 along the warp.
    pub groups: Vec<ColorGroup>,
    coloring: Coloring,
}

heap_bytes!(
    IrregularBends {
        a, middle, b, element, area_fraction, lambda, groups, coloring,
    } plain {}
);

impl IrregularBends {
    /// Allocates for `count` bends and `particles` particles.
    pub fn reserve(&mut self, count: usize, particles: usize) {
        let lists = [&mut self.a, &mut self.middle, &mut self.b, &mut self.element];
        lists.into_iter().for_each(|list| list.reserve_total(count));
        self.area_fraction.reserve_total(count);
        self.lambda.iter_mut().for_each(|lambda| lambda.reserve_total(count));
        self.groups.reserve_total(MAX_GROUPS);
        self.coloring.reserve(count, particles);
    }

    /// Rebuilds the bends from their links. `element_of(link, kind)` returns the original element
    /// of a link and its area fraction.
    pub fn rebuild(
        &mut self,
        mesh: &Mesh,
        links: &Links,
        bend_links: &[u32],
        element_of: impl Fn(u32, usize) -> (u32, f32),
    ) {
        let ends = |at: usize| {
            let link = bend_links[at] as usize;
            let spec = &links.spec[link];
            let LinkSupport::TwoEdges([left, _]) = spec.support else { return None };
            let kind = if spec.direction == ThreadDirection::Weft { 0 } else { 1 };
            Some((kind, [links.a[link], mesh.vertex(left), links.b[link]]))
        };
        let Self { a, middle, b, element: elements, area_fraction, lambda, groups, coloring } =
            self;
        let order = coloring.assign(bend_links.len(), mesh.vertex_count(), ends, groups);
        [&mut *a, middle, b, elements].into_iter().for_each(Vec::clear);
        area_fraction.clear();
        for at in order {
            let Some((kind, ends)) = ends(*at as usize) else { continue };
            let (element, fraction) = element_of(bend_links[*at as usize], kind);
            a.push(ends[0]);
            middle.push(ends[1]);
            b.push(ends[2]);
            elements.push(element);
            area_fraction.push(fraction);
        }
        lambda.iter_mut().for_each(|lambda| lambda.resize(a.len(), 0.0));
    }
}
