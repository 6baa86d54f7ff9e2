#!/usr/bin/env python3
"""Checks that the repository speaks of itself alone: no paths of somebody's machine, no numbers of a tracker that a
reader cannot open, no promises left in the code.

    tools/check_words.py [ROOT]
"""

import re
import sys

import repository

# Written in pieces, so that this file does not find itself.
PATTERNS = [
    (re.compile(r"(?<![\w.~}$)/-])/(?:wo" r"rk|t" r"mp|ho" r"me|ro" r"ot)/[\w.]"), "path of a machine"),
    (re.compile(r"\b(?:iss" r"ue|tic" r"ket|pull req" r"uest|fixes|closes|resolves)s?:? +#\d+", re.I),
     "number of a tracker"),
    (re.compile(r"\bGH-\d+\b"), "number of a tracker"),
    (re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b"), "unfinished business: do it, or say plainly what is not done"),
    (re.compile(r"\b(?:sub-?ag" r"ents?|chat" r"bots?|language mod" r"els?)\b", re.I), "talks about how it was written"),
]
# Written by tools, not by people.
SKIPPED_NAMES = {"package-lock.json", "LICENSE"}


def check(root):
    findings = []
    for path in repository.files(root):
        where = path.relative_to(root)
        if path.name in SKIPPED_NAMES or where.parts[:2] == ("fuzz", "corpus"):
            continue
        text = repository.text_of(path)
        if text is None:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            for pattern, meaning in PATTERNS:
                if match := pattern.search(line):
                    findings.append(f"{where}:{number}: '{match[0]}': {meaning}")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
