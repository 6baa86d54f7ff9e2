# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_mirror


class CheckMirror(ScratchCase):
    def setUp(self):
        super().setUp()
        self.write("src/linkwright/core/table.h")
        self.write("src/linkwright/core/table.cpp")
        self.write("src/linkwright/core/CMakeLists.txt", "linkwright_module(core SOURCES table.cpp)\n")
        self.write("tests/core/table_test.cpp")
        self.write("tests/core/CMakeLists.txt", "linkwright_test(core SOURCES table_test.cpp)\n")

    def findings(self, no_test=()):
        return check_mirror.check(self.root, dict(no_test))

    def test_complete_unit_passes(self):
        self.assertEqual(self.findings(), [])

    def test_missing_test(self):
        (self.root / "tests/core/table_test.cpp").unlink()
        self.assertEqual(self.findings(), ["src/linkwright/core/table.h: has no tests/core/table_test.cpp"])
        self.assertEqual(self.findings({"core/table.h": "plain data"}), [])

    def test_stale_exception(self):
        self.assertEqual(self.findings({"core/table.h": "plain data"}),
                         ["tools/check_mirror.py: 'core/table.h' needs no exception (it has a test, or is gone)"])

    def test_unlisted_source(self):
        self.write("src/linkwright/core/value.cpp")
        self.assertEqual(self.findings(), ["src/linkwright/core/value.cpp: is not listed in "
                                           "src/linkwright/core/CMakeLists.txt, so it is not built"])

    def test_unlisted_test_even_when_a_comment_names_it(self):
        self.write("tests/core/CMakeLists.txt", "linkwright_test(core SOURCES)  # table_test.cpp\n")
        self.assertEqual(self.findings(), ["tests/core/table_test.cpp: is not listed in "
                                           "tests/core/CMakeLists.txt, so it is not built"])

    def test_folders_of_a_domain(self):
        self.write("src/linkwright/planar/CMakeLists.txt", "linkwright_module(planar SOURCES linkage/plan.cpp)\n")
        self.write("tests/planar/CMakeLists.txt", "linkwright_test(planar SOURCES linkage/plan_test.cpp)\n")
        for name in ("src/linkwright/planar/linkage/plan.h", "src/linkwright/planar/linkage/plan.cpp",
                     "tests/planar/linkage/plan_test.cpp"):
            self.write(name)
        self.assertEqual(self.findings(), [])
        self.write("src/linkwright/planar/path/plan.h")
        self.write("src/linkwright/planar/path/plan.cpp")
        self.assertEqual(self.findings(), [
            "src/linkwright/planar/path/plan.cpp: is not listed in src/linkwright/planar/CMakeLists.txt, so it is not built",
            "src/linkwright/planar/path/plan.h: has no tests/planar/path/plan_test.cpp"])

    def test_name_inside_another_name_does_not_count(self):
        self.write("src/linkwright/core/able.cpp")
        self.assertEqual(len(self.findings()), 1)

    def test_folder_without_list(self):
        self.write("src/linkwright/math/angles.cpp")
        self.assertEqual(self.findings(), ["src/linkwright/math/angles.cpp: src/linkwright/math has no CMakeLists.txt"])

    def test_public_headers_include_public_headers_only(self):
        self.write("src/linkwright/core.h", '#include "linkwright/core/table.h"\n#include "linkwright/core/gone.h"\n')
        self.write("src/linkwright/core/table.h", '#include "linkwright/core/detail/rows.h"\n')
        self.assertEqual(self.findings(), [
            "src/linkwright/core.h: includes linkwright/core/gone.h, which is gone",
            "src/linkwright/core/table.h: is public and includes linkwright/core/detail/rows.h, which no header straight under "
            "src/linkwright includes"])


if __name__ == "__main__":
    unittest.main()
