//! IrregularBends: where a grid is torn, two threads in a row that have left their plate, and what resists that they
//! bend where they meet. What a substep needs of them lies side by side here, colour by colour.

use crate::mesh::Mesh;
use crate::model::coloring::{ColorGroup, Coloring, MAX_GROUPS};
use crate::model::links::{LinkSupport, Links, ThreadDirection};

/// All elbows, as of the last time they were gathered.
#[derive(Clone, Debug, Default)]
pub(crate) struct IrregularBends {
    /// The far ends of the threads, and where they meet.
    pub a: Vec<u32>,
    pub middle: Vec<u32>,
    pub b: Vec<u32>,
    /// The particle in the middle of the plate's element that each was woven as, and what there was of that,
    /// over one that lies inside.
    pub element: Vec<u32>,
    pub area_fraction: Vec<f32>,
    /// Those of a colour and of elements along the weft (0) or the warp (1), next to each other.
    pub groups: Vec<ColorGroup>,
    coloring: Coloring,
}

impl IrregularBends {
    /// Makes room for so many, and for `particles`.
    pub fn reserve(&mut self, count: usize, particles: usize) {
        let lists = [&mut self.a, &mut self.middle, &mut self.b, &mut self.element];
        lists.into_iter().for_each(|list| list.reserve_exact(count.saturating_sub(list.len())));
        self.area_fraction.reserve_exact(count.saturating_sub(self.area_fraction.len()));
        self.groups.reserve_exact(MAX_GROUPS.saturating_sub(self.groups.len()));
        self.coloring.reserve(count, particles);
    }

    /// Gathers those that some bend links are; `element_of` says of a link along weft or warp what it was woven as.
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
        let Self { a, middle, b, element: elements, area_fraction, groups, coloring } = self;
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
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        5 * size_of::<u32>() * self.a.capacity() + self.coloring.bytes()
    }
}
