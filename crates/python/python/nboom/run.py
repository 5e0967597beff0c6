"""The results of a run."""

from __future__ import annotations

import html
import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _nboom
from .checks import path_text
from .errors import SimulationError
from .options import words
from .tables import Table

if TYPE_CHECKING:
    from .scene import Scene

__all__ = ["Run", "framed"]


class Run:
    """The results of a run.

    Arrays are the memory that the run has filled, without copies.
    """

    def __init__(self, scene: Scene, options: Mapping[str, Any], inner: _nboom.Run) -> None:
        self.scene = scene
        self.options = dict(options)
        self._inner = inner
        self._states: Table | None = None
        self._output: Table | None = None
        self._summary: dict[str, Any] | None = None

    @property
    def states(self) -> Table:
        """The motion: a row for each output time, columns as in states.csv, angles in radians."""
        if self._states is None:
            self._states = Table._of_motion(*self._inner.states)
        return self._states

    @property
    def output(self) -> Table | None:
        """The table that the scene or the options ``columns`` and ``degrees`` ask for."""
        wanted = self._inner.wanted
        if self._output is None and wanted is not None:
            self._output = Table._of_motion(*wanted)
        return self._output

    @property
    def events(self) -> Table:
        """What happened, in time order: columns as in events.csv, and ``body``."""
        heads = self._inner.event_heads
        units = {name: unit for name, unit, _ in heads if unit is not None}
        return Table(self._inner.events, units, {name: about for name, _, about in heads})

    @property
    def summary(self) -> dict[str, Any]:
        """What summary.json says: verdict, worst loads, conservation, code, effort."""
        if self._summary is None:
            self._summary = json.loads(self._inner.summary)
        return self._summary

    @property
    def complete(self) -> bool:
        """Whether the run has come to its end."""
        return self._inner.complete

    def __getitem__(self, name: str) -> Any:
        """A column of :attr:`states`."""
        return self.states[name]

    def __contains__(self, name: object) -> bool:
        return name in self.states

    def __iter__(self) -> Iterator[str]:
        """The names of the columns of :attr:`states`."""
        return iter(self.states)

    def save(self, directory: str | os.PathLike[str], **options: Any) -> Path:
        """Writes all files of the run, report.html included, and returns the directory.

        The scene is simulated again, to the same last bit, since tables of loads and the page are made on the
        way.

        Parameters
        ----------
        directory : path
            Created if needed; another run that is there is replaced.
        **options
            More options of ``nboom run``: ``tables=["parquet"]``, ``plots="svg"``, ``certify=True``, ...
        """
        folder = Path(path_text("directory", directory))
        if "output" in options:
            raise TypeError(f"output: {options['output']!r} found beside the directory, one of them expected")
        self.scene._inner.write(words({**self.options, **options, "output": folder}), self._inner)
        return folder

    def report(self) -> str:
        """The page that shows the run: HTML that needs no other file and no network."""
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "run" / "report.html"
            try:
                self.save(page.parent)
            except SimulationError:
                # A run that failed fails again, and leaves its page.
                if self.complete or not page.exists():
                    raise
            return page.read_text(encoding="utf-8")

    def __repr__(self) -> str:
        end = "" if self.complete else ", not complete"
        rows, events = self._inner.states[1].shape[0], len(self._inner.events["t"])
        return f"<nboom.Run of {self.scene.name}: {rows} output times, {events} events{end}>"

    def _repr_html_(self) -> str:
        return framed(self.report())


def framed(page: str) -> str:
    """A page in a frame of its own, for notebooks."""
    source = html.escape(page, quote=True)
    return f'<iframe srcdoc="{source}" style="width: 100%; height: 640px; border: 0"></iframe>'
