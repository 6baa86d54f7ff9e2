# SPDX-License-Identifier: BSD-3-Clause
"""What the checks of the repository share: its files, its include lines, and how findings are reported."""

import re
import subprocess
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SKIPPED_FOLDERS = {"build", "out", "dist", "node_modules", "__pycache__", ".git", ".cache"}


def files(root):
    """Every file of the repository: what git knows and would add; without git, every file outside build folders."""
    listed = subprocess.run(
        ["git", "-c", "safe.directory=*", "ls-files", "--cached", "--others", "--exclude-standard", "-z"],
        cwd=root, capture_output=True, check=False) if (root / ".git").exists() else None
    if listed and listed.returncode == 0:
        names = sorted(set(listed.stdout.decode().split("\0")) - {""})
        return [root / name for name in names if (root / name).is_file()]
    return sorted(path for path in root.rglob("*")
                  if path.is_file() and not SKIPPED_FOLDERS & set(path.relative_to(root).parts))


def text_of(path):
    """The text of a file, or None when it is binary."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return None


def includes(path):
    """(line number, bracket, name) of every include line."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1], match[2]


def public_headers(root):
    """What users of the library include: the entry headers straight under src/linkwright, and what these include."""
    src = root / "src"
    entries = sorted((src / "linkwright").glob("*.h"))
    inner = {src / name for entry in entries for _, _, name in includes(entry) if name.count("/") > 1}
    return entries + sorted(inner)


def main(check):
    """Runs `check(root)`, which returns findings; root is the argument or the repository of this script."""
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    findings = check(root)
    for finding in findings:
        print(finding)
    if findings:
        print(f"{len(findings)} to fix")
    return 1 if findings else 0
