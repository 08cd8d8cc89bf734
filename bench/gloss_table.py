#!/usr/bin/env python3
"""Rough mirrors by lookup against path tracing: a table of docs/benchmarks.md.

    bench/gloss_table.py build/release [--roughness 0.1 0.3 0.6] [--settings 513/128 2049/256]

Gives the metal panels of scene `gloss` one roughness after the other, bakes it with fields of so
many lines and cells a side for rough mirrors and prints the FLIP of their pixels, the mean of the
scene's cameras by pixels, and the CPU time of that part of the bake (gloss_quality.cpp).
"""

import argparse
import pathlib
import re
import tempfile

from program import bake, cpu_seconds, report_of, run, scene_file


def with_roughness(scene, roughness):
    """Of the panels alone; the floor keeps its own."""
    library = scene.with_suffix(".mtl")
    text = re.sub(r"(newmtl metal-\d\n(?:.*\n)*?Pr )\S+", rf"\g<1>{roughness}",
                  library.read_text())
    library.write_text(text)


def measure(args, scene, roughness, setting, folder):
    lines, cells = setting.split("/")
    field, report = folder / "f.vlf", folder / "quality.json"
    baked = bake(args.build / "app/vlf", scene, field, "--preset", args.preset,
                 "--gloss-directions", lines, "--gloss-cells", cells)
    run(args.build / "bench/gloss_quality", field, "--json", report, "--spp", args.spp)
    cameras = report_of(report)["cameras"]
    pixels = sum(c["pixels"] for c in cameras)
    flip = sum(c["pixels"] * c["flip"] for c in cameras) / pixels
    worst = max(c["flip"] for c in cameras)
    noise = sum(c["pixels"] * c["flipOfNoise"] for c in cameras) / pixels
    print(f"| {roughness} | {setting} | {flip:.3f} | {worst:.3f} | {noise:.3f} | "
          f"{baked['fileBytes'] / 1e6:.1f} MB | {cpu_seconds(baked, {'gloss'}):.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="folder of the build")
    parser.add_argument("--roughness", nargs="+", default=["0.1", "0.3", "0.6"])
    parser.add_argument("--settings", nargs="+", default=["513/128"])
    parser.add_argument("--preset", default="standard")
    parser.add_argument("--spp", type=int, default=4096)
    args = parser.parse_args()
    print("| roughness | lines/cells | FLIP | worst camera | of the truth's noise | file | CPU s |")
    print("| ---: | --- | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = scene_file(args.build / "app/vlf", "gloss", folder)
        for roughness in args.roughness:
            with_roughness(scene, roughness)
            for setting in args.settings:
                measure(args, scene, roughness, setting, folder)


if __name__ == "__main__":
    main()
