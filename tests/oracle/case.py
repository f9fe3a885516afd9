# SPDX-License-Identifier: Apache-2.0
"""A case: an asset, how it is drawn, and the numbers that its picture should have."""
import math
import os
import re
import subprocess
import tempfile

from pictures import hdr, read_exr

# Deterministic error: pictures, vertices and textures hold floats.
ROUNDING = 1e-4
BLACK = (".hdr", hdr([[(0, 0, 0)] * 2]))


class Failure(Exception):
    pass


class Case:
    """
    name      unique, "group: subject"
    source    section of the specification, name of an extension or paper
    scene     Scene, seen through its first camera
    expected  numbers, or a function that gives them; by default the mean color of the picture
    measure   function from a Picture to as many numbers
    most      bound of what one path adds to a number, where paths are chosen at random. A mean m of
              n paths between 0 and `most` deviates by sqrt(m (most - m) / n) at most (Bhatia and
              Davis, 2000); the tolerance is four times that. Without it nothing is random.
    near      tolerance beside that, for what the case says
    sky       (suffix, bytes) of an environment, black unless given: the studio is left out. Lights
              are as bright as the asset says while the scene has less than pi lux; above that they
              are dimmed (docs/bake.md, What is drawn)
    limit     the limit of the renderer (docs/bake.md, What is drawn) the case shows: it must not agree
    """

    def __init__(self, name, source, scene, expected, *, measure=None, most=None, near=0.0,
                 samples=4, size=(2, 2), shader="spec", bounces=6, sky=BLACK, options=(), limit=""):
        self.name, self.source, self.scene = name, source, scene
        self.expected, self.measure = expected, measure or mean_color
        self.most, self.near, self.limit = most, near, limit
        self.samples, self.size, self.sky = samples, size, sky
        self.options = ["--samples", str(samples), "--size", "{}x{}".format(*size),
                        "--shader", shader, "--bounces", str(bounces), *options]

    def tolerance(self, expected):
        fixed = ROUNDING * max(abs(expected), 0.01) + self.near
        if self.most is None:
            return fixed
        paths = self.samples * self.size[0] * self.size[1]
        variance = max(expected * (self.most - expected), 0.0)
        return fixed + 4 * math.sqrt(variance / paths)

    def run(self, program):
        """Lines about numbers that disagree."""
        expected = self.expected() if callable(self.expected) else self.expected
        measured = self.measure(self.picture(program))
        if len(measured) != len(expected):
            raise Failure(f"{len(measured)} numbers, not {len(expected)}")
        tolerances = [self.tolerance(e) for e in expected]
        if all(abs(m - e) <= t for m, e, t in zip(measured, expected, tolerances)):
            return []
        return [f"expected {shown(expected)}, measured {shown(measured)}, "
                f"tolerance {shown(tolerances)} ({self.source})"]

    def picture(self, program):
        with tempfile.TemporaryDirectory() as folder:
            suffix, sky_bytes = self.sky
            asset, sky, picture = (os.path.join(folder, name) for name in
                                   ("asset.gltf", "sky" + suffix, "picture.exr"))
            with open(asset, "w", encoding="utf-8") as file:
                file.write(self.scene.text())
            with open(sky, "wb") as file:
                file.write(sky_bytes)
            words = [program, "bake", asset, "-o", picture, "--camera", "0", "--environment", sky,
                     "--denoise", "off", "--isolated", "--strict", "--quiet", "--jobs", "1",
                     *self.options]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            if done.returncode:
                raise Failure(f"exit code {done.returncode}: {done.stderr.strip()}")
            with open(picture, "rb") as file:
                return read_exr(file.read())


def shown(numbers):
    return "(" + ", ".join(f"{number:.6g}" for number in numbers) + ")"


def mean_color(picture):
    return picture.mean()[:3]


def pixels(*places):
    """The channels of these pixels, (column, row) from the upper left, one after the other."""
    return lambda picture: tuple(c for x, y in places for c in picture.at(x, y)[:3])


def centroid(picture):
    """Where the light of a picture is: columns and rows from the upper left, 0.5 in the middle of
    the first pixel."""
    total, x_sum, y_sum = 0.0, 0.0, 0.0
    for y, row in enumerate(picture.rows):
        for x, pixel in enumerate(row):
            total += pixel[1]
            x_sum += pixel[1] * (x + 0.5)
            y_sum += pixel[1] * (y + 0.5)
    if not total:
        raise Failure("the picture is black")
    return x_sum / total, y_sum / total


GROUPS = []


def group(function):
    """For functions that yield cases."""
    GROUPS.append(function)
    return function


def all_cases(pattern=""):
    cases = [case for function in GROUPS for case in function()]
    names = [case.name for case in cases]
    assert len(set(names)) == len(names), [name for name in names if names.count(name) > 1]
    return [case for case in cases if re.search(pattern, case.name)]
