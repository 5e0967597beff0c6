"""Runs that fail, and what is broken off."""

import copy
import pickle
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor

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
        with pytest.raises(nboom.SimulationError, match="2 events within"):
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
