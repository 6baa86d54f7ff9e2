// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/planar/cam/programme.h"

// What is told of a programme that no cam can do.
namespace linkwright::planar {

struct FindingWords {
  std::string key, message, hint;  // the key is "segment", or empty where the whole programme is to blame
};

// The words for a finding that is an error; `rotary` is true where the follower turns.
FindingWords words_for(const ProgrammeFinding& finding, bool rotary);

}  // namespace linkwright::planar
