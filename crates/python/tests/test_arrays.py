"""Arrays as numpy may have them: their numbers are those that Python sees."""

import numpy as np
import pytest

import nboom


@pytest.fixture
def dynamics(examples):
    return nboom.load(examples / "cubesat.toml").dynamics()


def omegas(count):
    return np.arange(3.0 * count).reshape(count, 3) / 10


def fields(count):
    """Those of records whose size is no multiple of eight bytes."""
    records = np.zeros(count, dtype=[("id", "i4"), ("omega", "f8", 3)])
    records["omega"] = omegas(count)
    return records["omega"]


def within_bytes(count):
    return np.frombuffer(b"\0" * 4 + omegas(count).tobytes(), offset=4).reshape(count, 3)


@pytest.mark.parametrize("make", [fields, within_bytes])
def test_numbers_anywhere_in_memory_are_read_as_they_are(dynamics, make):
    found = dynamics.accelerations(make(20), np.zeros((20, 4)), np.zeros((20, 4)))
    expected = dynamics.accelerations(omegas(20), np.zeros((20, 4)), np.zeros((20, 4)))
    for a, b in zip(found, expected, strict=True):
        np.testing.assert_array_equal(a, b)


def test_one_state_may_be_a_field(dynamics):
    records = np.zeros(3, dtype=[("omega", "f8"), ("id", "i4")])
    records["omega"] = [0.1, 0.2, 0.3]
    found = dynamics.accelerations(records["omega"], np.zeros(4), np.zeros(4))
    expected = dynamics.accelerations([0.1, 0.2, 0.3], np.zeros(4), np.zeros(4))
    np.testing.assert_array_equal(found[0], expected[0])


def test_classes_of_their_own_are_arrays_too(dynamics):
    class Own(np.ndarray):
        pass

    found = dynamics.accelerations(omegas(1)[0].view(Own), np.zeros(4), np.zeros(4))
    np.testing.assert_array_equal(found[0], dynamics.accelerations(omegas(1)[0], np.zeros(4), np.zeros(4))[0])


def test_masked_numbers_are_no_numbers(dynamics):
    masked = np.ma.array([0.1, 1e20, 0.3], mask=[False, True, False])
    with pytest.raises(TypeError, match="omega: a masked array found, an array of numpy without a mask expected"):
        dynamics.accelerations(masked, np.zeros(4), np.zeros(4))
