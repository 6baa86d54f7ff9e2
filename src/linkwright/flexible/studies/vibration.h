// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/flexible/studies/hub_link.h"

// Vibrations and deflection of a hub with an elastic link: what its file holds, how it is read, run and
// reported.
namespace linkwright::flexible {

/// `[vibration]`.
struct VibrationForm {
  int modes = 3;
  int divisions = 8;
  Kinematics kinematics = Kinematics::chord_consistent;
  Hub hub = Hub::driven;
};
template <class Visitor>
void fields(Visitor&& visit, VibrationForm& v) {
  visit(field::entry("modes", "from the lowest on").between(1, 20), v.modes);
  visit(field::entry("divisions", "of the link, two cells each").between(1, 200), v.divisions);
  visit(field::entry("kinematics", "how the joints of the chain move"), v.kinematics);
  visit(field::entry("hub", "whether it yields to the link"), v.hub);
}

/// `[campbell]`: frequencies over the speed of the hub.
struct CampbellForm {
  double from = 0, to = 0;
  int samples = 61;
  std::vector<double> orders;
};
template <class Visitor>
void fields(Visitor&& visit, CampbellForm& c) {
  const auto speed = [&](std::string_view key, std::string_view summary, bool required, double& value) {
    visit(field::speed_angular(key, summary).not_negative().required(required), value);
  };
  speed("from", "least speed of the hub", false, c.from);
  speed("to", "largest speed of the hub", true, c.to);
  visit(field::entry("samples", "number of speeds, both ends included").between(2, 2000), c.samples);
  visit(field::entry("orders",
                     "orders of excitation, multiples of the speed: where one meets a frequency is reported")
            .positive()
            .at_most(1e4),
        c.orders);
}

/// `[load]`: what the link carries at rest against its hub.
struct LoadForm {
  std::array<double, 2> force{};
  double couple = 0, angle = 0, speed = 0;
};
template <class Visitor>
void fields(Visitor&& visit, LoadForm& l) {
  const auto number = [&](std::string_view key, std::string_view summary, Dimension dimension, double most,
                          auto& value) {
    visit(field::of(dimension, key, summary).between(-most, most), value);
  };
  number("force", "at the tip, along the undeformed link and across it", Dimension::force, 1e12, l.force);
  number("couple", "at the tip", Dimension::torque, 1e12, l.couple);
  number("angle", "of the hub; matters under gravity", Dimension::angle, 1e4, l.angle);
  number("speed", "of the hub, steady", Dimension::speed_angular, 1e6, l.speed);
}

/// An analysis as read.
struct VibrationStudy {
  HubLinkForm mechanism;
  VibrationForm vibration;
  std::optional<CampbellForm> campbell;
  std::optional<LoadForm> load;
};

/// "analysis" of "flexible.hub_link".
study::Kind vibration_kind();
study::Result run_vibration(const VibrationStudy& study, RunContext& context);

}  // namespace linkwright::flexible
