"""Arguments as programs have them, warnings, and tables in other programs' hands."""

import copy
import csv
import pickle
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import ROOT

import nboom

ROBOT = ROOT / "tests" / "data" / "robots" / "gimbals.urdf"


@pytest.fixture
def satellite(examples):
    return nboom.load(examples / "n-boom-1970.nml")


@pytest.fixture
def cubesat(examples):
    return nboom.load(examples / "cubesat.toml")


def states(count, hinges=4):
    dice = np.random.default_rng(6)
    # Few digits, so that float32 has them all.
    return [np.round(8 * dice.normal(size=(count, size))) / 8 for size in (3, hinges, hinges)]


@pytest.mark.parametrize("kind", ["<f4", ">f4", ">f8", "f2", "longdouble"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_every_kind_of_real_number_is_taken(satellite, kind, order):
    dynamics, arguments = satellite.dynamics(), states(20)
    expected = np.concatenate(dynamics.accelerations(*arguments), axis=1)
    others = [np.array(numbers, dtype=kind, order=order) for numbers in arguments]
    np.testing.assert_array_equal(np.concatenate(dynamics.accelerations(*others), axis=1), expected)


def test_arguments_are_not_written_to_nor_kept(satellite):
    dynamics, arguments = satellite.dynamics(), states(100)
    before = copy.deepcopy(arguments)
    found = dynamics.accelerations(*arguments)
    for now, then in zip(arguments, before, strict=True):
        np.testing.assert_array_equal(now, then)
    kept = found[0].copy()
    dynamics.accelerations(*states(100))
    arguments[0][:] = 0.0
    np.testing.assert_array_equal(found[0], kept)
    assert not any(np.shares_memory(a, b) for a in found for b in arguments)


def test_no_states_have_no_accelerations(satellite):
    found = satellite.dynamics().accelerations(*states(0))
    assert [numbers.shape for numbers in found] == [(0, 3), (0, 3), (0, 4)]


def test_equations_in_bulk_are_those_of_each_state(satellite):
    dynamics, arguments = satellite.dynamics(path="generic", formulation="symmetric"), states(70)
    matrices, forcings = dynamics.equations(*arguments)
    assert matrices.shape == (70, 10, 10) and forcings.shape == (70, 10)
    for i in (0, 33, 69):
        matrix, forcing = dynamics.equations(*(numbers[i] for numbers in arguments))
        np.testing.assert_array_equal(matrix, matrices[i])
        np.testing.assert_array_equal(forcing, forcings[i])
    arguments[1][69, 3] = np.inf
    with pytest.raises(ValueError, match=r"beta\[69, 3\]: inf found, a finite number expected"):
        dynamics.equations(*arguments)


def test_threads_with_single_states_do_not_disturb_each_other(satellite):
    dynamics, arguments = satellite.dynamics(), states(2_000)
    each = list(zip(*arguments, strict=True))

    def one(state):
        return np.concatenate(dynamics.accelerations(*state))

    expected = [one(state) for state in each]
    with ThreadPoolExecutor(4) as threads:
        np.testing.assert_array_equal(list(threads.map(one, each)), expected)


def test_an_exception_of_an_argument_passes_through(satellite):
    class Stubborn:
        def __array__(self, dtype=None, copy=None):
            raise RuntimeError("not today")

    with pytest.raises(RuntimeError, match="not today"):
        satellite.dynamics().accelerations(Stubborn(), [0.0] * 4, [0.0] * 4)


@pytest.mark.skipif(not ROBOT.exists(), reason="there is no clone around the tests")
def test_a_robot_from_a_file_runs_and_survives_pickling():
    robot = nboom.load(ROBOT)
    assert [hinge.body for hinge in robot.hinges] == ["ring", "antenna", "arm", "wrist inner", "wrist outer", "hand"]
    assert 'base = "fixed"' not in robot.text
    assert 'base = "fixed"' in nboom.load(ROBOT, fixed_base=True).text
    assert 'base = "fixed"' in nboom.parse(ROBOT.read_text(), format="urdf", fixed_base=True).text
    again = pickle.loads(pickle.dumps(robot))
    for scene in (again, copy.deepcopy(robot)):
        assert np.asarray(scene.run(samples=5).states).tobytes() == np.asarray(robot.run(samples=5).states).tobytes()


@pytest.mark.parametrize("name", ["n-boom-1970.nml", "four-wings.nml"])
def test_a_deck_survives_pickling_as_it_is(examples, name):
    deck = nboom.load(examples / name)
    again = pickle.loads(pickle.dumps(deck))
    copies = [again, pickle.loads(pickle.dumps(again)), copy.copy(deck), copy.deepcopy(deck)]
    # Its integrator has settings in the deck.
    options = {"integrator": "rkam", "samples": 20, "end_time": 0.2}
    expected = deck.run(**options)
    for scene in copies:
        assert scene.name == deck.name and scene.hinges == deck.hinges and scene.text == deck.text
        assert scene.dynamics().hinges == deck.dynamics().hinges
        run = scene.run(**options)
        assert np.asarray(run.states).tobytes() == np.asarray(expected.states).tobytes()
        assert run.states.about == expected.states.about and run.events == expected.events


def test_a_deck_with_other_numbers_survives_pickling(satellite):
    path = "main_body.mass"
    heavier = satellite.with_values({path: 2.0 * satellite[path]})
    again = pickle.loads(pickle.dumps(heavier))
    assert again[path] == 2.0 * satellite[path] and again.hinges == heavier.hinges


def test_a_number_with_a_unit_is_refused_with_its_place(examples):
    text = (examples / "boom.toml").read_text()
    wrong = text.replace("mass = 120.0", 'mass = "120 kg"')
    line = text[: text.index("mass = 120.0")].count("\n") + 1
    with pytest.raises(nboom.InputError, match=rf"^boom:{line}:\d+: mass: found `kg`"):
        nboom.parse(wrong, "boom")


def test_poor_results_are_warned_of(examples):
    scene = nboom.load(examples / "boom.toml")
    with pytest.warns(nboom.TrustWarning, match="poor conservation"):
        nboom.load(examples / "n-boom-1970.nml").run(rtol=0.5, atol=0.5)
    with warnings.catch_warnings():
        warnings.simplefilter("error", nboom.TrustWarning)
        scene.run()


def test_events_have_the_hinges_of_the_file(cubesat, tmp_path):
    run = cubesat.run()
    with (run.save(tmp_path / "run") / "events.csv").open() as file:
        rows = list(csv.DictReader(file))
    for name in ("appendage", "segment"):
        np.testing.assert_array_equal([float(row[name] or "nan") for row in rows], run.events[name])
    bodies = dict(zip([hinge.label for hinge in cubesat.hinges], [hinge.body for hinge in cubesat.hinges]))
    labels = [f"{row['appendage']},{row['segment']}" for row in rows]
    assert [bodies.get(label) for label in labels] == list(run.events["body"])


def test_pandas_gets_the_motion_without_a_copy(cubesat):
    run = cubesat.run(samples=20)
    whole = np.asarray(run.states)
    assert np.shares_memory(run.states.to_pandas().to_numpy(), whole)
    assert not np.shares_memory(np.array(run.states), whole)


def test_writing_into_a_frame_of_pandas_leaves_the_run_as_it_is(cubesat):
    pytest.importorskip("pandas", minversion="3", reason="pandas copies on write from there on")
    run = cubesat.run(samples=20, columns="beta_1_1")
    for find in (lambda: run.states, lambda: run.output, lambda: run.events):
        before = copy.deepcopy(dict(find()))
        frame = find().to_pandas()
        frame.loc[:, "t"] = 7.0
        frame.iloc[0, 0] = 8.0
        frame[frame.columns[-1]] = 9.0
        assert list(frame["t"][:2]) == [8.0, 7.0]
        for name, column in before.items():
            np.testing.assert_array_equal(find()[name], column)
        assert list(find().to_pandas()["t"]) == list(before["t"])


def test_a_table_that_pandas_had_survives_pickling(cubesat):
    states = cubesat.run(samples=20).states
    states.to_pandas()
    assert len(pickle.dumps(states)) == len(pickle.dumps(cubesat.run(samples=20).states))
    assert pickle.loads(pickle.dumps(states)) == states


def test_missing_cells_are_nulls_in_arrow(cubesat):
    events = cubesat.run().events
    table = events.to_arrow()
    assert table.column("body").null_count == sum(body is None for body in events["body"]) > 0
    assert np.isnan(events["impulse"]).any()
    np.testing.assert_array_equal(table.column("impulse").to_numpy(), events["impulse"])


def test_names_are_escaped_in_notebooks(examples):
    text = (examples / "boom.toml").read_text()
    scene = nboom.parse(text.replace('name = "boom"', 'name = "<b>&"'), "boom")
    assert "<b>&<" not in scene._repr_html_() and "&lt;b&gt;&amp;" in scene._repr_html_()
    table = nboom.Table({"<i>": ["<script>"]})
    assert "<script>" not in table._repr_html_() and "<i>" not in table._repr_html_()
