#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the C++ reference is complete: Doxygen reads the public headers, and each function, parameter, returned
value, type and member in them without a description is a finding. With --html it writes the pages of the reference, which web/manual
puts into the frame of the manual.

    tools/check_reference.py [ROOT]
    tools/check_reference.py --html FOLDER [ROOT]

A header belongs to the group of its folder (core, planar, ...), which its entry header, src/linkwright/<folder>.h, defines
by @defgroup. `study` and `app` belong to `studies`.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import repository

DOCS = Path(__file__).resolve().parent.parent / "docs"
GROUPS = {"study": "studies", "app": "studies"}
# Functions that have the same form everywhere; core/field.h explains them once.
FIELDS = re.compile(r"^template <class Visitor>(?=\nvoid fields\(Visitor&& (\w+), ([\w:]+)& (\w+)\))", re.M)
NAMES = re.compile(r"^(?=constexpr std::array<EnumName<([\w:]+)>, \d+> names\()", re.M)
# Points that end no sentence: Doxygen takes the first sentence as the brief description.
ABBREVIATIONS = re.compile(r"(?<=[ (])(et al|Eqs?|Figs?)\.(?: |$)", re.M)
# A namespace that only declares what other headers define is no part of a group and ends without its name.
NAMESPACE = re.compile(r"^(namespace (linkwright[\w:]*) \{)(\n.*?^)(\}  // namespace \2$)", re.M | re.S)


def grouped(text, group):
    """The text of a header whose namespaces are parts of a group, line by line as before."""
    text = ABBREVIATIONS.sub(r"\1.\\ ", text)
    text = FIELDS.sub(r"/** Field list of \2, see Field. @param \1 called with the Field and the value of each member "
                      r"@param \3 whose members are visited */ template <class Visitor>", text)
    text = NAMES.sub(r"/** @returns the names of \1 in files, see EnumName */ ", text)
    return NAMESPACE.sub(rf"\1 /** @addtogroup {group} */ /** @{{ */\3/** @}} */ \4", text)


def run(root, settings):
    """Runs Doxygen over the public headers; returns its warnings, with paths from the root."""
    program = shutil.which("doxygen")
    if not program:
        return ["doxygen is not installed: apt-get install doxygen"]
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder).resolve()
        for header in repository.public_headers(root):
            name = header.relative_to(root)
            if not header.is_file():
                return [f"{name}: is gone; tools/check_mirror.py says who includes it"]
            text = header.read_text(encoding="utf-8")
            if len(name.parts) > 3:
                text = grouped(text, GROUPS.get(name.parts[2], name.parts[2]))
            (scratch / name).parent.mkdir(parents=True, exist_ok=True)
            (scratch / name).write_text(text, encoding="utf-8")
        (scratch / "pages").mkdir(exist_ok=True)
        examples = root / "examples" / "cpp"
        settings = [(DOCS / "Doxyfile").read_text(encoding="utf-8"), f"LAYOUT_FILE = {DOCS / 'DoxygenLayout.xml'}",
                    f"EXAMPLE_PATH = {examples if examples.is_dir() else ''}", *settings]
        result = subprocess.run([program, "-"], input="\n".join(settings) + "\n", cwd=scratch, capture_output=True,
                                text=True, check=False)
        # Lines that do not begin with a path go on with the warning above them.
        lines = result.stderr.replace(f"{scratch}/", "").splitlines()
    findings = []
    for line in lines:
        if re.match(r"\s", line) and findings:
            findings[-1] += "; " + line.strip()
        elif line.strip():
            # What has a brief description alone is without a place, but its whole name is in the message.
            findings.append(re.sub(r"^<[^:]*>:\d+: ", "", line))
    if result.returncode and not findings:
        findings.append(f"doxygen ends with code {result.returncode}")
    return sorted(set(findings))


def check(root):
    # Doxygen 1.9.4 sees which parameters are described only while it writes pages.
    return run(root, ["OUTPUT_DIRECTORY = pages", "GENERATE_HTML = YES"])


def write_pages(root, folder):
    """Writes the pages without a frame, each after a line with its title, and the names in them as names.xml."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "head").write_text('<!--title $title--><div id="top">\n', encoding="utf-8")
    (folder / "foot").write_text("<!--end-->\n", encoding="utf-8")
    return run(root, [f"OUTPUT_DIRECTORY = {folder}", "GENERATE_HTML = YES", "WARN_AS_ERROR = NO",
                      f"HTML_HEADER = {folder / 'head'}", f"HTML_FOOTER = {folder / 'foot'}",
                      f"GENERATE_TAGFILE = {folder / 'names.xml'}"])


def main():
    if "--html" not in sys.argv:
        return repository.main(check)
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--html", type=Path, required=True)
    arguments.add_argument("root", nargs="?", type=Path, default=Path(__file__).parent.parent)
    given = arguments.parse_args()
    findings = write_pages(given.root.resolve(), given.html.resolve())
    if findings:
        print(findings[0] + (f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""), file=sys.stderr)
    return 0 if (given.html / "index.html").is_file() else 1


if __name__ == "__main__":
    sys.exit(main())
