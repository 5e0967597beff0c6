"""Motions that can be written down, and physics that no code may break."""

import numpy as np
import pytest

import nboom

STIFFNESS, INNER, OUTER, START = 2.0, 40.0, 1.5, 30.0


def oscillator(damping):
    """A wheel on the axis of a satellite, on a spring."""
    return nboom.scene(
        "wheel",
        run={"end": 5.0},
        main_body={"mass": 100.0, "inertia": [50.0, 50.0, INNER]},
        body=[
            {
                "name": "wheel",
                "mass": 3.0,
                "mass_centre": [0.0, 0.0, 0.0],
                "inertia": [1.0, 1.0, OUTER],
                "hinge": {
                    "at": [0.0, 0.0, 0.0],
                    "axis": "z",
                    "start_deg": START,
                    "spring": {"stiffness": STIFFNESS},
                    "damper": {"damping": damping},
                },
            }
        ],
    )


@pytest.mark.parametrize("damping", [0.0, 0.4])
@pytest.mark.parametrize("integrator", ["dop853", "adams", "taylor", "gauss_lanes", "radau5", "radau9", "radau13"])
def test_a_wheel_on_a_spring_swings_by_the_formula(damping, integrator):
    run = oscillator(damping).run(rtol=1e-11, integrator=integrator)
    over = 1 / INNER + 1 / OUTER
    decay = damping * over / 2
    rate = np.sqrt(STIFFNESS * over - decay**2)
    t, start = run["t"], np.radians(START)
    beta = start * np.exp(-decay * t) * (np.cos(rate * t) + decay / rate * np.sin(rate * t))
    tau = -start * np.exp(-decay * t) * STIFFNESS * over / rate * np.sin(rate * t)
    np.testing.assert_allclose(run["beta_1_1"], beta, atol=1e-8)
    np.testing.assert_allclose(run["tau_1_1"], tau, atol=1e-8)
    # The satellite turns back as much as the wheel turns, by their inertias.
    np.testing.assert_allclose(run["omega_z"], -tau * OUTER / (INNER + OUTER), atol=1e-9)


def test_the_energy_of_an_undamped_spring_is_kept():
    run = oscillator(0.0).run(rtol=1e-11)
    energy = run["kinetic_energy"] + STIFFNESS * run["beta_1_1"] ** 2 / 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-9)


def test_a_free_body_precesses_by_the_formula():
    axial, transverse, spin, wobble = 20.0, 15.0, 1.5, 0.2
    scene = nboom.scene(
        "top",
        run={"end": 10.0},
        main_body={"mass": 10.0, "inertia": [axial, transverse, transverse]},
        initial={"rate_deg": np.degrees([spin, wobble, 0.0])},
    )
    run = scene.run(rtol=1e-12)
    angle = (axial - transverse) / transverse * spin * run["t"]
    np.testing.assert_allclose(run["omega_x"], spin, rtol=1e-9)
    np.testing.assert_allclose(run["omega_y"], wobble * np.cos(angle), atol=1e-8)
    np.testing.assert_allclose(run["omega_z"], wobble * np.sin(angle), atol=1e-8)
    nutation = np.arctan2(transverse * wobble, axial * spin)
    np.testing.assert_allclose(run["nutation"], nutation, atol=1e-8)


@pytest.mark.parametrize("name", ["four-wings.nml", "cubesat.toml", "boom.toml"])
def test_no_latch_changes_the_angular_momentum(examples, name):
    run = nboom.load(examples / name).run(rtol=1e-11)
    momentum = np.stack([run[f"angular_momentum_{axis}"] for axis in "xyz"])
    assert np.abs(momentum - momentum[:, :1]).max() < 1e-8 * np.linalg.norm(momentum[:, 0])


@pytest.mark.parametrize("name", ["n-boom-1970.nml", "four-wings.nml", "solar-array.toml", "gimbal.toml"])
def test_every_formulation_and_the_generated_code_agree(examples, name):
    scene = nboom.load(examples / name)
    recursion = scene.dynamics(path="generic", formulation="recursive")
    dice, n = np.random.default_rng(3), len(recursion.hinges)
    state = [dice.normal(size=(200, size)) for size in (3, n, n, n)]
    expected = np.concatenate(recursion.accelerations(*state), axis=1)
    largest = np.abs(expected).max(axis=1, keepdims=True)
    others = [scene.dynamics(path="generated")]
    formulations = ["report", "relative", "symmetric", "articulated"]
    # Stops look at rates, so that momenta do not cover the solar array.
    if name != "solar-array.toml":
        formulations.append("momentum")
    for formulation in formulations:
        others.append(scene.dynamics(path="generic", formulation=formulation))
    for dynamics in others:
        found = np.concatenate(dynamics.accelerations(*state), axis=1)
        assert np.max(np.abs(found - expected) / largest) < 1e-11, dynamics


def test_a_hinge_held_is_one_that_a_torque_keeps_still(examples):
    scene = nboom.load(examples / "n-boom-1970.nml")
    free = scene.dynamics(path="generic", formulation="recursive")
    held = scene.dynamics(path="generic", formulation="recursive", held={"1,2": 0.4})
    dice = np.random.default_rng(4)
    omega, beta, tau = dice.normal(size=3), dice.normal(size=4), dice.normal(size=4)
    beta[1], tau[1] = 0.4, 0.0
    matrix, forcing = free.equations(omega, beta, tau)
    keep = np.delete(np.arange(10), 7)
    # Without the held hinge's row and column: its acceleration is zero, its torque whatever is needed.
    expected = np.linalg.solve(matrix[np.ix_(keep, keep)], forcing[keep])
    omega_dot, origin, tau_dot = held.accelerations(omega, np.delete(beta, 1), np.delete(tau, 1))
    found = np.concatenate([origin, omega_dot, tau_dot])
    assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max()


def test_a_matrix_is_that_of_kinetic_energy(examples):
    scene = nboom.load(examples / "gimbal.toml")
    run = scene.run(rtol=1e-10)
    dynamics = scene.dynamics(path="generic", formulation="symmetric")

    def column(*names):
        return np.stack([run[name] for name in names], axis=1)

    omega = column("omega_x", "omega_y", "omega_z")
    beta, tau = column("beta_1_1", "beta_1_2"), column("tau_1_1", "tau_1_2")
    matrix, _ = dynamics.equations(omega, beta, tau)
    # The velocity of O in main-body axes, of which the table has inertial ones.
    chi, kappa, v = run["chi"], column("kappa_x", "kappa_y", "kappa_z"), column("v_x", "v_y", "v_z")
    twice = 2 * np.cross(v, kappa)
    body = v + chi[:, None] * twice + np.cross(twice, kappa)
    speed = np.concatenate([body, omega, tau], axis=1)
    energy = np.einsum("ni,nij,nj->n", speed, matrix, speed) / 2
    np.testing.assert_allclose(energy, run["kinetic_energy"], rtol=1e-11)
