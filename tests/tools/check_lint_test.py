# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_lint


class CheckLint(ScratchCase):
    def setUp(self):
        super().setUp()
        self.write(".yamllint", "extends: default\nrules: {document-start: disable}\n")

    def test_clean_files_pass(self):
        self.write("a.py", "import os\n\nprint(os.sep)\n")
        self.write("b.sh", '#!/bin/sh\necho "$1"\n')
        self.write("c.yml", "one: 1\n")
        self.assertEqual(check_lint.check(self.root), [])

    def test_python(self):
        self.write("a.py", "import os\n")
        [finding] = check_lint.check(self.root)
        self.assertIn("a.py:1:1: F401 'os' imported but unused", finding)

    def test_shell_with_and_without_a_suffix(self):
        self.write("b.sh", "#!/bin/sh\nrm $1\n")
        self.write("run", "#!/bin/sh\nrm $1\n")
        first, second = check_lint.check(self.root)
        self.assertIn("b.sh:2:4: note: Double quote", first)
        self.assertIn("run:2:4: note: Double quote", second)

    def test_yaml(self):
        self.write("c.yml", "one: 1\none: 2\n")
        self.assertTrue(any('duplication of key "one"' in finding for finding in check_lint.check(self.root)))

    def test_a_page_without_its_packages(self):
        self.write("web/package.json", "{}\n")
        self.assertEqual(check_lint.check(self.root), ["ESLint is not installed: npm ci in web/"])


if __name__ == "__main__":
    unittest.main()
