"""Lanecast's scene format: spheres and open cones one by one, the polygons of a material as a mesh, in a PLY file when they are many.

Intensities are not part of the databases; the suggestion is sqrt(n) / (2 n) for each of n lights and for the ambient term. A mirror
or a highlight has the strength `specular`, and what shines through is neither tinted nor weakened beyond `transmits`.
"""

import json
import math
import struct
from itertools import groupby

from spd_scene import Cone, Polygon, Sphere, add, cross, dot, length, sub, times

INLINE_TRIANGLES = 300


def material_json(material):
    grey = lambda x: [x] * 3
    lit = [round(c * material.diffuse, 9) for c in material.color]
    out = {"ambient": lit, "diffuse": lit}
    if material.specular:
        out.update({"specular": grey(material.specular), "shininess": round(material.exponent(), 4),
                    "reflective": grey(material.specular)})
    if material.transmits:
        out.update({"transmissive": grey(material.transmits), "refraction": material.index})
    return out


def placed_along(base, apex):
    """Takes the y axis to the way from base to apex, the origin to its middle."""
    way = sub(apex, base)
    axis = cross((0, 1, 0), way)
    angle = math.degrees(math.atan2(length(axis), way[1]))
    if length(axis) < 1e-12 * length(way):
        axis = (1, 0, 0)
    turn = [{"type": "rotation", "axis": list(axis), "degrees": angle}] if angle else []
    return turn + [{"type": "translate", "translate": list(times(add(base, apex), 0.5))}]


def cone_json(cone):
    height = length(sub(cone.apex, cone.base))
    out = {"type": "cylinder", "radius": cone.base_radius, "height": height, "capped": False}
    if cone.base_radius != cone.apex_radius:
        out = {"type": "cone", "base_radius": cone.base_radius, "apex_radius": cone.apex_radius, "height": height,
               "capped": False}
    return out | {"transformations": placed_along(cone.base, cone.apex), "material": material_json(cone.material)}


def mesh_of(polygons):
    """Shared corners once: (points, triangles)."""
    index, triangles = {}, []
    for polygon in polygons:
        corners = [index.setdefault(p, len(index)) for p in polygon.points]
        triangles += [tuple(corners[i] for i in triangle) for triangle in polygon.cut()]
    return list(index), triangles


def write_ply(path, points, triangles):
    with open(path, "wb") as out:
        out.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        out.write(b"".join(struct.pack("<3d", *p) for p in points))
        out.write(b"".join(struct.pack("<B3i", 3, *t) for t in triangles))


def objects_of(scene, name, directory):
    """Primitives in their order; runs of polygons of one material become one mesh."""
    meshes = 0
    for (is_polygon, material), run in groupby(scene.primitives, lambda p: (isinstance(p, Polygon), p.material)):
        if not is_polygon:
            for p in run:
                if isinstance(p, Sphere):
                    yield {"type": "sphere", "radius": p.radius, "position": list(p.centre), "material": material_json(material)}
                elif isinstance(p, Cone):
                    yield cone_json(p)
            continue
        points, triangles = mesh_of(run)
        out = {"type": "mesh", "material": material_json(material)}
        if len(triangles) <= INLINE_TRIANGLES:
            out["triangles"] = [[list(points[i]) for i in triangle] for triangle in triangles]
        else:
            out["file"] = f"{name}_{meshes}.ply"
            write_ply(directory / out["file"], points, triangles)
            meshes += 1
        yield out


def upright(scene):
    """Our `up` may not be parallel to the view; the databases' never is."""
    view = sub(scene.at, scene.eye)
    assert abs(dot(view, scene.up)) < 0.9999 * length(view) * length(scene.up)
    return list(scene.up)


def write_scene(scene, name, comment, directory):
    """`name`.json and its meshes; returns the path of the former."""
    directory.mkdir(parents=True, exist_ok=True)
    intensity = [round(math.sqrt(len(scene.lights)) / (2 * len(scene.lights)), 9)] * 3
    camera = {"field": scene.angle, "background": list(scene.background), "position": list(scene.eye), "look_at": list(scene.at),
              "up": upright(scene), "resolution": [scene.resolution] * 2}
    lights = [{"type": "ambient", "color": intensity}]
    lights += [{"type": "point", "color": intensity, "position": list(at)} for at in scene.lights]
    path = directory / f"{name}.json"
    with open(path, "w", encoding="utf-8") as out:
        dump = lambda value: json.dumps(value, separators=(", ", ": "))
        out.write(f'{{\n  "_comment": {dump(comment)},\n  "camera": {dump(camera)},\n  "objects": [')
        for i, item in enumerate(objects_of(scene, name, directory)):
            out.write(("," if i else "") + "\n    " + dump(item))
        out.write('\n  ],\n  "lights": [\n    ' + ",\n    ".join(dump(light) for light in lights))
        out.write('\n  ],\n  "render": {"depth": 4, "cutoff": 0}\n}\n')
    return path
