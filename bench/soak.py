#!/usr/bin/env python3
"""A long walk in the window: does memory grow, does a frame stall?

    bench/soak.py build/release/app/vlf [--minutes 20]

Opens an example scene in `vlf view`, which bakes it, and replays a way through it over and over,
while keys change the mode and the scene's material file is rewritten, so that it is baked anew.
Needs Xvfb, xauth and xdotool. Prints memory over time and the frames that took longest.
"""

import argparse
import csv
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def resident_megabytes(pid):
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(re.sub(r"\D", "", line)) / 1024
    return 0


def camera_path(cameras):
    """From camera to camera and back to the first, four seconds each."""
    samples = []
    for i, camera in enumerate(cameras + cameras[:1]):
        x, y, z = (a - b for a, b in zip(camera["look"], camera["eye"]))
        samples.append({"seconds": 4 * i, "eye": camera["eye"],
                        "yaw": math.degrees(math.atan2(-x, -z)),
                        "pitch": math.degrees(math.atan2(y, math.hypot(x, z))),
                        "verticalFov": 50})
    return {"format": "vlf camera path", "version": 1, "camera": samples}


def walk(options, folder, display):
    """Resident memory (MiB) every five seconds; the exit code of the window."""
    environment = dict(os.environ, DISPLAY=display, XDG_CONFIG_HOME=str(folder))
    scene = f"{options.scene}.obj"
    subprocess.run([options.program, "-q", "scene", options.scene, "-o", "."], cwd=folder,
                   check=True)
    cameras = json.loads((folder / f"{options.scene}.cameras.json").read_text())["cameras"]
    (folder / "path.json").write_text(json.dumps(camera_path(cameras)))
    view = subprocess.Popen(
        [options.program, "-q", "view", scene, "--fresh", "--preset", "draft", "--size", "640x480",
         "--replay", "path.json", "--loop", "--log", "frames.csv"], cwd=folder, env=environment)
    material = folder / f"{options.scene}.mtl"
    original = material.read_text()
    memory, end = [], time.monotonic() + 60 * options.minutes
    while time.monotonic() < end and view.poll() is None:
        time.sleep(5)
        memory.append(resident_megabytes(view.pid))
        subprocess.run(["xdotool", "key", "m"], env=environment, check=False)
        if len(memory) % 4 == 0:
            material.write_text(original + f"# changed {len(memory)} times\n")
    subprocess.run(["xdotool", "key", "Escape"], env=environment, check=False)
    return memory, view.wait(timeout=60)


def report(memory, frames):
    quarter = max(1, len(memory) // 4)
    print(f"{len(memory) / 12:.1f} minutes, {len(frames)} frames")
    print("memory, MiB: median of each quarter "
          + ", ".join(f"{statistics.median(memory[i:i + quarter]):.0f}"
                      for i in range(0, quarter * 4, quarter)) + f"; most {max(memory):.0f}")
    frames.sort()
    print(f"frames, ms: median {frames[len(frames) // 2]:.0f}, "
          f"p99 {frames[int(0.99 * (len(frames) - 1))]:.0f}, longest {frames[-1]:.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--scene", default="mirror-room")
    parser.add_argument("--minutes", type=float, default=20)
    parser.add_argument("--display", default=":98", help="for Xvfb to make")
    options = parser.parse_args()
    screen = subprocess.Popen(["Xvfb", options.display, "-screen", "0", "1024x768x24", "-noreset"],
                              stderr=subprocess.DEVNULL)
    try:
        time.sleep(2)
        with tempfile.TemporaryDirectory() as name:
            memory, code = walk(options, Path(name), options.display)
            with open(Path(name) / "frames.csv", newline="") as stream:
                frames = [float(row["total_ms"]) for row in csv.DictReader(stream)]
    finally:
        screen.terminate()
    report(memory, frames)
    return code


if __name__ == "__main__":
    sys.exit(main())
