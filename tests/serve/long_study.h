// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "linkwright/app/examples.h"

namespace linkwright::serve::test {

inline std::string example(std::string_view name) {
  return std::string(app::find_examples(name).front()->text);
}

/// A study that runs for a quarter of an hour if nobody ends it.
inline std::string long_study() {
  std::string text = example("fourbar-18-points");
  const std::string_view seeds = "count = 20 ";
  return text.replace(text.find(seeds), seeds.size(), "count = 100000 ");
}

}  // namespace linkwright::serve::test
