#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares pictures of gltfx with those of Cycles: same camera, same environment, no denoiser.

  tests/cycles/agree.py GLTFX [--only PATTERN] [--jobs N] [--list] [--verbose] [--keep DIR]

Each scene is written as glTF, drawn by both and compared in two ways: the mean of each color in
each region of a grid, and the root of the mean square over pixels, averaged over 4 by 4, as part of
the mean of the picture. Needs Blender 3.4.
"""
import argparse
import math
import os
import re
import sys
import tempfile

sys.dont_write_bytecode = True

import renderers  # noqa: E402  before the rest: it adds the folder of tests/oracle
import comparison  # noqa: E402
import scenes  # noqa: E402,F401
import differences  # noqa: E402,F401

SIZE, BOUNCES, BLOCK = 96, 16, 4
DARK = 0.1  # of the mean of the picture: differences of darker regions count as part of that


def means(picture, columns, rows):
    """Colors of the cells of a grid, row by row."""
    result = []
    for row in range(rows):
        for column in range(columns):
            ys = range(row * picture.height // rows, (row + 1) * picture.height // rows)
            xs = range(column * picture.width // columns, (column + 1) * picture.width // columns)
            cell = [picture.at(x, y) for y in ys for x in xs]
            result.append(tuple(sum(p[c] for p in cell) / len(cell) for c in range(3)))
    return result


def worst_region(ours, theirs, grid):
    """(relative difference, column, row) of the region that differs most."""
    least = DARK * sum(theirs.mean()[:3]) / 3
    found = []
    for i, (a, b) in enumerate(zip(means(ours, *grid), means(theirs, *grid))):
        differences = [(x - y) / max(y, least) for x, y in zip(a, b)]
        found.append((max(differences, key=abs), i % grid[0], i // grid[0]))
    return max(found, key=lambda one: abs(one[0]))


def blurred_error(ours, theirs):
    grid = (theirs.width // BLOCK, theirs.height // BLOCK)
    pairs = [(x, y) for a, b in zip(means(ours, *grid), means(theirs, *grid)) for x, y in zip(a, b)]
    square = sum((x - y) ** 2 for x, y in pairs) / len(pairs)
    return math.sqrt(square) * len(pairs) / sum(y for _, y in pairs)


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="GLTFX")
    parser.add_argument("--only", default="", metavar="PATTERN", help="of names of scenes")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="threads of each renderer")
    parser.add_argument("--list", action="store_true", help="names and tolerances; draws nothing")
    parser.add_argument("--verbose", action="store_true", help="a line for each scene")
    parser.add_argument("--keep", metavar="DIR", help="where assets and pictures stay")
    return parser.parse_args(words)


def drawn(comparisons, draw):
    """Pairs of pictures, of gltfx and of Cycles."""
    jobs = []
    for one in comparisons:
        asset = draw.path(one.name + ".gltf")
        with open(asset, "w", encoding="utf-8") as file:
            file.write(one.scene.text())
        jobs.append(draw.job(asset, one.name + "-cycles.exr", SIZE, one.samples, BOUNCES,
                             sky=one.sky))
    draw.blender(jobs)
    for one, job in zip(comparisons, jobs):
        _, ours = draw.gltfx(job["asset"], SIZE, one.samples, BOUNCES, "--shader", one.shader,
                             "--strict", picture=one.name + "-gltfx.exr", sky=one.sky)
        yield one, ours, renderers.read(job["picture"])


def verdict(one, ours, theirs):
    """(whether it is as expected, a line)"""
    worst, column, row = worst_region(ours, theirs, one.grid)
    error = blurred_error(ours, theirs)
    agrees = abs(worst) <= one.tolerance and error <= comparison.TOLERANCE
    line = f"{one.name}: region {column},{row} {worst:+.1%}, pixels {error:.1%}"
    if not one.difference:
        return agrees, f"{line}; tolerance {one.tolerance:.0%}"
    if agrees:
        return False, f"{line}: agrees, but is listed as a difference: {one.difference}"
    return True, f"known difference: {line}: {one.difference}"


def compare(comparisons, draw, verbose):
    """Names of those that are not as expected."""
    failed = []
    for one, ours, theirs in drawn(comparisons, draw):
        good, line = verdict(one, ours, theirs)
        if not good:
            failed.append(one.name)
        if verbose or one.difference or not good:
            print(f"{'' if good else 'FAILED: '}{line}", flush=True)
    return failed


def main():
    arguments = arguments_of(sys.argv[1:])
    comparisons = [one for one in comparison.all_comparisons()
                   if re.search(arguments.only, one.name)]
    if arguments.list:
        for one in comparisons:
            reason = one.difference or one.because
            print(f"{one.name}: {one.what}{'; ' * bool(reason)}{reason}")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        try:
            draw = renderers.Renderers(arguments.program, arguments.keep or folder, arguments.jobs)
            failed = compare(comparisons, draw, arguments.verbose)
        except renderers.Failure as failure:
            print(f"agree.py: {failure}", file=sys.stderr)
            return 1
    same = [one.name for one in comparisons if not one.difference]
    print(f"Cycles: {len(set(same) - set(failed))} of {len(same)} scenes agree, "
          f"{len(comparisons) - len(same)} known differences")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
