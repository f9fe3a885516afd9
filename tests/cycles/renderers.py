# SPDX-License-Identifier: Apache-2.0
"""Draws assets with gltfx and with Cycles: same camera, same environment, no denoiser."""
import json
import os
import resource
import shutil
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../oracle"))
sys.dont_write_bytecode = True

from pictures import hdr, read_exr  # noqa: E402
from vectors import times  # noqa: E402


class Failure(Exception):
    pass


def room(brightness=1.0, width=256, height=128):
    """Radiance file of a room with one lamp. None of its rows begins with 2, 2, which would
    announce run lengths."""
    rows = []
    for y in range(height):
        up = 1 - y / height
        wall = (0.3 + up * 0.5, 0.35 + up * 0.5, 0.4 + up * 0.6)
        colors = [(9.0, 8.8, 8.4) if abs(x - 80) < 14 and abs(y - 36) < 10 else wall
                  for x in range(width)]
        rows.append([times(brightness, color) for color in colors])
    return hdr(rows)


class Renderers:
    """`work`: folder for environments, job files and pictures. An environment is "bright" or
    "dim". `cpu`: seconds are those of processors, of all threads."""

    def __init__(self, program, work, threads, cpu=False):
        if not shutil.which("blender"):
            raise Failure("Blender is not installed (Debian: apt-get install blender)")
        version = output_of(["blender", "--version"]).split("\n", 1)[0]
        if not version.startswith("Blender 3.4"):
            raise Failure(f"needs Blender 3.4, whose differences are known, and not {version}")
        self.program, self.work = os.path.abspath(program), os.path.abspath(work)
        self.threads, self.cpu = threads, cpu
        os.makedirs(self.work, exist_ok=True)
        for sky, brightness in (("bright", 1.0), ("dim", 0.05)):
            with open(self.path(sky + ".hdr"), "wb") as out:
                out.write(room(brightness))

    def path(self, name):
        return os.path.join(self.work, name)

    def gltfx(self, asset, size, samples, bounces, *options, seed=0, picture="gltfx.exr",
              sky="bright"):
        """(seconds from start to file, Picture)"""
        picture = self.path(picture)
        seconds = self.timed([
            self.program, "bake", asset, "-o", picture, "--camera", "0", "--size", str(size),
            "--samples", str(samples), "--bounces", str(bounces), "--environment",
            self.path(sky + ".hdr"), "--denoise", "off", "--jobs", str(self.threads), "--seed",
            str(seed), "--isolated", "--quiet", *options])
        return seconds, read(picture)

    def cycles(self, asset, size, samples, bounces, seed=0):
        """(seconds from start to file, Picture)"""
        job = self.job(asset, "cycles.exr", size, samples, bounces, seed=seed)
        seconds = self.blender([job])
        return seconds, read(job["picture"])

    def job(self, asset, picture, size, samples, bounces, *, seed=0, sky="bright"):
        return {"asset": os.path.abspath(asset), "picture": self.path(picture),
                "sky": self.path(sky + ".hdr"), "size": size, "samples": samples,
                "bounces": bounces, "seed": seed, "threads": self.threads}

    def blender(self, jobs):
        """Seconds of one process of Blender that does all of these."""
        for job in jobs:
            if os.path.exists(job["picture"]):
                os.remove(job["picture"])
        with open(self.path("jobs.json"), "w", encoding="utf-8") as out:
            json.dump(jobs, out)
        return self.timed([
            "blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
            os.path.join(HERE, "draw_in_blender.py"), "--", self.path("jobs.json")])

    def timed(self, words):
        start = self.now()
        output_of(words)
        return self.now() - start

    def now(self):
        if not self.cpu:
            return time.monotonic()
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime


def read(path):
    with open(path, "rb") as file:
        return read_exr(file.read())


def output_of(words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Failure(f"{words[0]}: exit code {done.returncode}: "
                      + (done.stderr.strip() or done.stdout.strip())[-2000:])
    return done.stdout
