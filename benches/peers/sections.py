"""Thin-wall theory beside finite elements: `nboom section` against sectionproperties.

Run by hand, with the command built:

    pip install sectionproperties==3.10.2
    python benches/peers/sections.py target/release/nboom

Prints the table of docs/validation.md. Sections are meshed as they really are: each wall reaches half
its thickness to either side of the middle line, and corners are sharp. Finite elements know nothing of
the middle line, so differences are those of thin-wall theory and fall with the thickness.
"""

import json
import math
import subprocess
import sys
import tempfile

from sectionproperties.analysis import Section
from sectionproperties.pre import Geometry
from shapely import Point, Polygon

# Force on the outboard part, and moment about the point on the eta axis.
FORCE, MOMENT = (3.0, -20.0, 5.0), (4.0, -6.0, 2.0)


def regular(count):
    angles = [2 * math.pi * i / count for i in range(count)]
    return [(math.cos(a), math.sin(a)) for a in angles]


SQUARE = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
ANGLE = [(3, -1), (3, 0), (0, 0), (0, 3), (-1, 3), (-1, -1)]
KITE = [(3, 2), (-1, 2.5), (-1.5, -1), (2, -1.5)]
BOX = [(20, 1), (-20, 1), (-20, -1), (20, -1)]
CASES = [
    ("square", SQUARE, [0.1] * 4),
    ("square", SQUARE, [0.05] * 4),
    ("square", SQUARE, [0.02] * 4),
    ("square, one heavy wall", SQUARE, [0.02, 0.08, 0.02, 0.02]),
    ("square, one heavy wall", SQUARE, [0.01, 0.04, 0.01, 0.01]),
    ("kite, uneven walls", KITE, [0.05, 0.04, 0.06, 0.05]),
    ("kite, uneven walls", KITE, [0.025, 0.02, 0.03, 0.025]),
    ("L, not convex", ANGLE, [0.05] * 6),
    ("L, not convex", ANGLE, [0.02] * 6),
    ("hexagon", regular(6), [0.02] * 6),
    ("triangle", regular(3), [0.02] * 3),
    ("flat box of the report", BOX, [0.05, 0.1, 0.05, 0.1]),
    ("tube", 1.0, 0.1),
    ("tube", 1.0, 0.02),
]


def question(name, outline, thickness):
    load = {"P": FORCE, "Q": MOMENT}
    if isinstance(outline, list):
        return {"id": name, "kind": "polygon", "vertices": outline, "thickness": thickness} | load
    return {"id": name, "kind": "circular", "R": outline, "t": thickness} | load


def ask(command, questions):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"cases": questions}, file)
        file.flush()
        answer = subprocess.run([command, "section", file.name], check=True, stdout=subprocess.PIPE)
    return [case["expect"] for case in json.loads(answer.stdout)["cases"]]


def offset(vertices, thickness, side):
    """The outline half a thickness to one side: where the shifted walls intersect."""
    lines = []
    for (x, y), (u, v), t in zip(vertices, vertices[1:] + vertices[:1], thickness):
        length = math.hypot(u - x, v - y)
        normal = ((v - y) / length, (x - u) / length)
        lines.append((normal, normal[0] * x + normal[1] * y + side * t / 2))
    corners = []
    for (a, p), (b, q) in zip(lines[-1:] + lines[:-1], lines):
        determinant = a[0] * b[1] - a[1] * b[0]
        corners.append(((p * b[1] - q * a[1]) / determinant, (q * a[0] - p * b[0]) / determinant))
    return corners


def finite_elements(outline, thickness):
    """Meshed with x along zeta and y along xi, so that eta points to the viewer."""
    swapped = lambda points: [(zeta, xi) for xi, zeta in points]
    if isinstance(outline, list):
        outer, inner = (swapped(offset(outline, thickness, side)) for side in (1, -1))
        wall, thinnest = Polygon(outer, [inner]), min(thickness)
    else:
        circle = lambda radius: Point(0, 0).buffer(radius, quad_segs=90)
        wall = circle(outline + thickness / 2).difference(circle(outline - thickness / 2))
        thinnest = thickness
    geometry = Geometry(wall)
    # A length of the wall no longer than its thickness has some eight quadratic triangles.
    geometry.create_mesh(mesh_sizes=thinnest**2 / 4)
    section = Section(geometry)
    section.calculate_geometric_properties()
    section.calculate_warping_properties()
    return section


def middle_stresses(case, expect):
    """Our stresses in the middle of the walls: place, normal and shear, tension positive."""
    if case["kind"] == "circular":
        for point in expect["axis_points"]:
            angle = math.radians(point["angle"])
            place = (case["R"] * math.cos(angle), case["R"] * math.sin(angle))
            yield place, [-component for component in point["sigma_true"]]
        return
    vertices, normal = case["vertices"], expect["sigma22_at_vertices"]
    for i, flow in enumerate(expect["shear_flow_start_mid_end"]):
        (x, z), (u, w) = vertices[i], vertices[(i + 1) % len(vertices)]
        length = math.hypot(u - x, w - z)
        shear = flow[1] / case["thickness"][i]
        mean = (normal[i] + normal[(i + 1) % len(vertices)]) / 2
        along = ((u - x) / length, (w - z) / length)
        yield ((x + u) / 2, (z + w) / 2), [-mean, -shear * along[0], -shear * along[1]]


def stresses(section, places):
    """Theirs under the same load, as they want it: forces in the shear centre, moments about the
    centroid, all on the face whose normal is eta."""
    force, moment = [-f for f in FORCE], [-m for m in MOMENT]
    c_zeta, c_xi = section.get_c()
    s_zeta, s_xi = section.get_sc()
    loads = {
        "n": force[1],
        "vx": force[2],
        "vy": force[0],
        # The first pulls at positive y, the second presses at positive x.
        "mxx": moment[2] - c_xi * force[1],
        "myy": moment[0] + c_zeta * force[1],
        "mzz": moment[1] - s_zeta * force[0] + s_xi * force[2],
    }
    found = section.get_stress_at_points([(zeta, xi) for xi, zeta in places], **loads)
    return [(normal, along_y, along_x) for normal, along_x, along_y in found]


def row(case, expect):
    outline = case.get("vertices", case.get("R"))
    thickness = case.get("thickness", case.get("t"))
    section = finite_elements(outline, thickness)
    size = math.sqrt(expect["enclosed_area"]) if "enclosed_area" in expect else 2 * outline
    ixx, iyy, _ = section.get_ic()
    if case["kind"] == "polygon":
        inertias = [(expect["I_zetazeta"], ixx), (expect["I_xixi"], iyy)]
        torsion, walls = expect["J_bredt"], zip(outline, outline[1:] + outline[:1], thickness)
        ratio = max(t / math.dist(a, b) for a, b, t in walls)
        centre = (expect["shear_centre_xi"], expect["shear_centre_zeta"])
    else:
        inertias, torsion = [(expect["I"], ixx), (expect["I"], iyy)], expect["J"]
        ratio, centre = thickness / outline, (0.0, 0.0)
    zeta, xi = section.get_sc()
    ours = list(middle_stresses(case, expect))
    theirs = stresses(section, [place for place, _ in ours])
    largest = max(abs(component) for _, stress in ours for component in stress)
    off = lambda a, b: max(abs(x - y) for x, y in zip(a, b))
    return [
        case["id"],
        f"{ratio:.3f}",
        f"{abs(expect['A'] / section.get_area() - 1):.1e}",
        f"{max(abs(mine / other - 1) for mine, other in inertias):.1e}",
        f"{abs(torsion / section.get_j() - 1):.1e}",
        f"{math.dist(centre, (xi, zeta)) / size:.1e}",
        f"{max(off(mine, other) for (_, mine), other in zip(ours, theirs)) / largest:.1e}",
    ]


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: sections.py NBOOM")
    questions = [question(*case) for case in CASES]
    heads = ["section", "largest t/L", "A", "I", "J", "shear centre", "stress"]
    print("|", " | ".join(heads), "|")
    print("|", " | ".join("---" for _ in heads), "|")
    for case, expect in zip(questions, ask(sys.argv[1], questions)):
        print("|", " | ".join(row(case, expect)), "|", flush=True)


if __name__ == "__main__":
    main()
