#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every C++ file is formatted as .clang-format says, and that every source file names its licence.

    tools/check_format.py [ROOT]

Debian 12's clang-format 14 is the judge; others break lines elsewhere.
"""

import shutil
import subprocess
import sys

import repository


LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
SOURCES = {".h", ".cpp", ".ts", ".tsx", ".mjs", ".js", ".css", ".py", ".sh", ".cmake", ".yml", ".yaml"}


def licences(root):
    """Source files without the line of their licence; examples are there to be copied and carry none."""
    for path in repository.files(root):
        name = path.relative_to(root)
        source = path.suffix in SOURCES or path.name == "CMakeLists.txt"
        if source and name.parts[0] != "examples" and LICENCE not in path.read_text(encoding="utf-8")[:300]:
            yield f"{name}: add the line {LICENCE} as a comment at its top"


def check(root):
    program = shutil.which("clang-format-14") or shutil.which("clang-format")
    if not program:
        return [*licences(root), "clang-format is not installed: apt-get install clang-format-14"]
    sources = [path for path in repository.files(root) if path.suffix in (".h", ".cpp")]
    run = subprocess.run([program, "--dry-run", "--ferror-limit=1", "--style=file", *map(str, sources)],
                         cwd=root, capture_output=True, text=True, check=False)
    wrong = sorted({line.split(":")[0] for line in run.stderr.splitlines() if "[-Wclang-format-violations]" in line})
    return [*licences(root), *(f"{path}: is not formatted; run clang-format -i on it" for path in wrong)]


if __name__ == "__main__":
    sys.exit(repository.main(check))
