#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Interrupts a picture as Ctrl-C does, once its progress is on the terminal: the line is ended.

interrupt.py PROGRAM ASSET
"""
import os
import pty
import signal
import sys
import tempfile

program, asset = (os.path.abspath(word) for word in sys.argv[1:3])


def read(terminal):
    try:
        return os.read(terminal, 4096)
    except OSError:  # the program has ended
        return b""


def interrupted(folder):
    """The text on the terminal, and how the program ended."""
    words = [program, "bake", asset, "-o", os.path.join(folder, "a.png"), "--size", "4096",
             "--quality", "final", "--samples", "256", "--denoise", "off"]
    child, terminal = pty.fork()
    if child == 0:
        os.execv(program, words)
    shown = b""
    while b" left" not in shown:
        part = read(terminal)
        if not part:
            sys.exit(f"the program ended before it showed progress: {shown!r}")
        shown += part
    os.write(terminal, b"\x03")
    while part := read(terminal):
        shown += part
    return shown, os.waitpid(child, 0)[1]


with tempfile.TemporaryDirectory() as place:
    text, status = interrupted(place)
    left = os.listdir(place)
if os.WTERMSIG(status) != signal.SIGINT:
    sys.exit(f"it ended with {status}")
if not text.endswith(b"\n"):
    sys.exit(f"the line of progress is not ended: {text[-80:]!r}")
if left:
    sys.exit(f"it left {left}")
