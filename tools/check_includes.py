#!/usr/bin/env python3
"""Holds src/ to the table of who may include whom, and every source file to its length.

    tools/check_includes.py [source directory]

Prints `file:line: what is wrong` for each finding; exit status 1 if there is one. Only the standard library is used.

  per ISA   src/simd/, src/render/kernels/: simd includes nothing of ours; kernels include simd, kernels and the boundary
            headers; of the standard library only headers without out-of-line code; only simd/isa.hpp includes xsimd and
            the intrinsics
  boundary  scene/precision.hpp, scene/scene_view.hpp, render/kernel_table.hpp: <cstdint> and each other, no function bodies
  baseline  scene <- scene; render <- render, scene, but never a kernel; lanecast and cli <- all of those; libraries as LIBRARIES says
"""
import pathlib
import re
import sys

MAX_LINES = 500
BOUNDARY = {"scene/precision.hpp", "scene/scene_view.hpp", "render/kernel_table.hpp"}
SIMD_SEAM = "simd/isa.hpp"
CANARIES = "cli/selftest/canary_subjects.cpp"  # what the compiler makes of intrinsics is what it is for
KERNEL_STD = {"array", "bit", "cmath", "cstdint", "limits", "type_traits"}
INTRINSICS = re.compile(r"^(xsimd/.*|[a-z]*mmintrin\.h|x86intrin\.h|cpuid\.h|immintrin\.h)$")
# Library header -> rooms that may include it.
LIBRARIES = [
    (re.compile(r"^glm/"), {"scene", "render", "lanecast", "cli"}),
    (re.compile(r"^nlohmann/"), {"scene"}),
    (re.compile(r"^(OpenEXR|Imath)/|^(Imf|Imath|Iex)[A-Za-z0-9]*\.h$|^half\.h$"), {"render"}),
    (re.compile(r"^png\.h$|^libdeflate\.h$"), {"render"}),
    (re.compile(r"^CLI/"), {"cli", "main"}),
    (re.compile(r"^embree[34]/"), {"cli"}),
]
NLOHMANN_FILES = 2  # a reader and at most one helper: everyone else sees a SceneDescription
# Room -> rooms of ours it may include.
ROOMS = {
    "simd": {"simd"},
    "kernels": {"simd", "kernels"},
    "scene": {"scene"},
    "render": {"render", "scene"},
    "lanecast": {"lanecast", "render", "scene"},
    "cli": {"cli", "lanecast", "render", "scene"},
    "main": {"cli", "render", "scene"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
STD = re.compile(r"^[a-z_0-9]+$")
POSIX = re.compile(r"^((sys|linux|netinet|arpa)/[a-z_]+\.h|[a-z]+\.h)$")
PER_ISA = {"simd", "kernels"}


def room_of(path: str) -> str:
    """The room of a path relative to src/."""
    if path.startswith("render/kernels/"):
        return "kernels"
    return path.split("/")[0] if "/" in path else "main"


def check_include(path: str, name: str, ours: bool):
    """What is wrong with `path` including `name`, or None."""
    room = room_of(path)
    if path in BOUNDARY:
        return None if name == "cstdint" or name in BOUNDARY else f"a boundary header includes only <cstdint>, not {name}"
    if INTRINSICS.match(name):
        return None if path in {SIMD_SEAM, CANARIES} else f"{name}: only {SIMD_SEAM} includes xsimd and the intrinsics"
    if ours:
        if name in BOUNDARY and room != "simd":
            return None
        target = room_of(name)
        if target in ROOMS.get(room, ()):
            return None
        return f"{room} must not include {name}"
    if room in PER_ISA:
        if name in KERNEL_STD:
            return None
        return f"per-ISA code includes only {', '.join(f'<{h}>' for h in sorted(KERNEL_STD))}, not <{name}>"
    for pattern, rooms in LIBRARIES:
        if pattern.match(name):
            return None if room in rooms else f"{room} must not include <{name}>"
    if STD.match(name) or POSIX.match(name):
        return None
    return f"<{name}> is of no library the table knows"


def without_comments(text: str) -> str:
    """The text with comments blanked, line numbers kept."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)


def check_tree(root: pathlib.Path):
    """Yields findings."""
    src = root / "src"
    nlohmann = []
    for file in sorted(src.rglob("*")):
        if file.suffix not in {".hpp", ".cpp", ".h", ".inc"}:
            continue
        path = file.relative_to(src).as_posix()
        text = without_comments(file.read_text(encoding="utf-8"))
        if room_of(path) not in ROOMS:
            yield f"src/{path}:1: {room_of(path)}/ is no room the table knows"
            continue
        for number, line in enumerate(text.split("\n"), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            ours, library = match.groups()
            name = ours or library
            if name.startswith("nlohmann/"):
                nlohmann.append(path)
            if ours and ("/" not in ours or ".." in ours):
                yield f"src/{path}:{number}: {ours}: includes of ours are written from src/, as \"scene/description.hpp\""
                continue
            wrong = check_include(path, name, ours is not None)
            if wrong:
                yield f"src/{path}:{number}: {wrong}"
        if path in BOUNDARY:
            body = re.search(r"\)\s*(const\s*)?(noexcept\s*)?(->[^;{]*)?\{", text)
            if body:
                yield f"src/{path}:{text.count(chr(10), 0, body.end()) + 1}: a boundary header holds no function body"
    if len(set(nlohmann)) > NLOHMANN_FILES:
        yield f"src/{nlohmann[-1]}:1: {len(set(nlohmann))} files include nlohmann; at most {NLOHMANN_FILES} may"

    for folder in ("src", "tests", "tools", "cmake", ".ci"):
        for file in sorted((root / folder).rglob("*")):
            if not file.is_file() or "__pycache__" in file.parts or file.suffix in {".ply", ".obj", ".mtl", ".json", ".bin"}:
                continue
            lines = file.read_bytes().count(b"\n")
            if lines > MAX_LINES and b"\0" not in file.read_bytes()[:4096]:
                yield f"{file.relative_to(root).as_posix()}:{MAX_LINES + 1}: {lines} lines; at most {MAX_LINES}"


def main() -> int:
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    findings = list(check_tree(root))
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
