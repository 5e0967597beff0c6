"""Sweeps on a cluster of Dask: batches of cases go out and come back as bytes of the journal."""

from __future__ import annotations

import hashlib
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _nboom
from .errors import InputError, SimulationError

if TYPE_CHECKING:
    from distributed import Client, Future

__all__ = ["gather"]

#: Seconds that a batch should take: long beside what a task of Dask costs, short beside a sweep.
_BATCH = 1.0

#: Seconds from batch to batch that this process needs, which waits for the disk at each.
_INTERVAL = 0.02

#: Most cases of a batch.
_MOST_CASES = 50_000

#: Batches of a worker's thread that wait or run, so that it never waits itself.
_AHEAD = 2

#: How often the same batch may end with the death of its worker.
_MOST_DEATHS = 10

#: Study of a worker process, by the hash of its texts: the last one alone.
_known: dict[str, _nboom.Study] = {}
_lock = threading.Lock()

Maker = tuple[str, str, str]


def run_batch(texts: tuple[str, str], first: int, last: int) -> tuple[bytes, Maker, float]:
    """Runs consecutive cases on a worker; returns the batch, who made it and its seconds."""
    began = time.perf_counter()
    batch = _study(texts).run_batch(first, last)
    return batch, _nboom.maker(), time.perf_counter() - began


def _study(texts: tuple[str, str]) -> _nboom.Study:
    key = hashlib.sha256("\0".join(texts).encode()).hexdigest()
    with _lock:
        if key not in _known:
            with tempfile.TemporaryDirectory() as folder:
                for name, text in zip(("study.toml", "scene.toml"), texts, strict=True):
                    Path(folder, name).write_text(text, encoding="utf-8")
                study = _nboom.Study.load(str(Path(folder, "study.toml")), False)
            _known.clear()
            _known[key] = study
        return _known[key]


def own_maker() -> Maker:
    """What results of this process depend on."""
    return _nboom.maker()


def maker_of_worker() -> Maker | str:
    """What a worker's results depend on, or why it cannot have any."""
    try:
        from nboom import _nboom as of_worker
    except ImportError as error:
        return str(error)
    return of_worker.maker()


def gather(
    study: _nboom.Study,
    options: _nboom.SweepOptions,
    client: Client,
    strangers: str,
    tell: Callable[[int, int], None],
) -> _nboom.Ended:
    """Runs the cases of a study on the workers of a client."""
    if getattr(client, "asynchronous", False):
        raise TypeError("client: an asynchronous one found, Client(..., asynchronous=False) expected")
    gathering = study.gather(options)
    tell(*gathering.done())
    if gathering.missing():
        Dispatch(study, gathering, client, strangers, tell).run()
    return gathering.finish()


class Dispatch:
    """Hands out batches until no case is missing."""

    def __init__(
        self,
        study: _nboom.Study,
        gathering: _nboom.Gathering,
        client: Client,
        strangers: str,
        tell: Callable[[int, int], None],
    ) -> None:
        self.gathering = gathering
        self.client = client
        self.strangers = strangers
        self.tell = tell
        self.texts = study.texts()
        self.name = f"nboom-{study.name}"
        self.missing = deque(gathering.missing())
        self.running: dict[Future, tuple[int, int]] = {}
        self.deaths: dict[tuple[int, int], int] = {}
        self.size = 1
        self.number = 0
        self.known: set[str] = set()
        self.threads: dict[str, int] = {}

    def run(self) -> None:
        from distributed import CancelledError, as_completed
        from distributed.comm import CommClosedError

        completed = as_completed(with_results=False, raise_errors=False)
        try:
            self.look_at_workers()
            self.submit(completed)
            for future in completed:
                self.take(future)
                self.look_at_workers()
                self.submit(completed)
        except Exception as error:
            # Whatever a client without a scheduler fails with.
            if self.client.status == "running" and not isinstance(error, (CommClosedError, CancelledError)):
                raise
            done, cases = self.gathering.done()
            raise SimulationError(
                f"the cluster went away ({type(error).__name__}: {error}); {done} of {cases} cases are kept, "
                "and resume=True does the others"
            ) from error
        finally:
            if self.running and self.client.status == "running":
                self.client.cancel(list(self.running), force=True)

    def look_at_workers(self) -> None:
        """Notices workers that come and go."""
        workers: dict[str, int] = self.client.nthreads()
        new = [worker for worker in workers if worker not in self.known]
        if new:
            self.known.update(new)
            self.check(self.client.run(maker_of_worker, workers=new, on_error="ignore"), workers)
        self.threads = {worker: n for worker, n in self.threads.items() if worker in workers}

    def check(self, makers: dict[str, Any], workers: dict[str, int]) -> None:
        """Refuses strangers, or leaves them without work."""
        own = own_maker()
        for worker, maker in makers.items():
            # Pickles and messages make lists of tuples.
            is_own = not isinstance(maker, str) and tuple(maker) == own
            if is_own or (self.strangers == "accept" and not isinstance(maker, str)):
                self.threads[worker] = workers[worker]
            elif self.strangers == "refuse":
                told = maker if isinstance(maker, str) else "nboom " + ", ".join(maker)
                raise InputError(
                    f"worker {worker}: {told} found, nboom {', '.join(own)} expected; "
                    'strangers="apart" leaves it without work, strangers="accept" takes its last digits'
                )

    def submit(self, completed: Any) -> None:
        """Hands out as many batches as workers can have."""
        slots = _AHEAD * sum(self.threads.values())
        if not self.threads and self.missing and not self.running:
            raise InputError("client: no worker found that may run cases, one or more expected")
        while self.missing and len(self.running) < slots:
            first, last = self.missing.popleft()
            end = min(last, first + self.share(last - first + 1) - 1)
            if end < last:
                self.missing.appendleft((end + 1, last))
            self.number += 1
            future = self.client.submit(
                run_batch,
                self.texts,
                first,
                end,
                key=f"{self.name}-{id(self)}-{self.number}",
                workers=list(self.threads) if self.strangers == "apart" else None,
                pure=False,
            )
            self.running[future] = (first, end)
            completed.add(future)

    def share(self, of_range: int) -> int:
        """Cases of the next batch: fewer towards the end, so that all workers end together."""
        left = of_range + sum(last - first + 1 for first, last in self.missing)
        threads = max(sum(self.threads.values()), 1)
        return max(1, min(self.size, -(-left // (2 * threads))))

    def take(self, future: Future) -> None:
        """Adds a batch that came back; one whose worker died is handed out again."""
        from distributed.scheduler import KilledWorker

        cases = self.running.pop(future)
        error = future.exception()
        if isinstance(error, KilledWorker):
            self.deaths[cases] = self.deaths.get(cases, 0) + 1
            if self.deaths[cases] > _MOST_DEATHS:
                raise SimulationError(f"cases {cases[0]} to {cases[1]}: each worker that runs them dies") from error
            self.missing.appendleft(cases)
            return
        if error is not None:
            raise error
        batch, maker, seconds = future.result()
        self.gathering.add(batch, tuple(maker))
        per_case = max(seconds / (cases[1] - cases[0] + 1), 1e-9)
        target = max(_BATCH, _INTERVAL * sum(self.threads.values()))
        # The first batches are short, and say little about how long cases take.
        self.size = min(_MOST_CASES, 8 * self.size, max(int(target / per_case), self.size // 2, 1))
        self.tell(*self.gathering.done())
