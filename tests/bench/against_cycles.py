#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws assets with gltfx and with Cycles: same camera, same environment, no denoiser.

  against_cycles.py [--size N] [--samples LIST] [--work DIR] PROGRAM ASSET.glb...

Needs Blender on the path, which brings Cycles and a glTF importer. An environment that PROGRAM and
Blender both read is made first, and the camera is put into a copy of each asset. For each number of
samples it prints seconds from start to file and the error: the root of the mean square over the
pixels, as part of the mean, against that renderer's own picture of 4,096 samples, so that what the
importer reads differently does not count; and for each asset how far the two references are apart.
"""
import argparse
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import time

BLENDER = r'''
import bpy, sys
asset, sky, picture, size, samples = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=asset)
scene = bpy.context.scene
scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
nodes = scene.world.node_tree.nodes
image = nodes.new("ShaderNodeTexEnvironment")
image.image = bpy.data.images.load(sky)
scene.world.node_tree.links.new(image.outputs[0], nodes["Background"].inputs[0])
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = int(samples)
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 4
scene.cycles.sample_clamp_indirect = 0
scene.render.threads_mode = "FIXED"
scene.render.threads = 2
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.resolution_percentage = 100
scene.render.film_transparent = False
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "HDR"
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
'''


def write_sky(path, width=256, height=128):
    """A bright room with one lamp, as a Radiance file without compression."""
    def pixel(value):
        mantissa, exponent = math.frexp(max(value))
        scale = mantissa * 256 / max(value)
        return bytes([int(v * scale) for v in value] + [exponent + 128])

    with open(path, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            up = 1 - y / height
            for x in range(width):
                lamp = abs(x - 80) < 14 and abs(y - 36) < 10
                out.write(pixel((9.0, 8.8, 8.4) if lamp else (0.3 + up * 0.5, 0.35 + up * 0.5,
                                                              0.4 + up * 0.6)))


def read_radiance(path):
    """Rows of (r, g, b) of a Radiance file, compressed or not."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"\n\n") + 2
    line_end = data.index(b"\n", end)
    _, height, _, width = data[end:line_end].split()
    height, width, at = int(height), int(width), line_end + 1
    values = []
    for _ in range(height):
        if data[at:at + 2] != b"\2\2":
            row, at = data[at:at + 4 * width], at + 4 * width
            planes = [row[c::4] for c in range(4)]
        else:
            at, planes = at + 4, []
            for _ in range(4):
                plane = bytearray()
                while len(plane) < width:
                    count = data[at]
                    if count > 128:
                        plane += data[at + 1:at + 2] * (count - 128)
                        at += 2
                    else:
                        plane += data[at + 1:at + 1 + count]
                        at += 1 + count
                planes.append(plane)
        for r, g, b, e in zip(*planes):
            scale = math.ldexp(1, e - 136) if e else 0
            values += [r * scale, g * scale, b * scale]
    return values


def with_camera(path, target):
    """A copy of a .glb with a camera before it, that both programs take."""
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack("<I", data[12:16])[0]
    document, rest = json.loads(data[20:20 + size]), data[20 + size:]
    document["cameras"] = [{"type": "perspective", "perspective": {
        "yfov": 0.6, "znear": 0.05, "aspectRatio": 1}}]
    document["nodes"].append({"camera": 0, "translation": [0, 0, 4.5]})
    document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(target, "wb") as out:
        out.write(b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text + rest)


def apart(one, other):
    square = sum((a - b) ** 2 for a, b in zip(one, other)) / len(other)
    return math.sqrt(square) / (sum(other) / len(other))


class Renderers:
    def __init__(self, options):
        self.options = options
        self.sky = os.path.join(options.work, "sky.hdr")
        self.script = os.path.join(options.work, "draw.py")
        self.picture = os.path.join(options.work, "picture")
        write_sky(self.sky)
        with open(self.script, "w", encoding="utf-8") as out:
            out.write(BLENDER)

    def gltfx(self, asset, samples):
        picture = self.picture + ".exr"
        seconds = self.timed([self.options.program, "bake", asset, "-o", picture, "--size",
                              self.options.size, "--samples", str(samples), "--bounces", "4",
                              "--denoise", "off", "--camera", "0", "--environment", self.sky,
                              "--jobs", "2", "--quiet"])
        # Blender reads OpenEXR; this script reads Radiance.
        converted = self.picture + ".hdr"
        self.run_blender(f"import bpy; i = bpy.data.images.load({picture!r}); "
                         f"i.file_format = 'HDR'; i.filepath_raw = {converted!r}; i.save()")
        return seconds, read_radiance(converted)

    def cycles(self, asset, samples):
        picture = self.picture + "-cycles.hdr"
        seconds = self.timed(["blender", "--background", "--factory-startup", "--python",
                              self.script, "--", asset, self.sky, picture, self.options.size,
                              str(samples)])
        return seconds, read_radiance(picture)

    def run_blender(self, text):
        self.timed(["blender", "--background", "--factory-startup", "--python-expr", text])

    @staticmethod
    def timed(words):
        start = time.monotonic()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return time.monotonic() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("assets", nargs="+")
    parser.add_argument("--size", default="512")
    parser.add_argument("--samples", default="16,64")
    parser.add_argument("--reference", type=int, default=4096, help="samples")
    parser.add_argument("--work", default="build/bench-work/cycles")
    options = parser.parse_args()
    if not shutil.which("blender"):
        sys.exit("against_cycles.py: Blender is not installed.")
    os.makedirs(options.work, exist_ok=True)
    renderers = Renderers(options)
    for path in options.assets:
        asset = os.path.join(options.work, os.path.basename(path))
        with_camera(path, asset)
        references = [draw(asset, options.reference)[1]
                      for draw in (renderers.gltfx, renderers.cycles)]
        print(f"{path}: references {apart(*references):.4f} apart")
        for samples in map(int, options.samples.split(",")):
            for name, draw, reference in zip(("gltfx", "Cycles"),
                                             (renderers.gltfx, renderers.cycles), references):
                seconds, picture = draw(asset, samples)
                print(f"  {name:7} {samples:5} samples {seconds:7.2f} s  "
                      f"error {apart(picture, reference):.4f}", flush=True)


if __name__ == "__main__":
    main()
