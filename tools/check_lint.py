#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what linters find in the sources that are not C++: flake8 in Python, shellcheck in shell, yamllint in YAML, and
ESLint in TypeScript and the scripts of Node. Their rules are in .flake8, .yamllint and web/eslint.config.mjs.

    tools/check_lint.py [ROOT]
"""

import shutil
import subprocess
import sys

import repository

YAML = {".yml", ".yaml", ".cff"}


def is_shell(path):
    """Whether a file is a script of the shell; those that have no suffix say so in their first line."""
    if path.suffix:
        return path.suffix == ".sh"
    with path.open("rb") as file:
        return file.readline().rstrip() in (b"#!/bin/sh", b"#!/bin/bash")


def run(program, words, files, root):
    """The findings of a linter of Debian, one a line."""
    if not files:
        return []
    if not shutil.which(program):
        return [f"{program} is not installed: apt-get install {program}"]
    done = subprocess.run([program, *words, *(str(path.relative_to(root)) for path in files)],
                          cwd=root, capture_output=True, text=True, check=False)
    return (done.stdout + done.stderr).splitlines() if done.returncode else []


def check_web(root):
    web = root / "web"
    if not (web / "package.json").is_file():
        return []
    if not (web / "node_modules/.bin/eslint").exists():
        return ["ESLint is not installed: npm ci in web/"]
    done = subprocess.run(["npm", "run", "--silent", "lint"], cwd=web, capture_output=True, text=True, check=False)
    return (done.stdout + done.stderr).splitlines() if done.returncode else []


def check(root):
    files = repository.files(root)
    return (run("flake8", [], [path for path in files if path.suffix == ".py"], root)
            + run("shellcheck", ["--format=gcc"], [path for path in files if is_shell(path)], root)
            + run("yamllint", ["--format=parsable", "--strict"], [path for path in files if path.suffix in YAML], root)
            + check_web(root))


if __name__ == "__main__":
    sys.exit(repository.main(check))
