# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_includes


class CheckIncludes(ScratchCase):
    def findings(self, text, name="src/linkwright/core/a.h"):
        self.write(name, text)
        return check_includes.check(self.root)

    def test_what_is_included_passes(self):
        self.assertEqual(self.findings("#include <string>\n#include <vector>\nstd::vector<std::string> a();\n"), [])

    def test_what_others_include_does_not_count(self):
        self.write("src/linkwright/core/b.h", "#include <vector>\n")
        self.assertEqual(self.findings('#include "linkwright/core/b.h"\nstd::vector<int> a();\n'),
                         ["src/linkwright/core/a.h: uses std::vector without #include <vector>"])

    def test_names_are_whole(self):
        for text, header in (("std::string_view a();", "string_view"), ("std::optional<int> a();", "optional"),
                             ("auto a = std::nullopt;", "optional"), ("std::string a();", "string")):
            [finding] = self.findings(f"{text}\n")
            self.assertTrue(finding.endswith(f"#include <{header}>"), finding)

    def test_a_source_may_leave_it_to_its_own_header(self):
        self.write("src/linkwright/core/a.h", "#include <span>\nint a(std::span<const int> of);\n")
        self.assertEqual(self.findings('#include "linkwright/core/a.h"\nint a(std::span<const int>) { return 1; }\n',
                                       "src/linkwright/core/a.cpp"), [])
        [finding] = self.findings('#include "linkwright/core/a.h"\nint b(std::span<const int>) { return 1; }\n',
                                  "src/linkwright/core/b.cpp")
        self.assertIn("b.cpp: uses std::span", finding)

    def test_what_is_required_is_declared(self):
        text = 'void a(int of) { LINKWRIGHT_REQUIRE(of > 0, "{}", of); }\n'
        self.assertEqual(self.findings(text), ['src/linkwright/core/a.h: uses LINKWRIGHT_REQUIRE without #include "linkwright/core/check.h"'])
        self.assertEqual(self.findings(f'#include "linkwright/core/check.h"\n{text}'), [])

    def test_comments_texts_and_other_folders_are_left_alone(self):
        self.assertEqual(self.findings('// std::vector\n/* std::span\n */ const char* a = "std::string";\n'), [])
        self.assertEqual(self.findings("std::vector<int> a();\n", "tests/core/a_test.cpp"), [])


if __name__ == "__main__":
    unittest.main()
