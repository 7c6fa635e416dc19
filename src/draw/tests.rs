//! What a picture holds.

use proptest::prelude::*;

use super::{Panel, ReachMap, common_point, hemispheres};
use crate::geometry::{Direction, Point, Vector, direction_from_azimuth_elevation};

fn panel() -> Panel {
    let ring = |k: u32| direction_from_azimuth_elevation(f64::from(k), 0.3 + 0.1 * f64::from(k % 3));
    Panel {
        title: "wall & <monitor>".into(),
        planned: (0..9).map(ring).collect(),
        skipped: vec![(ring(10), "no_ik".into()), (ring(11), "obstacle_collision".into())],
        reach: Some(ReachMap {
            min_elevation_rad: 0.1,
            max_elevation_rad: 1.5,
            reached: vec![vec![true; 12], vec![false; 12], [true, false, true].repeat(4)],
        }),
        base_azimuth_rad: Some(std::f64::consts::PI),
        captions: vec![("Views".into(), "9 of 11".into())],
    }
}

/// Fails where an element is not closed by its own name, or a `<` or `&` stands in a text.
fn assert_well_formed(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    for part in xml.split('<').skip(1) {
        let (tag, content) = part.split_once('>').expect("every tag ends");
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        for entity in content.split('&').skip(1) {
            assert!(
                ["amp;", "lt;", "gt;", "quot;"].iter().any(|known| entity.starts_with(known)),
                "{content}"
            );
        }
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with('/') => {}
            None => open.extend(tag.split_whitespace().next()),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn every_planned_view_is_a_numbered_dot_and_every_skipped_one_a_cross() {
    let svg = hemispheres(&[panel()]);
    assert_well_formed(&svg);
    assert_eq!(svg.matches("class=\"number\"").count(), 9);
    assert_eq!(svg.matches("<title>no_ik</title>").count(), 1);
    assert_eq!(svg.matches("<title>obstacle_collision</title>").count(), 1);
    assert!(svg.contains("wall &amp; &lt;monitor&gt;"));
}

#[test]
fn the_same_panels_give_the_same_bytes() {
    assert_eq!(hemispheres(&[panel(), panel()]), hemispheres(&[panel(), panel()]));
}

#[test]
fn an_empty_panel_is_a_picture_too() {
    assert_well_formed(&hemispheres(&[]));
    let svg = hemispheres(&[Panel::default()]);
    assert_well_formed(&svg);
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

#[test]
fn a_top_view_is_in_the_middle_and_one_along_x_on_the_right_rim() {
    let planned = vec![Vector::z_axis(), Vector::x_axis()];
    let svg = hemispheres(&[Panel { planned, ..Panel::default() }]);
    assert!(svg.contains("class=\"view\" cx=\"225\" cy=\"252\""), "{svg}");
    assert!(svg.contains("class=\"view\" cx=\"391\" cy=\"252\""), "{svg}");
}

#[test]
fn parallel_axes_meet_nowhere() {
    let down = -Vector::z_axis();
    assert_eq!(common_point(&[(Point::origin(), down), (Point::new(1.0, 0.0, 0.0), down)]), None);
    assert_eq!(common_point(&[]), None);
}

proptest! {
    #[test]
    fn axes_through_one_point_meet_there(
        x in -2.0..2.0f64, y in -2.0..2.0f64, z in -2.0..2.0f64, turn in 0.0..6.0f64, radius in 0.1..1.0f64
    ) {
        let point = Point::new(x, y, z);
        let line = |k: u32| {
            let direction = direction_from_azimuth_elevation(turn + f64::from(k), 0.2 + 0.3 * f64::from(k));
            (point + direction.into_inner() * radius, Direction::new_unchecked(-direction.into_inner()))
        };
        let found = common_point(&[line(0), line(1), line(2)]).unwrap();
        prop_assert!((found - point).norm() < 1e-9);
    }
}
