"""Bakes that are interrupted, killed, or find no room on the disk: nothing is lost.

Run as: interruption_test.py PATH_OF_VLF [unittest options]
"""

import os
import random
import resource
import signal
import subprocess
import time
import unittest

from case import BAD_INPUT, FAILED, INTERRUPTED, PROGRAM, USAGE, Case, vlf

CHECKPOINT = "room.vlf.checkpoint"
LONGEST = 20  # seconds until an interrupted program ends, on a busy machine and with sanitizers


class Bakes(Case):
    """Bakes of a room with a mirror that take about a second in each stage."""

    OPTIONS = {"-o": "room.vlf", "--preset": "draft", "--texel": "0.1", "--direct-samples": "8",
               "--cells": "256", "--radiance-directions": "2049", "--checkpoint": "60"}
    STAGES = ["direct light", "bounces", "radiance field"]
    whole_field = None

    def setUp(self):
        super().setUp()
        self.run_vlf("scene", "mirror-room", "--triangles", "1000", "-o", ".")
        self.scene = self.files()

    def command(self, *flags, **options):
        """The command with other options: texel="0.2" for --texel 0.2."""
        changed = {"-o" if k == "output" else "--" + k.replace("_", "-"): v
                   for k, v in options.items()}
        pairs = {**self.OPTIONS, **changed}
        return ["bake", "mirror-room.obj", *[word for pair in pairs.items() for word in pair],
                *flags]

    def whole(self):
        """The bytes of the field, baked in one go."""
        if not Bakes.whole_field:
            self.run_vlf(*self.command(checkpoint="0"))
            Bakes.whole_field = self.take()
        return Bakes.whole_field

    def take(self):
        """The bytes of the field, which is removed; nothing else may be left."""
        self.assertEqual(self.files(), sorted([*self.scene, "room.vlf"]))
        field = self.folder / "room.vlf"
        content = field.read_bytes()
        field.unlink()
        return content

    def start(self, *flags, **options):
        return subprocess.Popen([PROGRAM, *self.command(*flags, **options)], cwd=self.folder,
                                text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def wait_for(self, process, *stages):
        """Reads what the process says until one of the stages has begun, or all of it."""
        said = ""
        for line in process.stdout:
            said += line
            if line.startswith(stages):
                break
        return said

    def interrupted_in(self, stage, *flags, number=signal.SIGINT, **options):
        """What a bake says that is interrupted when the stage has begun."""
        process = self.start(*flags, **options)
        said = self.wait_for(process, stage)
        time.sleep(0.05)
        process.send_signal(number)
        rest, _ = process.communicate(timeout=LONGEST)
        self.assertEqual(process.returncode, INTERRUPTED, said + rest)
        return said + rest


class Resume(Bakes):
    def test_whenever_a_bake_is_killed_it_goes_on_to_the_same_bits(self):
        whole = self.whole()
        chance = random.Random(7)
        kills = resumed = 0
        for first in range(3):
            ended, attempt = False, 0
            while not ended:
                process = self.start("--resume", "--threads", str(1 + (first + attempt) % 3),
                                     checkpoint="0.02")
                said = self.wait_for(process, "direct light", "bounces")
                try:
                    # Longer and longer: on however busy a machine one of them gets somewhere.
                    rest, _ = process.communicate(timeout=(0.3 + 0.1 * attempt) * chance.random())
                    ended = True
                except subprocess.TimeoutExpired:
                    process.kill()
                    rest, _ = process.communicate()
                    kills += 1
                resumed += "going on from" in said
                self.assertNotIn("error:", said + (rest or ""))
                attempt += 1
            self.assertEqual(process.returncode, 0, said)
            self.assertEqual(self.take(), whole)
        self.assertGreater(kills, 6)
        self.assertGreater(resumed, 6)

    def test_a_bake_interrupted_in_stage_after_stage_goes_on_to_the_same_bits(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            flags = []
            for stage in self.STAGES:
                said = self.interrupted_in(stage, *flags, number=number)
                self.assertIn(f"{CHECKPOINT} keeps the bake: go on with --resume", said)
                self.assertEqual(self.files(), sorted([*self.scene, CHECKPOINT]))
                flags = ["--resume"]
            self.run_vlf(*self.command("--resume", "--json", "bake.json"),
                         says=[f"going on from {CHECKPOINT}: the radiance field"])
            self.assertTrue(self.json("bake.json")["resumed"])
            (self.folder / "bake.json").unlink()
            self.assertEqual(self.take(), self.whole())

    def test_a_bake_with_adaptive_texels_goes_on_to_the_same_bits(self):
        self.run_vlf(*self.command("--adaptive-texels", checkpoint="0"))
        whole = self.take()
        self.assertNotEqual(whole, self.whole())
        self.assertNotIn("keeps the bake", self.interrupted_in("texel sizes", "--adaptive-texels"))
        self.assertEqual(self.files(), self.scene)
        self.interrupted_in("bounces", "--adaptive-texels")
        self.run_vlf(*self.command("--resume"), code=BAD_INPUT, says=["--adaptive-texels"])
        self.run_vlf(*self.command("--adaptive-texels", "--resume", checkpoint="0.02"))
        self.assertEqual(self.take(), whole)

    def test_interrupted_before_there_is_light_nothing_is_kept(self):
        self.interrupted_in("charts", texel="0.005")
        self.assertEqual(self.files(), self.scene)

    def test_without_checkpoints_nothing_is_kept(self):
        self.assertNotIn("--resume", self.interrupted_in("bounces", checkpoint="0"))
        self.assertEqual(self.files(), self.scene)

    def test_with_nothing_to_resume_a_bake_begins_anew(self):
        self.run_vlf(*self.command("--resume", "--json", "bake.json"),
                     says=["no checkpoint to resume from"])
        self.assertFalse(self.json("bake.json")["resumed"])

    def test_a_checkpoint_is_not_lost_by_a_bake_that_begins_anew(self):
        self.interrupted_in("bounces")
        kept = (self.folder / CHECKPOINT).read_bytes()
        self.run_vlf(*self.command(), code=BAD_INPUT, says=[CHECKPOINT, "--resume", "delete"])
        self.assertEqual((self.folder / CHECKPOINT).read_bytes(), kept)
        self.assertEqual(self.files(), sorted([*self.scene, CHECKPOINT]))

    def test_by_way_of_a_link_the_same_bake_goes_on(self):
        whole = self.whole()
        (self.folder / "link.vlf").symlink_to("room.vlf")
        (self.folder / "room.vlf").write_text("old")
        self.interrupted_in("bounces")
        self.run_vlf(*self.command("--resume", output="link.vlf"), says=["going on from"])
        self.assertTrue((self.folder / "link.vlf").is_symlink())
        (self.folder / "link.vlf").unlink()
        self.assertEqual(self.take(), whole)


class Refusal(Bakes):
    def setUp(self):
        super().setUp()
        self.interrupted_in("bounces")
        self.kept = (self.folder / CHECKPOINT).read_bytes()

    def refused(self, *flags, says=(), **options):
        self.run_vlf(*self.command("--resume", *flags, **options), code=BAD_INPUT,
                     says=[CHECKPOINT, "delete", *says])
        self.assertEqual(self.files(), sorted([*self.scene, CHECKPOINT]))

    def test_another_parameter_is_named(self):
        for option, was, now in [("--cells", "256", "128"), ("--texel", "0.1", "0.2"),
                                 ("--preset", "draft", "high"), ("--bounces", "auto", "3"),
                                 ("--directions", "513", "2049"), ("--direct-samples", "8", "4"),
                                 ("--radiance-directions", "2049", "0"), ("--tile", "4", "16"),
                                 ("--radiance-cells", "128", "64"), ("--seed", "0", "5")]:
            self.refused(**{option[2:]: now}, says=[f"{option} was {was}, is {now}"])
        self.assertEqual((self.folder / CHECKPOINT).read_bytes(), self.kept)

    def test_another_instruction_set_is_named(self):
        done = vlf(*self.command("--isa", "none"), folder=self.folder)
        sets = done.stderr.split("choose one of ")[1].strip().split(", ")
        if len(sets) < 2:
            self.skipTest("this machine has one instruction set")
        self.refused("--isa", sets[1], says=[f"--isa was {sets[0]}, is {sets[1]}"])

    def test_another_scene_is_named(self):
        materials = self.folder / "mirror-room.mtl"
        materials.write_text(materials.read_text().replace("Kd 0.74", "Kd 0.75"))
        self.refused(says=["the scene's fingerprint"])

    def test_a_damaged_checkpoint_is_refused(self):
        checkpoint = self.folder / CHECKPOINT
        spots = random.Random(3)
        size = len(self.kept)
        for length in (0, 1, 47, 48, size // 2, size - 1):
            checkpoint.write_bytes(self.kept[:length])
            self.refused()
        for _ in range(20):
            damaged = bytearray(self.kept)
            damaged[spots.randrange(size)] ^= 1 << spots.randrange(8)
            checkpoint.write_bytes(damaged)
            self.refused()

    def test_a_checkpoint_is_no_field(self):
        for command in (["info"], ["render", "-o", "a.png"]):
            self.run_vlf(*command, CHECKPOINT, code=BAD_INPUT, says=[CHECKPOINT, "--resume"])


class TwoBakes(Bakes):
    def test_the_second_of_two_bakes_of_one_file_is_refused(self):
        first = self.start()
        self.wait_for(first, "direct light")
        self.run_vlf(*self.command(), code=FAILED, says=["room.vlf", f"process {first.pid}", "wait"])
        first.communicate(timeout=LONGEST)
        self.assertEqual(first.returncode, 0)
        self.take()

    def test_bakes_of_two_files_go_side_by_side(self):
        first = self.start()
        self.wait_for(first, "direct light")
        self.bake("another.vlf")
        first.communicate(timeout=LONGEST)
        self.assertEqual(first.returncode, 0)

    def test_what_a_killed_bake_leaves_does_not_block_and_goes_away(self):
        process = self.start(checkpoint="0")
        self.wait_for(process, "bounces")
        process.kill()
        process.communicate()
        for left in ("room.vlf.tmp-123-0", "room.vlf.checkpoint.tmp-123-7"):
            (self.folder / left).write_text("half a file")
        self.assertIn("room.vlf.lock", self.files())
        self.run_vlf(*self.command())
        self.take()


class NoRoom(Bakes):
    def limited(self, size, *flags, **options):
        """The end of a bake that may write no file larger than `size`."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        return subprocess.run([PROGRAM, *self.command(*flags, **options)], cwd=self.folder,
                              text=True, capture_output=True, preexec_fn=limit, timeout=120)

    def test_a_checkpoint_that_cannot_be_written_does_not_end_the_bake(self):
        self.run_vlf(*self.command(radiance_directions="0"))
        whole = self.take()
        done = self.limited(len(whole), radiance_directions="0", checkpoint="0.02")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("no checkpoint"), 1, done.stderr)
        self.assertIn("File too large", done.stderr)
        self.assertEqual(self.take(), whole)

    def test_when_the_field_cannot_be_written_the_checkpoint_keeps_the_bake(self):
        whole = self.whole()
        (self.folder / "room.vlf").write_text("old")
        self.interrupted_in("radiance field")
        done = self.limited(len(whole) // 2, "--resume", checkpoint="0")
        self.assertEqual(done.returncode, FAILED, done.stderr)
        for text in ("room.vlf: cannot write: File too large", CHECKPOINT, "--resume"):
            self.assertIn(text, done.stderr)
        self.assertEqual((self.folder / "room.vlf").read_text(), "old")
        self.assertEqual(self.files(), sorted([*self.scene, CHECKPOINT, "room.vlf"]))
        self.run_vlf(*self.command("--resume"))
        self.assertEqual(self.take(), whole)

    def on_disk(self, size, *mount_options):
        """Mounts a small disk at `disk`; an output there."""
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("only root can mount a small disk")
        self.addCleanup(subprocess.run, ["umount", disk])
        return disk

    def bake_to(self, output, **options):
        return vlf(*self.command(output=output, **options), folder=self.folder)

    def test_a_full_disk_is_noticed_before_the_bake(self):
        disk = self.on_disk("64k")
        (disk / "room.vlf").write_text("old")
        try:
            (disk / "full").write_bytes(bytes(1 << 20))
        except OSError:
            pass
        done = self.bake_to("disk/room.vlf")
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertIn("disk/room.vlf: cannot write: No space left on device", done.stderr)
        self.assertNotIn("charts", done.stderr)
        self.assertEqual(sorted(os.listdir(disk)), ["full", "room.vlf"])
        self.assertEqual((disk / "room.vlf").read_text(), "old")

    def test_a_disk_that_becomes_full_leaves_the_old_file(self):
        disk = self.on_disk("256k")
        (disk / "room.vlf").write_text("old")
        done = self.bake_to("disk/room.vlf", checkpoint="0.02")
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual((disk / "room.vlf").read_text(), "old")
        self.assertFalse([f for f in os.listdir(disk) if ".tmp" in f or f.endswith(".lock")])

    def test_a_read_only_disk_is_noticed_before_the_bake(self):
        disk = self.on_disk("1m")
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        done = self.bake_to("disk/room.vlf")
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertIn("Read-only file system", done.stderr)
        self.assertNotIn("charts", done.stderr)

    def test_a_missing_folder_is_noticed_before_the_bake(self):
        done = self.bake_to("missing/room.vlf")
        self.assertEqual(done.returncode, FAILED, done.stderr)
        self.assertIn("there is no folder 'missing'", done.stderr)
        self.assertNotIn("charts", done.stderr)


class Usage(Bakes):
    def test_an_interval_is_a_number_of_seconds(self):
        for seconds in ("-1", "often", "nan"):
            self.run_vlf(*self.command(checkpoint=seconds), code=USAGE, says=["--checkpoint"])
        self.assertEqual(self.files(), self.scene)


if __name__ == "__main__":
    unittest.main()
