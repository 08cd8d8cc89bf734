"""Environments and punctual lights from end to end.

Run as: light_test.py PATH_OF_VLF [unittest options]
"""

import json
import math
import unittest

from case import BAD_INPUT, USAGE, Case

OPEN_OBJ = """mtllib open.mtl
v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -2 2 -2
v 2 2 -2
v -1 0 -0.5
v 0 0 -0.5
v 0 0 0.5
v -1 0 0.5
v -1 1 -0.5
v 0 1 -0.5
v 0 1 0.5
v -1 1 0.5
usemtl floor
f 4 3 2 1
usemtl mirror
f 1 2 6 5
usemtl box
f 11 14 13 12
f 10 9 13 14
f 9 8 12 13
f 8 7 11 12
f 7 10 14 11
"""
OPEN_MTL = """newmtl floor
Kd 0.6 0.5 0.4
newmtl box
Kd 0.7 0.7 0.7
newmtl mirror
Kd 0 0 0
Ks 0.9 0.9 0.9
illum 3
"""
VIEW = ["--eye", "2.5,1.4,3.5", "--look", "0,0.6,0", "--fov", "60", "--size", "160x120"]


def rgbe(color):
    most = max(color)
    exponent = math.frexp(most)[1]
    return bytes([int(c * 256 / 2.0**exponent) for c in color] + [exponent + 128])


def write_sky(path, width=128, height=64):
    """A gradient, brighter towards the right, with a bright disc."""
    rows = [f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()]
    for y in range(height):
        for x in range(width):
            disc = (x - 90) ** 2 + (y - 14) ** 2 < 9
            rows.append(rgbe([60, 50, 40] if disc else
                             [0.2 + x / width, 0.5 + 0.4 * (height - y) / height, 0.7]))
    path.write_bytes(b"".join(rows))


def lights():
    """Three lights without any geometry."""
    kinds = [{"type": "point", "name": "bulb", "intensity": 2},
             {"type": "spot", "intensity": 9, "spot": {"outerConeAngle": 0.5}},
             {"type": "directional", "color": [1, 0.5, 0.25], "intensity": 2}]
    down = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
    nodes = [{"translation": [0.8, 1.5, 0.5], "rotation": down,
              "extensions": {"KHR_lights_punctual": {"light": i}}} for i in range(3)]
    return {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": kinds}},
            "scene": 0, "scenes": [{"nodes": [0, 1, 2]}], "nodes": nodes}


class Light(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "open.obj").write_text(OPEN_OBJ)
        (self.folder / "open.mtl").write_text(OPEN_MTL)
        (self.folder / "lights.gltf").write_text(json.dumps(lights()))
        write_sky(self.folder / "sky.hdr")

    def bake_open(self, *options):
        self.run_vlf("bake", "open.obj", *options, "-o", "open.vlf", "--preset", "draft", "--texel",
                     "0.1", "--json", "bake.json")

    def render(self, name, *options):
        self.run_vlf("render", "open.vlf", *VIEW, *options, "-o", name)

    def compare(self, a, b):
        self.run_vlf("compare", a, b, "--exposure", "auto", "--json", "compare.json")
        return self.json("compare.json")["flip"]


class Environment(Light):
    def test_a_picture_of_a_field_shows_what_the_path_tracer_does(self):
        options = ["--environment", "sky.hdr", "--environment-turn", "30", "--environment-scale",
                   "0.5"]
        self.bake_open(*options)
        self.run_vlf("reference", "open.obj", *options, *VIEW, "--spp", "256", "-o", "truth.exr")
        for mode in ["raytraced", "field"]:
            self.render("cpu.exr", "--mode", mode)
            self.render("gl.exr", "--mode", mode, "--backend", "gl")
            self.assertLess(self.compare("gl.exr", "cpu.exr"), 0.01, mode)
            self.assertLess(self.compare("cpu.exr", "truth.exr"), 0.08, mode)

    def test_the_field_tells_its_environment(self):
        self.bake_open("--environment", "sky.hdr", "--environment-turn", "-20")
        self.run_vlf("info", "open.vlf", "--json", "info.json", says=["sky.hdr (128 x 64 pixels)"])
        told = self.json("info.json")["environment"]
        self.assertEqual([told["name"], told["turn"], told["width"]], ["sky.hdr", -20, 128])
        self.bake_open("--environment", "1,2,3", "--environment-scale", "2")
        self.run_vlf("info", "open.vlf", "--json", "info.json", says=["2 4 6 W/(m² sr) all around"])
        self.bake("room.vlf")
        self.run_vlf("info", "room.vlf", "--json", "info.json")
        self.assertIsNone(self.json("info.json")["environment"])

    def test_energy_comes_in_and_leaves(self):
        self.bake_open("--environment", "1,1,1")
        energy = self.json("bake.json")["energy"]
        emitted, absorbed, escaped = (energy[k][0] for k in ("emitted", "absorbed", "escaped"))
        self.assertGreater(absorbed, 0.1 * emitted)
        self.assertGreater(escaped, 0.1 * emitted)

    def test_irradiance_is_measured_in_the_same_environment_only(self):
        self.bake_open("--environment", "sky.hdr")
        measure = ["reference", "open.obj", "--irradiance", "open.vlf", "--spp", "64", "--texels",
                   "50", "-o", "error.json"]
        self.run_vlf(*measure, code=BAD_INPUT, says=["their environment"])
        self.run_vlf(*measure, "--environment", "sky.hdr", "--environment-turn", "1",
                     code=BAD_INPUT)
        self.run_vlf(*measure, "--environment", "sky.hdr")
        self.assertEqual(len(self.json("error.json")["texels"]), 50)

    def test_what_is_no_environment_is_refused(self):
        bake = ["bake", "open.obj", "-o", "open.vlf", "--environment"]
        self.run_vlf(*bake, "1,1,-1", code=USAGE, says=["radiances from 0"])
        self.run_vlf(*bake, "1,nan,1", code=USAGE)
        self.run_vlf("bake", "open.obj", "-o", "open.vlf", "--environment-turn", "3", code=USAGE)
        write_sky(self.folder / "square.hdr", 64, 64)
        self.run_vlf(*bake, "square.hdr", code=BAD_INPUT, says=["twice as wide as high"])
        done = self.run_vlf(*bake, "nowhere.hdr", code=1)
        self.assertIn("nowhere.hdr", done.stderr)


class Punctual(Light):
    def test_a_picture_of_a_field_shows_what_the_path_tracer_does(self):
        # Without the mirror: the path tracer has none of its caustics.
        (self.folder / "open.mtl").write_text(OPEN_MTL.replace("illum 3", "illum 1")
                                              .replace("Ks 0.9 0.9 0.9", ""))
        self.run_vlf("bake", "open.obj", "lights.gltf", "-o", "open.vlf", "--preset", "draft",
                     "--texel", "0.04")
        self.run_vlf("reference", "open.obj", "lights.gltf", *VIEW, "--spp", "256", "-o",
                     "truth.exr")
        self.render("cpu.exr")
        self.render("gl.exr", "--backend", "gl")
        self.assertLess(self.compare("gl.exr", "cpu.exr"), 0.01)
        self.assertLess(self.compare("cpu.exr", "truth.exr"), 0.08)

    def test_the_field_tells_its_lights(self):
        self.run_vlf("bake", "open.obj", "lights.gltf", "-o", "open.vlf", "--preset", "draft",
                     "--texel", "0.2")
        self.run_vlf("info", "open.vlf", "--json", "info.json",
                     says=["bulb (point, 2 2 2 W/sr)", "directional, 2 1 0.5 W/m²"])
        told = self.json("info.json")["lights"]
        self.assertEqual([light["kind"] for light in told], ["point", "spot", "directional"])
        for a, b in zip(told[0]["position"], [0.8, 1.5, 0.5]):
            self.assertAlmostEqual(a, b, places=5)

    def test_a_light_that_is_none_is_named(self):
        broken = lights()
        broken["extensions"]["KHR_lights_punctual"]["lights"][1]["intensity"] = -3
        (self.folder / "lights.gltf").write_text(json.dumps(broken))
        self.run_vlf("bake", "open.obj", "lights.gltf", "-o", "open.vlf", code=BAD_INPUT,
                     says=["lights[1].intensity"])


if __name__ == "__main__":
    unittest.main()
