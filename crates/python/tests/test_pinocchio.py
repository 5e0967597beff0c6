"""Accelerations in bulk beside Pinocchio's, where that is installed."""

import re
from pathlib import Path

import numpy as np
import pytest
from test_scene import ROBOT

import nboom

pin = pytest.importorskip("pinocchio")


#: Of the wheel example-robot-data, which lies beside Pinocchio's.
PUBLIC = {
    "ur5": "ur_description/urdf/ur5_robot.urdf",
    "panda": "panda_description/urdf/panda.urdf",
    "anymal": "anymal_c_simple_description/urdf/anymal.urdf",
    "go2": "go2_description/urdf/go2.urdf",
    "g1": "g1_description/urdf/g1_29dof_rev_1_0.urdf",
    "talos": "talos_data/robots/talos_reduced.urdf",
    "humanoid": "simple_humanoid_description/urdf/simple_humanoid.urdf",
}


def robots():
    """A robot of ours, and public ones where they are installed."""
    folder = Path(pin.__file__).parents[4] / "share" / "example-robot-data" / "robots"
    public = [(name, folder / path) for name, path in PUBLIC.items()]
    found = [("arm", ROBOT), *((name, path.read_text()) for name, path in public if path.exists())]
    # Pinocchio takes neither dampers nor mimicking joints into its accelerations.
    return [(name, re.sub(r"<(dynamics|mimic)\b[^>]*/>", "", text)) for name, text in found]


@pytest.mark.parametrize(("name", "text"), robots(), ids=lambda of: of if len(of) < 20 else "urdf")
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

    bodies = {joint.find("child").get("link"): joint.get("name") for joint in xml.fromstring(text).findall("joint")}
    hinges = nboom.parse(text, name, format="urdf").hinges
    return [model.joints[model.getJointId(bodies[hinge.body])].idx_v - 6 for hinge in hinges]
