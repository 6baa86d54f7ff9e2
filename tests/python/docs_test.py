# SPDX-License-Identifier: BSD-3-Clause
"""What the pages show of Python runs."""

import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["LINKWRIGHT_EXAMPLES"]).parent


class Pages(unittest.TestCase):
    def test_their_code_runs_from_top_to_bottom(self):
        for page in ("README.md", "docs/python.md"):
            blocks = re.findall(r"^```python\n(.*?)^```", (SOURCE / page).read_text(encoding="utf-8"), re.M | re.S)
            self.assertTrue(blocks)
            names = {}
            with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
                before = os.getcwd()
                os.chdir(folder)
                try:
                    for i, block in enumerate(blocks):
                        with self.subTest(page=page, block=i):
                            exec(compile(block, f"{page}, block {i + 1}", "exec"), names)
                finally:
                    os.chdir(before)


if __name__ == "__main__":
    unittest.main()
