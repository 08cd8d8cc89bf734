"""Objects in the pictures of the program, and the comparison with a new bake.

Run as: objects_test.py PATH_OF_VLF [unittest options]
"""

import json
import signal
import subprocess
import time
import unittest

from case import BAD_INPUT, INTERRUPTED, PROGRAM, USAGE, Case

SMALL = ["--size", "80x60"]
NEAR = ["--eye", "2.5,2,-1", "--look", "3.6,0.4,1.2"]
CUBE = "cube:0.8:red@3.6,0.4,1.2"
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class Render(Case):
    def picture(self, *options, output="picture.exr"):
        self.run_vlf("render", "room.vlf", *SMALL, "-o", output, *options)
        return (self.folder / output).read_bytes()

    def difference(self, test, reference):
        self.run_vlf("compare", test, reference, "--exposure", "auto", "--json", "c.json")
        return self.json("c.json")["flip"]

    def setUp(self):
        super().setUp()
        self.bake("room.vlf")

    def test_an_object_is_seen_in_every_mode(self):
        for mode in ["raytraced", "field", "progressive", "wireframe"]:
            without = self.picture("--mode", mode)
            # Without its shadow, too.
            self.assertNotEqual(self.picture("--mode", mode, "--object", CUBE, "--shadow", "none"),
                                without, mode)

    def test_an_object_far_away_changes_nothing(self):
        self.assertEqual(self.picture("--object", "cube:1@900,0,0"), self.picture())

    def test_the_room_has_the_shadow_and_the_colour_of_an_object(self):
        cube = ["--object", CUBE, "--mode", "field", "--shading", "flat"]
        pictures = {self.picture(*cube, "--shadow", shadow)
                    for shadow in ["none", "hard", "soft", "field"]}
        self.assertEqual(len(pictures), 4)

    def test_both_backends_draw_the_same_objects(self):
        self.picture("--mode", "field", output="without.exr")
        for backend in ["cpu", "gl"]:
            self.picture("--object", CUBE, "--mode", "field", "--backend", backend,
                         output=f"{backend}.exr")
        apart = self.difference("gl.exr", "cpu.exr")
        self.assertLess(apart, 0.03)
        self.assertGreater(self.difference("cpu.exr", "without.exr"), 2 * apart)

    def test_stills_show_a_moment_of_the_scenario(self):
        motion = {"keyframes": [{"seconds": 0, "position": [3.6, 0.4, 1.2]},
                                {"seconds": 2, "position": [3.6, 2.4, 1.2]}]}
        (self.folder / "s.json").write_text(json.dumps({
            "format": "vlf scenario", "version": 1,
            "objects": [{"shape": "cube", "scale": 0.8, "position": [3.6, 0.4, 1.2],
                         "material": {"diffuse": [0.63, 0.065, 0.05]}, "motion": motion}]}))
        start = self.picture("--scenario", "s.json")
        self.assertEqual(start, self.picture("--object", CUBE))
        end = self.picture("--scenario", "s.json", "--moment", "2")
        self.assertEqual(end, self.picture("--object", CUBE.replace("0.4", "2.4")))
        self.assertNotEqual(start, end)
        for command in [["render", "room.vlf", "-o", "a.png"], ["compare-dynamic", "room.vlf"]]:
            self.run_vlf(*command, "--moment", "2", code=USAGE, says=["--scenario"])
            for moment in ["nan", "-1", "86401"]:
                self.run_vlf(*command, "--scenario", "s.json", "--moment", moment, code=USAGE,
                             says=["--moment", "between 0 and 86400"])

    def test_films_show_the_scenario_from_its_beginning(self):
        camera = {"eye": [2.78, 2.73, -8], "yaw": 180, "pitch": 0, "verticalFov": 39}
        (self.folder / "path.json").write_text(json.dumps({
            "format": "vlf camera path", "version": 1,
            "camera": [{"seconds": s, **camera} for s in (0, 1)]}))
        (self.folder / "s.json").write_text(json.dumps({
            "format": "vlf scenario", "version": 1, "objects": [
                {"shape": "cube", "position": [4, 0.5, 1], "shading": "flat", "shadow": "none",
                 "motion": {"circle": {"centre": [2.78, 0.5, 2.8], "degreesPerSecond": 40}}}]}))
        self.run_vlf("render", "room.vlf", *SMALL, "--path", "path.json", "--scenario", "s.json",
                     "--fps", "2", "-o", "f%d.exr")
        frames = [(self.folder / f"f{i}.exr").read_bytes() for i in range(2)]
        self.assertNotEqual(*frames)
        eye = ["--eye", "2.78,2.73,-8", "--look", "2.78,2.73,0", "--fov", "39"]
        self.picture("--scenario", "s.json", "--moment", "0.5", *eye)
        (self.folder / "f1.exr").rename(self.folder / "film.exr")
        self.assertLess(self.difference("film.exr", "picture.exr"), 1e-3)
        (self.folder / "f0.exr").rename(self.folder / "film.exr")
        self.assertGreater(self.difference("film.exr", "picture.exr"), 1e-2)

    def test_a_file_is_an_object(self):
        (self.folder / "shape.obj").write_text(TRIANGLE)
        self.assertNotEqual(self.picture("--object", "shape.obj@2,2,1"), self.picture())

    def test_object_files_that_cannot_be_used_are_named(self):
        (self.folder / "empty.obj").write_text("# nothing\n")
        (self.folder / "nan.obj").write_text(TRIANGLE.replace("v 1 0 0", "v nan 0 0"))
        (self.folder / "cut.glb").write_bytes(b"glTF\2\0\0\0")
        for name in ["empty.obj", "nan.obj", "cut.glb", "missing.obj"]:
            self.run_vlf("render", "room.vlf", "--object", name, "-o", "a.png", code=BAD_INPUT,
                         says=[name])
            self.assertNotIn("a.png", self.files())

    def test_what_is_no_object_is_a_usage_error(self):
        for text in ["teapot", "cube:-1", "cube:pink", "shape.txt"]:
            self.run_vlf("render", "room.vlf", "--object", text, "-o", "a.png", code=USAGE,
                         says=["--object"])


class CompareDynamic(Case):
    def setUp(self):
        super().setUp()
        self.bake("room.vlf")

    def compare(self, *options, **expected):
        return self.run_vlf("compare-dynamic", "room.vlf", "--object", CUBE, *SMALL, *NEAR,
                            *options, **expected)

    def test_reports_faces_and_texels_and_writes_a_sheet(self):
        self.compare("-o", "sheet.png", "--json", "r.json", says=["FLIP", "face", "of the change"])
        report = self.json("r.json")
        self.assertGreaterEqual(len(report["faces"]), 2)
        for face in report["faces"]:
            self.assertGreater(face["pixels"], 0)
            self.assertLess(abs(face["error"]), 0.2)
        self.assertGreater(report["room"]["changedTexels"], 0)
        self.assertLess(report["flip"], 0.1)
        self.assertEqual(report["truth"], "rebake")
        png = (self.folder / "sheet.png").read_bytes()
        self.assertTrue(png.startswith(b"\x89PNG"))
        self.assertGreaterEqual(int.from_bytes(png[16:20], "big"), 3 * 80)
        self.compare("-o", "sheet.jpg", code=USAGE, says=["must end in .png"])

    def test_simpler_shading_is_a_greater_error(self):
        errors = {}
        for shading in ["flat", "gather"]:
            self.compare("--shading", shading, "--json", "r.json")
            errors[shading] = self.json("r.json")
        for measure in ["flip", "relMse", "meanFaceError"]:
            self.assertLess(2 * errors["gather"][measure], errors["flat"][measure], measure)

    def test_no_shadow_is_a_greater_error(self):
        errors = []
        for shadow in ["field", "none"]:
            self.compare("--shadow", shadow, "--json", "r.json")
            errors.append(self.json("r.json")["room"]["changeError"])
        self.assertLess(errors[0], errors[1])
        self.assertAlmostEqual(errors[1], 1, delta=0.05)

    def test_paths_are_a_truth_too(self):
        self.compare("--truth", "path", "--spp", "16", "--json", "r.json")
        report = self.json("r.json")
        self.assertNotIn("room", report)
        self.assertEqual(report["truth"], "path")
        self.assertGreaterEqual(len(report["faces"]), 2)
        self.assertLess(report["meanFaceError"], 0.2)

    def test_options_of_one_truth_are_refused_with_the_other(self):
        self.compare("--spp", "16", code=USAGE, says=["--spp", "needs --truth path"])
        self.compare("--truth", "path", "--cells", "64", code=USAGE, says=["bakes nothing"])

    def test_without_an_object_there_is_nothing_to_compare(self):
        self.run_vlf("compare-dynamic", "room.vlf", code=USAGE, says=["--object"])

    def test_an_interrupt_leaves_the_old_report(self):
        report = self.folder / "r.json"
        report.write_text("old")
        process = subprocess.Popen(
            [PROGRAM, "compare-dynamic", "room.vlf", "--object", CUBE, "--texel", "0.02",
             "--directions", "8193", "--cells", "1024", "--json", "r.json"],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED)
        self.assertEqual(report.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
