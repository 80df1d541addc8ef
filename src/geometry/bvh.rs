//! A bounding volume hierarchy (BVH): a binary tree of AABBs over static items.
//!
//! Built top down: each node is split at the median of the box centers along its longest axis,
//! until a leaf holds at most four items. Nodes are stored in depth-first order with a skip index,
//! so that a query walks the array without a stack.
//!
//! ```text
//! node 0 ─┬─ node 1 ─┬─ node 2 (leaf)      skip: 0 → 5, 1 → 4, 2 → 3, 3 → 4, 4 → 5
//!         │          └─ node 3 (leaf)
//!         └─ node 4 (leaf)
//! ```
//! Reads the boxes of the items once, at construction; queries read only the tree.
//! Invariant: the tree and the order of query results depend on the boxes alone.

use crate::geometry::aabb::Aabb;
use crate::math::sort::sort_by;
use core::ops::Range;
use glam::Vec3;

/// Largest number of items in a leaf.
const LEAF: usize = 4;

/// A tree over items that are numbered from 0.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    /// Each node stands before its children.
    nodes: Vec<BvhNode>,
    /// The items, leaf by leaf.
    order: Vec<u32>,
}

#[derive(Clone, Debug)]
struct BvhNode {
    bounds: Aabb,
    /// The node that follows the whole subtree of this one.
    skip: u32,
    /// The range of a leaf in `order`; empty in inner nodes.
    items: Range<u32>,
}

impl Bvh {
    /// Builds the tree over one item per box. `bounds` must not be empty.
    pub fn build(bounds: &[Aabb]) -> Self {
        let order = (0..bounds.len() as u32).collect();
        let mut tree = Self { nodes: Vec::new(), order };
        tree.build_subtree(bounds, 0..bounds.len());
        tree
    }

    fn build_subtree(&mut self, bounds: &[Aabb], items: Range<usize>) {
        let mut all = Aabb::EMPTY;
        self.order[items.clone()].iter().for_each(|item| all.merge(&bounds[*item as usize]));
        let at = self.nodes.len();
        let is_leaf = items.len() <= LEAF;
        let own = if is_leaf { items.start as u32..items.end as u32 } else { 0..0 };
        self.nodes.push(BvhNode { bounds: all, skip: 0, items: own });
        if !is_leaf {
            let size = all.half_extents();
            let axis = if size.x >= size.y && size.x >= size.z {
                0
            } else if size.y >= size.z {
                1
            } else {
                2
            };
            let middle = items.start + items.len() / 2;
            let center = |item: &u32| bounds[*item as usize].center()[axis];
            // Ties are broken by number, so that the order is unique.
            let order = &mut self.order[items.clone()];
            sort_by(order, |a, b| center(a).total_cmp(&center(b)).then(a.cmp(b)));
            self.build_subtree(bounds, items.start..middle);
            self.build_subtree(bounds, middle..items.end);
        }
        self.nodes[at].skip = self.nodes.len() as u32;
    }

    /// Returns the bounds of all items.
    pub fn bounds(&self) -> Aabb {
        self.nodes[0].bounds
    }

    /// Returns the items of all leaves whose bounds overlap `query`, in the order of the tree.
    /// Items of such a leaf that do not overlap themselves are included.
    pub fn overlapping(&self, query: Aabb) -> impl Iterator<Item = u32> + '_ {
        let mut at = 0;
        let mut leaf = 0..0;
        core::iter::from_fn(move || {
            loop {
                if let Some(item) = leaf.next() {
                    return Some(self.order[item as usize]);
                }
                let node = self.nodes.get(at)?;
                if node.bounds.overlaps(&query) {
                    leaf = node.items.clone();
                    at += 1;
                } else {
                    at = node.skip as usize;
                }
            }
        })
    }

    /// Visits the items of all leaves whose bounds are within a distance of `point`, in the order
    /// of the tree. `visit` returns the square of the distance [m²] to search from then on.
    pub fn visit_near(&self, point: Vec3, mut squared: f32, visit: &mut dyn FnMut(u32) -> f32) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if node.bounds.distance_squared(point) > squared {
                at = node.skip as usize;
                continue;
            }
            for item in &self.order[node.items.start as usize..node.items.end as usize] {
                squared = visit(*item);
            }
            at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_query_finds_every_overlapping_item_and_skips_most_others() {
        let bounds: Vec<Aabb> = (0..200)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin() * 3.0;
                Aabb::from_points([Vec3::new(wave(1.1), wave(2.3), wave(0.7))]).expanded(0.1)
            })
            .collect();
        let tree = Bvh::build(&bounds);
        assert!(bounds.iter().all(|one| tree.bounds().contains(one)));
        for i in 0..50 {
            let wave = |k: f32| (i as f32 * k).cos() * 3.0;
            let center = Vec3::new(wave(1.3), wave(0.4), wave(2.1));
            let query = Aabb::from_points([center]).expanded(0.7);
            let found: Vec<u32> = tree.overlapping(query).collect();
            for (item, bounds) in bounds.iter().enumerate() {
                assert!(!bounds.overlaps(&query) || found.contains(&(item as u32)));
            }
            assert!(found.len() < 150, "the query skips only {} of 200", 200 - found.len());
        }
    }
    #[test]
    fn a_search_for_the_nearest_item_finds_it_and_skips_most_others() {
        let point = |i: i32, k: f32| {
            let wave = |k: f32| (i as f32 * k).sin() * 3.0;
            Vec3::new(wave(k), wave(2.3 * k), wave(0.7 * k))
        };
        let bounds: Vec<Aabb> = (0..200).map(|i| Aabb::from_points([point(i, 1.1)])).collect();
        let tree = Bvh::build(&bounds);
        for i in 0..50 {
            let (from, mut nearest, mut visits) = (point(i, 0.9), f32::INFINITY, 0);
            tree.visit_near(from, f32::INFINITY, &mut |item| {
                visits += 1;
                nearest = nearest.min(bounds[item as usize].center().distance_squared(from));
                nearest
            });
            let all = bounds.iter().map(|bounds| bounds.center().distance_squared(from));
            assert_eq!(nearest, all.fold(f32::INFINITY, f32::min));
            assert!(visits < 150, "the search visits {visits} of 200");
        }
    }
}
