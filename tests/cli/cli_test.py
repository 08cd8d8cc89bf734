"""The program from end to end: what it writes, says and returns.

Run as: cli_test.py PATH_OF_VLF [unittest options]
"""

import csv
import json
import os
import queue
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib
from pathlib import Path

PROGRAM = os.path.abspath(sys.argv.pop(1))
COMMANDS = ["bake", "info", "render", "view", "reference", "compare", "scene", "sheet"]
FAILED, USAGE, BAD_INPUT, INTERRUPTED = 1, 2, 3, 130

EMPTY_OBJ = "# nothing\n"


def vlf(*arguments, folder):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True,
                          text=True, timeout=120)


class Case(unittest.TestCase):
    """A test in a folder of its own that holds the scene `cornell`."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.run_vlf("scene", "cornell", "-o", ".")

    def run_vlf(self, *arguments, code=0, says=()):
        """Runs the program, checks its exit code and what it says; returns the process."""
        done = vlf(*arguments, folder=self.folder)
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stdout}{done.stderr}")
        for text in says:
            self.assertIn(text, done.stdout + done.stderr)
        return done

    def bake(self, output, *options):
        self.run_vlf("bake", "cornell.obj", "-o", output, "--preset", "draft", "--texel", "0.2",
                     "--cells", "64", *options)
        return self.folder / output

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())

    def json(self, name):
        return json.loads((self.folder / name).read_text())


class Help(Case):
    def test_version_names_the_program(self):
        self.run_vlf("--version", says=["vlf "])

    def test_every_command_has_help_with_an_example(self):
        for command in COMMANDS:
            self.run_vlf(command, "--help", says=["Example", f"vlf {command}"])

    def test_the_program_lists_its_commands(self):
        self.run_vlf("--help", says=COMMANDS)

    def test_no_command_or_an_unknown_one_is_a_usage_error(self):
        self.run_vlf(code=USAGE)
        self.run_vlf("cook", code=USAGE)
        self.run_vlf("bake", "cornell.obj", "-o", "a.vlf", "--nonsense", code=USAGE)


class Screen:
    """A display without a screen, and the keys pressed on it."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "800x600x24",
             "-noreset"],
            pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as answer:
            self.environment = dict(os.environ, DISPLAY=f":{answer.readline().strip()}")
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()

    def do(self, *actions):
        done = subprocess.run(["xdotool", *map(str, actions)], env=self.environment,
                              capture_output=True, text=True, timeout=60)
        return done.stdout.split()


class Walkthrough(Case):
    """A window on a room, its keys pressed."""

    def setUp(self):
        super().setUp()
        self.bake("room.vlf")
        self.screen = Screen()
        self.screen.__enter__()
        self.addCleanup(self.screen.__exit__)
        self.screen.environment["XDG_CONFIG_HOME"] = str(self.folder / "config")

    def open(self, *options, size="320x240", file="room.vlf"):
        """Opens the window; `said` then holds the lines it prints."""
        if size:
            options = ("--size", size, *options)
        self.program = subprocess.Popen(
            [PROGRAM, "-v", "view", file, *options], cwd=self.folder,
            env=self.screen.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = queue.Queue()
        reader = threading.Thread(target=self.listen, args=(self.program, self.said))
        reader.start()
        for cleanup in (self.program.stderr.close, reader.join, self.program.wait,
                        self.program.kill):
            self.addCleanup(cleanup)
        self.hear("H in the window")
        self.window = self.screen.do("search", "--sync", "--onlyvisible", "--name", file)[0]
        self.screen.do("windowfocus", "--sync", self.window)

    @staticmethod
    def listen(program, said):
        with program.stdout as stream:
            for line in stream:
                said.put(line.strip())

    def hear(self, text):
        """The next line that is said, in which the text must be."""
        line = self.said.get(timeout=30)
        self.assertIn(text, line)
        return line

    def press(self, key, text):
        self.screen.do("key", key)
        return self.hear(text)

    def close(self):
        self.screen.do("key", "Escape")
        self.assertEqual(self.program.wait(timeout=30), 0)

    def picture(self):
        """What the window shows: width, height, and a number that says whether it is the same."""
        png = (self.folder / self.press("F12", "written").split()[0]).read_bytes()
        width, height = (int.from_bytes(png[i:i + 4], "big") for i in (16, 20))
        return width, height, zlib.crc32(png)

    def remembered(self):
        return json.loads((self.folder / "config" / "vlf" / "view.json").read_text())

    def room(self):
        (room,) = self.remembered()["rooms"].values()
        return room

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


class KeyTable(Case):
    def test_the_manual_has_every_key_of_the_help(self):
        manual = (Path(__file__).parents[2] / "docs" / "command-line.md").read_text()
        text = self.run_vlf("view", "--help").stdout
        rows = text.split("Keys:\n")[1].split("\n\n")[0].splitlines()
        self.assertGreater(len(rows), 20)
        for row in rows:
            keys, does = row[:26].strip(), row[26:].strip()
            self.assertIn(f"| {keys} | {does} |", manual)


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


class Pipeline(Case):
    def test_both_backends_draw_the_same_picture(self):
        self.bake("room.vlf")
        for mode in ["field", "raytraced", "progressive"]:
            for backend in ["cpu", "gl"]:
                self.run_vlf("render", "room.vlf", "--mode", mode, "--backend", backend, "--size",
                             "160x120", "-o", f"{backend}.exr", "--json", f"{backend}.json")
            self.assertNotIn("gpuMemory", self.json("cpu.json"))
            memory = self.json("gl.json")["gpuMemory"]
            self.assertGreater(memory["atlas"], 0)
            self.assertEqual(memory["hits"] > 0, mode != "field")
            self.run_vlf("compare", "gl.exr", "cpu.exr", "--exposure", "auto", "--json", "c.json")
            self.assertLess(self.json("c.json")["flip"], 0.01)

    def test_the_gpu_memory_that_info_tells_is_what_opengl_takes(self):
        self.run_vlf("scene", "mirror-room", "-o", ".")
        self.run_vlf("bake", "mirror-room.obj", "-o", "mirrors.vlf", "--preset", "draft", "--texel",
                     "0.2", "--cells", "64")
        self.run_vlf("info", "mirrors.vlf", "--gpu", "--json", "info.json",
                     says=["memory of the GPU"])
        told = self.json("info.json")["gpuMemory"]
        render = ["render", "mirrors.vlf", "--mode", "field", "--backend", "gl", "--size", "64x48",
                  "--antialias", "1", "-o", "a.png", "--json", "render.json"]
        self.run_vlf(*render)
        for part in ["geometry", "atlas", "radiance", "textures", "radianceElements"]:
            self.assertEqual(told[part], self.json("render.json")["gpuMemory"][part], part)
        half = told["total"] // 2
        self.run_vlf(*render, "--gpu-memory", half, says=["warning: mirrors are shown"])
        taken = self.json("render.json")["gpuMemory"]
        self.assertLessEqual(taken["radiance"], half)
        self.run_vlf(*render, "--gpu-memory", "1k", code=BAD_INPUT, says=["fewer --radiance-cells"])

    def test_opengl_draws_every_mode(self):
        self.bake("room.vlf")
        for mode in ("raytraced", "field", "progressive", "wireframe", "diagram"):
            self.run_vlf("render", "room.vlf", "--backend", "gl", "--mode", mode, "--size", "64x48",
                         "-o", f"{mode}.png")
            self.assertGreater((self.folder / f"{mode}.png").stat().st_size, 100)

    def test_from_scene_to_comparison(self):
        self.run_vlf("bake", "cornell.obj", "-o", "room.vlf", "--preset", "draft", "--json",
                     "bake.json")
        self.run_vlf("info", "room.vlf", "--json", "info.json")
        self.check_reports(self.json("bake.json"), self.json("info.json"))

        size = ["--size", "64x64"]
        self.run_vlf("render", "room.vlf", *size, "-o", "field.exr")
        self.run_vlf("render", "room.vlf", *size, "--mode", "wireframe", "-o", "lines.png")
        self.run_vlf("reference", "cornell.obj", *size, "--spp", "64", "-o", "truth.exr")
        self.run_vlf("compare", "field.exr", "truth.exr", "--json", "compare.json")
        self.assertGreater((self.folder / "lines.png").stat().st_size, 100)
        report = self.json("compare.json")
        key = next(k for k in report if k.lower() == "relmse")
        self.assertLess(report[key], 0.2)

    def check_reports(self, bake, info):
        self.assertEqual(bake["preset"], "draft")
        self.assertGreater(bake["texels"], 10000)
        self.assertEqual(bake["fileBytes"], (self.folder / "room.vlf").stat().st_size)
        self.assertEqual(info["fileBytes"], bake["fileBytes"])
        self.assertEqual(info["bake"]["directions"], bake["directions"])
        self.assertEqual(info["bake"]["texelSize"], bake["texelSize"])
        emitted, absorbed = bake["energy"]["emitted"], bake["energy"]["absorbed"]
        self.assertTrue(all(0 < a < e for a, e in zip(absorbed, emitted)))

    def test_irradiance_against_the_path_tracer(self):
        self.bake("room.vlf")
        self.run_vlf("reference", "cornell.obj", "--irradiance", "room.vlf", "--spp", "256",
                     "--texels", "100", "--texel-points", "-o", "error.json")
        report = self.json("error.json")
        self.assertEqual(len(report["texels"]), 100)
        for texel in report["texels"]:
            mean = [sum(axis) / len(texel["points"]) for axis in zip(*texel["points"])]
            for a, b in zip(mean, texel["position"]):
                self.assertAlmostEqual(a, b, places=4)
        self.assertLess(report["relativeRmse"], 0.1)

    def test_the_field_is_the_same_for_any_number_of_threads(self):
        one = self.bake("1.vlf", "--threads", "1").read_bytes()
        for threads in ("2", "7"):
            self.assertEqual(self.bake(f"{threads}.vlf", "--threads", threads).read_bytes(), one)


class Stereo(Case):
    SIZE = ["--size", "160x120", "--antialias", "1"]

    def setUp(self):
        super().setUp()
        self.bake("room.vlf")

    def size(self, name):
        header = (self.folder / name).read_bytes()
        return tuple(int.from_bytes(header[i:i + 4], "big") for i in (16, 20))

    def test_every_layout_writes_its_pictures(self):
        for layout in ["side-by-side", "anaglyph", "pair"]:
            self.run_vlf("render", "room.vlf", *self.SIZE, "--stereo", layout, "--convergence",
                         "2", "-o", f"{layout}.png", "--json", "r.json")
            self.assertEqual(self.json("r.json")["stereo"]["layout"], layout)
        self.assertEqual(self.size("side-by-side.png"), (320, 120))
        self.assertEqual(self.size("anaglyph.png"), (160, 120))
        self.assertEqual(self.size("pair-left.png"), (160, 120))
        self.assertNotIn("pair.png", self.files())
        left, right = (self.folder / f"pair-{eye}.png" for eye in ("left", "right"))
        self.assertNotEqual(left.read_bytes(), right.read_bytes())

    def test_eyes_without_a_distance_see_the_same(self):
        self.run_vlf("render", "room.vlf", *self.SIZE, "--stereo", "pair", "--eye-separation", "0",
                     "-o", "a.png")
        self.run_vlf("render", "room.vlf", *self.SIZE, "-o", "one.png")
        one = (self.folder / "one.png").read_bytes()
        for eye in ("left", "right"):
            self.assertEqual((self.folder / f"a-{eye}.png").read_bytes(), one)

    def test_both_backends_see_the_same_with_both_eyes(self):
        for backend in ("cpu", "gl"):
            self.run_vlf("render", "room.vlf", "--size", "160x120", "--mode", "field", "--backend",
                         backend, "--stereo", "side-by-side", "--convergence", "1.5", "-o",
                         f"{backend}.exr")
        self.run_vlf("compare", "gl.exr", "cpu.exr", "--exposure", "auto", "--json", "c.json")
        self.assertLess(self.json("c.json")["flip"], 0.01)

    def test_options_that_mean_nothing_are_refused(self):
        for options, says in [(["--eye-separation", "0.1"], "--stereo"),
                              (["--stereo", "anaglyph", "-o", "a.exr"], "display"),
                              (["--stereo", "pair", "--convergence", "0"], "--convergence"),
                              (["--stereo", "pair", "--eye-separation", "nan"], "separation")]:
            output = [] if "-o" in options else ["-o", "a.png"]
            self.run_vlf("render", "room.vlf", *options, *output, code=USAGE, says=[says])


class Film(Case):
    SIZE = ["--size", "160x120", "--antialias", "1"]
    PATH = {"format": "vlf camera path", "version": 1, "camera": [
        {"seconds": 0, "eye": [0.1, 1, 2.5], "yaw": 0, "pitch": 0, "verticalFov": 50},
        {"seconds": 1, "eye": [-0.3, 1.1, 1.5], "yaw": 20, "pitch": -5, "verticalFov": 50}]}

    def setUp(self):
        super().setUp()
        self.bake("room.vlf")
        (self.folder / "walk.json").write_text(json.dumps(self.PATH))

    def film(self, *options, **expected):
        return self.run_vlf("render", "room.vlf", "--path", "walk.json", *self.SIZE, *options,
                            **expected)

    def probe(self, name):
        done = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", name],
            cwd=self.folder, capture_output=True, text=True, check=True)
        return json.loads(done.stdout)["streams"][0]

    def middle_color(self, name):
        """Of the first frame, by ffmpeg's conversion to RGB."""
        done = subprocess.run(
            ["ffmpeg", "-v", "error", "-i", name, "-frames:v", "1", "-vf", "scale=160:120", "-f",
             "rawvideo", "-pix_fmt", "rgb24", "-"], cwd=self.folder, capture_output=True,
            check=True)
        return [sum(done.stdout[c::3]) / (160 * 120) for c in range(3)]

    def test_a_film_has_the_frames_of_its_path(self):
        self.film("--film", "a.mp4", "--fps", "12", "--log", "log.csv", "--json", "r.json")
        stream = self.probe("a.mp4")
        self.assertEqual((stream["width"], stream["height"]), (160, 120))
        self.assertEqual(stream["nb_read_frames"], "12")
        self.assertAlmostEqual(float(stream["duration"]), 1, places=3)
        self.assertEqual((stream["codec_name"], stream["pix_fmt"]), ("h264", "yuv420p"))
        report = self.json("r.json")["film"]
        self.assertEqual(report["frames"], 12)
        self.assertGreaterEqual(report["milliseconds"]["total"]["p99OverMedian"], 1)
        rows = (self.folder / "log.csv").read_text().splitlines()
        self.assertEqual(len(rows), 13)
        self.assertTrue(rows[0].startswith("frame,path_time_s,cpu_ms,gpu_ms,total_ms,"))
        self.assertEqual(float(rows[12].split(",")[1]), round(11 / 12, 6))

    def test_a_film_has_the_colours_of_its_pictures(self):
        self.film("--film", "a.mp4", "--to", "1f", "--exposure", "0", "--crf", "5")
        self.film("-o", "a%d.png", "--to", "1f", "--exposure", "0")
        for a, b in zip(self.middle_color("a.mp4"), self.middle_color("a0.png")):
            self.assertAlmostEqual(a, b, delta=1.5)

    def test_frames_are_the_same_every_time(self):
        for backend in ("cpu", "gl"):
            runs = []
            for threads in ("1", "2", "2"):
                self.film("--threads", threads, "-o", "f-%03d.exr", "--fps", "3", "--mode",
                          "field", "--backend", backend)
                frames = sorted(self.folder.glob("f-*.exr"))
                runs.append([frame.read_bytes() for frame in frames])
            self.assertEqual([f.name for f in frames], [f"f-00{i}.exr" for i in range(3)])
            self.assertEqual(runs[0], runs[1])
            self.assertEqual(runs[1], runs[2])
            self.assertNotEqual(runs[0][0], runs[0][1])

    def test_a_part_of_a_film_has_the_frames_of_the_whole(self):
        self.film("-o", "all-%d.png", "--fps", "5")
        self.film("-o", "part-%d.png", "--fps", "5", "--from", "0.4", "--to", "4f")
        self.assertEqual([f for f in self.files() if f.startswith("part")],
                         ["part-2.png", "part-3.png"])
        for i in (2, 3):
            self.assertEqual((self.folder / f"part-{i}.png").read_bytes(),
                             (self.folder / f"all-{i}.png").read_bytes())

    def test_a_tour_visits_the_cameras(self):
        self.run_vlf("render", "room.vlf", "--tour", *self.SIZE, "--exposure", "0", "-o", "t%d.png",
                     "--to", "1f")
        self.run_vlf("render", "room.vlf", *self.SIZE, "--exposure", "0", "-o", "first.png")
        self.run_vlf("compare", "t0.png", "first.png", "--json", "c.json")
        self.assertLess(self.json("c.json")["flip"], 0.002)

    def test_films_for_two_eyes(self):
        for layout, files in [("side-by-side", {"a.mp4": 320}), ("anaglyph", {"a.mp4": 160}),
                              ("pair", {"a-left.mp4": 160, "a-right.mp4": 160})]:
            self.film("--film", "a.mp4", "--fps", "2", "--stereo", layout)
            for name, width in files.items():
                stream = self.probe(name)
                self.assertEqual((stream["width"], stream["nb_read_frames"]), (width, "2"))

    def test_what_makes_no_film_is_a_usage_error(self):
        for options, says in [
                (["--film", "a.avi"], ".mp4"),
                (["-o", "a.png"], "%05d"),
                (["-o", "a%d-%d.png"], "%05d"),
                (["-o", "a%5d.png"], "%05d"),
                ([], "--film"),
                (["--film", "a.mp4", "--fps", "0"], "--fps"),
                (["--film", "a.mp4", "--from", "soon"], "--from"),
                (["--film", "a.mp4", "--log", "log.txt"], ".csv"),
                (["--film", "a.mp4", "--camera", "front"], "--camera"),
                (["--film", "a.mp4", "-o", "b%d.png"], "--film")]:
            self.film(*options, code=USAGE, says=[says])
        self.run_vlf("render", "room.vlf", "--film", "a.mp4", code=USAGE, says=["--path"])
        self.run_vlf("render", "room.vlf", "--tour", "--film", "a.mp4", "--size", "161x120",
                     code=USAGE, says=["even", "162x120"])
        self.run_vlf("render", "room.vlf", "-o", "a.png", "--log", "a.csv", code=USAGE,
                     says=["--log"])
        self.assertEqual(self.files(), sorted(["room.vlf", "walk.json"] + self.scene_files()))

    def scene_files(self):
        return [f for f in self.files() if f.startswith("cornell")]

    def test_a_damaged_path_is_named_with_its_element(self):
        text = json.dumps(self.PATH)
        (self.folder / "walk.json").write_text(text.replace('"yaw": 20', '"yaw": "left"'))
        self.film("--film", "a.mp4", code=BAD_INPUT, says=["walk.json", "camera[1].yaw"])
        (self.folder / "walk.json").unlink()
        self.film("--film", "a.mp4", code=FAILED, says=["walk.json"])

    def test_a_range_without_frames_is_refused(self):
        self.film("--film", "a.mp4", "--from", "2", code=BAD_INPUT, says=["--from", "30", "1.000 s"])

    def with_ffmpeg(self, script):
        """Renders a film over an old one with this script in place of ffmpeg, or with none."""
        programs = self.folder / "programs"
        programs.mkdir(exist_ok=True)
        if script:
            (programs / "ffmpeg").write_text("#!/bin/sh\n" + script)
            (programs / "ffmpeg").chmod(0o755)
        (self.folder / "a.mp4").write_text("old")
        before = self.files()
        done = subprocess.run([PROGRAM, "render", "room.vlf", "--path", "walk.json", *self.SIZE,
                               "--film", "a.mp4"], cwd=self.folder, capture_output=True, text=True,
                              env=dict(os.environ, PATH=str(programs)), timeout=60)
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertEqual((self.folder / "a.mp4").read_text(), "old")
        self.assertEqual(self.files(), before)
        return done.stderr

    def test_without_ffmpeg_there_is_advice(self):
        self.assertIn("install", self.with_ffmpeg(None))

    def test_what_ffmpeg_says_when_it_fails_is_passed_on(self):
        at_once = self.with_ffmpeg("echo one >&2; echo no such codec >&2; exit 1\n")
        self.assertIn("a.mp4", at_once)
        self.assertIn("no such codec", at_once)
        reading = "exec 3<&0; while read -r line <&3; do :; done; echo disk full >&2; exit 1\n"
        self.assertIn("disk full", self.with_ffmpeg(reading))
        self.assertIn("says nothing", self.with_ffmpeg("kill -9 $$\n"))


class BadInput(Case):
    def bake_fails(self, scene, code, says, output="a.vlf", *options):
        self.run_vlf("bake", scene, "-o", output, "--preset", "draft", *options, code=code,
                     says=says)
        self.assertFalse((self.folder / "a.vlf").exists())

    def test_a_missing_scene_is_named(self):
        done = vlf("bake", "none.obj", "-o", "a.vlf", folder=self.folder)
        self.assertIn(done.returncode, (FAILED, BAD_INPUT))
        self.assertIn("none.obj", done.stderr)
        self.assertNotIn("a.vlf", self.files())

    def test_a_bad_preset_is_a_usage_error(self):
        self.run_vlf("bake", "cornell.obj", "-o", "a.vlf", "--preset", "best", code=USAGE,
                     says=["preset"])

    def test_options_of_pictures_are_no_options_of_irradiance(self):
        self.bake("room.vlf")
        for option in (["--max-depth", "3"], ["--size", "8x8"], ["--camera", "front"]):
            self.run_vlf("reference", "cornell.obj", "--irradiance", "room.vlf", "--spp", "4",
                         "-o", "error.json", *option, code=USAGE, says=[option[0], "--irradiance"])
        self.assertNotIn("error.json", self.files())

    def test_an_empty_scene_is_named(self):
        (self.folder / "empty.obj").write_text(EMPTY_OBJ)
        self.bake_fails("empty.obj", BAD_INPUT, ["empty.obj"])

    def test_a_damaged_scene_is_named_with_its_line(self):
        (self.folder / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n")
        self.bake_fails("bad.obj", BAD_INPUT, ["bad.obj", "3"])

    def test_an_output_without_folder_is_named(self):
        done = vlf("bake", "cornell.obj", "-o", "no/such/a.vlf", folder=self.folder)
        self.assertIn(done.returncode, (FAILED, BAD_INPUT))
        self.assertIn("no/such", done.stderr)

    def test_an_output_that_cannot_be_written_is_named(self):
        (self.folder / "a.vlf").mkdir()
        self.run_vlf("bake", "cornell.obj", "-o", "a.vlf", "--preset", "draft", "--texel", "0.3",
                     code=FAILED, says=["a.vlf"])
        self.assertEqual([f for f in self.files() if f.startswith("a.vlf")], ["a.vlf"])

    def test_too_little_memory_is_refused_with_advice(self):
        self.bake_fails("cornell.obj", BAD_INPUT, ["GiB", "--texel"], "a.vlf", "--texel", "0.002",
                        "--max-memory", "0.2")

    def test_absurdly_small_texels_are_refused(self):
        self.bake_fails("cornell.obj", BAD_INPUT, ["texels"], "a.vlf", "--texel", "1e-7")

    def test_what_is_no_field_file_is_named(self):
        (self.folder / "not.vlf").write_text("this is no field file")
        for command in (["info"], ["render", "-o", "a.png"]):
            self.run_vlf(*command, "not.vlf", code=BAD_INPUT, says=["not.vlf"])

    def test_a_truncated_field_file_is_refused(self):
        whole = self.bake("room.vlf").read_bytes()
        (self.folder / "half.vlf").write_bytes(whole[: len(whole) // 2])
        self.run_vlf("info", "half.vlf", code=BAD_INPUT, says=["half.vlf"])


class FullDisk(Case):
    def test_a_bake_that_finds_no_room_for_its_file_leaves_the_old_one(self):
        old = self.bake("room.vlf").read_bytes()
        before = self.files()

        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (len(old) // 2, len(old) // 2))

        done = subprocess.run([PROGRAM, "bake", "cornell.obj", "-o", "room.vlf", "--preset", "draft",
                               "--texel", "0.2"], cwd=self.folder, capture_output=True, text=True,
                              preexec_fn=limit_files, timeout=120)
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertIn("room.vlf", done.stderr)
        self.assertEqual((self.folder / "room.vlf").read_bytes(), old)
        self.assertEqual(self.files(), before)

    def test_a_full_device_is_named(self):
        if os.path.exists("/dev/full"):
            self.run_vlf("bake", "cornell.obj", "-o", "/dev/full", "--preset", "draft", "--texel",
                         "0.3", code=FAILED, says=["/dev/full", "No space left"])

    def test_a_bake_can_be_thrown_away(self):
        self.run_vlf("bake", "cornell.obj", "-o", "/dev/null", "--preset", "draft", "--texel", "0.3")


class Interrupt(Case):
    """Ctrl-C while a stage of the work goes on."""

    LONGEST = 10  # seconds until the program ends, on a busy machine and with sanitizers

    def interrupt(self, stage, *arguments):
        """Starts the program, interrupts it when the stage has begun and checks how it ends.

        As at a terminal, the signal goes to all processes of the group.
        """
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        said = []
        for line in process.stdout:
            said.append(line)
            if line.startswith(stage):
                break
        time.sleep(0.2)
        os.killpg(process.pid, signal.SIGINT)
        rest, _ = process.communicate(timeout=self.LONGEST)
        self.assertEqual(process.returncode, INTERRUPTED, "".join(said) + rest)

    def leaves_alone(self, name, stage, *arguments):
        old = (self.folder / name).read_bytes()
        before = self.files()
        self.interrupt(stage, *arguments)
        self.assertEqual((self.folder / name).read_bytes(), old)
        self.assertEqual(self.files(), before)

    def test_a_bake_leaves_the_old_file(self):
        self.bake("room.vlf")
        bake = ["bake", "cornell.obj", "-o", "room.vlf", "--preset", "high", "--json", "bake.json"]
        (self.folder / "bake.json").write_text("old")
        self.leaves_alone("room.vlf", "direct light", *bake, "--texel", "0.01", "--direct-samples",
                          "4096")
        self.leaves_alone("room.vlf", "bounces", *bake, "--texel", "0.02", "--direct-samples", "1",
                          "--cells", "4096")

    def test_a_bake_of_mirrors_leaves_the_old_file(self):
        self.bake("room.vlf")
        self.run_vlf("scene", "mirror-room", "--triangles", "1000", "-o", ".")
        self.leaves_alone("room.vlf", "radiance field", "bake", "mirror-room.obj", "-o", "room.vlf",
                          "--preset", "draft", "--texel", "0.3", "--radiance-directions", "8193",
                          "--radiance-cells", "512")

    def test_a_still_leaves_the_old_picture(self):
        self.bake("room.vlf")
        (self.folder / "a.png").write_text("old")
        for mode in ("raytraced", "wireframe"):
            self.leaves_alone("a.png", "rendering", "render", "room.vlf", "--mode", mode, "--size",
                              "6000x5000", "--antialias", "16", "-o", "a.png")

    def test_a_film_leaves_the_old_film(self):
        self.bake("room.vlf")
        (self.folder / "a.mp4").write_text("old")
        self.leaves_alone("a.mp4", "frames", "render", "room.vlf", "--tour", "--film", "a.mp4",
                          "--log", "a.csv")

    def test_measuring_irradiance_leaves_the_old_report(self):
        self.bake("room.vlf")
        (self.folder / "a.json").write_text("old")
        self.leaves_alone("a.json", "path tracing texels", "reference", "cornell.obj",
                          "--irradiance", "room.vlf", "--spp", "1000000", "-o", "a.json")

    def test_path_tracing_keeps_what_there_is(self):
        self.interrupt("path tracing", "reference", "cornell.obj", "--size", "64x48", "--spp",
                       "100000000", "-o", "a.exr")
        self.run_vlf("compare", "a.exr", "a.exr")
        self.assertFalse([f for f in self.files() if ".tmp" in f])


if __name__ == "__main__":
    unittest.main()
