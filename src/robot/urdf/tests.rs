//! URDFs that work, and many that must not.

use proptest::prelude::*;

use crate::geometry::Pose;
use crate::robot::{LinkShape, Meshes, RobotError, RobotModel};

/// The UR5e as ROS describes it: origins and axes of the URDF convention,
/// `base_link` turned by pi about z against `base`, `tool0` behind fixed joints.
fn ur5e_urdf() -> String {
    let joint = |name: &str, parent: &str, child: &str, xyz: &str, rpy: &str, bound: &str| {
        format!(
            "<joint name='{name}' type='revolute'><origin xyz='{xyz}' rpy='{rpy}'/><parent link='{parent}'/>\
             <child link='{child}'/><axis xyz='0 0 1'/>\
             <limit lower='-{bound}' upper='{bound}' effort='150' velocity='3.14'/></joint>"
        )
    };
    let fixed = |name: &str, parent: &str, child: &str, rpy: &str| {
        format!(
            "<joint name='{name}' type='fixed'><origin xyz='0 0 0' rpy='{rpy}'/><parent link='{parent}'/>\
             <child link='{child}'/></joint>"
        )
    };
    let half = "1.5707963267948966";
    let pi = "3.141592653589793";
    let links = [
        "base_link",
        "base",
        "base_inertia",
        "shoulder",
        "upper_arm",
        "forearm",
        "wrist_1",
        "wrist_2",
        "tool0",
    ];
    let mut text = "<?xml version='1.0'?><robot name='ur5e'>".to_owned();
    links.iter().for_each(|link| text += &format!("<link name='{link}'/>"));
    text += "<link name='wrist_3'><collision><origin xyz='0 0 -0.02'/><geometry><cylinder radius='0.04' length='0.05'/>\
             </geometry></collision></link>";
    text += "<link name='camera'><collision><geometry><box size='0.09 0.03 0.03'/></geometry></collision>\
             <collision><geometry><mesh filename='package://camera.stl'/></geometry></collision></link>";
    text += &fixed("base_fixed", "base_link", "base", &format!("0 0 {pi}"));
    text += &fixed("inertia", "base_link", "base_inertia", &format!("0 0 {pi}"));
    text += &joint("pan", "base_inertia", "shoulder", "0 0 0.1625", "0 0 0", "6.283185307179586");
    text += &joint("lift", "shoulder", "upper_arm", "0 0 0", &format!("{half} 0 0"), "6.283185307179586");
    text += &joint("elbow", "upper_arm", "forearm", "-0.425 0 0", "0 0 0", pi);
    text += &joint("w1", "forearm", "wrist_1", "-0.3922 0 0.1333", "0 0 0", "6.283185307179586");
    text += &joint("w2", "wrist_1", "wrist_2", "0 -0.0997 0", &format!("{half} 0 0"), "6.283185307179586");
    text +=
        &joint("w3", "wrist_2", "wrist_3", "0 0.0996 0", &format!("{half} {pi} {pi}"), "6.283185307179586");
    text += &fixed("tool", "wrist_3", "tool0", "0 0 0");
    text += &fixed("camera_mount", "tool0", "camera", "0 0 0");
    text + "</robot>"
}

fn refusal(text: &str) -> String {
    RobotModel::from_urdf(text, None, None).unwrap_err().to_string()
}

#[test]
fn the_ur5e_from_urdf_moves_as_the_built_in_one() {
    let from_urdf = RobotModel::from_urdf(&ur5e_urdf(), None, None).unwrap();
    let built_in = RobotModel::named("ur5e").unwrap();
    assert_eq!((from_urdf.base_frame.as_str(), from_urdf.flange_frame.as_str()), ("base_link", "tool0"));
    let half_turn = nalgebra::UnitQuaternion::from_scaled_axis(nalgebra::Vector3::z() * std::f64::consts::PI);
    let base_link_from_base = Pose::from_parts(nalgebra::Translation3::identity(), half_turn);
    for q in [[0.0; 6], [0.3, -1.2, 1.5, -0.4, 0.9, 2.2], [-2.0, 0.4, -1.1, 2.4, -0.5, 0.1]] {
        let (a, b) =
            (from_urdf.kinematics.forward(&q), base_link_from_base * built_in.kinematics.forward(&q));
        assert!((a.to_homogeneous() - b.to_homogeneous()).norm() < 1e-9, "{a} {b}");
    }
    // A base in the middle of the tree works as well: here the maker's own frame has no joint below it.
    let error = RobotModel::from_urdf(&ur5e_urdf(), Some("base"), Some("tool0")).unwrap_err();
    assert!(error.to_string().contains("not below"), "{error}");
}

#[test]
fn a_ur_from_urdf_has_all_eight_branches_and_says_how_far_it_falls_short() {
    let robot = RobotModel::from_urdf(&ur5e_urdf(), None, None).unwrap();
    let q = [0.3, -1.2, 1.4, -0.9, 1.1, 0.4];
    let target = robot.kinematics.forward(&q);
    let answer = robot.kinematics.inverse_near(&target, &q);
    assert_eq!(answer.solutions.len(), 8);
    assert!(answer.solutions[0].iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-8));
    for state in &answer.solutions {
        let reached = robot.kinematics.forward(state);
        assert!((reached.to_homogeneous() - target.to_homogeneous()).norm() < 1e-8);
    }
    let failure = robot.kinematics.inverse(&Pose::translation(0.0, 1.0, 0.3), &[]).failure.unwrap();
    assert!(
        matches!(failure.reason, crate::robot::UnreachableReason::OutOfReach { beyond_m, .. } if beyond_m > 0.05)
    );
    let reached = robot.kinematics.forward(&failure.nearest).translation.vector;
    assert!(
        ((reached - nalgebra::Vector3::new(0.0, 1.0, 0.3)).norm() - failure.position_residual_m).abs() < 1e-9
    );
}

#[test]
fn shapes_of_fixed_links_belong_to_the_moving_link_and_meshes_are_named() {
    let robot = RobotModel::from_urdf(&ur5e_urdf(), None, None).unwrap();
    assert_eq!(robot.links.len(), 7);
    let last = &robot.links[6];
    assert_eq!(last.name, "wrist_3");
    assert!(
        matches!(last.shapes[0], LinkShape::Cylinder { .. })
            && matches!(last.shapes[1], LinkShape::Cuboid { .. })
    );
    assert!(
        robot.warnings.iter().any(|w| w.message.contains("camera") && w.message.contains("mesh")),
        "{:?}",
        robot.warnings
    );
    assert!(
        robot.warnings.iter().any(|w| w.message.contains("forearm") && w.message.contains("stand for")),
        "{:?}",
        robot.warnings
    );
}

#[test]
fn a_mesh_without_file_is_named_and_one_with_a_file_becomes_a_shape() {
    let text = ur5e_urdf();
    let robot = RobotModel::from_urdf(&text, None, None).unwrap();
    let warning = robot.warnings.iter().find(|w| w.code == "mesh_left_out").unwrap();
    assert!(warning.message.contains("camera") && warning.message.contains("package://camera.stl"));

    let file = |text: &str| Meshes::from([("package://camera.stl".to_owned(), text.as_bytes().to_vec())]);
    let corners = "v 0 0 0\nv 0.1 0 0\nv 0 0.04 0\nv 0.1 0.04 0.02\n";
    let robot = RobotModel::from_urdf_and_meshes(&text, None, None, &file(corners)).unwrap();
    assert!(robot.warnings.iter().all(|w| w.code != "mesh_left_out"), "{:?}", robot.warnings);
    assert!(robot.warnings.iter().any(|w| w.code == "mesh_replaced" && w.message.contains("box")));
    let Some(LinkShape::Cuboid { half_extents_m, .. }) = robot.links[6].shapes.last() else {
        panic!("{:?}", robot.links[6])
    };
    assert!(half_extents_m.product() <= 0.05 * 0.02 * 0.01 + 1e-12, "{half_extents_m}");

    let refused = |text: &str, file: &Meshes| {
        RobotModel::from_urdf_and_meshes(text, None, None, file).unwrap_err().to_string()
    };
    assert!(refused(&text, &file("<COLLADA/>")).contains("package://camera.stl"));
    assert!(refused(&text, &file("v 0 0 0\nv 100 0 0\n")).contains("millimetres"));
    let scaled = text.replace("camera.stl'", "camera.stl' scale='0.001 0.001 0.001'");
    assert!(RobotModel::from_urdf_and_meshes(&scaled, None, None, &file("v 0 0 0\nv 100 0 0\n")).is_ok());
    let scaled = text.replace("camera.stl'", "camera.stl' scale='0 0 1'");
    assert!(refused(&scaled, &file(corners)).contains("scale"));
}

#[test]
fn what_does_not_fit_a_serial_arm_is_refused_by_name() {
    let text = ur5e_urdf();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        refusal(&text.replacen(from, to, 1))
    };
    assert!(
        with("name='elbow' type='revolute'", "name='elbow' type='prismatic'")
            .contains("\"elbow\": prismatic")
    );
    assert!(with("name='lift' type='revolute'", "name='lift' type='fixed'").contains("5 moving joints"));
    assert!(with("-0.425 0 0", "-425 0 0").contains("\"elbow\": origin xyz has -425"));
    assert!(with("-0.425 0 0", "NaN 0 0").contains("NaN"));
    assert!(with("<axis xyz='0 0 1'/>", "<axis xyz='0 0 0'/>").contains("\"pan\": axis"));
    assert!(with("velocity='3.14'", "velocity='-1'").contains("pan: speed limit is -1"));
    assert!(with("lower='-3.141592653589793'", "lower='4'").contains("elbow: upper limit"));
    assert!(with("<parent link='shoulder'/>", "<parent link='nowhere'/>").contains("\"nowhere\" is missing"));
    assert!(with("<link name='forearm'/>", "<link name='shoulder'/>").contains("another link"));
    assert!(with("radius='0.04'", "radius='inf'").contains("cylinder radius"));
    assert!(with("<child link='forearm'/>", "<child link='shoulder'/>").contains("two joints"));
}

#[test]
fn cycles_end() {
    let links = "<link name='a'/><link name='b'/>";
    let joint = |name: &str, parent: &str, child: &str| {
        format!("<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>")
    };
    let text = format!("<robot name='r'>{links}{}{}</robot>", joint("x", "a", "b"), joint("y", "b", "a"));
    assert!(refusal(&text).contains("cycle"));
    assert!(RobotModel::from_urdf(&text, Some("a"), None).is_err());
    assert!(RobotModel::from_urdf(&text, Some("a"), Some("a")).is_err());
    assert!(RobotModel::from_urdf(&text, Some("a"), Some("b")).is_err());
    let to_itself = format!("<robot name='r'>{links}{}</robot>", joint("x", "a", "a"));
    assert!(RobotModel::from_urdf(&to_itself, Some("a"), Some("b")).is_err());
}

#[test]
fn what_is_no_urdf_is_said_so() {
    for text in
        ["", "hello", "<robot", "<robot/>", "<html></html>", "\0\0", "<robot name='x'><link/></robot>"]
    {
        assert!(matches!(RobotModel::from_urdf(text, None, None), Err(RobotError::Urdf(_))), "{text}");
    }
}

#[test]
fn the_largest_text_is_refused_or_read_without_harm() {
    let most = crate::robot::bounds::LONGEST_URDF_BYTES - 100;
    for piece in
        ["<link name='a'/>", "<joint/>", "<!-- -->", "<link name='&amp;'><visual/></link>", "<x y='z'>t</x>"]
    {
        let text = format!("<robot name='r'>{}</robot>", piece.repeat(most / piece.len()));
        assert!(RobotModel::from_urdf(&text, None, None).is_err());
    }
    let attributes = format!("<robot {}/>", (0..90_000).map(|i| format!("a{i}='1' ")).collect::<String>());
    assert!(RobotModel::from_urdf(&attributes, None, None).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_text_makes_it_panic(text in "[<>/='\" a-z!?&;#x0-9-]{0,80}") {
        let _ = RobotModel::from_urdf(&text, None, None);
    }

    #[test]
    fn no_damage_to_a_urdf_makes_it_panic(at in 0.0..1.0f64, length in 0usize..40, put in "[<>/='\" a-z!?&;#0-9-]{0,8}") {
        let text = ur5e_urdf();
        let from = (at * text.len() as f64) as usize;
        let to = (from + length).min(text.len());
        let damaged = format!("{}{put}{}", &text[..from], &text[to..]);
        let _ = RobotModel::from_urdf(&damaged, None, None);
    }
}
