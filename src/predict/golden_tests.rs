//! The shipped network, pre-processing included, against what PyTorch answered (`prvnet.parity --golden`).

use image::{Rgba, RgbaImage};
use serde::Deserialize;
use sha2::{Digest, Sha256};

use super::{PhotoInput, Predictor, SHIPPED_MODEL};
use crate::imaging::{Camera, Distortion};

#[derive(Deserialize)]
struct Golden {
    model_sha256: String,
    cases: Vec<Case>,
}

/// Photos that integers make, and PyTorch's answer to them.
#[derive(Deserialize)]
struct Case {
    width: u32,
    height: u32,
    /// `fx,fy,cx,cy,k1,k2,p1,p2,k3`.
    camera: String,
    distance_m: f64,
    seeds: Vec<u32>,
    view_count: f64,
}

impl Case {
    fn camera(&self) -> Camera {
        let numbers: Vec<f64> = self.camera.split(',').map(|number| number.parse().unwrap()).collect();
        let [fx, fy, cx, cy, k1, k2, p1, p2, k3] = numbers.try_into().unwrap();
        let (width, height) = (self.width, self.height);
        Camera { width, height, fx, fy, cx, cy, distortion: Distortion { k1, k2, p1, p2, k3 } }
    }

    /// Stripes of three periods on a disc, clear elsewhere, as `prvnet.parity.pattern` draws them.
    fn photo(&self, seed: u32) -> RgbaImage {
        let (width, height) = (i64::from(self.width), i64::from(self.height));
        let radius = height * i64::from(6 + seed % 3) / 9;
        RgbaImage::from_fn(self.width, self.height, |x, y| {
            let color = |c: u32| (((3 + seed + c) * x + (5 + 2 * c) * y + ((x * y) >> (4 + c))) & 255) as u8;
            let (right, down) = (2 * i64::from(x) + 1 - width, 2 * i64::from(y) + 1 - height);
            let inside = right * right + down * down < radius * radius;
            Rgba([color(0), color(1), color(2), if inside { 255 } else { 0 }])
        })
    }
}

#[test]
fn the_shipped_network_answers_as_pytorch_did() {
    let golden: Golden = serde_json::from_str(include_str!("../../models/prvnet.golden.json")).unwrap();
    let digest: String = Sha256::digest(SHIPPED_MODEL).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(golden.model_sha256, digest, "prvnet.golden.json is of another model: make train writes both");
    let predictor = Predictor::load(SHIPPED_MODEL, 1, 1).unwrap();
    assert!(golden.cases.len() >= 5);
    for (index, case) in golden.cases.iter().enumerate() {
        let photo =
            |seed: &u32| PhotoInput::looking_at_center(case.photo(*seed), case.camera(), case.distance_m);
        let photos: Vec<PhotoInput> = case.seeds.iter().map(photo).collect();
        let answer = predictor.predict(&photos).unwrap();
        assert!(
            (answer.raw - case.view_count).abs() <= 1e-4,
            "case {index}: {} {}",
            answer.raw,
            case.view_count
        );
    }
}
