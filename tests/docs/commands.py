#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands that README.md and docs/*.md show, in the order of each page.

  tests/docs/commands.py PROGRAM       those that need nothing but the built program
  tests/docs/commands.py --clone PAGE  prints a script of those of a page for a clean clone, built by tools/quickstart

A command is a line that begins with "$ " in a block "console", a block "sh" as a whole, and what stands under "run" in
a table of README.md. Each is run, or is in ELSEWHERE with what runs it or why nothing can.
"""
import base64
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CLONE = "tests/packaging/run quickstart, in a clean clone"
ELSEWHERE = {
    "tools/quickstart": CLONE,
    "cmake --install build/release --prefix DIR": CLONE,
    "tools/deb": "tests/packaging/run deb",
    "apt install ./build/deb/gltfx_*.deb": "tests/packaging/run chroot",
    "tools/dist": "tests/packaging/run dist",
    "docker build --tag gltfx .": "no test: it takes a Docker daemon",
    "cmake --preset release -DGLTFX_BAKE=OFF": "tests/packaging/run without_baker",
    "cmake --build --preset release": "tests/packaging/run without_baker",
    "cmake --preset release -DGLTFX_BAKE=OFF && cmake --build --preset release": "tests/packaging/run without_baker",
    "tools/wasm": "tools/test npm",
    "tools/web/assemble": "tests/web",
    "tools/npm/pack": "tools/test npm",
    "npm install ./gltfx-VERSION.tgz": "tests/npm",
    "npm install ./gltfx-VERSION.tgz ./gltfx-linux-x64-VERSION.tgz": "tests/npm",
    "npx gltfx validate model.glb": "tests/npm",
    "esbuild page.mjs --bundle --format=esm --outfile=out/page.mjs": "no test: esbuild is a program of others",
    "cp node_modules/gltfx/wasm/gltfx.wasm out/": "no test: it copies a file of the package that tests/npm makes",
    "tools/slurm/submit validate library/ -o results/ --shards 64 -- --profile strict": "tests/slurm",
    "tools/slurm/submit bake library/ -o results-of-bake/ -s --cpus-per-task=8 -- -o thumbnails/ --size 256":
        "tests/slurm",
    "fixtures/materials/make.py": "no test: it writes the fixtures, which the tests read",
    "fixtures/materials/make.py --draw build/release/bin/gltfx": "no test: it writes pictures of the docs",
    "gltfx bake fixtures/figures -o figures/ --camera 0 --lights asset --size 180x120": "test pipeline, Figures",
    "tests/oracle/albedo.py build/release/bin/gltfx": "tools/nightly",
    "tools/targets/measure": "tools/nightly, where the engines are installed",
    "tools/targets/measure three@0.187.0": "tools/nightly, where the engines are installed",
    "tools/targets/measure --check three": "tools/nightly, where the engines are installed",
    "cmake -S . -B build -DCMAKE_PREFIX_PATH=/opt/gltfx": "tests/packaging/run find_package",
    "g++ -std=c++20 main.cpp $(PKG_CONFIG_PATH=/opt/gltfx/lib/pkgconfig pkg-config --cflags --libs gltfx)":
        "tests/packaging/run pkg_config",
    "gltfx compare --git HEAD": "test program, CompareGit: it takes a repository",
    "gltfx compare --git v1.0..v1.1 props/": "test program, CompareGit",
    "gltfx compare --setup-git": "test program, GitDriver",
    'curl --fail --location --output gltfx.tar.zst -- "$GLTFX_ARCHIVE"': "tests/packaging/run action, as action.yml",
    'echo "$GLTFX_SHA256  gltfx.tar.zst" | sha256sum --check --strict': "tests/packaging/run action, as action.yml",
    "mkdir gltfx && tar -xf gltfx.tar.zst -C gltfx --strip-components=1": "tests/packaging/run action, as action.yml",
    "gltfx/bin/gltfx validate assets/": "tests/packaging/run action, as action.yml",
}
# What other commands end with than 0.
CODES = {"gltfx validate fixtures/bad/leaf-unlit.gltf": 1,
         "gltfx compare fixtures/good/lamp.gltf fixtures/bad/lamp-clip-planes-swapped.gltf": 1,
         "gltfx validate assets --rules house": 1,  # meshes without the prefix
         "gltfx edit model.gltf --delete /meshes/3": 1}  # something refers to it


def commands_of(page):
    """(line, command) in the order of the page."""
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        lines = file.read().split("\n")
    found = []
    kind = None
    column = None
    for number, line in enumerate(lines, 1):
        fence = re.match(r"```(\w*)", line)
        if fence:
            kind = None if kind is not None else fence.group(1)
        elif kind == "console" and line.startswith("$ "):
            found.append((number, line[2:]))
        elif kind == "sh" and line.strip():
            found.append((number, line))
        elif kind is None and page == "README.md" and line.startswith("|"):
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if "run" in cells:
                column = cells.index("run")
            elif column is not None and len(cells) > column:
                words = re.sub(r"[^`]*which makes .*", "", cells[column])
                found += [(number, command) for command in re.findall(r"`([^`]*)`", words)]
        else:
            column = None
    return [(number, re.sub(r"\s+# .*", "", command).strip()) for number, command in found]


def pages():
    docs = sorted(name for name in os.listdir(os.path.join(ROOT, "docs")) if name.endswith(".md"))
    return ["README.md"] + ["docs/" + name for name in docs]


def model():
    """Enough meshes, nodes and animations for the deletions in the docs."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<2f", 0, 1) + struct.pack("<6f", *[0] * 6)
    vec3 = {"componentType": 5126, "type": "VEC3"}
    return data, {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(8))}],
        "nodes": [{"mesh": 0}, {"mesh": 1}, {"mesh": 2}] + [{"name": f"node {i}"} for i in range(3, 7)] + [{"mesh": 3}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]} for _ in range(4)],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}}],
                        "samplers": [{"input": 1, "output": 2}]} for node in (1, 2, 7)],
        "accessors": [{"bufferView": 0, "count": 3, "min": [0, 0, 0], "max": [1, 1, 0], **vec3},
                      {"bufferView": 1, "count": 2, "min": [0], "max": [1], "componentType": 5126, "type": "SCALAR"},
                      {"bufferView": 2, "count": 2, **vec3}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
        "buffers": [{"byteLength": len(data)}]}


def glb(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def make_world(folder, program):
    """The files of a clone, and files with the names in the docs."""
    for name in ("fixtures", "tools", "tests"):
        os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))
    for place in ("build/release/bin", "bin"):
        os.makedirs(os.path.join(folder, place))
        os.symlink(os.path.abspath(program), os.path.join(folder, place, "gltfx"))
    good = os.path.join(ROOT, "fixtures/good")
    leaf = [name for name in os.listdir(good) if re.match(r"leaf(_\w+)?\.(gltf|bin|png)$", name)]
    data, document = model()
    for place in ("assets", "library", "props/lamps", "."):
        os.makedirs(os.path.join(folder, place), exist_ok=True)
        for name in leaf if place == "." else ["triangle.gltf"]:
            shutil.copy(os.path.join(good, name), os.path.join(folder, place))
        with open(os.path.join(folder, place, "model.glb"), "wb") as file:
            file.write(glb(document, data))
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    with open(os.path.join(folder, "model.gltf"), "w", encoding="utf-8") as file:
        json.dump(document, file)


def run_pages(program):
    failures = []
    unused = set(ELSEWHERE)
    for page in pages():
        with tempfile.TemporaryDirectory() as folder:
            make_world(folder, program)
            environment = dict(os.environ, PATH=os.path.join(folder, "bin") + ":" + os.environ["PATH"])
            environment.pop("GLTFX_CODEC_WORKERS", None)
            for line, command in commands_of(page):
                unused.discard(command)
                if command in ELSEWHERE:
                    continue
                done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True, check=False,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
                print(f"{page}:{line}: {command}: {done.returncode}")
                if done.returncode != CODES.get(command, 0):
                    failures.append(f"{page}:{line}: {command}: exit code {done.returncode}:\n{done.stdout[:2000]}")
    failures += [f"{command}: in ELSEWHERE, but on no page" for command in sorted(unused)]
    print("\n".join(failures))
    return 1 if failures else 0


def print_script(page):
    """After tools/quickstart, with the assets and the place that the page leaves to the reader."""
    lines = ["set -e", 'export PATH="$PWD/build/release/bin:$PATH"', "mkdir -p assets",
             "cp fixtures/good/leaf* assets/"]
    for line, command in commands_of(page):
        if command == "tools/quickstart" or ELSEWHERE.get(command, CLONE) != CLONE:
            continue
        command = command.replace("--prefix DIR", "--prefix /tmp/gltfx-of-readme")
        code = CODES.get(command, 0)
        lines.append(f"echo '{page}:{line}'")
        lines.append(command if code == 0 else f"code=0; {command} || code=$?; [ $code -eq {code} ]")
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--clone":
        print_script(sys.argv[2])
    elif len(sys.argv) == 2:
        sys.exit(run_pages(sys.argv[1]))
    else:
        sys.exit(__doc__)
