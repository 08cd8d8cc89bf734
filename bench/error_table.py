#!/usr/bin/env python3
"""The estimated error of bakes against the true one: a table of docs/benchmarks.md.

    bench/error_table.py build/release/app/vlf [--texels 500] [--spp 4096] [--cache DIR]
        [--bake "--preset draft" --bake "--error 1%" ...] [SCENE ...]

Bakes the project's scenes with each of the sets of options and path-traces the irradiance of some of
their texels with the same program, once of the texels' means and once at points between them. The
truths are kept in the cache. CPU seconds are those of the bake, radiance fields left out.
"""

import argparse
import pathlib
import tempfile

from irradiance_truth import IrradianceTruth, measured_rmse
from program import bake, cpu_seconds, scene_file

SCENES = ["cornell", "two-rooms", "mirror-room", "gallery", "office"]
PRESETS = ["--preset draft", "--preset standard", "--preset high"]


def percent(value, bound=False):
    return f"{'≤ ' if bound else ''}{100 * value:.2f} %"


def compared(estimate, error):
    rmse, is_bound = measured_rmse(error)
    ratio = f"{'≥ ' if is_bound else ''}{estimate / rmse:.2f}"
    return f"{percent(estimate)} | {percent(rmse, is_bound)} | {ratio}"


def measure(args, scene, options, folder):
    path, field = scene_file(args.vlf, scene, folder), folder / "f.vlf"
    report = bake(args.vlf, path, field, *options.split(), "--radiance-directions", 0,
                  "--gloss-directions", 0)
    cache = args.cache or folder / "truth"
    estimate = report["estimatedError"]
    texels = IrradianceTruth(args.vlf, cache, args.texels, args.spp).of(path, field)
    points = IrradianceTruth(args.vlf, cache, args.texels, args.spp, "--interpolated").of(
        path, field)
    print(f"| {path.stem} | `{options}` | {report['texels']} | {cpu_seconds(report):.2f} | "
          f"{compared(estimate['ofTexels'], texels)} | "
          f"{compared(estimate['interpolated'], points)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vlf", help="the program")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--bake", action="append", help="options of vlf bake")
    parser.add_argument("--texels", type=int, default=500)
    parser.add_argument("--spp", type=int, default=4096)
    parser.add_argument("--cache", type=pathlib.Path, help="folder that keeps the truths")
    args = parser.parse_intermixed_args()
    print("| scene | settings | texels | bake, CPU s | texels: estimated | true | ratio "
          "| between: estimated | true | ratio |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene in args.scenes:
        for options in args.bake or PRESETS:
            with tempfile.TemporaryDirectory() as folder:
                measure(args, scene, options, pathlib.Path(folder))


if __name__ == "__main__":
    main()
