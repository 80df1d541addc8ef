//! IrregularBends: where a grid is torn, two threads in a row that have left their plate, and what resists that they
//! bend where they meet. What a substep needs of them lies side by side here, colour by colour.

use crate::mesh::Mesh;
use crate::model::links::{Links, Support, Thread};
use crate::model::recoloring::{GROUPS, Group, Recoloring};

/// All elbows, as of the last time they were gathered.
#[derive(Clone, Debug, Default)]
pub(crate) struct IrregularBends {
    /// The far ends of the threads, and where they meet.
    pub a: Vec<u32>,
    pub middle: Vec<u32>,
    pub b: Vec<u32>,
    /// The particle in the middle of the plate's element that each was woven as, and what there was of that,
    /// over one that lies inside.
    pub woven: Vec<u32>,
    pub share: Vec<f32>,
    /// Those of a colour and of elements along the weft (0) or the warp (1), next to each other.
    pub groups: Vec<Group>,
    palette: Recoloring,
}

impl IrregularBends {
    /// Makes room for so many, and for `particles`.
    pub fn reserve(&mut self, count: usize, particles: usize) {
        let lists = [&mut self.a, &mut self.middle, &mut self.b, &mut self.woven];
        lists.into_iter().for_each(|list| list.reserve_exact(count.saturating_sub(list.len())));
        self.share.reserve_exact(count.saturating_sub(self.share.len()));
        self.groups.reserve_exact(GROUPS.saturating_sub(self.groups.len()));
        self.palette.reserve(count, particles);
    }

    /// Gathers those that some bend links are; `woven` says of a link along weft or warp what it was woven as.
    pub fn gather(
        &mut self,
        mesh: &Mesh,
        links: &Links,
        strays: &[u32],
        woven: impl Fn(u32, usize) -> (u32, f32),
    ) {
        let ends = |at: usize| {
            let link = strays[at] as usize;
            let spec = &links.spec[link];
            let Support::Pair([left, _]) = spec.support else { return None };
            let kind = if spec.thread == Thread::Weft { 0 } else { 1 };
            Some((kind, [links.a[link], mesh.vertex(left), links.b[link]]))
        };
        let Self { a, middle, b, woven: middles, share, groups, palette } = self;
        let order = palette.color(strays.len(), mesh.vertex_count(), ends, groups);
        [&mut *a, middle, b, middles].into_iter().for_each(Vec::clear);
        share.clear();
        for at in order {
            let Some((kind, ends)) = ends(*at as usize) else { continue };
            let (woven_middle, woven_share) = woven(strays[*at as usize], kind);
            a.push(ends[0]);
            middle.push(ends[1]);
            b.push(ends[2]);
            middles.push(woven_middle);
            share.push(woven_share);
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        5 * size_of::<u32>() * self.a.capacity() + self.palette.bytes()
    }
}
