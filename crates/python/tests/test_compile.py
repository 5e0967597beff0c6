"""Routines that are compiled for a scene on the spot, where cargo is."""

import shutil

import numpy as np
import pytest

import nboom


@pytest.mark.skipif(shutil.which("cargo") is None, reason="there is no cargo")
def test_a_scene_runs_by_routines_of_its_own(examples, tmp_path):
    scene = nboom.load(examples / "boom.toml")
    own = scene.compile(work=tmp_path, offline=True)
    dynamics = own.dynamics(path="generated")
    assert dynamics.path == "generated"
    dice = np.random.default_rng(3)
    state = dice.normal(size=(20, 3)), dice.normal(size=(20, 1)), dice.normal(size=(20, 1))
    found = np.concatenate(dynamics.accelerations(*state), axis=1)
    expected = np.concatenate(scene.dynamics(path="generic").accelerations(*state), axis=1)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    run, before = own.run(rtol=1e-10), scene.run(rtol=1e-10, path="generic")
    assert run.summary["path"] == "generated"
    np.testing.assert_allclose(run["omega_x"], before["omega_x"], atol=1e-8)


def test_without_cargo_it_says_so(examples, tmp_path, monkeypatch):
    monkeypatch.setenv("CARGO", str(tmp_path / "nothing"))
    with pytest.raises(nboom.SimulationError, match="cannot start .*nothing"):
        nboom.load(examples / "boom.toml").compile(work=tmp_path)
    with pytest.raises(nboom.InputError, match="formulation: `euler` found, one of report"):
        nboom.load(examples / "boom.toml").compile(formulation="euler")
