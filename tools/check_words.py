#!/usr/bin/env python3
"""Checks that the repository speaks of itself alone: no paths of somebody's machine, no numbers of a tracker that a
reader cannot open, no promises left in the code. And that it calls things by the names of the field: what users read
(pages, study files, the texts of messages and reports) has none of the words that were given up for them.

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

def words(pattern, instead):
    return re.compile(rf"\b(?:{pattern})\b", re.I), f"say {instead}"


# What users read has other words for these.
GIVEN_UP = [
    words("told|tells", "reported, given, listed, says"),
    words("even motion", "uniform motion"),
    words("to and fro", "reciprocating"),
    words("evenness|regulation", "speed fluctuation"),
    words("(?:goes|go|going) round", "rotates fully"),
    words(r"loose (?:\w+ )?pins?|play of (?:the|a|its|all) (?:pins?|joints?)", "clearance joint, joint clearance"),
    words("errs", "deviates"),
    words("(?:links?|bod(?:y|ies)|beams?) that bends?", "flexible link, body, beam"),
    words("designed numbers?", "design variable"),
    words("hurdles?", "criterion"),
    words("mend|mends|mended|puts? right", "fix, corrected"),
    words("wheel guides?", "wheel suspension"),
    words("rooms and floors|furniture|strangers?", "module, layer, files of a unit, untrusted input"),
    words("anew", "again, recomputed"),
    words("stands? (?:twice|in|on|at|above|upright|outside)", "is given, listed, mounted, fixed, vertical"),
    words("of use", "usable, feasible"),
    words("(?:of|has|have) no use", "ignored"),
    words(r"(?<!here )(?:is|are) no (?!(?:larger|longer|more|less|better|worse|way|other)\b)\w+", "is not a"),
    words("(?:is|are) put to", "assigned to"),
    words("as long as (?:it|they) (?:is|are)", "unchanged, equally long"),
    words(r"ways? of the (?!same\b)\w+", "displacement, path, trajectory of the"),
    words("in the place of", "instead of, in place of"),
    words("meets? and cross(?:es)?", "coincide"),
    words("(?:can|cannot|will|goes) go on|goes on", "continues"),
    words("left alone", "not interrupted, not overwritten"),
    words("canned", "built-in"),
    words("lever arms? of", "moment arm"),
    words("by (?:chance only|luck)", "for special dimensions only"),
    words("(?:is|are) to become", "is minimised"),
    words(r"how far (?:the|they|it)\b.*\boff", "deviation"),
]
# Where the old words are quoted.
QUOTED = {"CHANGELOG.md", "src/linkwright/study/renamed.cpp"}
# Written by tools, not by people.
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.S)
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
SKIPPED_NAMES = {"package-lock.json", "LICENSE"}


def for_users(where, text):
    """(line number, text) of what users read in a file: pages and study files as a whole, the literals of sources."""
    if where.as_posix() in QUOTED:
        return
    if where.suffix in (".md", ".toml"):
        yield from enumerate(text.splitlines(), 1)
    elif where.parts[0] == "src" and where.suffix in (".h", ".cpp"):
        plain = RAW_STRING.sub(lambda raw: "\n" * raw[0].count("\n"), text)
        for number, line in enumerate(plain.splitlines(), 1):
            if not line.lstrip().startswith(("#include", "//")):
                yield number, " ".join(LITERAL.findall(line))


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
        for number, line in for_users(where, text):
            for pattern, instead in GIVEN_UP:
                if match := pattern.search(line):
                    findings.append(f"{where}:{number}: '{match[0]}': {instead}")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
