"""Runs: in memory, as in files, with options, when they fail."""

import csv
import json

import numpy as np
import pytest

import nboom


@pytest.fixture
def cubesat(examples):
    return nboom.load(examples / "cubesat.toml")


def rows(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_momentum_and_energy_are_those_of_physics(examples):
    run = nboom.load(examples / "n-boom-1970.nml").run(rtol=1e-11)
    momentum = np.array([run[f"angular_momentum_{axis}"] for axis in "xyz"])
    assert np.ptp(np.linalg.norm(momentum, axis=0)) < 1e-8 * np.linalg.norm(momentum[:, 0])
    assert run.summary["conservation"]["energy"] < 1e-8
    # What a latch takes out of the motion is lost for ever.
    latches = run.events["kind"] == "lock_up"
    assert latches.sum() == 4
    assert (run.events["energy_after"][latches] < run.events["energy_before"][latches]).all()


def test_memory_has_what_files_have(examples, tmp_path):
    run = nboom.load(examples / "solar-array.toml").run(samples=50)
    folder = run.save(tmp_path / "run", tables="parquet")
    states = rows(folder / "states.csv")
    assert list(states[0]) == list(run.states)
    for name, column in run.states.items():
        assert [float(row[name]) for row in states] == list(column), name
    events = rows(folder / "events.csv")
    for name in ("t", "impulse", "energy_before", "energy_after"):
        found = [float(row[name] or "nan") for row in events]
        np.testing.assert_array_equal(found, run.events[name])
    assert [row["kind"] for row in events] == list(run.events["kind"])
    written = json.loads((folder / "summary.json").read_text())
    for key in ("wall_seconds", "files"):
        written.pop(key, None)
    assert {key: run.summary[key] for key in written} == written
    assert (folder / "report.html").exists() and (folder / "states.parquet").exists()


def test_a_run_repeats_itself_to_the_last_bit(cubesat):
    simulator = cubesat.simulator(rtol=1e-8)
    first, second = (np.asarray(simulator.run().states) for _ in range(2))
    alone = np.asarray(nboom.parse(cubesat.text, cubesat.name).run(rtol=1e-8).states)
    assert first.tobytes() == second.tobytes() == alone.tobytes()


def test_options_are_those_of_the_command(cubesat):
    assert cubesat.run(samples=7).states.rows == 8
    times = [0.5, 1.0, np.float64(1.25)]
    assert set(times) <= set(cubesat.run(times=np.array(times))["t"])
    assert cubesat.run(end_time=0.75)["t"][-1] == 0.75
    assert cubesat.run(integrator="gauss_lanes").summary["integrator"] == "gauss_lanes"
    output = cubesat.run(columns=["beta_1_1", "nutation"], degrees=True).output
    assert list(output) == ["t", "beta_1_1_deg", "nutation_deg"]
    np.testing.assert_allclose(output["beta_1_1_deg"], np.degrees(cubesat.run()["beta_1_1"]))
    assert cubesat.run().output is None or "t" in cubesat.run().output


@pytest.mark.parametrize("options", [{}, {"samples": 5}, {"times": [0.0]}])
@pytest.mark.parametrize("name", ["cubesat.toml", "n-boom-1970.nml"])
def test_a_run_of_no_length_has_one_row(examples, tmp_path, name, options):
    run = nboom.load(examples / name).run(end_time=0.0, **options)
    assert list(run["t"]) == [0.0] and run.summary["samples"] == 0 and run.complete
    folder = run.save(tmp_path / "run", tables="parquet", plots="svg", listing=True)
    for table in ("states.csv", "ledger.csv"):
        assert len((folder / table).read_text().splitlines()) == 2
    assert (folder / "report.html").exists() and (folder / "plots").is_dir()


def test_options_that_there_are_not_are_refused(cubesat):
    with pytest.raises(TypeError, match="rtoll: no such option, did you mean rtol"):
        cubesat.run(rtoll=1e-9)
    with pytest.raises(nboom.InputError, match="^rtol: relative error -1e0 found, a number from"):
        cubesat.run(rtol=-1.0)
    with pytest.raises(nboom.InputError, match="integrator"):
        cubesat.run(integrator="euler")
    with pytest.raises(TypeError, match="run.save"):
        cubesat.run(output="here")
    with pytest.raises(TypeError, match="nboom.load"):
        cubesat.run(set="a=1")
    with pytest.raises(TypeError, match="samples: .* found"):
        cubesat.run(samples={})
    with pytest.raises(nboom.InputError, match="--columns"):
        cubesat.run(columns=["betta_1_1"])


def test_a_run_that_fails_keeps_what_it_found(cubesat):
    with pytest.raises(nboom.SimulationError, match="the 2 events") as caught:
        cubesat.run(max_events=2)
    run = caught.value.run
    assert isinstance(run, nboom.Run) and not run.complete
    assert run.states.rows > 1 and not run.summary["complete"]


def test_a_directory_that_is_not_ours_is_refused(cubesat, tmp_path):
    (tmp_path / "states.csv").write_text("mine")
    with pytest.raises(nboom.InputError, match="states.csv"):
        cubesat.run().save(tmp_path)
    assert (tmp_path / "states.csv").read_text() == "mine"


def test_columns_are_views_of_one_array(cubesat):
    run = cubesat.run()
    whole = np.asarray(run.states)
    assert all(np.shares_memory(column, whole) for column in run.states.values())
    assert np.shares_memory(run["beta_1_1"], run.states["beta_1_1"])
    frame = run.states.to_pandas()
    assert list(frame.columns) == list(run.states)
    assert frame["omega_x"].to_numpy().tolist() == run["omega_x"].tolist()


def test_tables_go_to_arrow_with_units(cubesat):
    table = cubesat.run().states.to_arrow()
    note = table.schema.field("omega_x").metadata
    assert note[b"unit"] == b"rad/s" and note[b"description"]
    events = cubesat.run().events.to_arrow()
    assert events.column("kind").to_pylist()[-1] == "end"
    assert events.column("body").null_count > 0


def test_results_show_themselves(cubesat):
    run = cubesat.run(samples=20)
    assert run._repr_html_().startswith("<iframe srcdoc=")
    assert "<table>" in run.states._repr_html_() and "…" in run.states._repr_html_()
    with pytest.raises(KeyError, match="no such column"):
        run["betta"]


def test_stresses_are_in_the_summary(examples):
    run = nboom.load(examples / "n-boom-1970.nml").run()
    assert run.summary["verdict"]["worst_load"] > 0
    without = nboom.load(examples / "n-boom-1970.nml").run(no_stresses=True)
    assert without.summary["verdict"]["worst_load"] is None
