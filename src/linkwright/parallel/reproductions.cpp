// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/reproductions.h"

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/design_synthesis.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "linkwright/parallel/pi_joint/stiffness_synthesis.h"
#include "linkwright/parallel/studies/published.h"

namespace linkwright::parallel {
namespace {

constexpr const char* source = "Milutinovic et al. 2014";
constexpr double travel = pi / 3;  // to both sides

study::Comparisons prototype_rows(const std::string&, RunContext&) {
  const PiJoint joint = pi_prototype();
  const PiDrive drive = pi_prototype_drive();
  const PiRangeValues range = range_values(joint, 0, travel);
  study::Comparisons out;
  const auto row = [&](const char* item, const char* where, double published, double ours,
                       const char* verdict, const char* note = "") {
    out.push_back({item, std::string(source) + ", " + where, published, ours, verdict, note});
  };
  row("base and coupler b, mm", "section 4.2", 68, 1e3 * base_length(joint), "reproduced");
  row("longest diagonal over +-60 deg, mm", "section 4.2", 232, 1e3 * range.greatest_diagonal,
      "not reproduced", "rounding up would explain it");
  row("shortest diagonal over +-60 deg, mm", "section 4.2", 117, 1e3 * range.min_diagonal, "not reproduced",
      "rounding up would explain it");
  row("stroke over +-60 deg, mm", "section 4.2", 115, 1e3 * range.stroke(), "reproduced");
  row("linear resolution, mm/step", "Table 1", 0.0127, 1e3 * quantum(drive), "reproduced");
  row("linear speed at 1200 1/min, mm/s", "Table 1", 50, 1e3 * rate_of(drive.screw, 1200.0 / 60 * 2 * pi),
      "reproduced", "one digit; the figures use 50 mm/s");
  row("linear speed at 4000 steps/s, mm/s", "Table 1", 50, 4000 * 1e3 * quantum(drive), "reproduced",
      "one digit; likewise");
  return out;
}

study::Comparisons acceleration_rows(const std::string&, RunContext&) {
  // The pose of the proof: theta = 25 deg at 1.3 rad/s and -4 rad/s2.
  const PiJoint joint = pi_prototype();
  const double angle = math::radians(25), rate = 1.3, by = -4;
  const double ours = diagonal_motion(joint, {angle, rate, by}).acceleration;
  const double first = jacobian(joint, angle), second = jacobian_slope(joint, angle);
  return {{"acceleration of the diagonal at 25 deg, 1.3 rad/s, -4 rad/s2, m/s2",
           "Milutinovic et al. 2014, (18)-(20)", first + second * rate, ours, "corrected",
           "as printed, (19) lacks the angular acceleration, and (20) has the angular speed where its square "
           "belongs"}};
}

study::Comparisons stiffness_rows(const std::string&, RunContext&) {
  const PiJoint joint = pi_prototype();
  const AngleRange range{-travel, travel};
  constexpr double measured = 3.5e4;
  study::Comparisons out;
  const auto row = [&](const char* item, StiffnessMean mean) {
    const auto k = diagonal_for_mean(joint, {}, range, mean, measured);
    PiBars bars;
    bars.diagonal = k.value_or(0);
    out.push_back({item, "Milutinovic et al. 2014, section 4.2", measured,
                   mean_stiffness(joint, bars, range, StiffnessMean::of_stiffness), "not reproduced",
                   k ? "a measurement: it takes a diagonal of " +
                           std::to_string(std::round(*k / 1e4) / 100).substr(0, 5) + "e6 N/m"
                     : "no diagonal gives it"});
  };
  row("mean stiffness, N m/rad: as mean of the stiffness", StiffnessMean::of_stiffness);
  row("mean stiffness, N m/rad: as mean of the compliance", StiffnessMean::of_compliance);
  row("mean stiffness, N m/rad: as value at 0", StiffnessMean::at_zero);
  return out;
}

}  // namespace

std::vector<study::Reproduction> reproductions() {
  return study::reproductions_of(published::reproductions(),
                                 {{"milutinovic-2014-prototype", prototype_rows},
                                  {"milutinovic-2014-acceleration", acceleration_rows},
                                  {"milutinovic-2014-stiffness", stiffness_rows}});
}

}  // namespace linkwright::parallel
