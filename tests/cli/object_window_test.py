"""Objects in the walkthrough's window: added, moved by keys and mouse, recorded and replayed.

Run as: object_window_test.py PATH_OF_VLF [unittest options]; needs Xvfb, xauth and xdotool.
"""

import csv
import json
import unittest

from case import BAD_INPUT, USAGE
from window_case import WindowCase

CUBE = "cube:0.6:red@4.2,0.3,1"
CHEAP = ["--shading", "flat", "--shadow", "none"]


class Objects(WindowCase):
    def hold(self, *keys):
        for key in keys:
            self.screen.do("keydown", key)
        self.screen.do("sleep", "0.25")
        for key in reversed(keys):
            self.screen.do("keyup", key)

    def objects(self, file):
        return self.json(file)["objects"]

    def test_keys_move_the_camera_or_the_object(self):
        self.open("--fresh", "--object", CUBE, *CHEAP)
        start = self.picture()
        self.press("o", "keys move cube")
        for keys in [("w",), ("x",), ("a",), ("d",), ("ctrl", "w"), ("ctrl", "x"), ("ctrl", "a"),
                     ("ctrl", "d"), ("q",), ("z",)]:
            before = self.picture()
            self.hold(*keys)
            self.assertNotEqual(before, self.picture(), keys)
        self.press("o", "keys move the camera")
        self.press("x", "automatic")
        self.press("x", "fixed")
        self.press("Delete", "removed cube")
        empty = self.picture()
        self.press("0", "start")
        self.assertEqual(empty, self.picture(), "the camera has not moved")
        self.assertNotEqual(empty, start)
        self.close()

    def test_keys_move_the_object_as_they_say(self):
        for keys, sign in [([("a",), ("ctrl", "w"), ("w",)], [-1, 1, -1]),
                           ([("d",), ("ctrl", "x"), ("x",)], [1, -1, 1])]:
            frames = self.recorded(keys)
            for axis in range(3):
                way = frames[-1]["position"][axis] - frames[0]["position"][axis]
                self.assertGreater(sign[axis] * way, 0.05, (keys, axis))
        for keys, axis in [(("ctrl", "a"), [0, 1, 0]), (("ctrl", "d"), [0, -1, 0]),
                           (("q",), [1, 0, 0]), (("z",), [-1, 0, 0])]:
            frames = self.recorded([keys])
            self.assertEqual(frames[-1]["position"], frames[0]["position"])
            turn = frames[-1]["rotation"]
            self.assertGreater(turn["degrees"], 3, keys)
            self.assertLess(turn["degrees"], 180, keys)
            self.assertEqual([round(a, 3) for a in turn["axis"]], axis, keys)

    def recorded(self, keys):
        """The keyframes of a cube that these keys have moved."""
        self.open("--fresh", "--object", CUBE, *CHEAP, "--record", "walk.json")
        self.press("o", "keys move cube")
        for key in keys:
            self.hold(*key)
        self.close()
        return self.objects("walk.json")[0]["motion"]["keyframes"]

    def test_a_click_selects_and_the_gizmo_moves(self):
        self.open("--fresh", "--object", "cube:1.5@2.78,2.73,1", *CHEAP, size="400x300")
        start = self.picture()
        self.screen.do("mousemove", 200, 150, "click", 1)
        self.hear("selected cube")
        self.assertEqual(start, self.picture(), "the gizmo is not of the picture")
        self.screen.do("mousemove", 200, 75, "sleep", "0.2", "mousedown", 1, "mousemove", 200, 60,
                       "mousemove", 200, 40, "sleep", "0.2", "mouseup", 1)
        moved = self.picture()
        self.assertNotEqual(start, moved)
        self.press("Delete", "removed")
        empty = self.picture()
        self.assertNotEqual(moved, empty)
        self.press("0", "start")
        self.assertEqual(empty, self.picture(), "the camera has not moved")
        self.close()

    def test_replays_have_the_objects_equal_frame_by_frame(self):
        self.open("--fresh", "--object", CUBE, *CHEAP, "--record", "walk.json")
        self.press("o", "keys move cube")
        self.hold("w")
        self.hold("ctrl", "a")
        self.close()
        walk = self.json("walk.json")
        self.assertEqual(walk["version"], 2)
        self.assertGreater(len(walk["objects"][0]["motion"]["keyframes"]), 5)
        for record, log in [("a.json", "a.csv"), ("b.json", "b.csv")]:
            self.open("--fresh", "--replay", "walk.json", "--fps", "20", "--log", log, "--record",
                      record)
            self.assertEqual(self.program.wait(timeout=60), 0)
        self.assertEqual((self.folder / "a.json").read_bytes(),
                         (self.folder / "b.json").read_bytes())
        frames, recorded = (self.objects(file)[0]["motion"]["keyframes"]
                            for file in ("a.json", "walk.json"))
        self.assertNotEqual(frames[0]["position"], frames[-1]["position"])
        for end in (0, -1):
            for a, b in zip(frames[end]["position"], recorded[end]["position"]):
                self.assertAlmostEqual(a, b, delta=1e-4)
        with open(self.folder / "a.csv", encoding="utf-8") as log:
            rows = list(csv.DictReader(log))
        self.assertTrue(all(float(row["objects_ms"]) >= 0 for row in rows))
        self.run_vlf("view", "room.vlf", "--fresh", "--replay", "walk.json", "--object", CUBE,
                     code=BAD_INPUT, says=["walk.json", "leave out --object"])

    def test_a_scenario_moves_by_itself_until_it_is_paused(self):
        (self.folder / "scene.json").write_text(json.dumps({
            "format": "vlf scenario", "version": 1, "objects": [
                {"shape": "cube", "position": [4.2, 0.5, 1], "scale": 0.6, "shading": "flat",
                 "shadow": "none", "motion": {"turn": {"degreesPerSecond": 40}}}]}))
        self.open("--fresh", "--scenario", "scene.json")
        first = self.picture()
        self.screen.do("sleep", "0.3")
        self.assertNotEqual(first, self.picture())
        self.press("p", "stand still")
        still = self.picture()
        self.screen.do("sleep", "0.3")
        self.assertEqual(still, self.picture())
        self.press("p", "go on")
        self.close()

    def test_dynamic_light_is_compared_with_the_room_baked_again(self):
        self.open("--fresh", "--object", CUBE, *CHEAP)
        before = self.picture()
        self.press("v", "comparing")
        self.hear("baked again")
        side = self.picture()
        self.press("v", "wipe: dynamic | baked again")
        self.screen.do("mousemove", 0, 100, "sleep", "0.2")
        truth = self.picture()
        self.screen.do("mousemove", 799, 100, "sleep", "0.2")
        dynamic = self.picture()
        self.assertEqual(len({side, truth, dynamic}), 3)
        self.assertEqual(dynamic, before)
        self.press("v", "wipe: dynamic | error")
        self.press("v", "comparison ended")
        self.assertEqual(before, self.picture())
        self.press("v", "comparing")
        self.hear("baked again")
        self.press("o", "keys move cube")
        self.screen.do("keydown", "w")
        while "the room has changed" not in self.said.get(timeout=30):
            pass
        self.screen.do("keyup", "w")
        self.press("v", "comparing")
        self.close()

    def test_both_sides_of_a_comparison_have_the_same_shaders(self):
        shaders = self.folder / "shaders"
        shaders.mkdir()
        self.open("--fresh", "--object", CUBE, *CHEAP, "--shaders", "shaders")
        self.press("v", "comparing")
        self.hear("baked again")
        self.press("v", "wipe")
        (shaders / "tone_map.glsl").write_text(
            "vec4 outputColor(vec3 radiance) { return vec4(1, 0, 0, 1); }")
        self.hear("shaders reloaded")
        pictures = set()
        for x in (0, 799):
            self.screen.do("mousemove", x, 100, "sleep", "0.2")
            pictures.add(self.picture())
        self.assertEqual(len(pictures), 1, "all is red")
        self.close()

    def test_there_is_nothing_to_compare_without_an_object(self):
        (self.folder / "scene.json").write_text(json.dumps({
            "format": "vlf scenario", "version": 1,
            "objects": [{"shape": "cube", "visible": False}]}))
        self.open("--fresh", "--scenario", "scene.json")
        self.press("v", "no object to compare")
        self.press("j", "all objects are hidden")
        self.close()

    def test_what_cannot_be_put_into_the_room_opens_no_window(self):
        for option, code, says in [
                (["--object", "brick"], USAGE, ["brick", "scene file", "cube, sphere, knot"]),
                (["--object", "cube:huge"], USAGE, ["huge", "size in metres", "white"]),
                (["--object", "cube@1,2"], USAGE, ["cube@1,2"]),
                (["--shading", "nice"], USAGE, ["--shading"]),
                (["--object", "none.obj@0,0,0"], BAD_INPUT, ["--object none.obj", "none.obj"]),
                (["--scenario", "bad.json"], BAD_INPUT, ["bad.json: objects[0].scale"])]:
            (self.folder / "bad.json").write_text(
                '{"format": "vlf scenario", "version": 1, "objects": [{"shape": "cube", '
                '"scale": -1}]}')
            self.run_vlf("view", "room.vlf", *option, code=code, says=says)


if __name__ == "__main__":
    unittest.main()
