# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_reach


class CheckReach(ScratchCase):
    def setUp(self):
        super().setUp()
        self.write("src/linkwright/planar/a.h", "/// b() is not called here.\ndouble a(int x);\ndouble b();\n")
        self.write("src/linkwright/planar/a.cpp", "double a(int x) { return x; }\ndouble b() { return 1; }\n")

    def test_a_call_reaches(self):
        self.write("src/linkwright/app/c.cpp", "double c() { return a(1) + b(); }\n")
        self.assertEqual(check_reach.check(self.root, {}), [])

    def test_a_call_beside_the_definition_reaches(self):
        self.write("src/linkwright/planar/a.cpp", "double b() { return 1; }\ndouble a(int x) {\n  return x + b();\n}\n")
        [finding] = check_reach.check(self.root, {})
        self.assertIn("nothing calls a()", finding)

    def test_comments_and_definitions_do_not(self):
        self.write("src/linkwright/app/c.cpp", "// b() is fine\ndouble c() { return a(1); }\n")
        [finding] = check_reach.check(self.root, {})
        self.assertIn("src/linkwright/planar/a.h: nothing calls b()", finding)

    def test_a_reason_excuses_until_it_is_not_needed(self):
        self.write("src/linkwright/app/c.cpp", "double c() { return a(1); }\n")
        self.assertEqual(check_reach.check(self.root, {"planar/b": "for users"}), [])
        [finding] = check_reach.check(self.root, {"planar/b": "for users", "planar/a": "for users"})
        self.assertIn("'planar/a' needs no reason", finding)


if __name__ == "__main__":
    unittest.main()
