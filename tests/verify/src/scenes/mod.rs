//! The scenes, by what is at stake.

mod bodies;
mod bounds;
mod energy;
mod falls;
mod garments;
mod hands;
mod impacts;
mod random;
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
        random::scenes(),
    ];
    groups.into_iter().flatten().collect()
}

/// Returns the scenes with these names, or the first name that no scene has.
pub fn named(names: &[String]) -> Result<Vec<Scene>, String> {
    let mut scenes = all();
    let mut chosen = Vec::new();
    for name in names {
        let listed = scenes.iter().position(|scene| scene.name == *name);
        let scene = listed.map(|index| scenes.remove(index)).or_else(|| random::named(name));
        chosen.push(scene.ok_or_else(|| name.clone())?);
    }
    Ok(chosen)
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
