"""OBJ and PLY for scene_to_pov.py: triangles by material, as docs/scene-format.md reads them. Trusts its input:
`lanecast check` is the judge of files. Only the standard library is used.

read_mesh(path) -> (points, groups): points is a list of (x, y, z); groups maps a material, a dict of those scene keys
that the file gives, to its triangles, as [(material, [(i, j, k), ...]), ...].
"""
import pathlib
import struct

PLY_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
             "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f",
             "float64": "d"}


def fan(corners):
    return [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]


# ---- PLY

def ply_header(data):
    """-> (format, elements, offset of the body); an element is [name, count, properties], a property (name, types)."""
    end = data.index(b"end_header")
    offset = data.index(b"\n", end) + 1
    form, elements = None, []
    for line in data[:end].decode("latin-1").splitlines():
        words = line.split()
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append([words[1], int(words[2]), []])
        elif words[:1] == ["property"]:
            types = words[2:4] if words[1] == "list" else [words[1]]
            elements[-1][2].append((words[-1], [PLY_TYPES[t] for t in types]))
    return form, elements, offset


def binary_rows(data, offset, order, element):
    """One dict per row, in file order, and the offset behind them as the last item."""
    _, count, properties = element
    if all(len(types) == 1 for _, types in properties):
        row = struct.Struct(order + "".join(types[0] for _, types in properties))
        names = [name for name, _ in properties]
        for i in range(count):
            yield dict(zip(names, row.unpack_from(data, offset + i * row.size)))
        yield offset + count * row.size
        return
    for _ in range(count):
        out = {}
        for name, types in properties:
            length = 1
            if len(types) == 2:
                length = struct.unpack_from(order + types[0], data, offset)[0]
                offset += struct.calcsize(types[0])
            values = struct.unpack_from(f"{order}{length}{types[-1]}", data, offset)
            offset += struct.calcsize(types[-1]) * length
            out[name] = values if len(types) == 2 else values[0]
        yield out
    yield offset


def text_rows(words, at, element):
    _, count, properties = element
    for _ in range(count):
        out = {}
        for name, types in properties:
            length = 1
            if len(types) == 2:
                length, at = int(words[at]), at + 1
            kind = float if types[-1] in "fd" else int
            values = tuple(kind(word) for word in words[at:at + length])
            at += length
            out[name] = values if len(types) == 2 else values[0]
        yield out
    yield at


def read_ply(path):
    data = path.read_bytes()
    form, elements, offset = ply_header(data)
    words = data[offset:].split() if form == "ascii" else None
    at = 0 if words is not None else offset
    points, triangles = [], []
    for element in elements:
        if words is not None:
            rows = text_rows(words, at, element)
        else:
            rows = binary_rows(data, at, "<" if form == "binary_little_endian" else ">", element)
        for row in rows:
            if not isinstance(row, dict):
                at = row
            elif element[0] == "vertex":
                points.append((row["x"], row["y"], row["z"]))
            elif element[0] == "face":
                triangles += fan(row["vertex_indices"] if "vertex_indices" in row else row["vertex_index"])
    return points, [({}, triangles)]


# ---- OBJ

def read_mtl(path):
    keys = {"Kd": "diffuse", "Ks": "specular", "Ka": "ambient"}
    materials, current = {}, {}
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["newmtl"]:
            current = materials.setdefault(" ".join(words[1:]), {})
        elif words and words[0] in keys and words[1] not in ("spectral", "xyz"):
            values = [float(word) for word in words[1:4]]
            current[keys[words[0]]] = values if len(values) == 3 else [values[0]] * 3
        elif words[:1] == ["Ns"]:
            current["shininess"] = float(words[1])
    return materials


def read_obj(path):
    points, groups, materials, triangles = [], {}, {}, None
    for line in path.read_text(errors="replace").replace("\\\n", " ").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append(tuple(float(word) for word in words[1:4]))
        elif words[0] == "f":
            if triangles is None:
                triangles = groups.setdefault(None, [])
            corners = [int(word.split("/")[0]) for word in words[1:]]
            triangles += fan([i - 1 if i > 0 else len(points) + i for i in corners])
        elif words[0] == "mtllib" and (path.parent / " ".join(words[1:])).exists():
            materials.update(read_mtl(path.parent / " ".join(words[1:])))
        elif words[0] == "usemtl":
            triangles = groups.setdefault(" ".join(words[1:]), [])
    return points, [(materials.get(name, {}), group) for name, group in groups.items() if group]


def read_mesh(path):
    path = pathlib.Path(path)
    return read_obj(path) if path.suffix.lower() == ".obj" else read_ply(path)
