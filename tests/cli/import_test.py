"""Scene files from end to end.

Run as: import_test.py PATH_OF_VLF [unittest options]
"""

import base64
import json
import struct
import unittest

from case import BAD_INPUT, Case


class Gltf:
    """A document of squares, each a node with a mesh and a material of its own."""

    def __init__(self):
        self.data = b""
        self.root = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "meshes": [],
                     "materials": [], "nodes": [], "scenes": [{"nodes": []}]}

    def accessor(self, values, kind):
        parts = {"VEC3": 3, "VEC2": 2}[kind]
        bytes = struct.pack(f"<{len(values)}f", *values)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data),
                                         "byteLength": len(bytes)})
        self.root["accessors"].append({"bufferView": len(self.root["bufferViews"]) - 1,
                                       "componentType": 5126, "count": len(values) // parts,
                                       "type": kind})
        self.data += bytes
        return len(self.root["accessors"]) - 1

    def add_square(self, corners, material, colors=None):
        """Corners in order; the front is where they turn counter-clockwise."""
        attributes = {"POSITION": self.accessor(sum(corners, []), "VEC3")}
        if colors:
            attributes["COLOR_0"] = self.accessor(sum(colors, []), "VEC3")
        index = len(self.root["nodes"])
        self.root["materials"].append(material)
        self.root["meshes"].append({"primitives": [{"attributes": attributes, "mode": 6,
                                                    "material": index}]})
        self.root["nodes"].append({"mesh": index})
        self.root["scenes"][0]["nodes"].append(index)

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return json.dumps(self.root | {"buffers": [{"byteLength": len(self.data), "uri": uri}]})


class Import(Case):
    def bake_file(self, name, text, **expected):
        (self.folder / name).write_text(text)
        return self.run_vlf("bake", name, "-o", "room.vlf", "--preset", "draft", "--cells", "64",
                            **expected)

    def test_warnings_explain_why_a_scene_is_refused(self):
        self.bake_file("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", code=BAD_INPUT,
                       says=["warning: a.obj:3: lines and points skipped", "error: a.obj: no triangle"])

    def test_dropped_triangles_are_counted(self):
        self.bake_file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\nf 2 3 1\n",
                       says=["a.obj: 1 triangles without area are dropped",
                             "a.obj: 1 triangles that repeat others are dropped"])

    def test_vertex_colours_look_the_same_however_they_are_rendered(self):
        room = Gltf()
        floor = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]
        room.add_square(floor, {"pbrMetallicRoughness": {"metallicFactor": 0}},
                        [[0, 0, 1], [0, 0, 0], [1, 0, 0], [1, 0, 1]])
        lamp = [[x, 1, z] for x, _, z in reversed(floor)]
        room.add_square(lamp, {"emissiveFactor": [1, 1, 1],
                               "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}})
        self.bake_file("room.gltf", room.text())
        view = ["--eye", "0.5,0.9,0.5", "--look", "0.5,0,0.5", "--up", "0,0,-1", "--fov", "70",
                "--size", "96x96"]
        self.run_vlf("reference", "room.gltf", *view, "--spp", "256", "-o", "truth.exr")
        for options in (["--mode", "field"], ["--mode", "raytraced"],
                        ["--mode", "field", "--backend", "gl"]):
            self.run_vlf("render", "room.vlf", *view, *options, "-o", "a.exr")
            self.run_vlf("compare", "a.exr", "truth.exr", "--exposure", "auto", "--json", "c.json")
            self.assertLess(self.json("c.json")["flip"], 0.02, options)


if __name__ == "__main__":
    unittest.main()
