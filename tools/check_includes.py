#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a file of src/ includes the standard headers whose names it uses, and core/check.h for what it requires, so that
each can be read, moved and compiled alone. A source may leave them to the header of its own name.

    tools/check_includes.py [ROOT]
"""

import re
import sys

import repository

# The names for which a header is included. Only names that people write out: std::get belongs to three headers and is
# none's.
NAMES = {
    "array": "array|to_array",
    "complex": "complex|polar",
    "functional": "function|reference_wrapper|c?ref|hash|less|greater|plus|minus|multiplies|invoke",
    "optional": "optional|nullopt|make_optional",
    "span": "span|dynamic_extent",
    "string": "string|to_string|sto(?:i|l|ul|ll|ull|d)|getline",
    "string_view": "string_view",
    "variant": "variant|visit|get_if|holds_alternative|monostate",
    "vector": "vector",
}
USES = {f"<{header}>": re.compile(rf"\bstd::(?:{names})\b") for header, names in NAMES.items()}
USES['"linkwright/core/check.h"'] = re.compile(r"(?<!#define )\bLINKWRIGHT_REQUIRE(?=\()")
COMMENTS_AND_TEXTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', re.S)


def included(path):
    """Headers that a file includes itself, in their brackets."""
    return {f"<{name}>" if bracket == "<" else f'"{name}"' for _, bracket, name in repository.includes(path)}


def missing(path):
    """(name, header) of what a file uses and neither it nor, for a source, the header of its name includes."""
    code = COMMENTS_AND_TEXTS.sub("", path.read_text(encoding="utf-8"))
    own = path.with_suffix(".h")
    there = included(path) | (included(own) if path.suffix == ".cpp" and own.is_file() else set())
    return [(use[0], header) for header, uses in USES.items() if header not in there and (use := uses.search(code))]


def sources(root):
    return [path for path in repository.files(root)
            if path.suffix in (".h", ".cpp") and path.relative_to(root).parts[0] == "src"]


def check(root):
    return [f"{path.relative_to(root).as_posix()}: uses {name} without #include {header}"
            for path in sources(root) for name, header in missing(path)]


if __name__ == "__main__":
    sys.exit(repository.main(check))
