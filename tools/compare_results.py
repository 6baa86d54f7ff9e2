#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Keeps what a program computes, and compares what two programs computed: for changes that must not change results.

    tools/compare_results.py keep LINKWRIGHT FOLDER [--jobs J] [--only PATTERN]    runs all examples, templates and
                                                                                  reproductions, or some
    tools/compare_results.py compare OLD NEW [--tolerance T] [--absolute A]        result.json (but for `run`) and CSV files

Numbers are equal when they differ by at most T (1e-12) of the larger one, or by at most A (0). Exit code 1 when anything differs.
"""

import argparse
import concurrent.futures
import csv
import fnmatch
import json
import math
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHOWN = 5  # differences of a study


def studies(program):
    """(name, text or path) of every example and every template."""
    for path in sorted((ROOT / "examples").glob("*/*.toml")):
        yield f"{path.parent.name}-{path.stem}", path
    kinds = subprocess.run([program, "catalogue", "--json"], capture_output=True, text=True, check=True).stdout
    for kind in [one["name"] for one in json.loads(kinds)]:
        text = subprocess.run([program, "new", kind, "-"], capture_output=True, text=True, check=True).stdout
        yield "template-" + kind.replace("/", "-"), text


def keep(options):
    folder = Path(options.folder)
    folder.mkdir(parents=True, exist_ok=True)

    def run(item):
        name, study = item
        if isinstance(study, str):
            path = folder / f"{name}.toml"
            path.write_text(study)
            study = path
        done = subprocess.run([options.program, "run", str(study), "--out", str(folder / name), "--threads", "1", "--set",
                               'output.formats=["json", "csv"]'], capture_output=True, text=True)
        (folder / f"{name}.exit").write_text(f"{done.returncode}\n")
        return done.returncode

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        codes = list(pool.map(run, (one for one in studies(options.program) if fnmatch.fnmatch(one[0], options.only))))
    if options.only != "*":
        print(f"{len(codes)} studies kept in {folder}")
        return 0
    tables = subprocess.run([options.program, "reproduce", "all", "--json"], capture_output=True, text=True, check=False)
    (folder / "reproductions.json").write_text(tables.stdout)
    print(f"{len(codes)} studies and all reproductions kept in {folder}; exit codes "
          + ", ".join(f"{code}: {codes.count(code)}" for code in sorted(set(codes))))
    return 0


def same(a, b, tolerance, absolute):
    if a == b or math.isnan(a) and math.isnan(b):
        return True
    return abs(a - b) <= max(absolute, tolerance * max(abs(a), abs(b)))


def differences(a, b, tolerance, absolute=0.0, where=""):
    """Where two JSON values differ."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in sorted(a.keys() | b.keys()):
            if key not in a or key not in b:
                yield f"{where}.{key} is only in the {'new' if key in b else 'old'} one"
            else:
                yield from differences(a[key], b[key], tolerance, absolute, f"{where}.{key}")
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield f"{where} has {len(a)} and {len(b)} entries"
        for i, (x, y) in enumerate(zip(a, b)):
            yield from differences(x, y, tolerance, absolute, f"{where}[{i}]")
    elif isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        if not same(a, b, tolerance, absolute):
            yield f"{where} is {a!r} and {b!r}"
    elif a != b:
        yield f"{where} is {a!r} and {b!r}"


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def content(path):
    if path.suffix == ".json":
        value = json.loads(path.read_text())
        if isinstance(value, dict):
            value.pop("run", None)
        return value
    if path.suffix == ".csv":
        with path.open(newline="") as file:
            return [[number(cell) for cell in row] for row in csv.reader(file)]
    return path.read_text()


def compare(options):
    old, new = Path(options.old), Path(options.new)
    names = {path.relative_to(folder) for folder in (old, new) for path in folder.rglob("*")
             if path.suffix in (".json", ".csv", ".exit")}
    if not names:
        print(f"there is nothing to compare in {old} and {new}")
        return 2
    different = 0
    for name in sorted(names):
        if not (old / name).is_file() or not (new / name).is_file():
            found = [f"is only in the {'new' if (new / name).is_file() else 'old'} one"]
        elif (old / name).read_bytes() == (new / name).read_bytes():
            continue
        else:
            found = list(differences(content(old / name), content(new / name), options.tolerance, options.absolute))
        if found:
            different += 1
            print(f"{name}: {len(found)} differences")
            for line in found[:SHOWN]:
                print("    " + line[:200])
    print(f"{len(names)} files, {different} differ")
    return 1 if different else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("keep")
    command.add_argument("program")
    command.add_argument("folder")
    command.add_argument("--jobs", type=int, default=1)
    command.add_argument("--only", default="*")
    command.set_defaults(run=keep)
    command = commands.add_parser("compare")
    command.add_argument("old")
    command.add_argument("new")
    command.add_argument("--tolerance", type=float, default=1e-12)
    command.add_argument("--absolute", type=float, default=0.0)
    command.set_defaults(run=compare)
    options = parser.parse_args()
    return options.run(options)


if __name__ == "__main__":
    sys.exit(main())
