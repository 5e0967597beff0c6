"""What Python costs beside Rust: evaluations, runs, sweeps, a cluster on this machine.

Prints a table in Markdown. Figures that are compared are taken in turns in one process tree; of each the shortest
counts. Needs the package, and distributed; run it where nothing else runs: python benches/python.py
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np

import nboom
from nboom import _nboom, cluster

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"

STUDY = """
scene = "{scene}"
draws = {draws}
results = ["lock_time of 1,1", "lock_time of 1,2", "verdict.largest_impulse", "final nutation"]
[run]
stresses = false
[[vary]]
path = "initial.rate_deg[1]"
as = "factor"
normal = {{ mean = 1.0, deviation = 0.02 }}
[[vary]]
path = "main_body.mass"
as = "factor"
uniform = {{ from = 0.9, to = 1.1 }}
"""


def row(what: str, figure: str) -> None:
    print(f"| {what} | {figure} |", flush=True)


def seconds(work, least=0.2) -> float:
    """Of one call, the shortest sample."""
    work()
    began, calls = time.perf_counter(), 0
    while time.perf_counter() - began < least:
        work()
        calls += 1
    return (time.perf_counter() - began) / calls


def kernels(scene: Path) -> dict[str, float]:
    """Nanoseconds of an evaluation as the command times it, by code."""
    command = [sys.executable, "-m", "nboom", "bench", scene, "--harness", "--seconds", "0.2"]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    return {line.split()[0]: float(line.split()[3]) for line in lines}


def evaluations() -> None:
    for name in ("n-boom-1970.nml", "solar-array.toml"):
        scene = nboom.load(EXAMPLES / name)
        for path, kernel in (("auto", "nboom_generated_articulated"), ("generic", "nboom_generic_recursive")):
            dynamics = scene.dynamics(path=path)
            n, dice = len(dynamics.hinges), np.random.default_rng(1)
            one = dice.normal(size=3), dice.normal(size=n), dice.normal(size=n)
            many = [np.tile(array, (4096, 1)) for array in one]
            rust, single, bulk = [], [], []
            for _ in range(5):
                rust.append(kernels(EXAMPLES / name))
                single.append(1e9 * seconds(lambda: dynamics.accelerations(*one)))
                bulk.append(1e9 * seconds(lambda: dynamics.accelerations(*many)) / 4096)
            of_rust = min(found.get(kernel, np.nan) for found in rust)
            lanes = min(found.get(f"{kernel}_lanes8", np.nan) for found in rust)
            row(
                f"{name}, {dynamics.path}: kernel, eight at once; single call, bulk [ns]",
                f"{of_rust:.0f}, {lanes:.0f}; {min(single):.0f}, {min(bulk):.0f}",
            )


def runs() -> None:
    for name, options in (("n-boom-1970.nml", {"no_stresses": True}), ("n-boom-1970.nml", {}), ("cubesat.toml", {})):
        simulator = nboom.load(EXAMPLES / name).simulator(**options)
        inside, whole = [], []
        for _ in range(2000):
            began = time.perf_counter()
            run = simulator.run()
            whole.append(time.perf_counter() - began)
            inside.append(run._inner.seconds)
        a, b = np.median(inside), np.median(whole)
        row(f"{name} {options or ''}: a run in Rust, as Python sees it [µs]", f"{1e6 * a:.1f}, {1e6 * b:.1f}: {b / a:.3f}")


def sweeps(folder: Path, draws: int) -> None:
    from distributed import Client, LocalCluster

    study = folder / "study.toml"
    study.write_text(STUDY.format(scene=EXAMPLES / "n-boom-1970.nml", draws=draws))
    one = nboom.study(study)
    times: dict[str, list[float]] = {"command": [], "Python": [], "Dask": []}
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers,
        Client(workers) as client,
    ):
        client.run(cluster.maker_of_worker)
        for turn in range(3):
            place = folder / str(turn)
            command = [sys.executable, "-m", "nboom", "sweep", study, "--quiet", "--no-report", "-o", place / "command"]
            ways = {
                "command": lambda command=command: subprocess.run(command, check=True),
                "Python": lambda place=place: nboom.sweep(study, place / "Python", report=False, progress=False),
                "Dask": lambda place=place: nboom.sweep(
                    study, place / "Dask", client=client, report=False, progress=False
                ),
            }
            for way, work in ways.items():
                began = time.perf_counter()
                work()
                times[way].append(time.perf_counter() - began)
                assert (place / way / "cases.parquet").read_bytes() == (place / "command" / "cases.parquet").read_bytes()
    best = {way: min(of) for way, of in times.items()}
    told = ", ".join(f"{way} {of:.2f}" for way, of in best.items())
    row(f"{draws} cases in two threads or on two workers [s]", told)
    row("Python over command; two workers over two threads", f"{best['Python'] / best['command']:.3f}; {best['Dask'] / best['Python']:.3f}")
    parts(one, folder, draws)


def parts(study: nboom.Study, folder: Path, draws: int) -> None:
    """What a case costs where it runs, where it is gathered, and on the disk."""
    count = min(draws, 10_000)
    batch, maker, of_cases = cluster.run_batch(study._inner.texts(), 1, count)
    row("a case on a worker [µs]; its bytes in the journal", f"{1e6 * of_cases / count:.0f}; {len(batch) / count:.0f}")
    options = _nboom.SweepOptions(os.fspath(folder / "parts"), False, False, False)
    gathering = study._inner.gather(options)
    began = time.perf_counter()
    gathering.add(batch, maker)
    row(f"a batch of {count} cases is added and safe on the disk [ms]", f"{1e3 * (time.perf_counter() - began):.1f}")
    for first, last in gathering.missing():
        for begin in range(first, last + 1, count):
            end = min(begin + count - 1, last)
            gathering.add(cluster.run_batch(study._inner.texts(), begin, end)[0], maker)
    began = time.perf_counter()
    gathering.finish()
    of_tables = (time.perf_counter() - began) / draws
    size = (folder / "parts" / "cases.parquet").stat().st_size
    row("a case in tables and statistics [µs]; its bytes in Parquet", f"{1e6 * of_tables:.2f}; {size / draws:.1f}")


def tasks() -> None:
    """What a task costs the scheduler and the client."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers,
        Client(workers) as client,
    ):
        client.gather(client.map(abs, range(10)))
        began = time.perf_counter()
        client.gather(client.map(abs, range(1000, 4000), pure=False))
        row("a task of Dask that does nothing [ms]", f"{1e3 * (time.perf_counter() - began) / 3000:.2f}")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--draws", type=int, default=100_000)
    draws = arguments.parse_args().draws
    warnings.simplefilter("ignore")
    print(f"nboom {', '.join(_nboom.maker())}\n\n| what | figure |\n| --- | --- |")
    folder = Path(tempfile.mkdtemp())
    try:
        evaluations()
        runs()
        sweeps(folder, draws)
        tasks()
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
