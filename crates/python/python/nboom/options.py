"""Keyword arguments as options of the command."""

from __future__ import annotations

import os
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

import numpy as np

from . import _nboom
from .checks import number, scalar, utf_8
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


#: All options of ``nboom run``: whether True says them, and whether another value does.
_KNOWN = {name: (alone, valued) for name, alone, valued in _nboom.options()}


def words(options: Mapping[str, Any]) -> list[str]:
    """The words of a command line that say these options."""
    said = []
    for name, value in options.items():
        if name in _NOT_HERE:
            raise TypeError(f"{name}: not an option here; {_NOT_HERE[name]} is what says it")
        if name not in _KNOWN:
            near = get_close_matches(name, _KNOWN.keys() - _NOT_HERE.keys(), 1)
            raise TypeError(f"{name}: no such option" + "".join(f", did you mean {known}?" for known in near))
        option, value = "--" + name.replace("_", "-"), scalar(value)
        alone, valued = _KNOWN[name]
        if isinstance(value, (bool, np.bool_)):
            if not alone:
                raise TypeError(f"{name}: {value!r} found, a text, a number or a list of them expected")
            said += [option] if value else []
        elif value is not None:
            if not valued:
                raise TypeError(f"{name}: {value!r} found, a truth value expected")
            said.append(f"{option}={_word(name, value)}")
    return said


def _word(name: str, value: Any) -> str:
    if isinstance(value, str):
        return utf_8(name, value)
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, (int, np.integer)):
        # One that has more digits than Python writes is named.
        number(name, value)
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        found = float(value)
        # Counts may come as 400.0.
        return f"{found:.0f}" if found.is_integer() and abs(found) < 1e15 else repr(found)
    if isinstance(value, (list, tuple, np.ndarray)):
        if len(value) == 0:
            raise InputError(f"{name}: an empty list found, one or more elements expected")
        for element in value:
            # To Python they are 1 and 0.
            if isinstance(element, (bool, np.bool_)):
                raise TypeError(f"{name}: {element!r} found in a list, a text or a number expected")
        return ",".join(_word(name, element) for element in value)
    raise TypeError(f"{name}: {value!r} found, a text, a number, a list of them or a truth value expected")


def in_memory(options: Mapping[str, Any]) -> None:
    """Refuses options that have no effect on a run without files."""
    for name in options:
        if name in OF_FILES:
            raise TypeError(f"{name}: an option of files; run.save(directory, {name}=...) takes it")
