// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"
#include "linkwright/study/study.h"
#include "linkwright/suspension/studies/sweep.h"
#include "linkwright/suspension/studies/templates.h"
#include "linkwright/suspension/wheel/corner_columns.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_rows = 1000000;

/// The mechanism of another study, or one in this table; `key` is that of the table.
std::optional<CornerDescription> read_another(study::ObjectReader& table, std::string_view key,
                                              std::string_view what, const study::Common& common) {
  std::string file;
  const bool named = table(field::entry("file"), file);
  if (named == table.has("mechanism")) {
    table.error("file", fmt::format("{} is {}", what, named ? "given twice" : "missing"),
                fmt::format("write file = \"before.toml\", the study that holds it; or [{}.mechanism]", key));
    return std::nullopt;
  }
  if (!named) {
    std::string type;
    if (auto mechanism = table.table("mechanism")) (*mechanism)(field::entry("type"), type);
    return read_suspension(table, common, OpenPoints::none);
  }
  Diagnostics problems;
  study::Common there = common;
  const std::filesystem::path path = common.folder / file;
  there.folder = path.parent_path();
  const Value other = study::read_file(path, problems);
  std::optional<CornerDescription> out;
  if (!has_errors(problems)) {
    study::DocumentReader reader(other, file, problems);
    study::ObjectReader root = reader.root();
    out = read_suspension(root, there, OpenPoints::none);
    if (!out && !has_errors(problems)) table.error("file", fmt::format("'{}' has no wheel suspension", file));
  }
  for (const Diagnostic& d : problems)
    if (d.severity == Diagnostic::Severity::error) table.unreadable("file", study::in_file(d));
  return out;
}

/// `[baseline]`, `[other_wheel]`.
std::optional<CornerDescription> read_another(study::ObjectReader& document, const char* key,
                                              std::string_view what, const study::Common& common) {
  auto table = document.table(key);
  return table ? read_another(*table, std::string_view(key), what, common) : std::nullopt;
}

/// `[[other_design]]`.
std::vector<OtherDesign> read_other_designs(study::ObjectReader& document, const study::Common& common) {
  std::vector<OtherDesign> out;
  for (study::ObjectReader& table : document.tables("other_design")) {
    std::string name;
    table(field::entry("name").required(), name);
    if (auto description = read_another(table, std::string_view("other_design"), "the other design", common))
      out.push_back({name, *std::move(description)});
  }
  return out;
}

/// True if the tables of the study, and the data they are made from, have room in memory.
bool fits_memory(study::ObjectReader& document, const SweepStudy& s) {
  constexpr double of_anti_features = 7;
  const double columns = 3 + static_cast<double>(columns_of(s).size()) +
                         (has_springs(s.description) ? spring_columns : 0) +
                         (s.vehicle ? of_anti_features : 0) +
                         (s.packaging ? packaging_columns(*s.packaging) : 0),
               positions = static_cast<double>(s.travels.size() * s.racks.size()),
               position = sizeof(CornerPosition) + sizeof(WheelParameters) + study::table_bytes(1, columns);
  auto sweep = document.table("sweep");
  if (!study::require_memory(*sweep, "travel", positions * position * (s.baseline ? 2 : 1),
                             fmt::format("{} travels with {} racks", s.travels.size(), s.racks.size()),
                             "take fewer travels or racks, or fewer quantities"))
    return false;
  return !s.axle || fits_memory(document, *s.axle);
}

/// `[other_wheel]`, checked against the suspension.
std::optional<CornerDescription> read_other_wheel(study::ObjectReader& document, const study::Common& common,
                                                  const std::optional<CornerDescription>& one) {
  auto other = read_another(document, "other_wheel", "the other wheel", common);
  if (!other || !one) return other;
  auto table = document.table("other_wheel");
  if (other->suspension.side == one->suspension.side)
    table->error("mechanism", fmt::format("both wheels are {} ones", name_of(one->suspension.side)),
                 fmt::format("write side = \"{}\" for the other one",
                             name_of(one->suspension.side == Side::left ? Side::right : Side::left)));
  if (other->suspension.steering_linkage != one->suspension.steering_linkage)
    table->error("mechanism", "the steering linkage is another one than at the first wheel",
                 "it moves both tie rods: give the same [mechanism.steering_linkage] for both wheels");
  const auto &bar = one->springs.anti_roll_bar, &other_bar = other->springs.anti_roll_bar;
  if (bar.has_value() != other_bar.has_value())
    table->error("mechanism", "the anti-roll bar has an arm at one wheel alone",
                 "give [mechanism.anti_roll_bar] for both wheels");
  else if (one->springs.heave_spring.has_value() != other->springs.heave_spring.has_value())
    table->error("mechanism", "the heave spring has an end at one wheel alone",
                 "give [mechanism.heave_spring] for both wheels");
  else if (one->springs.heave_spring)
    table->warning("mechanism",
                   "the table sweep takes the other end of the heave spring as the mirror image of this one",
                   "[axle.opposite] takes both wheels as they are");
  if (bar && other_bar && bar->post_top != other_bar->post_top)
    table->error("mechanism", "the anti-roll bar has another shape or post than at the first wheel",
                 "it is one bar: give the same shape, and for a T bar the same axis, for both wheels");
  else if (bar && other_bar && bar->stiffness != other_bar->stiffness)
    table->error("mechanism", "the anti-roll bar has another stiffness than at the first wheel",
                 "it is one bar: give the same stiffness for both wheels");
  return other;
}

/// The result of a study whose points have no names in the list yet.
study::Result proposal(const study::ResultFile& names) {
  study::Result result;
  result.status = Status::infeasible;
  result.headline = fmt::format(
      "The suspension is not known yet: {} is not there. Check the names in the file {} of this result, save "
      "it "
      "beside the study and run it again.",
      names.name, names.name);
  result.files = {names};
  return result;
}

std::vector<Word> quantity_words() {
  return {{"carrier", "place of the wheel centre"},
          {"toe", ""},
          {"camber", "angle of the vertical with the wheel's plane, and as the front view shows it"},
          {"carrier_pitch", "turn of the carrier about the wheel's axis"},
          {"contact", "contact point of the tyre"},
          {"track", "half-track change"},
          {"wheelbase", "wheelbase change and recession"},
          {"gains", "bump steer and camber by travel"},
          {"roll_centre", "its height, both wheels travelling equally"},
          {"instant_centres", "front and side view, with swing arms"},
          {"anti_pitch", "anti-dive, anti-lift and anti-squat tangents of braking and driving"},
          {"spring", "length and motion ratio"},
          {"steering_axis", "caster, kingpin inclination, trail, scrub radius, offsets, pitch of the screw"},
          {"steering", "toe by rack"},
          {"contact_axis", "the steering axis with the height of the contact point held"},
          {"geometric_axis", "the line through both ball joints of the carrier: caster, inclination, ..."},
          {"arm_planes", "roll centre and instant centres by the planes of the arms"},
          {"screw", "pitch of the carrier's screw as it travels"}};
}

}  // namespace

std::optional<SweepStudy> read_sweep_study(study::ObjectReader& document, const study::Common& common,
                                           Value& canonical, std::optional<study::ResultFile>* proposed) {
  SweepStudy s;
  s.quantities = common.output.quantities;
  s.drawn = std::any_of(common.output.formats.begin(), common.output.formats.end(),
                        [](study::Format f) { return f != study::Format::json && f != study::Format::csv; });
  const auto description = read_suspension(document, common, OpenPoints::none, proposed);
  CornerSweep sweep;
  std::optional<std::vector<double>> travels, racks = std::vector{0.0};
  if (auto table = document.table(field::entry("sweep").required())) {
    table->read(sweep);
    const GridSweep& grid = std::get<GridSweep>(sweep.type);
    s.travel = grid.travel.coordinate;
    s.assemblies = sweep.assemblies;
    if (description)
      s.lock = sweep.steering_lock.value_or(description->suspension.spring ? Driver::spring
                                                                           : Driver::wheel_centre_z);
    if (auto travel = table->table("travel")) travels = values_of(*travel, grid.travel.values, "mm");
    if (auto rack = table->table("rack"); rack && grid.rack) racks = values_of(*rack, *grid.rack, "mm");
    if (description) {
      const Suspension& suspension = description->suspension;
      if (s.travel == Driver::spring && !suspension.spring)
        if (auto travel = table->table("travel"))
          travel->error("coordinate", "there is no spring", "add [mechanism.spring], or take wheel_centre_z");
      if (s.lock == Driver::spring && !suspension.spring)
        table->error("steering_lock", "there is no spring to hold",
                     "add [mechanism.spring], or take wheel_centre_z");
      const bool steered = std::any_of(suspension.links.begin(), suspension.links.end(),
                                       [](const CornerLink& l) { return l.moved_by_rack; });
      if (!steered && racks && (racks->size() > 1 || (*racks)[0] != 0))
        table->error("rack", "no link is moved by the rack",
                     "write moved_by = \"rack\" in the tie rod's table");
    }
    if (travels && racks && travels->size() * racks->size() > max_rows)
      table->error("travel",
                   fmt::format("{} travels with {} racks make {} rows, at most {} are allowed",
                               travels->size(), racks->size(), travels->size() * racks->size(), max_rows));
  }
  s.baseline = read_another(document, "baseline", "the baseline", common);
  s.others = read_other_designs(document, common);
  s.other_wheel = read_other_wheel(document, common, description);
  const bool ride = document(field::entry("ride"), s.ride);
  document(field::entry("vehicle"), s.vehicle);
  if (s.vehicle && s.vehicle->other_axle)
    if (auto table = document.table("vehicle"))
      complete_other_axle(*table, common, s.vehicle->axle, *s.vehicle->other_axle);
  document(field::entry("axle"), s.axle);
  document(field::entry("compliance"), s.compliance);
  document(field::entry("packaging"), s.packaging);
  document(field::entry("adjust"), s.adjust);
  document(field::entry("sensitivity"), s.sensitivity);
  document(field::entry("tolerances"), s.tolerances);
  s.lists = read_lists(document, description);
  document(field::entry("data_sheet"), s.data_sheet);
  if (s.data_sheet && s.data_sheet->title.empty()) s.data_sheet->title = common.title;
  if (description && travels && racks) {
    SweepStudy measurable = s;
    measurable.description = *description;
    measurable.quantities.clear();
    measurable.travel = measurable.lock = Driver::wheel_centre_z;  // a spring may be missing
    s.measured = read_measured(document, common, sweep_columns_at(measurable, {}, {}, RunContext()));
  }
  if (description && ride) check_ride(document, s.ride, *description);
  if (description && s.sensitivity) complete_sensitivity(document, *s.sensitivity, description->suspension);
  if (description && s.tolerances) complete_tolerances(document, *s.tolerances, description->suspension);
  if (description && s.axle) complete_axle(document, *s.axle, description->suspension);
  if (description && s.adjust) check_adjust(document, *s.adjust, description->suspension);
  if (description && s.packaging) check_packaging(document, *s.packaging, description->suspension);
  if (description && s.compliance) check_compliance(document, *s.compliance, *description);
  if (!description || !travels || !racks || document.document().has_errors()) return std::nullopt;
  s.description = *description;
  s.travels = *travels;
  s.racks = *racks;
  if (!fits_memory(document, s)) return std::nullopt;
  canonical["mechanism"] = write_suspension(s.description);
  canonical["sweep"] = study::write_fields(
      CornerSweep{GridSweep{{s.travel, listed<LengthValues>(s.travels)}, listed<LengthValues>(s.racks)},
                  s.lock, s.assemblies});
  if (s.baseline) canonical["baseline"]["mechanism"] = write_suspension(*s.baseline);
  for (const OtherDesign& other : s.others) {
    Value table;
    table["name"] = other.name;
    table["mechanism"] = write_suspension(other.description);
    if (!canonical.find("other_design")) canonical["other_design"] = Value::array();
    canonical["other_design"].push_back(std::move(table));
  }
  if (!s.measured.empty()) canonical["measured"] = write_measured(s.measured);
  if (s.other_wheel) canonical["other_wheel"]["mechanism"] = write_suspension(*s.other_wheel);
  if (ride) canonical["ride"] = study::write_fields(s.ride);
  if (s.vehicle) canonical["vehicle"] = study::write_fields(*s.vehicle);
  if (s.axle) canonical["axle"] = study::write_fields(*s.axle);
  if (s.adjust) canonical["adjust"] = study::write_fields(*s.adjust);
  if (s.packaging) canonical["packaging"] = study::write_fields(*s.packaging);
  if (s.sensitivity) canonical["sensitivity"] = study::write_fields(*s.sensitivity);
  if (s.tolerances) canonical["tolerances"] = study::write_fields(*s.tolerances);
  if (!s.lists.empty()) canonical["list"] = write_lists(s.lists);
  if (s.data_sheet) canonical["data_sheet"] = study::write_fields(*s.data_sheet);
  if (s.compliance) canonical["compliance"] = study::write_fields(*s.compliance);
  return s;
}

Value sweep_of_found(const CornerDescription& description, const Suspension& found, Driver travel,
                     std::vector<double> travels, std::vector<double> racks, Driver steering_lock) {
  for (auto* values : {&travels, &racks}) {
    constexpr double same = 1e-9;
    for (double& v : *values)
      if (std::abs(v) < same) v = 0;
    std::sort(values->begin(), values->end());
    values->erase(
        std::unique(values->begin(), values->end(), [](double a, double b) { return b - a < same; }),
        values->end());
  }
  const GridPositions grid = solve_grid(prepare_suspension(found), travel, travels, racks);
  const bool all = grid.positions.size() == travels.size() * racks.size() &&
                   std::all_of(grid.positions.begin(), grid.positions.end(),
                               [](const CornerPosition& p) { return p.status == Status::done; });
  if (!all) racks = {0};
  Value out;
  out["mechanism"]["type"] = "suspension.corner";
  Value suspension = write_suspension(description, found);
  for (Value::Member& member : suspension.as_object()) out["mechanism"][member.key] = std::move(member.value);
  out["sweep"] = study::write_fields(CornerSweep{
      GridSweep{{travel, listed<LengthValues>(std::move(travels))}, std::nullopt}, steering_lock, false});
  if (racks != std::vector<double>{0})
    out["sweep"]["rack"] = study::write_fields(listed<LengthValues>(racks));
  return out;
}

namespace {
/// The schema of the mechanism of another suspension, which may repeat its type.
Value another_mechanism() {
  Value out = study::schema_fields<CornerForm>();
  out["properties"]["type"]["const"] = "suspension.corner";
  return out;
}
}  // namespace

study::Kind sweep_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "suspension.corner";
  kind.summary =
      "wheel suspension over wheel travel and rack: toe, camber, track, roll centre, steering axis, ...";
  kind.quantities = quantity_words();
  kind.example = templates::analysis_corner();
  kind.schema = [](study::SchemaWriter& document) {
    describe_suspension(document);
    document.property(field::entry("sweep", "positions that are taken").required(),
                      study::schema_fields<CornerSweep>());
    const auto another = [&](const char* key, const char* summary) {
      study::SchemaWriter table;
      table.property(field::entry("file", "study whose mechanism it is"), Value());
      table.property(field::entry("mechanism", "the mechanism itself"), another_mechanism());
      document.property(field::entry(key, summary), std::move(table).finish());
    };
    another("baseline", "another wheel suspension to compare with");
    another("other_wheel", "the other wheel of the axle; default: the mirror image of this one");
    study::SchemaWriter other;
    other.property(field::entry("name", "of the design, for diagrams").required(), Value());
    other.property(field::entry("file", "study whose mechanism it is"), Value());
    other.property(field::entry("mechanism", "the mechanism itself"), another_mechanism());
    document.property(field::entry("other_design", "wheel suspensions whose curves are laid beside these"),
                      study::schema_array(std::move(other).finish()));
    describe_measured(document);
    document.property(field::entry("ride", "what the corner carries: natural frequency, damping ratio"),
                      study::schema_fields<RideForm>());
    document.property(field::entry("vehicle", "what the axle is part of: anti-dive, Ackermann"),
                      study::schema_fields<VehicleForm>());
    document.property(field::entry("axle", "both wheels: roll, single and opposite travel, steering"),
                      study::schema_fields<AxleForm>());
    document.property(field::entry("compliance", "elastic joints and loads"),
                      study::schema_fields<ComplianceForm>());
    document.property(field::entry("adjust", "turns of adjusters that set toe, camber and caster"),
                      study::schema_fields<AdjustForm>());
    document.property(field::entry("packaging", "angles of joints and half-shafts, clearances"),
                      study::schema_fields<PackagingForm>());
    document.property(field::entry("sensitivity", "derivatives of curves by the hard points"),
                      study::schema_fields<SensitivityForm>());
    document.property(field::entry("tolerances", "bands of curves when points have tolerances"),
                      study::schema_fields<TolerancesForm>());
    describe_lists(document);
    document.property(field::entry("data_sheet", "all tables as a text with columns, data-sheet.txt"),
                      study::schema_fields<DataSheetForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    std::optional<study::ResultFile> names;
    if (auto s = read_sweep_study(document, common, prepared.canonical, &names)) {
      prepared.tables = {empty_sweep_table(*s)};
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_sweep_study(s, context); };
    } else if (names) {
      prepared.canonical["mechanism"] = Value::object();
      prepared.run = [names = *std::move(names)](RunContext&) { return proposal(names); };
    }
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::suspension
