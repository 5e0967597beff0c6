"""The page on Python works as it stands."""

import re
import shutil

import pytest
from conftest import ROOT

PAGE = ROOT / "docs" / "python.md"


@pytest.mark.skipif(not PAGE.exists(), reason="there is no clone around the tests")
def test_the_blocks_of_the_page_run_one_after_the_other(tmp_path, monkeypatch, examples):
    shutil.copytree(examples, tmp_path / "examples", ignore=shutil.ignore_patterns("target"))
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    assert len(blocks) >= 5
    known = {}
    for block in blocks:
        exec(compile(block, str(PAGE), "exec"), known)  # noqa: S102
    assert known["worst"].complete and (tmp_path / "cubesat-run" / "report.html").exists()
