#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares pictures of small scenes with numbers from the specification and from physics.

  tests/oracle/closed_forms.py GLTFX [--only PATTERN] [--jobs N] [--list] [--verbose]

Each case writes an asset, draws it with `gltfx bake` to an OpenEXR file and compares linear
numbers of the picture with a formula. Formulas are written out here from the texts that each case
names, and share nothing with the renderer. Needs only Python.
"""
import argparse
import concurrent.futures
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

import case  # noqa: E402
import cases_images  # noqa: E402,F401
import cases_lights  # noqa: E402,F401
import cases_materials  # noqa: E402,F401
import cases_transport  # noqa: E402,F401
import cases_views  # noqa: E402,F401
import cases_volumes  # noqa: E402,F401


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="GLTFX")
    parser.add_argument("--only", default="", metavar="PATTERN", help="of names of cases")
    parser.add_argument("--jobs", type=int, default=1, metavar="N")
    parser.add_argument("--list", action="store_true", help="names and sources; draws nothing")
    parser.add_argument("--verbose", action="store_true", help="a line for each case")
    return parser.parse_args(words)


def problems_of(one, program):
    try:
        return one.run(program)
    except case.Failure as failure:
        return [str(failure)]


def main():
    arguments = arguments_of(sys.argv[1:])
    cases = case.all_cases(arguments.only)
    if arguments.list:
        print(*[f"{one.name}  [{one.source}]" for one in cases], sep="\n")
        return 0
    program = os.path.abspath(arguments.program)
    failed = limits = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = pool.map(lambda one: problems_of(one, program), cases)
        for one, problems in zip(cases, results):
            if one.limit:
                limits += 1
                if problems:
                    print(f"known limit: {one.name}: {one.limit}: {problems[0]}", flush=True)
                    continue
                problems = [f"agrees, but is listed as a limit: {one.limit}"]
            failed += bool(problems)
            for problem in problems:
                print(f"FAILED: {one.name}: {problem}", flush=True)
            if arguments.verbose and not problems:
                print(one.name, flush=True)
    print(f"closed forms: {len(cases) - limits - failed} of {len(cases) - limits} agree, {limits} known limits")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
