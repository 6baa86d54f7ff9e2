// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace linkwright::app {

/// A mechanism that comes with the program: what `sample = "..."` in `[mechanism]` may name.
struct Sample {
  std::string name;                     ///< "jansen_leg"
  std::string summary;                  ///< description in one line
  std::vector<std::string> mechanisms;  ///< `type` of the mechanisms that know it: "planar.linkage"
  std::string group;                    ///< in users' words: "Planar linkages"
};

/// All of them, grouped.
std::vector<Sample> samples();

}  // namespace linkwright::app
