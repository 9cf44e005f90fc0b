# SPDX-License-Identifier: Apache-2.0
"""Opens the window in an Xvfb of its own and looks at the screen until something is drawn: that first picture has the panels of the last one.
usage: first_picture.py INCISE-VIEW WORK-FOLDER. Exit code 77 where there is no Xvfb.
"""
import mmap
import os
import shutil
import struct
import subprocess
import sys
import time

WIDTH, HEIGHT = 1920, 1080
MOST_SECONDS = 60
SETTLED_SECONDS = 3
BESIDE = (16, 200)  # pixels of the column of tools, beside its icons
BODY = (960, 540)


class Screen:
    """The pixels of an Xvfb, as they are now."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", self.bytes[:100])
        self.first, self.row = header[0] + 12 * header[19], header[12]

    def at(self, x, y):
        place = self.first + y * self.row + 4 * x
        return self.bytes[place:place + 3]


def wait_for(what, is_there):
    end = time.monotonic() + MOST_SECONDS
    while not is_there():
        if time.monotonic() > end:
            sys.exit(f"first_picture: waited in vain for {what}")
        time.sleep(0.0005)


def main():
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    if shutil.which("Xvfb") is None:
        sys.exit(77)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    reading, writing = os.pipe()
    options = ["-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", ".", "+extension", "GLX", "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), *options], pass_fds=[writing],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    window = None
    try:
        number = os.read(reading, 16).decode().strip()
        environment = {**os.environ, "DISPLAY": f":{number}"}
        wait_for("Xvfb's screen", lambda: os.path.exists("Xvfb_screen0"))
        screen = Screen("Xvfb_screen0")
        window = subprocess.Popen([program, "--paused", "--size", f"{WIDTH}x{HEIGHT}"], env=environment)
        blank = screen.at(*BODY)
        wait_for("a first picture", lambda: screen.at(*BODY) != blank)
        first = screen.at(*BESIDE)  # the rows above the body's are there before it
        time.sleep(SETTLED_SECONDS)
        last = screen.at(*BESIDE)
    finally:
        for process in (window, server):
            if process is not None:
                process.terminate()
                process.wait()
    if first != last:
        sys.exit(f"first_picture: beside the tools the first picture is {first.hex()}, later it is {last.hex()}")


main()
