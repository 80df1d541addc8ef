//! A bounding volume hierarchy (BVH): a binary tree of AABBs over numbered items.
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
//! Reads the boxes of the items at construction, and again to refit the tree to items that moved;
//! queries read only the tree.
//! Invariant: the tree and the order of query results depend on the boxes alone, and the bounds of
//! a node contain the boxes of its items.

use crate::geometry::aabb::Aabb;
use crate::geometry::swept_box::MovingBox;
use crate::math::sort::{select_by, sort_by};
use core::cmp::Ordering;
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

/// A search for the best item of a tree: the one of least distance, in some sense.
pub(crate) trait Visitor {
    /// Returns a lower bound of the distance of all items within `bounds`; `None` if none of them
    /// counts.
    fn least_distance(&self, bounds: &Aabb) -> Option<f32>;

    /// Returns the distance up to which an item may still be the best.
    fn limit(&self) -> f32;

    /// Visits an item.
    fn visit(&mut self, item: u32);
}

/// More than the depth of any tree: halving 2³² items takes 32 levels.
const MAX_DEPTH: usize = 40;

/// Returns whether a distance is at most `limit`; true if it is NaN.
fn is_near(distance: f32, limit: f32) -> bool {
    distance.partial_cmp(&limit) != Some(Ordering::Greater)
}

impl Bvh {
    /// Builds the tree over one item per box. `bounds` must not be empty.
    pub fn build(bounds: &[Aabb]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: Vec::new() };
        let mut items: Vec<(f32, u32)> = (0..bounds.len() as u32).map(|item| (0.0, item)).collect();
        tree.build_subtree(bounds, &mut items, 0);
        tree.order = items.into_iter().map(|(_, item)| item).collect();
        tree
    }

    /// Appends the nodes over `items`, of which the first has number `start` in the tree's order.
    fn build_subtree(&mut self, bounds: &[Aabb], items: &mut [(f32, u32)], start: usize) {
        let mut all = Aabb::EMPTY;
        items.iter().for_each(|(_, item)| all.merge(&bounds[*item as usize]));
        let at = self.nodes.len();
        let is_leaf = items.len() <= LEAF;
        let own = if is_leaf { start as u32..(start + items.len()) as u32 } else { 0..0 };
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
            for (center, item) in items.iter_mut() {
                *center = bounds[*item as usize].center()[axis];
            }
            // Ties are broken by number, so that the order is unique.
            let order = |a: &(f32, u32), b: &(f32, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
            let middle = items.len() / 2;
            // Leaves list their items in ascending order.
            if middle <= LEAF {
                sort_by(items, order);
            } else {
                select_by(items, middle, order);
            }
            let (low, high) = items.split_at_mut(middle);
            self.build_subtree(bounds, low, start);
            self.build_subtree(bounds, high, start + middle);
        }
        self.nodes[at].skip = self.nodes.len() as u32;
    }

    /// Recomputes the bounds of all nodes from the boxes that the items have now. The tree keeps its
    /// shape, so that it stays efficient while neighbours stay near each other.
    pub fn refit(&mut self, bounds: &dyn Fn(u32) -> Aabb) {
        for at in (0..self.nodes.len()).rev() {
            let mut all = Aabb::EMPTY;
            let items = &self.nodes[at].items;
            if items.is_empty() {
                let second = self.nodes[at + 1].skip as usize;
                [at + 1, second].iter().for_each(|child| all.merge(&self.nodes[*child].bounds));
            } else {
                let items = &self.order[items.start as usize..items.end as usize];
                items.iter().for_each(|item| all.merge(&bounds(*item)));
            }
            self.nodes[at].bounds = all;
        }
    }

    /// Recomputes the bounds of all nodes from the moving boxes of the items, and sets those of the nodes.
    pub fn refit_moving(&mut self, boxes: &dyn Fn(u32) -> MovingBox, nodes: &mut Vec<MovingBox>) {
        nodes.resize(self.nodes.len(), MovingBox::EMPTY);
        for at in (0..self.nodes.len()).rev() {
            let mut all = MovingBox::EMPTY;
            let items = &self.nodes[at].items;
            if items.is_empty() {
                let second = self.nodes[at + 1].skip as usize;
                [at + 1, second].iter().for_each(|child| all.merge(&nodes[*child]));
            } else {
                let items = &self.order[items.start as usize..items.end as usize];
                items.iter().for_each(|item| all.merge(&boxes(*item)));
            }
            self.nodes[at].bounds = all.bounds();
            nodes[at] = all;
        }
    }

    /// Visits the items that may be the best, those of nearer nodes first.
    pub fn visit(&self, visitor: &mut dyn Visitor) {
        let mut pending = [(0.0, 0); MAX_DEPTH];
        let mut count = 0;
        let distance = |visitor: &dyn Visitor, node: usize| {
            let distance = visitor.least_distance(&self.nodes[node].bounds);
            distance.filter(|distance| is_near(*distance, visitor.limit()))
        };
        let mut next = distance(visitor, 0).map(|_| 0);
        while let Some(at) = next {
            let node = &self.nodes[at];
            next = None;
            if node.items.is_empty() {
                let children = [at + 1, self.nodes[at + 1].skip as usize];
                match children.map(|child| distance(visitor, child)) {
                    [None, None] => {}
                    [Some(_), None] => next = Some(children[0]),
                    [None, Some(_)] => next = Some(children[1]),
                    [Some(a), Some(b)] => {
                        let (near, far) = if b < a { (1, 0) } else { (0, 1) };
                        pending[count] = ([a, b][far], children[far]);
                        count += 1;
                        next = Some(children[near]);
                    }
                }
            } else {
                for item in &self.order[node.items.start as usize..node.items.end as usize] {
                    visitor.visit(*item);
                }
            }
            while next.is_none() && count > 0 {
                count -= 1;
                let (distance, node) = pending[count];
                next = is_near(distance, visitor.limit()).then_some(node);
            }
        }
    }

    /// Memory use [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<BvhNode>() * self.nodes.capacity() + size_of::<u32>() * self.order.capacity()
    }

    /// Returns the bounds of all items.
    pub fn bounds(&self) -> Aabb {
        self.nodes[0].bounds
    }

    /// Returns the items of all leaves whose bounds overlap `query`, in the order of the tree.
    /// Items of such a leaf that do not overlap themselves are included.
    pub fn overlapping(&self, query: Aabb) -> impl Iterator<Item = u32> + '_ {
        self.items_of_nodes(move |node| self.nodes[node].bounds.overlaps(&query))
    }

    /// Returns the items of all leaves for which `is_near` is true, as for all nodes above them, in the
    /// order of the tree. `is_near` takes the number of a node.
    pub fn items_of_nodes<'a>(
        &'a self,
        is_near: impl Fn(usize) -> bool + 'a,
    ) -> impl Iterator<Item = u32> + 'a {
        let mut at = 0;
        let mut leaf = 0..0;
        core::iter::from_fn(move || {
            loop {
                if let Some(item) = leaf.next() {
                    return Some(self.order[item as usize]);
                }
                let node = self.nodes.get(at)?;
                if is_near(at) {
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
