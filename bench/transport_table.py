#!/usr/bin/env python3
"""Irradiance error against CPU time: the table of docs/benchmarks.md.

    bench/transport_table.py build/release/app/vlf [--texels 1000] [--spp 4096] [--cache DIR]
        [SCENE ...]

Bakes the project's scenes, path-traces the irradiance of some of their texels with the same
program and prints, per scene, what the bake took and what path tracing all texels to the same error
would take (its error falls with the square root of the samples). CPU seconds, so that other work on
the machine matters less. A scene is a name known to `vlf scene` or a file. The truth is kept in the
cache, with the time it took, for fields that have the same texels.
"""

import argparse
import pathlib
import tempfile

from irradiance_truth import IrradianceTruth, measured_rmse, restricted
from program import bake, cpu_seconds, scene_file

SCENES = ["cornell", "two-rooms", "mirror-room", "gallery", "office"]

# Where the error of a whole scene, which bright places dominate, hides that of a dark one.
DARK_PLACES = {"two-rooms": ("its dark room", lambda position: position[0] > 4.15)}


def error_columns(error):
    rmse, is_bound = measured_rmse(error)
    sign = "≤ " if is_bound else ""
    bias = f"{100 * error['bias']:+.3f} ± {100 * error['biasError']:.3f} %"
    return rmse, sign, f"{sign}{100 * rmse:.2f} % | {bias}"


def measure(args, scene, folder):
    path, field = scene_file(args.vlf, scene, folder), folder / "f.vlf"
    report = bake(args.vlf, path, field, "--preset", args.preset, "--radiance-directions", 0)
    truth = IrradianceTruth(args.vlf, args.cache or folder / "truth", args.texels, args.spp)
    error = truth.of(path, field)
    cpu = cpu_seconds(report)
    traced = len(error["texels"])
    rmse, sign, columns = error_columns(error)
    to_equal = error["cpuSeconds"] * report["texels"] / traced * (error["truthError"] / rmse) ** 2
    at_least = "≥ " if sign else ""
    print(f"| {path.stem} | {report['texels']} | {cpu:.2f} | {columns} | "
          f"{at_least}{to_equal:.0f} | {at_least}{to_equal / cpu:.0f}x |", flush=True)
    if path.stem in DARK_PLACES:
        name, where = DARK_PLACES[path.stem]
        print(f"| {name} | | | {error_columns(restricted(error, where))[2]} | | |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vlf", help="the program")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--preset", default="standard")
    parser.add_argument("--texels", type=int, default=1000)
    parser.add_argument("--spp", type=int, default=4096)
    parser.add_argument("--cache", type=pathlib.Path, help="folder that keeps the truth")
    args = parser.parse_intermixed_args()
    print("| scene | texels | bake, CPU s | error | bias | path tracing to it, CPU s | factor |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            measure(args, scene, pathlib.Path(folder))


if __name__ == "__main__":
    main()
