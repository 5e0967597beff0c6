"""Sweeps on two local workers of Dask."""

import os
import signal

import pytest

import nboom
from nboom import cluster

distributed = pytest.importorskip("distributed")

FILES = ["cases.parquet", "statistics.json", "study.json", "study.toml", "scene.toml"]


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers,
        distributed.Client(workers) as client,
    ):
        yield client


def same(a, b):
    return [name for name in FILES if (a / name).read_bytes() != (b / name).read_bytes()] == []


def test_a_worker_that_is_killed_costs_only_time(client, many, tmp_path):
    killed = []

    def kill(done, total):
        if not killed and done > total / 4:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    nboom.sweep(many, tmp_path / "cluster", client=client, report=False, progress=kill)
    nboom.sweep(many, tmp_path / "threads", report=False)
    assert killed and same(tmp_path / "cluster", tmp_path / "threads")


def test_what_ends_it_loses_no_batch(client, many, tmp_path):
    def stop(done, total):
        if done > total / 4:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        nboom.sweep(many, tmp_path / "cluster", client=client, report=False, progress=stop)
    began = []
    nboom.sweep(
        many, tmp_path / "cluster", client=client, report=False, resume=True, progress=lambda n, _: began.append(n)
    )
    assert began[0] > 3_000
    nboom.sweep(many, tmp_path / "threads", report=False)
    assert same(tmp_path / "cluster", tmp_path / "threads")


def test_strangers_are_named_and_refused_or_kept_apart(client, few, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "own_maker", lambda: ("0.0", "abacus", "stone"))
    with pytest.raises(nboom.InputError, match="worker tcp.*found, nboom 0.0, abacus, stone expected"):
        nboom.sweep(few, tmp_path / "out", client=client, report=False)
    with pytest.raises(nboom.InputError, match="no worker found that may run cases"):
        nboom.sweep(few, tmp_path / "apart", client=client, strangers="apart", report=False)
    accepted = nboom.sweep(few, tmp_path / "accepted", client=client, strangers="accept", report=False)
    assert accepted.cases.rows == 40


def test_what_a_cluster_cannot_have_is_refused(client, few, tmp_path):
    with pytest.raises(TypeError, match="shard and jobs"):
        nboom.sweep(few, tmp_path / "out", client=client, jobs=2)
    with pytest.raises(ValueError, match="strangers: `perhaps` found"):
        nboom.sweep(few, tmp_path / "out", client=client, strangers="perhaps")


def test_a_client_that_goes_away_leaves_what_was_done(many, tmp_path):
    workers = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)
    client = distributed.Client(workers)

    def close(done, total):
        if done > total / 10:
            workers.close()

    with pytest.raises(nboom.SimulationError, match="the cluster went away.*resume=True"):
        nboom.sweep(many, tmp_path / "out", client=client, report=False, progress=close)
    client.close()
    assert nboom.sweep(many, tmp_path / "out", resume=True, report=False).cases.rows == 12_000
