"""A fractal mountain with four balls of glass above. Size 6: 8192 triangles. The heights come of the database's own random numbers,
so that everybody has the same mountain; its classic hash, kept for that, repeats itself above size 7."""

import math

from spd_scene import Material, Polygon, Scene, Sphere, add, rotate, times, unit

SIZE = 6
GLASS = Material((1, 1, 1), 0.1, 0.1, 6.7, 0.9, 1.5)
ROCK = Material((0.5, 0.45, 0.35), 1)
FRACTAL_DIMENSION = 2.2
SEED = 21


def gaussian(seed):
    """Polar method over a linear congruential generator started at `seed`."""
    state = seed

    def draw():
        nonlocal state
        state = (28411 + 8121 * state) % 134456
        return 2 * state / 134456 - 1

    while True:
        a, b = draw(), draw()
        r = a * a + b * b
        if 0 < r < 1:
            return a * math.sqrt(-2 * math.log(r) / r)


def heights(size):
    """By midpoint displacement: z of the grid point (x, y), both 0 .. 2^size."""
    ratio = 2 / math.exp(math.log(2) / (FRACTAL_DIMENSION - 1))
    rough = math.sqrt(ratio * ratio - 1)
    n = 1 << size

    def noise(x, y):
        return gaussian(SEED + ((x << (23 - size)) + (y << (15 - size)) + (x << (7 - size)) if size <= 7 else
                                mixed(x, y)) % 65536)

    z = {(x, y): 0.0 for x in (0, n) for y in (0, n)}
    cells = n
    while cells > 1:
        half, side = cells // 2, cells / n  # `side`: half the edge in scene units
        for y in range(0, n + 1, cells):
            for x in range(half, n, cells):
                z[x, y] = (z[x - half, y] + z[x + half, y]) / 2 + side * rough * noise(x, y)
                z[y, x] = (z[y, x - half] + z[y, x + half]) / 2 + side * rough * noise(y, x)
        for y in range(half, n, cells):
            for x in range(half, n, cells):
                mean = sum(z[x + dx, y + dy] for dx in (-half, half) for dy in (-half, half)) / 4
                z[x, y] = mean + math.sqrt(2) * side * rough * noise(x, y)
        cells = half
    return z


def mixed(x, y):
    """A hash for sizes above 7, where the classic one has no bits left: products with odd constants, folded three times."""
    h = (x * 0x9E3779B1 ^ y * 0x85EBCA77) & 0xffffffff
    for shift, factor in ((15, 0x2C1B3C6D), (12, 0x297A2D39), (15, 1)):
        h = (h ^ h >> shift) * factor & 0xffffffff
    return h


def build(size):
    scene = Scene((-1.6, 1.6, 1.7), (0, 0, 0), 45, [(-100, -100, 100)])
    middle, radius = (-0.8, 0.8, 1), 0.17
    top = (0, 0, radius * math.sqrt(1.5))
    down = rotate(top, unit((1, 1, 0)), math.acos(-1 / 3))
    offsets = [top] + [rotate(down, (0, 0, 1), math.radians(120 * k)) for k in range(3)]
    scene.primitives += [Sphere(add(middle, offset), radius, GLASS) for offset in offsets]
    n, z = 1 << size, heights(size)

    def point(x, y):
        return add(times((x, y, 0), 2 / n), (-1, -1, z[x, y]))

    for y in range(n):
        for x in range(n):
            corners = point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)
            scene.primitives.append(Polygon((corners[0], corners[1], corners[2]), ROCK))
            scene.primitives.append(Polygon((corners[2], corners[3], corners[0]), ROCK))
    return scene
