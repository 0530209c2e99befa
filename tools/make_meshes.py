#!/usr/bin/env python3
"""Writes the meshes of scenes/: the same bytes on every machine.

    tools/make_meshes.py [directory]        default: scenes/meshes beside this script

  knot.ply                     a trefoil of a twisted band
  rose_tracery.ply             the stone of a rose window of twelve petals, disc of radius 3 in the plane z = 0
  rose_<colour>.ply            its panes, one file per colour of glass
  hall.obj, hall.mtl           walls of the hall around it; the back wall has a round opening
  floor.obj, floor.mtl         octagonal tiles with square insets
  checkerboard.obj, .mtl       48 x 48 unit squares
  gem.ply                      a brilliant cut; ASCII
  dodecahedron.obj, .mtl       in six colours: materials, polygons, negative indices

Lengths are in scene units, y is up, triangles turn counter-clockwise seen from outside. Only the standard library is used.
"""
import math
import pathlib
import struct
import sys

TAU = 2 * math.pi


# ---- vectors

def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, k):
    return (a[0] * k, a[1] * k, a[2] * k)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return times(a, 1 / math.sqrt(dot(a, a)))


def polar(r, angle, z=0.0):
    return (r * math.cos(angle), r * math.sin(angle), z)


# ---- files

class Mesh:
    """Points and polygons, a material name per polygon."""

    def __init__(self):
        self.points, self.faces, self.materials = [], [], []

    def point(self, p):
        self.points.append(p)
        return len(self.points) - 1

    def face(self, *points, material=""):
        """A polygon of points of its own."""
        self.faces.append([self.point(p) for p in points])
        self.materials.append(material)

    def strip(self, left, right):
        """Quads between two lines of points, counter-clockwise where `right` is to the right when walking along them."""
        a, b = [self.point(p) for p in left], [self.point(p) for p in right]
        for i in range(len(a) - 1):
            quad = [a[i], b[i], b[i + 1], a[i + 1]]
            near = [math.dist(self.points[quad[k]], self.points[quad[k - 1]]) < 1e-6 for k in range(4)]
            if sum(near) < 2:  # where the lines meet, a triangle
                self.faces.append([corner for corner, again in zip(quad, near) if not again])
                self.materials.append("")


def rounded(p):
    """So that the last bit of this machine's sine is not seen in the files."""
    return tuple(round(c, 6) + 0.0 for c in p)


def write_ply(path, mesh, comment, binary=True):
    """Polygons as they are; 16-bit indices where they suffice."""
    index, code = ("ushort", "H") if len(mesh.points) <= 65536 else ("uint", "I")
    header = (f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\ncomment {comment}\n"
              f"element vertex {len(mesh.points)}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {len(mesh.faces)}\nproperty list uchar {index} vertex_indices\nend_header\n")
    if binary:
        body = b"".join(struct.pack("<3f", *rounded(p)) for p in mesh.points)
        body += b"".join(struct.pack(f"<B{len(f)}{code}", len(f), *f) for f in mesh.faces)
    else:
        lines = [" ".join(f"{c:.6f}" for c in rounded(p)) for p in mesh.points]
        lines += [" ".join(map(str, [len(f)] + f)) for f in mesh.faces]
        body = ("\n".join(lines) + "\n").encode()
    path.write_bytes(header.encode() + body)


def write_obj(path, mesh, comment, colours, relative=False):
    """`colours`: material name -> diffuse colour; the ambient one is the same. Equal points are written once."""
    lines = [f"# {comment}", f"mtllib {path.stem}.mtl"]
    number, written = {}, {}
    for p in mesh.points:
        text = " ".join(f"{c:.5g}" for c in rounded(p))
        if text not in written:
            written[text] = len(written) + 1
            lines.append("v " + text)
        number[len(number)] = written[text]
    shift = len(written) + 1 if relative else 0
    current = None
    for face, material in sorted(zip(mesh.faces, mesh.materials), key=lambda fm: fm[1]):
        if material != current:
            current = material
            lines.append(f"usemtl {material}")
        lines.append("f " + " ".join(str(number[i] - shift) for i in face))
    path.write_text("\n".join(lines) + "\n")
    mtl = [f"# of {path.name}"]
    for name, colour in colours.items():
        rgb = " ".join(f"{c:g}" for c in colour)
        mtl += [f"newmtl {name}", f"Ka {rgb}", f"Kd {rgb}"]
    path.with_suffix(".mtl").write_text("\n".join(mtl) + "\n")


# ---- the knot

def knot(around=580, across=80):
    """A (2, 3) torus knot whose section is a rounded band, turned once on its way; it stands on y = 0."""
    def centre(t):
        r = 1.0 + 0.42 * math.cos(3 * t)
        return (r * math.cos(2 * t), r * math.sin(2 * t), 0.52 * math.sin(3 * t))

    mesh = Mesh()
    low = 0.0
    for i in range(around):
        t = TAU * i / around
        ahead = unit(sub(centre(t + 1e-4), centre(t - 1e-4)))
        side = unit(cross(ahead, unit(centre(t))))  # no tangent of this knot points away from the origin
        up = cross(side, ahead)
        turn = 3 * t + 0.4
        for j in range(across):
            s = TAU * j / across
            # a superellipse of exponent 2.6: flatter than an ellipse, without edges
            c, d = math.cos(s), math.sin(s)
            u = 0.31 * math.copysign(abs(c) ** (2 / 2.6), c)
            v = 0.17 * math.copysign(abs(d) ** (2 / 2.6), d)
            a, b = u * math.cos(turn) - v * math.sin(turn), u * math.sin(turn) + v * math.cos(turn)
            p = add(centre(t), add(times(side, a), times(up, b)))
            low = min(low, p[1])
            mesh.point(p)
    mesh.points = [(x, y - low, z) for x, y, z in mesh.points]
    for i in range(around):
        for j in range(across):
            k, n = (i + 1) % around, (j + 1) % across
            mesh.faces.append([i * across + j, k * across + j, k * across + n, i * across + n])
    return mesh


# ---- the rose window

SECTORS = 12
ROSE_RADIUS = 3.0
DEPTH = 0.07  # half the thickness of the stone


def half_width_petal(r):
    """Half the angle of the panes on a sector's axis: a pointed petal, then a small round light."""
    if 0.62 < r < 1.78:
        s = (r - 0.62) / 1.16
        return 0.25 * (s ** 0.55 * (1 - s) ** 0.75) / (0.423 ** 0.55 * 0.577 ** 0.75) * min(1.0, 0.55 + 0.42 / r)
    if 2.0 < r < 2.36:
        return math.sqrt(0.18 ** 2 - (r - 2.18) ** 2) / r
    return 0.0


def half_width_between(r):
    """Half the angle of the round panes between two sectors."""
    if 1.56 < r < 2.28:
        x = (r * r + 1.92 ** 2 - 0.36 ** 2) / (2 * r * 1.92)  # a circle of radius 0.36 about r = 1.92
        return math.acos(min(1.0, x))
    return 0.0


def radii(a, b, n):
    """n steps from a to b, denser at the ends, where round panes close."""
    return [a + (b - a) * (1 - math.cos(math.pi * i / n)) / 2 for i in range(n + 1)]


def extrude(mesh, left, right):
    """A slab of stone between two lines in the plane z = 0, with its front, back and both rims."""
    def front(line):
        return [(x, y, DEPTH) for x, y, _ in line]

    def back(line):
        return [(x, y, -DEPTH) for x, y, _ in line]

    mesh.strip(front(left), front(right))
    mesh.strip(back(right), back(left))
    mesh.strip(front(right), back(right))
    mesh.strip(back(left), front(left))


def arc(r, a, b, n, about=(0.0, 0.0, 0.0)):
    return [add(about, polar(r, a + (b - a) * i / n)) for i in range(n + 1)]


def ring(mesh, r0, r1, n=192, about=(0.0, 0.0, 0.0)):
    extrude(mesh, arc(r0, 0, TAU, n, about), arc(r1, 0, TAU, n, about))


def bar(mesh, r0, r1, a, b, n=1):
    """A piece of a ring between the angles a < b, rims on all four sides."""
    extrude(mesh, arc(r0, a, b, n), arc(r1, a, b, n))
    for t, order in ((a, 1), (b, -1)):
        rim = [[polar(r0, t, z), polar(r1, t, z)] for z in (DEPTH, -DEPTH)]
        mesh.strip(*rim[::order])


def rose():
    """The tracery and the panes by colour."""
    stone = Mesh()
    panes = {name: Mesh() for name in ("amber", "red", "blue", "green", "violet")}
    half = TAU / SECTORS / 2
    breaks = [0.56, 0.62, 1.56, 1.78, 2.0, 2.28, 2.36, 2.46]
    lines = sorted({r for a, b in zip(breaks, breaks[1:]) for r in radii(a, b, 16)})
    for sector in range(SECTORS):
        axis = sector * 2 * half + math.pi / 2
        for sign in (1, -1):
            inner = [polar(r, axis + sign * half_width_petal(r)) for r in lines]
            outer = [polar(r, axis + sign * (half - half_width_between(r))) for r in lines]
            extrude(stone, *((outer, inner) if sign > 0 else (inner, outer)))

        def pane(mesh, a, b, width, about):
            rs = radii(a, b, 24)
            mesh.strip([polar(r, about + width(r)) for r in rs], [polar(r, about - width(r)) for r in rs])

        odd = sector % 2 == 1
        pane(panes["red" if odd else "blue"], 0.62, 1.20, half_width_petal, axis)
        pane(panes["amber" if odd else "violet"], 1.25, 1.78, half_width_petal, axis)
        bar(stone, 1.20, 1.25, axis - half_width_petal(1.22), axis + half_width_petal(1.22))
        pane(panes["amber"], 2.0, 2.36, half_width_petal, axis)
        middle = polar(1.92, axis + half)
        panes["green" if odd else "red"].strip(arc(0.19, 0, TAU, 48, middle), arc(0.36, 0, TAU, 48, middle))
        panes["blue" if odd else "amber"].strip(arc(0.0, 0, TAU, 48, middle), arc(0.155, 0, TAU, 48, middle))
        ring(stone, 0.155, 0.19, 48, middle)

    # the eye: six wedges around a round light
    ring(stone, 0.50, 0.56)
    ring(stone, 0.20, 0.25)
    panes["amber"].strip(arc(0.0, 0, TAU, 48), arc(0.20, 0, TAU, 48))
    for i in range(6):
        a, b = TAU * i / 6 + 0.06, TAU * (i + 1) / 6 - 0.06
        panes["blue" if i % 2 else "red"].strip(arc(0.25, a, b, 12), arc(0.50, a, b, 12))
        bar(stone, 0.25, 0.50, b, b + 0.12, 2)

    # the border: 48 panes in a ring
    ring(stone, 2.43, 2.50)  # over the chords at 2.46
    ring(stone, 2.74, ROSE_RADIUS)
    for i in range(48):
        a, b = TAU * i / 48 + 0.012, TAU * (i + 1) / 48 - 0.012
        panes[("blue", "violet", "blue", "green")[i % 4]].strip(arc(2.50, a, b, 4), arc(2.74, a, b, 4))
        bar(stone, 2.50, 2.74, b, b + 0.024)
    return stone, panes


# ---- the hall

HALL_X, HALL_TOP, HALL_BACK, HALL_FRONT = 6.6, 10.4, -7.0, 17.0
WINDOW_Y = 5.4


def hall():
    """Walls and ceiling seen from inside. The opening in the back wall is as wide as the rose and half a unit deep."""
    mesh = Mesh()

    def quad(a, b, c, d, material):
        mesh.face(a, b, c, d, material=material)

    corners = [math.atan2(y - WINDOW_Y, x) % TAU for x in (-HALL_X, HALL_X) for y in (0.0, HALL_TOP)]
    angles = sorted([TAU * i / 192 for i in range(192)] + corners)
    for a, b in zip(angles, angles[1:] + [TAU]):
        def circle(width, height=0.0, ends=(a, b)):
            return [add(polar(ROSE_RADIUS + width, t), (0, WINDOW_Y, HALL_BACK + height)) for t in ends]

        hole, crest, lip, edge = circle(0), circle(0.14, 0.14), circle(0.28), [edge_of_wall(t) for t in (a, b)]
        quad(hole[0], edge[0], edge[1], hole[1], "wall")
        # a frame of two slopes, and the reveal behind it
        quad(hole[0], crest[0], crest[1], hole[1], "trim")
        quad(crest[0], lip[0], lip[1], crest[1], "trim")
        quad(hole[1], hole[0], add(hole[0], (0, 0, -0.5)), add(hole[1], (0, 0, -0.5)), "trim")

    for side in (-1, 1):
        x = side * HALL_X
        wall = [(x, 0, HALL_BACK), (x, 0, HALL_FRONT), (x, HALL_TOP, HALL_FRONT), (x, HALL_TOP, HALL_BACK)]
        quad(*(wall if side < 0 else wall[::-1]), "wall")
        for y0, y1, out in ((0, 0.5, 0.16), (7.3, 7.5, 0.16)):  # skirting and cornice
            box(mesh, (x - out, y0, HALL_BACK), (x + out, y1, HALL_FRONT), "trim")
    x, y, z0, z1 = HALL_X, HALL_TOP, HALL_BACK, HALL_FRONT
    quad((-x, y, z0), (-x, y, z1), (x, y, z1), (x, y, z0), "wall")
    quad((-x, 0, z1), (x, 0, z1), (x, y, z1), (-x, y, z1), "wall")
    box(mesh, (-HALL_X, 0, HALL_BACK), (HALL_X, 0.5, HALL_BACK + 0.16), "trim")
    return mesh


def edge_of_wall(t):
    """Where the direction t from the window's centre meets the edge of the back wall."""
    c, s = math.cos(t), math.sin(t)
    across = HALL_X / abs(c) if abs(c) > 1e-9 else math.inf
    along = ((HALL_TOP - WINDOW_Y) if s > 0 else WINDOW_Y) / abs(s) if abs(s) > 1e-9 else math.inf
    k = min(across, along)
    return (k * c, WINDOW_Y + k * s, HALL_BACK)


def box(mesh, lo, hi, material):
    x, y, z = zip(lo, hi)
    p = [[[(x[i], y[j], z[k]) for k in (0, 1)] for j in (0, 1)] for i in (0, 1)]
    mesh.face(p[0][0][0], p[0][0][1], p[0][1][1], p[0][1][0], material=material)
    mesh.face(p[1][0][0], p[1][1][0], p[1][1][1], p[1][0][1], material=material)
    mesh.face(p[0][0][0], p[1][0][0], p[1][0][1], p[0][0][1], material=material)
    mesh.face(p[0][1][0], p[0][1][1], p[1][1][1], p[1][1][0], material=material)
    mesh.face(p[0][0][0], p[0][1][0], p[1][1][0], p[1][0][0], material=material)
    mesh.face(p[0][0][1], p[1][0][1], p[1][1][1], p[0][1][1], material=material)


def floor(pitch=1.1, inset=0.30, joint=0.012):
    """Octagons and squares in y = 0 over the hall's area, with joints between them."""
    mesh = Mesh()
    x, y, z0, z1 = HALL_X, -0.004, HALL_BACK, HALL_FRONT
    mesh.face((-x, y, z0), (-x, y, z1), (x, y, z1), (x, y, z0), material="joint")
    h, c = pitch / 2 - joint, inset * pitch  # c: what the squares cut from each corner
    for i in range(-6, 7):
        for k in range(-7, 17):
            x, z = i * pitch, k * pitch
            if not (abs(x) <= HALL_X and HALL_BACK <= z <= HALL_FRONT):
                continue
            a = h - c
            octagon = [(-h, -a), (-h, a), (-a, h), (a, h), (h, a), (h, -a), (a, -h), (-a, -h)]
            mesh.face(*[(x + u, 0.0, z + v) for u, v in octagon], material="light" if (i + k) % 2 else "warm")
            s = c - joint / 2
            square = [(0, -s), (-s, 0), (0, s), (s, 0)]
            mesh.face(*[(x + pitch / 2 + u, 0.0, z + pitch / 2 + v) for u, v in square], material="dark")
    return mesh


# ---- small things

def gem():
    """A round brilliant of radius 1, its girdle at y = 0."""
    mesh = Mesh()
    crown, table, depth = 0.34, 0.53, 0.86

    def around(r, y, n, shift=0.0):
        return [(r * math.cos(TAU * (i + shift) / n), y, r * math.sin(TAU * (i + shift) / n)) for i in range(n)]

    girdle = [add(p, (0, 0.02, 0)) for p in around(1, 0, 16)]
    lower = [add(p, (0, -0.02, 0)) for p in around(1, 0, 16)]
    stars = around(0.76, crown * 0.62, 8, 0.5)
    top = around(table, crown, 8)
    halves = around(0.22, -depth * 0.76, 8, 0.5)
    tip = (0.0, -depth, 0.0)
    mesh.face(*top[::-1])
    for i in range(8):
        j = (i + 1) % 8
        g = [girdle[(2 * i + k) % 16] for k in range(3)]
        w = [lower[(2 * i + k) % 16] for k in range(3)]
        mesh.face(top[i], top[j], stars[i])
        mesh.face(top[i], stars[i], g[0])  # a kite's half
        mesh.face(top[j], g[2], stars[i])
        for k in (0, 1):
            mesh.face(stars[i], g[k + 1], g[k])
            mesh.face(g[k], g[k + 1], w[k + 1], w[k])
            mesh.face(halves[i], w[k], w[k + 1])
        mesh.face(halves[i], w[2], tip)  # a main's half
        mesh.face(halves[i], tip, w[0])
    return mesh


def outward(mesh):
    """Turns the polygons of a star-shaped mesh about the origin so that they face away from it."""
    for face in mesh.faces:
        p = [mesh.points[i] for i in face[:3]]
        if dot(cross(sub(p[1], p[0]), sub(p[2], p[0])), p[0]) < 0:
            face.reverse()
    return mesh


def dodecahedron():
    """Twelve pentagons, six colours; opposite faces share one."""
    g = (1 + math.sqrt(5)) / 2
    points = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for a in (-1 / g, 1 / g):
        for b in (-g, g):
            points += [(0, a, b), (a, b, 0), (b, 0, a)]
    mesh = Mesh()
    mesh.points = points
    for a in (-1, 1):
        for b in (-g, g):
            for axis, normal in enumerate(((a, 0, b), (0, b, a), (b, a, 0))):  # the points of the dual icosahedron
                n = unit(normal)
                reach = max(dot(p, n) for p in points)
                face = [i for i, p in enumerate(points) if dot(p, n) > reach - 1e-9]
                s = unit(sub(points[face[0]], times(n, reach)))
                t = cross(n, s)
                face.sort(key=lambda i: math.atan2(dot(points[i], t), dot(points[i], s)))
                mesh.faces.append(face)
                mesh.materials.append(f"colour{axis}{0 if a * b > 0 else 1}")
    return mesh


def checkerboard(n=48):
    """n x n unit squares in y = 0 about the origin."""
    mesh = Mesh()
    for i in range(n):
        for k in range(n):
            x, z = i - n / 2, k - n / 2
            mesh.face((x, 0, z), (x, 0, z + 1), (x + 1, 0, z + 1), (x + 1, 0, z), material="light" if (i + k) % 2 else "dark")
    return mesh


def main():
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent / "scenes" / "meshes"
    out.mkdir(parents=True, exist_ok=True)
    write_ply(out / "knot.ply", knot(), "a trefoil of a twisted band")
    stone, panes = rose()
    write_ply(out / "rose_tracery.ply", stone, "stone of a rose window")
    for name, mesh in panes.items():
        write_ply(out / f"rose_{name}.ply", mesh, f"{name} panes of a rose window")
    write_obj(out / "hall.obj", hall(), "a hall with a round window", {"wall": (0.16, 0.30, 0.38), "trim": (0.70, 0.66, 0.58)})
    write_obj(out / "floor.obj", floor(), "octagonal tiles with square insets",
              {"light": (0.76, 0.73, 0.67), "warm": (0.58, 0.54, 0.48), "dark": (0.06, 0.09, 0.11), "joint": (0.22, 0.21, 0.20)})
    write_ply(out / "gem.ply", outward(gem()), "a brilliant cut", binary=False)
    write_obj(out / "checkerboard.obj", checkerboard(), "48 x 48 unit squares",
              {"light": (0.80, 0.76, 0.66), "dark": (0.16, 0.22, 0.28)})
    write_obj(out / "dodecahedron.obj", dodecahedron(), "a dodecahedron in six colours",
              {"colour00": (0.80, 0.20, 0.15), "colour01": (0.95, 0.55, 0.15), "colour10": (0.20, 0.45, 0.75),
               "colour11": (0.15, 0.60, 0.55), "colour20": (0.90, 0.82, 0.35), "colour21": (0.45, 0.25, 0.55)}, relative=True)


if __name__ == "__main__":
    main()
