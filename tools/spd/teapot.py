"""Newell's teapot on a checkerboard, its 32 patches cut into size x size quads each. Size 12: 9120 triangles."""

from spd_scene import Material, Polygon, Scene
from teapot_patches import HALVES, POINTS, QUARTERS

SIZE = 12
POT = Material((1, 0.5, 0.1), 0.75, 0.25, 37)
BOARD = (Material((0.5, 0.5, 0.5), 0.5, 0.5, 30), Material((1, 1, 1), 0.5, 0.5, 30))


def patches():
    """All 32, wound alike: a mirrored one has its rows reversed."""
    def mirrored(rows):
        return [[(x, -y, z) for x, y, z in reversed(row)] for row in rows]

    def turned(rows):
        return [[(-x, -y, z) for x, y, z in row] for row in rows]

    for indices in QUARTERS + HALVES:
        rows = [[POINTS[i] for i in indices[k:k + 4]] for k in range(0, 16, 4)]
        both = [rows, mirrored(rows)]
        yield from both
        if indices in QUARTERS:
            yield from (turned(rows) for rows in both)


def bezier(points, t):
    s = 1 - t
    weights = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
    return tuple(sum(w * p[axis] for w, p in zip(weights, points)) for axis in range(3))


def add_patch(scene, rows, n):
    steps = [i / n for i in range(n + 1)]
    grid = [[bezier([bezier(row, u) for row in rows], v) for u in steps] for v in steps]
    for j in range(n):
        for i in range(n):
            a, b, c, d = grid[j][i], grid[j][i + 1], grid[j + 1][i + 1], grid[j + 1][i]
            for triangle in ((a, b, c), (c, d, a)):
                if len({tuple(round(x, 9) for x in p) for p in triangle}) == 3:  # not at a pole of lid or bottom
                    scene.primitives.append(Polygon(triangle, POT))


def build(size):
    scene = Scene((4.86, 7.2, 5.4), (0, 0, 0), 45, [(-3.1, 9.8, 12.1), (11.3, 5.1, 8.8)], one_sided=False)
    edge = 8 / size
    for i in range(size):
        for j in range(size):
            x, y = -4 + i * edge, -4 + j * edge
            corners = ((x, y, 0), (x + edge, y, 0), (x + edge, y + edge, 0), (x, y + edge, 0))
            scene.primitives.append(Polygon(corners, BOARD[(i + j) % 2]))
    for rows in patches():
        add_patch(scene, rows, size)
    return scene
