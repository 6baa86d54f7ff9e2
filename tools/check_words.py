#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the repository speaks of itself alone: no paths of somebody's machine, no numbers of a tracker that a
reader cannot open, no promises left in the code. And that it calls things by the names of the field: what users read
(pages, study files, the texts of messages and reports) has none of the words that were given up for them. A comment is a
sentence with a subject, or a noun phrase that names the thing: few begin as fragments that lean on the line before.

    tools/check_words.py [ROOT]
    tools/check_words.py --comments [ROOT]      comments and fragments of each module
    tools/check_words.py --fragments [ROOT]     where each fragment is
    tools/check_words.py --identifiers [ROOT]   names that still have the words given up for them
"""

import collections
import io
import re
import sys
import tokenize
from pathlib import Path

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


# Words that users do not read, each with its replacement.
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
# Files that quote the old words.
QUOTED = {"CHANGELOG.md", "docs/changes-in-detail.md", "src/linkwright/study/renamed.cpp"}
# Written by tools, not by people.
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.S)
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
SKIPPED_NAMES = {"package-lock.json", "LICENSE"}

# A comment that begins so leans on the line before it, or leaves out what it speaks of.
FRAGMENT = re.compile(r"(?:of|what|whatever|whether|where|that|those|with|how|than|as|which|who|whose|why|when(?![^.]*,))\b",
                      re.I)
MOST_FRAGMENTS = 0.05  # share of the comments of a module of the program
# Comments that are no prose: ends of namespaces, words for tools, rulers.
NO_PROSE = re.compile(r"namespace\b|NOLINT|clang-format|eslint|@ts-|noqa|!/|-\*-|[^\w\s]*$")
# A string, a character, a regular expression of TypeScript, or a comment, which alone has a name.
STRING = r'"(?:[^"\\\n]|\\.)*"'
CHARACTERS = r"'(?:[^'\\\n]|\\.)*'"
COMMENT = r"(?P<comment>//[^\n]*|/\*.*?\*/)"
C_TOKEN = re.compile(rf'R"(?P<end>\w*)\(.*?\)(?P=end)"|{STRING}|(?<!\w){CHARACTERS}|{COMMENT}', re.S)
TS_TOKEN = re.compile(rf"{STRING}|{CHARACTERS}|`(?:[^`\\]|\\.)*`"
                      r"|[(=,:\[!&|?]\s*/(?![/*])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\[\n])+/" rf"|{COMMENT}", re.S)
CMAKE_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|(?P<comment>#[^\n]*)', re.S)
TOKENS = {".h": C_TOKEN, ".cpp": C_TOKEN, ".ts": TS_TOKEN, ".tsx": TS_TOKEN, ".mjs": TS_TOKEN, ".cmake": CMAKE_TOKEN,
          "CMakeLists.txt": CMAKE_TOKEN}
MARKER = re.compile(r"(?://[/!]?<?|#+|/\*+|\*(?!/))")
# Words of names that were given up; some of them are still right here and there.
NAMES_GIVEN_UP = re.compile(
    r"(?<![a-z])(?:ways?|told|tells?|wheel_?guides?|guides?|settled?|settling|kept|restored|go_on|there|held|remarks?|beside"
    r"|looks|trade_words|troubles?|drawbacks?|most|longest|least|felt|spun|turned|evenness|in_the_limit|on_orbit|hops?"
    r"|stretch(?:es)?|pieces?|stands?|sown|anew)(?![a-z])")
WORD_BREAK = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


def comments(where, text):
    """(line number, text) of each comment of a source; lines of one marker below each other are one comment."""
    if where.suffix == ".py":
        found = [(token.start[0], token.start[1], token.string)
                 for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type == tokenize.COMMENT]
    elif tokens := TOKENS.get(where.suffix) or TOKENS.get(where.name):
        found = [(text.count("\n", 0, match.start("comment")) + 1,
                  match.start("comment") - text.rfind("\n", 0, match.start("comment")) - 1, match["comment"])
                 for match in tokens.finditer(text) if match["comment"]]
    else:
        return
    lines = text.splitlines()
    last = (0, 0, "")
    for number, column, comment in found:
        marker = MARKER.match(comment)[0]
        alone = not lines[number - 1][:column].strip()
        if not (alone and last == (number - 1, column, marker)):
            said = comment[len(marker):].strip(" *\n/")
            if said and not NO_PROSE.match(said):
                yield number, said
        last = (number, column, marker)


def module_of(where):
    """The folder that a source is counted in: a module of the program, else the folder at the root; None for the rest."""
    parts = where.parts
    if parts[:2] == ("src", "linkwright"):
        return "/".join(parts[:3]) if len(parts) > 3 else "src/linkwright"
    if parts[0] == "web":
        return "/".join(parts[:2]) if len(parts) > 2 else None
    return parts[0] if parts[0] in ("tests", "tools", "python", "bench", "fuzz") else None


def sources(root):
    """(path from the root, module, text) of every source."""
    for path in repository.files(root):
        where = path.relative_to(root)
        if (module := module_of(where)) and (text := repository.text_of(path)) is not None:
            yield where, module, text


def fragments(root):
    """(comments, [(path, line number, text) of those that begin as fragments]) of each module."""
    counted = collections.defaultdict(lambda: [0, []])
    for where, module, text in sources(root):
        for number, said in comments(where, text):
            counted[module][0] += 1
            if FRAGMENT.match(said):
                counted[module][1].append((where, number, said))
    return counted


def names_given_up(root):
    """How many different names of sources have each word given up for names."""
    names = {name for where, _, text in sources(root) if where.suffix in TOKENS
             for name in re.findall(r"\b[A-Za-z_]\w*", TOKENS[where.suffix].sub(" ", text))}
    return collections.Counter(word for name in names
                               for word in NAMES_GIVEN_UP.findall(WORD_BREAK.sub("_", name).lower()))


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
    for module, (all_of, found) in fragments(root).items():
        if module.startswith("src/linkwright/") and len(found) > MOST_FRAGMENTS * all_of:
            findings += [f"{where}:{number}: '{said}': a fragment; write a sentence or name the thing"
                         for where, number, said in found]
    return findings


def show_comments(root):
    counted = fragments(root)
    counted["all"] = [sum(all_of for all_of, _ in counted.values()), sum((found for _, found in counted.values()), [])]
    print(f"{'module':<32}{'comments':>10}{'fragments':>11}{'percent':>9}")
    for module, (all_of, found) in counted.items():
        print(f"{module:<32}{all_of:>10}{len(found):>11}{100 * len(found) / all_of:>9.1f}")


def show_fragments(root):
    for _, found in fragments(root).values():
        for where, number, said in found:
            print(f"{where}:{number}: {said}")


def show_identifiers(root):
    for word, names in names_given_up(root).most_common():
        print(f"{word:<20}{names:>6}")


if __name__ == "__main__":
    shows = {"--comments": show_comments, "--fragments": show_fragments, "--identifiers": show_identifiers}
    if len(sys.argv) > 1 and sys.argv[1] in shows:
        shows[sys.argv[1]](Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else Path(__file__).resolve().parent.parent)
        sys.exit(0)
    sys.exit(repository.main(check))
