"""Accelerations in bulk beside Pinocchio's, where that is installed."""

import numpy as np
import pytest
from test_scene import ROBOT

import nboom

pin = pytest.importorskip("pinocchio")


def robots():
    """A robot of ours, and all public ones where they are installed."""
    yield "arm", ROBOT
    try:
        from example_robot_data import robots_loader
    except ImportError:
        return
    for name in ("ur5", "anymal", "go2", "g1", "talos"):
        yield name, open(robots_loader.load_full(name)[2]).read()


@pytest.mark.parametrize(("name", "text"), robots(), ids=lambda of: of if len(of) < 20 else "")
def test_accelerations_are_pinocchio_s(name, text):
    model = pin.buildModelFromXML(text, pin.JointModelFreeFlyer())
    model.gravity.setZero()
    data = model.createData()
    dynamics = nboom.parse(text, name, format="urdf").dynamics(path="generic")
    n = model.nv - 6
    assert len(dynamics.hinges) == n
    dice = np.random.default_rng(5)
    omega, beta, tau, torque = (dice.normal(size=(50, size)) for size in (3, n, n, n))
    omega_dot, origin, tau_dot = dynamics.accelerations(omega, beta, tau, torque)
    order = order_of_joints(model, name, text)
    for i in range(50):
        q, v, u = np.zeros(model.nq), np.zeros(model.nv), np.zeros(model.nv)
        q[6] = 1.0
        q[7:][order], v[3:6], v[6:][order], u[6:][order] = beta[i], omega[i], tau[i], torque[i]
        expected = pin.aba(model, data, q, v, u)
        # The main body's point O stands still, so its spatial and its classical acceleration are the same.
        found = np.concatenate([origin[i], omega_dot[i], np.zeros(n)])
        found[6:][order] = tau_dot[i]
        assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max()


def order_of_joints(model, name, text):
    """Where each of our hinges is among Pinocchio's joints; a hinge has the name of the body on it."""
    import xml.etree.ElementTree as xml

    bodies = {joint.find("child").get("link"): joint.get("name") for joint in xml.fromstring(text).iter("joint")}
    hinges = nboom.parse(text, name, format="urdf").hinges
    return [model.joints[model.getJointId(bodies[hinge.body])].idx_v - 6 for hinge in hinges]
