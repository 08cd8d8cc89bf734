#!/usr/bin/env python3
"""Mirrors by lookup against traced reflections: a table of docs/benchmarks.md.

    bench/mirror_table.py build/release [--scene mirror-room] [--settings 2049/256 8193/512]

Bakes the scene with radiance fields of so many lines and cells a side and prints the PSNR of mirror
pixels against the traced reflections of the same field (pooled over its cameras, weighted by their
mirror pixels) and the CPU time per mirror pixel (mirror_quality.cpp). A scene is a name known to
`vlf scene` or a file.
"""

import argparse
import math
import pathlib
import tempfile

from program import bake, cpu_seconds, report_of, run, scene_file

RAYS = {"antialiased": "as rendered", "oneRay": "one"}


def pooled_psnr(cameras, rays, lookup):
    squares = sum(c["pixels"] * 10 ** (-c[rays][lookup] / 10) for c in cameras)
    return -10 * math.log10(squares / sum(c["pixels"] for c in cameras))


def mean_time(cameras, way):
    pixels = sum(c["pixels"] for c in cameras)
    return sum(c["pixels"] * c["nanoseconds"][way] for c in cameras) / pixels


def measure(args, scene, setting, folder):
    lines, cells = setting.split("/")
    field, report = folder / "f.vlf", folder / "quality.json"
    baked = bake(args.build / "app/vlf", scene, field, "--preset", args.preset,
                 "--radiance-directions", lines, "--radiance-cells", cells)
    run(args.build / "bench/mirror_quality", field, "--json", report, "--width", args.width,
        "--height", args.height)
    cameras = report_of(report)["cameras"]
    seconds = cpu_seconds(baked, {"radiance field"})
    for rays, name in RAYS.items():
        plain, corrected = (pooled_psnr(cameras, rays, k) for k in ("plain", "depthCorrected"))
        worst = min(c[rays]["depthCorrected"] for c in cameras)
        print(f"| {setting} | {name} | {plain:.1f} dB | {corrected:.1f} dB | "
              f"{corrected - plain:+.1f} dB | {worst:.1f} dB |", flush=True)
    ways = ("plain", "depthCorrected", "traced")
    times = " / ".join(f"{mean_time(cameras, way):.0f}" for way in ways)
    return (f"| {setting} | {times} | {baked['radianceElements'] / 1e6:.1f} M | "
            f"{baked['fileBytes'] / 1e6:.1f} MB | {seconds:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="folder of the build")
    parser.add_argument("--scene", default="mirror-room")
    parser.add_argument("--settings", nargs="+", default=["2049/256", "8193/512"])
    parser.add_argument("--preset", default="standard")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--height", type=int, default=480)
    args = parser.parse_args()
    print("| lines/cells | rays a pixel | plain | depth-corrected | gain | its worst camera |")
    print("| --- | --- | ---: | ---: | ---: | ---: |", flush=True)
    costs = []
    with tempfile.TemporaryDirectory() as folder:
        scene = scene_file(args.build / "app/vlf", args.scene, folder)
        for setting in args.settings:
            costs.append(measure(args, scene, setting, pathlib.Path(folder)))
    print("\n| lines/cells | ns a pixel: plain / depth-corrected / traced | elements | file | "
          "radiance field, CPU s |")
    print("| --- | ---: | ---: | ---: | ---: |")
    print("\n".join(costs))


if __name__ == "__main__":
    main()
