// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/number_lists.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"

namespace linkwright::report {

/// All that a report is made from. `result` must outlive the call.
struct ReportInput {
  const study::Result& result;
  study::DisplayUnits units = {};  ///< in which people are shown lengths, angles ...
  std::string study_toml;          ///< text of the study file; empty = not shown
  std::string title;               ///< title of the study
  std::string source;              ///< source of its numbers; may be empty
  std::string tool;                ///< "linkwright 0.1.0"
  std::string command;             ///< command line that makes this report again
  std::string result_json;  ///< text of result.json: offered as it is, and what the viewer takes the tables
                            ///< from; empty = none
  NumberLists lists =
      {};  ///< apart for pages with the program behind them, which also get handles and frames
};

/// One HTML file that needs nothing else: it loads nothing, opens from disk, prints, and without scripts
/// still shows the drawings and the tables. Text of the study is never read as markup.
///
/// Of each entry of `result.log` (one a seed) the viewer uses: `seed`; `evaluations`; `status`; the final
/// cost, which is the first number named `best`, `error` or `cost`, or else with one of these words in its
/// key
/// ("path_error_sum_sq_m2"); and the convergence, which is the first array among `history`, `convergence`,
/// `trace`: numbers, or objects with `evaluations` and a cost. Plots without a scene are placed beside them;
/// a histogram among them takes the place of the distribution over the seeds.
std::string html(const ReportInput& input);

}  // namespace linkwright::report
