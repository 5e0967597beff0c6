"""Runs scenes with tables in Parquet and HDF5, and compares these with those in CSV, to the last bit, by readers of
others: tables.py NBOOM FOLDER."""

import csv
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys

import h5py
import pandas
import polars
import pyarrow.parquet

NBOOM, FOLDER = sys.argv[1:3]
CLONE = pathlib.Path.cwd()
FORMATS = "parquet,hdf5"
KEYS = {"unit": "units", "description": "descriptions", "body": "bodies"}
# Prints the largest memory [KiB] of a command. This process is large itself, which its children would inherit.
PROBE = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""
cells = 0


def nboom(*words, code=0, by=()):
    """What is printed."""
    command = [*by, NBOOM, *map(str, words)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == code, (words, done.stdout)
    return done.stdout


def same(kind, said, found):
    """Whether a field of CSV and what a reader found are the same; HDF5 has NaN or "" where nothing is said."""
    if said == "":
        return found is None or found == "" or (kind != "string" and math.isnan(found))
    if kind == "number":
        return struct.pack("<d", float(said)) == struct.pack("<d", found)
    return found == (int(said) if kind == "integer" else said)


def compare(run, made):
    """Compares the files of a run in the folder `made` with its tables in CSV; how many cells were compared."""
    global cells
    package = json.loads((run / "datapackage.json").read_text())
    texts = {name: (run / file).read_text() for name, file in [("summary", "summary.json"), ("scene", "scene.toml")]}
    with h5py.File(made / "run.h5") as hdf5:
        assert {name: hdf5.attrs[name] for name in texts} == texts
        assert set(hdf5) == {resource["name"] for resource in package["resources"]}
        for resource in package["resources"]:
            cells += compare_table(run, made, resource, hdf5[resource["name"]], texts)


def compare_table(run, made, resource, group, texts):
    fields = resource["schema"]["fields"]
    names = [field["name"].split(" [")[0] for field in fields]
    with open(run / resource["path"], newline="") as file:
        header, *rows = csv.reader(file)
    path = made / (resource["name"] + ".parquet")
    arrow, of_polars = pyarrow.parquet.read_table(path), polars.read_parquet(path)
    assert header == [field["name"] for field in fields], path
    assert names == arrow.column_names == of_polars.columns == group.attrs["columns"].split(","), path
    assert set(names) == set(group), path
    about = {keys: {n: f[key] for n, f in zip(names, fields) if key in f} for key, keys in KEYS.items()}
    metadata = polars.read_parquet_metadata(path)
    assert {keys: json.loads(metadata[keys]) for keys in about} == about == pandas.read_parquet(path).attrs, path
    assert {name: metadata[name] for name in texts} == texts, path
    for place, (name, field) in enumerate(zip(names, fields)):
        data, kind = group[name], field["type"]
        assert all(data.attrs.get(key) == field.get(key) for key in KEYS), (path, name)
        said = [row[place] for row in rows]
        found = [arrow.column(name).to_pylist(), of_polars[name].to_list(), data.asstr()[()] if kind == "string" else data[()]]
        for reader in found:
            assert len(said) == len(reader), (path, name)
            assert all(same(kind, *pair) for pair in zip(said, reader)), (path, name)
    return len(rows) * len(names)


def runs():
    """Runs with many tables, units in headers, a long scene; one that fails; one repeated."""
    for scene, *options in [
        ("n-boom-1970.nml", "--hinge-loads"),
        ("mast.toml", "--units-in-headers", "--degrees"),
        ("rolled-boom.toml", "--samples", "3"),
        ("wing.toml", "--hinge-loads"),
    ]:
        run = pathlib.Path("out") / scene.split(".")[0]
        nboom("run", f"examples/{scene}", "-o", run, "--quiet", "--no-report", "--tables", FORMATS, *options)
        summary = json.loads((run / "summary.json").read_text())
        assert set(summary["files"]) == set(os.listdir(run)), summary["files"]
        compare(run, run)
        nboom("tables", run, "--format", FORMATS)
        compare(run, pathlib.Path(f"{run}-tables"))
        if scene == "wing.toml":
            nboom("run", run / "run.json")
            repeated = pathlib.Path(f"{run}-repeated")
            assert set(os.listdir(run)) == set(os.listdir(repeated))
            compare(repeated, repeated)
    failed = pathlib.Path("out/failed")
    words = ("run", "examples/n-boom-1970.nml", "-o", failed, "--quiet", "--no-report", "--max-events", 2)
    nboom(*words, "--tables", FORMATS, code=3)
    compare(failed, failed)
    refused = nboom("tables", failed, "--format", FORMATS, code=2)
    assert "not complete" in refused, refused
    nboom(*words, code=3)
    assert not list(failed.glob("*.parquet")), "tables of an earlier run are left"


def page():
    """Runs the programs of the page that says how to read the tables."""
    blocks = re.findall(r"^```python file=.*?\n(.*?)^```", (CLONE / "docs/how-to/tables.md").read_text(), re.M | re.S)
    assert len(blocks) == 2
    for block in blocks:
        exec(block, {})


def memory():
    """Memory does not grow with the length of a table."""
    most = {}
    for rows in [300_000, 3_000_000]:
        place = pathlib.Path(f"long-{rows}")
        place.mkdir()
        fields = [{"name": name, "type": "number", "description": ""} for name in ["t", "beta_1_1", "tau_1_1"]]
        table = {"name": "states", "path": "states.csv", "schema": {"fields": fields}}
        (place / "datapackage.json").write_text(json.dumps({"resources": [table]}))
        (place / "summary.json").write_text('{"complete": true}')
        (place / "states.csv").write_text("t,beta_1_1,tau_1_1\n" + "0.25,-0.125,1e-3\n" * rows)
        for name in FORMATS.split(","):
            printed = nboom("tables", place, "--format", name, by=[sys.executable, "-c", PROBE])
            most[name, rows] = float(printed.split()[-1]) / 1024
        shutil.rmtree(place)
    for name in FORMATS.split(","):
        short, long = [most[name, rows] for rows in [300_000, 3_000_000]]
        print(f"{name}: at most {long:.0f} MiB for 3 million rows, {short:.0f} MiB for a tenth")
        assert long < 1.25 * short, most


os.chdir(FOLDER)
shutil.copytree(CLONE / "examples", "examples", ignore=lambda folder, names: {n for n in names if n == "target"})
runs()
page()
memory()
print(f"{cells} cells are the same in CSV, Parquet and HDF5")
