#pragma once

#include <functional>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/study/result.h"

namespace linkwright::study {

/// A published table that is recomputed.
struct Reproduction {
  std::string id;                  ///< "boskovic-2018-table-2.7"
  std::string title;               ///< title of the table
  std::string source;              ///< place where it is printed
  std::vector<std::string> notes;  ///< notes needed to read it: corrections, conventions
  /// Numbers with their verdicts: "reproduced", "corrected" (right once a slip of the source is fixed),
  /// "improved" (a better answer to the same question), "not reproduced".
  std::function<std::vector<Comparison>(RunContext& context)> run;
};

}  // namespace linkwright::study
