"""Tables of results."""

from __future__ import annotations

import html
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import pyarrow

__all__ = ["Table"]

#: Rows and columns of a table that a notebook shows.
_ROWS_SHOWN = 10
_COLUMNS_SHOWN = 12


class Table(Mapping[str, np.ndarray]):
    """Columns by name, each an array of numpy with a number or a text for each row.

    Numbers that are missing are NaN, texts that are missing ``None``. A table of the motion is one array,
    of which columns are views: ``numpy.asarray(table)`` copies nothing.

    Attributes
    ----------
    units : dict
        The unit of each column of numbers that has one.
    about : dict
        What each column is, in one line.
    """

    def __init__(
        self,
        columns: Mapping[str, Any],
        units: Mapping[str, str] | None = None,
        about: Mapping[str, str] | None = None,
        array: np.ndarray | None = None,
    ) -> None:
        self._columns = {name: _column(cells) for name, cells in columns.items()}
        self.units = dict(units or {})
        self.about = dict(about or {})
        self._array = array
        self._frame: pandas.DataFrame | None = None

    @classmethod
    def _of_motion(cls, heads: list[tuple[str, str, str]], array: np.ndarray) -> Table:
        names = [name for name, _, _ in heads]
        return cls(
            {name: array[:, i] for i, name in enumerate(names)},
            {name: unit for name, unit, _ in heads},
            {name: about for name, _, about in heads},
            array,
        )

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            known = ", ".join(self._columns)
            raise KeyError(f"{name}: no such column, one of {known} expected") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __eq__(self, other: object) -> bool:
        """Whether names and cells are the same, those that are missing too."""
        if not isinstance(other, Table):
            return NotImplemented
        return list(self) == list(other) and all(_are_same(self[name], other[name]) for name in self)

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self._columns.values()), ()))

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        if self._array is None:
            raise TypeError("a table with texts found, one of numbers expected; take its columns by name")
        if dtype is not None and np.dtype(dtype) != self._array.dtype:
            if copy is False:
                raise ValueError(f"{np.dtype(dtype)} found, {self._array.dtype} expected: another type needs a copy")
            return self._array.astype(dtype)
        return self._array.copy() if copy else self._array

    def to_pandas(self) -> pandas.DataFrame:
        """The table for pandas; of the motion without a copy of its numbers until the frame is written into."""
        import pandas

        if self._array is None:
            return pandas.DataFrame(dict(self._columns))
        if self._frame is None:
            self._frame = pandas.DataFrame(self._array, columns=list(self), copy=False)
        # pandas copies on write what two frames share, but not what it shares with numpy: one frame stays here.
        return self._frame.copy(deep=False)

    def __getstate__(self) -> dict[str, Any]:
        # Where it is read there may be no pandas.
        return {**vars(self), "_frame": None}

    def to_arrow(self) -> pyarrow.Table:
        """The table for Arrow and all that reads it, with units and meanings of columns."""
        import pyarrow

        fields, columns = [], []
        for name, cells in self._columns.items():
            array = pyarrow.array(np.ascontiguousarray(cells), from_pandas=cells.dtype == object)
            # What is always missing would have no type.
            array = array.cast(pyarrow.string()) if pyarrow.types.is_null(array.type) else array
            notes = {"unit": self.units.get(name), "description": self.about.get(name)}
            notes = {key: note for key, note in notes.items() if note}
            fields.append(pyarrow.field(name, array.type, metadata=notes or None))
            columns.append(array)
        return pyarrow.table(columns, schema=pyarrow.schema(fields))

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        return f"<nboom.Table: {self.rows} rows, {len(self)} columns: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        names = list(self)[:_COLUMNS_SHOWN]
        more = "<th>…</th>" if len(self) > len(names) else ""
        head = "".join(f"<th>{html.escape(self._head(name))}</th>" for name in names) + more
        shown = range(min(self.rows, _ROWS_SHOWN))
        body = "".join(
            "<tr>" + "".join(f"<td>{_cell(self._columns[name][i])}</td>" for name in names) + "</tr>"
            for i in shown
        )
        size = f"<p>{self.rows} rows, {len(self)} columns</p>"
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{size}"

    def _head(self, name: str) -> str:
        unit = self.units.get(name)
        return f"{name} [{unit}]" if unit and unit != "1" else name


def _column(cells: Any) -> np.ndarray:
    if isinstance(cells, np.ndarray):
        return cells
    return np.array(cells, dtype=object)


def _are_same(a: np.ndarray, b: np.ndarray) -> bool:
    return np.array_equal(a, b, equal_nan=a.dtype.kind == b.dtype.kind == "f")


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else html.escape(str(value))
