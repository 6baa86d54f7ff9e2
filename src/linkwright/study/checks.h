// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/value.h"
#include "linkwright/study/result.h"

namespace linkwright::study {

class ObjectReader;  // study/bind.h

/// One `[[check]]` of a study. The limits are in the unit that the quantity's name ends in.
struct CheckRequest {
  std::string quantity;           ///< see `evaluate`
  std::optional<double> at_most,  ///< upper limit
      at_least,                   ///< lower limit
      equals,                     ///< expected value
      tolerance;                  ///< allowed distance from it, >= 0
  /// Row of a table: numbers by column key, any unit of the column's dimension; { travel_mm = 50.0, rack_mm =
  /// 0.0 }.
  std::vector<std::pair<std::string, double>> at;
};
template <class Visitor>
void fields(Visitor&& visit, CheckRequest& c) {
  visit(
      field::entry("quantity", "what is checked: best.<key>, statistics.<key>, <table>.<column>.<statistic>")
          .required(),
      c.quantity);
  visit(field::entry("at_most", "upper limit"), c.at_most);
  visit(field::entry("at_least", "lower limit"), c.at_least);
  visit(field::entry("equals", "expected value"), c.equals);
  visit(field::entry("tolerance", "allowed distance from the expected value").not_negative(), c.tolerance);
}

/// Reads the row of a table that a quantity belongs to.
/// @param reader table of the study that may have the key `at`
/// @param check receives the row; unchanged if there is no key
void read_row(ObjectReader& reader, CheckRequest& check);

/// Reads `[[check]]`: each needs limits that fit together.
/// @param document the study, whose reader takes what is wrong
/// @returns the checks in their order
std::vector<CheckRequest> read_checks(ObjectReader& document);

/// @param checks checks of a study
/// @returns them as a canonical study holds them
Value write_checks(const std::vector<CheckRequest>& checks);

/// Compares a result with a check. Quantities are
///
/// - `best.KEY`: objective, parameter or classification (a number) of the first solution;
/// - `statistics.KEY`: number of the statistics;
/// - `TABLE.COLUMN` with `at`: the row whose columns have these values (to 1e-6 of the column's span);
/// - `TABLE.COLUMN.WHAT`: max, min, max_abs, mean, rms, first or last of the rows that have a value; mean and
/// rms
///   count one of the two ends of a period;
/// - `TABLE.COLUMN` of a table with one row.
///
/// Keys match in any unit of their dimension: sweep.toe_deg is found in the column toe_rad and converted.
/// @param request the check
/// @param result result of the study
/// @returns the check with its value; a quantity that cannot be found is a failed check whose message says
/// why
Check evaluate(const CheckRequest& request, const Result& result);

}  // namespace linkwright::study
