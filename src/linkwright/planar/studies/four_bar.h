#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/reactions.h"
#include "linkwright/planar/linkage/branch.h"
#include "linkwright/study/kind.h"

// The analysis of a four-bar over a sweep of its crank: what its file holds (field lists), how it is read,
// run and reported.
namespace linkwright::planar {

/// `[mechanism]` of the analysis: one linkage in numbers.
struct ReactionsMechanism {
  FourBar linkage;
  std::optional<FourBarMasses> masses;
};
template <class Visitor>
void fields(Visitor&& visit, ReactionsMechanism& m) {
  visit(Field{.key = "branch", .summary = "assembly branch"}, m.linkage.branch);
  visit(Field{.key = "parameters", .summary = "the linkage in numbers", .required = true}, m.linkage);
  visit(Field{.key = "mass", .summary = "masses of the links; only forces and torques need them"}, m.masses);
}

/// The link that a motor turns.
enum class DriveInput { crank };
constexpr std::array<EnumName<DriveInput>, 1> names(DriveInput) {
  return {{{DriveInput::crank, "crank", "the crank O1-O2"}}};
}
struct Drive {
  DriveInput input = DriveInput::crank;
  double speed = 0;         ///< rad/s
  double acceleration = 0;  ///< rad/s2
};
template <class Visitor>
void fields(Visitor&& visit, Drive& d) {
  visit(Field{.key = "input", .summary = "link that is driven"}, d.input);
  visit(Field{.key = "speed",
              .summary = "speed of the input at every position, counter-clockwise positive",
              .dimension = Dimension::speed_angular,
              .minimum = -1e6,
              .maximum = 1e6,
              .required = true},
        d.speed);
  visit(Field{.key = "acceleration",
              .summary = "acceleration of the input at every position",
              .dimension = Dimension::acceleration_angular,
              .minimum = -1e9,
              .maximum = 1e9},
        d.acceleration);
}

struct Environment {
  double gravity = 9.81;  ///< m/s2, along -y
};
template <class Visitor>
void fields(Visitor&& visit, Environment& e) {
  visit(Field{.key = "gravity",
              .summary = "along -y of the global frame",
              .dimension = Dimension::acceleration,
              .minimum = 0,
              .maximum = 1e6},
        e.gravity);
}

/// Evenly spaced crank angles from `from` to `to`, ends included.
struct CrankSamples {
  double from = 0;  ///< rad, from the ground link
  double to = 0;    ///< rad
  int samples = 0;
};
template <class Visitor>
void fields(Visitor&& visit, CrankSamples& s) {
  visit(Field{.key = "from",
              .summary = "first crank angle, from the ground link",
              .dimension = Dimension::angle,
              .minimum = -1e3,
              .maximum = 1e3,
              .required = true},
        s.from);
  visit(Field{.key = "to",
              .summary = "last crank angle",
              .dimension = Dimension::angle,
              .minimum = -1e3,
              .maximum = 1e3,
              .required = true},
        s.to);
  visit(Field{.key = "samples",
              .summary = "number of crank angles, both ends included",
              .minimum = 2,
              .maximum = 100000,
              .required = true},
        s.samples);
}
struct CrankGrid {
  CrankSamples crank_angle;
};
template <class Visitor>
void fields(Visitor&& visit, CrankGrid& g) {
  visit(Field{.key = "crank_angle", .summary = "crank angles of the rows", .required = true}, g.crank_angle);
}
constexpr Word choice_word(const CrankGrid&) { return {"grid", "evenly spaced samples"}; }
struct CrankSweep {
  std::variant<CrankGrid> type;
  AtChangePoint at_change_point = AtChangePoint::smooth;
};
template <class Visitor>
void fields(Visitor&& visit, CrankSweep& s) {
  visit(Field{.key = "type", .summary = "how samples are placed"}, s.type);
  visit(Field{.key = "at_change_point", .summary = "how the linkage goes on where its branches meet"},
        s.at_change_point);
}

/// What the table holds.
struct ReactionsQuantities {
  bool position = true, rates = true, reactions = true, drive_torque = true, shaking = true,
       transmission_angle = true;
  /// Whether masses are needed.
  bool dynamic() const { return reactions || drive_torque || shaking; }
};

/// An analysis as read.
struct ReactionsStudy {
  ReactionsMechanism mechanism;
  Drive drive;
  Environment environment;
  CrankSweep sweep;
  ReactionsQuantities quantities;
  study::DisplayUnits units;  ///< of its messages
};

/// "analysis" of "planar.four_bar".
study::Kind reactions_kind();

/// Reads the tables of the study; problems go to the reader.
ReactionsStudy read_reactions_study(study::ObjectReader& document, const study::Common& common);

/// The table of the study alone.
Table reactions_table(const ReactionsStudy& study);

/// Evaluates every row and reports. Rows that do not assemble, or stand at a dead point, hold what is known
/// of them and their status; the status of the result is then the first of these. Rows at change points hold
/// the limits from both sides and make no difference to it.
study::Result run_reactions_study(const ReactionsStudy& study, RunContext& context);

}  // namespace linkwright::planar
