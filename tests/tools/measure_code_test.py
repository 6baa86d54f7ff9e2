# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import measure_code


class MeasureCode(ScratchCase):
    def test_public_headers_are_those_that_a_domain_includes(self):
        self.write("src/linkwright/planar.h", '#include "linkwright/planar/a.h"\n')
        self.write("src/linkwright/planar/a.h", '#include <cmath>\n#include "linkwright/planar/b.h"\n#include "linkwright/planar/detail/c.h"\n'
                                                "double length(double x);\ndouble length(float x);\n")
        self.write("src/linkwright/planar/b.h", "void move(int steps);\n")
        self.write("src/linkwright/planar/detail/c.h", "void hidden();\n")
        self.write("src/linkwright/planar/d.h", "void alone();\n")
        headers = measure_code.public_headers(self.root)
        self.assertEqual([header.name for header in headers], ["a.h", "b.h", "planar.h"])
        self.assertEqual({name for _, name in measure_code.public_functions(headers)}, {"length", "move"})

    def test_vectors_of_the_plane(self):
        self.write("src/linkwright/planar/a.h", "struct Vec {\n  double x = 0, y = 0;\n};\nstruct Pose {\n  double x, y;\n  double angle;\n};\n")
        self.write("src/linkwright/planar/b.cpp", "std::complex<double> z;\n")
        self.assertEqual(measure_code.plane_vectors(self.root), ["planar::Vec", "std::complex<double>"])

    def test_readers_of_prose(self):
        self.write("web/src/prose.ts", "export const units = (text) => text.replace(/mm/g, 'in');\n")
        self.write("src/linkwright/app/compare.cpp", "int main() {}\n")
        self.assertEqual(measure_code.prose_readers(self.root), ["web/src/prose.ts"])

    def test_facts(self):
        self.write("a/result.json", '{"answer": {"facts": [{"key": "length", "value": 0.0}, {"key": "order"}]}}')
        self.write("b/result.json", "{}")
        self.assertEqual(measure_code.facts(self.root), (2, 1))


if __name__ == "__main__":
    unittest.main()
