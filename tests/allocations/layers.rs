//! Layers allocate when they are added and when the other cloth has torn, and only then.

use crate::common::shapes::free_sheet;
use crate::counting_allocator::allocation_count;
use muslin::Cloth;

#[test]
fn a_layer_allocates_only_when_it_is_added_or_gets_other_triangles() {
    let mut inner = Cloth::grid(&free_sheet(20, 0.8, 0.0)).unwrap();
    let mut outer = Cloth::grid(&free_sheet(12, 0.4, 0.01)).unwrap();
    let border: Vec<u32> = (0..400).filter(|i| [0, 19].contains(&(i % 20))).collect();
    border.iter().for_each(|i| inner.pin(*i, None).unwrap());
    let mut layer = None;
    let mut run = |inner: &mut Cloth, ticks: u32| {
        for _ in 0..ticks {
            inner.step(1);
            layer = Some(outer.collide_with(inner, layer).unwrap());
            outer.step(1);
        }
        assert!(outer.collider_impulse(layer.unwrap()).unwrap().linear.y < 0.0);
    };
    run(&mut inner, 60);
    assert_eq!(allocation_count(|| run(&mut inner, 60)), 0);
    assert!(inner.tear_edge(1, 2).unwrap());
    assert!(allocation_count(|| run(&mut inner, 1)) > 0);
    assert_eq!(allocation_count(|| run(&mut inner, 60)), 0);
}
