// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/function/dwell_synthesis.h"
#include "linkwright/study/kind.h"

// Six-bars whose output rests while the crank turns on: what their file holds, how it is read, run and
// reported.
namespace linkwright::planar {

struct DwellMechanism {
  double ground = 0.1, shortest = 0.2, longest = 2.5;
};
template <class Visitor>
void fields(Visitor&& visit, DwellMechanism& m) {
  visit(field::length("ground", "length of the ground link of the four-bar, which scales all others")
            .between(1e-6, 1e6),
        m.ground);
  visit(field::entry("shortest_link_ratio", "shortest link, in ground links").between(0.01, 0.9), m.shortest);
  visit(field::entry(
            "longest_link_ratio",
            "longest link, in ground links; coordinates of coupler point and pivots stay below it, too")
            .above(1)
            .at_most(20),
        m.longest);
}

struct DwellTarget {
  double dwell = 0, swing = 0, tolerance = 0, transmission = 0.6981317007977318;
};
template <class Visitor>
void fields(Visitor&& visit, DwellTarget& t) {
  const auto angle = [&](const char* key, const char* summary, double least, double most, bool required,
                         double& value) {
    visit(field::angle(key, summary).between(least, most).required(required), value);
  };
  angle("dwell_angle", "rotation of the crank during which the output rests", 0.03490658503988659,
        5.235987755982989, true, t.dwell);
  angle("swing_angle", "of the output over the turn, at least", 0.017453292519943295, 2.6179938779914944,
        true, t.swing);
  angle("tolerance", "how far the output may depart from its middle while it rests, either way", 0,
        0.5235987755982988, true, t.tolerance);
  angle("least_transmission_angle", "between coupler and rocker, and between link and output", 0,
        1.2217304763960306, false, t.transmission);
}

struct DwellStudy {
  DwellMechanism mechanism;
  DwellTarget target;
};

/// "synthesis" of "planar.six_bar" for "dwell".
study::Kind dwell_kind();

study::Result run_dwell_study(const DwellStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::planar
