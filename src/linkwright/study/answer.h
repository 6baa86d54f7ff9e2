// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/study/result.h"

// Short answers of a result, for people and programs that do not know its kind.
namespace linkwright::study {

enum class Verdict { passed, doubtful, incomplete, failed };
constexpr std::array<EnumName<Verdict>, 4> names(Verdict) {
  return {{{Verdict::passed, "passed", "done, every check holds and nothing is marked as bad"},
           {Verdict::doubtful, "doubtful",
            "done and every check holds, but some facts or the best solution have defects"},
           {Verdict::incomplete, "incomplete", "stopped by the time limit or on request: best so far"},
           {Verdict::failed, "failed", "a check does not hold, or there is no answer (see status)"}}};
}

/// The verdict, why, and the troubles behind it.
struct Answer {
  Verdict verdict = Verdict::passed;
  std::vector<std::string> reasons;  ///< empty for `passed`
  std::optional<Trouble> first;      ///< the first in time or along the sweep
  std::optional<Trouble> worst;      ///< the one that exceeds its limit most; the longest stretch of rows
};

/// The answer of any result: from its status, checks, facts and defects; troubles are its own or, if it has
/// none, the rows of its tables that are not done.
Answer answer_of(const Result& result);

}  // namespace linkwright::study
