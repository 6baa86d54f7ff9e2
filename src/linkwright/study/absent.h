// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace linkwright::study {

/// A key, or one of its words, that a study of a related kind has and this kind has not.
struct Absent {
  std::string_view key;     ///< key with its tables and without unit: "target.gates", "constraint.type"
  std::string_view word;    ///< the word of that key that is not here; empty = the key itself
  std::string_view reason;  ///< says why it is absent, and what comes nearest
};

}  // namespace linkwright::study
