#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/optimise/population_methods.h"
#include "linkwright/parallel/dexterity/synthesis.h"
#include "linkwright/parallel/studies/pi_joint.h"

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
    return Field{.key = key, .summary = summary, .minimum = 0, .maximum = 1};
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
  visit(Field{.key = "arm_travel",
              .summary = "largest less least arm angle, over all legs",
              .dimension = Dimension::angle,
              .minimum = 0,
              .maximum = 6.3,
              .exclusive_minimum = true},
        l.arm_travel);
  visit(Field{.key = "side_swing",
              .summary = "of the rods out of the planes of their arms, at most",
              .dimension = Dimension::angle,
              .minimum = 0,
              .maximum = 1.5707963267948966,
              .exclusive_minimum = true},
        l.side_swing);
  visit(Field{.key = "size",
              .summary = "arm and rod together, at most",
              .dimension = Dimension::length,
              .minimum = 0,
              .maximum = 1e6,
              .exclusive_minimum = true},
        l.size);
}

/// `[target.pi_joint]`: Pi-joints that are designed with the robot.
struct PiTravelForm : PiLimitsForm {
  std::optional<Range> mounting, ratio;
  bool mirrored = false;
};
template <class Visitor>
void fields(Visitor&& visit, PiTravelForm& p) {
  visit(robot_fields::angle("mounting", "outward angle of the arm where theta is 0; default: any"),
        p.mounting);
  visit(Field{.key = "ratio", .summary = "base by arm; default: 0.05 to 0.95", .minimum = 0, .maximum = 100},
        p.ratio);
  visit(Field{.key = "mirrored", .summary = "theta turns against the arm"}, p.mirrored);
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
  visit(Field{.key = "shape", .summary = "of the region"}, r.shape);
  visit(robot_fields::length("width", "diameter, or extent along x"), r.width);
  visit(robot_fields::length("length", "extent along y of a box", false), r.length);
  visit(robot_fields::length("height", "extent away from the base", false), r.height);
  visit(Field{.key = "symmetric", .summary = "look only at the part that the symmetry of the robot repeats"},
        r.symmetric);
  visit(Field{.key = "nodes",
              .summary = "points along radius, azimuth, depth (cylinder) or along the axes, where the "
                         "indices are looked at",
              .minimum = 1,
              .maximum = 10000},
        r.nodes);
  visit(Field{.key = "cells",
              .summary = "of the midpoint rule for means, likewise",
              .minimum = 1,
              .maximum = 10000},
        r.cells);
  visit(Field{.key = "goal", .summary = "what is optimised"}, r.goal);
  visit(Field{.key = "limits", .summary = "what holds everywhere in the region"}, r.limits);
  visit(Field{.key = "pi_joint", .summary = "Pi-joints that are designed with the robot"}, r.pi_joint);
}

struct RecommendedDexterity {
  DexterityOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedDexterity& r) {
  visit(Field{.key = "starts", .summary = "local searches at most", .minimum = 1, .maximum = 1e6},
        r.options.starts);
  visit(Field{.key = "confirmations",
              .summary = "end when so many local searches found the same; 0 = make all",
              .minimum = 0,
              .maximum = 1e6},
        r.options.confirmations);
  visit(Field{.key = "between_nodes", .summary = "check between the nodes as well"}, r.options.between_nodes);
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
  visit(Field{.key = "method", .summary = "how designs are searched"}, o.method);
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
