#!/usr/bin/env python3
"""Holds vlf against Mitsuba 3, an independent renderer: both must agree within their noise.

    python3 -m venv venv && venv/bin/pip install mitsuba numpy
    venv/bin/python tests/mitsuba/crosscheck.py images --vlf build/app/vlf
    venv/bin/python tests/mitsuba/crosscheck.py irradiance --vlf build/app/vlf
    venv/bin/python tests/mitsuba/crosscheck.py lights --vlf build/app/vlf

`images` renders example scenes with `vlf reference` and with Mitsuba and compares the means of the
picture's regions. `irradiance` does so with the irradiance of texels, and of regions of them, by
`vlf reference --irradiance` and by `vlf bake`. `lights` does what `images` does under punctual lights
and skies, and holds bakes against the same.

Every difference is divided by the standard error of both sides. Fails (exit code 1) if a |z| is
above what chance allows among so many, or if their mean square is. Exit code 77: no Mitsuba.
The llvm variant needs a libLLVM of version 17 or later (Debian: libllvm19; another may be named by
DRJIT_LIBLLVM_PATH). `--variant scalar_rgb` needs nothing, is slow and does images only.
"""

import argparse
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

from agreement import judge

VIEWS = [("cornell", "front"), ("cornell", "corner"), ("mirror-room", "front"),
         ("mirror-room", "mirror"), ("two-rooms", "overview"), ("two-rooms", "door"),
         ("grotto", None), ("gloss", "front"), ("gloss", "floor"),
         ("glass", "front"), ("glass", "ball"), ("glass", "pane")]
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
                            *mitsuba_regions(*view), batches=BATCHES)
    return agrees


def check_irradiance(arguments):
    import irradiance
    if "llvm" not in mi.variant():
        sys.exit("irradiance needs an llvm variant of Mitsuba")
    with tempfile.TemporaryDirectory() as folder:
        return irradiance.check(arguments, folder)


def check_lights(arguments):
    import lights
    with tempfile.TemporaryDirectory() as folder:
        return lights.check(arguments, folder, region_sums, BATCHES)


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
    texels.add_argument("--vlf", required=True, help="the program")
    texels.add_argument("--scenes", nargs="*", help="only these of the scenes")
    lights = modes.add_parser("lights", help="pictures under punctual lights and skies")
    lights.add_argument("--vlf", required=True, help="the program")
    lights.add_argument("--scenes", nargs="*", help="only these of the cases")
    lights.add_argument("--spp", type=int, default=1024, help="samples per pixel [1024]")
    lights.add_argument("--width", type=int, default=64)
    lights.add_argument("--height", type=int, default=48)
    arguments = parser.parse_args()
    mi.set_variant(arguments.variant)
    checks = {"images": check_images, "irradiance": check_irradiance, "lights": check_lights}
    agrees = checks[arguments.mode](arguments)
    sys.exit(0 if agrees else 1)


if __name__ == "__main__":
    main()
