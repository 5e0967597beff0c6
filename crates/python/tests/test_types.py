"""What type checkers are told."""

import ast
from pathlib import Path

import nboom
from nboom import _nboom


def test_classes_that_cannot_be_subclassed_are_final():
    stub = ast.parse((Path(nboom.__file__).parent / "_nboom.pyi").read_text(encoding="utf-8"))
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    assert len(classes) >= 8
    for node in classes:
        try:
            type("Own", (getattr(_nboom, node.name),), {})
            is_final = False
        except TypeError:
            is_final = True
        assert ("final" in [ast.unparse(mark) for mark in node.decorator_list]) == is_final, node.name
