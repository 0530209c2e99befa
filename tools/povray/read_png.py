"""PNG in, for `pictures`: 8-bit RGB or RGBA, not interlaced, which is what POV-Ray and Lanecast write. Only the standard
library is used.

read_png(path) -> (width, height, rows): rows is a list of bytes, three per pixel.
"""
import pathlib
import struct
import zlib


def chunks(data):
    at = 8
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + size]
        at += 12 + size


def paeth(a, b, c):
    estimate = a + b - c
    distances = abs(estimate - a), abs(estimate - b), abs(estimate - c)
    return (a, b, c)[distances.index(min(distances))]


def unfilter(kind, row, above, step):
    """The bytes of a row, in place, from what was written of them and the row above."""
    for x in range(len(row)):
        left = row[x - step] if x >= step else 0
        corner = above[x - step] if x >= step else 0
        row[x] = (row[x] + (0, left, above[x], (left + above[x]) // 2, paeth(left, above[x], corner))[kind]) & 255


def read_png(path):
    data = pathlib.Path(path).read_bytes()
    packed, step = b"", 3
    for name, body in chunks(data):
        if name == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or colour not in (2, 6) or interlaced:
                raise ValueError(f"{path}: not an 8-bit RGB picture")
            step = 3 if colour == 2 else 4
        elif name == b"IDAT":
            packed += body
    plain = zlib.decompress(packed)
    rows, above = [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        row = bytearray(plain[start + 1:start + 1 + width * step])
        unfilter(plain[start], row, above, step)
        above = row
        rows.append(bytes(row) if step == 3 else bytes(v for i, v in enumerate(row) if i % 4 != 3))
    return width, height, rows
