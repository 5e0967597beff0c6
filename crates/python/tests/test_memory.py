"""Results that memory has no room for: Python hears it, and goes on."""

import subprocess
import sys

import pytest

# Rust would end the process, so it is one of its own.
PROGRAM = """
import resource
import numpy as np
import nboom

scene = nboom.load({scene!r})
dynamics = scene.dynamics()

def states(count):
    return [np.broadcast_to(np.zeros(size), (count, size)) for size in (3, 4, 4)]

{before}
pages = int(open("/proc/self/statm").read().split()[0])
most = pages * resource.getpagesize() + 2**30
resource.setrlimit(resource.RLIMIT_AS, (most, most))
try:
    {call}
except MemoryError as error:
    print(error)
assert scene.run(samples=3).states.rows == 4
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the size of the process is in /proc")
@pytest.mark.parametrize(
    ("before", "call", "shape"),
    [
        ("arguments = states(10**8)", "dynamics.accelerations(*arguments)", "(100000000, 3)"),
        ("arguments = states(10**17)", "dynamics.accelerations(*arguments)", "(100000000000000000, 3)"),
        # There is room for the arguments.
        (
            "arguments = [np.zeros((2_000_000, size)) for size in (3, 4, 4)]",
            "dynamics.equations(*arguments)",
            "(2000000, 10, 10)",
        ),
        ("", "scene.run(samples=10_000_000)", "(10000001, "),
        ("", "scene.run(samples=5_000_000, columns='omega')", "(5000001, "),
    ],
)
def test_results_that_are_too_large_are_told(examples, before, call, shape):
    program = PROGRAM.format(scene=str(examples / "cubesat.toml"), before=before, call=call)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(f"an array of shape {shape}")
    assert done.stdout.endswith(" found, one that fits into memory expected\n")
