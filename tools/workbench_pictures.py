#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the workbench as its users meet it, to look at before and after a change of the page.

    tools/workbench_pictures.py LINKWRIGHT FOLDER [SCREEN ...] [--chromium CHROMIUM]

Takes nine screens - start, gallery, draw, path, error, search, poses, suspension, robot - of `linkwright serve` on a laptop and on
a phone, in light and in dark colours, into FOLDER/SCREEN-SIZE-COLOURS.png. Says which are wider than the window, and then
ends with 1.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="LINKWRIGHT", type=Path)
    parser.add_argument("folder", metavar="FOLDER", type=Path)
    parser.add_argument("screens", metavar="SCREEN", nargs="*")
    parser.add_argument("--chromium", default=shutil.which("chromium") or "chromium")
    options = parser.parse_args()
    return subprocess.run(["node", "tests/workbench_pictures.mjs", str(options.program.resolve()), options.chromium,
                           str(options.folder.resolve()), *options.screens], cwd=ROOT / "web", check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
