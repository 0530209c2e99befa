"""A pyramid of objects, each of six interlocking pentagonal rings. Size 7: 4200 spheres, 4200 cylinders."""

import math

from spd_scene import Cone, Material, Polygon, Scene, Sphere, add, rotate

SIZE = 7
WALL = Material((1, 1, 1), 1)
COLORS = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 1), (1, 0, 1), (1, 1, 0))
RADIUS = 0.07412  # of balls and bars


def pentagons():
    flat = [rotate((1 / (1 + RADIUS), 0, 0), (0, 0, 1), math.radians(72 * i)) for i in range(5)]
    tilt = 2 * math.acos(math.cos(math.radians(60)) / math.sin(math.radians(36)))
    tilted = [rotate(v, (1, 0, 0), tilt) for v in flat]
    return [flat] + [[rotate(v, (0, 0, 1), math.radians(36 + 72 * k)) for v in tilted] for k in range(5)]


def build(size):
    s = 1 / math.sin(math.radians(22.5))
    scene = Scene((-1, -s, 0.5), (-1, 1 - s, 0.5), 45, [(3, -s, 3), (-4, -s, 1), (2, -s, -4)])
    y = s * (size + 1)
    half = 1.01 * (y + s) * math.tan(math.radians(22.5))
    x0, x1, z0, z1 = -1 - half, -1 + half, 0.5 - half, 0.5 + half
    scene.primitives.append(Polygon(((x1, y, z1), (x0, y, z1), (x0, y, z0), (x1, y, z0)), WALL))
    rings = pentagons()
    for d in range(size):
        for i in range(d + 1):
            for j in range(d + 1):
                place = (2 * i - d, s * (d + 1), 2 * j - d)
                for ring, color in zip(rings, COLORS):
                    paint = Material(color, 0.5, 0.2, 37)
                    for k in range(5):
                        a, b = add(place, ring[k]), add(place, ring[(k + 1) % 5])
                        scene.primitives += [Cone(a, RADIUS, b, RADIUS, paint), Sphere(a, RADIUS, paint)]
    return scene
