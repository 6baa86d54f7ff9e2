# SPDX-License-Identifier: BSD-3-Clause
"""The figures that the script `run` prints at its end stand in the summaries of its studies, and it fails without one.

    run_figures.py LINKWRIGHT SCRIPT
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

program, script = sys.argv[1:]
text = Path(script).read_text(encoding="utf-8")
function = re.search(r"^figure\(\) \{\n.*?^\}\n", text, re.DOTALL | re.MULTILINE).group()
labels = re.findall(r"""figure "\$study" '([^']+)'""", text)
lists = set(re.findall(r"^for study in (.*); do$", text, re.MULTILINE))
assert len(labels) >= 4 and len(lists) == 1, f"the script has other figures or studies than expected: {labels}, {lists}"


def figure(study, label, folder):
    """What the script's own function says, and with which code it ends."""
    done = subprocess.run(["sh", "-euc", f"{function}x=$(figure '{study}' '{label}')\necho \"$x\""], cwd=folder,
                          capture_output=True, text=True, check=False)
    return done.returncode, done.stdout.strip(), done.stderr


with tempfile.TemporaryDirectory() as folder:
    out = Path(folder) / "out"
    out.mkdir()
    for study in lists.pop().split():
        file = Path(script).parent / "examples/studies" / f"{study}.toml"
        summary = subprocess.run([program, "run", file, "--out", out / study], capture_output=True, text=True, check=True)
        (out / f"{study}.txt").write_text(summary.stdout, encoding="utf-8")
        for label in labels:
            code, found, _ = figure(study, label, folder)
            assert code == 0 and re.search(r"\w", found), f"{study}: nothing stands behind '{label}':\n{summary.stdout}"
        code, found, complaint = figure(study, "no such label", folder)
        assert code != 0 and not found, "the script goes on without a figure"
        assert complaint == f"run: the summary out/{study}.txt has no line 'no such label'\n", complaint
