"""Keyword arguments as options of the command."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import InputError

#: Options of ``nboom run`` that concern its files or its terminal alone.
OF_FILES = frozenset(
    {
        "output",
        "tables",
        "plots",
        "listing",
        "certify",
        "no_report",
        "units_in_headers",
        "report_signs",
    }
)

#: Options that say what the scene is, or have no place in Python.
_NOT_HERE = {
    "scene": "nboom.load",
    "set": "nboom.load(path, parameters={...})",
    "format": "nboom.parse(text, format=...)",
    "include_anywhere": "nboom.load(path, include_anywhere=True)",
    "fixed_base": "nboom.load(path, fixed_base=True)",
    "case": "nboom.study(path)",
    "quiet": "the warnings module",
    "help": "help(nboom)",
}


def words(options: Mapping[str, Any]) -> list[str]:
    """The words of a command line that say these options."""
    said = []
    for name, value in options.items():
        if name in _NOT_HERE:
            raise TypeError(f"{name}: not an option here; {_NOT_HERE[name]} is what says it")
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        said.append(option if value is True else f"{option}={_word(name, value)}")
    return said


def _word(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (list, tuple, np.ndarray)):
        if len(value) == 0:
            raise InputError(f"{name}: an empty list found, one or more elements expected")
        return ",".join(_word(name, element) for element in value)
    raise TypeError(f"{name}: {value!r} found, a text, a number, a list of them or a truth value expected")


def in_memory(options: Mapping[str, Any]) -> None:
    """Refuses options that have no effect on a run without files."""
    for name in options:
        if name in OF_FILES:
            raise TypeError(f"{name}: an option of files; run.save(directory, {name}=...) takes it")
