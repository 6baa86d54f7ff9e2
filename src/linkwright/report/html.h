#pragma once

#include <string>

#include "linkwright/study/result.h"

namespace linkwright::report {

/// All that a report is made from. `result` must outlive the call.
struct ReportInput {
  const study::Result& result;
  std::string study_toml;   ///< text of the study file; empty = not shown
  std::string title;        ///< of the study
  std::string source;       ///< where its numbers come from; may be empty
  std::string tool;         ///< "linkwright 0.1.0"
  std::string command;      ///< command line that makes this report again
  std::string result_json;  ///< text of result.json: offered as it is, and what the viewer takes the tables
                            ///< from; empty = none
};

/// One HTML file that needs nothing else: it loads nothing, opens from disk, prints, and without scripts
/// still shows the drawings and the tables. Text of the study is never read as markup.
///
/// Of each entry of `result.log` (one a seed) the viewer uses: `seed`; `evaluations`; `status`; the final
/// cost, which is the first number among `best`, `error`, `cost`, or whose key starts with one of these
/// words; and the convergence, which is the first array among `history`, `convergence`, `trace`: numbers, or
/// objects with `evaluations` and one of the cost keys.
std::string html(const ReportInput& input);

}  // namespace linkwright::report
