"""Jacks (E. Enzmann): a cross of three bars with balls at their ends carries eight of half its size. Size 4: 3510 spheres, 1755
cylinders."""

import math

from spd_scene import Cone, Material, Scene, Sphere, add, rotate, times

SIZE = 4
PAINT = Material((0.737, 0.561, 0.561), 0.7, 0.7, 20, index=1)
BAR, BALL = 0.1, 0.2  # radii, of half a bar's length
OFFSET = 0.5 / 0.75   # of the smaller ones, the same


def turned(v):
    return rotate(rotate(v, (0, 1, 0), math.radians(-20)), (1, 0, 0), math.radians(-30))


def grow(scene, centre, scale, depth):
    """`scale` is half the length of a bar."""
    axes = [turned(v) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    at = turned(centre)
    for axis in axes:
        ends = [add(at, times(axis, scale * sign)) for sign in (-1, 1)]
        scene.primitives.append(Cone(ends[0], BAR * scale, ends[1], BAR * scale, PAINT))
        scene.primitives += [Sphere(end, BALL * scale, PAINT) for end in ends]
    if depth == 1:
        return
    step = OFFSET * scale
    for sx in (-step, step):
        for sy in (-step, step):
            for sz in (-step, step):
                grow(scene, add(centre, (sx, sy, sz)), scale / 2, depth - 1)



def build(size):
    scene = Scene((0, 0, -8), (0, 0, 0), 25, [(-10, 3, -20)], up=(0, 1, 0), background=(0.2, 0.05, 0.2), resolution=256)
    grow(scene, (0, 0, 0), 0.75, size)
    return scene
