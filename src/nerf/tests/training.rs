use super::scene::{BOUNDS, views};
use crate::imaging::Camera;
use crate::nerf::{NerfSettings, train};

#[test]
fn a_short_training_shows_the_scene_from_new_views() {
    let camera = Camera::square(64, 0.33);
    let (training, test) = (views(&camera, 20, 0.0), views(&camera, 6, 1.0));
    let settings = NerfSettings { steps: 300, samples_per_step: 2048, ..NerfSettings::label() };
    let mut progress = Vec::new();
    let nerf = train(&training, &BOUNDS, &settings, &mut |p| progress.push(p)).unwrap();
    let evaluation = nerf.evaluate(&test);
    assert!(evaluation.mean_psnr_db() > 22.0, "{evaluation:?}");
    assert_eq!(progress.len(), 300);
    assert!(progress[299].loss < 0.3 * progress[0].loss, "{:?} {:?}", progress[0], progress[299]);
}

#[test]
fn a_carved_training_leaves_the_space_beside_the_object_empty() {
    let camera = Camera::square(64, 0.33);
    let (training, test) = (views(&camera, 20, 0.0), views(&camera, 6, 1.0));
    let settings = NerfSettings { steps: 150, ..NerfSettings::label_fast() };
    let nerf = train(&training, &BOUNDS, &settings, &mut |_| {}).unwrap();
    assert!(nerf.evaluate(&test).mean_psnr_db() > 21.0, "{:?}", nerf.evaluate(&test));
    for view in &test {
        let render = nerf.render(&view.camera, &view.world_from_camera);
        // The corners look past the hull of these views.
        for (x, y) in [(0, 0), (63, 0), (0, 63), (63, 63)] {
            assert_eq!(render.get_pixel(x, y).0[3], 0);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_does_not() {
    let camera = Camera::square(24, 0.33);
    let training = views(&camera, 6, 0.0);
    let image = |seed| {
        let settings = NerfSettings { steps: 40, samples_per_step: 512, seed, ..NerfSettings::label() };
        let nerf = train(&training, &BOUNDS, &settings, &mut |_| {}).unwrap();
        nerf.render(&camera, &super::scene::pose(2, 7, 0.3)).into_raw()
    };
    assert_eq!(image(1), image(1));
    assert_ne!(image(1), image(2));
}
