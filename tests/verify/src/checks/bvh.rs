//! Bounding volume hierarchy over triangles: median splits along the longest axis.
//!
//! Reads triangles; `visit_self_pairs`, `visit_pairs`, `nearest` and `count_ray_hits` answer from
//! it.
//! Invariant: every pair of triangles whose boxes overlap is visited exactly once.

use super::distance::{closest_on_triangle, ray_hits};
use muslin::glam::DVec3;

/// Triangles per leaf.
const LEAF: usize = 4;

#[derive(Clone, Copy, Debug)]
struct Aabb {
    low: DVec3,
    high: DVec3,
}

impl Aabb {
    fn of(triangle: &[DVec3; 3]) -> Self {
        let [a, b, c] = *triangle;
        Self { low: a.min(b).min(c), high: a.max(b).max(c) }
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn overlaps(self, other: Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    fn distance(self, p: DVec3) -> f64 {
        (self.low - p).max(p - self.high).max(DVec3::ZERO).length()
    }

    fn is_hit(self, from: DVec3, inverse: DVec3) -> bool {
        let (a, b) = ((self.low - from) * inverse, (self.high - from) * inverse);
        a.max(b).min_element() >= a.min(b).max_element().max(0.0)
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// Range of `order` below this node.
    first: usize,
    end: usize,
    /// The second child; the first is the next node. 0 = leaf.
    second: usize,
}

/// A tree over triangles.
#[derive(Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    order: Vec<usize>,
    boxes: Vec<Aabb>,
    triangles: Vec<[DVec3; 3]>,
}

impl Bvh {
    /// Builds the tree; there must be at least one triangle.
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        let boxes: Vec<Aabb> = triangles.iter().map(Aabb::of).collect();
        let order: Vec<usize> = (0..triangles.len()).collect();
        let end = order.len();
        let mut tree = Self { nodes: Vec::new(), order, boxes, triangles };
        tree.split(0, end);
        tree
    }

    pub fn triangle(&self, at: usize) -> [DVec3; 3] {
        self.triangles[at]
    }

    fn split(&mut self, first: usize, end: usize) -> usize {
        let of = |at: &usize| self.boxes[*at];
        let bounds = self.order[first..end].iter().map(of).reduce(Aabb::union);
        let bounds = bounds.unwrap_or(Aabb { low: DVec3::ZERO, high: DVec3::ZERO });
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, first, end, second: 0 });
        if end - first > LEAF {
            let size = bounds.high - bounds.low;
            let axis = (0..3).fold(0, |most, k| if size[k] > size[most] { k } else { most });
            let middle = (end - first) / 2;
            let boxes = &self.boxes;
            let center = |at: usize| boxes[at].low[axis] + boxes[at].high[axis];
            self.order[first..end]
                .select_nth_unstable_by(middle, |a, b| center(*a).total_cmp(&center(*b)));
            self.split(first, first + middle);
            self.nodes[node].second = self.split(first + middle, end);
        }
        node
    }

    /// Calls `visit` for every pair of triangles of this tree whose boxes overlap.
    pub fn visit_self_pairs(&self, visit: &mut impl FnMut(usize, usize)) {
        self.visit_inside(0, visit);
    }

    fn visit_inside(&self, node: usize, visit: &mut impl FnMut(usize, usize)) {
        let Node { first, end, second, .. } = self.nodes[node];
        if second == 0 {
            for at in first..end {
                for other in at + 1..end {
                    let (a, b) = (self.order[at], self.order[other]);
                    if self.boxes[a].overlaps(self.boxes[b]) {
                        visit(a, b);
                    }
                }
            }
            return;
        }
        self.visit_inside(node + 1, visit);
        self.visit_inside(second, visit);
        self.visit_between(node + 1, self, second, visit);
    }

    /// Calls `visit` for every triangle of this tree and triangle of `other` whose boxes overlap.
    pub fn visit_pairs(&self, other: &Self, visit: &mut impl FnMut(usize, usize)) {
        self.visit_between(0, other, 0, visit);
    }

    fn visit_between(
        &self,
        node: usize,
        other: &Self,
        beside: usize,
        visit: &mut impl FnMut(usize, usize),
    ) {
        let (one, two) = (self.nodes[node], other.nodes[beside]);
        if !one.bounds.overlaps(two.bounds) {
            return;
        }
        match (one.second, two.second) {
            (0, 0) => {
                for a in &self.order[one.first..one.end] {
                    for b in &other.order[two.first..two.end] {
                        if self.boxes[*a].overlaps(other.boxes[*b]) {
                            visit(*a, *b);
                        }
                    }
                }
            }
            (second, of_other)
                if second != 0 && (of_other == 0 || one.end - one.first >= two.end - two.first) =>
            {
                self.visit_between(node + 1, other, beside, visit);
                self.visit_between(second, other, beside, visit);
            }
            (_, second) => {
                self.visit_between(node, other, beside + 1, visit);
                self.visit_between(node, other, second, visit);
            }
        }
    }

    /// Distance from `p` to the nearest triangle [m].
    pub fn nearest(&self, p: DVec3) -> f64 {
        let mut best = f64::INFINITY;
        let mut stack = vec![0];
        while let Some(node) = stack.pop() {
            let Node { bounds, first, end, second } = self.nodes[node];
            if bounds.distance(p) >= best {
                continue;
            }
            if second == 0 {
                for at in &self.order[first..end] {
                    best = best.min(closest_on_triangle(p, self.triangles[*at]).distance(p));
                }
                continue;
            }
            let (near, far) = (node + 1, second);
            let is_far_nearer =
                self.nodes[far].bounds.distance(p) < self.nodes[near].bounds.distance(p);
            stack.extend(if is_far_nearer { [near, far] } else { [far, near] });
        }
        best
    }

    /// Number of triangles that the ray from `from` along `direction` hits.
    pub fn count_ray_hits(&self, from: DVec3, direction: DVec3) -> usize {
        let inverse = direction.recip();
        let mut count = 0;
        let mut stack = vec![0];
        while let Some(node) = stack.pop() {
            let Node { bounds, first, end, second } = self.nodes[node];
            if !bounds.is_hit(from, inverse) {
                continue;
            }
            if second == 0 {
                let hits = |at: &&usize| ray_hits(from, direction, self.triangles[**at]);
                count += self.order[first..end].iter().filter(hits).count();
            } else {
                stack.extend([node + 1, second]);
            }
        }
        count
    }
}
