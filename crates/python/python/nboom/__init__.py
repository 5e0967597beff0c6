"""Fast, exact simulation of spacecraft that unfold.

>>> import nboom
>>> scene = nboom.load("wing.toml")          # doctest: +SKIP
>>> run = scene.run(rtol=1e-10)              # doctest: +SKIP
>>> run.states["beta_1_1"], run.events       # doctest: +SKIP
>>> nboom.sweep("study.toml").cases          # doctest: +SKIP
"""

from ._nboom import Dynamics, __version__
from .errors import ComparisonFailed, Error, InputError, SceneWarning, SimulationError, TrustWarning
from .run import Run
from .scene import Hinge, Scene, Simulator, load, parse, scene
from .study import Study, Sweep, merge, read_sweep, study, sweep
from .tables import Table

__all__ = [
    "ComparisonFailed",
    "Dynamics",
    "Error",
    "Hinge",
    "InputError",
    "Run",
    "Scene",
    "SceneWarning",
    "SimulationError",
    "Simulator",
    "Study",
    "Sweep",
    "Table",
    "TrustWarning",
    "__version__",
    "load",
    "merge",
    "parse",
    "read_sweep",
    "scene",
    "study",
    "sweep",
]
