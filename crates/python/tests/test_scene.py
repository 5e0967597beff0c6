"""Scenes: read, said in Python, changed, refused."""

import pickle
import warnings

import numpy as np
import pytest

import nboom

ONE_BOOM = {
    "run": {"end": 10.0},
    "main_body": {"mass": 100.0, "inertia": [40.0, 30.0, 20.0]},
    "body": [
        {
            "name": "boom",
            "mass": 3.0,
            "mass_centre": [1.0, 0.0, 0.0],
            "inertia": np.array([0.1, 1.0, 1.0]),
            "hinge": {
                "at": (0.5, 0.0, 0.1),
                "axis": "z",
                "start_deg": 90,
                "latch_deg": np.float64(0.0),
                "spring": {"stiffness": 2.0},
            },
        }
    ],
}

TEXT = """
[run]
end = 10.0
[main_body]
mass = 100.0
inertia = [40.0, 30.0, 20.0]
[[body]]
name = "boom"
mass = 3.0
mass_centre = [1.0, 0.0, 0.0]
inertia = [0.1, 1.0, 1.0]
[body.hinge]
at = [0.5, 0.0, 0.1]
axis = "z"
start_deg = 90.0
latch_deg = 0.0
spring = { stiffness = 2.0 }
"""


def bits(scene):
    return np.asarray(scene.run().states).tobytes()


def test_decks_scenes_and_robots_are_read(examples):
    deck = nboom.load(examples / "n-boom-1970.nml")
    assert deck.degrees_of_freedom == 10
    assert [hinge.label for hinge in deck.hinges] == ["1,1", "1,2", "2,1", "2,2"]
    array = nboom.load(str(examples / "solar-array.toml"), parameters={"damping": 11.0})
    assert array.parameters["damping"] == 11.0
    assert array.hinges[0].body == "yoke 1"
    robot = nboom.parse(ROBOT, "arm", format="urdf")
    assert robot.degrees_of_freedom == 7


def test_a_scene_in_words_is_that_of_its_text():
    assert bits(nboom.scene("boom", **ONE_BOOM)) == bits(nboom.parse(TEXT, "boom"))


def test_a_deck_and_its_text_have_the_same_motion(examples):
    deck = nboom.load(examples / "n-boom-1970.nml")
    assert bits(nboom.parse(deck.text, deck.name)) == bits(deck)


def test_numbers_are_read_and_set_by_path():
    scene = nboom.parse(TEXT, "boom")
    path = "body.boom.hinge.spring.stiffness"
    stiffer = scene.with_values({path: 3.0})
    assert (scene[path], stiffer[path]) == (2.0, 3.0)
    assert stiffer.run().events["t"][0] < scene.run().events["t"][0]
    with pytest.raises(nboom.InputError, match="body.boom.hinge.spring.stiffness"):
        scene["body.boom.hinge.spring.stifness"]
    with pytest.raises(nboom.InputError, match="mass"):
        scene.with_values({"body.boom.mass": -1.0})


def test_a_scene_is_no_list_of_its_numbers(examples):
    scene = nboom.load(examples / "cubesat.toml")
    with pytest.raises(TypeError, match="'Scene' object is not iterable"):
        list(scene)
    with pytest.raises(TypeError, match="'Scene' object is not a container"):
        "main_body.mass" in scene  # noqa: B015


def test_hinges_are_equal_if_label_and_body_are(examples):
    scene = nboom.load(examples / "cubesat.toml")
    one, other = scene.hinges[:2]
    assert one == scene.hinges[0] and one != other and one != "1,1"
    assert scene.hinges.index(other) == 1 and {one: 1}[scene.hinges[0]] == 1
    assert one == pickle.loads(pickle.dumps(one)) and repr(one) == f"Hinge('1,1', {one.body!r})"


def test_a_pickled_scene_moves_the_same(examples):
    scene = nboom.load(examples / "cubesat.toml")
    assert bits(pickle.loads(pickle.dumps(scene))) == bits(scene)


def test_wrong_scenes_are_refused_with_place_and_remedy(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(TEXT.replace("stiffness", "stifness"))
    with pytest.raises(nboom.InputError, match=r"wrong.toml:17:\d+: .*did you mean `stiffness`") as caught:
        nboom.load(path)
    assert isinstance(caught.value, ValueError)
    with pytest.raises(nboom.InputError, match="nowhere.toml"):
        nboom.load(tmp_path / "nowhere.toml")
    with pytest.raises(nboom.InputError, match="scene.txt"):
        nboom.load(tmp_path / "scene.txt")
    with pytest.raises(ValueError, match="`yaml` found, toml, nml or urdf expected"):
        nboom.parse(TEXT, format="yaml")


@pytest.mark.parametrize(
    ("tables", "place"),
    [
        ({"run": {"end": object()}}, "run.end"),
        ({"body": [{"mass": 1j}]}, r"body\[1\].mass"),
        ({"run": {1: 2}}, "run"),
        ({"run": {"end": 1 << 70}}, "run.end"),
    ],
)
def test_what_toml_cannot_say_is_a_type_error(tables, place):
    with pytest.raises(TypeError, match=place + ": .* found, .* expected"):
        nboom.scene("wrong", **tables)


def test_warnings_are_python_s(examples):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        nboom.load(examples / "n-boom-1970.nml")
    assert any(issubclass(warning.category, nboom.SceneWarning) for warning in said)


def test_a_scene_shows_itself(examples):
    shown = nboom.load(examples / "cubesat.toml")._repr_html_()
    assert "<svg" in shown and "10 degrees of freedom" in shown


def test_verify_says_that_all_code_agrees(examples):
    found = nboom.load(examples / "n-boom-1970.nml").verify(states=10)
    assert found["passed"] and len(found["rows"]) > 10
    with pytest.raises(nboom.ComparisonFailed, match="more than 1e-30") as caught:
        nboom.load(examples / "n-boom-1970.nml").verify(states=2, tol=1e-30)
    assert not caught.value.found["passed"]
    with pytest.raises(ValueError, match="states: 0 found"):
        nboom.load(examples / "n-boom-1970.nml").verify(states=0)


ROBOT = """<robot name="arm">
<link name="base"><inertial><mass value="10"/><origin xyz="0 0 0"/>
<inertia ixx="2" iyy="2" izz="2" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="arm"><inertial><mass value="1"/><origin xyz="0.5 0 0.1"/>
<inertia ixx="0.1" iyy="0.3" izz="0.3" ixy="0.01" ixz="0" iyz="0"/></inertial></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0.4 0" rpy="0.2 0 0.1"/>
<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="10" velocity="10"/></joint>
</robot>"""


def test_a_number_has_one_value(examples):
    scene = nboom.load(examples / "cubesat.toml")
    for second in ("body.x panel.mass", 'body."x panel".mass'):
        with pytest.raises(nboom.InputError, match=r"values: `body\[1\].mass` and .* are one number"):
            scene.with_values({"body[1].mass": 0.2, "main_body.mass": 9.0, second: 0.3})
