// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "linkwright/core/units.h"

namespace linkwright::study {
namespace {

/// Columns that say where a row is: the inputs, which come before the results computed from them.
std::vector<Trouble::Place> place_of(const Table& table, std::size_t row) {
  std::vector<Trouble::Place> out;
  if (!table.columns.empty() && row < table.columns[0].values.size())
    out.push_back({table.columns[0].key, table.columns[0].values[row]});
  return out;
}

/// The stretches of rows that are not done, a trouble each; `size` holds their lengths.
std::vector<Trouble> troubles_of(const Table& table, std::vector<std::size_t>& sizes) {
  std::vector<Trouble> out;
  for (std::size_t row = 0; row < table.status.size();) {
    const std::string& status = table.status[row];
    std::size_t end = row + 1;
    while (end < table.status.size() && table.status[end] == status) ++end;
    if (status != "done") {
      Trouble trouble;
      trouble.what = status;
      trouble.where = place_of(table, row);
      trouble.why = fmt::format("{} of {} rows of '{}' are {}", end - row, table.rows(), table.name, status);
      out.push_back(std::move(trouble));
      sizes.push_back(end - row);
    }
    row = end;
  }
  return out;
}

}  // namespace

Answer answer_of(const Result& result) {
  Answer out;
  for (const Check& check : result.checks)
    if (!check.passed)
      out.reasons.push_back(check.message.empty()
                                ? fmt::format("check failed: {}{} = {:.9g} ({})", check.quantity,
                                              check.at.empty() ? "" : " at " + check.at, check.value,
                                              check.limit)
                                : fmt::format("check failed: {}: {}", check.quantity, check.message));
  const bool failed_check = !out.reasons.empty();
  for (const Fact& fact : result.facts)
    if (fact.verdict == Fact::Verdict::bad) out.reasons.push_back(to_string(fact.label + ": " + fact.text));
  if (!result.solutions.empty())
    for (const Sentence& defect : result.solutions.front().defects)
      out.reasons.push_back("defect of the best solution: " + to_string(defect));
  switch (result.status) {
    case Status::done:
    case Status::at_rest:
      out.verdict = failed_check          ? Verdict::failed
                    : out.reasons.empty() ? Verdict::passed
                                          : Verdict::doubtful;
      break;
    case Status::deadline:
    case Status::cancelled:
      out.verdict = failed_check ? Verdict::failed : Verdict::incomplete;
      out.reasons.push_back(result.status == Status::deadline ? "the time limit was reached"
                                                              : "the run was stopped");
      break;
    default:
      out.verdict = Verdict::failed;
      out.reasons.insert(out.reasons.begin(), result.headline.empty() ? std::string(to_string(result.status))
                                                                      : to_string(result.headline));
  }
  if (!result.troubles.empty()) {
    out.first = result.troubles.front();
    out.worst = *std::max_element(result.troubles.begin(), result.troubles.end(),
                                  [](const Trouble& a, const Trouble& b) {
                                    // Answers that cannot be compared come before those that can.
                                    return std::isnan(a.share) ? !std::isnan(b.share) : a.share < b.share;
                                  });
    return out;
  }
  for (const Table& table : result.tables) {
    std::vector<std::size_t> sizes;
    const std::vector<Trouble> troubles = troubles_of(table, sizes);
    if (troubles.empty()) continue;
    out.first = troubles.front();
    out.worst =
        troubles[static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin())];
    break;
  }
  return out;
}

}  // namespace linkwright::study
