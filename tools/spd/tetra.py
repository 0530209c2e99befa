"""Sierpinski's tetrahedron. Size 6: 4096 triangles."""

from spd_scene import Material, Polygon, Scene, add, times

SIZE = 6
RED = Material((1, 0.2, 0.2), 1)
CORNERS = ((1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1))  # of a cube, every other one
FACES = ((0, 1, 3), (0, 2, 1), (0, 3, 2), (1, 2, 3))           # seen from outside counter-clockwise


def grow(scene, centre, half, depth):
    corners = [add(centre, times(c, half)) for c in CORNERS]
    if depth == 1:
        scene.primitives += [Polygon(tuple(corners[i] for i in face), RED) for face in FACES]
        return
    for c in CORNERS:
        grow(scene, add(centre, times(c, half / 2)), half / 2, depth - 1)


def build(size):
    scene = Scene((1.022846, -3.177154, -2.174512), (-0.004103, -0.004103, 0.216539), 45, [(2, -18, -5)],
                  up=(-0.816497, -0.816497, 0.816497))
    grow(scene, (0, 0, 0), 1, size)
    return scene
