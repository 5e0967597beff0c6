"""Tables: what is missing, and what is the same."""

import numpy as np
import pytest

import nboom


@pytest.fixture
def cubesat(examples):
    return nboom.load(examples / "cubesat.toml")


def test_a_run_has_its_columns(cubesat):
    run = cubesat.run(samples=3)
    assert "t" in run and "nothing" not in run
    assert list(run) == list(run.states)


def test_events_without_a_hinge_have_none(cubesat):
    events = cubesat.run().events
    last = events["kind"] == "end"
    assert last.any() and np.isnan(events["appendage"][last]).all() and np.isnan(events["segment"][last]).all()
    assert set(events["appendage"][~np.isnan(events["appendage"])]) == {1.0, 2.0, 3.0, 4.0}


def test_texts_that_are_all_missing_are_texts(examples):
    import pyarrow

    events = nboom.load(examples / "n-boom-1970.nml").run().events
    assert set(events["body"]) == {None}
    assert events.to_arrow().schema.field("body").type == pyarrow.string()


def test_tables_are_equal_if_their_numbers_are(cubesat):
    one, two = cubesat.run(samples=3), cubesat.run(samples=3)
    assert one.states == two.states and one.events == two.events
    assert one.states != cubesat.run(samples=4).states and one.states != one.events and one.states != 3


def test_events_say_what_their_columns_are(examples):
    events = nboom.load(examples / "mast.toml").run().events
    assert set(events.about) == set(events)
    assert events.units.keys() == {"t", "impulse", "energy_before", "energy_after"}
    assert "of a slide the impulsive force" in events.about["impulse"]
    description = events.to_arrow().schema.field("impulse").metadata[b"description"]
    assert description.decode() == events.about["impulse"]
