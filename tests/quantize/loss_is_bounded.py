#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Quantizes assets and measures the loss, independent of gltfx.

    tests/quantize/loss_is_bounded.py build/dev/bin/gltfx [FILE|FOLDER...]   [--bounds LIST] [--jobs N]

No loss is beyond its bound, and each is what the report states, within 1 %. A second run changes nothing.
Scenes that are easy to get wrong are made by scenes.py. Prints what was wrong, and the number of assets; the
exit code says whether all is well.
"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import asset as assets
import measure
import scenes

UNITS = {"position": ("positions", 100), "normal": ("normals", 1), "texcoord": ("texture coordinates", 1),
         "color": ("colors", 1), "weight": ("weights", 100)}
BOUNDS = {"positions": 0.01, "normals": 0.5, "texture coordinates": 0.25, "colors": 0.5 / 255, "weights": 0.05}
AGREEMENT = 0.01
ROUNDING = {"positions": 1e-5, "normals": 2e-5, "texture coordinates": 1e-4, "colors": 1e-7, "weights": 1e-5}


def convert(program, source, target, bounds):
    words = [program, "convert", str(source), "-o", str(target), "--isolated", "--partial", "--format", "json",
             "--quantize" + ("=" + bounds if bounds else "")]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode not in (0, 1):
        return None, done.stderr.strip()
    report = json.loads(done.stdout)["files"][0]
    return report, report.get("error", "")


def bounds_of(text):
    bounds = dict(BOUNDS)
    for item in filter(None, text.split(",")):
        name, value = item.split("=")
        if name not in UNITS:
            continue
        key, _ = UNITS[name]
        number = value.rstrip("%degtxl")
        above, _, below = number.partition("/")
        bounds[key] = 0 if value == "off" else float(above) / float(below or 1)
    return bounds


def check(program, source, folder, text):
    """Why an asset is wrong; empty: it is right; None: it cannot be compared."""
    target, again = folder / "once.glb", folder / "twice.glb"
    report, error = convert(program, source, target, text)
    if report is None or not target.exists():
        return None if report is None or "would have the new error" not in error else error
    try:
        old, new = assets.Asset(source), assets.Asset(target)
        losses = measure.measure(old, new)
    except (assets.Unreadable, OSError, KeyError, IndexError, ValueError, TypeError, UnicodeDecodeError):
        return None
    except measure.Broken as broken:
        return str(broken)
    stated = {}
    for step in report["steps"]:
        for loss in step["loss"]:
            if "measured" in loss:
                stated[loss["quantity"]] = loss["measured"]
    for name, bound in bounds_of(text).items():
        if losses[name] > bound * (1 + 1e-6) + ROUNDING[name]:
            return f"{name} lost {losses[name]:.6g}, the bound is {bound:.6g}"
        known = stated.get(name, 0)
        posed = name == "positions" and old.list("skins") and old.list("animations")
        if posed and bound * (1 + 1e-9) >= known >= losses[name]:
            continue  # the report also knows the poses of animations
        if abs(known - losses[name]) > AGREEMENT * max(known, losses[name]) + ROUNDING[name]:
            return f"{name} lost {losses[name]:.6g}, the report states {known:.6g}"
    report, error = convert(program, target, again, text)
    if error or target.read_bytes() != again.read_bytes():
        return f"a second run is different: {error}"
    return ""


def check_seams(program, folder):
    """Points that were equal in the space of the scene still are."""
    source, target = folder / "seams.glb", folder / "shut.glb"
    source.write_bytes(scenes.SCENES["seams"]().glb())
    convert(program, source, target, "")
    shown = list(measure.shown_positions(assets.Asset(source), assets.Asset(target)))
    (_, _, a, a_now), (_, _, b, b_now) = shown
    border = [(i, k) for i in range(len(a)) for k in np.flatnonzero((np.abs(b - a[i]) < 1e-12).all(1))]
    if not border:
        return "the halves have no border"
    open_by = max(float(np.abs(a_now[i] - b_now[k]).max()) for i, k in border)
    return f"a seam is open by {open_by:.3g}" if open_by > 0 else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("paths", nargs="*")
    parser.add_argument("--bounds", default="")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    wrong, compared = [], 0
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place)
        files = []
        for name, make in scenes.SCENES.items():
            files.append(root / f"{name}.glb")
            files[-1].write_bytes(make().glb())
        made = len(files)
        for path in map(pathlib.Path, options.paths):
            found = [path] if path.is_file() else sorted(path.rglob("*"))
            files += [each for each in found if each.suffix in (".glb", ".gltf", ".vrm")]

        def run(number):
            folder = root / str(number)
            folder.mkdir()
            return check(options.program, files[number], folder, options.bounds)

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for number, outcome in enumerate(pool.map(run, range(len(files)))):
                compared += outcome is not None
                if outcome or (outcome is None and number < made):
                    wrong.append(f"{files[number].name}: {outcome or 'cannot be compared'}")
        if why := check_seams(options.program, root):
            wrong.append(why)
    print("\n".join(wrong + [f"{compared} of {len(files)} assets compared, {len(wrong)} wrong"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
