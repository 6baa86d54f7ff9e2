// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/direct/published_targets.h"
#include "tests/suspension/suspensions.h"

namespace linkwright::test {}
namespace linkwright::suspension::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// The suspension of example 5 of Poznanovic 2016 with other body points 3, 4 and 5.
inline Suspension with_points(const DirectTask& task, const Value& points) {
  Suspension out = task.suspension;
  for (std::size_t i = 0; i < 3; ++i) out.links[2 + i].body[0] = point(points.as_array()[i]);
  return out;
}

}  // namespace linkwright::suspension::test
