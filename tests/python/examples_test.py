# SPDX-License-Identifier: BSD-3-Clause
"""The examples run: scripts, and the cells of notebooks one after the other."""

import contextlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(os.environ["LINKWRIGHT_EXAMPLES"], "python")


class Examples(unittest.TestCase):
    def test_scripts(self):
        scripts = sorted(FOLDER.glob("*.py"))
        self.assertGreaterEqual(len(scripts), 6)
        for script in scripts:
            with self.subTest(script.name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-B", script], cwd=folder, capture_output=True, text=True, check=False)
                self.assertEqual((0, ""), (done.returncode, done.stderr))
                self.assertTrue(done.stdout)

    def test_notebooks(self):
        notebooks = sorted(FOLDER.glob("*.ipynb"))
        self.assertTrue(notebooks)
        for notebook in notebooks:
            document = json.loads(notebook.read_text(encoding="utf-8"))
            self.assertEqual(4, document["nbformat"])
            names = {}
            for i, cell in enumerate(document["cells"]):
                if cell["cell_type"] != "code":
                    continue
                with self.subTest(notebook=notebook.name, cell=i + 1):
                    self.assertEqual([], cell["outputs"])
                    with contextlib.redirect_stdout(io.StringIO()):
                        exec(compile("".join(cell["source"]), f"{notebook.name}, cell {i + 1}", "exec"), names)


if __name__ == "__main__":
    unittest.main()
