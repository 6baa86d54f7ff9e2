"""Runs the study that the README shows.

    readme_study.py LINKWRIGHT README
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

program, readme = sys.argv[1:]
[study] = re.findall(r"```toml\n(.*?)```", Path(readme).read_text(encoding="utf-8"), re.DOTALL)
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "study.toml"
    file.write_text(study, encoding="utf-8")
    sys.exit(subprocess.run([program, "run", file, "--out", Path(folder) / "out"], check=False).returncode)
