// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/remarks.h"

namespace linkwright::clearance {
namespace {

// Rows beyond which not every one is compared with the ideal path.
constexpr std::size_t max_compared = 20000;

// Distance of a place from a line through places, m.
double distance_from(const std::vector<std::complex<double>>& path, std::complex<double> place) {
  double least = infinity;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const math::Vec2 along = math::vec(path[i + 1] - path[i]), way = math::vec(place - path[i]);
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(along, way) / square, 0.0, 1.0) : 0;
    const math::Vec2 off = way - share * along;
    least = std::min(least, dot(off, off));
  }
  return std::isfinite(least) ? std::sqrt(least) : nan;
}

class SimulationReporter {
 public:
  SimulationReporter(const ClearanceStudy& s, ClearanceRecording recording)
      : s_(s), r_(std::move(recording)) {}

  study::Result report() {
    result_.status = r_.status;
    motion();
    ideal();
    pins();
    if (real()) add(contacts_table(s_, r_));
    if (rows() > 0) add(contact_map_table(s_, r_));
    add(spectrum_table(s_, r_));
    add(section_table(s_, r_));
    if (r_.regime && r_.regime->orbit && r_.regime->orbit->status == Status::done) {
      add(orbit_table(s_, *r_.regime->orbit));
      add(multipliers_table(*r_.regime->orbit));
    }
    if (!r_.rows.empty()) result_.scenes.push_back(clearance_scene(s_, r_));
    plots();
    add_facts(s_, r_, errors_, result_);
    return std::move(result_);
  }

 private:
  void add(Table table) {
    if (!table.columns.empty()) result_.tables.push_back(std::move(table));
  }
  bool contact() const { return s_.model != PinModel::continuous; }
  // True if there was real contact.
  bool real() const { return s_.model == PinModel::contact || r_.went_over(); }
  std::size_t rows() const { return r_.rows.size(); }
  const std::string& name(std::size_t pin) const { return s_.linkage.joints[at(s_.joint_of(pin))].name; }
  std::string key(std::size_t pin) const { return identifier(name(pin)); }
  std::string trace_key(std::size_t k) const {
    const planar::LinkageBody& b = s_.linkage.bodies[at(s_.traces[k].body)];
    return identifier(b.name) + "_" + identifier(b.points[at(s_.traces[k].point)].name);
  }
  std::string trace_name(std::size_t k) const {
    const planar::LinkageBody& b = s_.linkage.bodies[at(s_.traces[k].body)];
    return b.name + "." + b.points[at(s_.traces[k].point)].name;
  }
  template <class F>
  static std::vector<double> column(const std::vector<RecordedRow>& rows, F&& of) {
    std::vector<double> out;
    for (const RecordedRow& row : rows) out.push_back(of(row));
    return out;
  }

  // ---- tables
  // -------------------------------------------------------------------------------------------------

  void add_inputs(Table& table, const std::vector<RecordedRow>& rows) {
    const planar::Linkage& l = s_.linkage;
    table.add("time_s", "time (s)", column(rows, [](const RecordedRow& r) { return r.time; }));
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k) {
      const bool rotary = s_.plan.rotary[k];
      const std::string& joint = planar::input_joint(l, k).name;
      const char *rate = rotary ? "rad_per_s" : "m_per_s", *unit = rotary ? "rad/s" : "m/s";
      table.add(planar::input_key(l, s_.plan, k), planar::input_label(l, s_.plan, k),
                column(rows, [k](const RecordedRow& r) { return r.inputs[k].value; }));
      table.add(fmt::format("{}_joint_speed_{}", identifier(joint), rate),
                fmt::format("{} joint speed ({})", joint, unit),
                column(rows, [k](const RecordedRow& r) { return r.inputs[k].rate; }));
    }
  }
  void add_values(Table& table, const std::vector<RecordedRow>& rows) {
    for (std::size_t c = 0; c < r_.columns.size(); ++c) {
      std::vector<double> values = column(rows, [c](const RecordedRow& r) { return r.values[c]; });
      planar::unwrap(r_.columns[c], values);
      table.add(r_.columns[c].key, r_.columns[c].label, std::move(values));
    }
  }
  static void add_status(Table& table, const std::vector<RecordedRow>& rows) {
    for (const RecordedRow& row : rows) table.status.emplace_back(to_string(row.status));
  }

  void motion() {
    Table table{.name = "motion"};
    add_inputs(table, r_.rows);
    add_values(table, r_.rows);
    for (std::size_t k = 0; k < s_.traces.size(); ++k) add_path(table, k);
    const auto energy = [&](const char* key, const char* label, double RecordedRow::*of) {
      table.add(key, label, column(r_.rows, [of](const RecordedRow& r) { return r.*of; }));
    };
    energy("kinetic_energy_J", "kinetic energy (J)", &RecordedRow::kinetic);
    energy("potential_energy_J", "potential energy of weight and springs (J)", &RecordedRow::potential);
    if (contact()) {
      energy("contact_energy_J", "elastic energy of the contacts (J)", &RecordedRow::elastic);
      energy("dissipated_energy_J", "energy lost in the contacts (J)", &RecordedRow::dissipated);
    }
    energy("work_J", "work of drives and loads (J)", &RecordedRow::work);
    energy("energy_drift_J", "energy drift (J)", &RecordedRow::drift);
    add_status(table, r_.rows);
    result_.tables.push_back(std::move(table));
  }
  // Adds the point without clearance, and its distances from there and from the ideal path.
  void add_path(Table& table, std::size_t k) {
    const std::string key = trace_key(k), label = trace_name(k);
    const auto columns_of = [&](std::string_view end) {
      for (std::size_t c = 0; c < r_.columns.size(); ++c)
        if (r_.columns[c].key == key + std::string(end)) return c;
      return r_.columns.size();
    };
    const std::size_t x = columns_of("_x_m"), y = columns_of("_y_m");
    if (x == r_.columns.size() || y == r_.columns.size()) return;
    std::vector<double> ideal_x(rows(), nan), ideal_y(rows(), nan), error(rows(), nan), off(rows(), nan);
    for (std::size_t i = 0; i < rows(); ++i) {
      const std::complex<double> place{r_.rows[i].values[x], r_.rows[i].values[y]};
      if (i % (1 + rows() / max_compared) == 0) off[i] = distance_from(r_.ideal_paths[k], place);
      if (i >= r_.ideal.size()) continue;
      ideal_x[i] = r_.ideal[i].values[x], ideal_y[i] = r_.ideal[i].values[y];
      error[i] = std::abs(place - std::complex<double>(ideal_x[i], ideal_y[i]));
    }
    for (const double d : off)
      if (errors_.path.greatest(d, k)) errors_.point = trace_name(k);
    for (const double d : error) errors_.place.greatest(d, k);
    table.add(key + "_ideal_x_m", label + " x without clearance (m)", std::move(ideal_x));
    table.add(key + "_ideal_y_m", label + " y without clearance (m)", std::move(ideal_y));
    table.add(key + "_place_error_m", label + " distance from where it is without clearance (m)",
              std::move(error));
    table.add(key + "_path_error_m", label + " distance from the path without clearance (m)", std::move(off));
  }

  void ideal() {
    if (r_.ideal.empty()) return;
    Table table{.name = "ideal"};
    add_inputs(table, r_.ideal);
    add_values(table, r_.ideal);
    add_status(table, r_.ideal);
    result_.tables.push_back(std::move(table));
  }

  // True if there is a phase: the clearance link runs before a single rotary drive.
  bool has_phase() const { return s_.plan.inputs() == 1 && s_.plan.rotary[0]; }
  void add_phase(Table& table, std::size_t k) {
    std::vector<double> phase =
        column(r_.rows, [&](const RecordedRow& r) { return r.pins[k].angle - r.inputs[0].value; });
    if (!phase.empty()) {
      const double turns = phase[0] - math::wrap_angle(phase[0]);
      for (double& v : phase) v -= turns;
    }
    table.add(
        key(k) + "_phase_rad",
        fmt::format("{} clearance link before {} (rad)", name(k), planar::input_joint(s_.linkage, 0).name),
        std::move(phase));
  }
  static void unwrap_known(std::vector<double>& angles) {
    double last = nan;
    for (double& a : angles) {
      if (std::isnan(a)) continue;
      if (!std::isnan(last)) a = last + math::angle_difference(a, last);
      last = a;
    }
  }

  void pins() {
    Table table{.name = "pins"}, hodograph{.name = "hodograph"};
    table.add("time_s", "time (s)", column(r_.rows, [](const RecordedRow& r) { return r.time; }));
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      const std::string& j = name(k);
      const auto add = [&](const char* end, std::string label, auto&& of) -> Column& {
        return table.add(key(k) + end, j + " " + std::move(label),
                         column(r_.rows, [&](const RecordedRow& r) { return double(of(r.pins[k])); }));
      };
      add("_eccentricity_x_m", "eccentricity x (m)",
          [](const PinInstant& p) { return p.eccentricity.real(); });
      add("_eccentricity_y_m", "eccentricity y (m)",
          [](const PinInstant& p) { return p.eccentricity.imag(); });
      if (contact()) {
        add("_depth_m", "depth (m)", [](const PinInstant& p) { return p.depth; });
        add("_contact_N", "contact force (N)", [](const PinInstant& p) { return p.normal; });
        add("_friction_N", "friction (N)", [](const PinInstant& p) { return p.friction; });
        add("_touches", "in contact (1) or not (0)", [](const PinInstant& p) { return p.contact; });
        Column& angle = add("_contact_angle_rad", "direction of the pin in its bush where they touch (rad)",
                            [](const PinInstant& p) { return p.contact ? std::arg(p.eccentricity) : nan; });
        unwrap_known(angle.values);
      } else {
        add("_link_angle_rad", "direction of the clearance link (rad)",
            [](const PinInstant& p) { return p.angle; });
        add("_link_speed_rad_per_s", "speed of the clearance link (rad/s)",
            [](const PinInstant& p) { return p.angle_rate; });
        add("_link_acceleration_rad_per_s2", "acceleration of the clearance link (rad/s2)",
            [](const PinInstant& p) { return p.angle_acceleration; });
        add("_tension_N", "tension of the clearance link, positive in contact (N)",
            [](const PinInstant& p) { return p.normal; });
        if (has_phase()) add_phase(table, k);
      }
      // The path of the pin beside the circle that it is in.
      std::vector<double> circle_x, circle_y;
      for (std::size_t i = 0; i < rows(); ++i) {
        const double angle = 2 * pi * double(i) / double(std::max<std::size_t>(rows() - 1, 1));
        circle_x.push_back(s_.clearance_of(k) * std::cos(angle));
        circle_y.push_back(s_.clearance_of(k) * std::sin(angle));
      }
      for (const char* end : {"_eccentricity_x_m", "_eccentricity_y_m"})
        hodograph.columns.push_back(*table.find(key(k) + end));
      const std::string circle = fmt::format("{} clearance circle, {:.4g} mm", j, 1e3 * s_.clearance_of(k));
      hodograph.add(key(k) + "_clearance_x_m", circle + " x (m)", std::move(circle_x));
      hodograph.add(key(k) + "_clearance_y_m", circle + " y (m)", std::move(circle_y));
    }
    add_status(table, r_.rows);
    result_.tables.push_back(std::move(table));
    result_.tables.push_back(std::move(hodograph));
  }

  // ---- plots
  // --------------------------------------------------------------------------------------------------

  // Diagrams of a table that has rows; of another one, none.
  study::AddPlot diagrams(study::Plot like) {
    if (const Table* table = result_.table(like.table); table && table->rows() == 0) like.table.clear();
    return {result_, std::move(like)};
  }
  void plots() {
    using Style = study::Plot::Style;
    const study::AddPlot motion = diagrams({.table = "motion", .x = "time_s", .scene = "motion"}),
                         against_ideal = diagrams({.table = "motion",
                                                   .x = "time_s",
                                                   .scene = "motion",
                                                   .baseline = result_.table("ideal") ? "ideal" : ""}),
                         of_pins = diagrams({.table = "pins", .x = "time_s", .scene = "motion"}),
                         in_bushes = diagrams({.table = "hodograph", .style = Style::polar}),
                         map_of_bushes = diagrams({.table = "contact_map", .style = Style::polar});
    std::vector<std::string> paths, errors, hodograph, forces, spectrum, reactions, drives, map, times,
        angles;
    for (std::size_t k = 0; k < s_.traces.size(); ++k) {
      const std::string t = trace_key(k);
      for (const char* end : {"_x_m", "_y_m", "_ideal_x_m", "_ideal_y_m"}) paths.push_back(t + end);
      errors.push_back(t + "_path_error_m");
      errors.push_back(t + "_place_error_m");
    }
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      for (const char* end : {"_eccentricity_x_m", "_eccentricity_y_m", "_clearance_x_m", "_clearance_y_m"})
        hodograph.push_back(key(k) + end);
      forces.push_back(key(k) + (contact() ? "_contact_N" : "_tension_N"));
      spectrum.push_back(key(k) + "_amplitude_N");
      for (const char* end : {"_force_x_N", "_force_y_N"}) map.push_back(key(k) + end);
      for (const char* end : {"_time_share_x", "_time_share_y"}) times.push_back(key(k) + end);
      angles.push_back(key(k) + (contact() ? "_contact_angle_rad" : "_phase_rad"));
    }
    in_bushes("hodograph", "Paths of the pins in their bushes", hodograph);
    of_pins("contact-forces",
            contact() ? "Contact forces" : "Tension of the clearance links: contact while positive", forces);
    map_of_bushes(
        "contact-map",
        "Contact map: largest force of the pins on each place of their bushes, as seen from the bush", map);
    map_of_bushes(
        "contact-time-map",
        "Contact map: share of the time in which the pins touch each place of their bushes, as seen from "
        "the bush",
        times);
    of_pins("contact-angles",
            contact() ? "Where the pins touch: directions in their bushes" : "Phases of the clearance links",
            angles, contact() ? Style::points : Style::line);
    if (!contact()) {
      std::vector<std::string> speeds;
      for (std::size_t k = 0; k < s_.pins(); ++k) speeds.push_back(key(k) + "_link_speed_rad_per_s");
      of_pins("link-speeds", "Speeds of the clearance links", speeds);
    }
    motion("paths", "Paths of the traced points, with and without clearance", paths, Style::polar);
    motion("path-errors", "Path deviation from the ideal linkage", errors);
    for (std::size_t k = 0; k < s_.traces.size(); ++k)
      against_ideal("acceleration-" + trace_key(k),
                    "Acceleration of " + trace_name(k) + " (pale: without clearance)",
                    {trace_key(k) + "_acceleration_x_m_per_s2", trace_key(k) + "_acceleration_y_m_per_s2"});
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k)
      if (s_.plan.rotary[k])
        drives.push_back(identifier(planar::input_joint(s_.linkage, k).name) + "_drive_torque_N_m");
    for (const planar::LinkageJoint& j : s_.linkage.joints)
      if (!planar::has_teeth(j.type) && reactions.size() < 6) reactions.push_back(identifier(j.name) + "_N");
    against_ideal("torque", "Drive torque (pale: without clearance)", drives);
    against_ideal("reactions", "Joint forces (pale: without clearance)", reactions);
    diagrams({.table = "spectrum", .x = "frequency_Hz", .logarithmic_y = true})(
        "spectrum", contact() ? "Spectrum of the contact forces" : "Spectrum of the tensions", spectrum);
    for (std::size_t k = 0; k < s_.pins(); ++k)
      diagrams({.table = "section",
                .x = key(k) + (contact() ? "_eccentricity_x_m" : "_link_angle_rad"),
                .style = Style::points})(
          "section-" + key(k), "Once a turn: " + name(k),
          {key(k) + (contact() ? "_eccentricity_rate_x_m_per_s" : "_link_speed_rad_per_s")});
    motion("energies", "Energies",
           {"kinetic_energy_J", "potential_energy_J", "contact_energy_J", "dissipated_energy_J", "work_J"});
    motion("energy-audit", "Energy audit: imbalance", {"energy_drift_J"});
  }

  const ClearanceStudy& s_;
  ClearanceRecording r_;
  PathErrors errors_;
  study::Result result_;
};

}  // namespace

study::Result report_clearance(const ClearanceStudy& study, ClearanceRecording recording) {
  return SimulationReporter(study, std::move(recording)).report();
}

}  // namespace linkwright::clearance
