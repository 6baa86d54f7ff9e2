// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/optimise/population_methods.h"
#include "linkwright/parallel/dexterity/synthesis.h"
#include "linkwright/parallel/studies/pi_joint.h"
#include "linkwright/study/bind.h"

// The synthesis of a robot's dimensions for a region: what its file holds, how it is read, run and reported.
namespace linkwright::parallel {

/// `[target.limits]`.
struct DexterityLimitsForm {
  double conditioning = 0, input = 0, output = 0, transmission = 0;
  std::optional<double> constraint, arm_travel, side_swing, size;
};
template <class Visitor>
void fields(Visitor&& visit, DexterityLimitsForm& l) {
  const auto index = [](std::string_view key, std::string_view summary) {
    return field::entry(key, summary).between(0, 1);
  };
  visit(index("conditioning", "minimum local conditioning index"), l.conditioning);
  visit(index("input", "least input transmission index"), l.input);
  visit(index("output", "least output transmission index"), l.output);
  visit(index("transmission",
              "least of both; default: 0.3 for goal = \"size\" without a limit of conditioning, "
              "transmission, or both input and output, else none"),
        l.transmission);
  visit(index("constraint",
              "minimum constraint index of a DELTA: how firmly its parallelograms keep the platform from "
              "turning; default 0.2; 0: only never to be lost"),
        l.constraint);
  visit(field::angle("arm_travel", "largest less least arm angle, over all legs").positive().at_most(6.3),
        l.arm_travel);
  visit(field::angle("side_swing", "of the rods out of the planes of their arms, at most")
            .positive()
            .at_most(1.5707963267948966),
        l.side_swing);
  visit(field::length("size", "arm and rod together, at most").positive().at_most(1e6), l.size);
}

/// `[target.pi_joint]`: Pi-joints that are designed with the robot.
struct PiTravelForm : PiLimitsForm {
  std::optional<Range> mounting, ratio;
  bool mirrored = false;
};
template <class Visitor>
void fields(Visitor&& visit, PiTravelForm& p) {
  visit(field::angle("mounting", "outward angle of the arm where theta is 0; default: any"), p.mounting);
  visit(field::entry("ratio", "base by arm; default: 0.05 to 0.95").between(0, 100), p.ratio);
  visit(field::entry("mirrored", "theta turns against the arm"), p.mirrored);
  fields(visit, static_cast<PiLimitsForm&>(p));
}

/// `[target]`: the region and what is wanted there.
struct RegionForm {
  RegionShape shape = RegionShape::cylinder;
  double width = 0, length = 0, height = 0;
  bool symmetric = true;
  std::vector<int> nodes{5, 61, 5}, cells{8, 12, 5};
  DexterityGoal goal = DexterityGoal::worst;
  DexterityLimitsForm limits;
  std::optional<PiTravelForm> pi_joint;
};
template <class Visitor>
void fields(Visitor&& visit, RegionForm& r) {
  visit(field::entry("shape", "of the region"), r.shape);
  visit(field::length("width", "diameter, or extent along x").not_negative().required(), r.width);
  visit(field::length("length", "extent along y of a box").not_negative(), r.length);
  visit(field::length("height", "extent away from the base").not_negative(), r.height);
  visit(field::entry("symmetric", "look only at the part that the symmetry of the robot repeats"),
        r.symmetric);
  visit(field::entry("nodes",
                     "points along radius, azimuth, depth (cylinder) or along the axes, where the "
                     "indices are looked at")
            .between(1, 10000),
        r.nodes);
  visit(field::entry("cells", "of the midpoint rule for means, likewise").between(1, 10000), r.cells);
  visit(field::entry("goal", "what is optimised"), r.goal);
  visit(field::entry("limits", "what holds everywhere in the region"), r.limits);
  visit(field::entry("pi_joint", "Pi-joints that are designed with the robot"), r.pi_joint);
}

struct RecommendedDexterity {
  DexterityOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedDexterity& r) {
  visit(field::entry("starts", "local searches at most").between(1, 1e6), r.options.starts);
  visit(field::entry("confirmations", "end when so many local searches found the same; 0 = make all")
            .between(0, 1e6),
        r.options.confirmations);
  visit(field::entry("between_nodes", "check between the nodes as well"), r.options.between_nodes);
}
constexpr Word choice_word(const RecommendedDexterity&) {
  return {"recommended", "sequential quadratic programming with exact derivatives at the worst poses"};
}

using DexterityMethod =
    optimise::MethodChoice<optimise::Constraints::feasibility_rules, RecommendedDexterity>;
struct DexterityOptimiser {
  DexterityMethod method;
};
template <class Visitor>
void fields(Visitor&& visit, DexterityOptimiser& o) {
  visit(field::entry("method", "how designs are searched"), o.method);
}

/// A synthesis as read.
struct DexterityStudy {
  DexterityTask task;
  DexterityMethod method;
  bool transmission_put_in = false;  ///< its limit: without any the smallest robot is singular
};

/// "synthesis" of "parallel.delta", "parallel.hexa" and "parallel.five_bar" for a "region".
std::vector<study::Kind> dexterity_kinds();

std::optional<DexterityStudy> read_dexterity_study(study::ObjectReader& document, RobotFamily family,
                                                   Value& canonical);
study::Result run_dexterity_study(const DexterityStudy& study, const study::Common& common,
                                  RunContext& context);

}  // namespace linkwright::parallel
