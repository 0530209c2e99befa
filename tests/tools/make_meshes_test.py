#!/usr/bin/env python3
"""tools/make_meshes.py writes what scenes/meshes holds, byte by byte, and its bodies are closed."""
import filecmp
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "tools"))
sys.dont_write_bytecode = True
import make_meshes  # noqa: E402

failures = []
with tempfile.TemporaryDirectory() as directory:
    subprocess.run([sys.executable, root / "tools" / "make_meshes.py", directory], check=True)
    made, kept = ({p.name for p in pathlib.Path(d).iterdir()} for d in (directory, root / "scenes" / "meshes"))
    failures += [f"{name}: made or kept, not both" for name in sorted(made ^ kept)]
    _, different, errors = filecmp.cmpfiles(directory, root / "scenes" / "meshes", sorted(made & kept), shallow=False)
    failures += [f"{name}: the file in scenes/meshes is another one" for name in different + errors]


def check_closed(name, mesh):
    """Every edge runs once in each direction, so that inside and outside are told apart; the volume is positive."""
    edges, volume = {}, 0.0
    number = {}
    for face in mesh.faces:
        corners = [number.setdefault(make_meshes.rounded(mesh.points[i]), len(number)) for i in face]
        points = [mesh.points[i] for i in face]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[a, b] = edges.get((a, b), 0) + 1
        for k in range(1, len(points) - 1):
            volume += make_meshes.dot(points[0], make_meshes.cross(points[k], points[k + 1])) / 6
    if any(count != 1 or edges.get((b, a)) != 1 for (a, b), count in edges.items()):
        failures.append(f"{name}: not closed")
    if volume <= 0:
        failures.append(f"{name}: inside out")


check_closed("knot", make_meshes.knot(60, 12))
check_closed("gem", make_meshes.outward(make_meshes.gem()))
check_closed("dodecahedron", make_meshes.dodecahedron())

print("\n".join(failures) or "as they should be")
sys.exit(bool(failures))
