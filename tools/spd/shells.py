"""A sea shell of overlapping spheres (after C. Pickover). Size 5: 5761 spheres."""

import math

from spd_scene import Material, Scene, Sphere

SIZE = 5
SHELL = Material((1, 0.8, 0.4), 0.8, 0.2, 10, index=1)


def build(size):
    scene = Scene((-6, -60, 35), (0, 8, -15), 45, [(-100, -100, 100)])
    steps = 180 << size
    for i in range(-2 * steps // 3, steps // 3 + 1):
        angle = 18 * math.pi * i / steps
        r = math.exp(0.15 * angle)
        scene.primitives.append(Sphere((r * math.sin(angle), r * math.cos(angle), -2 * r), r, SHELL))
    return scene
