//! What a robot's links and joints mean.

use std::f64::consts::FRAC_PI_2;

use nboom_io::{Format, ReadOptions, SceneFile, parse, parse_robot, parse_scene, write_scene};
use nboom_model::Base;
use nboom_scalar::{Sym3, Vec3};

const BODY: &str = "<inertial><origin xyz=\"0.5 0 0\"/><mass value=\"2\"/>\
    <inertia ixx=\"1\" ixy=\"0.1\" ixz=\"0\" iyy=\"2\" iyz=\"0\" izz=\"1.5\"/></inertial>";

fn robot(parts: &str) -> SceneFile {
    let text = format!(
        "<robot name=\"arm\"><link name=\"base\">{BODY}</link><link name=\"arm\">{BODY}</link>{parts}\
         </robot>"
    );
    parse_robot("arm.urdf", &text, "file", Base::Free).expect("a robot")
}

/// A joint from one link to the other.
fn joint(motion: &str, parent: &str, child: &str, parts: &str) -> String {
    format!(
        "<joint name=\"{parent} {child}\" type=\"{motion}\"><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/>{parts}</joint>"
    )
}

fn is_near(found: Vec3<f64>, expected: [f64; 3]) -> bool {
    let [x, y, z] = expected;
    (found - Vec3::new(x, y, z)).norm() < 1e-15
}

#[test]
fn a_joint_is_a_hinge_where_its_origin_is() {
    let parts = "<origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/><axis xyz=\"0 3 4\"/>\
                 <dynamics damping=\"0.7\"/>";
    let file = robot(&joint("revolute", "base", "arm", parts));
    let scene = &file.scene;
    let body = &scene.bodies[0];
    assert_eq!((scene.name.as_str(), scene.name_of(0)), ("arm", Some("arm")));
    assert!(is_near(body.mount.point, [1.0, 2.0, 3.0]));
    assert!(is_near(body.axis, [0.0, 0.6, 0.8]));
    // The yaw of a quarter turn puts x of the arm along y of the base.
    let x = body.mount.rot_inboard_from_hinge * Vec3::unit_x();
    assert!(is_near(x, [0.0, 1.0, 0.0]));
    assert_eq!(body.hinge.dashpot.rate_linear, -0.7);
    let expected = Sym3 { xx: 1.0, yy: 2.0, zz: 1.5, xy: 0.1, xz: 0.0, yz: 0.0 };
    assert_eq!((body.mass_properties.mass, body.mass_properties.inertia), (2.0, expected));
    assert!(is_near(body.mass_properties.center_of_mass, [0.5, 0.0, 0.0]));
    assert_eq!(file.settings.units.expect("URDF has units").name(), "SI");
}

#[test]
fn roll_comes_before_pitch_before_yaw() {
    let quarter = FRAC_PI_2;
    let parts = format!("<origin rpy=\"{quarter} {quarter} 0\"/>");
    let file = robot(&joint("continuous", "base", "arm", &parts));
    let rot = file.scene.bodies[0].mount.rot_inboard_from_hinge;
    // Roll takes y to z, pitch takes z to x.
    assert!(is_near(rot * Vec3::unit_y(), [1.0, 0.0, 0.0]));
    assert!(is_near(file.scene.bodies[0].axis, [1.0, 0.0, 0.0]));
}

#[test]
fn fixed_links_are_one_body() {
    let tool = format!("<link name=\"tool\">{BODY}</link><link name=\"frame\"/>");
    let turned = "<origin xyz=\"2 0 0\" rpy=\"0 0 3.141592653589793\"/>";
    let file = robot(&format!(
        "{tool}{}{}{}",
        joint("continuous", "base", "arm", "<axis xyz=\"0 0 1\"/>"),
        joint("fixed", "arm", "tool", turned),
        joint("fixed", "tool", "frame", "")
    ));
    let body = &file.scene.bodies[0].mass_properties;
    // Mass centres 0.5 and 2 - 0.5 from the hinge, the turn by half changes no product of xy.
    let expected = Sym3 { xx: 2.0, yy: 5.0, zz: 4.0, xy: 0.2, xz: 0.0, yz: 0.0 };
    assert_eq!(file.scene.bodies.len(), 1);
    assert_eq!(body.mass, 4.0);
    assert!(is_near(body.center_of_mass, [1.0, 0.0, 0.0]));
    let difference = body.inertia + expected * -1.0;
    assert!(difference.to_matrix().rows.iter().all(|row| row.norm() < 1e-15));
}

#[test]
fn a_robot_may_float_on_a_root_without_mass() {
    let text = format!("<link name=\"world\"/>{}", joint("floating", "world", "base", ""));
    let file = robot(&format!("{text}{}", joint("continuous", "base", "arm", "")));
    assert_eq!(file.scene.main_body.mass, 2.0);
    assert_eq!(file.scene.bodies.len(), 1);
}

#[test]
fn a_robot_that_others_would_fix_floats_with_a_warning() {
    let text = format!("<link name=\"world\"/>{}", joint("fixed", "world", "base", ""));
    let file = robot(&format!("{text}{}", joint("continuous", "base", "arm", "")));
    assert_eq!(file.scene.main_body.mass, 2.0);
    assert!(!file.scene.base.is_held());
    let told: Vec<&str> = file.warnings.iter().map(|warning| warning.found.as_str()).collect();
    assert_eq!(told, ["`world` as the root"]);
}

#[test]
fn a_base_is_fixed_of_robots_alone() {
    let joint = joint("fixed", "world", "base", "");
    let text = format!(
        "<robot name=\"arm\"><link name=\"world\"/><link name=\"base\">{BODY}</link>{joint}</robot>"
    );
    let options = ReadOptions { fixed_base: true, ..ReadOptions::default() };
    let read = |format, text: &str| parse(format, ("arm", text), "arm", None, &options);
    let fixed = read(Format::Urdf, &text).expect("a robot");
    assert_eq!(fixed.scene.base, Base::Fixed);
    assert!(fixed.warnings.is_empty());
    let scene = write_scene(&fixed);
    assert!(scene.contains("base = \"fixed\""));
    for (format, text) in [(Format::Toml, scene.as_str()), (Format::Nml, "&DIM\n&END\n")] {
        let told = read(format, text).expect_err("no robot").to_string();
        assert!(told.starts_with("arm: --fixed-base found, which only a robot"), "{told}");
    }
}

#[test]
fn a_root_that_is_fixed_needs_no_mass() {
    let text = format!(
        "<robot name=\"arm\"><link name=\"world\"/><link name=\"arm\">{BODY}</link>{}</robot>",
        joint("continuous", "world", "arm", "")
    );
    let read = |format, text: &str, fixed_base| {
        let options = ReadOptions { fixed_base, ..ReadOptions::default() };
        parse(format, ("arm", text), "arm", None, &options)
    };
    let fixed = read(Format::Urdf, &text, true).expect("a robot");
    assert_eq!(fixed.scene.main_body.mass, 0.0);
    let again = read(Format::Toml, &write_scene(&fixed), false).expect("a scene");
    assert_eq!(again.scene, fixed.scene);
    let floats = read(Format::Urdf, &text, false).expect_err("no mass").to_string();
    assert!(floats.contains("link `world` without mass"), "{floats}");
    assert!(floats.contains("or --fixed-base, by which the ground holds it"), "{floats}");
    let alone = "<robot name=\"arm\"><link name=\"world\"/></robot>";
    let nothing = read(Format::Urdf, alone, true).expect_err("no mass").to_string();
    assert!(nothing.contains("link `world` without mass"), "{nothing}");
    assert!(!nothing.contains("--fixed-base"), "{nothing}");
}

#[test]
fn what_is_left_out_is_named() {
    let parts = "<limit lower=\"-1\" upper=\"1\"/><mimic joint=\"base arm\"/><dynamics friction=\"1\" mu_coulomb=\"2\"/>\
                 <safety_controller/>";
    let file = robot(&format!(
        "<transmission/><transmission/>{}",
        joint("revolute", "base", "arm", parts)
    ));
    let told: Vec<&str> = file.warnings.iter().map(|warning| warning.found.as_str()).collect();
    assert_eq!(file.scene.bodies[0].hinge.friction, 1.0);
    for expected in [
        "limits of base arm",
        "mimicry of base arm",
        "mu_coulomb of base arm",
        "safety_controller, transmission (2)",
    ] {
        assert!(told.contains(&expected), "{told:?}");
    }
}

#[test]
fn attributes_of_other_programs_are_no_errors() {
    let parts = "<origin/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" jerk=\"2\"/>\
                 <dynamics damping=\"0.7\" friction=\"0\" D=\"1\" K=\"2\" mu_coulomb=\"0\" mu_viscous=\"3\"/>";
    let joint = joint("revolute", "base", "arm", parts).replacen(
        "<joint",
        "<joint dont_collapse=\"true\" xmlns:a=\"b\" a:c=\"d\"",
        1,
    );
    assert_eq!(robot(&joint).scene.bodies[0].hinge.dashpot.rate_linear, -0.7);
    let unused = "<axis/><dynamics/>";
    robot(&self::joint("fixed", "base", "arm", unused));
}

#[test]
fn what_is_left_out_of_an_inertial_is_named() {
    let body = BODY.replace("</inertial>", "<density/></inertial>");
    let text = format!("<robot name=\"arm\"><link name=\"base\">{body}</link></robot>");
    let file = parse_robot("arm.urdf", &text, "file", Base::Free).expect("a robot");
    let told: Vec<&str> = file.warnings.iter().map(|warning| warning.found.as_str()).collect();
    assert_eq!(told, ["density"]);
}

/// The tree of a robot is that of the scene that it is written as, whatever its links are called.
#[test]
fn a_link_may_have_the_name_of_the_main_body() {
    for name in ["main_body", "main body"] {
        let text = format!("<link name=\"{name}\">{BODY}</link>");
        let joints = [joint("continuous", "base", name, ""), joint("continuous", name, "arm", "")];
        let scene = robot(&format!("{text}{}", joints.concat()));
        assert_eq!(scene.scene.bodies[1].inboard, Some(0));
        let again = parse_scene("a.toml", &write_scene(&scene), "a", None, &ReadOptions::default());
        let again = again.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(*again.scene, *scene.scene);
        assert_eq!([0, 1].map(|i| again.scene.name_of(i)), [Some(name), Some("arm")]);
    }
}

/// A scene that is made of a robot can be read, whatever the robot is called.
#[test]
fn a_robot_has_the_name_of_a_folder() {
    let long = "\u{e9}".repeat(150);
    let cut = "\u{e9}".repeat(100);
    for (name, expected) in [("a/b:c", "a_b_c"), ("..", "_."), (&long, &cut)] {
        let text = format!("<robot name=\"{name}\"><link name=\"base\">{BODY}</link></robot>");
        let file = parse_robot("arm.urdf", &text, "file", Base::Free).expect("a robot");
        assert_eq!(file.scene.name, expected);
        let options = ReadOptions::default();
        let again = parse_scene("arm.toml", &write_scene(&file), "arm", None, &options);
        assert_eq!(again.expect("a scene").scene.name, expected);
    }
}

fn warned(file: &SceneFile) -> Vec<&str> {
    file.warnings.iter().map(|warning| warning.found.as_str()).collect()
}

#[test]
fn elements_and_attributes_of_a_namespace_are_not_read() {
    let foreign = "<gz:link name=\"ghost\"/><gz:joint name=\"ghost\" type=\"fixed\"/>";
    let parts = "<gz:origin xyz=\"9 9 9\"/><origin gz:xyz=\"8 8 8\" xyz=\"1 2 3\"><gz:pose/></origin>\
                 <gz:axis xyz=\"0 0 1\"/><gz:mimic joint=\"ghost\"/><gz:dynamics damping=\"5\"/>";
    let joint = joint("continuous", "base", "arm", parts);
    let joint = joint.replacen("name=", "gz:name=\"ghost\" name=", 1);
    let body = BODY.replace("<mass", "<gz:mass value=\"-1\"/><gz:inertia/><mass gz:value=\"7\"");
    let text = format!(
        "<robot name=\"arm\" xmlns:gz=\"http://gazebosim.org/schema\"><link name=\"base\">\
         <gz:inertial/>{body}</link><link name=\"arm\">{BODY}</link>{joint}{foreign}</robot>"
    );
    let file = parse_robot("arm.urdf", &text, "file", Base::Free).expect("a robot");
    let scene = &file.scene;
    assert_eq!((scene.main_body.mass, scene.bodies.len()), (2.0, 1));
    assert!(is_near(scene.bodies[0].mount.point, [1.0, 2.0, 3.0]));
    assert!(is_near(scene.bodies[0].axis, [1.0, 0.0, 0.0]));
    assert_eq!(scene.bodies[0].hinge.dashpot.rate_linear, 0.0);
    let left_out = "gz:axis, gz:dynamics, gz:inertia, gz:inertial, gz:joint, gz:link, gz:mass, gz:mimic, \
                    gz:origin, gz:pose";
    assert_eq!(warned(&file), [left_out]);
}

#[test]
fn a_robot_may_have_a_namespace() {
    let joint = joint("revolute", "base", "arm", "<origin xyz=\"1 2 3\"/><axis xyz=\"0 0 1\"/>");
    let plain = robot(&joint);
    for (name, prefix) in [("xmlns", ""), ("xmlns:urdf", "urdf:")] {
        let links = ["base", "arm"].map(|link| format!("<link name=\"{link}\">{BODY}</link>"));
        let inner = format!("{}{joint}", links.concat());
        let inner = inner.replace("</", "\n/").replace('<', &format!("<{prefix}"));
        let inner = inner.replace("\n/", &format!("</{prefix}"));
        let text = format!(
            "<{prefix}robot name=\"arm\" {name}=\"http://www.ros.org\">{inner}<gazebo xmlns=\"\"/>\
             </{prefix}robot>"
        );
        let file = parse_robot("arm.urdf", &text, "file", Base::Free).expect("a robot");
        assert_eq!(*file.scene, *plain.scene);
        assert_eq!(warned(&file), ["gazebo"]);
    }
}

#[test]
fn dynamics_that_are_left_out_are_named() {
    let dynamics = "damping=\"0.2\" D=\"5\" K=\"3\" mu_viscous=\"4\" mu_coulomb=\"2\"";
    let second = "friction=\"0\" D=\"0\" K=\"stiff\" mu_coulomb=\"0.0\"";
    let file = robot(&format!(
        "<link name=\"hand\">{BODY}</link><link name=\"tool\">{BODY}</link>{}{}{}",
        joint("continuous", "base", "arm", &format!("<dynamics {dynamics}/>")),
        joint("continuous", "arm", "hand", &format!("<dynamics {dynamics}/>")),
        joint("continuous", "hand", "tool", &format!("<dynamics {second}/>")),
    ));
    assert_eq!(
        warned(&file),
        ["D, K, mu_coulomb, mu_viscous of base arm, arm hand", "K of hand tool"]
    );
    assert_eq!(file.warnings[0].symbol, "dynamics");
    assert_eq!(
        file.warnings[0].expected,
        "`damping` and `friction` alone: joints move without the rest"
    );
    let rates = file.scene.bodies.iter().map(|body| body.hinge.dashpot.rate_linear);
    assert_eq!(rates.collect::<Vec<_>>(), [-0.2, -0.2, 0.0]);
}

/// As in a file of a CAD program.
#[test]
fn rounding_of_a_point_mass_is_no_defect() {
    let head = "<inertial><origin xyz=\"0.0185 -0.1108 0\"/><mass value=\"1.33687\"/>\
        <inertia ixx=\"0\" ixy=\"0\" ixz=\"2.40741e-35\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>";
    let file = robot(&format!(
        "<link name=\"head\">{head}</link>{}{}",
        joint("continuous", "base", "arm", ""),
        joint("continuous", "arm", "head", "")
    ));
    assert_eq!(file.scene.bodies[1].mass_properties.mass, 1.33687);
}

#[test]
fn links_of_a_body_may_miss_the_triangle_inequality_or_mass_with_a_warning() {
    let foot = "<inertial><mass value=\"0\"/>\
        <inertia ixx=\"0.5\" ixy=\"0\" ixz=\"0\" iyy=\"0.5\" iyz=\"0\" izz=\"0.5\"/></inertial>";
    let frame = foot.replace("0.5", "0");
    let camera = foot
        .replace("\"0\"/><in", "\"1\"/><in")
        .replacen("0.5", "0.01", 1)
        .replacen("0.5", "0.01", 1);
    let file = robot(&format!(
        "<link name=\"foot\">{foot}</link><link name=\"frame\">{frame}</link>\
         <link name=\"camera\">{camera}</link>{}{}{}{}",
        joint("continuous", "base", "arm", ""),
        joint("fixed", "arm", "foot", ""),
        joint("fixed", "arm", "frame", ""),
        joint("fixed", "base", "camera", "")
    ));
    let body = &file.scene.bodies[0].mass_properties;
    assert_eq!((body.mass, body.inertia.xx, body.inertia.yy), (2.0, 1.5, 2.5));
    assert_eq!((file.scene.main_body.mass, file.scene.main_body.inertia.xx), (3.0, 1.01));
    let told =
        ["mass 0 of link `foot`", "principal moments of inertia 0.01, 0.01, 0.5 of link `camera`"];
    assert_eq!(warned(&file), told);
    let expected = "a positive finite mass: added as it is to the links that it is fixed to";
    assert_eq!(
        (file.warnings[0].symbol.as_str(), file.warnings[0].expected.as_str()),
        ("mass", expected)
    );
}

#[test]
fn a_robot_floats_from_where_its_joint_puts_it() {
    let parts = "<origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/><dynamics damping=\"5\"/>";
    let text = format!(
        "<robot name=\"arm\"><link name=\"world\"/><link name=\"base\">{BODY}</link>\
         <link name=\"arm\">{BODY}</link>{}{}</robot>",
        joint("floating", "world", "base", parts),
        joint("continuous", "base", "arm", "")
    );
    for base in [Base::Free, Base::Fixed] {
        let file = parse_robot("arm.urdf", &text, "file", base.clone()).expect("a robot");
        let initial = &file.scene.initial;
        assert_eq!(file.scene.base, base);
        assert!(is_near(initial.position_inertial, [1.0, 2.0, 3.0]));
        assert!(is_near(initial.attitude.to_matrix() * Vec3::unit_x(), [0.0, 1.0, 0.0]));
        assert_eq!(warned(&file), ["damping of world base"]);
        assert_eq!(file.warnings[0].expected, "none: nothing brakes a robot that floats");
        let again =
            parse_scene("arm.toml", &write_scene(&file), "arm", None, &ReadOptions::default());
        let again = again.expect("a scene");
        assert_eq!(again.scene, file.scene);
    }
}

#[test]
fn a_root_of_mass_zero_is_a_root_without_mass() {
    let nothing = BODY.replace("\"2\"", "\"0\"").replace("\"1\"", "\"0\"");
    let nothing = nothing.replace("\"0.1\"", "\"0\"").replace("\"1.5\"", "\"0\"");
    let text = format!(
        "<link name=\"world\">{nothing}</link>{}{}",
        joint("floating", "world", "base", ""),
        joint("continuous", "base", "arm", "")
    );
    assert_eq!(robot(&text).scene.main_body.mass, 2.0);
}
