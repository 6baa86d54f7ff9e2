#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Spoils every value of every template and of some examples, one at a time, misspells every key, table and word of them, and
counts the error messages: one mistake, one message. Each is among those that the manual lists (web/manual/messages.mjs), which reads
them from the sources.

usage: check_one_message.py LINKWRIGHT EXAMPLES [EVERY]
EVERY = n takes each n-th mistake only (default 1).
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

program = sys.argv[1]
examples = pathlib.Path(sys.argv[2])
every = int(sys.argv[3]) if len(sys.argv) > 3 else 1
# Built-in mechanisms are included, of which templates have none.
with_samples = ["studies/jansen-leg", "studies/four-bar-chain-2", "studies/tolerances-hoeken"]


def listed_messages():
    """Patterns of the messages that the manual lists. A message may be put together of several of its texts."""
    script = pathlib.Path(__file__).resolve().parents[2] / "web/manual/messages.mjs"
    texts = {one["text"] for one in json.loads(subprocess.run(["node", script], check=True, capture_output=True, text=True).stdout)}
    return [re.compile(".*?".join(re.escape(part) for part in text.split("…")), re.S)
            for text in texts if len(re.sub(r"[^A-Za-z]", "", text)) >= 8]


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


def misspelt(text):
    """The lines of a study with one key, one name of a table or one word misspelt."""
    lines = text.splitlines()
    for i, line in enumerate(lines):
        def but(there):
            return "\n".join([*lines[:i], there, *lines[i + 1:]]) + "\n"

        if match := re.match(r"^(\s*)([A-Za-z_0-9]+)(\s*=.*)$", line):
            key = match.group(2)
            if len(key.split("_")[0]) > 3:  # "x_m" is another key, not a misspelt one
                yield f"key {line.strip()}", but(match.group(1) + key[:2] + key[3:] + match.group(3))
        if match := re.match(r"^(\s*\[+(?:[a-z_]+\.)*)([a-z_]{4,})(\]+.*)$", line):
            name = match.group(2)
            yield f"table {line.strip()}", but(match.group(1) + name[:2] + name[3:] + match.group(3))
        # A name or a folder may be any, and every reference to it is then a mistake of its own; the result is searched for what a
        # check asks for.
        if match := re.match(r'^(\s*(?!name|title|source|quantity|dir)[a-z_]+\s*=\s*)"([^"]+)"(.*)$', line):
            yield f"word {line.strip()}", but(f'{match.group(1)}"{match.group(2)}x"{match.group(3)}')


def main():
    kinds = [one["name"] for one in json.loads(run("catalogue", "--json").stdout)]
    listed = listed_messages()
    count = failures = unlisted = 0
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "study.toml"
        studies = [(kind, run("new", kind, "-").stdout) for kind in kinds]
        studies += [(name, (examples / f"{name}.toml").read_text()) for name in with_samples]
        for kind, study in studies:
            for line, text in (*spoilt(study), *misspelt(study)):
                count += 1
                if count % every:
                    continue
                file.write_text(text)
                answer = run("check", str(file))
                errors = [e for e in answer.stderr.splitlines() if ": error: " in e]
                for error in errors:
                    said = error.split(": error: ", 1)[1]
                    if not any(pattern.search(said) for pattern in listed):
                        unlisted += 1
                        print(f"{kind}: {line}: not in the manual's list: {said}")
                if answer.returncode != 2 or len(errors) != 1:
                    failures += 1
                    print(f"{kind}: {line}")
                    for error in errors[:6] or [f"exit code {answer.returncode}, no error"]:
                        print("    " + error.split("study.toml:")[-1][:200])
    print(f"{count} mistakes, every {every}: {failures} with other than one message, {unlisted} messages that the manual does not list")
    return 1 if failures or unlisted or count < 100 else 0


sys.exit(main())
