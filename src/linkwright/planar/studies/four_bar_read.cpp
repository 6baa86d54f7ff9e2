#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/studies/four_bar.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

// In the order of the columns.
const std::vector<Word>& quantity_words() {
  static const std::vector<Word> words = {
      {"position", "coupler and rocker angle, points O2 and O3"},
      {"rates", "speeds and accelerations of coupler and rocker"},
      {"reactions", "forces in the joints O1 to O4"},
      {"drive_torque", "torque of the motor on the crank"},
      {"shaking", "force and moments of the mechanism on the ground"},
      {"transmission_angle", "between coupler and rocker, folded to 0..90 deg"}};
  return words;
}

ReactionsQuantities chosen_four_bar_quantities(const std::vector<std::string>& listed) {
  const auto has = [&](std::string_view word) {
    return listed.empty() || std::find(listed.begin(), listed.end(), word) != listed.end();
  };
  return {.position = has("position"),
          .rates = has("rates"),
          .reactions = has("reactions"),
          .drive_torque = has("drive_torque"),
          .shaking = has("shaking"),
          .transmission_angle = has("transmission_angle")};
}

// Lengths so small or so far apart that the mechanics would leave the range of a double are no design.
void check_lengths(study::ObjectReader& mechanism, FourBar l, const study::DisplayUnits& units) {
  constexpr double least = 1e-9;
  auto parameters = mechanism.table("parameters");
  if (!parameters) return;
  fields(
      [&](const Field& field, double& length) {
        if (field.exclusive_minimum && length < least)
          parameters->error(
              field.key,
              fmt::format("is {}, a link must be at least {} long", units.text(length, Dimension::length),
                          units.text(least, Dimension::length)),
              "check the unit");
      },
      l);
}

}  // namespace

ReactionsStudy read_reactions_study(study::ObjectReader& document, const study::Common& common) {
  ReactionsStudy s;
  s.units = common.units;
  s.quantities = chosen_four_bar_quantities(common.output.quantities);
  if (auto mechanism = document.table(Field{.key = "mechanism", .summary = {}, .required = true})) {
    mechanism->read(s.mechanism);
    check_lengths(*mechanism, s.mechanism.linkage, common.units);
    if (s.quantities.dynamic() && !mechanism->has("mass"))
      mechanism->error("mass", "forces and torques need the masses of the links",
                       "add [mechanism.mass.crank], [mechanism.mass.coupler] and [mechanism.mass.rocker], or "
                       "list other quantities: output.quantities = [\"position\", \"rates\", "
                       "\"transmission_angle\"]");
  }
  if (auto drive = document.table(Field{.key = "drive", .summary = {}, .required = true}))
    drive->read(s.drive);
  if (auto environment = document.table("environment")) environment->read(s.environment);
  if (auto sweep = document.table(Field{.key = "sweep", .summary = {}, .required = true})) {
    sweep->read(s.sweep);
    const CrankSamples& angles = std::get<CrankGrid>(s.sweep.type).crank_angle;
    if (auto axis = sweep->table("crank_angle"); axis && angles.samples >= 2 && angles.from == angles.to)
      axis->error("to",
                  fmt::format("the sweep ends where it begins, at {}",
                              common.units.text(angles.to, Dimension::angle, 6)),
                  "for a full turn write from_deg = 0, to_deg = 360");
  }
  return s;
}

study::Kind reactions_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "planar.four_bar";
  kind.summary = "motion, joint reactions, drive torque and shaking force of a four-bar over its crank angle";
  kind.quantities = quantity_words();
  kind.example = templates::analysis_four_bar();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(Field{.key = "mechanism", .summary = "the four-bar", .required = true},
                      study::schema_fields<ReactionsMechanism>());
    document.property(Field{.key = "drive", .summary = "what moves it", .required = true},
                      study::schema_fields<Drive>());
    document.property(Field{.key = "environment", .summary = "what acts from outside"},
                      study::schema_fields<Environment>());
    document.property(Field{.key = "sweep", .summary = "where it is evaluated", .required = true},
                      study::schema_fields<CrankSweep>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const ReactionsStudy s = read_reactions_study(document, common);
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(s.mechanism);
    prepared.canonical["drive"] = study::write_fields(s.drive);
    prepared.canonical["environment"] = study::write_fields(s.environment);
    prepared.canonical["sweep"] = study::write_fields(s.sweep);
    prepared.run = [s](RunContext& context) { return run_reactions_study(s, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
