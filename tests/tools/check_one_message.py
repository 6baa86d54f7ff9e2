#!/usr/bin/env python3
"""Spoils every value of every template, one at a time, and counts the error messages: one mistake, one message.

usage: check_one_message.py LINKWRIGHT [EVERY]
EVERY = n takes each n-th value only (default 1).
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

program = sys.argv[1]
every = int(sys.argv[2]) if len(sys.argv) > 2 else 1


def run(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


def spoilt(text):
    """The lines of a study with the value of one key made a value of the wrong type."""
    lines = text.splitlines()
    for i, line in enumerate(lines):
        match = re.match(r"^(\s*[A-Za-z_0-9]+\s*=\s*)(.*)$", line)
        if not match:
            continue
        value = match.group(2).split("#")[0].rstrip()
        if value.startswith(("[", "{")) and value.count("[") + value.count("{") != value.count("]") + value.count("}"):
            continue  # goes on in the next line
        wrong = "5" if value.startswith(("true", "false")) else "true"
        yield line.strip(), "\n".join([*lines[:i], match.group(1) + wrong, *lines[i + 1:]]) + "\n"


def main():
    kinds = [one["name"] for one in json.loads(run("catalogue", "--json").stdout)]
    count = failures = 0
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "study.toml"
        for kind in kinds:
            for line, text in spoilt(run("new", kind, "-").stdout):
                count += 1
                if count % every:
                    continue
                file.write_text(text)
                answer = run("check", str(file))
                errors = [e for e in answer.stderr.splitlines() if ": error: " in e]
                if answer.returncode != 2 or len(errors) != 1:
                    failures += 1
                    print(f"{kind}: {line}")
                    for error in errors[:6] or [f"exit code {answer.returncode}, no error"]:
                        print("    " + error.split("study.toml:")[-1][:200])
    print(f"{count} values, every {every}: {failures} with other than one message")
    return 1 if failures or count < 100 else 0


sys.exit(main())
