// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/study/result.h"

namespace linkwright::test {}
namespace linkwright::report::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// A double wishbone over wheel travel and rack as a domain would give it: a spatial scene with a second
/// input, a wheel, a spring with damper, the steering axis, a force and a velocity; a table of toe and camber
/// with one row a sample, the same table of another rack height, and diagrams with groups, a band and a
/// baseline. The mechanism is computed here: frame x forward, y left, z up.
study::Result sample_spatial();

}  // namespace linkwright::report::test
