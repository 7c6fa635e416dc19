//! One text for all requests that mean the same.

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::limits::drop_own;
use super::{base64_bytes, robot};
use crate::api::wire::{JointLimitsJson, PlanRequestJson, RollJson, TimingJson};
use crate::motion::{Cell, Roll};
use crate::robot::RobotModel;

/// Largest deviation from 1 of a quaternion's norm that is taken for rounding, and of one that is
/// taken for a quaternion.
const NORM: (f64, f64) = (1e-12, 1e-3);

/// `request` with what goes without saying left out: defaults, limits that are the robot's own, the sign
/// of quaternions and of zero, the case of a robot's name. It means the same, and is its own canonical form. What is
/// wrong with it stays wrong.
pub fn canonical(mut request: PlanRequestJson) -> PlanRequestJson {
    request.timing = request.timing.filter(|timing| *timing != TimingJson::default());
    request.margin = request.margin.filter(|margin| *margin != Cell::DEFAULT_MARGIN_M);
    if let Some(limits) = &mut request.limits {
        if let Some(model) = request.robot.as_ref().and_then(|description| robot(description).ok()) {
            drop_own(limits, &model);
        }
        limits.retain(|_, limits| *limits != JointLimitsJson::default());
    }
    request.limits = request.limits.filter(|limits| !limits.is_empty());
    let free = match Roll::FREE {
        Roll::Free { samples } => Some(samples as u32),
        Roll::Fixed => None,
    };
    if request.roll == RollJson::Sampled && request.roll_samples == free {
        (request.roll, request.roll_samples) = (RollJson::Free, None);
    }
    if let Some(robot) = &mut request.robot {
        if let Some(name) = &mut robot.model {
            let lower = name.to_ascii_lowercase();
            if RobotModel::names().contains(&lower.as_str()) {
                *name = lower;
            }
        }
        robot.meshes = robot.meshes.take().filter(|meshes| !meshes.is_empty());
    }
    // Long texts have no numbers in them.
    let images = request.images.take();
    let meshes = request.robot.as_mut().and_then(|robot| robot.meshes.take());
    let numbers = serde_json::to_value(&request).map(|mut value| {
        clean(&mut value);
        value
    });
    if let Ok(cleaned) = numbers.and_then(serde_json::from_value) {
        request = cleaned;
    }
    request.images = images;
    if let Some(robot) = &mut request.robot {
        robot.meshes = meshes;
    }
    request
}

/// What a plan's id is the hash of: `canonical` JSON in which photos and meshes stand for their bytes,
/// however their base64 is broken into lines.
///
/// # Errors
/// Those of serialising, which these types do not have.
pub fn identity(request: &PlanRequestJson) -> Result<Vec<u8>, serde_json::Error> {
    let mut value = serde_json::to_value(request)?;
    if let Some(Value::Array(images)) = value.get_mut("images") {
        images.iter_mut().for_each(digest);
    }
    if let Some(Value::Object(meshes)) = value.pointer_mut("/robot/meshes") {
        meshes.values_mut().for_each(digest);
    }
    serde_json::to_vec(&value)
}

/// A base64 text as the hash of its bytes; what is none stays, to be refused later.
fn digest(text: &mut Value) {
    let bytes = text.as_str().and_then(|text| base64_bytes("", text).ok());
    if let Some(bytes) = bytes {
        let hash = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
        *text = Value::String(format!("sha256:{hash}"));
    }
}

/// Zero without sign and quaternions with one sign and norm, throughout.
fn clean(value: &mut Value) {
    match value {
        Value::Number(number) if number.as_f64() == Some(0.0) && number.is_f64() => *value = Value::from(0.0),
        Value::Array(items) => items.iter_mut().for_each(clean),
        Value::Object(members) => {
            for (name, member) in members {
                clean(member);
                if name == "orientation"
                    && let Some(turned) = quaternion(member)
                {
                    *member = turned;
                }
            }
        }
        _ => {}
    }
}

/// A quaternion x, y, z, w with its last member that is not zero above zero, of norm 1; `None` for what is
/// none.
fn quaternion(value: &Value) -> Option<Value> {
    let numbers: Vec<f64> = value.as_array()?.iter().map(Value::as_f64).collect::<Option<_>>()?;
    let norm = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
    let off = (norm - 1.0).abs();
    if numbers.len() != 4 || !(off <= NORM.1) {
        return None;
    }
    // What is 1 up to rounding stays, so that doing this twice does nothing more.
    let scale = if off > NORM.0 { norm } else { 1.0 };
    let leading = numbers.iter().rev().find(|x| **x != 0.0)?;
    Some(numbers.iter().map(|x| x / (scale * leading.signum()) + 0.0).map(Value::from).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde_json::json;

    fn text(value: Value) -> String {
        let request: PlanRequestJson = serde_json::from_value(value).unwrap();
        serde_json::to_string(&canonical(request)).unwrap()
    }

    #[test]
    fn photos_are_known_by_their_bytes() {
        let id = |image: &str| {
            let request =
                PlanRequestJson { images: Some(vec![image.to_owned()]), ..PlanRequestJson::default() };
            identity(&request).unwrap()
        };
        assert_eq!(id("QUJD"), id("QU\nJD"));
        assert_eq!(id("QUJD"), id("data:image/png;base64,QUJD"));
        assert_ne!(id("QUJD"), id("QUJE"));
        assert_ne!(id("no base64"), id("none either"));
    }

    #[test]
    fn what_is_no_quaternion_stays_to_be_refused() {
        for orientation in [json!([0.0, 0.0, 0.0, 0.0]), json!([0.0, 0.0, 0.0, -2.0])] {
            let request = json!({"flange_from_camera": {"position": [0, 0, 0], "orientation": orientation}});
            assert!(text(request).contains(&orientation.to_string()));
        }
    }

    proptest! {
        #[test]
        fn a_canonical_request_is_its_own_and_knows_no_sign(q in proptest::array::uniform4(-1.0..1.0f64), off in -9e-4..9e-4f64) {
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            prop_assume!(norm > 1e-3);
            let pose = |sign: f64| {
                let turned = q.map(|x| sign * x * (1.0 + off) / norm);
                json!({"view_count": 3, "flange_from_camera": {"position": [0.0, -0.0, 1.0], "orientation": turned}})
            };
            let once = text(pose(1.0));
            prop_assert_eq!(&once, &text(pose(-1.0)));
            // Written and read again, as a request that is fetched and posted is.
            prop_assert_eq!(&once, &text(serde_json::from_str(&once).unwrap()));
        }
    }
}
