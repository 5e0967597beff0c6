"""Sweeps: the bytes of the command, whatever comes in between."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import nboom

SAME = ["cases.parquet", "statistics.json", "study.json", "study.toml", "scene.toml"]


def same(a, b, files=SAME):
    return [name for name in files if (a / name).read_bytes() != (b / name).read_bytes()] == []


def test_a_sweep_has_the_bytes_of_the_command(few, tmp_path):
    sweep = nboom.sweep(few, tmp_path / "here", progress=False)
    command = [sys.executable, "-m", "nboom", "sweep", few, "-o", tmp_path / "there", "--quiet"]
    subprocess.run(command, check=True)
    assert same(tmp_path / "here", tmp_path / "there")
    assert sweep.cases.rows == 40 and list(sweep.cases["case"]) == list(range(1, 41))
    assert set(sweep.cases["status"]) == {"ok"}
    assert sweep.statistics and sweep.description["seed"] == 7
    assert sweep._repr_html_().startswith("<iframe")
    assert sweep.cases.to_arrow().num_rows == 40 and len(sweep.cases.to_pandas()) == 40
    again = nboom.read_sweep(tmp_path / "here")
    np.testing.assert_array_equal(again.cases["spring"], sweep.cases["spring"])


def test_threads_and_shards_do_not_matter(few, tmp_path):
    nboom.sweep(few, tmp_path / "one", jobs=1, report=False)
    nboom.sweep(few, tmp_path / "two", jobs=2, report=False)
    assert same(tmp_path / "one", tmp_path / "two")
    shards = [tmp_path / f"part-{i}" for i in (1, 2, 3)]
    for i, shard in enumerate(shards, 1):
        nboom.sweep(few, shard, shard=(i, 3))
    part = nboom.Sweep(shards[0])
    assert "shard 1/3 of 40 cases" in repr(part)
    with pytest.raises(nboom.InputError, match="the shard 1/3 found, a whole sweep expected"):
        _ = part.statistics
    nboom.merge(reversed(shards), tmp_path / "three", report=False)
    assert same(tmp_path / "one", tmp_path / "three")
    with pytest.raises(nboom.InputError, match="1/3"):
        nboom.merge(shards[1:], tmp_path / "four")
    with pytest.raises(nboom.InputError, match="shard"):
        nboom.sweep(few, tmp_path / "five", shard=(4, 3))
    with pytest.raises(nboom.InputError, match="CSV of the shard 1/3"):
        nboom.sweep(few, tmp_path / "six", shard=(1, 3), csv=True)


def test_a_case_is_the_run_of_its_row(few, tmp_path):
    sweep = nboom.sweep(few, tmp_path / "out", report=False)
    for case in (1, 17, 40):
        run = sweep.study.case(case).run()
        assert run["omega_x"][-1] == sweep.cases["final_omega_x"][case - 1]
    for wrong in (41, 0, -1):
        with pytest.raises(nboom.InputError, match=f"case: {wrong} found, a number from 1 to 40 expected"):
            nboom.study(few).case(wrong)


def test_progress_is_told(few, tmp_path):
    told = []
    nboom.sweep(few, tmp_path / "out", report=False, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (40, 40)
    assert [done for done, _ in told] == sorted(done for done, _ in told)


def test_what_ends_a_sweep_loses_no_batch(many, tmp_path):
    def stop(done, total):
        if done > 0:
            raise RuntimeError("enough")

    directory = tmp_path / "out"
    with pytest.raises(RuntimeError, match="enough"):
        nboom.sweep(many, directory, report=False, progress=stop)
    done = []
    with pytest.raises(nboom.InputError, match="resume"):
        nboom.sweep(many, directory, report=False)
    nboom.sweep(many, directory, report=False, resume=True, progress=lambda n, _: done.append(n))
    assert 0 < done[0] < 12_000
    nboom.sweep(many, tmp_path / "whole", report=False)
    assert same(directory, tmp_path / "whole")


def test_ctrl_c_ends_a_sweep_in_order(many, tmp_path):
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        nboom.sweep(many, tmp_path / "out", report=False)
    timer.cancel()
    assert time.monotonic() - began < 3
    assert nboom.sweep(many, tmp_path / "out", report=False, resume=True).cases.rows == 12_000


def test_ctrl_c_ends_a_run(examples):
    scene = nboom.load(examples / "wire-booms.toml")
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100_000):
            scene.run(rtol=1e-13, end_time=1e6, samples=10)
    timer.cancel()


def test_a_scene_that_is_deleted_is_not_missed(few, tmp_path, examples):
    own = tmp_path / "own.toml"
    own.write_text((examples / "cubesat.toml").read_text())
    few.write_text(few.read_text().replace(str(examples / "cubesat.toml"), "own.toml"))
    study = nboom.study(few)
    own.unlink()
    assert nboom.sweep(study, tmp_path / "out", report=False).cases.rows == 40
    with pytest.raises(nboom.InputError, match="own.toml"):
        nboom.study(few)


def test_files_outside_of_the_folder_are_included_if_they_may_be(few, tmp_path, examples):
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "parts.toml").write_text("[parameters]\nspare = 1.0\n")
    scene = (examples / "cubesat.toml").read_text()
    (inner / "own.toml").write_text('include = ["../parts.toml"]\n' + scene)
    few.write_text(few.read_text().replace(str(examples / "cubesat.toml"), str(inner / "own.toml")))
    with pytest.raises(nboom.InputError, match="parts.toml"):
        nboom.study(few)
    study = nboom.study(few, include_anywhere=True)
    assert nboom.sweep(study, tmp_path / "out", report=False).cases.rows == 40


def test_studies_and_directories_that_do_not_fit_are_refused(few, many, tmp_path):
    nboom.sweep(few, tmp_path / "out", report=False)
    with pytest.raises(nboom.InputError, match="another sweep found"):
        nboom.sweep(many, tmp_path / "out")
    with pytest.raises(nboom.InputError, match="no sweep found"):
        nboom.read_sweep(tmp_path)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(few.read_text().replace("draws", "drawss"))
    with pytest.raises(nboom.InputError, match=r"wrong.toml:\d+:\d+: .*did you mean `draws`"):
        nboom.study(wrong)
    scene = tmp_path / "out" / "scene.toml"
    scene.write_text(scene.read_text() + "\n")
    with pytest.raises(nboom.InputError, match="scene.toml"):
        nboom.study(tmp_path / "out" / "study.toml")


def test_an_array_of_slurm_makes_the_same(few, tmp_path, examples):
    """The script as Slurm starts it, without Slurm."""
    script = [shutil.which("bash"), examples / "cluster" / "sweep.slurm"]
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    for part in "123":
        environment = os.environ | {"PATH": path, "SLURM_ARRAY_TASK_ID": part}
        subprocess.run([*script, "run", few, tmp_path / "out", "3"], check=True, env=environment)
    environment = os.environ | {"PATH": path}
    subprocess.run([*script, "merge", few, tmp_path / "out", "3"], check=True, env=environment, stdout=subprocess.DEVNULL)
    nboom.sweep(few, tmp_path / "whole", report=False)
    assert same(tmp_path / "out", tmp_path / "whole")


def test_what_is_no_sweep_is_said_to_be_none(tmp_path):
    for directory in (tmp_path, tmp_path / "nowhere"):
        with pytest.raises(nboom.InputError) as read:
            nboom.read_sweep(directory)
        for look in (repr, lambda sweep: sweep.description, lambda sweep: sweep.report()):
            with pytest.raises(nboom.InputError) as caught:
                look(nboom.Sweep(directory))
            assert str(caught.value) == str(read.value)
