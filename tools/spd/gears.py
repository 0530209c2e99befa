"""size^3 meshing gears of 36 teeth; every fifth is of glass. Size 4: 9345 polygons, 128 of them with 144 corners."""

import math

from spd_scene import Material, Polygon, Scene, square

SIZE = 4
TEETH = 36
GROUND = Material((1, 0.85, 0.7), 0.3, 0.6, 37)


def material(ix, iy, iz):
    parts = ((3 * ix + 2 * iy + iz + 1) * 5 / 7, (3 * iy + 2 * iz + ix + 1) * 3 / 7, (3 * iz + 2 * ix + iy + 1) * 2 / 7)
    color = [0.01 + math.fmod(part, 1) for part in parts]
    color = tuple(c / max(color) for c in color)
    if (4 * ix + 2 * iy + iz) % 5 == 0:
        return Material(color, 0.2, transmits=0.8, index=1.1)
    return Material(color, 1)


def face_triangles():
    """Of the outline, four points a tooth: two triangles for the tooth, a fan for the convex disc of the roots."""
    n = 4 * TEETH
    teeth = [t for k in range(0, n, 4) for t in (((k - 1) % n, k, k + 1), ((k - 1) % n, k + 1, k + 2))]
    roots = [i for i in range(n) if i % 4 >= 2]
    return tuple(teeth + [(roots[0], roots[i], roots[i + 1]) for i in range(1, len(roots) - 1)])


TRIANGLES = face_triangles()


def gear(scene, centre, outer, thickness, start, paint):
    x, y, top = centre
    outline = []
    for tooth in range(TEETH):
        for offset, radius in ((-0.19, 0.995), (0.19, 0.995), (0.3, 0.9), (0.7, 0.9)):
            angle = start + (tooth + offset) * 2 * math.pi / TEETH
            outline.append((x + outer * radius * math.cos(angle), y + outer * radius * math.sin(angle)))
    n, bottom = len(outline), top - thickness
    scene.primitives.append(Polygon(tuple((px, py, top) for px, py in outline), paint, TRIANGLES))
    reverse = tuple(tuple(n - 1 - i for i in reversed(t)) for t in TRIANGLES)
    scene.primitives.append(Polygon(tuple((px, py, bottom) for px, py in reversed(outline)), paint, reverse))
    for i in range(n):
        (ax, ay), (bx, by) = outline[i], outline[(i + 1) % n]
        scene.primitives.append(Polygon(((ax, ay, top), (ax, ay, bottom), (bx, by, bottom), (bx, by, top)), paint))


def build(size):
    lights = [(2, 4, 4), (-2, 4, 3), (2, -2.5, 2.5), (-1, -4, 2), (-1.111, -2.121, 2.626)]
    scene = Scene((-1.1, -2.1, 2.6), (0, 0, 0), 45, lights)
    scene.primitives.append(square(-2, 2, -2, 2, 0, GROUND))
    outer = 1 / (size - (size - 1) * 0.05)
    for iz in range(size):
        for iy in range(size):
            for ix in range(size):
                centre = (-1 + outer + ix * 1.9 * outer, -1 + outer + iy * 1.9 * outer, 1 - iz / size)
                start = math.pi / TEETH if (ix + iy + iz) % 2 else 0
                gear(scene, centre, outer, min(0.1, 1 / (2 * size)), start, material(ix, iy, iz))
    return scene
