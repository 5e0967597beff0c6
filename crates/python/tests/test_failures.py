"""Runs that fail, and what is broken off."""

import copy
import pickle
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import nboom


@pytest.fixture
def cubesat(examples):
    return nboom.load(examples / "cubesat.toml")


def fails(scene):
    return scene.run(max_events=2)


def test_a_failure_goes_from_process_to_process(cubesat):
    with pytest.raises(nboom.SimulationError) as caught:
        fails(cubesat)
    caught.value.add_note("of the third try")
    for again in (pickle.loads(pickle.dumps(caught.value)), copy.copy(caught.value)):
        assert type(again) is nboom.SimulationError and str(again) == str(caught.value)
        assert again.run is None and again.__notes__ == ["of the third try"]
    with ProcessPoolExecutor(1) as processes:
        with pytest.raises(nboom.SimulationError, match="the 2 events"):
            processes.submit(fails, cubesat).result()
        assert processes.submit(len, [1]).result() == 1


def test_a_failed_run_shows_itself(cubesat):
    with pytest.raises(nboom.SimulationError) as caught:
        fails(cubesat)
    assert "not complete" in repr(caught.value.run)
    assert caught.value.run.report().startswith("<!")
    assert caught.value.run._repr_html_().startswith("<iframe")


def test_ctrl_c_ends_a_comparison(cubesat):
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        cubesat.verify(300_000)
    timer.cancel()
    assert time.monotonic() - began < 4


def test_ctrl_c_ends_the_wait_for_a_run_of_another_thread(cubesat):
    # Some seconds.
    simulator = cubesat.simulator(max_step=2e-6, end_time=4.0, samples=1)
    other = threading.Thread(target=simulator.run)
    other.start()
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        simulator.run()
    timer.cancel()
    # It would end at once if its run had.
    other.join(0.3)
    was_running = other.is_alive()
    other.join()
    assert was_running


def test_ctrl_c_ends_an_evaluation_of_a_large_scene():
    hinge = {"at": [1.0, 0.0, 0.0], "axis": "z"}
    body = {"mass": 1.0, "mass_centre": [0.5, 0.0, 0.0], "inertia": [0.1] * 3, "tip": [1.0, 0.0, 0.0], "hinge": hinge}
    bodies = [body | {"name": str(i)} | ({"on": str(i - 1)} if i > 0 else {}) for i in range(500)]
    mast = nboom.scene("mast", run={"end": 1.0}, main_body={"mass": 9.0, "inertia": [4.0, 3.0, 2.0]}, body=bodies)
    dynamics = mast.dynamics(path="generic", formulation="symmetric")
    zeros = np.zeros((500, 500))
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        # Some ten seconds.
        dynamics.accelerations(np.zeros((500, 3)), zeros, zeros)
    timer.cancel()
    assert time.monotonic() - began < 4
