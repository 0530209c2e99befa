#!/usr/bin/env python3
"""Converts a scene to POV-Ray 3.7, for timing one against the other: the same geometry, camera, lights and depth.

    tools/povray/scene_to_pov.py scene.json [-o scene.pov] [--depth N] [--size WxH]

What POV-Ray cannot say, and what stands for it:
- colours of `specular` and `transmissive`: their mean (diffuse, ambient and reflective keep theirs);
- `near`, soft shadows, anti-aliasing, Schlick's term: left out; time Lanecast without them too;
- attenuation with a linear and a quadratic term: the quadratic one;
- opaque shadows of transmissive objects: such an object gets `no_shadow`, and a twin that only shadow rays see.
- one transparent object inside another: POV-Ray keeps count of what a ray is in, Lanecast's outside is always air.
Only the standard library is used.
"""
import argparse
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from read_mesh import read_mesh  # noqa: E402

FAR = 1e5  # distance of a directional light from the eye, scene units, at least: POV-Ray's parallel lights stand somewhere
IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]


# ---- vectors

def add(a, b, k=1.0):
    return [x + k * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a))
    return [x / length for x in a]


def times(a, k):
    return [x * k for x in a]


def mean(a):
    return sum(a) / 3


def number(x):
    """The shortest text that reads back as the same double: POV-Ray computes in doubles."""
    return repr(float(x))


def vector(a):
    return "<" + ",".join(number(x) for x in a) + ">"


# ---- transformations: 3x4, world_from_object

def product(outer, inner):
    """outer * inner: inner is applied first."""
    columns = [[row[c] for row in inner] for c in range(4)]
    return [[dot(row[:3], column) + (row[3] if c == 3 else 0) for c, column in enumerate(columns)] for row in outer]


def rotation(axis, degrees):
    x, y, z = unit(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    k = 1 - c
    return [[c + x * x * k, x * y * k - z * s, x * z * k + y * s, 0],
            [y * x * k + z * s, c + y * y * k, y * z * k - x * s, 0],
            [z * x * k - y * s, z * y * k + x * s, c + z * z * k, 0]]


def world_from_object(transformations):
    out = IDENTITY
    for step in transformations:
        if step["type"] == "rotation":
            matrix = rotation(step["axis"], step["degrees"])
        elif step["type"] == "scale":
            matrix = [[step["scale"][r] if r == c else 0 for c in range(4)] for r in range(3)]
        else:
            matrix = [IDENTITY[r][:3] + [step["translate"][r]] for r in range(3)]
        out = product(matrix, out)
    return out


def matrix_line(matrix):
    """POV-Ray lists columns: the images of x, y and z, then the translation."""
    if matrix == IDENTITY:
        return ""
    return "  matrix " + vector([matrix[r][c] for c in range(4) for r in range(3)]) + "\n"


# ---- materials

def texture(material, ambient_light, settings):
    zero = [0, 0, 0]
    diffuse = material.get("diffuse", zero)
    opacity = 1 - transparency(material, settings)
    # POV-Ray multiplies ambient by the pigment, so it is divided by it here; a channel without diffuse gets a trace of it
    pigment = [max(x, 1e-4) for x in diffuse] if any(diffuse) else [1, 1, 1]
    ambient = [a * light / p for a, light, p in zip(material.get("ambient", zero), ambient_light, pigment)]
    finish = [f"ambient rgb {vector(ambient)}", f"diffuse {1 if any(diffuse) else 0}"]
    specular = mean(material.get("specular", zero)) * opacity
    if specular > 0:
        finish.append(f"specular {number(specular)} roughness {number(1 / max(material.get('shininess', 1), 1e-3))}")
    reflective = material.get("reflective", zero)
    if any(reflective) and settings.get("reflections", True):
        finish.append(f"reflection {{ rgb {vector(times(reflective, opacity))} }}")
    return (f"  texture {{ pigment {{ rgbt <{','.join(map(number, pigment))},{number(1 - opacity)}> }} "
            f"finish {{ {' '.join(finish)} }} }}\n")


def transparency(material, settings):
    if not settings.get("transmission", True):
        return 0
    return mean(material.get("transmissive", [0, 0, 0]))


def interior(material, settings):
    index = material.get("refraction", 0) if settings.get("refraction", True) else 0
    return f"  interior {{ ior {number(index)} }}\n" if index > 0 else ""


# ---- objects

def mesh_text(points, triangles):
    used = sorted({i for triangle in triangles for i in triangle})
    number = {i: n for n, i in enumerate(used)}
    return ("mesh2 {\n  vertex_vectors { " + f"{len(used)}" + "".join(",\n" + vector(points[i]) for i in used)
            + " }\n  face_indices { " + f"{len(triangles)}"
            + "".join(f",\n<{number[a]},{number[b]},{number[c]}>" for a, b, c in triangles) + " }\n")


def shapes(scene_object, directory):
    """(opening text without the closing brace, material) of each part."""
    kind, material = scene_object["type"], scene_object.get("material", {})
    opening = "" if scene_object.get("capped", True) else " open"
    if kind == "sphere":
        yield f"sphere {{ {vector(scene_object.get('position', [0, 0, 0]))}, {number(scene_object['radius'])}\n", material
    elif kind == "cylinder":
        half = scene_object["height"] / 2
        yield f"cylinder {{ <0,{number(-half)},0>, <0,{number(half)},0>, {number(scene_object['radius'])}{opening}\n", material
    elif kind == "cone":
        half = scene_object["height"] / 2
        yield (f"cone {{ <0,{number(-half)},0>, {number(scene_object['base_radius'])}, <0,{number(half)},0>, "
               f"{number(scene_object.get('apex_radius', 0))}{opening}\n"), material
    elif kind == "plane":
        normal = unit(scene_object["normal"])
        yield f"plane {{ {vector(normal)}, {number(dot(normal, scene_object['position']))}\n", material
    elif "file" in scene_object:
        points, groups = read_mesh(directory / scene_object["file"])
        for given, triangles in groups:
            yield mesh_text(points, triangles), material | given
    else:
        points = [point for triangle in scene_object["triangles"] for point in triangle]
        yield mesh_text(points, [(i, i + 1, i + 2) for i in range(0, len(points), 3)]), material


def write_object(out, scene_object, ambient_light, settings, directory):
    if scene_object["type"] == "plane" and not settings.get("planes", True):
        return
    place = matrix_line(world_from_object(scene_object.get("transformations", [])))
    for text, material in shapes(scene_object, directory):
        look = texture(material, ambient_light, settings)
        if transparency(material, settings) > 0 and not settings.get("transmissive_shadows", False):
            out.write(text + look + interior(material, settings) + place + "  no_shadow\n}\n")
            out.write(text + "  pigment { rgb 0 }\n" + place + "  no_image no_reflection\n}\n")
        else:
            out.write(text + look + interior(material, settings) + place + "}\n")


# ---- camera and lights

def fade(light):
    """-> (factor of the colour, text): POV-Ray's light is 2 / (1 + (d / fade_distance)^fade_power) of its colour."""
    constant, linear, quadratic = light.get("attenuation", [1, 0, 0])
    constant = max(constant, 1e-6)
    if quadratic > 0:
        return 0.5 / constant, f" fade_distance {number(math.sqrt(constant / quadratic))} fade_power 2"
    if linear > 0:
        return 0.5 / constant, f" fade_distance {number(constant / linear)} fade_power 1"
    return 1 / constant, ""


def extent(scene):
    """The largest coordinate or size that the scene names, about."""
    values = [abs(x) for x in scene["camera"].get("position", [0])]
    for scene_object in scene["objects"]:
        values += [scene_object.get(key, 0) for key in ("radius", "height", "base_radius")]
        values += [abs(x) for x in scene_object.get("position", [])]
        for step in scene_object.get("transformations", []):
            values += [abs(x) for x in step.get("translate", [])]
    return max(values)


def light_text(light, settings, eye, far):
    factor, extra = fade(light)
    if not settings.get("shadows", True):
        extra += " shadowless"
    position = light.get("position", [0, 0, 0])
    if light["type"] == "directional":
        position = add(eye, unit(light["direction"]), -far)
        extra += f" parallel point_at {vector(eye)}"
    elif light["type"] == "spot":
        angle = min(light["cutoff"], 90)
        aim = add(position, unit(light["direction"]))
        extra += f" spotlight radius {number(angle)} falloff {number(angle)} tightness 0 point_at {vector(aim)}"
    return f"light_source {{ {vector(position)}, rgb {vector(times(light['color'], factor))}{extra} }}\n"


def camera_text(camera, size):
    eye = camera.get("position", [0, 0, 0])
    forward = unit(add(camera["look_at"], eye, -1)) if "look_at" in camera else [0, 0, -1]
    right = unit(cross(forward, camera.get("up", [0, 1, 0])))
    up = cross(right, forward)
    reach = 0.5 / math.tan(math.radians(camera.get("field", 60)) / 2)
    return (f"camera {{ perspective location {vector(eye)} direction {vector(times(forward, reach))} up {vector(up)} "
            f"right {vector(times(right, size[0] / size[1]))} }}\n")


def convert(path, out, depth=None, size=None):
    """Writes the scene at `path` to the text file `out`. Text after the root value is ignored, as Lanecast does."""
    path = pathlib.Path(path)
    scene, _ = json.JSONDecoder().raw_decode(path.read_text(encoding="utf-8-sig").lstrip())
    camera, settings = scene["camera"], scene.get("render", {})
    size = size or camera.get("resolution", [512, 512])
    depth = settings.get("depth", 8) if depth is None else depth
    ambient_light = [0, 0, 0]
    for light in scene["lights"]:
        if light["type"] == "ambient" and settings.get("ambient", True):
            ambient_light = light["color"]
    # the camera ray is level 1 there and level 0 here; adc_bailout drops rays of little weight, as `cutoff` does
    out.write("#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light rgb 1 "
              f"max_trace_level {depth + 1} adc_bailout {number(settings.get('cutoff', 0))} }}\n")
    out.write(f"background {{ rgb {vector(camera.get('background', [0, 0, 0]))} }}\n")
    out.write(camera_text(camera, size))
    far = max(FAR, 10 * extent(scene))
    for light in scene["lights"]:
        if light["type"] != "ambient":
            out.write(light_text(light, settings, camera.get("position", [0, 0, 0]), far))
    for scene_object in scene["objects"]:
        write_object(out, scene_object, ambient_light, settings, path.parent)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", help="default: the scene's name with .pov, in the current directory")
    parser.add_argument("--depth", type=int, help="default: the scene's, or 8")
    parser.add_argument("--size", help="WxH, for its shape only; default: the scene's resolution")
    request = parser.parse_args()
    size = [int(x) for x in request.size.split("x")] if request.size else None
    with open(request.output or pathlib.Path(request.scene).stem + ".pov", "w", encoding="utf-8") as out:
        convert(request.scene, out, request.depth, size)


if __name__ == "__main__":
    main()
