#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills long studies at random moments and lets them go on: what they end with must be what a run that was left alone ends
with, byte for byte.

    tools/kill_and_resume.py LINKWRIGHT [--kills N] [--seed S] [--study NAME ...] [--keep FOLDER]

Each round starts a study, sends SIGKILL at a random moment, goes on with --resume, now and then to be killed again, and in the
end compares result.json (without `run`, which holds times) and all tables with those of an undisturbed run. The number of
threads is drawn anew at every start. Exit code 1 when a round ended with anything else.
"""

import argparse
import collections
import json
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Name -> example and what makes it long enough to be killed.
STUDIES = {
    "path, recommended": ("studies/fourbar-18-points.toml", ["optimiser.seeds.count=300"]),
    "path, population": ("studies/fourbar-18-points-grey-wolf.toml",
                         ["optimiser.seeds.count=60", "optimiser.generations=4000"]),
    "balancing": ("studies/balance-four-bar-case-1.toml", ["optimiser.seeds.count=5"]),
    "region of a delta": ("studies/delta-cylinder-smallest.toml", ["optimiser.seeds.count=100"]),
    "suspension": ("studies/suspension-5us-synthesis.toml", ["optimiser.seeds.count=5000"]),
    "clearance": ("studies/clearance-four-bar-lengths-swarm.toml", ["optimiser.seeds.count=30"]),
}


def command(program, name, folder, threads, *more):
    study, changes = STUDIES[name]
    words = [program, "run", str(ROOT / "examples" / study), "--out", str(folder), "--threads", str(threads)]
    for change in [*changes, "output.formats=['json', 'csv']"]:
        words += ["--set", change]
    return words + list(more)


def outcome(folder):
    """Name -> content of what a run left; numbers as they are written."""
    out = {}
    for path in sorted(folder.iterdir()):
        if path.name == "result.json":
            document = json.loads(path.read_text("utf-8"), parse_float=str, parse_int=str)
            document.pop("run", None)
            out[path.name] = json.dumps(document)
        elif path.suffix == ".csv":
            out[path.name] = path.read_bytes()
    return out


def difference(whole, resumed):
    names = [name for name in sorted(set(whole) | set(resumed)) if whole.get(name) != resumed.get(name)]
    return f"differs in {', '.join(names)}" if names else None


def round_of(program, name, whole, length, rng, folder):
    """Kills once or more; (kills in time, what the last start said, what is wrong or None)."""
    kills = 0
    resume = []
    said = b""
    while True:
        process = subprocess.Popen(command(program, name, folder, rng.choice([1, 2]), *resume), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE)
        moment = rng.random() * 1.05 * length
        try:
            if kills < 4 and (kills == 0 or rng.random() < 0.4):
                said = process.communicate(timeout=moment)[1]
            else:
                said = process.communicate(timeout=600)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            kills += 1
            resume = ["--resume"]
            continue
        break
    if process.returncode not in (0, 1):
        return kills, said, f"exit code {process.returncode}: {said.decode('utf-8', 'replace').strip()[-300:]}"
    return kills, said, difference(whole, outcome(folder))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=100, help="as many SIGKILLs in time, over all studies")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--study", action="append", choices=list(STUDIES))
    parser.add_argument("--keep", help="folder for what is left of rounds that went wrong")
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    names = options.study or list(STUDIES)
    rng = random.Random(options.seed)
    faults = 0
    kills = collections.Counter()
    went_on = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="killed-") as temporary:
        place = Path(temporary)
        whole, length = {}, {}
        for k, name in enumerate(names):
            folder = place / f"whole {k}"
            start = time.monotonic()
            code = subprocess.run(command(program, name, folder, 2), capture_output=True, check=False).returncode
            if code not in (0, 1):
                print(f"{name}: exit code {code} without being killed", file=sys.stderr)
                return 2
            length[name] = time.monotonic() - start
            whole[name] = outcome(folder)
        idle = 0
        while sum(kills.values()) < options.kills and idle < 50:
            name = min(names, key=lambda n: kills[n])
            folder = place / "killed"
            shutil.rmtree(folder, ignore_errors=True)
            state = f"{options.seed}, round {sum(kills.values())}"
            number, said, fault = round_of(program, name, whole[name], length[name], rng, folder)
            idle = 0 if number else idle + 1
            kills[name] += number
            went_on[name] += b"resumes from here" in said
            if fault:
                faults += 1
                print(f"{name}, seed {state}, {number} kills: {fault}", flush=True)
                if options.keep:
                    shutil.copytree(folder, Path(options.keep) / f"{options.seed}-{sum(kills.values())}", dirs_exist_ok=True)
    for name in names:
        print(f"{name}: {kills[name]} kills, {went_on[name]} rounds went on from a checkpoint, undisturbed {length[name]:.1f} s")
    print(f"{sum(kills.values())} kills, seed {options.seed}: {faults} rounds ended differently")
    if idle >= 50:
        print("the studies end before they can be killed: make them longer", file=sys.stderr)
        return 2
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
