"""A tree of cones with balls at the joints (after Aono and Kunii). Size 11: 4095 cones, 4095 spheres."""

import math

from spd_scene import Cone, Material, Scene, Sphere, add, rotate, square, times

SIZE = 11
FIELD = Material((0.2, 0.7, 0.2), 1)
BARK = Material((0.55, 0.4, 0.2), 1)
THINNER = 0.67            # from base to tip, and from branch to branch
BRANCHES = ((40, 90, 0.65), (25, 230, 0.70))  # degrees off the parent, degrees about it, length


def local(v, lean, turn, shorter):
    """From a branch's coordinates to its parent's: turned, shortened, put on the parent's tip."""
    v = rotate(rotate(v, (1, 0, 0), math.radians(lean)), (0, 0, 1), math.radians(turn))
    return add(times(v, shorter), (0, 0, 1))


def grow(scene, path, scale, depth):
    """`path`: the branch and its ancestors, from the inside out."""
    def to_world(v):
        for branch in path:
            v = local(v, *branch)
        return v

    tip, tip_radius = to_world((0, 0, 1)), 0.15 * scale * THINNER
    scene.primitives += [Cone(to_world((0, 0, 0)), 0.15 * scale, tip, tip_radius, BARK), Sphere(tip, tip_radius, BARK)]
    if depth > 0:
        for branch in BRANCHES:
            grow(scene, [branch] + path, scale * THINNER, depth - 1)


def build(size):
    lights = [(-5, 5, 50), (30, -30, 30), (-40, -30, 20), (10, 30, 40), (-30, 40, 10), (50, 25, 20), (-10, -60, 30)]
    scene = Scene((4.5, 0.4, 2), (0, 0, 1.5), 45, lights)
    scene.primitives.append(square(-50, 50, -50, 50, 0, FIELD))
    grow(scene, [], 1, size)
    return scene
