// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/clearance/contact_analysis.h"
#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {
namespace {

// Turns below which a section says nothing, and rows below which a spectrum does.
constexpr std::size_t min_turns = 3, min_rows = 32;
constexpr int map_directions = 72;

std::string key(const ClearanceStudy& s, std::size_t pin) { return identifier(s.pin_name(pin)); }
template <class F>
std::vector<double> column(const std::vector<RecordedRow>& rows, F&& of) {
  std::vector<double> out;
  for (const RecordedRow& row : rows) out.push_back(of(row));
  return out;
}
bool only_links(const ClearanceStudy& s) { return s.model == PinModel::continuous; }

}  // namespace

Table contacts_table(const ClearanceStudy& s, const ClearanceRecording& r) {
  Table table{.name = "contacts"};
  const auto add = [&](const char* column_key, const char* label, auto&& of) {
    std::vector<double> values;
    for (const ContactEvent& e : r.events) values.push_back(of(e));
    table.add(column_key, label, std::move(values));
  };
  for (const ContactEvent& e : r.events) table.names.push_back(s.pin_name(at(e.joint)));
  add("start_s", "start (s)", [](const ContactEvent& e) { return e.start; });
  add("approach_m_per_s", "speed of approach (m/s)", [](const ContactEvent& e) { return e.approach; });
  add("angle_rad", "direction of the pin in its bush (rad)", [](const ContactEvent& e) { return e.angle; });
  add("bush_angle_rad", "the same in the frame of the bush (rad)",
      [](const ContactEvent& e) { return e.bush_angle; });
  add("end_s", "end (s)", [](const ContactEvent& e) { return e.end; });
  add("separation_m_per_s", "speed of separation (m/s)", [](const ContactEvent& e) { return e.separation; });
  add("depth_m", "largest depth (m)", [](const ContactEvent& e) { return e.depth; });
  add("force_N", "largest force (N)", [](const ContactEvent& e) { return e.force; });
  return table;
}

Table contact_map_table(const ClearanceStudy& s, const ClearanceRecording& r) {
  Table table{.name = "contact_map"};
  std::vector<double> directions;
  for (int i = 0; i <= map_directions; ++i) directions.push_back(full_turn * i / map_directions);
  const auto place = [](double angle) {
    const auto i =
        static_cast<int>(std::lround((angle / full_turn - std::floor(angle / full_turn)) * map_directions));
    return at(i % map_directions);
  };
  table.add("bush_angle_rad", "direction in the frame of the bush (rad)", directions);
  for (std::size_t k = 0; k < s.pins(); ++k) {
    std::vector<double> force(directions.size(), 0.0), depth = force, share = force;
    const auto press = [&](double angle, double newton, double metre) {
      const std::size_t i = place(angle);
      force[i] = std::max(force[i], newton);
      depth[i] = std::max(depth[i], metre);
      return i;
    };
    for (const RecordedRow& row : r.rows) {
      const PinInstant& p = row.pins[k];
      if (p.contact) share[press(p.bush_angle, p.normal, p.depth)] += 1.0 / double(r.rows.size());
    }
    // Peaks between the rows.
    for (const ContactEvent& e : r.events)
      if (at(e.joint) == k) press(e.bush_angle, e.force, e.depth);
    for (std::vector<double>* ring : {&force, &depth, &share}) ring->back() = ring->front();
    const std::string& pin = s.pin_name(k);
    // Draws them as vectors from the middle of the bush, each in its own unit.
    const auto rose = [&](const std::string& end, const char* unit, const std::string& label,
                          const std::vector<double>& of) {
      std::vector<double> x, y;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        x.push_back(of[i] * std::cos(directions[i]));
        y.push_back(of[i] * std::sin(directions[i]));
      }
      table.add(key(s, k) + end + "_x" + unit, label + " x" + (*unit ? " (N)" : ""), std::move(x));
      table.add(key(s, k) + end + "_y" + unit, label + " y" + (*unit ? " (N)" : ""), std::move(y));
    };
    rose("_force", "_N", pin + " largest force", force);
    rose("_time_share", "", pin + " time in contact", share);
    table.add(key(s, k) + "_force_N", pin + " largest force there (N)", force);
    if (!only_links(s)) table.add(key(s, k) + "_depth_m", pin + " largest depth there (m)", depth);
    table.add(key(s, k) + "_time_share", pin + " share of the rows in which it touches there", share);
  }
  return table;
}

Table spectrum_table(const ClearanceStudy& s, const ClearanceRecording& r) {
  Table table{.name = "spectrum"};
  if (r.rows.size() < min_rows) return table;
  const double interval = (r.rows.back().time - r.rows.front().time) / double(r.rows.size() - 1);
  // Whole periods have nothing that leaks; their last row is the first one again.
  const bool periodic = r.regime && r.regime->turns > 0;
  for (std::size_t k = 0; k < s.pins(); ++k) {
    std::vector<double> force = column(r.rows, [k](const RecordedRow& row) { return row.pins[k].normal; });
    if (periodic) force.pop_back();
    Spectrum spectrum = amplitude_spectrum(force, interval, !periodic);
    if (k == 0) table.add("frequency_Hz", "frequency (Hz)", std::move(spectrum.frequency));
    table.add(
        key(s, k) + "_amplitude_N",
        fmt::format("{} amplitude of the {} (N)", s.pin_name(k), only_links(s) ? "tension" : "contact force"),
        std::move(spectrum.amplitude));
  }
  return table;
}

Table section_table(const ClearanceStudy& s, const ClearanceRecording& r) {
  Table table{.name = "section"};
  if (r.sections.size() <= min_turns) return table;
  std::vector<double> turns;
  for (std::size_t i = 0; i < r.sections.size(); ++i) turns.push_back(double(i));
  table.add("turn", "turn", std::move(turns));
  for (std::size_t k = 0; k < s.pins(); ++k) {
    const auto add = [&](const char* end, std::string label, auto&& of) {
      table.add(key(s, k) + end, s.pin_name(k) + " " + std::move(label),
                column(r.sections, [&](const RecordedRow& row) { return double(of(row.pins[k])); }));
    };
    if (!only_links(s)) {
      add("_eccentricity_x_m", "eccentricity x (m)",
          [](const PinInstant& p) { return p.eccentricity.real(); });
      add("_eccentricity_y_m", "eccentricity y (m)",
          [](const PinInstant& p) { return p.eccentricity.imag(); });
      add("_eccentricity_rate_x_m_per_s", "eccentricity rate x (m/s)",
          [](const PinInstant& p) { return p.rate.real(); });
      add("_eccentricity_rate_y_m_per_s", "eccentricity rate y (m/s)",
          [](const PinInstant& p) { return p.rate.imag(); });
    } else {
      add("_link_angle_rad", "direction of the clearance link (rad)",
          [](const PinInstant& p) { return std::remainder(p.angle, full_turn); });
      add("_link_speed_rad_per_s", "speed of the clearance link (rad/s)",
          [](const PinInstant& p) { return p.angle_rate; });
    }
  }
  return table;
}

Table orbit_table(const ClearanceStudy& s, const JointOrbit& orbit) {
  Table table{.name = "orbit"};
  const auto add = [&](const char* column_key, const char* label, auto&& of) {
    std::vector<double> values;
    for (const ClearanceState& start : orbit.start) values.push_back(of(start));
    table.add(column_key, label, std::move(values));
  };
  for (std::size_t k = 0; k < s.pins(); ++k) table.names.push_back(s.pin_name(k));
  add("link_angle_rad", "direction of the clearance link at the start (rad)",
      [](const ClearanceState& c) { return math::wrap_angle(c.angle); });
  add("link_speed_rad_per_s", "its speed (rad/s)", [](const ClearanceState& c) { return c.rate; });
  if (s.plan.inputs() != 1 || !s.plan.rotary[0] || !s.drives[0].law) return table;
  const math::Motion crank = math::MotionCurve(*s.drives[0].law)(s.from);
  add("phase_rad", "phase from the drive (rad)",
      [&](const ClearanceState& c) { return math::angle_difference(c.angle, crank.value); });
  if (crank.rate != 0)
    add("phase_slope", "its slope by the angle of the drive",
        [&](const ClearanceState& c) { return c.rate / crank.rate - 1; });
  return table;
}

Table multipliers_table(const JointOrbit& orbit) {
  Table table{.name = "multipliers"};
  const auto add = [&](const char* column_key, const char* label, auto&& of) {
    std::vector<double> values;
    for (const std::complex<double>& m : orbit.multipliers) values.push_back(of(m));
    table.add(column_key, label, std::move(values));
  };
  add("real", "real part", [](const std::complex<double>& m) { return m.real(); });
  add("imaginary", "imaginary part", [](const std::complex<double>& m) { return m.imag(); });
  add("size", "absolute value: departures grow above 1",
      [](const std::complex<double>& m) { return std::abs(m); });
  return table;
}

}  // namespace linkwright::clearance
