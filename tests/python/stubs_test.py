# SPDX-License-Identifier: BSD-3-Clause
"""What the stub of the extension promises is there, and the other way round."""

import ast
import pathlib
import unittest

import linkwright
from linkwright import _linkwright


def public(names):
    return {name for name in names if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def test_names_are_those_of_the_extension(self):
        tree = ast.parse(pathlib.Path(linkwright.__file__).with_name("_linkwright.pyi").read_text())
        named = set()
        for node in tree.body:
            if isinstance(node, ast.AnnAssign):
                named.add(node.target.id)
            elif isinstance(node, ast.FunctionDef):
                named.add(node.name)
            elif isinstance(node, ast.ClassDef):
                named.add(node.name)
                members = {m.name if isinstance(m, ast.FunctionDef) else m.target.id for m in node.body
                           if isinstance(m, (ast.FunctionDef, ast.AnnAssign))}
                self.assertEqual(public(members), public(vars(getattr(_linkwright, node.name))), node.name)
        self.assertEqual(named, public(vars(_linkwright)))

    def test_what_is_exported_has_a_docstring(self):
        for name in linkwright.__all__:
            self.assertTrue(getattr(linkwright, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
