# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_reference

ENTRY = """// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup core Core
/// @namespace linkwright
/// The library.

#include "linkwright/core/table.h"
"""
HEADER = """// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace linkwright {

/// The number of rows.
/// @param columns number of columns, at least 1
/// @returns the number of rows
/// @throws ContractError if there is no column
int rows(int columns);

/// A place.
struct Place {
  double x = 0;  ///< m
};
template <class Visitor>
void fields(Visitor&& visit, Place& p) {
  visit("x", p.x);
}

enum class Side { left, right };

}  // namespace linkwright
"""


class CheckReference(ScratchCase):
    def findings(self, old="enum class Side { left, right };\n", new=""):
        self.write("src/linkwright/core.h", ENTRY)
        self.assertIn(old, HEADER)
        self.write("src/linkwright/core/table.h", HEADER.replace(old, new))
        return check_reference.check(self.root)

    def test_complete_header_passes(self):
        self.assertEqual(self.findings(), [])

    def test_missing_parameter(self):
        self.assertIn("src/linkwright/core/table.h:7: error: parameters of member linkwright::rows are not documented",
                      self.findings("/// @param columns number of columns, at least 1\n", ""))

    def test_missing_return(self):
        [finding] = [f for f in self.findings("/// @returns the number of rows\n", "") if "Side" not in f]
        self.assertIn("return type of member linkwright::rows is not documented", finding)

    def test_wrong_name_of_a_parameter(self):
        self.assertIn("argument 'rows' of command @param is not found",
                      " ".join(self.findings("@param columns", "@param rows")))

    def test_function_without_description(self):
        found = self.findings("enum class Side { left, right };\n", "int bare(int x);\n")
        self.assertEqual(len(found), 1, found)
        self.assertIn("src/linkwright/core/table.h:21: error: Member bare", found[0])

    def test_member_without_description(self):
        self.assertIn("Member x (variable) of struct linkwright::Place is not documented",
                      " ".join(self.findings("  ///< m", "")))

    def test_enumerators_without_description(self):
        self.assertIn("Side", " ".join(self.findings("", "")))

    def test_headers_that_are_not_public_do_not_count(self):
        self.write("src/linkwright/core/detail/rows.h", "int bare(int x);\n")
        self.assertEqual(self.findings(), [])

    def test_brief_description_alone_has_the_whole_name(self):
        found = self.findings("enum class Side { left, right };", "/// Columns.\nint columns(int rows);")
        self.assertIn("linkwright::columns", " ".join(found))
        self.assertNotIn("<columns>", " ".join(found))

    def test_abbreviations_end_no_sentence(self):
        self.assertEqual(check_reference.grouped("/// By Saltelli et al. (2010), Eqs. (1), (2).\n", "core"),
                         "/// By Saltelli et al.\\ (2010), Eqs.\\ (1), (2).\n")


if __name__ == "__main__":
    unittest.main()
