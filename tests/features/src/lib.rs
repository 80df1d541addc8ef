//! Tests of the crate without its optional parts: refusals name the feature, the rest works.
//!
//! `cargo test --package muslin-features` runs them; in a build of the whole workspace the features
//! of other packages would be on.

#[cfg(test)]
mod tests {
    use muslin::glam::Vec3;
    use muslin::{Cloth, ColliderDesc, Error, EventKind, GridDesc, SelfCollision, Settings, Shape};

    fn sheet(self_collision: SelfCollision) -> Result<Cloth, Error> {
        let settings = Settings { self_collision, tearing: true, ..Settings::default() };
        Cloth::grid(&GridDesc { columns: 16, rows: 16, settings, ..GridDesc::default() })
    }

    /// Asserts that an error names `feature`, in its field and in its message.
    fn assert_missing<T: std::fmt::Debug>(result: Result<T, Error>, feature: &str) {
        let error = result.expect_err("the feature is off");
        assert!(error.to_string().contains(&format!("needs the feature `{feature}`")), "{error}");
        assert!(matches!(error, Error::MissingFeature { feature: named, .. } if named == feature));
    }

    #[test]
    fn surface_self_collision_is_refused_and_changes_nothing() {
        assert_missing(sheet(SelfCollision::Surface), "self-collision");
        let mut cloth = sheet(SelfCollision::Particles).unwrap();
        let hash = cloth.state_hash();
        let settings =
            Settings { self_collision: SelfCollision::Surface, ..cloth.settings().clone() };
        assert_missing(cloth.set_settings(settings), "self-collision");
        assert_eq!(cloth.state_hash(), hash);
    }

    #[test]
    fn colliders_with_facets_are_refused_and_others_work() {
        let mut cloth = sheet(SelfCollision::None).unwrap();
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].to_vec();
        for shape in [Shape::Convex, Shape::Mesh, Shape::Heightfield] {
            let desc = ColliderDesc {
                shape,
                positions: corners.clone(),
                indices: vec![0, 1, 2],
                columns: 2,
                rows: 2,
                heights: vec![0.0; 4],
                ..ColliderDesc::default()
            };
            assert_missing(cloth.add_collider(&desc), "facet-colliders");
        }
        for shape in [Shape::Plane, Shape::Sphere, Shape::Capsule, Shape::Box] {
            let position = Vec3::new(0.4, -0.5, -0.6);
            cloth
                .add_collider(&ColliderDesc { shape, position, ..ColliderDesc::default() })
                .unwrap();
        }
        cloth.step(10);
        assert!(cloth.view().positions.iter().all(|x| x.is_finite()));
    }

    #[test]
    fn cloth_hangs_tears_and_collides_by_its_particles() {
        let mut cloth = sheet(SelfCollision::Particles).unwrap();
        cloth.step(30);
        assert!(cloth.tear_edge(100, 101).unwrap());
        cloth.step(30);
        let tears = std::iter::from_fn(|| cloth.next_event())
            .filter(|event| event.kind == EventKind::EdgeTorn)
            .count();
        assert_eq!(tears, 1);
        assert!(cloth.stats().max_stretch < 0.2);
    }
}
