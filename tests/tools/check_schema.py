#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the JSON Schema of each kind accepts the template of the kind and the example studies.

usage: check_schema.py LINKWRIGHT STUDY-OR-FOLDER...
"""
import json
import pathlib
import subprocess
import sys
import tomllib

from jsonschema import Draft202012Validator

program = sys.argv[1]


def run(*arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def validator(schema):
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def problems(check, document):
    """What refuses the document: the path and the message of the deepest errors."""
    out = []
    for error in check.iter_errors(document):
        while error.context:
            error = min(error.context, key=lambda e: -len(e.absolute_path))
        out.append(f"{'.'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    return out


def main():
    whole = json.loads(run("schema"))
    kinds = {kind["title"]: kind for kind in whole["anyOf"]}
    for schema in kinds.values():
        Draft202012Validator.check_schema(schema)

    def kind_of(study):
        name = f"{study.get('kind')}/{study.get('mechanism', {}).get('type')}"
        target = study.get("target", {}).get("type") if isinstance(study.get("target"), dict) else None
        return kinds.get(f"{name}/{target}") or kinds.get(name) or kinds.get(study.get("kind"))

    refused = 0
    count = 0

    def check(name, study):
        nonlocal refused, count
        count += 1
        schema = kind_of(study)
        found = problems(validator(schema), study) if schema else ["no kind of this name"]
        if found:
            refused += 1
            print(f"{name}:")
            for line in found[:5]:
                print(f"    {line}")

    for title in kinds:
        check(f"template of {title}", tomllib.loads(run("new", title, "-")))
    for argument in sys.argv[2:]:
        path = pathlib.Path(argument)
        for file in sorted(path.rglob("*.toml")) if path.is_dir() else [path]:
            study = tomllib.loads(file.read_text(encoding="utf-8"))
            if "schema" in study and "kind" in study:
                check(str(file), study)
    print(f"{count - refused} accepted, {refused} refused")
    return 1 if refused or count == 0 else 0


sys.exit(main())
