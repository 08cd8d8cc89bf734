#!/usr/bin/env python3
"""Holds the FLIP of `vlf compare` against the implementation of the authors of FLIP.

Needs the Python packages flip-evaluator and numpy, best in a virtual environment:

    python3 -m venv venv
    venv/bin/pip install flip-evaluator numpy
    venv/bin/python flip_crosscheck.py build/app/vlf

Pairs of pictures are generated, written as PNG and compared by both programs. Exits with 0 if all
mean errors agree within TOLERANCE, with 1 if not, and with 77 (skipped) without the packages.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

try:
    import flip_evaluator
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

TOLERANCE = 1e-4


def write_png(path, pixels):
    """Writes (height, width, 3) bytes as a PNG."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def to_bytes(picture):
    return np.clip(np.round(255 * picture), 0, 255).astype(np.uint8)


def room(width, height):
    """A smooth picture with hard edges and thin lines, encoded values in [0, 1]."""
    y, x = np.mgrid[0:height, 0:width] / height
    picture = np.stack([0.6 * x / x.max(), 0.5 + 0.4 * np.sin(9 * x * y), 1 - y], axis=-1)
    picture[(x - 0.4) ** 2 + (y - 0.5) ** 2 < 0.04] = (0.9, 0.2, 0.1)
    picture[::17, :] *= 0.5
    return picture


def pairs():
    """Yields name, reference, test and pixels per degree."""
    random = np.random.default_rng(1)
    base = room(320, 200)
    yield "equal", base, base, 67
    yield "noise", base, base + random.normal(0, 0.1, base.shape), 67
    yield "brighter", base, 1.2 * base, 67
    yield "shifted", base, np.roll(base, 2, axis=1), 67
    yield "hue", base, base[..., ::-1], 67
    yield "random", random.random((64, 96, 3)), random.random((64, 96, 3)), 67
    yield "black and white", np.zeros((40, 30, 3)), np.ones((40, 30, 3)), 67
    yield "green and blue", np.full((9, 40, 3), (0.0, 1, 0)), np.full((9, 40, 3), (0.0, 0, 1)), 67
    yield "far", base, np.roll(base, 2, axis=0), 100
    yield "near", base, base + random.normal(0, 0.05, base.shape), 25
    dot = np.zeros((33, 47, 3))
    dot[16, 20] = 1
    yield "dot", dot, np.zeros_like(dot), 67


def flip_of_vlf(vlf, test, reference, ppd, folder):
    report = folder / "report.json"
    subprocess.run([vlf, "--quiet", "compare", test, reference, "--ppd", str(ppd), "--json",
                    report], check=True)
    return json.loads(report.read_text())["flip"]


def flip_of_authors(test, reference, ppd):
    _, mean, _ = flip_evaluator.evaluate(str(reference), str(test), "LDR", applyMagma=False,
                                         parameters={"ppd": float(ppd)})
    return mean


def main(vlf):
    failed = False
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        reference, test = folder / "reference.png", folder / "test.png"
        for title, reference_picture, test_picture, ppd in pairs():
            write_png(reference, to_bytes(reference_picture))
            write_png(test, to_bytes(test_picture))
            ours = flip_of_vlf(vlf, test, reference, ppd, folder)
            theirs = flip_of_authors(test, reference, ppd)
            good = abs(ours - theirs) <= TOLERANCE
            failed = failed or not good
            print(f"{'ok' if good else 'FAILED':7}{title:16} vlf {ours:.6f}  authors {theirs:.6f}"
                  f"  difference {ours - theirs:+.1e}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
