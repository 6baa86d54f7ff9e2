// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/study/result.h"

namespace linkwright::test {}
namespace linkwright::report::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// A finished path synthesis as a domain would give it: two crank-rockers through the 18 points of Boskovic
/// 2018, Eq. (4.27)-(4.30), and a double rocker that assembles on part of the turn only. The mechanisms are
/// computed here.
study::Result sample_result();

/// A simulation over two seconds as a domain would give it: a slider-crank that turns once a second, with a
/// spring, a guide, a wheel, forces, velocities, a couple and a polar diagram; and a chain of 81 bars.
study::Result sample_simulation();

/// Slices of a workspace as a domain would give them: a ball of 0.4 m about (0, 0, -0.7 m) in four slices, on
/// a grid of 21 by 21 places, with a value that falls from 1 in the middle to 0 at the rim, and one slice
/// alone.
study::Result sample_maps();

/// Three cranks over each other: two ghosts, curves of each, histograms of each with few and with many
/// values.
study::Result sample_compared();

/// Diagrams that are hard to draw, over the turn of a crank: an angle that grows from 0 to 360°, seven curves
/// and nine, costs of 1e-30 from two seeds and as a column, three pairs of forces without a scene.
study::Result sample_diagrams();

/// The parts of result.json that a report reads.
std::string sample_json(const study::Result& result);

/// The study file that belongs to it.
std::string sample_study();

/// Text that breaks out of HTML, attributes, scripts and comments wherever it is not escaped.
inline constexpr const char* hostile =
    "</title></script><script>document.body.dataset.broken=1</script><!-- \"'><img src=x onerror=x>&amp; "
    "\x01";

}  // namespace linkwright::report::test
