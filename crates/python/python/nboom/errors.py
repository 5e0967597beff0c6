"""What goes wrong: exceptions with the messages of the command ``nboom``."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .run import Run

__all__ = ["ComparisonFailed", "Error", "InputError", "SceneWarning", "SimulationError", "TrustWarning"]


class Error(Exception):
    """Anything that nboom refuses or cannot do."""


class InputError(Error, ValueError):
    """A scene, a study, an option or a directory is wrong; the message names file, line and key."""


class SimulationError(Error, RuntimeError):
    """A run or a sweep cannot be finished.

    ``run`` is the run up to where it failed, where there is one; an error that comes from another process has none.
    """

    run: Run | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        # The memory of a run stays in its process.
        return type(self), self.args, {name: value for name, value in vars(self).items() if name != "run"}


class ComparisonFailed(Error, AssertionError):
    """Codes that should agree do not; ``found`` is what was compared."""

    def __init__(self, message: str, found: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.found = found


class SceneWarning(UserWarning):
    """Something in a scene is allowed, but probably a mistake."""


class TrustWarning(UserWarning):
    """The results of a run are poor, or a part fails."""


def warn(message: str, category: type[Warning]) -> None:
    """Warns of a line outside of this package, the last one that was called from."""
    package = str(Path(__file__).parent)
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(package):
        level, frame = level + 1, frame.f_back
    warnings.warn(message, category, stacklevel=level)
