# SPDX-License-Identifier: BSD-3-Clause
"""Runs the studies that the README shows.

    readme_study.py LINKWRIGHT README
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

program, readme = sys.argv[1:]
studies = re.findall(r"```toml\n(.*?)```", Path(readme).read_text(encoding="utf-8"), re.DOTALL)
assert studies, "the README shows no study"
for study in studies:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "study.toml"
        file.write_text(study, encoding="utf-8")
        code = subprocess.run([program, "run", file, "--out", Path(folder) / "out"], check=False).returncode
        if code:
            sys.exit(code)
