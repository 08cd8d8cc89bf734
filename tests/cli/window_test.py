"""The walkthrough window: what its keys do, what it remembers, how it ends.

Run as: window_test.py PATH_OF_VLF [unittest options]; needs Xvfb, xauth and xdotool.
"""

import csv
import os
import re
import subprocess
import time
import unittest
from pathlib import Path

from case import BAD_INPUT, FAILED, PROGRAM, USAGE, Case
from window_case import Screen, WindowCase


class Walkthrough(WindowCase):
    def test_keys_move_the_camera_and_change_the_exposure(self):
        self.open("--fresh")
        start = self.picture()
        self.assertEqual(start, self.picture())
        self.screen.do("keydown", "w", "sleep", "0.5", "keyup", "w")
        self.assertNotEqual(start, self.picture())
        self.press("0", "start")
        self.assertEqual(start, self.picture())
        self.press("minus", "exposure")
        self.assertNotEqual(start, self.picture())
        self.press("equal", "exposure")
        self.assertEqual(start, self.picture())
        self.press("2", "camera")
        self.assertNotEqual(start, self.picture())
        self.press("1", "camera front")
        self.assertEqual(start, self.picture())
        self.screen.do("mousemove", 100, 100, "mousedown", 1, "mousemove", 160, 120, "mouseup", 1)
        self.assertNotEqual(start, self.picture())
        self.assertNotIn("config", self.files(), "--fresh")

    def test_keys_do_what_they_say(self):
        self.open()
        for key, text in [("g", "walking"), ("g", "flying"), ("l", "plain"), ("l", "by depth"),
                          ("t", "linear"), ("t", "filmic"), ("x", "automatic"), ("x", "fixed at"),
                          ("bracketleft", "field of view"), ("Next", "field of view"),
                          ("n", "no bookmarks"), ("b", "place 1 added"),
                          ("n", "bookmark place 1"), ("c", "captured"), ("Escape", "mouse free"),
                          ("F11", "full screen"), ("F11", "window"), ("0", "start")]:
            self.press(key, text)
        self.screen.do("mousemove", 100, 100, "click", 4)
        self.hear("speed x 1.20")
        self.close()

    def test_what_lies_over_the_picture_is_not_written_nor_in_the_way(self):
        self.open("--fresh", size="600x500")
        start = self.picture()
        for key in ("Tab", "F3", "h"):
            self.screen.do("key", key)
            self.assertEqual(start, self.picture(), key)
        self.screen.do("key", "h")
        self.assertEqual(start, self.picture())
        # Over the panel the mouse is the panel's; keys are still the room's.
        self.screen.do("mousemove", 32, 98, "sleep", "0.3", "mousedown", 1, "sleep", "0.3",
                       "mouseup", 1)
        self.hear("mirrors: plain lookup")
        self.screen.do("mousemove", 32, 280, "mousedown", 1, "mousemove", 32, 300, "sleep", "0.3",
                       "mouseup", 1)
        self.assertEqual(start, self.picture())
        self.screen.do("keydown", "w", "sleep", "0.5", "keyup", "w")
        self.assertNotEqual(start, self.picture())
        self.close()
        self.assertNotIn("imgui.ini", self.files())

    def test_pictures_are_numbered_and_never_overwrite(self):
        (self.folder / "room-0001.png").write_text("precious")
        self.open("--fresh", "--camera", "front")
        self.press("F12", "room-0002.png written")
        self.press("shift+F12", "room-0001.exr written")
        self.close()
        self.assertEqual((self.folder / "room-0001.png").read_text(), "precious")
        self.run_vlf("render", "room.vlf", "--camera", "front", "--backend", "gl", "--mode",
                     "field", "--size", "320x240", "-o", "still.exr")
        self.run_vlf("compare", "room-0001.exr", "still.exr", "--json", "c.json")
        self.assertLess(self.json("c.json")["relMse"], 1e-6)

    def test_the_window_can_be_resized_hidden_and_shown_again(self):
        self.open("--fresh")
        self.screen.do("windowsize", "--sync", self.window, 200, 150)
        self.assertEqual(self.picture()[:2], (200, 150))
        self.screen.do("windowunmap", "--sync", self.window, "sleep", "0.5")
        self.screen.do("windowmap", "--sync", self.window, "windowfocus", self.window)
        self.press("t", "linear")
        self.close()

    def test_where_one_was_is_remembered(self):
        self.open(size="300x200")
        start = self.picture()
        self.screen.do("keydown", "d", "sleep", "0.5", "keyup", "d", "sleep", "0.7")
        end = self.picture()
        self.press("b", "added")
        self.close()
        self.assertNotEqual(start, end)
        self.assertEqual(self.room()["bookmarks"][0]["pose"], self.room()["pose"])
        self.assertEqual(self.remembered()["window"]["width"], 300)
        self.open(size=None)
        self.assertEqual(end, self.picture())
        self.press("0", "start")
        self.assertEqual(start, self.picture())
        self.press("n", "bookmark place 1")
        self.assertEqual(end, self.picture())
        self.close()

    def test_preferences_that_cannot_be_used_are_a_warning(self):
        path = self.folder / "config" / "vlf" / "view.json"
        path.parent.mkdir(parents=True)
        path.write_text('{"speed": "quick"}')
        self.open()
        self.press("b", "added")
        self.close()
        self.assertIn("view.json: speed: must be a number", self.program.stderr.read())
        self.assertEqual(path.read_text(), '{"speed": "quick"}')

    def test_shaders_are_loaded_anew_when_they_change(self):
        shaders = self.folder / "shaders"
        shaders.mkdir()
        self.open("--fresh", "--shaders", "shaders")
        start = self.picture()
        (shaders / "tone_map.glsl").write_text("nonsense")
        self.hear("shaders kept")
        self.assertEqual(start, self.picture())
        (shaders / "tone_map.glsl").write_text(
            "vec4 outputColor(vec3 radiance) { return vec4(1, 0, 0, 1); }")
        self.hear("shaders reloaded")
        self.assertNotEqual(start, self.picture())

    def test_every_mode_shows_something_else(self):
        self.open("--fresh", "--camera", "inside")
        pictures = [self.picture()]
        for mode in ["progressive", "raytraced", "wireframe", "normals", "directions", "subfield",
                     "tile", "chart", "field"]:
            self.press("m", f"mode {mode}")
            pictures.append(self.picture())
        self.assertEqual(pictures[0], pictures[-1])
        # Without mirrors there is nothing to trace.
        self.assertEqual(pictures[0], pictures[2])
        self.assertGreaterEqual(len(set(pictures)), 8)
        self.close()

    def test_replays_are_equal_frame_by_frame(self):
        self.open("--fresh", "--record", "walk.json")
        self.screen.do("keydown", "w", "sleep", "0.5", "keyup", "w")
        self.press("2", "camera inside")
        self.screen.do("sleep", "0.3")
        self.close()
        path = self.json("walk.json")["camera"]
        self.assertNotEqual(path[0]["eye"], path[-1]["eye"])
        shortest = min(zip(path, path[1:]), key=lambda p: p[1]["seconds"] - p[0]["seconds"])
        self.assertLess(shortest[1]["seconds"] - shortest[0]["seconds"], 1e-4, "a jump")
        self.assertNotEqual(shortest[0]["eye"], shortest[1]["eye"])
        for log in ["a.csv", "b.csv"]:
            self.open("--fresh", "--replay", "walk.json", "--fps", "20", "--log", log)
            self.assertEqual(self.program.wait(timeout=60), 0)
        rows = [[[row[c] for c in row if not c.endswith("_ms")]
                 for row in csv.DictReader((self.folder / log).read_text().splitlines())]
                for log in ["a.csv", "b.csv"]]
        self.assertEqual(rows[0], rows[1])
        self.assertGreater(len(rows[0]), 5)
        self.assertEqual(float(rows[0][2][1]), 0.1)

    def test_a_scene_is_baked_while_it_is_shown(self):
        self.open("--fresh", "--preset", "draft", "-o", "live.vlf", "--mode", "field",
                  file="cornell.obj")
        self.hear("live.vlf written, preset draft")
        self.run_vlf("bake", "cornell.obj", "-o", "room.vlf", "--preset", "draft")
        self.assertEqual((self.folder / "live.vlf").read_bytes(),
                         (self.folder / "room.vlf").read_bytes())
        first = self.picture()
        mtl = self.folder / "cornell.mtl"
        mtl.write_text(mtl.read_text().replace("Kd 0.63", "Kd 0.03"))
        self.screen.do("sleep", "4")
        self.assertNotEqual(first, self.picture(), "the wall is another colour")
        self.close()

    def test_the_window_closes_while_it_bakes(self):
        self.open("--fresh", "--preset", "high", "--texel", "0.01", file="cornell.obj")
        start = time.monotonic()
        self.close()
        self.assertLess(time.monotonic() - start, 10)

    def test_a_scene_that_cannot_be_read_opens_no_window(self):
        self.run_vlf("view", "none.obj", code=BAD_INPUT, says=["none.obj"])
        self.run_vlf("view", "room.vlf", "--preset", "draft", code=USAGE, says=["baked already"])

    def test_it_closes_after_so_many_frames(self):
        done = subprocess.run([PROGRAM, "-q", "view", "room.vlf", "--frames", "3", "--no-vsync",
                               "--samples", "2"],
                              cwd=self.folder, env=self.screen.environment, timeout=60)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.remembered()["movement"], "fly")


class Manual(Case):
    def setUp(self):
        super().setUp()
        self.manual = (Path(__file__).parents[2] / "docs" / "command-line.md").read_text()

    def test_it_has_every_option_of_the_help(self):
        for command in ["scene", "bake", "info", "render", "view", "reference", "compare",
                        "compare-dynamic", "sheet"]:
            options = re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", self.run_vlf(command, "--help").stdout,
                                 re.MULTILINE)
            self.assertGreater(len(options), 2)
            for option in options:
                self.assertRegex(self.manual, rf"{option}\b", command)

    def test_it_has_every_key_of_the_help(self):
        text = self.run_vlf("view", "--help").stdout
        rows = text.split("Keys:\n")[1].split("\n\n")[0].splitlines()
        self.assertGreater(len(rows), 20)
        for row in rows:
            keys, does = row[:26].strip(), row[26:].strip()
            self.assertIn(f"| {keys} | {does} |", self.manual)


class NoScreen(Case):
    def test_a_window_that_cannot_be_opened_is_an_error_with_advice(self):
        self.bake("room.vlf")
        environment = {k: v for k, v in os.environ.items()
                       if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run([PROGRAM, "view", "room.vlf"], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, FAILED)
        self.assertIn("vlf render", done.stderr)

    def test_a_driver_without_opengl_4_5_is_an_error_with_advice(self):
        self.bake("room.vlf")
        old = {"MESA_GL_VERSION_OVERRIDE": "4.3"}
        done = subprocess.run([PROGRAM, "render", "room.vlf", "--backend", "gl", "-o", "a.png"],
                              cwd=self.folder, env=dict(os.environ, **old), capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(done.returncode, FAILED)
        self.assertIn("--backend cpu", done.stderr)
        with Screen() as screen:
            done = subprocess.run([PROGRAM, "view", "room.vlf", "--fresh"], cwd=self.folder,
                                  env=dict(screen.environment, **old), capture_output=True,
                                  text=True, timeout=60)
        self.assertEqual(done.returncode, FAILED)
        self.assertIn("vlf render", done.stderr)


if __name__ == "__main__":
    unittest.main()
