"""What a scene of the Standard Procedural Databases is made of, and the vectors that place it.

The databases are Eric Haines' "A Proposal for Standard Graphics Environments" (IEEE CG&A 7(11), 1987) and their later
additions. Right-handed, z up but for jacks. A positive angle turns counter-clockwise, seen against the axis.
"""

import math
from dataclasses import dataclass, field

SKY = (0.078, 0.361, 0.753)


@dataclass(frozen=True)
class Material:
    color: tuple
    diffuse: float
    specular: float = 0  # of highlight and mirror
    shine: float = 0     # angle in degrees at which the highlight has half its strength; 0: none
    transmits: float = 0
    index: float = 0     # of refraction

    def exponent(self):
        """Of a Phong highlight; 1e5 where there is none."""
        return math.log(0.5) / math.log(math.cos(math.radians(self.shine))) if self.shine else 100000


@dataclass(frozen=True)
class Sphere:
    centre: tuple
    radius: float
    material: Material


@dataclass(frozen=True)
class Cone:
    """The side alone, from base to apex; a cylinder where the radii are equal."""
    base: tuple
    base_radius: float
    apex: tuple
    apex_radius: float
    material: Material


@dataclass(frozen=True)
class Polygon:
    """Flat; its front is where the points turn counter-clockwise. `triangles`: how it is cut, a fan if None."""
    points: tuple
    material: Material
    triangles: tuple = None

    def cut(self):
        return self.triangles or [(0, i, i + 1) for i in range(1, len(self.points) - 1)]


@dataclass
class Scene:
    """`angle`: of the whole view, top to bottom, in degrees; the picture is square."""
    eye: tuple
    at: tuple
    angle: float
    lights: list
    up: tuple = (0, 0, 1)
    background: tuple = SKY
    resolution: int = 512
    primitives: list = field(default_factory=list)
    one_sided: bool = True  # opaque polygons need to be seen from their front only


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return times(a, 1 / length(a))


def rotate(v, axis, angle):
    """`v` turned by `angle` (radians) about the unit vector `axis`: Rodrigues."""
    c, s = math.cos(angle), math.sin(angle)
    return add(add(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)))


def square(x0, x1, y0, y1, z, material):
    """Level, facing up."""
    return Polygon(((x1, y1, z), (x0, y1, z), (x0, y0, z), (x1, y0, z)), material)
