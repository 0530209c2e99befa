#!/usr/bin/env python3
"""The primitives of our generators, materials included, against the outputs of the original programs, as sets.

    spd_nff_test.py [scene ...]

Both ways one to one, to the six digits of those outputs. Exit status 77: no outputs at hand.
"""

import gzip
import importlib
import itertools
import os
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "spd"))
sys.dont_write_bytecode = True
from spd_scene import Cone, Polygon, Sphere, cross, dot, sub  # noqa: E402

FILES = {"balls": "balls", "gears": "gears", "jacks": "jacks_s4", "lattice": "lattice", "mount": "mount", "rings": "rings",
         "shells": "shells", "teapot": "teapot_s12", "tetra": "tetra", "tree": "tree"}
DIGITS = 6e-6  # of a value: half of its sixth digit at worst
EXACT = 6e-6   # and of a unit: what cancels in differences of printed points


def area_vector(points):
    """Twice the area, along the front's normal: Newell's sum."""
    total = (0, 0, 0)
    for a, b in zip(points[1:], points[2:]):
        n = cross(sub(a, points[0]), sub(b, points[0]))
        total = tuple(t + x for t, x in zip(total, n))
    return total


def described(primitive):
    """(kind, points that may come in any order, numbers, front)"""
    if isinstance(primitive, Sphere):
        return "s", (primitive.centre,), (primitive.radius,), None
    if isinstance(primitive, Cone):
        ends = sorted([(primitive.base_radius, primitive.base), (primitive.apex_radius, primitive.apex)], key=lambda e: -e[0])
        return "c", (ends[0][1], ends[1][1]), (ends[0][0], ends[1][0]), None
    return f"p{len(primitive.points)}", tuple(primitive.points), (), area_vector(primitive.points)


def numbers_of(material):
    return (*material.color, material.diffuse, material.specular, material.exponent(), material.transmits, material.index)


def read_nff(path):
    """(view, lights, [((kind, points, numbers, front), material numbers)])"""
    view, lights, found, material = {}, [], [], None
    with gzip.open(path, "rt") as lines:
        for line in lines:
            word, *rest = line.split()
            values = tuple(float(x) for x in rest)
            if word in ("from", "at", "up", "angle", "resolution", "b"):
                view[word] = values
            elif word == "l":
                lights.append(values)
            elif word == "f":
                material = values
            elif word == "s":
                found.append((("s", (values[:3],), values[3:], None), material))
            elif word == "c":
                ends = sorted([(values[3], values[:3]), (values[7], values[4:7])], key=lambda e: -e[0])
                found.append((("c", (ends[0][1], ends[1][1]), (ends[0][0], ends[1][0]), None), material))
            elif word in ("p", "pp"):
                points = tuple(tuple(float(x) for x in next(lines).split()[:3]) for _ in range(int(values[0])))
                found.append(((f"p{len(points)}", points, (), area_vector(points)), material))
    return view, lights, found


def close(a, b):
    return all(abs(x - y) <= DIGITS * abs(x) + EXACT for x, y in zip(a, b)) and len(a) == len(b)


def same_points(a, b, ordered):
    if ordered:
        return all(close(p, q) for p, q in zip(a, b))
    left = list(b)
    for p in a:
        match = next((q for q in left if close(p, q)), None)
        if match is None:
            return False
        left.remove(match)
    return True


def same(ours, theirs):
    (kind, points, numbers, front), paint = ours
    (other_kind, other_points, other_numbers, other_front), other_paint = theirs
    if kind != other_kind or not close(numbers, other_numbers):
        return False
    if not all(abs(x - y) <= 1e-5 * max(1, abs(x)) for x, y in zip(paint[:7], other_paint[:7])):
        return False
    if paint[6] > 0 and abs(paint[7] - other_paint[7]) > 1e-5:  # an index matters where something shines through
        return False
    equal_radii = kind == "c" and numbers[0] == numbers[1]
    if not same_points(points, other_points, kind == "c" and not equal_radii):
        return False
    return front is None or dot(front, other_front) > 0


CELL = 1e-3


def unmatched(ours, theirs):
    """How many of ours have no partner; partners are looked for where their centroids fall into neighbouring cells."""
    def centroid(item):
        points = item[0][1]
        return tuple(sum(p[axis] for p in points) / len(points) for axis in range(3))

    cells = defaultdict(list)
    for item in theirs:
        cells[tuple(int(c // CELL) for c in centroid(item))].append(item)
    missing = []
    for item in ours:
        place = centroid(item)
        ranges = [sorted({int((c - 2e-4) // CELL), int((c + 2e-4) // CELL)}) for c in place]
        for cell in itertools.product(*ranges):
            match = next((i for i, other in enumerate(cells[cell]) if same(item, other)), None)
            if match is not None:
                del cells[cell][match]
                break
        else:
            missing.append(item)
    return missing


def cut_faults(scene):
    """Polygons whose triangles do not cover them: the areas must add up, none turned over."""
    faults = 0
    for primitive in scene.primitives:
        if not isinstance(primitive, Polygon):
            continue
        whole = area_vector(primitive.points)
        total = (0, 0, 0)
        for i, j, k in primitive.cut():
            part = area_vector([primitive.points[i], primitive.points[j], primitive.points[k]])
            faults += dot(part, whole) <= 0
            total = tuple(a + b for a, b in zip(total, part))
        faults += dot(sub(total, whole), sub(total, whole)) > 1e-18 * dot(whole, whole)
    return faults


def compare(name, path):
    module = importlib.import_module(name)
    scene = module.build(module.SIZE)
    view, lights, theirs = read_nff(path)
    ours = [(described(p), numbers_of(p.material)) for p in scene.primitives]
    expected = {"from": scene.eye, "at": scene.at, "up": scene.up, "angle": (scene.angle,), "b": scene.background,
                "resolution": (scene.resolution,) * 2}
    faults = [f"{key} is {view[key]}" for key, value in expected.items() if not close(value, view[key])]
    faults += [] if len(lights) == len(scene.lights) and all(map(close, scene.lights, lights)) else ["other lights"]
    if len(ours) != len(theirs):
        faults.append(f"{len(ours)} primitives, not {len(theirs)}")
    missing = unmatched(ours, theirs)
    if missing:
        faults.append(f"{len(missing)} of {len(ours)} primitives are not in {path.name}, the first {missing[0]}")
    if cut_faults(scene):
        faults.append(f"{cut_faults(scene)} polygons are not covered by their triangles")
    return len(ours), faults


def main(names):
    shared = Path(os.environ.get("LANECAST_SHARED", ROOT.parent / "shared")) / "assets" / "spd_nff"
    if not shared.is_dir():
        print("skipped: spd_nff, the outputs of the original programs, are not here")
        return 77
    failed = False
    for name in names or sorted(FILES):
        count, faults = compare(name, shared / f"{FILES[name]}.nff.gz")
        print(f"{name}: {count} primitives, " + ("as the original's" if not faults else "; ".join(faults)[:600]))
        failed |= bool(faults)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
