//! Scenes in the words of a program: the same scenes as in TOML.

use std::path::Path;

use nboom_io::words::{
    Axes, BodyWords, HingeWords, KickOff, SceneWords, Thrust, after, at, body, coupling, damper,
    hinge, initial, main_body, scene, spring, when,
};
use nboom_io::{read_scene, write_scene};
use nboom_model::{
    BodyShape, HingeState, MassProperties, Material, Scene, SectionShape, SegmentStructure, Solid,
    Station,
};
use nboom_scalar::{Sym3, Vec3};

use super::right;

/// Equal to the last bit, the signs of zeros included.
fn same(words: SceneWords, toml: &Scene) {
    let built = words.build().unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(format!("{built:#?}"), format!("{toml:#?}"));
}

fn example(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name);
    read_scene(&path).unwrap_or_else(|error| panic!("{error}")).scene
}

fn panel(name: &str, hinge: HingeWords) -> BodyWords {
    let (mass, long, wide) = (2.5, 1.0, 1.5);
    body(name)
        .mass(mass)
        .mass_centre([0.0, long / 2.0, 0.0])
        .inertia([
            mass * long * long / 12.0,
            mass * wide * wide / 12.0,
            mass * (long * long + wide * wide) / 12.0,
        ])
        .tip([0.0, long, 0.0])
        .shape(BodyShape::around([0.0, long / 2.0, 0.0], Solid::Panel([wide, long, 0.0].into())))
        .hinge(hinge.axis("x").latch_deg(0.0))
}

#[test]
fn the_wing_is_that_of_its_file() {
    let inner = hinge()
        .at([0.0, 0.6, -0.5])
        .start_deg(90.0)
        .release(at(1.0))
        .spring(spring(0.3).rest_deg(-30.0))
        .damper(damper(0.25));
    let middle = hinge()
        .at([0.0, 1.0, 0.0])
        .start_deg(-180.0)
        .release(when("inner panel").passes_deg(45.0))
        .spring(spring(0.2).rest_deg(30.0))
        .damper(damper(0.2));
    let outer = hinge()
        .at([0.0, 1.0, 0.0])
        .start_deg(180.0)
        .release(when("middle panel").passes_deg(-90.0))
        .spring(spring(0.2).rest_deg(-30.0))
        .damper(damper(0.2));
    let bus = BodyShape::around([0.0; 3], Solid::Box([1.6, 1.0, 1.2].into()));
    let wing = scene("wing")
        .end(30.0)
        .main_body(main_body().mass(150.0).inertia([30.0, 28.0, 32.0]).shape(bus))
        .body(panel("inner panel", inner).repeat(2, "z"))
        .body(panel("middle panel", middle).on("inner panel"))
        .body(panel("outer panel", outer).on("middle panel"));
    same(wing, &example("wing.toml"));
}

#[test]
fn the_gimbal_is_that_of_its_file() {
    let cylinder = |middle, radius, length, along| {
        BodyShape::around(middle, Solid::Cylinder { radius, length, along })
    };
    let bus = BodyShape::around([0.0; 3], Solid::Box([1.0, 1.0, 1.1].into()));
    let bracket = body("bracket")
        .mass(3.0)
        .mass_centre([0.0, 0.0, 0.15])
        .inertia([0.03, 0.03, 0.01])
        .tip([0.0, 0.0, 0.3])
        .shape(cylinder([0.0, 0.0, 0.15], 0.06, 0.3, Vec3::unit_z()))
        .hinge(
            hinge()
                .at([0.3, 0.0, 0.6])
                .axis("z")
                .release(at(2.0))
                .spring(spring(0.5).rest_deg(40.0))
                .damper(damper(1.2)),
        );
    let dish = body("dish")
        .on("bracket")
        .mass(6.0)
        .mass_centre([0.2, 0.0, 0.0])
        .inertia([0.8, 0.45, 0.45])
        .shape(cylinder([0.2, 0.0, 0.0], 0.4, 0.08, Vec3::unit_x()))
        .hinge(
            hinge()
                .at([0.0, 0.0, 0.3])
                .axis("-y")
                .start_deg(-60.0)
                .release(when("bracket").passes_deg(20.0))
                .damper(damper(1.0))
                .torque_deg(&[[-60.0, 1.0], [-5.0, 0.5], [25.0, 0.0], [65.0, -1.0]]),
        );
    let gimbal = scene("gimbal")
        .end(40.0)
        .main_body(main_body().mass(200.0).inertia([60.0, 55.0, 70.0]).shape(bus))
        .initial(initial().attitude(Axes::turn_deg("z", 30.0)).rate_deg([0.0, 0.5, 0.0]))
        .body(bracket)
        .body(dish);
    same(gimbal, &example("gimbal.toml"));
}

/// Every key that no example has.
#[test]
fn all_other_words_mean_what_they_mean_in_toml() {
    let toml = r#"
name = "all"

[run]
start = 1.0
end = 9.0

[main_body]
mass = 100.0
mass_centre = [0.1, 0.2, 0.3]
inertia = { xx = 40.0, yy = 30.0, zz = 20.0, xy = 0.1, yz = -0.2 }

[initial]
attitude = { quaternion = [0.5, 0.5, -0.5, 0.5] }
rate_rad = [0.1, 0.2, 0.3]
position = [1.0, 2.0, 3.0]
velocity = [4.0, 5.0, 6.0]

[gravity]
acceleration = 9.81
up = [1.0, 2.0, 2.0]

[thrust]
force = [1.0, 2.0, 3.0]
point = [0.1, 0.0, 0.0]
from = 2.0
until = 3.0

[[body]]
name = "a"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]
kick_off = { main_body_end = [0.0, 1.0, 0.0], end = [0.0, 0.5, 0.0], force = [1.0, -0.5, 0.0, 0.0], limit = 2.0 }

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = [0.0, 3.0, 4.0]
axes = { euler_xyx_rad = [0.1, 0.2, 0.3] }
start_rad = 0.25
rate_rad = 0.5
latch_rad = 1.5
spring = { stiffness = 2.0, rest_rad = 0.1, quadratic = 0.3 }
damper = { damping = 0.1, rate_squared = 0.2, angle = 0.3, angle_squared = 0.4, rest_rad = 0.5 }

[[body]]
name = "b"
on = "a"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = "x"
axes = { euler_xyx_deg = [10.0, 20.0, 30.0] }
rate_deg = 3.0
state = "free"
torque_rad = [[0.0, 1.0], [1.0, 0.0]]

[[body.coupling]]
to = "a"
stiffness = 2.0
acts_on = "this"

[[body]]
name = "c"
on = "main_body"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = "x"
axes = { columns = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]] }
release = { after = "a", by = 2.0 }

[[body]]
name = "d"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = "x"
axes = { turn = { about = "-z", by_rad = 0.7 } }
"#;
    let rod = |name: &str, hinge: HingeWords| {
        let rod = body(name).mass(3.0).mass_centre([0.0, 1.0, 0.0]);
        rod.inertia([1.0, 0.1, 1.0]).hinge(hinge.at([0.0, 2.0, 0.0]))
    };
    let inertia = Sym3 { xx: 40.0, yy: 30.0, zz: 20.0, xy: 0.1, xz: 0.0, yz: -0.2 };
    let bus = main_body().mass(100.0).mass_centre([0.1, 0.2, 0.3]).inertia(inertia);
    let motion = initial()
        .attitude(Axes::quaternion([0.5, 0.5, -0.5, 0.5]))
        .rate_rad([0.1, 0.2, 0.3])
        .position([1.0, 2.0, 3.0])
        .velocity([4.0, 5.0, 6.0]);
    let a = hinge()
        .axis([0.0, 3.0, 4.0])
        .axes(Axes::euler_xyx_rad([0.1, 0.2, 0.3]))
        .start_rad(0.25)
        .rate_rad(0.5)
        .latch_rad(1.5)
        .spring(spring(2.0).rest_rad(0.1).quadratic(0.3))
        .damper(damper(0.1).rate_squared(0.2).angle(0.3).angle_squared(0.4).rest_rad(0.5));
    let b = hinge()
        .axis("x")
        .axes(Axes::euler_xyx_deg([10.0, 20.0, 30.0]))
        .rate_deg(3.0)
        .state(HingeState::Free)
        .torque_rad(&[[0.0, 1.0], [1.0, 0.0]]);
    let c = hinge()
        .axis(Vec3::unit_x())
        .axes(Axes::columns([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]))
        .release(after("a").by(2.0));
    let d = hinge().axis("x").axes(Axes::turn_rad("-z", 0.7));
    let kick_off = KickOff {
        main_body_end: [0.0, 1.0, 0.0],
        end: [0.0, 0.5, 0.0],
        force: [1.0, -0.5, 0.0, 0.0],
        limit: 2.0,
    };
    let thrust = Thrust { force: [1.0, 2.0, 3.0], point: [0.1, 0.0, 0.0], from: 2.0, until: 3.0 };
    let words = scene("all")
        .start(1.0)
        .end(9.0)
        .main_body(bus)
        .initial(motion)
        .gravity(9.81, [1.0, 2.0, 2.0])
        .thrust(thrust)
        .body(rod("a", a).kick_off(kick_off))
        .body(rod("b", b).on("a").coupling(coupling("a").stiffness(2.0).acts_on_this()))
        .body(rod("c", c).on("main_body"))
        .body(rod("d", d));
    same(words, &right(toml).scene);
}

pub fn bus() -> SceneWords {
    scene("a").end(10.0).main_body(main_body().mass(100.0).inertia([40.0, 30.0, 20.0]))
}

pub fn rod(name: &str) -> BodyWords {
    let rod = body(name).mass(3.0).mass_centre([0.0, 1.0, 0.0]).inertia([1.0, 0.1, 1.0]);
    rod.hinge(hinge().at([0.0, 2.0, 0.0]).axis("x"))
}

/// What is said of a scene, line by line.
pub fn told(words: SceneWords) -> Vec<String> {
    let errors = words.build().expect_err("something is wrong");
    let told: Vec<String> = errors.to_string().lines().map(str::to_owned).collect();
    assert_eq!(told.len(), errors.0.len());
    told
}

#[test]
fn structures_are_those_of_the_bodies() {
    let slice = MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.1, 1.0));
    let section = SectionShape::Tube { radius: 0.1, thickness: 0.001 };
    let whole = SegmentStructure {
        pulse_constant: 0.1,
        material: Material::elastic(7e10, 0.3),
        stations: vec![Station { distance_from_hinge: 0.0, slice, section }],
    };
    let one = bus().body(rod("a").structure(whole.clone()));
    let (_, structure) = one.clone().build_with_structure().unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(structure.expect("given").segments(), [whole]);
    let latching = rod("b").hinge(hinge().at([0.0, 2.0, 0.0]).axis("x").latch_deg(10.0));
    assert_eq!(told(one.body(latching)), ["body `b`: structure: found none, expected a value"]);
    let (_, none) = bus().body(rod("a")).build_with_structure().expect("right");
    assert_eq!(none, None);
}

/// What a program says can be written for people.
#[test]
fn words_become_toml() {
    let built = bus().body(rod("a")).build().expect("right");
    let mut file = right(super::BUS);
    file.scene = built.clone();
    assert_eq!(right(&write_scene(&file)).scene, built);
}
