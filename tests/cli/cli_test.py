"""The program from end to end: what it writes, says and returns.

Run as: cli_test.py PATH_OF_VLF [unittest options]
"""

import json
import os
import resource
import signal
import subprocess
import time
import unittest

from case import BAD_INPUT, FAILED, INTERRUPTED, PROGRAM, USAGE, Case, vlf

COMMANDS = ["bake", "info", "render", "view", "reference", "compare", "compare-dynamic", "scene",
            "sheet"]
EMPTY_OBJ = "# nothing\n"


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

    def test_a_bake_tells_and_shows_its_error(self):
        self.bake("room.vlf", "--json", "bake.json", "--error-map", "map.png", "--size", "80x60")
        error = self.json("bake.json")["estimatedError"]
        self.assertTrue(0 < error["ofTexels"] < error["interpolated"] < 0.3, error)
        self.run_vlf("info", "room.vlf", "--json", "info.json")
        self.assertEqual(self.json("info.json")["bake"]["texelError"], error["ofTexels"])
        self.assertGreater((self.folder / "map.png").stat().st_size, 500)
        self.run_vlf("reference", "cornell.obj", "--irradiance", "room.vlf", "--spp", "256",
                     "--texels", "100", "--interpolated", "-o", "error.json")
        self.assertEqual(len(self.json("error.json")["texels"]), 100)

    def test_adaptive_texels_are_told_shown_and_measured(self):
        for threads in ("1", "3"):
            self.run_vlf("bake", "cornell.obj", "-o", f"{threads}.vlf", "--preset", "draft",
                         "--texel", "0.06", "--cells", "64", "--threads", threads,
                         "--adaptive-texels", "--json", "bake.json")
        self.assertEqual((self.folder / "1.vlf").read_bytes(),
                         (self.folder / "3.vlf").read_bytes())
        report = self.json("bake.json")
        sizes = report["texelSizes"]
        self.assertGreater(len(sizes), 2)
        self.assertEqual(sum(size["texels"] for size in sizes), report["texels"])
        self.assertLess(sizes[0]["size"], report["texelSize"])
        self.run_vlf("reference", "cornell.obj", "--irradiance", "1.vlf", "--spp", "256",
                     "--texels", "100", "--interpolated", "-o", "error.json")
        self.assertLess(self.json("error.json")["relativeRmse"], 0.1)
        self.run_vlf("render", "1.vlf", "--size", "80x60", "-o", "room.png")

    def test_a_bake_ends_at_the_error_asked_for(self):
        self.bake("one.vlf", "--json", "bake.json", "--error", "0.6%")
        report = self.json("bake.json")
        self.assertLessEqual(report["estimatedError"]["ofTexels"], 0.006)
        self.assertGreater(report["refinements"], 1)
        self.assertEqual(self.bake("two.vlf", "--error", "0.006").read_bytes(),
                         (self.folder / "one.vlf").read_bytes())

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

    def test_a_film_has_the_objects_of_its_path(self):
        still = {"eye": [2.78, 2.73, -8], "yaw": 180, "pitch": 0, "verticalFov": 39}
        (self.folder / "walk.json").write_text(json.dumps({
            "format": "vlf camera path", "version": 2,
            "camera": [{"seconds": s, **still} for s in (0, 1)],
            "objects": [{"shape": "cube", "position": [4, 0.5, 1], "shading": "flat",
                         "shadow": "none", "motion": {"keyframes": [
                             {"seconds": 0}, {"seconds": 1, "position": [2, 2, 1]}]}}]}))
        for backend in ("cpu", "gl"):
            self.film("-o", "all-%d.png", "--fps", "3", "--exposure", "0", "--backend", backend,
                      "--log", "log.csv")
            self.film("-o", "part-%d.png", "--fps", "3", "--exposure", "0", "--backend", backend,
                      "--from", "2f")
            frames = [(self.folder / f"all-{i}.png").read_bytes() for i in range(3)]
            self.assertEqual(len(set(frames)), 3, "the camera rests")
            self.assertEqual((self.folder / "part-2.png").read_bytes(), frames[2])
            self.assertIn(",objects_ms,", (self.folder / "log.csv").read_text())
        self.film("-o", "all-%d.png", "--object", "cube", code=BAD_INPUT,
                  says=["walk.json", "leave out --object"])

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

    def test_an_error_that_is_none_is_a_usage_error(self):
        for error in ("0", "-1%", "200%", "little", "%"):
            self.run_vlf("bake", "cornell.obj", "-o", "a.vlf", "--error", error, code=USAGE,
                         says=["--error"])

    def test_an_error_out_of_reach_is_refused_with_advice(self):
        self.bake_fails("cornell.obj", BAD_INPUT, ["out of reach", "--texel"], "a.vlf", "--texel",
                        "0.4", "--error", "0.0001")

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

    def test_mirrors_that_take_too_much_memory_are_kept_in_a_file_meanwhile(self):
        self.run_vlf("scene", "mirror-room", "-o", ".")
        bake = ["bake", "mirror-room.obj", "--preset", "draft", "--radiance-cells", "512",
                "--json", "report.json", "-q"]
        self.run_vlf(*bake, "-o", "a.vlf")
        whole = json.loads((self.folder / "report.json").read_text())
        self.run_vlf(*bake, "-o", "b.vlf", "--max-memory", "0.1")
        little = json.loads((self.folder / "report.json").read_text())
        self.assertEqual((self.folder / "a.vlf").read_bytes(), (self.folder / "b.vlf").read_bytes())
        if "VLF_SANITIZED" not in os.environ:  # sanitizers take memory of their own
            self.assertGreater(whole["peakMemoryMiB"], 120)
            self.assertLess(little["peakMemoryMiB"], 0.1 * 1024)
        self.assertEqual(sorted(p.name for p in self.folder.glob(".vlf-scratch*")), [])

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
        bake = ["bake", "cornell.obj", "-o", "room.vlf", "--preset", "high", "--json", "bake.json",
                "--checkpoint", "0"]
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
                          "--radiance-cells", "512", "--checkpoint", "0")

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
