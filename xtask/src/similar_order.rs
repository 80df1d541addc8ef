//! Puts similar parts of a file next to each other, so that it compresses better.
//!
//! gzip replaces what it has read in the last 32 KiB by references. Two functions that the compiler made
//! from one generic function have most bytes in common, which helps only where they are that near.
//!
//! Method: a greedy path through the parts. The next one is that which shares most with the parts of
//! the last window: substrings of some bytes, rare ones weighing more, relative to its size. Which
//! parameters are best differs from file to file, so the best of some orders is taken.
//!
//! Reads the parts; writes nothing.
//! Invariant: the order follows from the bytes alone, so that builds are reproducible.

use std::collections::HashMap;
use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

/// Parameters of a greedy path.
#[derive(Clone, Copy)]
struct GreedyParameters {
    /// The length of the substrings that are compared [bytes].
    length: usize,
    /// How far back parts count as near [bytes].
    window: usize,
    /// The power of the size of a part by which its similarity is divided, in eighths.
    eighths: u32,
    /// The power of the number of parts with a substring by which its weight is divided, in eighths.
    rarity: u32,
}

/// The parameters that are tried.
const TRIED: [GreedyParameters; 8] = [
    GreedyParameters { length: 5, window: 28_000, eighths: 6, rarity: 4 },
    GreedyParameters { length: 5, window: 28_000, eighths: 7, rarity: 4 },
    GreedyParameters { length: 5, window: 32_000, eighths: 6, rarity: 4 },
    GreedyParameters { length: 6, window: 32_000, eighths: 5, rarity: 4 },
    GreedyParameters { length: 6, window: 32_000, eighths: 7, rarity: 4 },
    GreedyParameters { length: 6, window: 32_000, eighths: 5, rarity: 6 },
    GreedyParameters { length: 6, window: 32_000, eighths: 6, rarity: 6 },
    GreedyParameters { length: 6, window: 32_000, eighths: 7, rarity: 6 },
];

/// Returns the parts in their new order, each by its index.
pub fn similar_order(parts: &[&[u8]]) -> Vec<usize> {
    let orders = TRIED.iter().map(|parameters| greedy_order(parts, parameters));
    orders.min_by_key(|order| compressed_size(parts, order)).unwrap_or_default()
}

/// Returns the size of the parts in this order, compressed by gzip [bytes].
fn compressed_size(parts: &[&[u8]], order: &[usize]) -> usize {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    let written = order.iter().try_for_each(|part| gzip.write_all(parts[*part]));
    written.and_then(|()| gzip.finish()).map_or(usize::MAX, |packed| packed.len())
}

/// Returns the order along a greedy path. The longest part comes first.
fn greedy_order(parts: &[&[u8]], parameters: &GreedyParameters) -> Vec<usize> {
    let mut order = Vec::with_capacity(parts.len());
    let Some(mut next) = (0..parts.len()).rev().max_by_key(|part| parts[*part].len()) else {
        return order;
    };
    let mut window = Window::new(parts, parameters);
    let mut is_placed = vec![false; parts.len()];
    let (mut first, mut bytes) = (0, 0);
    loop {
        is_placed[next] = true;
        order.push(next);
        window.add(next);
        bytes += parts[next].len();
        while bytes > parameters.window && first + 1 < order.len() {
            window.remove(order[first]);
            bytes -= parts[order[first]].len();
            first += 1;
        }
        let left = (0..parts.len()).rev().filter(|part| !is_placed[*part]);
        match left.max_by(|a, b| window.similarity(*a).total_cmp(&window.similarity(*b))) {
            Some(part) => next = part,
            None => return order,
        }
    }
}

/// What each part shares with those of a window.
struct Window {
    /// The different substrings of each part.
    substrings: Vec<Vec<u32>>,
    /// The parts that have each substring.
    parts: Vec<Vec<u32>>,
    /// How many parts of the window have each substring.
    counts: Vec<u32>,
    /// The weight of the substrings that each part shares with the window.
    shared: Vec<u64>,
    parameters: GreedyParameters,
}

impl Window {
    fn new(parts: &[&[u8]], parameters: &GreedyParameters) -> Self {
        let mut numbers = HashMap::new();
        let mut substrings_of = |part| {
            let number = |substring| {
                let next = numbers.len() as u32;
                *numbers.entry(substring).or_insert(next)
            };
            let windows = <[u8]>::windows(part, parameters.length);
            let mut substrings: Vec<u32> = windows.map(number).collect();
            substrings.sort_unstable();
            substrings.dedup();
            substrings
        };
        let substrings: Vec<_> = parts.iter().map(|part| substrings_of(part)).collect();
        let mut parts_of = vec![Vec::new(); numbers.len()];
        for (part, substrings) in (0..).zip(&substrings) {
            substrings.iter().for_each(|substring| parts_of[*substring as usize].push(part));
        }
        let counts = vec![0; parts_of.len()];
        Self {
            substrings,
            parts: parts_of,
            counts,
            shared: vec![0; parts.len()],
            parameters: *parameters,
        }
    }

    fn add(&mut self, part: usize) {
        for substring in self.substrings[part].iter().map(|substring| *substring as usize) {
            self.counts[substring] += 1;
            if self.counts[substring] == 1 {
                let weight = self.weight(substring);
                let parts = &self.parts[substring];
                parts.iter().for_each(|part| self.shared[*part as usize] += weight);
            }
        }
    }

    fn remove(&mut self, part: usize) {
        for substring in self.substrings[part].iter().map(|substring| *substring as usize) {
            self.counts[substring] -= 1;
            if self.counts[substring] == 0 {
                let weight = self.weight(substring);
                let parts = &self.parts[substring];
                parts.iter().for_each(|part| self.shared[*part as usize] -= weight);
            }
        }
    }

    /// The weight of a substring: less if many parts have it.
    fn weight(&self, substring: usize) -> u64 {
        match self.parts[substring].len() {
            1 => 0,
            count => (65536.0 / power(count as f64, self.parameters.rarity)) as u64,
        }
    }

    /// How much a part is like the window, relative to a power of its size.
    fn similarity(&self, part: usize) -> f64 {
        let size = self.substrings[part].len() as f64 + 30.0;
        self.shared[part] as f64 / power(size, self.parameters.eighths)
    }
}

/// Returns a power below 1 of a number. Roots are the same on all machines, other powers are not.
fn power(number: f64, eighths: u32) -> f64 {
    let root = number.sqrt();
    let factors = [(4, root), (2, root.sqrt()), (1, root.sqrt().sqrt())];
    factors.iter().filter(|(part, _)| eighths & part != 0).map(|(_, factor)| factor).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twins_become_neighbours_and_every_part_stays() {
        let texts =
            ["add one, then two, then three", "xyz", "0123456789 0123", "add one, then six"];
        let order = similar_order(&texts.map(str::as_bytes));
        assert_eq!(order[..2], [0, 3]);
        let mut sorted = order;
        sorted.sort_unstable();
        assert_eq!(sorted, [0, 1, 2, 3]);
        assert!(similar_order(&[]).is_empty());
    }
}
