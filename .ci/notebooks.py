"""Executes all notebooks in a copy of the examples, so that nothing is written into the repository."""

import shutil
import sys
import tempfile
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def execute(path: Path) -> None:
    """Executes a notebook, which prints a line; ends with the first cell that fails."""
    began = time.monotonic()
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    if any(cell.get("outputs") for cell in notebook.cells):
        sys.exit(f"{path.name}: outputs found, none expected in the repository")
    client = NotebookClient(notebook, timeout=300, resources={"metadata": {"path": path.parent}})
    try:
        client.execute()
    except CellExecutionError as error:
        sys.exit(f"{path.name}: {error}")
    print(f"{path.name}: {len(notebook.cells)} cells, {time.monotonic() - began:.1f} s")


with tempfile.TemporaryDirectory() as folder:
    copy = Path(folder, "examples")
    shutil.copytree(EXAMPLES, copy, ignore=shutil.ignore_patterns("target"))
    notebooks = sorted((copy / "notebooks").glob("*.ipynb"))
    if not notebooks:
        sys.exit("no notebook found, some expected")
    for notebook in notebooks:
        execute(notebook)
