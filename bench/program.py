"""What the scripts of this folder share: running vlf, its scenes, bakes and their times."""

import json
import pathlib
import subprocess

# Stages of a bake that make the irradiance; "radiance field" is the mirrors'.
IRRADIANCE_STAGES = {"charts", "direct light", "bounces", "atlas"}


def run(*command):
    subprocess.run([str(c) for c in command], check=True)


def report_of(path):
    return json.loads(pathlib.Path(path).read_text())


def info(vlf, field):
    """What `vlf info` says about a field."""
    shown = subprocess.run([vlf, "info", field, "--json", "-"], check=True, capture_output=True)
    return json.loads(shown.stdout)


def scene_file(vlf, scene, folder):
    """The path of a scene: a file, or one that `vlf scene` knows, written to `folder`."""
    path = pathlib.Path(scene)
    if path.suffix:
        return path
    run(vlf, "-q", "scene", scene, "-o", folder)
    return pathlib.Path(folder) / f"{scene}.obj"


def cpu_seconds(report, stages=IRRADIANCE_STAGES):
    return sum(s["cpuSeconds"] for s in report["stages"] if s["name"] in stages)


def bake(vlf, scene, field, *options):
    """Bakes a scene file and returns the report."""
    report = field.with_suffix(".json")
    run(vlf, "-q", "bake", scene, "-o", field, "--json", report, *options)
    return report_of(report)
