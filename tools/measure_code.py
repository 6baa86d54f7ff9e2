#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a table of measures of the code, to be compared with those of another checkout.

    tools/measure_code.py [ROOT] [--results FOLDER]

Public headers are those that linkwright/<domain>.h includes, directly or through others, without detail/ and the headers of
the standard library; public functions are what they declare. With --results the facts of all result.json files below FOLDER are
counted, as `tools/compare_results.py keep` leaves them.
"""

import argparse
import json
import re
import sys
from pathlib import Path

import check_reach
import check_words
import long_functions
import repository

# Code that takes a number out of a sentence that the program has written: the file, and what shows that it still does.
PROSE_READERS = {
    "src/linkwright/study/answer.cpp": r"\bvalue_of\(const Fact&",
    "src/linkwright/app/compare.cpp": r"\bnumber_of\(",
    "src/linkwright/report/brief.cpp": r"\bbrief\(",
    "web/src/prose.ts": r"RegExp|\.match|\.replace|/g\b",
    "web/manual/messages.mjs": r"function\* tokens\(",
}
# A type that holds a point or vector of the plane: a structure of x and y, or one of the library.
INITIAL = r"(?: = [\w.]+|\{[^}]*\})?"
PLANE_STRUCT = re.compile(rf"\bstruct (\w+) \{{\s*(?:double|T) x{INITIAL}(?:,|;\s*//[^\n]*\n\s*(?:double|T)) y{INITIAL};"
                          r"(?!(?:\s*//[^\n]*)?\s*[\w:<>, ]+ \w+(?:;| =|{))")
PLANE_LIBRARY = [r"std::complex<double>", r"math::Complex<", r"std::array<double, 2>", r"std::pair<double, double>", r"Eigen::Vector2d"]


def sources(root, *suffixes):
    """(path from the root, text) of the sources of src/."""
    for path in repository.files(root):
        name = path.relative_to(root).as_posix()
        if name.startswith("src/") and path.suffix in suffixes:
            yield name, path.read_text(encoding="utf-8")


def prose_readers(root):
    return [name for name, pattern in PROSE_READERS.items()
            if (root / name).is_file() and re.search(pattern, (root / name).read_text(encoding="utf-8"))]


def public_headers(root):
    """The headers that users of the library get from linkwright/<domain>.h."""
    source = root / "src"
    waiting, found = sorted((source / "linkwright").glob("*.h")), set()
    while waiting:
        header = waiting.pop()
        if header in found or not header.is_file() or "detail" in header.parts:
            continue
        found.add(header)
        waiting += [source / name for _, _, name in repository.includes(header) if name.startswith("linkwright/")]
    return sorted(found)


def public_functions(headers):
    """(header, name) of each function that the headers declare; overloads count as one."""
    return {(header, name) for header in headers for name in check_reach.DECLARATION.findall(header.read_text(encoding="utf-8"))}


def plane_vectors(root):
    """The names of the types of src/ that hold a vector of the plane."""
    kinds = set()
    for name, text in sources(root, ".h", ".cpp"):
        module = name.split("/")[2]
        kinds |= {f"{module}::{struct}" for struct in PLANE_STRUCT.findall(text)}
        kinds |= {kind.rstrip("<") for kind in PLANE_LIBRARY if re.search(kind, text)}
    return sorted(kinds)


def fragments(root):
    """(comments, those that begin as fragments) of the modules of the program."""
    counted = [found for module, found in check_words.fragments(root).items() if module.startswith("src/")]
    return sum(comments for comments, _ in counted), sum(len(found) for _, found in counted)


def facts(folder):
    """(facts, those with a value) of all results below a folder."""
    found = [fact for path in sorted(folder.rglob("result.json"))
             for fact in json.loads(path.read_text(encoding="utf-8")).get("answer", {}).get("facts", [])]
    return len(found), sum(fact.get("value") is not None for fact in found)


def measures(root, results=None):
    """(measure, value) of each line of the table."""
    headers = public_headers(root)
    readers, kinds = prose_readers(root), plane_vectors(root)
    comments, fragment = fragments(root)
    yield "readers of our own prose", " ".join([str(len(readers)), *readers])
    if results:
        total, valued = facts(results)
        yield "facts with a value", f"{valued} of {total}, {100 * valued / max(total, 1):.1f} %"
    yield "lines of src", sum(text.count("\n") for _, text in sources(root, ".h", ".cpp"))
    yield "public headers", len(headers)
    yield "public functions", len(public_functions(headers))
    yield "kinds of 2-D vector", f"{len(kinds)}: {', '.join(kinds)}"
    yield "comments that begin as fragments", f"{fragment} of {comments}, {100 * fragment / max(comments, 1):.1f} %"
    for language, functions in (("C++", long_functions.cpp), ("TypeScript", long_functions.typescript)):
        yield f"functions over 100 lines, {language}", sum(last - first + 1 > 100 for _, first, last, _ in functions(root))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("root", metavar="ROOT", type=Path, nargs="?", default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--results", metavar="FOLDER", type=Path, help="results whose facts are counted")
    options = parser.parse_args()
    for measure, value in measures(options.root.resolve(), options.results):
        print(f"{measure:<38}{value}")


if __name__ == "__main__":
    sys.exit(main())
