#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lists functions that are longer than they should be: in the C++ of src/ and in the TypeScript of web/src/.

    tools/long_functions.py [ROOT] [--over LINES] [--at-most COUNT]

One line for each function of more than LINES (100) lines, the longest first, and their number in each language. A function
is counted from its first line to its last brace; one within another belongs to it. With --at-most it ends with 1 when there
are more than COUNT in one language.
C++ is read by its braces, which is right for code that clang-format has formatted; TypeScript by its compiler, which npm
has installed in web/.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

import repository

# Comments, texts, characters and preprocessor lines, of which braces and parentheses have no meaning.
OPAQUE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<![\w])\'(?:[^\'\\\n]|\\.)+\'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*',
                    re.S | re.M)
SCOPE = re.compile(r"(?:^|\s)(?:namespace|class|struct|union|extern)\b[^()=]*$")
FUNCTION = re.compile(r"\)(?:\s*(?:const|noexcept|override|final|mutable|&&?|noexcept\s*\([^()]*\)))*(?:\s*->[^{};()]*)?\s*$")
LABEL = re.compile(r"^\s*(?:public|private|protected)\s*:")
NAME = re.compile(r"(operator\s*(?:\(\)|[^\s(]+)|[\w:~]+)\s*(?:<[^<>()]*>)?\s*\(")
TYPESCRIPT = """
const [{ readFileSync }, typescript] = [require("node:fs"), require("typescript")];
const found = [];
for (const file of process.argv.slice(1)) {
  const source = typescript.createSourceFile(file, readFileSync(file, "utf8"), typescript.ScriptTarget.Latest, true);
  const line = (position) => source.getLineAndCharacterOfPosition(position).line + 1;
  const visit = (node) => {
    if (!typescript.isFunctionLike(node) || !node.body) return typescript.forEachChild(node, visit);
    const owner = node.name ?? node.parent.name;
    found.push([file, line(node.getStart()), line(node.end), owner ? owner.getText() : "a function without a name"]);
  };
  visit(source);
}
console.log(JSON.stringify(found));
"""


def blank(match):
    """As many lines without anything to read."""
    return re.sub(r"[^\n]", " ", match[0])


def functions_of_cpp(text):
    """(first line, last line, name) of every function with a body."""
    text = OPAQUE.sub(blank, text)
    found, open_braces, begin = [], [], 0  # `begin`: where the declaration began that a brace may end
    for mark in re.finditer(r"[{};]", text):
        inside_function = "function" in open_braces
        if mark[0] == "{":
            head = text[begin:mark.start()]
            if inside_function:
                kind = "block"
            elif SCOPE.search(head) and not FUNCTION.search(head):
                kind = "scope"
            elif FUNCTION.search(head):
                kind = "function"
                label = LABEL.match(head)
                first = begin + (label.end() if label else 0)
                first += len(text[first:mark.start()]) - len(text[first:mark.start()].lstrip())
            else:
                kind = "value"  # a list of members, for example: the declaration continues after it
            open_braces.append(kind)
            if kind in ("scope", "function"):
                begin = mark.end()
            if kind == "function":
                start, declaration = first, text[first:mark.start()]
        elif mark[0] == "}":
            kind = open_braces.pop() if open_braces else "scope"
            if kind == "function":
                name = NAME.search(re.sub(r"^\s*template\s*<[^()]*?>\s*(?=\w)", "", declaration))
                found.append((text.count("\n", 0, start) + 1, text.count("\n", 0, mark.start()) + 1,
                              name[1] if name else "a function without a name"))
            if kind in ("scope", "function"):
                begin = mark.end()
        elif not inside_function and "value" not in open_braces:
            begin = mark.end()
    return found


def cpp(root):
    """(file, first line, last line, name) of every function of src/."""
    for path in repository.files(root):
        name = path.relative_to(root).as_posix()
        if name.startswith("src/") and path.suffix in (".h", ".cpp"):
            for function in functions_of_cpp(path.read_text(encoding="utf-8")):
                yield name, *function


def typescript(root):
    """(file, first line, last line, name) of every function of web/src/."""
    names = [path.relative_to(root / "web").as_posix() for path in repository.files(root)
             if path.suffix in (".ts", ".tsx") and path.relative_to(root).parts[:2] == ("web", "src")]
    done = subprocess.run(["node", "-e", TYPESCRIPT, *names], cwd=root / "web", capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit("TypeScript could not be read; is its compiler there (npm ci in web/)?\n" + done.stderr)
    return [(f"web/{name}", *rest) for name, *rest in json.loads(done.stdout)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", metavar="ROOT", type=Path, nargs="?", default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--over", metavar="LINES", type=int, default=100, help="the length that is not listed yet")
    parser.add_argument("--at-most", metavar="COUNT", type=int, help="functions of each language that may be longer")
    options = parser.parse_args()
    code = 0
    for language, functions in (("C++", cpp), ("TypeScript", typescript)):
        everything = list(functions(options.root.resolve()))
        long = sorted(((last - first + 1, file, first, name) for file, first, last, name in everything
                       if last - first + 1 > options.over), reverse=True)
        for lines, file, first, name in long:
            print(f"{lines:5}  {file}:{first}  {name}")
        print(f"{language}: {len(long)} of {len(everything)} functions have more than {options.over} lines")
        if options.at_most is not None and len(long) > options.at_most:
            code = 1
    return code


if __name__ == "__main__":
    sys.exit(main())
