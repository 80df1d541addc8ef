//! The scenes, by what is at stake.

mod bodies;
mod bounds;
mod energy;
mod falls;
mod garments;
mod hands;
mod impacts;
mod small_bodies;
mod topology;

use crate::play::Scene;

/// All scenes, in the order of the table.
pub fn all() -> Vec<Scene> {
    let groups = [
        falls::scenes(),
        bounds::scenes(),
        impacts::scenes(),
        small_bodies::scenes(),
        bodies::scenes(),
        energy::scenes(),
        garments::scenes(),
        hands::scenes(),
        topology::scenes(),
    ];
    groups.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn scenes_have_names_of_their_own() {
        let scenes = all();
        let names: BTreeSet<_> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        assert_eq!(names.len(), scenes.len());
        assert!(scenes.len() >= 30, "{} scenes", scenes.len());
    }

    #[test]
    fn a_tenth_to_a_fifth_of_the_scenes_is_short() {
        let scenes = all();
        let short = scenes.iter().filter(|scene| scene.short_ticks.is_some()).count();
        let share = scenes.len() / short;
        assert!((5..=10).contains(&share), "{short} of {} scenes", scenes.len());
    }
}
