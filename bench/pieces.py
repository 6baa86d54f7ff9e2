#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the pieces of studies cost, for docs/many-machines.md: time and bytes of a piece on one thread, and the time of what one
rank does alone (reading, what follows the pieces, writing), which is that of resuming a run that had ended.

    bench/pieces.py LINKWRIGHT EXAMPLES
"""

import pathlib
import subprocess
import sys
import tempfile
import time

# Example, changes, name of a piece.
STUDIES = [
    ("fourbar-18-points", ["optimiser.seeds.count=1000"], "seed"),
    ("fourbar-18-points-free-timing-20", ["optimiser.seeds.count=40"], "seed"),
    ("suspension-5us-synthesis", ["optimiser.seeds.count=1000"], "seed"),
    ("balance-stephenson-six-bar", ["optimiser.seeds.count=1000"], "seed"),
    ("strut-suspension-sensitivity", [], "64 trials"),
]
# Rank 0 needs this time (s) for a message and for each byte of it (bench/shared_run_bench.cpp).
MESSAGE, BYTE = 7e-6, 1 / 78e6
START = 1.0  # start of mpirun on many machines, in seconds: an assumption


def seconds(command):
    begin = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{' '.join(command)}: {done.stderr}")
    return time.perf_counter() - begin


def main():
    program, examples = sys.argv[1:]
    print("| study | pieces | one piece | kept | alone | 64 ranks, 100 pieces each | 1024 ranks |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, changes, unit in STUDIES:
            command = [program, "run", str(next(pathlib.Path(examples).glob(f"{name}.toml"))), "--out", f"{folder}/{name}", "--threads", "1",
                       "--quiet"]
            for change in changes:
                command += ["--set", change]
            whole = seconds(command)
            alone = seconds([*command, "--resume"])
            kept = pathlib.Path(folder, name, "checkpoint.jsonl").read_text(encoding="utf-8").splitlines()[1:]
            pieces, size = len(kept), sum(map(len, kept))
            piece = (whole - alone) / pieces
            shares = []
            for ranks in (64, 1024):
                work = 100 * ranks
                served = work * (MESSAGE + BYTE * size / pieces)
                # The part that grows with the number of pieces, and all else with it: an upper bound.
                end = alone * work / pieces
                shares.append(100 * piece / (START + max(100 * piece, served) + end))
            print(f"| `{name}` | {pieces} x {unit} | {1e3 * piece:.3g} ms | {size / pieces:.0f} B | {1e3 * alone:.0f} ms "
                  f"| {100 * shares[0]:.0f} % | {100 * shares[1]:.0f} % |")


if __name__ == "__main__":
    main()
