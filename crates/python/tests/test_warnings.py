"""Warnings of runs that are saved, of studies and of sweeps: those of Python, and nothing on standard error."""

import warnings

import pytest

import nboom


@pytest.fixture
def said():
    """All warnings, whatever other tests ignore."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield lambda: [(warning.category, str(warning.message)) for warning in caught]


def changed(few, *pairs):
    text = few.read_text()
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    few.write_text(text)
    return few


@pytest.fixture
def poor(few, examples):
    """A study of runs that are too inaccurate."""
    return changed(
        few,
        (f"{examples}/cubesat.toml", f"{examples}/n-boom-1970.nml"),
        ("parameters.stiffness", "main_body.mass"),
        (few.read_text().splitlines()[5], 'results = ["final omega_x"]'),
        ("rtol = 1e-06", "rtol = 0.5\natol = 0.5"),
    )


def test_a_study_warns_of_its_scene(few, tmp_path, examples, said, capfd):
    (tmp_path / "own.toml").write_text((examples / "cubesat.toml").read_text().replace("end = 5.0", "end = 1.5"))
    changed(few, (f"{examples}/cubesat.toml", "own.toml"))
    nboom.study(few)
    assert {category for category, _ in said()} == {nboom.SceneWarning}
    assert all("after the end of the run" in text for _, text in said())
    assert capfd.readouterr().err == ""


def test_a_formulation_that_does_not_cover_the_scene_is_ignored_aloud(few, tmp_path, examples, said, capfd):
    why = "formulation report (formulation report does not cover hinge 1,2"
    run = nboom.load(examples / "nasa-ats.toml").run(formulation="report")
    assert [text.startswith(f"ignored: --{why}") for _, text in said()].count(True) == 1
    run.save(tmp_path / "run")
    assert [text.startswith(f"ignored: --{why}") for _, text in said()].count(True) == 1
    changed(
        few,
        ("cubesat.toml", "nasa-ats.toml"),
        ("parameters.stiffness", "main_body.mass"),
        (few.read_text().splitlines()[5], 'results = ["final omega_x"]'),
        ("rtol = 1e-06", 'formulation = "report"'),
    )
    before = len(said())
    nboom.sweep(few, tmp_path / "out", progress=False, report=False)
    assert [text.startswith(f"ignored in case 1: {why}") for _, text in said()[before:]].count(True) == 1
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("shard", [None, (1, 1)])
def test_a_sweep_warns_of_poor_cases(poor, tmp_path, said, capfd, shard):
    nboom.sweep(poor, tmp_path / "out", shard=shard, progress=False, report=False)
    told = [text for category, text in said() if category is nboom.TrustWarning]
    assert len(told) == 1 and told[0].startswith("poor conservation in 40 of 40 cases")
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("shard", [None, (1, 1)])
def test_a_sweep_warns_of_cases_without_a_run(few, tmp_path, said, capfd, shard):
    one = "normal = { mean = 1.0, deviation = 0.05 }"
    changed(few, ("parameters.stiffness", "main_body.mass"), (one, "uniform = { from = -1.0, to = 1.0 }"))
    nboom.sweep(few, tmp_path / "out", shard=shard, progress=False, report=False)
    assert any("of 40 cases rejected" in text for _, text in said())
    assert capfd.readouterr().err == ""


def test_parts_that_are_put_together_warn(poor, tmp_path, said, capfd):
    shards = [nboom.sweep(poor, tmp_path / f"part-{i}", shard=(i, 2), progress=False).directory for i in (1, 2)]
    before = len(said())
    nboom.merge(shards, tmp_path / "out", report=False)
    assert ["poor conservation" in text for _, text in said()[before:]] == [True]
    assert capfd.readouterr().err == ""


def test_saving_warns_of_what_the_run_did_not(examples, tmp_path, said, capfd):
    run = nboom.load(examples / "n-boom-1970.nml").run(rtol=1e-8)
    before = len(said())
    run.save(tmp_path / "same")
    assert said()[before:] == []
    run.save(tmp_path / "poor", rtol=0.5, atol=0.5)
    assert nboom.TrustWarning in [category for category, _ in said()[before:]]
    assert capfd.readouterr().err == ""


def test_saving_warns_of_the_scene_as_its_options_make_it(examples, tmp_path, said):
    run = nboom.load(examples / "cubesat.toml").run(samples=3)
    before = len(said())
    run.save(tmp_path / "short", end_time=0.5)
    assert nboom.SceneWarning in [category for category, _ in said()[before:]]


def test_a_page_repeats_no_warning(examples, said, capfd):
    run = nboom.load(examples / "n-boom-1970.nml").run(rtol=0.5, atol=0.5)
    before = len(said())
    assert before > 0 and run.report().startswith("<!")
    assert said()[before:] == [] and capfd.readouterr().err == ""
