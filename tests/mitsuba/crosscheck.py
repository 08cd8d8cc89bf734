#!/usr/bin/env python3
"""Holds vlf against Mitsuba 3, an independent renderer: both must agree within their noise.

    python3 -m venv venv && venv/bin/pip install mitsuba numpy
    venv/bin/python tests/mitsuba/crosscheck.py images --vlf build/app/vlf
    venv/bin/python tests/mitsuba/crosscheck.py irradiance room.obj texels.json

`images` renders example scenes with `vlf reference` and with Mitsuba and compares the means of the
picture's regions. `irradiance` compares texels: {"texels": [{"position": [x, y, z], "normal":
[x, y, z], "irradiance": [r, g, b], "standardError": [r, g, b]}, ...]} in metres and W/m2, with the
irradiance Mitsuba finds there.

Every difference is divided by the standard error of both sides. Fails (exit code 1) if a |z| is
above what chance allows among so many, or if their mean square is. Exit code 77: no Mitsuba.
The llvm variant needs a libLLVM of version 17 or later (Debian: libllvm19; another may be named by
DRJIT_LIBLLVM_PATH). `--variant scalar_rgb` needs nothing, is slow and does images only.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

try:
    import mitsuba as mi
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

VIEWS = [("cornell", "front"), ("cornell", "corner"), ("mirror-room", "front"),
         ("mirror-room", "mirror"), ("two-rooms", "overview"), ("two-rooms", "door"),
         ("grotto", None)]
REGIONS = (4, 3)  # columns, rows
BATCHES = 32  # independent Mitsuba renderings, whose spread is their error


def region_sums(image):
    """Sums of a (height, width, 3) picture over its regions: (rows * columns, 3)."""
    columns, rows = REGIONS
    strips = np.array_split(np.asarray(image, dtype=np.float64), rows, axis=0)
    return np.array([block.sum(axis=(0, 1))
                     for strip in strips for block in np.array_split(strip, columns, axis=1)])


def vlf_regions(vlf, obj, camera, width, height, spp):
    with tempfile.TemporaryDirectory() as folder:
        picture, variance = os.path.join(folder, "p.exr"), os.path.join(folder, "v.exr")
        subprocess.run([vlf, "reference", obj, "--camera", camera, "--size", f"{width}x{height}",
                        "--spp", str(spp), "-o", picture, "--variance", variance, "-q"], check=True)
        return region_sums(mi.Bitmap(picture)), np.sqrt(region_sums(mi.Bitmap(variance)))


def mitsuba_regions(obj, camera, width, height, spp):
    import obj_scene
    with tempfile.TemporaryDirectory() as folder:
        description = obj_scene.load(obj, folder)
        description["integrator"] = {"type": "path", "max_depth": -1}
        description["sensor"] = obj_scene.sensor(obj_scene.cameras(obj)[camera], width, height)
        scene = mi.load_dict(description)
        sums = np.array([region_sums(mi.render(scene, spp=max(1, spp // BATCHES), seed=i))
                         for i in range(BATCHES)])
    return sums.mean(axis=0), sums.std(axis=0, ddof=1) / math.sqrt(BATCHES)


def judge(title, ours, our_error, theirs, their_error):
    """Prints one line; True if the two sets of means agree within their errors."""
    error = np.sqrt(our_error**2 + their_error**2)
    scale = np.maximum(np.abs(theirs), 1e-12)
    known = error > 1e-6 * scale  # what both know exactly must be equal
    z = np.where(known, (ours - theirs) / np.where(known, error, 1), 0)
    exact = bool(np.all(np.abs(ours - theirs)[~known] <= 1e-4 * scale[~known]))
    count = max(1, int(known.sum()))
    # One false alarm in a thousand runs: Bonferroni for the largest, normal for the mean square.
    # The errors are estimates themselves: the spread of z is a little above 1.
    largest_allowed = 3.3 + 0.6 * math.log10(count)
    square_allowed = 1 + 2 / (BATCHES - 3) + 3.3 * math.sqrt(2 / (count / 3))
    largest, square = float(np.abs(z).max()), float((z**2).sum() / count)
    agrees = exact and largest <= largest_allowed and square <= square_allowed
    total = ours.sum() / theirs.sum() - 1
    print(f"{'ok  ' if agrees else 'FAIL'} {title:24} {count:5} values: max |z| {largest:.2f} "
          f"(<= {largest_allowed:.2f}), mean z^2 {square:.2f} (<= {square_allowed:.2f}); "
          f"error {100 * np.median((error / scale)[known]):.2f} %, total {100 * total:+.3f} %",
          flush=True)
    return agrees


def check_images(arguments):
    import obj_scene
    agrees = True
    with tempfile.TemporaryDirectory() as folder:
        for name, camera in VIEWS:
            if arguments.scenes and name not in arguments.scenes:
                continue
            subprocess.run([arguments.vlf, "scene", name, "-o", folder, "-q"], check=True)
            obj = os.path.join(folder, name + ".obj")
            camera = camera or next(iter(obj_scene.cameras(obj)))
            view = (obj, camera, arguments.width, arguments.height, arguments.spp)
            agrees &= judge(f"{name}/{camera}", *vlf_regions(arguments.vlf, *view),
                            *mitsuba_regions(*view))
    return agrees


def cosine_directions(normals, u, v):
    frame = mi.Frame3f(normals)
    return frame.to_world(mi.warp.square_to_cosine_hemisphere(mi.Point2f(u, v)))


def mitsuba_irradiance(scene, positions, normals, samples, seed):
    """Irradiance samples (points, samples, 3): the emitters by next-event estimation, all other
    light by a path in a cosine-distributed direction, less what the first hit emits."""
    import drjit as dr
    count = len(positions) * samples
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    p = mi.Point3f(np.repeat(positions, samples, axis=0).T.astype(np.float32))
    n = mi.Normal3f(np.repeat(normals, samples, axis=0).T.astype(np.float32))
    si = dr.zeros(mi.SurfaceInteraction3f, count)
    si.t, si.p, si.n, si.sh_frame = mi.Float(1), p, n, mi.Frame3f(n)
    light, radiance = scene.sample_emitter_direction(si, sampler.next_2d(), True)
    direct = radiance * dr.maximum(dr.dot(light.d, n), 0)
    d = cosine_directions(n, sampler.next_1d(), sampler.next_1d())
    ray = mi.RayDifferential3f(si.spawn_ray(d))
    incident = scene.integrator().sample(scene, sampler, ray)[0]
    hit = scene.ray_intersect(ray)
    seen = hit.emitter(scene).eval(hit)
    total = direct + dr.pi * (incident - seen)
    return np.array(total).T.reshape(len(positions), samples, 3)


def check_irradiance(arguments):
    import obj_scene
    if "llvm" not in mi.variant():
        sys.exit("irradiance needs an llvm variant of Mitsuba")
    with open(arguments.texels) as file:
        texels = json.load(file)["texels"]
    column = {key: np.array([t[key] for t in texels], dtype=np.float64)
              for key in ("position", "normal", "irradiance", "standardError")}
    with tempfile.TemporaryDirectory() as folder:
        description = obj_scene.load(arguments.obj, folder)
        description["integrator"] = {"type": "path", "max_depth": -1}
        scene = mi.load_dict(description)
        # Away from the surface, so that the point is on its lit side for Mitsuba's rays as well.
        start = column["position"] + arguments.offset * column["normal"]
        batches = np.array([
            mitsuba_irradiance(scene, start, column["normal"], arguments.samples // BATCHES, seed)
            .mean(axis=1) for seed in range(BATCHES)])
    error = batches.std(axis=0, ddof=1) / math.sqrt(BATCHES)
    return judge(os.path.basename(arguments.texels), column["irradiance"], column["standardError"],
                 batches.mean(axis=0), error)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variant", default="llvm_ad_rgb", help="of Mitsuba [llvm_ad_rgb]")
    modes = parser.add_subparsers(dest="mode", required=True)
    images = modes.add_parser("images", help="region means of pictures")
    images.add_argument("--vlf", required=True, help="the program")
    images.add_argument("--scenes", nargs="*", help="only these of the scenes")
    images.add_argument("--spp", type=int, default=1024, help="samples per pixel [1024]")
    images.add_argument("--width", type=int, default=64)
    images.add_argument("--height", type=int, default=48)
    texels = modes.add_parser("irradiance", help="irradiance of texels")
    texels.add_argument("obj")
    texels.add_argument("texels")
    texels.add_argument("--samples", type=int, default=8192, help="for each texel [8192]")
    texels.add_argument("--offset", type=float, default=1e-4, help="metres off the surface [1e-4]")
    arguments = parser.parse_args()
    mi.set_variant(arguments.variant)
    agrees = check_images(arguments) if arguments.mode == "images" else check_irradiance(arguments)
    sys.exit(0 if agrees else 1)


if __name__ == "__main__":
    main()
