#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs studies with a short time limit and lists by how much each overran it: a loop that does not look whether its run
is to stop shows here. Counted is processor time, which other work on the machine does not lengthen; what the same study
takes to be read and checked is taken off, and so is the limit itself.

    tools/time_limit_overruns.py PROGRAM [--limit 0.2] [--set KEY=VALUE]... [STUDY.toml...]

Without studies: the template of every kind of the catalogue, and all of examples/.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import time


def processor_seconds(command, patience):
    """Processor time of a command, its exit code (None: killed after `patience` seconds) and what it said."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
        end = time.monotonic() + patience
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                process.returncode = os.waitstatus_to_exitcode(status)
                break
            if time.monotonic() > end:
                process.kill()
                _, _, usage = os.wait4(process.pid, 0)
                process.returncode = None
                break
            time.sleep(0.005)
        out.seek(0)
        return usage.ru_utime + usage.ru_stime, process.returncode, out.read().decode(errors="replace")


def templates(program, folder):
    listed = subprocess.run([program, "catalogue", "--json"], check=True, capture_output=True, text=True).stdout
    for name in [one["name"] for one in json.loads(listed)]:
        file = pathlib.Path(folder) / (name.replace("/", "-") + ".toml")
        text = subprocess.run([program, "new", name, "-"], check=True, capture_output=True, text=True).stdout
        file.write_text(text, encoding="utf-8")
        yield file


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("studies", nargs="*", type=pathlib.Path)
    arguments.add_argument("--limit", type=float, default=0.2, help="seconds")
    arguments.add_argument("--allowed", type=float, default=0.5, help="seconds of overrun that are no finding")
    arguments.add_argument("--patience", type=float, default=120, help="seconds after which a run is killed")
    arguments.add_argument("--set", action="append", default=[], help="passed on to the program")
    given = arguments.parse_args()
    root = pathlib.Path(__file__).resolve().parent.parent
    change = [part for value in given.set for part in ("--set", value)]
    findings = 0
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        studies = given.studies
        if not studies:
            studies = [*templates(given.program, folder), *sorted((root / "examples").rglob("*.toml"))]
        for study in studies:
            reading, code, said = processor_seconds([given.program, "check", str(study), *change], given.patience)
            if code != 0:
                rows.append((float("nan"), float("nan"), "not read", study.name))
                continue
            run = [given.program, "run", str(study), "--out", f"{folder}/out", "--threads", "1", "--time-limit",
                   str(given.limit), *change]
            taken, code, said = processor_seconds(run, given.patience)
            status = next((line.split()[1] for line in said.splitlines() if line.strip().startswith("status ")), "-")
            over = max(taken - reading - given.limit, 0.0)
            if code is None:
                status = "killed"
            rows.append((over, taken, status, study.name))
            findings += over > given.allowed
    rows.sort(key=lambda row: -row[0] if row[0] == row[0] else 1)
    print(f"{'overrun s':>9}  {'total s':>8}  {'status':<14}  study")
    for over, taken, status, name in rows:
        print(f"{over:9.3f}  {taken:8.3f}  {status:<14}  {name}")
    print(f"{findings} of {len(rows)} studies overran the limit of {given.limit} s by more than {given.allowed} s")
    return 1 if findings else 0


if __name__ == "__main__":
    raise SystemExit(main())
