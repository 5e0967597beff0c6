"""Studies, and sweeps of all their cases."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _nboom
from .checks import path_text, whole
from .errors import InputError, SimulationError
from .progress import shown
from .run import framed
from .scene import Scene, Simulator
from .tables import Table

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["Study", "Sweep", "merge", "read_sweep", "study", "sweep"]


class Study:
    """What varies in a scene, how, and what is wanted of each run; checked.

    Attributes
    ----------
    name, method, seed, cases
        As the file says them; ``cases`` is how many there are.
    """

    def __init__(self, inner: _nboom.Study) -> None:
        self._inner = inner

    name: str = property(lambda self: self._inner.name)  # type: ignore[assignment]
    method: str = property(lambda self: self._inner.method)  # type: ignore[assignment]
    seed: int = property(lambda self: self._inner.seed)  # type: ignore[assignment]
    cases: int = property(lambda self: self._inner.cases)  # type: ignore[assignment]

    def case(self, number: int) -> Simulator:
        """The run of one case, from 1, with its faults: the numbers of its row to the last bit.

        Raises
        ------
        InputError
            If there is no such case, or its numbers make no scene.
        """
        scene, options = self._inner.case(whole("case", number, 1, self.cases))
        return Simulator(Scene(scene), dict(options))

    def __repr__(self) -> str:
        return repr(self._inner)


class Sweep:
    """A finished sweep.

    Attributes
    ----------
    directory : Path
        Where its files are.
    """

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = Path(path_text("directory", directory))
        self._cases: Table | None = None

    @property
    def cases(self) -> Table:
        """A row for each case: ``case``, ``seed``, variables, results, ``status``."""
        if self._cases is None:
            columns = _nboom.cases(os.fspath(self.directory))
            self._cases = Table(
                {name: cells for name, _, _, cells in columns},
                {name: unit for name, unit, _, _ in columns if unit is not None},
                {name: about for name, _, about, _ in columns},
            )
        return self._cases

    @property
    def statistics(self) -> dict[str, Any]:
        """What statistics.json says: percentiles with confidence, drivers, chances of latches."""
        return json.loads(self._text("statistics.json"))

    @property
    def description(self) -> dict[str, Any]:
        """What study.json says: version, instruction set, seed, method, counts."""
        try:
            text = (self.directory / "study.json").read_text(encoding="utf-8")
        except (FileNotFoundError, NotADirectoryError):
            # As `cases` says it.
            raise InputError(f"{self.directory}: no sweep found") from None
        return json.loads(text)

    @property
    def study(self) -> Study:
        """The study, as it lies beside the results."""
        return study(self.directory / "study.toml")

    def report(self) -> str:
        """The page of the sweep: HTML that needs no network."""
        return self._text("report.html")

    def _text(self, name: str) -> str:
        """A file of the directory, which a shard and a sweep without report do not have."""
        path = self.directory / name
        if not path.exists():
            shard = self.description.get("shard")
            told = f"the shard {shard} found, a whole sweep" if shard else "no such file found, one"
            raise InputError(f"{path}: {told} expected")
        return path.read_text(encoding="utf-8")

    def __repr__(self) -> str:
        of = self.description
        part = f"shard {of['shard']} of " if "shard" in of else ""
        return f"<nboom.Sweep {of['name']}: {part}{of['cases']} cases in {self.directory}>"

    def _repr_html_(self) -> str | None:
        page = self.directory / "report.html"
        return framed(self.report()) if page.exists() else None


def study(path: str | os.PathLike[str], include_anywhere: bool = False) -> Study:
    """Reads a study ``NAME.toml`` and the scene that it varies.

    Parameters
    ----------
    path : path
        The file.
    include_anywhere : bool, optional
        Let the scene include files outside of its folder.

    Raises
    ------
    InputError
        With file, line, key, what was found and expected, of all that is wrong.
    """
    inner = _nboom.Study.load(path_text("path", path), include_anywhere)
    inner.warn()
    return Study(inner)


def sweep(
    study: Study | str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    *,
    client: Client | None = None,
    jobs: int | None = None,
    shard: tuple[int, int] | None = None,
    resume: bool = False,
    csv: bool = False,
    accept_difference: bool = False,
    strangers: Literal["refuse", "apart", "accept"] = "refuse",
    report: bool = True,
    progress: bool | Callable[[int, int], None] | None = None,
) -> Sweep:
    """Runs all cases of a study: the same bytes as ``nboom sweep`` makes, wherever they run.

    Parameters
    ----------
    study : Study or path
        What is swept.
    output : path, optional
        Directory for the results, by default out/ and the study's name.
    client : distributed.Client, optional
        A cluster of Dask that runs the cases; by default threads of this process do. Only this process needs
        the directory.
    jobs : int, optional
        Threads, by default as many as there are processors.
    shard : (i, n), optional
        Run the i-th of n parts, from 1; :func:`merge` puts parts together. The directory then has no tables.
    resume : bool
        Go on with a sweep that was not finished, or that has fewer draws by Monte Carlo or Sobol; in a directory
        without one, start.
    csv : bool
        Write tables in CSV too.
    accept_difference : bool
        Go on with a sweep that another version or instruction set began.
    strangers : {"refuse", "apart", "accept"}
        What to do with workers of another version, instruction set or platform, whose last digits may
        differ: raise an error that names them, leave them without work, or let them work.
    report : bool
        Make report.html, and run the worst cases again for pages of their own.
    progress : bool or function, optional
        Whether to show how far the sweep is; a function gets how many of how many cases are done. By default
        it is shown on terminals and in notebooks.

    Raises
    ------
    InputError
        If study or directory is refused.
    SimulationError
        If the sweep cannot be finished. What is done stays; ``resume=True`` goes on.
    KeyboardInterrupt
        Likewise.
    """
    if strangers not in ("refuse", "apart", "accept"):
        raise ValueError(f"strangers: `{strangers}` found, refuse, apart or accept expected")
    threads = None if jobs is None else whole("jobs", jobs, 1, 65535)
    part = None if shard is None else _part(shard)
    what = study if isinstance(study, Study) else globals()["study"](study)
    directory = Path("out", what.name) if output is None else Path(path_text("output", output))
    options = _nboom.SweepOptions(os.fspath(directory), resume, csv, accept_difference or strangers == "accept")
    bar = shown(progress, what.name)
    try:
        if client is None:
            ended = what._inner.run(options, threads, part, bar)
        elif shard is not None or jobs is not None:
            raise TypeError("shard and jobs found, neither of them expected with a client")
        else:
            from .cluster import gather

            ended = gather(what._inner, options, client, strangers, bar)
    finally:
        bar.close()
    if not ended.complete:
        raise SimulationError(f"{directory}: the sweep is not finished; resume=True goes on")
    ended.finish(report)
    return Sweep(directory)


def _part(shard: tuple[int, int]) -> tuple[int, int]:
    """Which of how many parts."""
    if not isinstance(shard, (tuple, list)) or len(shard) != 2:
        raise TypeError(f"shard: {shard!r} found, two whole numbers expected")
    parts = whole("shard", shard[1], 1, 2**63 - 1)
    return whole("shard", shard[0], 1, parts), parts


def merge(
    shards: Sequence[str | os.PathLike[str]],
    output: str | os.PathLike[str],
    *,
    csv: bool = False,
    accept_difference: bool = False,
    report: bool = True,
) -> Sweep:
    """Puts the directories of all shards of a sweep together: the same bytes as one sweep.

    Raises
    ------
    InputError
        If one is no finished shard of the same sweep, or not each shard is there once.
    """
    if isinstance(shards, (str, bytes, os.PathLike)):
        raise TypeError(f"shards: {shards!r} found, a list of directories expected")
    parts = [path_text("shards", shard) for shard in shards]
    ended = _nboom.merge(parts, path_text("output", output), csv, accept_difference)
    ended.finish(report)
    return Sweep(output)


def read_sweep(directory: str | os.PathLike[str]) -> Sweep:
    """A finished sweep that is on the disk.

    Raises
    ------
    InputError
        If there is none.
    """
    found = Sweep(directory)
    _ = found.cases
    return found
