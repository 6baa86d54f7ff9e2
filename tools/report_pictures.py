#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of reports as readers meet them, to compare before and after a change of the viewer.

    tools/report_pictures.py LINKWRIGHT FOLDER [STUDY ...] [--whole] [--dark] [--chromium CHROMIUM]

Runs each study (default: 12 examples from all domains) and takes the first screen of its report at 1366x768, 390x844
and 1920x1080 into FOLDER/NAME-WIDTH.png; --whole takes the whole page instead, --dark the dark colours. Says where the
controls of the motion do not stand on the first screen, and then ends with 1.
"""

import argparse
import concurrent.futures
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ["studies/jansen-leg", "studies/fourbar-18-points", "studies/fourbar-reactions", "studies/four-bar-chain-40",
            "studies/balance-engine", "studies/clearance-slider-crank", "studies/tolerances-hoeken",
            "studies/elastic-four-bar", "studies/spin-up-beam", "studies/delta-cylinder-mean", "robots/packing-line",
            "suspension/sweep"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="LINKWRIGHT")
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument("studies", metavar="STUDY", type=Path, nargs="*")
    parser.add_argument("--whole", action="store_true", help="the whole page, not its first screen")
    parser.add_argument("--dark", action="store_true", help="dark colours")
    parser.add_argument("--chromium", default=shutil.which("chromium") or "chromium")
    options = parser.parse_args()
    studies = options.studies or [ROOT / "examples" / f"{name}.toml" for name in EXAMPLES]

    def run(study):
        out = (options.folder / "reports" / study.stem).resolve()
        done = subprocess.run([options.program, "run", str(study), "--out", str(out), "--threads", "1"],
                              capture_output=True, text=True, check=False)
        report = out / "report.html"
        if not report.exists():
            sys.exit(f"{study}: no report\n{done.stderr}")
        return report

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        reports = list(pool.map(run, studies))
    flags = [flag for flag in ("whole", "dark") if getattr(options, flag)]
    return subprocess.run(["node", "tests/pictures.mjs", options.chromium, str(options.folder.resolve()), ",".join(flags),
                           *map(str, reports)], cwd=ROOT / "web", check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
