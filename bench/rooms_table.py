#!/usr/bin/env python3
"""Rooms of all kinds, baked and rendered beside path tracing, as a table.

    bench/rooms_table.py build/release rooms.json [--presets draft standard] [--spp 1024]

rooms.json is a list of rooms and of a camera in each:

    [{"name": "kit-room", "files": ["kit-room.obj"], "eye": [0, 1.6, 2], "look": [0, 1, 0], "fov": 70,
      "reference": ["--environment", "sky.hdr"]}, ...]

"fov" and "reference", options of both `vlf bake` and `vlf reference`, may be left out. Files are
found in the folder --scenes, or relative to rooms.json. Bakes every room, renders it in mode
raytraced, path-traces it, and prints the FLIP; and about what of it is noise of the truth: half the FLIP of a second path-traced
picture of a quarter of the paths. Pictures are left in --pictures: NAME-PRESET.png beside
NAME-truth.png.
"""

import argparse
import json
import pathlib
import tempfile

from program import bake, report_of, run


def text(vector):
    return ",".join(str(v) for v in vector)


def view_of(room, size):
    view = ["--eye", text(room["eye"]), "--look", text(room["look"]), "--size", size]
    return view + (["--fov", room["fov"]] if "fov" in room else [])


def compare(vlf, test, truth, folder, *options):
    report = folder / "compare.json"
    run(vlf, "-q", "compare", test, truth, "--exposure", "auto", "--tone", "filmic",
        "--json", report, *options)
    return report_of(report)


def path_trace(args, room, files, spp, seed, folder):
    picture = folder / f"{room['name']}-{spp}.exr"
    run(args.build / "app/vlf", "-q", "--seed", seed, "reference", *files,
        *room.get("reference", []), *view_of(room, args.size), "--spp", spp, "-o", picture)
    return picture


def show(args, room, preset, files, truth, noise, folder):
    vlf = args.build / "app/vlf"
    field, picture = folder / "room.vlf", folder / "room.exr"
    report = bake(vlf, files[0], field, *files[1:], *room.get("reference", []),
                  "--preset", preset, "--checkpoint", "0")
    run(vlf, "-q", "render", field, *view_of(room, args.size), "--mode", "raytraced",
        "-o", picture)
    flip = compare(vlf, picture, truth, folder)["flip"]
    if args.pictures:
        heat = args.pictures / f"{room['name']}-{preset}-error.png"
        compare(vlf, picture, truth, folder, "--heatmap", heat)
        run(vlf, "-q", "render", field, *view_of(room, args.picture_size),
            "-o", args.pictures / f"{room['name']}-{preset}.png")
    cpu, peak = sum(s["cpuSeconds"] for s in report["stages"]), report["peakMemoryMiB"]
    print(f"| {room['name']} | {preset} | {report['texels']} | {report['seconds']:.1f} | {cpu:.1f} | "
          f"{peak / 1024:.2f} GiB, {100 * (report['predictedMemoryMiB'] / peak - 1):+.0f} % | {report['fileBytes'] / 1e6:.1f} MB | "
          f"{flip:.3f} | {noise:.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="folder of the build")
    parser.add_argument("rooms", type=pathlib.Path, help="list of rooms (JSON)")
    parser.add_argument("--scenes", type=pathlib.Path, help="folder of the rooms' files")
    parser.add_argument("--only", nargs="+", help="names of rooms")
    parser.add_argument("--presets", nargs="+", default=["draft", "standard"])
    parser.add_argument("--spp", type=int, default=1024)
    parser.add_argument("--size", default="160x120")
    parser.add_argument("--pictures", type=pathlib.Path, help="folder for pictures")
    parser.add_argument("--picture-size", default="640x480")
    args = parser.parse_args()
    if args.pictures:
        args.pictures.mkdir(parents=True, exist_ok=True)
    print("| room | preset | texels | bake, s | CPU s | peak memory, prediction | file | FLIP | of the truth's noise |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for room in json.loads(args.rooms.read_text()):
            if args.only and room["name"] not in args.only:
                continue
            files = [(args.scenes or args.rooms.parent) / f for f in room["files"]]
            truth = path_trace(args, room, files, args.spp, 1, folder)
            other = path_trace(args, room, files, args.spp // 4, 2, folder)
            noise = compare(args.build / "app/vlf", other, truth, folder)["flip"] / 2
            if args.pictures:
                run(args.build / "app/vlf", "-q", "reference", *files, *room.get("reference", []),
                    *view_of(room, args.picture_size), "--spp", 64,
                    "-o", args.pictures / f"{room['name']}-truth.png")
            for preset in args.presets:
                show(args, room, preset, files, truth, noise, folder)


if __name__ == "__main__":
    main()
