# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_format


class CheckFormat(ScratchCase):
    def test_formatted_code_passes(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("src/linkwright/core/a.cpp", "// SPDX-License-Identifier: BSD-3-Clause\nint a() { return 1; }\n")
        self.assertEqual(check_format.check(self.root), [])

    def test_names_the_file_that_is_not(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("src/linkwright/core/a.cpp", "// SPDX-License-Identifier: BSD-3-Clause\nint a()  {return 1 ;}\n")
        self.write("src/linkwright/core/b.h", "// SPDX-License-Identifier: BSD-3-Clause\nint b();\n")
        [finding] = check_format.check(self.root)
        self.assertIn("src/linkwright/core/a.cpp: is not formatted", finding)

    def test_names_the_file_without_a_licence(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("tools/a.py", "print(1)\n")
        self.write("examples/cpp/copied.cpp", "int b();\n")
        [finding] = check_format.check(self.root)
        self.assertIn("tools/a.py: add the line SPDX-License-Identifier: BSD-3-Clause", finding)


if __name__ == "__main__":
    unittest.main()
