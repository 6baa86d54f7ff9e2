#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of the reports of all examples and templates and, with --chromium, how long they take to open.

    tools/report_sizes.py LINKWRIGHT FOLDER [--time-limit S] [--chromium PROGRAM] [--most MB]

Writes the reports into FOLDER, where those that are there already are kept, and a line for each: bytes, and the
milliseconds until something of it was painted and until the viewer stood, and those of script in a frame of its animation:
median, 95 %, and mean time of the processor, which does not depend on what else runs. Exit code 1 when a report is larger than MB.
"""

import argparse
import json
import statistics
import subprocess
import sys
from pathlib import Path

from compare_results import ROOT, studies


def reports(options):
    """(name, path) of each report; what ends without an answer has one, too."""
    folder = Path(options.folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, study in studies(options.program):
        report = folder / name / "report.html"
        if not report.exists():
            path = study
            if isinstance(study, str):
                path = folder / f"{name}.toml"
                path.write_text(study)
            subprocess.run([options.program, "run", str(path), "--out", str(report.parent), "--time-limit",
                            str(options.time_limit), "--set", "output.formats=['html']"], capture_output=True, check=False)
        if report.exists():
            yield name, report


def measured(script, chromium, files):
    """Times in ms for each file: load_times.mjs gives [first paint, viewer], frame_cost.mjs [median, 95 %, processor] of a frame.
    They are told on standard error as they come, since all of them take a quarter of an hour."""
    with subprocess.Popen(["node", f"tests/{script}.mjs", chromium], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                          cwd=ROOT / "web") as browser:
        browser.stdin.write("\n".join(str(f.resolve()) for f in files))
        browser.stdin.close()
        times = []
        for line in browser.stdout:
            times.append(json.loads(line))
            print(script, f"{len(times)}/{len(files)}", files[len(times) - 1].parent.name, line.strip(), file=sys.stderr, flush=True)
    if len(times) < len(files):
        sys.exit(f"{script}.mjs ended at {files[len(times)]}")
    return times


def at_share(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="LINKWRIGHT")
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("--time-limit", type=float, default=8, metavar="S", help="seconds for each study (8)")
    parser.add_argument("--chromium", metavar="PROGRAM", help="opens each report in this browser, headless")
    parser.add_argument("--most", type=float, default=2.5, metavar="MB", help="the largest size that is allowed (2.5)")
    options = parser.parse_args()
    found = list(reports(options))
    sizes = [report.stat().st_size for _, report in found]
    files = [report for _, report in found]
    times, frames = ([measured(script, options.chromium, files) if options.chromium else [None] * len(found)
                      for script in ("load_times", "frame_cost")])
    for (name, _), size, time, frame in sorted(zip(found, sizes, times, frames), key=lambda row: -row[1]):
        in_browser = "" if time is None else f"{time[0]:6.0f} ms {time[1]:6.0f} ms {frame[0]:6.1f} ms {frame[1]:6.1f} ms {frame[2]:6.1f} ms  "
        print(f"{size / 1e6:7.2f} MB  {in_browser}{name}")

    def line(what, values, unit, digits):
        print(f"{what}: median {statistics.median(values):.{digits}f} {unit}, 95 % {at_share(values, 0.95):.{digits}f} {unit}, "
              f"largest {max(values):.{digits}f} {unit}")

    line(f"size of {len(found)} reports", [s / 1e6 for s in sizes], "MB", 2)
    if options.chromium:
        line("first paint", [t[0] for t in times], "ms", 0)
        line("viewer", [t[1] for t in times], "ms", 0)
        line("script of a frame", [f[0] for f in frames], "ms", 1)
        line("script of one frame in twenty", [f[1] for f in frames], "ms", 1)
        line("processor time of the script of a frame", [f[2] for f in frames], "ms", 1)
    return 1 if max(sizes) > options.most * 1e6 else 0


if __name__ == "__main__":
    sys.exit(main())
