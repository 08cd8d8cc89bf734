"""Punctual lights and environments: vlf's path tracer and its bakes against Mitsuba 3.

A small scene of flat pieces is written as glTF and given to Mitsuba piece by piece. Spots have a hard
edge, since Mitsuba's falls off by another law. The environment is a function of the direction, which
each side gets at the places where it takes its pixels to lie: Mitsuba's first column and last row lie
on the edges of the picture.
"""

import base64
import json
import math
import os
import subprocess

import mitsuba as mi
import numpy as np

from agreement import judge

FLOOR, WALL, BOX = [0.6, 0.5, 0.4], [0.3, 0.5, 0.7], [0.7, 0.7, 0.7]
EYE, LOOK, FOV = [2.2, 2.0, 3.0], [0.0, 0.4, 0.0], 45.0
TURN = 40.0
HEIGHT = 256


def quads():
    """(origin, u, v, colour) of parallelograms; fronts are the side of cross(u, v)."""
    yield [-2, 0, -2], [0, 0, 4], [4, 0, 0], FLOOR
    yield [-2, 0, -2], [4, 0, 0], [0, 2, 0], WALL
    x, y, z, s = -0.3, 0.0, -0.2, 0.8
    yield [x, s, z], [0, 0, s], [s, 0, 0], BOX
    yield [x, y, z + s], [s, 0, 0], [0, s, 0], BOX
    yield [x + s, y, z], [0, s, 0], [0, 0, s], BOX
    yield [x, y, z], [0, 0, s], [0, s, 0], BOX
    yield [x, y, z], [0, s, 0], [s, 0, 0], BOX


def sky(direction):
    """Radiance from unit directions (n, 3): a gradient, a wide lobe and a small bright one."""
    lobe = np.array([0.6, 0.6, 0.5]) / np.linalg.norm([0.6, 0.6, 0.5])
    sun = np.array([-0.5, 0.7, 0.4]) / np.linalg.norm([-0.5, 0.7, 0.4])
    grey = 0.4 + 0.3 * direction[:, 1] + 0.8 * np.exp(4 * (direction @ lobe - 1))
    bright = 300 * np.exp(1500 * (direction @ sun - 1))
    return grey[:, None] * [0.8, 1.0, 1.2] + bright[:, None] * [1.0, 0.9, 0.7]


def picture(columns, rows):
    """The sky at azimuths (from -Z towards +X) and polar angles."""
    azimuth, polar = np.meshgrid(columns, rows)
    directions = np.stack([np.sin(polar) * np.sin(azimuth), np.cos(polar),
                           -np.sin(polar) * np.cos(azimuth)], axis=-1).reshape(-1, 3)
    return sky(directions).reshape(len(rows), len(columns), 3).astype(np.float32)


def our_picture():
    u = (np.arange(2 * HEIGHT) + 0.5) / (2 * HEIGHT)
    v = (np.arange(HEIGHT) + 0.5) / HEIGHT
    return picture(2 * np.pi * (u - 0.5), np.pi * v)


def their_picture():
    # Mitsuba's u runs from -Z towards +X, ours does so from its middle.
    u, v = np.arange(2 * HEIGHT) / (2 * HEIGHT), np.arange(HEIGHT) / (HEIGHT - 1)
    return picture(2 * np.pi * u, np.pi * v)


def point():
    return {"type": "point", "color": [1, 0.8, 0.6], "intensity": 6}, [1.2, 1.5, 0.9], [0, -1, 0]


def spot():
    cone = {"innerConeAngle": 0.4, "outerConeAngle": 0.4001}
    light = {"type": "spot", "color": [0.7, 0.9, 1], "intensity": 20, "spot": cone}
    return light, [1.0, 2.2, 1.6], [-0.4, -0.8, -0.6]


def sun():
    return ({"type": "directional", "color": [1, 0.9, 0.7], "intensity": 3}, [0, 0, 0],
            [0.5, -0.8, -0.4])


CASES = {"point": (point(),), "spot": (spot(),), "directional": (sun(),),
         "three lights": (point(), spot(), sun()), "constant sky": (), "painted sky": ()}


def rotation_to(direction):
    """Quaternion (x, y, z, w) that turns -Z to the direction."""
    d = np.array(direction) / np.linalg.norm(direction)
    axis = np.cross([0, 0, -1.0], d)
    q = np.array([*axis, 1 + np.dot([0, 0, -1.0], d)])
    return (q / np.linalg.norm(q)).tolist()


def write_gltf(path, lights):
    buffer, views, accessors, meshes, nodes, materials = b"", [], [], [], [], []

    def add(values, component, kind):
        nonlocal buffer
        data = np.array(values, dtype=np.float32 if component == 5126 else np.uint16).tobytes()
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
        buffer += data + b"\0" * (-len(data) % 4)
        accessors.append({"bufferView": len(views) - 1, "componentType": component,
                          "count": len(values), "type": kind})
        return len(accessors) - 1

    for origin, u, v, colour in quads():
        o, u, v = np.array(origin, float), np.array(u, float), np.array(v, float)
        positions = add([o, o + u, o + u + v, o + v], 5126, "VEC3")
        indices = add([0, 1, 2, 0, 2, 3], 5123, "SCALAR")
        materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1],
                                                   "metallicFactor": 0}})
        meshes.append({"primitives": [{"attributes": {"POSITION": positions}, "indices": indices,
                                       "material": len(materials) - 1}]})
        nodes.append({"mesh": len(meshes) - 1})
    for i, (_, place, direction) in enumerate(lights):
        nodes.append({"translation": place, "rotation": rotation_to(direction),
                      "extensions": {"KHR_lights_punctual": {"light": i}}})
    root = {"asset": {"version": "2.0"}, "scene": 0, "meshes": meshes, "materials": materials,
            "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
            "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": len(buffer), "uri": "data:application/octet-stream;base64,"
                         + base64.b64encode(buffer).decode()}]}
    if lights:
        root["extensionsUsed"] = ["KHR_lights_punctual"]
        root["extensions"] = {"KHR_lights_punctual": {"lights": [light for light, _, _ in lights]}}
    with open(path, "w") as file:
        json.dump(root, file)


def environment_of(case, folder):
    """Options of vlf, and Mitsuba's emitter; none of both for the others."""
    if case == "constant sky":
        return ["--environment", "0.5,1,1.5"], {
            "type": "constant", "radiance": {"type": "rgb", "value": [0.5, 1, 1.5]}}
    if case != "painted sky":
        return [], None
    path = os.path.join(folder, "sky.exr")
    mi.Bitmap(our_picture()).write(path)
    turned = mi.ScalarTransform4f().rotate([0, 1, 0], TURN)
    return (["--environment", path, "--environment-turn", str(TURN), "--environment-scale", "0.5"],
            {"type": "envmap", "bitmap": mi.Bitmap(their_picture()), "scale": 0.5,
             "to_world": turned})


def emitter(light, place, direction):
    intensity = {"type": "rgb",
                 "value": [light["intensity"] * c for c in light["color"]]}
    if light["type"] == "point":
        return {"type": "point", "position": place, "intensity": intensity}
    if light["type"] == "directional":
        return {"type": "directional", "direction": direction, "irradiance": intensity}
    up = [0, 0, 1] if abs(direction[1]) > 0.9 else [0, 1, 0]
    target = (np.array(place) + np.array(direction)).tolist()
    degrees = math.degrees(light["spot"]["innerConeAngle"])
    return {"type": "spot", "intensity": intensity, "cutoff_angle": degrees + 0.003,
            "beam_width": degrees,
            "to_world": mi.ScalarTransform4f().look_at(origin=place, target=target, up=up)}


def mitsuba_scene(lights, environment, width, height):
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1},
             "sensor": {"type": "perspective", "fov": FOV, "fov_axis": "y",
                        "to_world": mi.ScalarTransform4f().look_at(origin=EYE, target=LOOK,
                                                                   up=[0, 1, 0]),
                        "film": {"type": "hdrfilm", "width": width, "height": height,
                                 "rfilter": {"type": "box"}, "pixel_format": "rgb"}}}
    for i, (origin, u, v, colour) in enumerate(quads()):
        o, u, v = np.array(origin, float), np.array(u, float), np.array(v, float)
        matrix = np.eye(4)
        matrix[:3, 0], matrix[:3, 1] = u / 2, v / 2
        normal = np.cross(u, v)
        matrix[:3, 2], matrix[:3, 3] = normal / np.linalg.norm(normal), o + (u + v) / 2
        scene[f"quad{i}"] = {
            "type": "rectangle", "to_world": mi.ScalarTransform4f(matrix),
            "bsdf": {"type": "twosided", "bsdf": {
                "type": "diffuse", "reflectance": {"type": "rgb", "value": colour}}}}
    for i, light in enumerate(lights):
        scene[f"light{i}"] = emitter(*light)
    if environment:
        scene["environment"] = environment
    return mi.load_dict(scene)


def words(values):
    return ",".join(str(v) for v in values)


def view(width, height):
    return ["--eye", words(EYE), "--look", words(LOOK), "--fov", str(FOV), "--size",
            f"{width}x{height}"]


def check(arguments, folder, region_sums, batches):
    agrees = True
    for case, lights in CASES.items():
        if arguments.scenes and case not in arguments.scenes:
            continue
        gltf = os.path.join(folder, "scene.gltf")
        write_gltf(gltf, lights)
        options, environment = environment_of(case, folder)
        exr, variance = os.path.join(folder, "p.exr"), os.path.join(folder, "v.exr")
        subprocess.run([arguments.vlf, "reference", gltf, *options,
                        *view(arguments.width, arguments.height), "--spp", str(arguments.spp),
                        "-o", exr, "--variance", variance, "-q"], check=True)
        ours = region_sums(mi.Bitmap(exr)), np.sqrt(region_sums(mi.Bitmap(variance)))
        scene = mitsuba_scene(lights, environment, arguments.width, arguments.height)
        sums = np.array([region_sums(mi.render(scene, spp=max(1, arguments.spp // batches), seed=i))
                         for i in range(batches)])
        theirs = sums.mean(axis=0), sums.std(axis=0, ddof=1) / math.sqrt(batches)
        agrees &= judge(case, *ours, *theirs, batches=batches)
        # A bake of the preset standard may be off by a hundredth in a region.
        field, still = os.path.join(folder, "f.vlf"), os.path.join(folder, "s.exr")
        subprocess.run([arguments.vlf, "bake", gltf, *options, "-o", field, "-q"], check=True)
        subprocess.run([arguments.vlf, "render", field, *view(arguments.width, arguments.height),
                        "--backend", "cpu", "-o", still, "-q"], check=True)
        baked = region_sums(mi.Bitmap(still))
        off = np.abs(baked - theirs[0]) / np.maximum(theirs[0], 0.01 * theirs[0].max())
        beyond = np.maximum(0, off - 4 * theirs[1] / np.maximum(theirs[0], 1e-9))
        fine = bool(beyond.max() < 0.01)
        print(f"{'ok  ' if fine else 'FAIL'} {case + ', baked':24} regions off by at most "
              f"{100 * off.max():.2f} %, in the mean by {100 * off.mean():.2f} %", flush=True)
        agrees &= fine
    return agrees
