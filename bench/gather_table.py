#!/usr/bin/env python3
"""The bundles against a gather with rays: a table of docs/benchmarks.md.

    bench/gather_table.py build/release [--texels 1000] [--spp 4096] [--cache DIR] [SCENE ...]

Per scene: what a bake takes, and what it takes when its bounces are a gather with rays of Embree
(gather_rival.cpp) of as many rays per texel as bring it to the same error. The rays are doubled
until the error is smaller; in between, CPU time and error are interpolated as powers of each other.
Charts and direct light are the same on both sides; "bounces" leaves them out. A scene is a name
known to `vlf scene` or a file. The truth is kept in the cache for fields that have the same texels.
"""

import argparse
import math
import pathlib
import sys
import tempfile

from irradiance_truth import IrradianceTruth, measured_rmse
from program import bake, cpu_seconds, report_of, run, scene_file

SCENES = ["cornell", "mirror-room", "two-rooms"]


class Point:
    """CPU seconds in all and of the bounces, for an error."""

    def __init__(self, report, error):
        self.all, self.bounces = cpu_seconds(report), cpu_seconds(report, {"bounces"})
        self.rays, self.error = report.get("rays", 0), error["relativeRmse"]


def gather(args, scene, rays, folder):
    report = folder / "gather.json"
    run(args.build / "bench/gather_rival", scene, "-o", folder / "gather.vlf", "--rays", rays,
        "--preset", args.preset, "--json", report)
    return report_of(report)


def sweep(args, scene, target, truth, folder):
    """The gather with more and more rays, until its error is below the target."""
    points, rays = [], args.min_rays
    while rays <= args.max_rays and not (points and points[-1].error < target):
        report = gather(args, scene, rays, folder)
        points.append(Point(report, truth.of(scene, folder / "gather.vlf")))
        print(f"{scene.stem}: {rays} rays, {points[-1].all:.2f} CPU s, "
              f"{100 * points[-1].error:.2f} %", file=sys.stderr)
        rays *= 2
    return points


def at_error(points, target, quantity):
    """A quantity of the points at an error, as a power of it between the last two points."""
    a, b = points[-2:]
    share = math.log(a.error / target) / math.log(a.error / b.error)
    return quantity(a) * (quantity(b) / quantity(a)) ** share


def measure(args, scene, folder):
    path, field = scene_file(args.build / "app/vlf", scene, folder), folder / "bake.vlf"
    vlf = args.build / "app/vlf"
    report = bake(vlf, path, field, "--preset", args.preset, "--radiance-directions", 0)
    truth = IrradianceTruth(vlf, args.cache or folder / "truth", args.texels, args.spp)
    error = truth.of(path, field)
    baked = Point(report, error)
    target, is_bound = measured_rmse(error)
    at_most, at_least = ("≤ ", "≥ ") if is_bound else ("", "")
    points = sweep(args, path, target, truth, folder)
    row = f"| {path.stem} | {baked.all:.2f} | {at_most}{100 * target:.2f} % | "
    if len(points) < 2 or points[-1].error >= target:
        last = points[-1]
        return row + f"{last.rays}: {100 * last.error:.2f} % | {last.all:.2f} | not compared | |"
    rays, cpu, bounces = (at_error(points, target, q) for q in
                          (lambda p: p.rays, lambda p: p.all, lambda p: p.bounces))
    return row + (f"{at_least}{rays:.0f} | {at_least}{cpu:.2f} | {at_least}{cpu / baked.all:.1f}x | "
                  f"{at_least}{bounces / baked.bounces:.1f}x |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="folder of the build")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--preset", default="standard")
    parser.add_argument("--texels", type=int, default=1000)
    parser.add_argument("--spp", type=int, default=4096)
    parser.add_argument("--min-rays", type=int, default=64)
    parser.add_argument("--max-rays", type=int, default=8192)
    parser.add_argument("--cache", type=pathlib.Path, help="folder that keeps the truth")
    args = parser.parse_intermixed_args()
    print("| scene | bake, CPU s | error | gather to it: rays a texel | CPU s | factor | bounces |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            print(measure(args, scene, pathlib.Path(folder)), flush=True)


if __name__ == "__main__":
    main()
