"""Sphereflake: every sphere carries nine of a third its radius. Size 4: 7381 spheres."""

import math

from spd_scene import Material, Scene, Sphere, add, cross, length, rotate, square, times, unit

SIZE = 4
FLOOR = Material((1, 0.75, 0.33), 0.8)
BALL = Material((1, 0.9, 0.7), 0.5, 0.5, 37)


def nine_directions():
    """Three about the pole z, three copies turned about it."""
    tilt = math.asin(2 / math.sqrt(6))
    three = [unit(v) for v in ((1, 1, 0), (1, 0, -1), (0, 1, -1))]
    three = [rotate(v, unit((1, -1, 0)), tilt) for v in three]
    return [rotate(v, (0, 0, 1), math.radians(120 * k)) for k in range(3) for v in three]


def from_pole(direction, v):
    """`v` under the shortest turn that takes z to `direction`."""
    if direction[2] >= 0.9999:
        return v
    if direction[2] <= -0.9999:
        return (-v[0], v[1], -v[2])
    axis = cross((0, 0, 1), direction)
    return rotate(v, times(axis, 1 / length(axis)), math.acos(direction[2]))


def grow(scene, centre, radius, direction, depth, nine):
    scene.primitives.append(Sphere(centre, radius, BALL))
    if depth == 0:
        return
    for v in nine:
        child = from_pole(direction, v)
        grow(scene, add(centre, times(child, radius * 4 / 3)), radius / 3, child, depth - 1, nine)


def build(size):
    scene = Scene((2.1, 1.3, 1.7), (0, 0, 0), 45, [(4, 3, 2), (1, -4, 4), (-3, 1, 5)])
    scene.primitives.append(square(-12, 12, -12, 12, -0.5, FLOOR))
    grow(scene, (0, 0, 0), 0.5, (0, 0, 1), size, nine_directions())
    return scene
