"""Options and numbers that are easily confused or refused without a word."""

import os
import shutil
import warnings
from pathlib import Path

import numpy as np
import pytest

import nboom


@pytest.fixture
def boom(examples):
    return nboom.load(examples / "boom.toml")


@pytest.mark.parametrize("count", [3, 2_000])
def test_other_times_are_other_runs(boom, count):
    first = np.linspace(0.0, 2.0, count)
    second = first.copy()
    second[count // 2] += 1e-10 if count < 10 else 1e-4
    for times in (first, second):
        np.testing.assert_array_equal(boom.run(times=times, end_time=2.0)["t"], times)


def test_warnings_name_the_line_that_called(examples, boom):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        deck = nboom.load(examples / "n-boom-1970.nml")
        deck.run(rtol=0.5, atol=0.5)
    assert {warning.category for warning in said} == {nboom.SceneWarning, nboom.TrustWarning}
    assert {warning.filename for warning in said} == {__file__}


def test_no_times_are_refused_by_name(boom):
    with pytest.raises(nboom.InputError, match="times"):
        boom.run(times=[])


def test_options_of_files_do_nothing_for_dynamics_and_are_refused(boom):
    with pytest.raises(TypeError, match="output"):
        boom.dynamics(output="here")


def test_negative_numbers_are_refused_with_what_was_found(few, tmp_path, boom):
    with pytest.raises(ValueError, match="jobs: -1 found"):
        nboom.sweep(few, tmp_path / "out", jobs=-1, report=False)
    with pytest.raises(nboom.InputError, match="case: -1 found, a number from 1 to 40 expected"):
        nboom.study(few).case(-1)
    with pytest.raises(ValueError, match="seed: -1 found"):
        boom.verify(states=5, seed=-1)


def test_a_wrong_word_for_strangers_is_refused_without_a_cluster_too(few, tmp_path):
    with pytest.raises(ValueError, match="strangers: `perhaps` found"):
        nboom.sweep(few, tmp_path / "out", strangers="perhaps", report=False)


def test_numpy_hears_that_a_copy_is_needed(boom):
    with pytest.raises(ValueError, match="copy"):
        np.array(boom.run().states, dtype=np.float32, copy=False)


def test_paths_may_have_any_bytes_and_texts_are_unicode(boom, tmp_path):
    folder = os.fsencode(tmp_path) + b"/sv\xff"
    for path in (folder, os.fsdecode(folder), Path(os.fsdecode(folder))):
        assert os.fsencode(boom.run().save(path)) == folder
        assert {b"states.csv", b"report.html"} <= set(os.listdir(folder))
        shutil.rmtree(folder)
    with pytest.raises(nboom.InputError, match=r"^columns: 'beta\\udcff' found, a text in UTF-8 expected"):
        boom.run(columns=["beta\udcff"])


def test_truth_values_in_lists_are_no_numbers(boom):
    for wrong in (True, np.True_):
        with pytest.raises(TypeError, match="^times: .*True.* found in a list, a text or a number expected"):
            boom.run(times=[wrong])
