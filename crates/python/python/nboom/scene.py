"""Scenes, and what runs them."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _nboom
from .checks import items, number, path_text, whole
from .errors import ComparisonFailed, InputError, SceneWarning, TrustWarning, warn
from .options import in_memory, words
from .run import Run

__all__ = ["Hinge", "Scene", "Simulator", "load", "parse", "scene"]

#: Simulators that a scene keeps, by options.
_MOST_SIMULATORS = 8


@dataclass(frozen=True, repr=False)
class Hinge:
    """A hinge of a scene; those with the same label and body are equal.

    Attributes
    ----------
    label : str
        Appendage and segment, ``"1,2"``.
    body : str or None
        The name of the body on it.
    """

    label: str
    body: str | None

    def __repr__(self) -> str:
        return f"Hinge({self.label!r}, {self.body!r})"


class Scene:
    """A satellite, what acts on it, and how it starts; checked.

    Made by :func:`load`, :func:`parse` and :func:`scene`. A scene does not change; :meth:`with_values` makes
    another one.
    """

    def __init__(self, inner: _nboom.Scene) -> None:
        self._inner = inner
        self._simulators: dict[tuple[str, ...], Simulator] = {}
        for warning in inner.warnings:
            warn(warning, SceneWarning)

    @property
    def name(self) -> str:
        """Its name."""
        return self._inner.name

    @property
    def span(self) -> tuple[float, float]:
        """Initial and end time [T]."""
        return self._inner.span

    @property
    def degrees_of_freedom(self) -> int:
        """Six, and one for each hinge."""
        return self._inner.degrees_of_freedom

    @property
    def hinges(self) -> list[Hinge]:
        """Its hinges, in the order of columns and of arrays over hinges."""
        return [Hinge(label, body) for label, body in self._inner.hinges]

    @property
    def units(self) -> str:
        """The units of its numbers, of which none is ever converted."""
        return self._inner.units

    @property
    def parameters(self) -> dict[str, float]:
        """Its parameters."""
        return dict(self._inner.parameters)

    @property
    def text(self) -> str:
        """The scene in TOML, with all that it includes."""
        return self._inner.text()

    def __getitem__(self, path: str) -> float:
        """The number at a path, as ``scene["body.boom.hinge.spring.stiffness"]``, in the units of its key."""
        return self._inner.number(path)

    # Else Python would look for the paths 0, 1, ...
    __iter__: None = None
    __contains__: None = None

    def with_values(self, values: Mapping[str, float]) -> Scene:
        """The scene with other numbers at paths.

        Parameters
        ----------
        values : dict
            Numbers by path, in the units of the key at the path: those of ``start_deg`` are degrees.

        Raises
        ------
        InputError
            If the scene has no number there, or becomes unphysical.
        """
        return Scene(self._inner.with_numbers([(path, number(path, value)) for path, value in items("values", values)]))

    def simulator(self, **options: Any) -> Simulator:
        """The scene prepared to be run as often as wanted.

        Options are those of :meth:`run`.
        """
        in_memory(options)
        return Simulator(self, options)

    def run(self, **options: Any) -> Run:
        """Simulates the scene.

        Parameters
        ----------
        **options
            Those of ``nboom run``, with ``_`` for ``-``: ``rtol=1e-10``, ``samples=400``,
            ``integrator="gauss_lanes"``, ``end_time=2.0``, ``times=[0.1, 0.2]``, ``no_stresses=True``, ...

        Raises
        ------
        InputError
            Of an option that does not fit.
        SimulationError
            If the motion cannot be followed; its ``run`` has what was found before.
        """
        in_memory(options)
        key = tuple(words(options))
        simulator = self._simulators.get(key)
        if simulator is None:
            if len(self._simulators) >= _MOST_SIMULATORS:
                self._simulators.clear()
            simulator = self._simulators[key] = self.simulator(**options)
        return simulator.run()

    def dynamics(
        self,
        held: Mapping[str, float] | None = None,
        formulation: str | None = None,
        path: str | None = None,
    ) -> _nboom.Dynamics:
        """The equations of motion, to be evaluated at any states.

        Parameters
        ----------
        held : dict, optional
            Hinges that are held, by body or label, with their angles [rad]; all others are free, however
            the scene begins. Where a body's name looks like the label of another hinge, the name counts.
        formulation, path : str, optional
            Which code, as of :meth:`run`.
        """
        numbers = {hinge.label: i for i, hinge in enumerate(self.hinges)}
        # As `Dynamics.hinges` has them.
        numbers |= {f"{hinge.label} ({hinge.body})": i for i, hinge in enumerate(self.hinges)}
        # Last, since a name may look like the label of another hinge: as the command and studies read names.
        numbers |= {hinge.body: i for i, hinge in enumerate(self.hinges) if hinge.body is not None}
        at: list[tuple[int, float]] = []
        for name, angle in items("held", {} if held is None else held):
            if name not in numbers:
                known = ", ".join(hinge.body or hinge.label for hinge in self.hinges)
                raise InputError(f"held: `{name}` found, a hinge of the scene expected: {known}")
            if numbers[name] in dict(at):
                raise InputError(f"held: `{name}` found for the second time, each hinge once expected")
            at.append((numbers[name], number(f"held: {name}", angle)))
        return self._inner.dynamics(words({"formulation": formulation, "path": path}), at)

    def verify(self, states: int = 100, seed: int = 1970, tol: float = 1e-11) -> dict[str, Any]:
        """Compares all code that computes accelerations, matrices and right sides on random states.

        Returns what ``nboom verify`` writes: ``rows`` with the largest deviation of each code.

        Raises
        ------
        ComparisonFailed
            If one is above ``tol``; its ``found`` has all of them.
        """
        count, start = whole("states", states, 1, 1_000_000), whole("seed", seed, 0, 2**64 - 1)
        found = json.loads(self._inner.verify(count, start, number("tol", tol)))
        if not found["passed"]:
            raise ComparisonFailed(f"{self.name}: codes deviate by more than {tol:g}", found)
        return found

    def compile(
        self,
        formulation: str | None = None,
        work: str | os.PathLike[str] | None = None,
        offline: bool = False,
    ) -> Scene:
        """The same scene with routines that cargo compiles for it now, with its numbers built in.

        Parameters
        ----------
        formulation : str, optional
            By default ``articulated``.
        work : path, optional
            The folder to build in; by default nboom in the user's cache. The next build there is quicker, and what is
            there already is not built again.
        offline : bool, optional
            Build with what cargo has at hand.

        Raises
        ------
        InputError
            If there is no code for the scene.
        SimulationError
            If cargo, which comes with Rust, is not there or fails.
        """
        where = None if work is None else path_text("work", work)
        return Scene(self._inner.compiled(formulation, where, offline))

    def __repr__(self) -> str:
        return f"<nboom.Scene {self.name}: {len(self.hinges)} hinges, {self.degrees_of_freedom} degrees of freedom>"

    def _repr_html_(self) -> str:
        start, end = self.span
        facts = (
            f"<p><b>{html.escape(self.name)}</b>: {len(self.hinges)} hinges, "
            f"{self.degrees_of_freedom} degrees of freedom, from {start:g} to {end:g}</p>"
        )
        return facts + (self._inner.svg() or "")

    def __reduce__(self) -> tuple[Any, ...]:
        return parse, self._inner.source()

    # A scene does not change.
    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: object) -> Scene:
        return self


class Simulator:
    """A scene with options, prepared: later runs cost nothing but their motion."""

    def __init__(self, scene: Scene, options: Mapping[str, Any]) -> None:
        self.scene = scene
        self.options = dict(options)
        self._inner = scene._inner.simulator(words(options))
        known = frozenset(scene._inner.warnings)
        for warning in self._inner.warnings:
            if warning not in known:
                warn(warning, SceneWarning)

    def run(self) -> Run:
        """Runs it, as :meth:`Scene.run` does."""
        try:
            inner = self._inner.run()
        except Exception as error:
            failed = getattr(error, "run", None)
            if isinstance(failed, _nboom.Run):
                error.run = Run(self.scene, self.options, failed)  # type: ignore[attr-defined]
            raise
        if inner.ignored is not None:
            warn(inner.ignored, SceneWarning)
        for trouble in inner.troubles:
            warn(trouble, TrustWarning)
        return Run(self.scene, self.options, inner)


def load(
    path: str | os.PathLike[str],
    parameters: Mapping[str, float] | None = None,
    include_anywhere: bool = False,
    fixed_base: bool = False,
) -> Scene:
    """Reads a scene ``NAME.toml``, a legacy deck ``NAME.nml`` or a robot ``NAME.urdf``.

    Parameters
    ----------
    path : path
        The file.
    parameters : dict, optional
        Values for parameters of the scene.
    include_anywhere : bool, optional
        Let the scene include files outside of its folder.
    fixed_base : bool, optional
        Fix the main body of a robot to the ground.

    Raises
    ------
    InputError
        With file, line, key, what was found and expected, of all that is wrong.
    """
    given = items("parameters", {} if parameters is None else parameters)
    values = [(name, number(f"parameters: {name}", value)) for name, value in given]
    return Scene(_nboom.Scene.load(path_text("path", path), values, include_anywhere, fixed_base))


def parse(
    text: str,
    name: str = "scene",
    format: str = "toml",
    folder: str | os.PathLike[str] | None = None,
    fixed_base: bool = False,
) -> Scene:
    """Reads the text of a scene, of a deck (``format="nml"``) or of a robot (``"urdf"``).

    ``folder`` is where files lie that the scene includes. ``fixed_base`` fixes the main body of a robot to the ground.
    """
    where = None if folder is None else path_text("folder", folder)
    return Scene(_nboom.Scene.parse(text, name, format, where, fixed_base))


def scene(name: str = "scene", **tables: Any) -> Scene:
    """A scene that is said in Python: the tables and keys of a scene in TOML.

    Examples
    --------
    >>> import nboom
    >>> one_boom = nboom.scene(
    ...     "one boom",
    ...     run={"end": 10.0},
    ...     main_body={"mass": 100.0, "inertia": [40.0, 30.0, 20.0]},
    ...     body=[{
    ...         "name": "boom", "mass": 3.0, "mass_centre": [1.0, 0.0, 0.0], "inertia": [0.1, 1.0, 1.0],
    ...         "hinge": {"at": [0.5, 0.0, 0.1], "axis": "z", "start_deg": 90.0, "latch_deg": 0.0,
    ...                   "spring": {"stiffness": 2.0}},
    ...     }],
    ... )
    >>> one_boom.degrees_of_freedom
    7
    """
    return parse(_nboom.toml_text(tables), name)
