"""What the tests of the command line share.

A test file is run as: FILE PATH_OF_VLF [unittest options]
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.path.abspath(sys.argv.pop(1))
FAILED, USAGE, BAD_INPUT, INTERRUPTED = 1, 2, 3, 130


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
