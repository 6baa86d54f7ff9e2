#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs templates and checks their result.json against `linkwright schema result`.

usage: check_results.py LINKWRIGHT [KIND...]      without kinds: the template of every kind
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

program = sys.argv[1]


def run(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True)


def main():
    schema = json.loads(run("schema", "result").stdout)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    kinds = sys.argv[2:] or [one["name"] for one in json.loads(run("catalogue", "--json").stdout)]
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for kind in kinds:
            study = pathlib.Path(folder) / "study.toml"
            study.write_text(run("new", kind, "-").stdout)
            answer = run("run", str(study), "--out", folder, "--time-limit", "2", "--set", 'output.formats=["json"]')
            document = json.loads((pathlib.Path(folder) / "result.json").read_text())
            problems = [f"{'.'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator.iter_errors(document)]
            if answer.returncode not in (0, 1, 3):
                problems.append(f"exit code {answer.returncode}: {answer.stderr[:300]}")
            if not document["answer"]["headline"]:
                problems.append("the answer has no headline")
            if document["answer"]["verdict"] in ("failed", "doubtful") and not document["answer"]["reasons"]:
                problems.append("no reason is given")
            if problems:
                failures += 1
                print(f"{kind}:")
                for problem in problems[:5]:
                    print("    " + problem)
    print(f"{len(kinds)} results, {failures} with problems")
    return 1 if failures or not kinds else 0


sys.exit(main())
