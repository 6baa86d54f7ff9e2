# SPDX-License-Identifier: BSD-3-Clause
"""`pip install .` in an environment of its own, without a network."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

SOURCE = pathlib.Path(os.environ["LINKWRIGHT_EXAMPLES"]).parent
USED = """
import linkwright, pathlib, sys
assert pathlib.Path(linkwright.__file__).is_relative_to(sys.argv[1]), linkwright.__file__
assert linkwright.example("fourbar-18-points").run().verdict == "passed"
assert linkwright.minimise(lambda x: x[:, 0] ** 2, [-1], [1], "cma_es").cost < 1e-12
carried = [line.split()[-1] for line in open("/proc/self/maps") if any(name in line for name in sys.argv[2:])]
assert carried and all(sys.argv[1] in path for path in carried), carried
"""


class Wheel(unittest.TestCase):
    def test_it_is_built_installed_and_used(self):
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        with tempfile.TemporaryDirectory() as folder:
            home = pathlib.Path(folder, "venv")
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", home], check=True, env=environment)
            pip = [home / "bin/python", "-m", "pip", "--disable-pip-version-check", "--no-cache-dir"]
            offline = {**environment, "PIP_NO_INDEX": "1"}
            subprocess.run([*pip, "wheel", "--quiet", "--no-deps", "-w", folder, SOURCE], check=True, env=offline)
            (wheel,) = pathlib.Path(folder).glob("linkwright-*.whl")
            with zipfile.ZipFile(wheel) as file:
                names = file.namelist()
            self.assertIn("linkwright/py.typed", names)
            self.assertTrue(any(name.startswith("linkwright/libs/libfmt.so") for name in names))
            self.assertTrue(any(name.endswith(".dist-info/licenses/LICENSE") for name in names))
            subprocess.run([*pip, "install", "--quiet", wheel], check=True, env=offline)
            subprocess.run([home / "bin/python", "-c", USED, home, "libfmt", "libpagmo", "libtbb", "libboost_serialization"],
                           check=True, env=environment, cwd=folder)
            subprocess.run([*pip, "uninstall", "--quiet", "--yes", "linkwright"], check=True, env=offline)


if __name__ == "__main__":
    unittest.main()
