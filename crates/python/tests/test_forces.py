"""Forces as they act at a time and in a posture: accelerations are those of runs that are there."""

import numpy as np
import pytest

import nboom

#: Between the times from which differences are taken.
H = 1e-4


def satellite(main=None, body=None, hinge=None, **tables):
    return nboom.scene(
        "one boom",
        run={"end": 10.0},
        initial={"rate_deg": [10.0, 20.0, 30.0]} if "drive" not in (main or {}) else None,
        main_body={"mass": 100.0, "inertia": [40.0, 30.0, 20.0], **(main or {})},
        body=[
            {
                "name": "boom",
                "mass": 3.0,
                "mass_centre": [1.0, 0.0, 0.0],
                "inertia": [0.1, 1.0, 1.0],
                "hinge": {"at": [0.5, 0.0, 0.1], "axis": "z", "start_deg": 90.0, **(hinge or {})},
                **(body or {}),
            }
        ],
        **tables,
    )


def states(scene, times):
    """At each time what the equations are evaluated at, and what a run has there by differences: ω̇ and τ̇."""
    around = np.add.outer(times, [-H, 0.0, H])
    run = scene.run(times=around.ravel(), rtol=1e-12, atol=1e-14)
    at = [np.searchsorted(run["t"], time - 1e-9) for time in around.ravel()]
    omega = np.stack([run[f"omega_{axis}"] for axis in "xyz"], axis=1)
    beta, tau = run["beta_1_1"][:, None], run["tau_1_1"][:, None]
    attitude = np.stack([run[name] for name in ("chi", "kappa_x", "kappa_y", "kappa_z")], axis=1)
    before, here, after = np.array(at).reshape(-1, 3).T
    rates = np.hstack([omega, tau])
    return (omega[here], beta[here], tau[here], attitude[here]), (rates[after] - rates[before]) / (2 * H)


PULSE = {"force": [0.0, 0.0, 5.0], "point": [1.0, 1.0, 0.0], "from": 1.0, "until": 3.0}
TORQUE = {"torque": [0.0, 0.2, 0.0], "over_time": [[0.0, 0.0], [1.0, 1.0], [4.0, 0.2]]}
INERTIAL = {"torque": [0.0, 0.2, 0.0], "axes": "inertial"}
ON_BODY = {"torque": [0.0, 0.0, 0.2], "from": 1.0, "until": 5.0}
KICK_OFF = {"main_body_end": [0.5, 0.3, 0.1], "end": [0.5, 0.2, 0.0], "force": [20.0, -5.0, 0.0, 0.0], "limit": 0.6}
ROTOR = {"axis": "z", "inertia": 0.05, "speed_over_time_rad": [[1.0, 100.0], [5.0, 300.0]]}
DRIVE = {"axis": "z", "rate_deg": [[0.0, 0.0], [5.0, 30.0], [8.0, 30.0]]}
TABLE = [[-20.0, 1.0], [10.0, 0.5], [60.0, -1.0], [89.0, -3.0], [95.0, -3.5]]

SCENES = {
    "thruster": lambda: satellite(main={"thruster": [{**PULSE, "from": None, "until": None}]}),
    "thruster from 1 to 3": lambda: satellite(main={"thruster": [PULSE]}),
    "torque over time": lambda: satellite(main={"torque": [TORQUE]}),
    "torque along inertial axes": lambda: satellite(main={"torque": [INERTIAL]}),
    "torque on a body": lambda: satellite(body={"torque": [ON_BODY]}),
    "rotor": lambda: satellite(main={"rotor": [ROTOR]}),
    "table": lambda: satellite(hinge={"torque_deg": TABLE}),
    "drive": lambda: satellite(main={"drive": DRIVE}),
    "kick-off spring": lambda: satellite(body={"kick_off": KICK_OFF}),
}


@pytest.mark.parametrize("name", SCENES)
def test_accelerations_are_those_of_a_run(name):
    scene = SCENES[name]()
    # Before, between and after the times of all of them.
    times = np.array([0.05, 0.15, 0.5, 0.9, 1.5, 2.0, 2.5, 3.5, 4.5, 5.5, 6.5, 9.0])
    arguments, expected = states(scene, times)
    codes = [scene.dynamics(), scene.dynamics(path="generated"), scene.dynamics(path="generic", formulation="symmetric")]
    for dynamics in [*codes, scene.dynamics(path="generic", formulation="recursive")]:
        for i, time in enumerate(times):
            omega, beta, tau, attitude = (rows[i] for rows in arguments)
            omega_dot, _, tau_dot = dynamics.accelerations(omega, beta, tau, attitude=attitude, time=time)
            # Differences err by h² and by rounding over h.
            found = np.append(omega_dot, tau_dot)
            np.testing.assert_allclose(found, expected[i], rtol=0, atol=2e-7 * max(1, np.abs(expected[i]).max()))


def test_forces_of_each_state_hold_for_eight_at_once():
    scene = satellite(hinge={"torque_deg": TABLE}, body={"kick_off": KICK_OFF}, main={"thruster": [PULSE]})
    dynamics = scene.dynamics(path="generated")
    beta = np.radians(np.linspace(-200.0, 200.0, 43))[:, None]
    omega, tau = np.ones((43, 3)), np.ones((43, 1))
    torques = set()
    for time in (2.0, 5.0):
        many = dynamics.accelerations(omega, beta, tau, time=time)
        for i in range(43):
            one = dynamics.accelerations(omega[i], beta[i], tau[i], time=time)
            np.testing.assert_allclose(np.concatenate(one), np.concatenate([rows[i] for rows in many]), rtol=1e-12)
        torques.add(many[2][0, 0])
    assert len(torques) == 2


def test_mass_matrix_and_forcing_have_the_forces_of_the_time():
    scene = satellite(main={"thruster": [PULSE]})
    for formulation in ("recursive", "symmetric"):
        dynamics = scene.dynamics(path="generic", formulation=formulation)
        forcings = [dynamics.equations([0.0] * 3, [0.0], [0.0], time=time)[1] for time in (0.0, 2.0, 9.0)]
        np.testing.assert_array_equal(forcings[0], forcings[2])
        np.testing.assert_allclose(forcings[1] - forcings[0], [0, 0, 5, 5, -5, 0, 0], atol=1e-12)


def test_a_thruster_without_a_hinge_is_not_left_out():
    scene = nboom.scene(
        "s",
        run={"end": 3.0},
        main_body={"mass": 100.0, "inertia": [40.0, 30.0, 20.0], "thruster": [{"force": [0, 0, 5.0], "point": [1, 1, 0]}]},
    )
    omega_dot, origin, _ = scene.dynamics().accelerations([0] * 3, [], [], time=1.0)
    np.testing.assert_allclose(omega_dot, [5 / 40, -5 / 30, 0])
    np.testing.assert_allclose(origin, [0, 0, 0.05])


def test_results_are_tuples():
    dynamics = satellite().dynamics(path="generic")
    assert type(dynamics.accelerations([0.0] * 3, [0.0], [0.0])) is tuple
    assert type(dynamics.equations([0.0] * 3, [0.0], [0.0])) is tuple
