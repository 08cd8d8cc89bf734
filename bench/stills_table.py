#!/usr/bin/env python3
"""Stills of baked rooms against the path tracer: a table of docs/benchmarks.md.

    bench/stills_table.py build/release/app/vlf [--spp 4096] [--references DIR] [--pictures DIR]
        [SCENE[:CAMERA,...] ...]

Bakes scenes, renders them and prints FLIP and relMSE against path-traced pictures, as `vlf compare
--exposure auto` measures them, with the relMSE that the reference's own noise makes up for. A scene
is a name known to `vlf scene` or a file; without cameras its first --cameras are taken. References
are kept in --references and used again for the same scene, camera, size and samples; --pictures
keeps a sheet per still: field, reference, FLIP.
"""

import argparse
import hashlib
import json
import pathlib
import tempfile

from program import bake, cpu_seconds, info, report_of, run, scene_file

SCENES = ["cornell:front,inside", "mirror-room:front,mirror", "two-rooms:overview,dark",
          "sealed:overview,lit", "office:overview,desk", "grotto:overview,pool",
          "gallery:overview,statue", "caustic:overview,front"]


def view_options(camera, size):
    def triple(name):
        return ",".join(f"{x:.9g}" for x in camera[name])

    return ["--eye=" + triple("eye"), "--look=" + triple("look"), "--up=" + triple("up"),
            "--fov", camera["verticalFov"], "--size", size]


def reference(args, scene, scene_hash, name, view, folder):
    """The path-traced picture and the report on it, made if they are not there."""
    folder.mkdir(parents=True, exist_ok=True)
    key = hashlib.sha256(json.dumps([scene_hash, view, args.spp]).encode()).hexdigest()
    picture = folder / f"{name}-{args.spp}-{key[:16]}.exr"
    report = picture.with_suffix(".json")
    if not report.exists():
        run(args.vlf, "-q", "reference", scene, *view, "--spp", args.spp, "-o", picture, "--json",
            report)
    return picture, report_of(report)


def compare(args, scene, field, camera, folder):
    name = f"{scene.stem}-{camera['name']}"
    view = view_options(camera, args.size)
    truth, traced = reference(args, scene, info(args.vlf, field)["bake"]["sceneHash"], name, view,
                              args.references or folder / "references")
    still, heat, report = folder / "still.exr", folder / "heat.png", folder / "compare.json"
    run(args.vlf, "-q", "render", field, *view, "--mode", args.mode, "-o", still)
    run(args.vlf, "-q", "compare", still, truth, "--exposure", "auto", "--heatmap", heat, "--json",
        report)
    if args.pictures:
        args.pictures.mkdir(parents=True, exist_ok=True)
        run(args.vlf, "-q", "sheet", still, truth, heat, "--columns", 3, "-o",
            args.pictures / f"{name}.png")
    return {**report_of(report), "noise": traced["relativeError"] ** 2}


def measure(args, scene_and_cameras, folder):
    scene, _, names = scene_and_cameras.partition(":")
    path, field = scene_file(args.vlf, scene, folder), folder / "f.vlf"
    radiance = [] if args.mode == "field" else ["--radiance-directions", 0]
    seconds = cpu_seconds(bake(args.vlf, path, field, "--preset", args.preset, *radiance))
    cameras = info(args.vlf, field)["cameras"]
    chosen = [c for c in cameras if c["name"] in names.split(",")] if names else \
        cameras[:args.cameras]
    for camera in chosen:
        found = compare(args, path, field, camera, folder)
        print(f"| {path.stem} | {camera['name']} | {found['flip']:.4f} | {found['relMse']:.5f} | "
              f"{found['noise']:.5f} | {seconds:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vlf", help="the program")
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE[:CAMERA,...]")
    parser.add_argument("--preset", default="high")
    parser.add_argument("--mode", default="raytraced", choices=["raytraced", "field"])
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--spp", type=int, default=4096)
    parser.add_argument("--cameras", type=int, default=2, help="of scenes without names of cameras")
    parser.add_argument("--references", type=pathlib.Path, help="folder that keeps the references")
    parser.add_argument("--pictures", type=pathlib.Path, help="folder for sheets of the pictures")
    args = parser.parse_intermixed_args()
    print("| scene | camera | FLIP | relMSE | of it noise | bake, CPU s |")
    print("| --- | --- | ---: | ---: | ---: | ---: |", flush=True)
    for scene in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            measure(args, scene, pathlib.Path(folder))


if __name__ == "__main__":
    main()
