"""A display without a screen and the walkthrough's window on it, for tests."""

import json
import os
import queue
import subprocess
import threading
import zlib

from case import PROGRAM, Case


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


class WindowCase(Case):
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
