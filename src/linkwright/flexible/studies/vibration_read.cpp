// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <optional>

#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/studies/templates.h"
#include "linkwright/flexible/studies/vibration.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::flexible {
namespace {

std::optional<VibrationStudy> read_vibration(study::ObjectReader& document, const study::Common& common,
                                             Value& canonical) {
  VibrationStudy s;
  auto mechanism = document.table(field::entry("mechanism").required());
  auto vibration = document.table("vibration");
  auto speeds = document.table("campbell");
  auto load = document.table("load");
  if (mechanism) mechanism->read(s.mechanism);
  if (vibration) vibration->read(s.vibration);
  if (speeds) speeds->read(s.campbell.emplace());
  if (load) load->read(s.load.emplace());
  if (!mechanism || document.document().has_errors()) return std::nullopt;
  const Beam& b = s.mechanism.beam;
  if (const auto wrong = problem(b)) {
    mechanism->error("", *wrong);
    return std::nullopt;
  }
  if (s.vibration.kinematics == Kinematics::source_linearised &&
      (b.gravity > 0 || b.mass_damping > 0 || b.stiffness_damping > 0 || b.extensible || load)) {
    vibration->error("kinematics",
                     "the printed equations have neither gravity nor damping nor stretching, and no large "
                     "deflections under a load",
                     "take chord_consistent");
    return std::nullopt;
  }
  const Chain chain = discretise(b, s.vibration.divisions, s.vibration.kinematics);
  if (const int most = mode_count(chain, {.hub = s.vibration.hub}); s.vibration.modes > most) {
    (vibration ? *vibration : document)
        .error("modes",
               fmt::format("a link of {} divisions has {} modes, {} are asked for", s.vibration.divisions,
                           most, s.vibration.modes),
               "take more divisions");
    return std::nullopt;
  }
  if (s.campbell && !(s.campbell->to > s.campbell->from)) {
    speeds->error("to", fmt::format("the speeds end at {}, where they begin or before",
                                    common.units.text(s.campbell->to, Dimension::speed_angular, 6)));
    return std::nullopt;
  }
  if (s.campbell && b.extensible && s.vibration.hub == Hub::free) {
    speeds->error("to", "the frequencies of an extensible link on a free hub that turns are not known",
                  "take hub = \"driven\", or extensible = false");
    return std::nullopt;
  }
  canonical["mechanism"] = study::write_fields(s.mechanism);
  canonical["vibration"] = study::write_fields(s.vibration);
  if (s.campbell) canonical["campbell"] = study::write_fields(*s.campbell);
  if (s.load) canonical["load"] = study::write_fields(*s.load);
  return s;
}

}  // namespace

study::Kind vibration_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "flexible.hub_link";
  kind.summary =
      "hub with an elastic link and a tip mass: frequencies and mode shapes, Campbell diagram, resonant "
      "speeds, "
      "deflection under load";
  kind.example = templates::analysis_hub_link();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "hub and link").required(),
                      study::schema_fields<HubLinkForm>());
    document.property(field::entry("vibration", "what is computed of its vibrations"),
                      study::schema_fields<VibrationForm>());
    document.property(field::entry("campbell", "frequencies over the speed of the hub"),
                      study::schema_fields<CampbellForm>());
    document.property(field::entry("load", "its load at rest against the hub"),
                      study::schema_fields<LoadForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_vibration(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_vibration(s, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::flexible
