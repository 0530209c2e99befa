#!/usr/bin/env python3
"""tools/check_includes.py must accept each line that is right and refuse each that is wrong."""
import pathlib
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tools"))
sys.dont_write_bytecode = True
import check_includes  # noqa: E402

GOOD = [
    ("simd/vec3.hpp", '#include "simd/batch.hpp"'),
    ("simd/isa.hpp", "#include <xsimd/xsimd.hpp>\n#include <immintrin.h>"),
    ("render/kernels/sphere.hpp", '#include "simd/vec3.hpp"\n#include "scene/scene_view.hpp"\n#include <cstdint>'),
    ("render/kernels/sphere.hpp", '#include "render/kernels/surface.hpp"\n#include "render/kernel_table.hpp"'),
    ("render/kernel_table.hpp", '#include "scene/scene_view.hpp"\n#include <cstdint>'),
    ("scene/scene_view.hpp", "struct A { int b[3]; };\ninline constexpr int c = (1 + 2);\nvoid (*f)(int) noexcept;"),
    ("scene/load_scene.cpp", "#include <nlohmann/json.hpp>\n#include <glm/vec3.hpp>\n#include <vector>"),
    ("render/exr_io.cpp", "#include <ImfOutputFile.h>\n#include <OpenEXR/ImfHeader.h>\n#include <sys/stat.h>"),
    ("render/png_io.cpp", '#include <png.h>\n#include "scene/error.hpp"'),
    ("cli/render.cpp", '#include <CLI/CLI.hpp>\n#include "render/film.hpp"\n#include "scene/flatten.hpp"'),
    ("main.cpp", '#include "cli/commands.hpp"\n#include <cstdio>'),
    ("scene/bvh.cpp", "// #include <xsimd/xsimd.hpp>\n/*\n#include <png.h>\n*/"),
]
BAD = [
    ("simd/vec3.hpp", '#include "scene/scene_view.hpp"', ":1:"),
    ("simd/batch.hpp", "#include <xsimd/xsimd.hpp>", "includes xsimd"),
    ("simd/vec3.hpp", "#include <vector>", "per-ISA code"),
    ("render/kernels/sphere.hpp", "#include <immintrin.h>", "intrinsic"),
    ("render/kernels/sphere.hpp", "#include <glm/vec3.hpp>", "per-ISA code"),
    ("render/kernels/sphere.hpp", "\n#include <algorithm>", ":2: per-ISA code"),
    ("render/kernels/sphere.hpp", '#include "scene/scene_arrays.hpp"', "kernels must not"),
    ("render/kernels/sphere.hpp", '#include "render/film.hpp"', "kernels must not"),
    ("render/kernel_table.hpp", "#include <array>", "boundary"),
    ("scene/scene_view.hpp", "#include <glm/vec3.hpp>", "boundary"),
    ("scene/scene_view.hpp", "inline int f() { return 1; }", "no function body"),
    ("render/kernel_table.hpp", "struct A {\n  int f() const noexcept { return 1; } };", ":2:"),
    ("scene/flatten.cpp", '#include "render/film.hpp"', "scene must not"),
    ("scene/flatten.cpp", "#include <ImfOutputFile.h>", "scene must not"),
    ("render/renderer.cpp", '#include "render/kernels/whitted.hpp"', "render must not"),
    ("render/renderer.cpp", '#include "cli/progress.hpp"', "render must not"),
    ("render/renderer.cpp", "#include <nlohmann/json.hpp>", "render must not"),
    ("render/renderer.cpp", '#include "simd/batch.hpp"', "render must not"),
    ("render/renderer.cpp", "#include <xmmintrin.h>", "intrinsic"),
    ("render/renderer.cpp", "#include <boost/format.hpp>", "no library"),
    ("render/film.cpp", '#include "film.hpp"', "written from src/"),
    ("util/strings.cpp", "", "no room"),
    ("scene/long.cpp", "\n" * 501, "501 lines"),
]
NLOHMANN = [(f"scene/reader{i}.cpp", "#include <nlohmann/json.hpp>") for i in range(check_includes.NLOHMANN_FILES + 1)]


def findings(files):
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder)
        for path, text in files:
            file = tree / "src" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text + "\n" if text and not text.endswith("\n") else text)
        return list(check_includes.check_tree(tree))


failed = 0
for path, text in GOOD:
    if found := findings([(path, text)]):
        failed += 1
        print(f"refused, but right: {path}: {found}")
for path, text, words in BAD:
    found = findings([(path, text)])
    if not any(words in finding and finding.startswith(f"src/{path}:") for finding in found):
        failed += 1
        print(f"accepted, but wrong: {path}: {text[:60]!r} -> {found}")
if findings(NLOHMANN[:-1]) or not findings(NLOHMANN):
    failed += 1
    print("the number of files that include nlohmann is not counted")
sys.exit(1 if failed else 0)
