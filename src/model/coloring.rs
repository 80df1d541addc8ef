//! Colouring: links of one colour share no particle, so their order cannot matter.

/// A colour for each pair, the lowest that neither end has yet, in the order of the list.
pub(crate) fn greedy(pairs: &[[u32; 2]], particle_count: usize) -> Vec<u32> {
    let mut taken: Vec<Vec<bool>> = vec![Vec::new(); particle_count];
    let mut colors = Vec::with_capacity(pairs.len());
    for [a, b] in pairs.iter().map(|pair| pair.map(|v| v as usize)) {
        let is_taken = |end: usize, color: usize| taken[end].get(color).copied().unwrap_or(false);
        let color = (0..).find(|c| !is_taken(a, *c) && !is_taken(b, *c)).unwrap_or(0);
        for end in [a, b] {
            if taken[end].len() <= color {
                taken[end].resize(color + 1, false);
            }
            taken[end][color] = true;
        }
        colors.push(color as u32);
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_particle_appears_twice_in_a_color() {
        let pairs: Vec<[u32; 2]> =
            (0..40u32).flat_map(|a| (1..5).map(move |d| [a, (a * 7 + d * 3) % 41])).collect();
        let pairs: Vec<[u32; 2]> = pairs.into_iter().filter(|[a, b]| a != b).collect();
        let colors = greedy(&pairs, 41);
        for color in 0..=*colors.iter().max().unwrap() {
            let mut ends: Vec<u32> = pairs
                .iter()
                .zip(&colors)
                .filter(|(_, c)| **c == color)
                .flat_map(|(p, _)| *p)
                .collect();
            let all = ends.len();
            ends.sort_unstable();
            ends.dedup();
            assert_eq!(ends.len(), all, "color {color}");
        }
    }
}
