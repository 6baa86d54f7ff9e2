// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/clearance/studies/design.h"
#include "linkwright/clearance/studies/templates.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::clearance {
namespace {

constexpr std::array<std::string_view, clearance_length_count> length_keys = {
    "ground",  "crank",   "coupler",     "rocker",     "point_distance",
    "pivot_x", "pivot_y", "point_angle", "frame_angle"};

// Bounds for a path of which nothing else is known: links up to four times its extent, pivots as far from its
// middle.
std::array<Range, clearance_length_count> bounds_of_path(const std::vector<double>& x,
                                                         const std::vector<double>& y) {
  const auto [x0, x1] = std::minmax_element(x.begin(), x.end());
  const auto [y0, y1] = std::minmax_element(y.begin(), y.end());
  const double size = std::hypot(*x1 - *x0, *y1 - *y0), far = 4 * size;
  const double mx = 0.5 * (*x0 + *x1), my = 0.5 * (*y0 + *y1);
  const Range link{0.05 * size, far};
  return {link,
          link,
          link,
          link,
          Range{0, far},
          Range{mx - far, mx + far},
          Range{my - far, my + far},
          Range{-pi, pi},
          Range{-pi, pi}};
}

// Eight ranges of two bodies; what is missing is reported.
std::array<Range, clearance_mass_count> masses_of(study::ObjectReader& table, const DesignMassesForm& form,
                                                  bool fixed) {
  constexpr std::array<std::string_view, 4> keys = {"mass_kg", "centre_u_mm", "centre_v_mm", "inertia_kg_m2"};
  std::array<Range, clearance_mass_count> out{};
  std::size_t k = 0;
  for (const auto& [body, name] : {std::pair{&form.coupler, "coupler"}, std::pair{&form.rocker, "rocker"}})
    for (std::size_t i = 0; i < 4; ++i, ++k) {
      const auto& range = body->ranges[i];
      if (!range)
        table.error("mass", fmt::format("the {} has no {}", name, keys[i]),
                    fixed ? "write a number" : "write a number, or { min = ..., max = ... }");
      else if (fixed && !range->fixed())
        table.error("mass", fmt::format("{} of the {} is a range, a reference has numbers", keys[i], name));
      else
        out[k] = *range;
    }
  return out;
}
// Nine numbers.
std::vector<double> numbers_of(study::ObjectReader& table, const DesignLengthsForm& form,
                               std::string_view why) {
  std::vector<double> out;
  for (std::size_t k = 0; k < clearance_length_count; ++k) {
    const auto& range = form.ranges[k];
    if (!range) {
      table.error("parameters", fmt::format("there is no {}", length_keys[k]), "all nine are needed");
    } else if (!range->fixed()) {
      table.error("parameters", fmt::format("{} is a range, {}", length_keys[k], why), "write a number");
    } else {
      out.push_back(range->lower);
    }
  }
  return out;
}

void read_timing(study::ObjectReader& target, const DesignTimingForm& t, const study::DisplayUnits& units,
                 ClearanceDesignStudy& s) {
  const std::size_t n = s.path.x.size();
  if (t.step && t.angles) {
    target.error("timing", "there are both step and angles", "keep one of them");
    return;
  }
  if (!t.step && !t.angles) {
    target.error("timing", "the crank angles of the points are missing",
                 "for example timing = { start_deg = 0.0, step_deg = 10.0 }, or angles_deg = [...]");
    return;
  }
  if (t.angles) {
    if (n >= 3 && t.angles->size() != n)
      target.error("timing", fmt::format("{} angles for {} points", t.angles->size(), n),
                   "give one crank angle for each point");
    s.path.crank_angles = *t.angles;
  } else {
    if (*t.step == 0 || std::abs(*t.step) > 2 * pi)
      target.error("timing", fmt::format("the step is {}, it must not be zero nor more than a turn",
                                         units.text(*t.step, Dimension::angle, 6)));
    for (std::size_t k = 0; k < n; ++k)
      s.path.crank_angles.push_back(t.start + *t.step * static_cast<double>(k));
    s.closed = std::abs(std::abs(*t.step) * static_cast<double>(n) - 2 * pi) < 1e-6;
  }
  if (t.free_within) {
    s.path.free_timing = true;
    s.path.angle_range = *t.free_within;
    for (std::size_t k = 1; k < s.path.crank_angles.size(); ++k)
      if (s.path.crank_angles[k] <= s.path.crank_angles[k - 1]) {
        target.error("timing",
                     fmt::format("the crank angle of point {} is not more than that of point {}", k + 1, k),
                     "free angles keep their order, and rise");
        break;
      }
  }
}

void read_path(study::ObjectReader& mechanism, study::ObjectReader& target, const study::Common& common,
               const DesignMechanismForm& m, const DesignTargetForm& t, ClearanceDesignStudy& s) {
  planar::read_path_points(target, common, t, s.path.x, s.path.y);
  read_timing(target, t.timing, common.units, s);
  s.path.clearance = m.clearance;
  s.path.phase = t.phase;
  s.path.branch = m.branch;
  s.path.crank_turns_fully = m.crank_rotates_fully;
  if (s.path.x.size() < 3 || s.path.y.size() != s.path.x.size()) return;
  s.path.bounds = bounds_of_path(s.path.x, s.path.y);
  for (std::size_t k = 0; k < clearance_length_count; ++k)
    if (m.parameters.ranges[k]) s.path.bounds[k] = *m.parameters.ranges[k];
  const double crank = s.path.bounds[index(ClearanceLength::crank)].lower;
  if (m.clearance > crank / 2)
    mechanism.error("clearance", fmt::format("{:.6g} mm is more than half of the shortest crank, {:.6g} mm",
                                             1e3 * m.clearance, 1e3 * crank));
  if (t.target == DesignTarget::both && t.stages == DesignStages::at_once && s.path.free_timing)
    target.error("stages", "at_once needs prescribed crank angles", "remove free_within from timing");
}

void read_masses(study::ObjectReader& document, study::ObjectReader& mechanism,
                 study::ObjectReader& drive_table, const DesignMechanismForm& m, const DesignTargetForm& t,
                 const DesignDriveForm& drive, double gravity, ClearanceDesignStudy& s) {
  s.mass.bounds = masses_of(mechanism, m.mass, false);
  s.mass.model.clearance = m.clearance;
  s.mass.model.gravity = {0, -gravity};
  s.mass.model.coupler_damping = m.damping.coupler;
  s.mass.model.rocker_damping = m.damping.rocker;
  s.mass.model.link_damping = m.damping.link;
  s.mass.model.linkage.branch = m.branch;
  s.mass.crank = {drive.start_angle, drive.speed};
  s.mass.phase = t.phase;
  s.mass.samples = t.samples;
  if (drive_table.has(field::speed_angular("speed")) && drive.speed == 0)
    drive_table.error("speed", "the crank stands still", "give the speed that it works at");
  if (t.target == DesignTarget::both) return;
  const std::vector<double> lengths =
      numbers_of(mechanism, m.parameters, "but masses are designed here, not lengths");
  if (lengths.size() != clearance_length_count || document.document().has_errors()) return;
  planar::FourBar& l = s.mass.model.linkage;
  l = {.ground = lengths[0],
       .crank = lengths[1],
       .coupler = lengths[2],
       .rocker = lengths[3],
       .coupler_u = lengths[4] * std::cos(lengths[7]),
       .coupler_v = lengths[4] * std::sin(lengths[7]),
       .pivot_x = lengths[5],
       .pivot_y = lengths[6],
       .frame_angle = lengths[8],
       .branch = m.branch};
  const double shortest = std::min({l.ground, l.crank, l.coupler, l.rocker});
  if (m.clearance > shortest / 2)
    mechanism.error("clearance", fmt::format("{:.6g} mm is more than half of the shortest link, {:.6g} mm",
                                             1e3 * m.clearance, 1e3 * shortest));
  else if (!turns_fully(s.mass.model))
    mechanism.error("parameters", "the crank does not rotate fully wherever the pin lies in its bush",
                    "ground + crank + clearance must be less than coupler + rocker, and ground - crank - "
                    "clearance more than the difference of coupler and rocker");
}

// Lengths of a reference as variables: with free timing its crank angles are those that are prescribed.
void read_reference(study::ObjectReader& table, const DesignReferenceForm& form, ClearanceDesignStudy& s) {
  ClearanceDesignValues values;
  if (s.has_path()) {
    values.lengths = numbers_of(table, form.parameters, "a reference has numbers");
    if (s.path.free_timing)
      values.lengths.insert(values.lengths.end(), s.path.crank_angles.begin(), s.path.crank_angles.end());
  }
  if (s.has_masses())
    for (const Range& r : masses_of(table, form.mass, true)) values.masses.push_back(r.lower);
  s.reference = std::move(values);
  s.reference_label = form.label;
}

const char* target_name(DesignTarget target) {
  return target == DesignTarget::lengths  ? "path_points"
         : target == DesignTarget::masses ? "phase"
                                          : "path_points_and_phase";
}

study::Kind kind_of(DesignTarget target) {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "clearance.four_bar";
  kind.target = target_name(target);
  kind.seeded = true;
  kind.summary = target == DesignTarget::lengths
                     ? "lengths of a four-bar for a path although its crank pin has clearance"
                 : target == DesignTarget::masses
                     ? "masses of a four-bar that keep its crank pin, a clearance joint, in contact"
                     : "lengths and masses of a four-bar whose crank pin has clearance, in turn or at once";
  kind.example = target == DesignTarget::lengths  ? templates::synthesis_four_bar_path_points()
                 : target == DesignTarget::masses ? templates::synthesis_four_bar_phase()
                                                  : templates::synthesis_four_bar_path_points_and_phase();
  kind.schema = [target](study::SchemaWriter& document) {
    const auto table = [&](const char* key, const char* summary, bool required, auto form) {
      if constexpr (requires { form.target; }) form.target = target;
      study::SchemaWriter writer;
      fields(writer, form);
      document.property(field::entry(key, summary).required(required), std::move(writer).finish());
    };
    table("mechanism", "the four-bar", true, DesignMechanismForm{});
    if (target != DesignTarget::lengths) {
      table("drive", "what turns the crank", true, DesignDriveForm{});
      table("environment", "weight", false, planar::Environment{});
    }
    table("target", "what is prescribed", true, DesignTargetForm{});
    table("reference", "a design that the answer is compared with", false, DesignReferenceForm{});
    table("optimiser", "how designs are searched", false, DesignOptimiser{});
  };
  kind.prepare = [target](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_clearance_design(document, common, target, prepared.canonical))
      prepared.run = [s = *std::move(s), common](RunContext& context) {
        return run_clearance_design(s, common, context);
      };
    return prepared;
  };
  return kind;
}

}  // namespace

std::optional<ClearanceDesignStudy> read_clearance_design(study::ObjectReader& document,
                                                          const study::Common& common, DesignTarget target,
                                                          Value& canonical) {
  ClearanceDesignStudy s;
  s.target = target;
  s.samples = std::max(common.output.samples, 25);
  DesignMechanismForm mechanism;
  DesignTargetForm wanted;
  DesignReferenceForm reference;
  mechanism.target = wanted.target = reference.target = target;
  DesignDriveForm drive;
  planar::Environment environment;
  DesignOptimiser optimiser;
  const auto read = [&](const char* key, bool required, auto& form) {
    auto table = document.table(field::entry(key).required(required));
    if (table) table->read(form);
    return table;
  };
  auto mechanism_table = read("mechanism", true, mechanism);
  auto target_table = read("target", true, wanted);
  std::optional<study::ObjectReader> drive_table;
  if (s.has_masses()) {
    drive_table = read("drive", true, drive);
    read("environment", false, environment);
  }
  auto reference_table = read("reference", false, reference);
  read("optimiser", false, optimiser);
  if (!mechanism_table || !target_table || (s.has_masses() && !drive_table)) return std::nullopt;
  s.stages = wanted.stages;
  s.method = optimiser.method;
  if (s.has_path()) read_path(*mechanism_table, *target_table, common, mechanism, wanted, s);
  if (s.has_masses())
    read_masses(document, *mechanism_table, *drive_table, mechanism, wanted, drive, environment.gravity, s);
  if (reference_table) read_reference(*reference_table, reference, s);
  if (document.document().has_errors()) return std::nullopt;

  if (s.has_path()) {
    for (std::size_t k = 0; k < clearance_length_count; ++k)
      mechanism.parameters.ranges[k] = s.path.bounds[k];
    wanted.points_file.reset();
    wanted.points.emplace();
    for (std::size_t k = 0; k < s.path.x.size(); ++k) wanted.points->push_back({s.path.x[k], s.path.y[k]});
  }
  canonical["mechanism"] = study::write_fields(mechanism);
  canonical["target"] = study::write_fields(wanted);
  if (s.has_masses()) {
    canonical["drive"] = study::write_fields(drive);
    canonical["environment"] = study::write_fields(environment);
  }
  if (reference_table) canonical["reference"] = study::write_fields(reference);
  canonical["optimiser"] = study::write_fields(optimiser);
  return s;
}

std::vector<study::Kind> clearance_design_kinds() {
  return {kind_of(DesignTarget::lengths), kind_of(DesignTarget::masses), kind_of(DesignTarget::both)};
}

}  // namespace linkwright::clearance
