// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/parallel/pi_joint/curves.h"
#include "linkwright/parallel/pi_joint/design_synthesis.h"
#include "linkwright/parallel/pi_joint/stiffness_synthesis.h"
#include "linkwright/parallel/studies/robot.h"

// The Pi-joint by itself: its curves over the angle, and its design from what is required.
namespace linkwright::parallel {

/// `[mechanism.drive]` of a single Pi-joint.
struct ScrewForm {
  std::optional<double> lead, force_limit, rate_limit;
  double efficiency = 1;
  std::optional<MotorForm> motor;
};
template <class Visitor>
void fields(Visitor&& visit, ScrewForm& s) {
  const auto positive = [](std::string_view key, std::string_view summary, Dimension dimension,
                           bool required) {
    return field::of(dimension, key, summary).positive().at_most(1e12).required(required);
  };
  visit(positive("lead", "travel of the screw for one turn", Dimension::length, true), s.lead);
  visit(field::entry("efficiency", "when the motor drives the load").positive().at_most(1), s.efficiency);
  visit(positive("force_limit", "largest force of the screw", Dimension::force, false), s.force_limit);
  visit(positive("rate_limit", "largest rate of the diagonal", Dimension::speed, false), s.rate_limit);
  visit(field::entry("motor", "torque, speed and steps of the motor"), s.motor);
}

/// `[mechanism.stiffness]` of its bars; those that are left out are rigid.
struct BarsForm {
  std::optional<double> arm, coupler, diagonal;
  double share = 1;
};
template <class Visitor>
void fields(Visitor&& visit, BarsForm& b) {
  const auto stiffness = [](std::string_view key, std::string_view summary) {
    return field::stiffness(key, summary).positive();
  };
  visit(stiffness("arm", "along each arm"), b.arm);
  visit(stiffness("coupler", "along the coupler"), b.coupler);
  visit(stiffness("diagonal", "along the diagonal"), b.diagonal);
  visit(field::entry("share", "of the load that acts at the diagonal's end of the coupler").between(0, 1),
        b.share);
}

struct PiJointForm {
  double arm = 0, ratio = 0;
  std::optional<ScrewForm> drive;
  std::optional<BarsForm> stiffness;
};
template <class Visitor>
void fields(Visitor&& visit, PiJointForm& p) {
  visit(field::length("arm", "length of the arms").not_negative().required(), p.arm);
  visit(field::entry("ratio", "base by arm, k = b/a").positive().at_most(100).required(), p.ratio);
  visit(field::entry("drive", "screw and motor"), p.drive);
  visit(field::entry("stiffness", "of the bars"), p.stiffness);
}

/// `[load]` at the output, and gravity in axes of the joint.
struct PiLoadForm {
  double torque = 0;
  std::array<double, 2> gravity{0, -9.80665};
};
template <class Visitor>
void fields(Visitor&& visit, PiLoadForm& l) {
  visit(field::torque("torque", "that acts on the arms, positive where it increases the angle"), l.torque);
  visit(field::acceleration("gravity", "x across the base, y along it from the first pivot to the second"),
        l.gravity);
}

/// `[sweep]` over the angle.
struct PiSweepForm {
  double from = 0, to = 0;
};
template <class Visitor>
void fields(Visitor&& visit, PiSweepForm& s) {
  visit(field::angle("from", "first angle, above -90 deg").required(), s.from);
  visit(field::angle("to", "last angle, below 90 deg").required(), s.to);
}

/// `[calibration]`: stiffness that was measured at the output.
struct CalibrationForm {
  std::vector<double> angles, stiffnesses;
};
template <class Visitor>
void fields(Visitor&& visit, CalibrationForm& c) {
  visit(field::angle("angles", "where it was measured").required(), c.angles);
  visit(field::stiffness_angular("stiffnesses", "measured at each of these angles").positive().required(),
        c.stiffnesses);
}

/// An analysis as read.
struct PiAnalysis {
  PiJoint joint;
  PiEquipment equipment;
  std::vector<double> angles;
  std::optional<CalibrationForm> calibration;
};

/// The requirements on a Pi-joint over its travel; a key left out is not required.
struct PiLimitsForm {
  std::optional<double> torque, force_limit, speed, rate_limit, quantum, resolution, transmission, stroke,
      telescoping, end_margin;
};
template <class Visitor>
void fields(Visitor&& visit, PiLimitsForm& r) {
  const auto number = [](std::string_view key, std::string_view summary, Dimension dimension,
                         double most = 1e12) {
    return field::of(dimension, key, summary).positive().at_most(most);
  };
  visit(number("torque", "at the output, everywhere", Dimension::torque), r.torque);
  visit(number("force_limit", "largest force of the diagonal", Dimension::force), r.force_limit);
  visit(number("speed", "of the output", Dimension::speed_angular), r.speed);
  visit(number("rate_limit", "largest rate of the diagonal", Dimension::speed), r.rate_limit);
  visit(number("quantum", "smallest step of the diagonal", Dimension::length), r.quantum);
  visit(number("resolution", "largest turn of the output for that step", Dimension::angle), r.resolution);
  visit(number("transmission", "least angle between diagonal and arm", Dimension::angle, 1.57),
        r.transmission);
  visit(number("stroke", "largest stroke of the diagonal", Dimension::length), r.stroke);
  visit(field::entry("telescoping", "largest ratio of the longest to the shortest diagonal")
            .above(1)
            .at_most(1e6),
        r.telescoping);
  visit(number("end_margin", "between the range and +-90 deg; default 1 deg", Dimension::angle, 1.5),
        r.end_margin);
}
PiRequirements requirements_of(const PiLimitsForm& form);

/// `[target]` of a design.
struct RequirementsForm : PiLimitsForm {
  double half_travel = 0;
};
template <class Visitor>
void fields(Visitor&& visit, RequirementsForm& r) {
  visit(field::angle("half_travel", "half of the range of the angle").positive().at_most(1.5707).required(),
        r.half_travel);
  fields(visit, static_cast<PiLimitsForm&>(r));
}

/// "analysis" of "parallel.pi_joint", and "synthesis" of it from "requirements".
study::Kind pi_analysis_kind();
study::Kind pi_design_kind();

study::Result run_pi_analysis(const PiAnalysis& study, RunContext& context);
study::Result run_pi_design(const PiRequirements& requirements, const study::Seeds& seeds,
                            RunContext& context);

}  // namespace linkwright::parallel
