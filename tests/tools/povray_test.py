#!/usr/bin/env python3
"""What tools/povray does without POV-Ray: reads PNG, keeps the digits of scenes, counts dots, and says that it skips."""
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "povray" / "pictures"
sys.path.insert(0, str(TOOL.parent))
from read_png import read_png  # noqa: E402
from scene_to_pov import convert  # noqa: E402

loader = importlib.machinery.SourceFileLoader("pictures", str(TOOL))
pictures = importlib.util.module_from_spec(importlib.util.spec_from_loader("pictures", loader))
loader.exec_module(pictures)


def png(rows, step, kinds):
    """A PNG whose row y is written with filter kinds[y % len(kinds)]."""
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    out, above = b"", bytes(len(rows[0]))
    for y, row in enumerate(rows):
        kind = kinds[y % len(kinds)]
        line = bytearray()
        for x, value in enumerate(row):
            a = row[x - step] if x >= step else 0
            b = above[x]
            c = above[x - step] if x >= step else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]  # Paeth: ties in this order
            line.append((value - (0, a, b, (a + b) // 2, nearest)[kind]) & 255)
        out += bytes([kind]) + line
        above = row
    head = struct.pack(">IIBBBBB", len(rows[0]) // step, len(rows), 8, 2 if step == 3 else 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(out))
            + chunk(b"IEND", b""))


def check_png(directory):
    dice = random.Random(1)
    for step in (3, 4):
        rows = [bytes(dice.randrange(256) for _ in range(step * 17)) for _ in range(20)]
        path = pathlib.Path(directory) / "a.png"
        path.write_bytes(png(rows, step, [0, 1, 2, 3, 4]))
        width, height, found = read_png(path)
        assert (width, height) == (17, 20)
        assert found == [b"".join(row[step * x:step * x + 3] for x in range(17)) for row in rows], step


def check_scene(directory):
    scene = {"camera": {"position": [0, 6373000, 0], "look_at": [0, 0, -1]},
             "objects": [{"type": "sphere", "radius": 6371000, "material": {}},
                         {"type": "sphere", "radius": 0.1, "position": [100000000.5, -99999997.8, 0], "material": {}}],
             "lights": [{"type": "directional", "color": [1, 1, 1], "direction": [0, -1, 0]}]}
    path = pathlib.Path(directory) / "a.json"
    path.write_text(json.dumps(scene))
    out = io.StringIO()
    convert(path, out)
    text = out.getvalue()
    assert "100000000.5,-99999997.8" in text, text
    light = text[text.index("light_source"):]
    height = float(light[light.index("<") + 1:light.index(">")].split(",")[1])
    assert height > 1e8, light  # beyond everything in the scene


def check_dots():
    grey, white = (100, 100, 100), (255, 255, 255)
    picture = [[grey] * 9 for _ in range(9)]
    assert pictures.count_dots(picture) == 0
    picture[4][4] = white
    assert pictures.count_dots(picture) == 1
    for row in picture:
        row[:5] = [white] * 5  # an edge is none
    assert pictures.count_dots(picture) == 0


def check_skip(directory):
    done = subprocess.run([sys.executable, str(TOOL), "no.json"], env={**os.environ, "PATH": directory}, capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0 and done.stdout.startswith("skipped: povray"), done


with tempfile.TemporaryDirectory() as place:
    check_png(place)
    check_scene(place)
    check_dots()
    check_skip(place)
print("PNG, scenes, dots and skipping are right")
