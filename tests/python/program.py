# SPDX-License-Identifier: BSD-3-Clause
"""The program that the package is compared with."""

import csv
import os
import pathlib
import subprocess

PROGRAM = os.environ["LINKWRIGHT"]
EXAMPLES = pathlib.Path(os.environ["LINKWRIGHT_EXAMPLES"])


def call(*arguments, folder=None):
    """(exit code, standard output, standard error)"""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=folder)
    return done.returncode, done.stdout, done.stderr


def columns(text):
    """{key: numbers} of a CSV file, NaN for what is missing; texts are left out."""
    rows = list(csv.reader(text.splitlines()))
    out = {}
    for key, *cells in zip(*rows):
        if key not in ("name", "status"):
            out[key] = [float(cell) if cell else float("nan") for cell in cells]
    return out
