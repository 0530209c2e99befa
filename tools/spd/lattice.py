"""A cubic lattice of mirroring balls and bars between them (A. Costa). Size 12: 2197 spheres, 6084 cylinders."""

import math

from spd_scene import Cone, Material, Scene, Sphere, add

SIZE = 12
BALL = Material((0.9, 0.9, 0.9), 0.5, 0.5, 37)
BARS = (Material((0.9, 0.1, 0.1), 0.99), Material((0.1, 0.9, 0.1), 0.99), Material((0.1, 0.1, 0.9), 0.99))


def build(size):
    x = (size // 2 + 0.5) / size
    lights = [(2, 0.5, 0.5), (-1, 0.5, 0.5), (0.5, 2, 0.5), (0.5, -1, 0.5), (0.5, 0.5, 2), (0.5, 0.5, -1)]
    scene = Scene((x, 1, 1 - 1 / (2 * size)), (x, -1, -1 - 1 / (2 * size)), 60, lights, up=(0.2, 1, 0))
    ball, bar = 1 / (4 * size), 1 / (16 * size)
    hidden = ball * (1 - math.sqrt(1 / 4)) * 0.99  # of a bar, inside each of its balls
    for i in range(size + 1):
        for j in range(size + 1):
            for k in range(size + 1):
                place = (i / size, j / size, k / size)
                scene.primitives.append(Sphere(place, ball, BALL))
                for axis, index in enumerate((i, j, k)):
                    if index == size:
                        continue
                    ends = [add(place, tuple(d if a == axis else 0 for a in range(3))) for d in (hidden, 1 / size - hidden)]
                    scene.primitives.append(Cone(ends[0], bar, ends[1], bar, BARS[axis]))
    return scene
