"""What tests share."""

import os
import signal
import warnings
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def examples() -> Path:
    """The examples of the repository."""
    return Path(os.environ.get("NBOOM_EXAMPLES", ROOT / "examples"))


@pytest.fixture(autouse=True)
def interruptible():
    """A shell may start what it runs in the background with Ctrl-C ignored, which tests send themselves."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(autouse=True)
def quiet():
    """Decks of 1970 have warnings that no test is about."""
    import nboom

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", nboom.SceneWarning)
        yield


STUDY = """
scene = "{examples}/cubesat.toml"
name = "few"
seed = 7
draws = {draws}
results = ["lock_time of y panel 1", "final omega_x", "verdict.largest_impulse"]

[run]
rtol = {rtol}

[[vary]]
name = "spring"
path = "parameters.stiffness"
as = "factor"
normal = {{ mean = 1.0, deviation = 0.05 }}
"""


@pytest.fixture
def few(examples, tmp_path) -> Path:
    """A study of forty short runs."""
    path = tmp_path / "few.toml"
    path.write_text(STUDY.format(examples=examples, draws=40, rtol=1e-6))
    return path


@pytest.fixture
def many(examples, tmp_path) -> Path:
    """A study that lasts some seconds."""
    path = tmp_path / "many.toml"
    path.write_text(STUDY.format(examples=examples, draws=12_000, rtol=1e-9))
    return path
