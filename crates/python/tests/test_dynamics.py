"""Equations of motion in bulk."""

import resource
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import nboom

SCENES = ["n-boom-1970.nml", "four-wings.nml", "solar-array.toml", "gimbal.toml", "mast.toml"]
FORMULATIONS = ["report", "relative", "symmetric", "articulated"]


def states(dynamics, count, seed=1):
    dice = np.random.default_rng(seed)
    n = len(dynamics.hinges)
    return dice.normal(size=(count, 3)), dice.normal(size=(count, n)), dice.normal(size=(count, n))


def flat(accelerations):
    return np.concatenate(accelerations, axis=-1)


def off(found, expected):
    """The largest deviation, relative to the largest number of its state."""
    return (np.abs(found - expected).max(axis=-1) / np.abs(expected).max(axis=-1)).max()


@pytest.fixture
def satellite(examples):
    return nboom.load(examples / "n-boom-1970.nml")


@pytest.mark.parametrize("name", SCENES)
def test_all_code_agrees(examples, name):
    scene = nboom.load(examples / name)
    recursion = scene.dynamics(path="generic", formulation="recursive")
    arguments = states(recursion, 100)
    expected = flat(recursion.accelerations(*arguments))
    # Well-conditioned scenes: rounding of some thousand operations.
    assert off(flat(scene.dynamics().accelerations(*arguments)), expected) < 1e-10
    for formulation in FORMULATIONS:
        try:
            dynamics = scene.dynamics(path="generic", formulation=formulation)
        except nboom.InputError as error:
            assert "does not cover" in str(error)
            continue
        assert off(flat(dynamics.accelerations(*arguments)), expected) < 1e-10, formulation


@pytest.mark.parametrize("name", SCENES[:3])
@pytest.mark.parametrize("formulation", ["symmetric", "recursive"])
def test_matrix_times_acceleration_is_forcing(examples, name, formulation):
    dynamics = nboom.load(examples / name).dynamics(path="generic", formulation=formulation)
    arguments = states(dynamics, 20)
    torque = np.ones_like(arguments[1])
    matrix, forcing = dynamics.equations(*arguments, torque)
    omega_dot, origin, tau_dot = dynamics.accelerations(*arguments, torque)
    solution = np.concatenate([origin, omega_dot, tau_dot], axis=1)
    assert off(np.einsum("nij,nj->ni", matrix, solution), forcing) < 1e-9
    np.testing.assert_allclose(matrix, matrix.transpose(0, 2, 1), rtol=0, atol=1e-9 * np.abs(matrix).max())


def test_one_state_is_a_row_of_many(satellite):
    for path in ("generic", "auto"):
        dynamics = satellite.dynamics(path=path)
        arguments = states(dynamics, 100)
        many = flat(dynamics.accelerations(*arguments))
        for i in (0, 41, 99):
            one = flat(dynamics.accelerations(*(rows[i] for rows in arguments)))
            assert one.shape == (10,) and off(one, many[i]) < 1e-13


def test_held_hinges_do_not_turn(satellite, examples):
    free = satellite.dynamics(path="generic")
    held = satellite.dynamics(path="generic", held={"1,1": 0.3, "2,2": -0.1})
    assert held.hinges == [free.hinges[1], free.hinges[2]]
    omega, beta, tau = states(held, 10)
    assert flat(held.accelerations(omega, beta, tau)).shape == (10, 8)
    panels = nboom.load(examples / "cubesat.toml")
    names = panels.dynamics().hinges
    assert panels.dynamics(held={names[0]: 0.0, "x panel 2": 0.0}).hinges == names[2:]
    none = satellite.dynamics(held=dict.fromkeys(["1,1", "1,2", "2,1", "2,2"], 0.0))
    assert none.accelerations([1.0, 2.0, 3.0], [], [])[2].shape == (0,)
    with pytest.raises(nboom.InputError, match="`3,1` found, a hinge of the scene expected"):
        satellite.dynamics(held={"3,1": 0.0})
    with pytest.raises(ValueError, match="NaN found for hinge"):
        satellite.dynamics(held={"1,1": float("nan")})


def test_generated_code_on_demand(satellite, examples):
    assert satellite.dynamics(path="generated").path == "generated"
    with pytest.raises(nboom.InputError, match="no routine for topology Tsss"):
        nboom.load(examples / "mast.toml").dynamics(path="generated")


def test_any_layout_of_numbers_is_taken(satellite):
    dynamics = satellite.dynamics()
    omega, beta, tau = states(dynamics, 24)
    expected = flat(dynamics.accelerations(omega, beta, tau))
    read_only = beta.copy()
    read_only.flags.writeable = False
    wide = np.zeros((24, 8))
    wide[:, ::2] = tau
    for b, t in [
        (beta.tolist(), tau.tolist()),
        (np.asfortranarray(beta), wide[:, ::2]),
        (read_only, tau.astype(">f8")),
        (beta[::-1][::-1], np.array(tau.T, order="C").T),
    ]:
        np.testing.assert_array_equal(flat(dynamics.accelerations(omega, b, t)), expected)
    whole = dynamics.accelerations([1, 0, 0], np.zeros(4, dtype=np.int32), np.zeros(4, dtype=np.float32))
    np.testing.assert_array_equal(flat(whole), flat(dynamics.accelerations([1.0, 0, 0], [0.0] * 4, [0.0] * 4)))


@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        ({"omega": np.zeros(4)}, ValueError, r"omega: an array of shape \(4,\) found, \(3,\) or \(N, 3\) expected"),
        ({"beta": np.zeros((5, 3))}, ValueError, r"beta: an array of shape \(5, 3\) found, \(4,\) or \(N, 4\)"),
        ({"beta": np.zeros((2, 2, 4))}, ValueError, "beta: an array of shape"),
        ({"beta": 0.0}, ValueError, r"beta: an array of shape \(\) found"),
        ({"tau": np.zeros((5, 4))}, ValueError, "one state found, rows of 5 as in tau expected"),
        ({"tau": np.zeros(4, dtype=complex)}, TypeError, "tau: complex128 found, real numbers expected"),
        ({"tau": ["a", "b", "c", "d"]}, TypeError, "tau: .* found, real numbers expected"),
        ({"tau": [None] * 4}, TypeError, "tau: .* found, real numbers expected"),
        ({"beta": [0.0, 1.0, np.nan, 0.0]}, ValueError, r"beta\[2\]: NaN found, a finite number expected"),
        ({"omega": [0.0, np.inf, 0.0]}, ValueError, r"omega\[1\]: inf found"),
        ({"torque": np.zeros(3)}, ValueError, "torque: an array"),
        ({"attitude": np.zeros(3)}, ValueError, "attitude: an array"),
        ({"attitude": np.zeros(4)}, ValueError, "attitude: a quaternion of length 0 found, 1 expected"),
        ({"time": float("inf")}, ValueError, "time: inf found"),
    ],
)
def test_wrong_arguments_say_what_was_found_and_expected(satellite, change, kind, message):
    arguments = {"omega": np.zeros(3), "beta": np.zeros(4), "tau": np.zeros(4)} | change
    with pytest.raises(kind, match=message):
        satellite.dynamics().accelerations(**arguments)


def test_the_place_of_a_number_in_bulk_is_told(satellite):
    dynamics = satellite.dynamics()
    omega, beta, tau = states(dynamics, 1000)
    tau[700, 2] = np.nan
    with pytest.raises(ValueError, match=r"tau\[700, 2\]: NaN found"):
        dynamics.accelerations(omega, beta, tau)


def test_a_formulation_without_a_matrix_says_so(satellite):
    with pytest.raises(ValueError, match="articulated: it never forms a mass matrix"):
        satellite.dynamics(path="generic", formulation="articulated").equations([0, 0, 0], [0] * 4, [0] * 4)


def test_threads_do_not_disturb_each_other(satellite):
    dynamics = satellite.dynamics()
    arguments = [states(dynamics, 20_000, seed) for seed in range(4)]
    expected = [flat(dynamics.accelerations(*of_thread)) for of_thread in arguments]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(lambda of_thread: flat(dynamics.accelerations(*of_thread)), arguments))
    for a, b in zip(found, expected, strict=True):
        np.testing.assert_array_equal(a, b)


def test_memory_does_not_grow_over_many_calls(satellite):
    dynamics = satellite.dynamics()
    good, bad = (np.zeros(3), np.zeros(4), np.zeros(4)), (np.zeros(3), np.zeros(5), np.zeros(4))

    def calls(count):
        for _ in range(count):
            dynamics.accelerations(*good)
            try:
                dynamics.accelerations(*bad)
            except ValueError:
                pass

    calls(5_000)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    calls(50_000)
    # In kB; a leak of one array in each call would be ten thousand.
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 4_000


RIG = """
name = "rig"
[main_body]
mass = 9.0
inertia = [4.0, 3.0, 2.0]
{held}
[gravity]
acceleration = 9.8
up = "z"
[[body]]
name = "panel"
mass = 4.0
mass_centre = [0.0, 0.5, 0.0]
inertia = [0.4, 0.02, 0.4]
tip = [0.0, 1.0, 0.0]
hinge = {{ at = [0.0, 1.0, 0.0], axis = "x" }}
[[body]]
name = "outer panel"
on = "panel"
mass = 3.0
mass_centre = [0.0, 0.5, 0.0]
inertia = [0.3, 0.02, 0.3]
tip = [0.0, 1.0, 0.0]
hinge = {{ at = [0.0, 1.0, 0.0], axis = "x" }}
[run]
end = 1.0
"""
DRIVEN = 'drive = { axis = "z", rate_rad = [[0.0, 0.2], [9.0, 2.0]] }'


@pytest.mark.parametrize("held", ['base = "fixed"', DRIVEN])
def test_all_code_holds_a_main_body_on_a_rig(tmp_path, held):
    path = tmp_path / "rig.toml"
    path.write_text(RIG.format(held=held))
    scene = nboom.load(path)
    recursion = scene.dynamics(path="generic", formulation="recursive")
    _, beta, tau = states(recursion, 20)
    omega = np.zeros((20, 3))
    omega[:, 2] = 0.2 if held == DRIVEN else 0.0
    expected = recursion.accelerations(omega, beta, tau)
    codes = [scene.dynamics(path="generic", formulation=form) for form in FORMULATIONS]
    for dynamics in [scene.dynamics(path="generated"), *codes]:
        found = dynamics.accelerations(omega, beta, tau)
        # The main body moves as prescribed, in bulk and in the four states beyond two times eight.
        assert np.array_equal(found[0], expected[0]) and np.array_equal(found[1], expected[1])
        assert off(found[2], expected[2]) < 1e-12
    with pytest.raises(ValueError, match="the main body is held"):
        codes[0].equations(omega, beta, tau)


@pytest.mark.parametrize("held", ['base = "fixed"', DRIVEN])
def test_equations_of_a_main_body_on_a_rig_have_its_accelerations(held):
    dynamics = nboom.parse(RIG.format(held=held)).dynamics(formulation="recursive")
    _, beta, tau = states(dynamics, 70)
    omega = np.zeros((70, 3))
    torque = np.linspace(-1.0, 1.0, 140).reshape(70, 2)
    omega_dot, origin, tau_dot = dynamics.accelerations(omega, beta, tau, torque)
    matrix, forcing = dynamics.equations(omega, beta, tau, torque)
    found = np.linalg.solve(matrix, forcing[..., None])[..., 0]
    expected = np.concatenate([origin, omega_dot, tau_dot], axis=1)
    # The condition of the matrices is below 1e4.
    assert np.linalg.cond(matrix).max() < 1e4
    assert off(found, expected) < 1e-11


def test_gravity_and_inertial_forces_on_a_rig_are_those_of_the_attitude_of_the_scene():
    panel = {
        "name": "panel",
        "mass": 2.0,
        "mass_centre": [1.0, 0.0, 0.0],
        "inertia": [0.1] * 3,
        "hinge": {"at": [0.0, 0.0, 0.0], "axis": "y"},
        # It carries the weight.
        "thruster": [{"force": [0.0, 0.0, 19.6], "point": [1.0, 0.0, 0.0], "axes": "inertial"}],
    }
    scene = nboom.scene(
        "rig",
        main_body={"mass": 1.0, "inertia": [1.0] * 3, "base": "fixed"},
        body=[panel],
        gravity={"acceleration": 9.8, "up": "z"},
        run={"end": 1.0},
        initial={"attitude": {"turn": {"about": "x", "by_deg": 180.0}}},
    )
    dynamics = scene.dynamics()
    at_rest = ([0.0] * 3, [0.0], [0.0])
    assert abs(dynamics.accelerations(*at_rest)[2][0]) < 1e-12
    # Turned about the vertical, nothing changes for gravity.
    assert abs(dynamics.accelerations(*at_rest, attitude=[0.0, 0.6, 0.8, 0.0])[2][0]) < 1e-12
    with pytest.raises(ValueError, match="attitude: found one with another direction of gravity"):
        dynamics.accelerations(*at_rest, attitude=[1.0, 0.0, 0.0, 0.0])


def test_names_of_bodies_come_before_numbers_of_hinges():
    hinge = {"at": [0.5, 0.0, 0.1], "axis": "z", "spring": {"stiffness": 2.0}}
    boom = {"mass": 3.0, "mass_centre": [1.0, 0.0, 0.0], "inertia": [0.1, 1.0, 1.0], "hinge": hinge}

    def left(first, second, held):
        main_body = {"mass": 100.0, "inertia": [40.0, 30.0, 20.0]}
        bodies = [boom | {"name": name} for name in (first, second)]
        scene = nboom.scene("two", run={"end": 10.0}, main_body=main_body, body=bodies)
        return scene.dynamics(held={held: 0.0}).hinges

    assert left("2,1", "b", "2,1") == ["2,1 (b)"]
    assert left("a", "b", "2,1") == ["1,1 (a)"]
    assert left("a", "b", "2,1 (b)") == ["1,1 (a)"]
    assert left("2,1 (b)", "b", "2,1 (b)") == ["2,1 (b)"]
