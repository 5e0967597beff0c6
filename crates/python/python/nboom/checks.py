"""Arguments that are numbers or paths; others are refused by name."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from .errors import InputError

__all__ = ["items", "number", "path_text", "scalar", "utf_8", "whole"]


def scalar(value: Any) -> Any:
    """What an array without dimensions holds; anything else as it is."""
    return value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value


def number(name: str, value: Any) -> float:
    """A number, of Python or of numpy."""
    found = scalar(value)
    if isinstance(found, (int, float, np.integer, np.floating)) and not isinstance(found, bool):
        try:
            return float(found)
        except OverflowError:
            # Its digits may be more than Python writes.
            raise InputError(f"{name}: a larger whole number found, a number up to 1.8e308 expected") from None
    raise TypeError(f"{name}: {value!r} found, a number expected")


def items(name: str, values: Any) -> list[tuple[str, Any]]:
    """The names and values of a dict, or of a row of pandas."""
    if not callable(getattr(values, "items", None)):
        raise TypeError(f"{name}: {values!r} found, a dict expected")
    pairs = list(values.items())
    for key, _ in pairs:
        if not isinstance(key, str):
            raise TypeError(f"{name}: {key!r} found, a text expected")
    return pairs


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number of a range."""
    found = scalar(value)
    if not isinstance(found, (int, np.integer)) or isinstance(found, bool):
        raise TypeError(f"{name}: {value!r} found, a whole number expected")
    if not least <= found <= most:
        raise InputError(f"{name}: {found} found, a number from {least} to {most} expected")
    return int(found)


def path_text(name: str, value: Any) -> str:
    """A path as a text."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name}: {value!r} found, a path expected")
    text = os.fsdecode(value)
    if not text:
        raise InputError(f"{name}: an empty text found, a path expected")
    return text


def utf_8(name: str, text: str) -> str:
    """A text that Rust can have: one without surrogates, which stand for other bytes in paths."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{name}: {text!r} found, a text in UTF-8 expected") from None
    return text
