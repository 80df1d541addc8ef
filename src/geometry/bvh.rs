//! A tree of boxes: which of many things may be near a place.

use crate::geometry::aabb::Aabb;
use crate::math::sort::sort_by;
use core::ops::Range;

/// Things in a leaf at most.
const LEAF: usize = 4;

/// A tree over things with bounds, in an order that their bounds alone decide.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    /// Each node before those below it.
    nodes: Vec<Node>,
    /// The things, leaf by leaf.
    order: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Node {
    bounds: Aabb,
    /// The node after all those below it.
    next: u32,
    /// The things of a leaf; none of what is no leaf.
    things: Range<u32>,
}

impl Bvh {
    /// A tree over as many things as there are bounds.
    pub fn over(bounds: &[Aabb]) -> Self {
        let order = (0..bounds.len() as u32).collect();
        let mut tree = Self { nodes: Vec::new(), order };
        tree.grow(bounds, 0..bounds.len());
        tree
    }

    fn grow(&mut self, bounds: &[Aabb], things: Range<usize>) {
        let mut all = Aabb::EMPTY;
        self.order[things.clone()].iter().for_each(|thing| all.merge(&bounds[*thing as usize]));
        let at = self.nodes.len();
        let is_leaf = things.len() <= LEAF;
        let own = if is_leaf { things.start as u32..things.end as u32 } else { 0..0 };
        self.nodes.push(Node { bounds: all, next: 0, things: own });
        if !is_leaf {
            let size = all.half_extents();
            let axis = if size.x >= size.y && size.x >= size.z {
                0
            } else if size.y >= size.z {
                1
            } else {
                2
            };
            let middle = things.start + things.len() / 2;
            let center = |thing: &u32| bounds[*thing as usize].center()[axis];
            // Equal ones by their numbers, so that the order is always the same.
            let order = &mut self.order[things.clone()];
            sort_by(order, |a, b| center(a).total_cmp(&center(b)).then(a.cmp(b)));
            self.grow(bounds, things.start..middle);
            self.grow(bounds, middle..things.end);
        }
        self.nodes[at].next = self.nodes.len() as u32;
    }

    /// The bounds of all.
    pub fn bounds(&self) -> Aabb {
        self.nodes[0].bounds
    }

    /// The things in leaves that meet `place`, always in the same order.
    pub fn near(&self, place: Aabb) -> impl Iterator<Item = u32> + '_ {
        let mut at = 0;
        let mut leaf = 0..0;
        core::iter::from_fn(move || {
            loop {
                if let Some(thing) = leaf.next() {
                    return Some(self.order[thing as usize]);
                }
                let node = self.nodes.get(at)?;
                if node.bounds.overlaps(&place) {
                    leaf = node.things.clone();
                    at += 1;
                } else {
                    at = node.next as usize;
                }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_tree_finds_all_that_meets_a_place() {
        let bounds: Vec<Aabb> = (0..200)
            .map(|i| {
                let wave = |k: f32| (i as f32 * k).sin() * 3.0;
                Aabb::from_points([Vec3::new(wave(1.1), wave(2.3), wave(0.7))]).expanded(0.1)
            })
            .collect();
        let tree = Bvh::over(&bounds);
        assert!(bounds.iter().all(|one| tree.bounds().contains(one)));
        for i in 0..50 {
            let wave = |k: f32| (i as f32 * k).cos() * 3.0;
            let place =
                Aabb::from_points([Vec3::new(wave(1.3), wave(0.4), wave(2.1))]).expanded(0.7);
            let found: Vec<u32> = tree.near(place).collect();
            for (thing, bounds) in bounds.iter().enumerate() {
                assert!(!bounds.overlaps(&place) || found.contains(&(thing as u32)));
            }
            assert!(found.len() < 150, "the tree tells {} of 200 apart", 200 - found.len());
        }
    }
}
