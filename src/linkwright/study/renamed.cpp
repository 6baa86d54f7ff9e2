// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/renamed.h"

#include <fmt/core.h>

#include <array>
#include <vector>

#include "linkwright/core/units.h"

namespace linkwright::study {
namespace {

constexpr std::string_view suspension = "suspension.", clearance = "clearance.", planar = "planar.",
                           parallel = "parallel.", four_bar = "planar.four_bar",
                           of_rows = "analysis balancing";

constexpr std::array all_renamed{
    Renamed{NameOf::kind, "regulation", "speed_fluctuation", planar},
    Renamed{NameOf::key, "regulation", "speed_fluctuation", planar},
    Renamed{NameOf::column, "regulated_speed", "speed_with_flywheel", planar},
    Renamed{NameOf::column, "_way", "_displacement"},
    Renamed{NameOf::word, "drive_torque", "drive", four_bar, of_rows},
    Renamed{NameOf::column, "drive_torque", "O1_drive_torque", four_bar, of_rows},
    Renamed{NameOf::column, "transmission_angle", "coupler_rocker_transmission_angle", four_bar, of_rows},
    Renamed{NameOf::column, "O2_x_m", "coupler_x_m", four_bar, of_rows},
    Renamed{NameOf::column, "O2_y_m", "coupler_y_m", four_bar, of_rows},
    Renamed{NameOf::column, "O3_x_m", "coupler_O3_x_m", four_bar, of_rows},
    Renamed{NameOf::column, "O3_y_m", "coupler_O3_y_m", four_bar, of_rows},
    Renamed{NameOf::column, "C_x", "coupler_C_x", four_bar, of_rows},
    Renamed{NameOf::column, "C_y", "coupler_C_y", four_bar, of_rows},
    Renamed{NameOf::column, "C_speed_x", "coupler_C_speed_x", four_bar, of_rows},
    Renamed{NameOf::column, "C_speed_y", "coupler_C_speed_y", four_bar, of_rows},
    Renamed{NameOf::column, "C_acceleration_x", "coupler_C_acceleration_x", four_bar, of_rows},
    Renamed{NameOf::column, "C_acceleration_y", "coupler_C_acceleration_y", four_bar, of_rows},
    Renamed{NameOf::key, "parts", "aspects", parallel},
    Renamed{NameOf::mechanism, "suspension.wheel_guide", "suspension.corner"},
    Renamed{NameOf::link, "KS", "US", suspension},
    Renamed{NameOf::word, "spin", "carrier_pitch", suspension},
    Renamed{NameOf::word, "support", "anti_pitch", suspension},
    Renamed{NameOf::word, "support_tangent", "anti_pitch_tangent", suspension},
    Renamed{NameOf::word, "support_tangent_free", "anti_pitch_tangent_free", suspension},
    Renamed{NameOf::key, "spin", "carrier_pitch", suspension},
    Renamed{NameOf::key, "largest_spin", "largest_carrier_pitch", suspension},
    Renamed{NameOf::key, "unknown_spin", "unknown_carrier_pitch", suspension},
    Renamed{NameOf::key, "spin_technique", "carrier_pitch_technique", suspension},
    Renamed{NameOf::column, "spin", "carrier_pitch", suspension},
    Renamed{NameOf::column, "deviation_spin", "deviation_carrier_pitch", suspension},
    Renamed{NameOf::column, "support_tangent", "anti_pitch_tangent", suspension},
    Renamed{NameOf::column, "support_tangent_free", "anti_pitch_tangent_free", suspension},
    Renamed{NameOf::target, "lead", "phase", clearance},
    Renamed{NameOf::target, "path_points_and_lead", "path_points_and_phase", clearance},
    Renamed{NameOf::key, "lead", "phase", clearance},
    Renamed{NameOf::column, "lead", "phase", clearance},
    Renamed{NameOf::column, "_lead", "_phase", clearance},
    Renamed{NameOf::column, "lead_min", "phase_min", clearance},
    Renamed{NameOf::column, "lead_max", "phase_max", clearance},
    Renamed{NameOf::column, "lead_slope", "phase_slope", clearance},
};

/// The words that columns of tolerances and errors add to the name of a quantity.
constexpr std::array<std::string_view, 14> what_is_said_of_it{
    "",       "_error",     "_worst",           "_across",     "_rms",         "_drawn",      "_lower",
    "_upper", "_deviation", "_drawn_deviation", "_drawn_mean", "_drawn_least", "_drawn_most", "_yield"};

/// "spin" and "_deg" of "spin_deg".
std::pair<std::string_view, std::string_view> base_and_unit(std::string_view key) {
  const auto parts = split_unit(key);
  if (!parts) return {key, {}};
  return {key.substr(0, parts->base.size()), key.substr(parts->base.size())};
}

class Reader {
 public:
  Reader(const Value& document, const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {
    if (const Value* mechanism = document.find("mechanism"))
      if (const Value* type = mechanism->find("type"); type && type->is_string())
        mechanism_ = type->as_string();
    if (const Value* kind = document.find("kind"); kind && kind->is_string()) kind_ = kind->as_string();
  }

  void read(Value& document) {
    if (!document.is_object()) return;
    visit(document, "");
  }

 private:
  const Renamed* find(NameOf of, std::string_view name) const {
    for (const Renamed& r : all_renamed)
      if (r.of == of && mechanism_.starts_with(r.mechanism) &&
          (r.kinds.empty() || (!kind_.empty() && r.kinds.find(kind_) != std::string_view::npos)) &&
          place_in(name, r) != std::string_view::npos)
        return &r;
    return nullptr;
  }
  /// Start of the old name in `name`.
  static std::size_t place_in(std::string_view name, const Renamed& r) {
    if (r.before == name) return 0;
    if (r.before.starts_with('_'))
      for (const std::string_view what : what_is_said_of_it)
        if (name.ends_with(what) && name.substr(0, name.size() - what.size()).ends_with(r.before))
          return name.size() - what.size() - r.before.size();
    return std::string_view::npos;
  }
  static std::string changed(std::string_view name, const Renamed& r) {
    const std::size_t place = place_in(name, r);
    return std::string(name.substr(0, place)) + std::string(r.now) +
           std::string(name.substr(place + r.before.size()));
  }
  void warn(const Position& at, std::string key, std::string_view before, std::string_view now) {
    diagnostics_.push_back({.severity = Diagnostic::Severity::warning,
                            .file = file_,
                            .position = at,
                            .key = std::move(key),
                            .message = fmt::format("'{}' is now called '{}'", before, now),
                            .hint = "the old name will be read until the next version"});
  }
  void text(Value& value, NameOf of, const std::string& path) {
    if (!value.is_string()) return;
    const std::string before = value.as_string();
    if (const Renamed* r = find(of, before)) replace(value, changed(before, *r), before, path);
  }
  void replace(Value& value, std::string now, const std::string& before, const std::string& path) {
    warn(value.position, path, before, now);
    const Position position = value.position;
    value = Value(std::move(now));
    value.position = position;
  }
  /// "2RS-KS": the codes of the links in a name.
  void links(Value& value, const std::string& path) {
    if (!value.is_string()) return;
    const std::string before = value.as_string();
    std::string now = before;
    for (const Renamed& r : all_renamed)
      if (r.of == NameOf::link && mechanism_.starts_with(r.mechanism))
        for (std::size_t at = 0; (at = now.find(r.before, at)) != std::string::npos; at += r.now.size())
          now.replace(at, r.before.size(), r.now);
    if (now != before) replace(value, std::move(now), before, path);
  }
  /// "sweep.spin_deg.max": columns between dots, each with a unit.
  std::optional<std::string> columns(std::string_view text) const {
    std::string out;
    bool any = false;
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t end = std::min(text.find('.', from), text.size());
      const std::string_view column = text.substr(from, end - from);
      auto [base, unit] = base_and_unit(column);
      const Renamed* r = find(NameOf::column, column);
      if (r)
        base = column, unit = {};
      else
        r = find(NameOf::column, base);
      out += (r ? changed(base, *r) : std::string(base)) + std::string(unit);
      any = any || r;
      if (end < text.size()) out += '.';
      from = end + 1;
    }
    if (!any) return std::nullopt;
    return out;
  }
  void quantity(Value& value, const std::string& path) {
    if (!value.is_string()) return;
    const std::string before = value.as_string();
    if (const Renamed* r = find(NameOf::word, before))
      return replace(value, std::string(r->now), before, path);
    if (auto now = columns(before)) replace(value, std::move(*now), before, path);
  }
  void visit(Value& table, const std::string& path) {
    for (Value::Member& member : table.as_object()) {
      const std::string at = path.empty() ? member.key : path + "." + member.key;
      if (path.empty() && member.key == "kind") text(member.value, NameOf::kind, at);
      if (member.key == "type")
        text(member.value,
             path == "mechanism" ? NameOf::mechanism
             : path == "target"  ? NameOf::target
                                 : NameOf::word,
             at);
      const bool of_link = path.find("mechanism.link[") != std::string::npos;
      if (member.key == (of_link ? "type" : "sample")) links(member.value, at);
      if (member.key == "quantity" || member.key == "parameter") quantity(member.value, at);
      if (member.key == "quantities" && member.value.is_array())
        for (Value& one : member.value.as_array()) text(one, NameOf::word, at);
      below(member.value, at);
      // Keys of [[check]].at are columns, those of other tables keys.
      const bool of_check = path.starts_with("check[") && path.ends_with(".at");
      const auto [base, unit] = base_and_unit(member.key);
      if (const Renamed* r = find(of_check ? NameOf::column : NameOf::key, base)) {
        const std::string now = changed(base, *r) + std::string(unit);
        if (table.find(now)) continue;
        warn(member.key_position, at, member.key, now);
        member.key = now;
      }
    }
  }
  void below(Value& value, const std::string& path) {
    if (value.is_object()) visit(value, path);
    if (value.is_array())
      for (std::size_t i = 0; i < value.as_array().size(); ++i)
        below(value.as_array()[i], fmt::format("{}[{}]", path, i));
  }

  std::string file_, mechanism_, kind_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::span<const Renamed> renamed() { return all_renamed; }

Value with_todays_names(Value document, const std::string& file, Diagnostics& diagnostics) {
  Reader(document, file, diagnostics).read(document);
  return document;
}

std::string todays_kind(std::string_view name) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t end = std::min(name.find('/', from), name.size());
    parts.emplace_back(name.substr(from, end - from));
    from = end + 1;
  }
  constexpr std::array of{NameOf::kind, NameOf::mechanism, NameOf::target};
  const std::string mechanism = parts.size() > 1 ? parts[1] : std::string();
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const Renamed& r : all_renamed)
      if (i < of.size() && r.of == of[i] && r.before == parts[i] && mechanism.starts_with(r.mechanism))
        parts[i] = r.now;
    out += (i ? "/" : "") + parts[i];
  }
  return out;
}

}  // namespace linkwright::study
