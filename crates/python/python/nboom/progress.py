"""How far a sweep is, on terminals and in notebooks."""

from __future__ import annotations

import html
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

__all__ = ["shown"]


class Silent:
    """Shows nothing."""

    def __call__(self, done: int, total: int) -> None:
        pass

    def close(self) -> None:
        pass


class Told(Silent):
    """Tells somebody else."""

    def __init__(self, tell: Callable[[int, int], None]) -> None:
        self._tell = tell

    def __call__(self, done: int, total: int) -> None:
        self._tell(done, total)


class Bar(Silent):
    """A line that changes."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._began = time.monotonic()
        self._before: int | None = None

    def __call__(self, done: int, total: int) -> None:
        if self._before is None:
            self._before = done
        self.show(done, total, self._left(done, total))

    def _left(self, done: int, total: int) -> str:
        now = done - (self._before or 0)
        if now <= 0:
            return ""
        seconds = (time.monotonic() - self._began) * (total - done) / now
        return f", about {seconds:.0f} s left" if done < total else ""

    def show(self, done: int, total: int, left: str) -> None:
        raise NotImplementedError


class Line(Bar):
    """On a terminal."""

    def show(self, done: int, total: int, left: str) -> None:
        sys.stderr.write(f"\r\x1b[K{self._name}: {done} of {total} cases{left}")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\r\x1b[K")
        sys.stderr.flush()


class Notebook(Bar):
    """In a notebook."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._handle: Any = None

    def show(self, done: int, total: int, left: str) -> None:
        from IPython.display import HTML, display

        text = f"{html.escape(self._name)}: {done} of {total} cases{left}"
        bar = HTML(f'<progress value="{done}" max="{max(total, 1)}"></progress> {text}')
        if self._handle is None:
            self._handle = display(bar, display_id=True)
        else:
            self._handle.update(bar)


def shown(progress: bool | Callable[[int, int], None] | None, name: str) -> Silent:
    """What shows the progress of a sweep."""
    if callable(progress):
        return Told(progress)
    if progress is not None and not isinstance(progress, (bool, np.bool_)):
        raise TypeError(f"progress: {progress!r} found, a truth value or a function expected")
    if progress is not None and not progress:
        return Silent()
    if _in_notebook():
        return Notebook(name)
    if progress or sys.stderr.isatty():
        return Line(name)
    return Silent()


def _in_notebook() -> bool:
    interactive = sys.modules.get("IPython")
    shell = interactive.get_ipython() if interactive is not None else None
    return shell is not None and type(shell).__name__ == "ZMQInteractiveShell"
