"""The program from end to end: what it writes, says and returns.

Run as: cli_test.py PATH_OF_VLF [unittest options]
"""

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
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
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "800x600x24"],
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
    """Keys do what the help says."""

    def setUp(self):
        super().setUp()
        self.bake("room.vlf")
        self.screen = Screen()
        self.screen.__enter__()
        self.addCleanup(self.screen.__exit__)
        self.program = subprocess.Popen([PROGRAM, "-q", "view", "room.vlf", "--size", "320x240"],
                                        cwd=self.folder, env=self.screen.environment)
        self.addCleanup(self.program.wait)
        self.addCleanup(self.program.kill)
        self.window = self.screen.do("search", "--sync", "--onlyvisible", "--name", "room.vlf")[0]
        self.screen.do("windowfocus", "--sync", self.window)

    def picture(self):
        """What the window shows, once it has been written."""
        path = self.folder / "vlf-view.png"
        path.unlink(missing_ok=True)
        self.screen.do("key", "F12")
        for _ in range(100):
            time.sleep(0.05)
            if path.exists():
                return path.read_bytes()
        self.fail("no picture was written")

    def test_keys_move_the_camera_and_change_the_exposure(self):
        start = self.picture()
        self.assertEqual(start, self.picture())
        self.screen.do("keydown", "w", "sleep", "0.3", "keyup", "w")
        self.assertNotEqual(start, self.picture())
        self.screen.do("key", "0")
        self.assertEqual(start, self.picture())
        self.screen.do("key", "minus")
        darker = self.picture()
        self.assertNotEqual(start, darker)
        self.screen.do("key", "equal")
        self.assertEqual(start, self.picture())
        self.screen.do("key", "2")
        self.assertNotEqual(start, self.picture())
        self.screen.do("key", "1")
        self.assertEqual(start, self.picture())

    def test_the_picture_is_as_large_as_the_window(self):
        self.screen.do("windowsize", "--sync", self.window, 200, 150)
        width, height = (int.from_bytes(self.picture()[i:i + 4], "big") for i in (16, 20))
        self.assertEqual((width, height), (200, 150))

    def test_escape_closes_it(self):
        self.screen.do("key", "Escape")
        self.assertEqual(self.program.wait(timeout=20), 0)


class NoScreen(Case):
    def test_a_window_that_cannot_be_opened_is_an_error_with_advice(self):
        self.bake("room.vlf")
        environment = {k: v for k, v in os.environ.items()
                       if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        done = subprocess.run([PROGRAM, "view", "room.vlf"], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, FAILED)
        self.assertIn("vlf render", done.stderr)


class Pipeline(Case):
    def test_both_backends_draw_the_same_picture(self):
        self.bake("room.vlf")
        for backend in ["cpu", "gl"]:
            self.run_vlf("render", "room.vlf", "--mode", "field", "--backend", backend, "--size",
                         "160x120", "-o", f"{backend}.exr", "--json", f"{backend}.json")
        self.assertNotIn("gpuMemory", self.json("cpu.json"))
        self.assertGreater(self.json("gl.json")["gpuMemory"]["atlas"], 0)
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

    def test_opengl_says_which_mode_it_draws(self):
        self.bake("room.vlf")
        self.run_vlf("render", "room.vlf", "--backend", "gl", "-o", "a.png", code=BAD_INPUT,
                     says=["mode field", "--backend cpu"])

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
        """Starts the program, interrupts it when the stage has begun and checks how it ends."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        said = []
        for line in process.stdout:
            said.append(line)
            if line.startswith(stage):
                break
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
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
