#!/usr/bin/env python3
"""Memory of bakes, as predicted and as it was: a table of docs/benchmarks.md.

    bench/memory_table.py build/release/app/vlf cornell mirror-room gallery room.glb [--presets draft standard]

Scenes are names that `vlf scene` knows, or files.
"""

import argparse
import pathlib
import tempfile

from program import bake, info, scene_file


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vlf", type=pathlib.Path)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--presets", nargs="+", default=["draft", "standard"])
    args = parser.parse_args()
    print("| scene | preset | triangles | texels | radiance elements | peak | predicted | |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for scene in args.scenes:
            path = scene_file(args.vlf, scene, folder)
            for preset in args.presets:
                field = folder / "room.vlf"
                report = bake(args.vlf, path, field, "--preset", preset, "--checkpoint", "0")
                peak, predicted = report["peakMemoryMiB"], report["predictedMemoryMiB"]
                triangles = info(args.vlf, field)["counts"]["triangles"]
                print(f"| {path.stem} | {preset} | {triangles} | {report['texels']} | "
                      f"{report['radianceElements']} | {peak:.0f} MiB | {predicted:.0f} MiB | "
                      f"{100 * (predicted / peak - 1):+.0f} % |", flush=True)


if __name__ == "__main__":
    main()
