"""What is wrong is named: the argument, what was found, and what would be right."""

import numpy as np
import pytest

import nboom


@pytest.fixture
def cubesat(examples):
    return nboom.load(examples / "cubesat.toml")


def test_options_that_there_are_not_are_refused_whatever_they_are(cubesat):
    for nothing in (None, False, 1e-9):
        with pytest.raises(TypeError, match="^rtoll: no such option, did you mean rtol"):
            cubesat.run(rtoll=nothing)
    with pytest.raises(TypeError, match="^bogus: no such option$"):
        cubesat.run(bogus=True)
    assert cubesat.run(rtol=None, no_stresses=False).complete


def test_two_directories_are_refused(cubesat, tmp_path):
    with pytest.raises(TypeError, match="output: .* found beside the directory"):
        cubesat.run().save(tmp_path / "one", output=tmp_path / "two")
    with pytest.raises(ValueError, match="directory: an empty text found, a path expected"):
        cubesat.run().save("")


def test_numbers_and_truth_values_of_numpy_are_options(cubesat):
    assert cubesat.run(samples=7.0).states.rows == cubesat.run(samples=np.array(7)).states.rows == 8
    assert cubesat.run(end_time=np.array(0.75))["t"][-1] == 0.75
    assert "beta_1_1_deg" in cubesat.run(columns="beta_1_1", degrees=np.True_).output
    assert "beta_1_1" in cubesat.run(columns="beta_1_1", degrees=np.False_).output


@pytest.mark.parametrize(
    ("options", "kind", "message"),
    [
        ({"samples": 10.5}, nboom.InputError, "samples: `10.5` found, a whole number expected"),
        ({"samples": 2**70}, nboom.InputError, "samples: `1180591620717411303424` found, a smaller number expected"),
        ({"samples": -(2**70)}, nboom.InputError, "samples: `-1180591620717411303424` found, a larger number expected"),
        ({"samples": 0}, nboom.InputError, "samples: `0` found, a number from 1 to 10000000 expected"),
        ({"samples": 10**5000}, nboom.InputError, "samples: a larger whole number found, .* expected"),
        ({"samples": True}, TypeError, "samples: True found, a text, a number or a list of them expected"),
        ({"samples": 5, "times": [1.0]}, nboom.InputError, "samples: found beside times, one of them expected"),
        ({"end_time": "abc"}, nboom.InputError, "end_time: `abc` found, a number expected"),
        ({"end_time": np.inf}, nboom.InputError, "end_time: `inf` found, a finite number expected"),
        ({"path": "some"}, nboom.InputError, "path: `some` found, one of auto, generated, generic expected"),
        ({"integrator": "euler"}, nboom.InputError, "integrator: `euler` found, one of .*dopri5.* expected"),
        ({"no_stresses": "yes"}, TypeError, "no_stresses: 'yes' found, a truth value expected"),
        ({"degrees": 1}, TypeError, "degrees: 1 found, a truth value expected"),
        ({"as_1970": "most"}, nboom.InputError, "as_1970: `most` found, one of .* expected"),
    ],
)
def test_values_of_options_say_what_is_expected(cubesat, options, kind, message):
    with pytest.raises(kind, match=f"^{message}$"):
        cubesat.run(**options)


@pytest.mark.parametrize(
    ("time", "kind", "message"),
    [
        (10**400, nboom.InputError, "a larger whole number found, a number up to 1.8e308 expected"),
        (np.nan, ValueError, "NaN found, a finite number expected"),
        ("now", TypeError, "'now' found, a number expected"),
        (True, TypeError, "True found, a number expected"),
    ],
    ids=["huge", "nan", "text", "truth"],
)
def test_the_time_of_a_state_is_a_finite_number(cubesat, time, kind, message):
    dynamics = cubesat.dynamics()
    for find in (dynamics.accelerations, dynamics.equations):
        with pytest.raises(kind, match=f"^time: {message}$"):
            find([0.0] * 3, [0.0] * 4, [0.0] * 4, time=time)


def test_kinds_of_numbers_are_times(cubesat):
    dynamics, state = cubesat.dynamics(), ([0.1] * 3, [0.2] * 4, [0.3] * 4)
    expected = dynamics.accelerations(*state, time=2.0)
    for time in (2, np.float32(2.0), np.int8(2), np.array(2.0)):
        for a, b in zip(dynamics.accelerations(*state, time=time), expected, strict=True):
            np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("wrong", ["", " ", "a\nb", "a\x1b[2J", "a/b", ".a", "a" * 201])
def test_names_of_texts_are_those_of_folders(examples, wrong):
    for name, format in (("boom.toml", "toml"), ("n-boom-1970.nml", "nml")):
        with pytest.raises(nboom.InputError, match="^name: `.*` found, the name of a folder: 1 to 200 bytes"):
            nboom.parse((examples / name).read_text(), wrong, format)
    with pytest.raises(nboom.InputError, match="^name: "):
        nboom.scene(wrong, run={"end": 1.0})


@pytest.mark.parametrize("wrong", ["x", "0.1", None, True, np.array([1.0, 2.0]), [1.0]])
def test_numbers_of_a_scene_are_numbers(cubesat, examples, wrong):
    with pytest.raises(TypeError, match="^parameters.stiffness: .* found, a number expected"):
        cubesat.with_values({"parameters.stiffness": wrong})
    with pytest.raises(TypeError, match="^parameters: stiffness: .* found, a number expected"):
        nboom.load(examples / "cubesat.toml", parameters={"stiffness": wrong})
    with pytest.raises(TypeError, match="^held: y panel 1: .* found, a number expected"):
        cubesat.dynamics(held={"y panel 1": wrong})


def test_numbers_of_numpy_are_numbers(cubesat):
    for number in (np.float32(0.5), np.int64(2), np.array(0.5), 2):
        assert cubesat.with_values({"parameters.stiffness": number})["parameters.stiffness"] == number


def test_arguments_of_sweeps_say_what_is_expected(few, tmp_path, cubesat):
    for wrong in ("2", 1.5, True):
        with pytest.raises(TypeError, match="^jobs: .* found, a whole number expected"):
            nboom.sweep(few, tmp_path / "out", jobs=wrong)
    for wrong in ([1, 2, 3], "1/2", 1):
        with pytest.raises(TypeError, match="^shard: .* found, two whole numbers expected"):
            nboom.sweep(few, tmp_path / "out", shard=wrong)
    for wrong in ((1.0, 2), (True, 2)):
        with pytest.raises(TypeError, match="^shard: .* found, a whole number expected"):
            nboom.sweep(few, tmp_path / "out", shard=wrong)
    for wrong in ((-1, 2), (0, 2), (3, 2), (1, 10**30)):
        with pytest.raises(nboom.InputError, match="^shard: .* found"):
            nboom.sweep(few, tmp_path / "out", shard=wrong)
    with pytest.raises(nboom.InputError, match="case: 1180591620717411303424 found, a number from 1 to 40 expected"):
        nboom.study(few).case(2**70)
    with pytest.raises(TypeError, match="case: '1' found, a whole number expected"):
        nboom.study(few).case("1")
    with pytest.raises(TypeError, match="states: 'a' found, a whole number expected"):
        cubesat.verify("a")
    with pytest.raises(TypeError, match="tol: 'a' found, a number expected"):
        cubesat.verify(4, tol="a")
    assert nboom.sweep(few, tmp_path / "out", shard=[1, np.int64(2)], progress=False).directory.exists()


def test_paths_are_named(few, tmp_path):
    with pytest.raises(TypeError, match="^path: None found, a path expected"):
        nboom.load(None)
    with pytest.raises(TypeError, match="^path: 3 found, a path expected"):
        nboom.study(3)
    with pytest.raises(TypeError, match="^shards: 'sw/s1' found, a list of directories expected"):
        nboom.merge("sw/s1", tmp_path / "out")
    with pytest.raises(TypeError, match="^shards: .* found, a path expected"):
        nboom.merge([3], tmp_path / "out")


@pytest.mark.parametrize("wrong", [[("stiffness", 1.0)], "stiffness", 5, []])
def test_numbers_by_name_come_as_a_dict(cubesat, examples, wrong):
    with pytest.raises(TypeError, match="^parameters: .* found, a dict expected"):
        nboom.load(examples / "cubesat.toml", parameters=wrong)
    with pytest.raises(TypeError, match="^values: .* found, a dict expected"):
        cubesat.with_values(wrong)
    with pytest.raises(TypeError, match="^held: .* found, a dict expected"):
        cubesat.dynamics(held=wrong)


def test_names_of_numbers_are_texts(cubesat, examples):
    with pytest.raises(TypeError, match="^parameters: 1 found, a text expected"):
        nboom.load(examples / "cubesat.toml", parameters={1: 2.0})
    with pytest.raises(TypeError, match="^values: 1 found, a text expected"):
        cubesat.with_values({1: 2.0})
    with pytest.raises(TypeError, match="^held: 1 found, a text expected"):
        cubesat.dynamics(held={1: 2.0})


def test_numbers_that_are_too_large_are_named(cubesat, examples):
    with pytest.raises(nboom.InputError, match="^main_body.mass: .* found, a number up to 1.8e308 expected"):
        cubesat.with_values({"main_body.mass": 10**400})
    with pytest.raises(nboom.InputError, match="^parameters: stiffness: .* found, a number up to 1.8e308 expected"):
        nboom.load(examples / "cubesat.toml", parameters={"stiffness": -(10**5000)})


@pytest.mark.parametrize("wrong", [5, 0, "yes"])
def test_progress_is_a_truth_value_or_a_function(few, tmp_path, wrong):
    with pytest.raises(TypeError, match="^progress: .* found, a truth value or a function expected"):
        nboom.sweep(few, tmp_path / "out", progress=wrong)
    assert not (tmp_path / "out").exists()
