"""The tables of a dated run: reads what `dated_run` has written, prints summary.md.

    python benches/peers/summary.py benches/runs/DATE-MACHINE

Shortest times of both rounds. Whole runs are compared at the same error, which is the peers' for all: the
largest difference of any variable at the end over the largest variable.
"""

import csv
import math
import re
import sys
from pathlib import Path

TOPOLOGIES = ["T1", "T2", "T3", "T4"]
# Rows of a table, each with the code that it stands beside.
GENERAL = [
    ("generated, any axes, numbers at run time", ["nboom_generated_articulated"], "T1_general"),
    ("kernel by hand, any axes, numbers at run time", ["limit_params_scalar"], "T1"),
]
EVALUATIONS = [
    ("generated, principal axes", ["nboom_generated_articulated"]),
    ("compiled for the scene, numbers at run time", ["nboom_compiled_articulated"]),
    ("compiled for the scene, numbers built in", ["nboom_generated_articulated_baked"]),
    ("kernel by hand, numbers built in", ["limit_baked_scalar", "limit_blk3_scalar"]),
    ("kernel by hand, planar chains, numbers at run time", ["limit_rolled_scalar", "limit_1state_lanes"]),
    ("generated, eight states, each", ["nboom_generated_articulated_lanes8"]),
    ("kernel by hand, planar chains, eight states, each", ["limit_rolled_simd8"]),
    ("kernel by hand, numbers built in, eight states, each", ["limit_baked_simd8"]),
    ("recursion", ["nboom_generic_recursive"]),
    ("Pinocchio, articulated bodies", ["pin_aba_world", "pin_aba_local"]),
    ("MuJoCo, bare", ["mujoco_bareFD"]),
    ("CasADi's C of Pinocchio", ["casadi_pin_aba", "casadi_pin_aba_cse"]),
]
FASTEST = ["articulated", "recursive"]
ERRORS = [1e-6, 1e-9, 1e-12, 1e-13]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def ns(value):
    return "-" if value is None else f"{value:.1f}" if value < 1000 else f"{value:.0f}"


def evaluations(directory):
    times = {}
    for line in (directory / "evaluations.txt").read_text().splitlines():
        found = re.match(r"(\S+) +(\S+) ns_min (\S+) ns_median", line)
        if found:
            name, scene, time = found[1], found[2], float(found[3])
            times[name, scene] = min(time, times.get((name, scene), math.inf))
    least = lambda names, scene: min(
        (times[name, scene] for name in names if (name, scene) in times), default=None
    )
    special = table(
        ["ns, shortest"] + TOPOLOGIES,
        [[row] + [ns(least(names, scene)) for scene in TOPOLOGIES] for row, names in EVALUATIONS],
    )
    general = table(
        ["ns, shortest", "T1 with inertias along no axes"],
        [[row, ns(least(names, scene))] for row, names, scene in GENERAL],
    )
    return special, general


def whole_runs(directory):
    """Points (error, microseconds) of each curve."""
    curves, ours, head = {}, None, None
    add = lambda name, error, time: curves.setdefault(name, {}).setdefault(error, []).append(time)
    for line in (directory / "whole-runs.txt").read_text(errors="replace").splitlines():
        if line.startswith("nboom "):
            ours, head = line.split()[1], None
        elif ours and head is None and line.startswith("path,"):
            head = line.split(",")
        elif ours and head and line.count(",") == len(head) - 1:
            row = dict(zip(head, next(csv.reader([line]))))
            code = {"recorded": "", "generated": f", {ours} routine"}.get(row["path"])
            code = f", library {row['formulation']}" if code is None else code
            # The fastest form of each kind of code; the other forms are in the file.
            if row["path"] == "recorded" or row["formulation"] in FASTEST:
                name = f"ours, `{row['integrator']}`{code}"
                add(name, float(row["error_as_peers"]), float(row["microseconds"]))
        else:
            found = re.match(r"(dop853|cvode_adams) (\S+) tol \S+ us_min (\S+) .*relerr (\S+)", line)
            if found:
                integrator = {"dop853": "DOP853", "cvode_adams": "CVODE Adams"}[found[1]]
                code = {"pin_aba": "Pinocchio"}.get(found[2], "the kernel by hand, numbers built in")
                add(f"{integrator} with {code}", float(found[4]), float(found[3]))
            found = re.match(r"heyoka scalar .* compact (\S+) .*us_min (\S+) .*relerr (\S+)", line)
            if found:
                name = "heyoka, compact" if found[1] == "True" else "heyoka, not compact"
                add(name, float(found[3]), float(found[2]))
    return {name: sorted((e, min(t)) for e, t in points.items()) for name, points in curves.items()}


def at(points, error):
    """The time to an error, between two points in logarithms; of more accurate ones the shortest."""
    better = [time for e, time in points if e <= error]
    if not better:
        return None
    below = max(p for p in points if p[0] <= error)
    above = min((p for p in points if p[0] > error), default=None)
    least = min(better)
    if above is None or below[0] <= 0:
        return least
    share = math.log(error / below[0]) / math.log(above[0] / below[0])
    return min(least, math.exp((1 - share) * math.log(below[1]) + share * math.log(above[1])))


# Our integrators in the tables, and what others are compared with.
OURS = tuple(f"ours, `{name}`" for name in ("auto", "dop853", "gauss_lanes", "taylor"))
BASES = [f"ours, `{name}`, compiled routine" for name in ("gauss_lanes", "dop853")]


def whole_run_tables(directory):
    curves = whole_runs(directory)
    show = lambda time: "-" if time is None else f"{time:.0f}"
    wanted = [name for name in curves if not name.startswith("ours")]
    wanted += [name for name in curves if name.startswith(OURS)]
    rows = [[name] + [show(at(curves[name], e)) for e in ERRORS] for name in wanted]
    times = table(["µs to an error of"] + [f"{e:.0e}" for e in ERRORS], rows)
    bases = [base for base in BASES if base in curves]
    ratios = "\n".join(ratio_table(curves, wanted, base) for base in bases)
    return times, ratios or "No compiled routine was measured.\n"


def ratio_table(curves, wanted, base):
    ratio = lambda name, e: (at(curves[name], e), at(curves[base], e))
    cell = lambda pair: "-" if None in pair else f"{pair[0] / pair[1]:.2f}"
    others = [name for name in wanted if name != base]
    rows = [[name] + [cell(ratio(name, e)) for e in ERRORS] for name in others]
    return table([f"times as long as {base}"] + [f"{e:.0e}" for e in ERRORS], rows)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: summary.py DIR")
    directory = Path(sys.argv[1])
    read = lambda name: (directory / name).read_text().rstrip()
    has = lambda name: (directory / name).exists()
    conditions = read("conditions.txt")
    date = re.search(r"date: (\S+)", conditions)[1]
    whole = "Whole runs" if not has("evaluations.txt") else "Evaluations and whole runs"
    print(f"# {whole} beside peers, {date}\n")
    print("By `benches/peers/dated_run`, one thread, peers and ours in turns.\n")
    print(f"```text\n{conditions}\n```\n")
    if has("evaluations.txt"):
        special, general = evaluations(directory)
        print("## Evaluations\n\nAll lines are in [evaluations.txt](evaluations.txt).\n")
        print(special)
        print("The kernels by hand with numbers at run time are for bodies of any shape:\n")
        print(general)
    times, ratios = whole_run_tables(directory)
    print("## Whole runs, on T1_smooth\n")
    print("All lines of both rounds are in [whole-runs.txt](whole-runs.txt). The error of all is that of")
    print("the peers: the largest difference of any variable at the end over the largest variable.\n")
    print(times)
    print(ratios)
    if has("features.txt"):
        print(f"## What features cost\n\n```text\n{read('features.txt')}\n```\n")
    if has("free_hinges.txt"):
        lines = [line for line in read("free_hinges.txt").splitlines() if "claim" in line]
        print("## Held hinges\n\nAll lines are in [free_hinges.txt](free_hinges.txt).\n")
        print("```text\n" + "\n".join(lines) + "\n```")


if __name__ == "__main__":
    main()
