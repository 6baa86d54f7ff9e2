// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/assemblies.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/studies/corner_scene.h"
#include "linkwright/suspension/studies/sweep.h"
#include "linkwright/suspension/wheel/corner_columns.h"

namespace linkwright::suspension {
namespace {

constexpr const char* scene_name = "travel";
/// A scene is for looking at: so many samples at most.
constexpr std::size_t max_scene_samples = 2500;

/// Reports why quantities that the study asks for have no values.
void tell_missing(study::Result& result, const SweepStudy& s) {
  const study::AddWarning warn{result.diagnostics};
  std::string_view told;
  for (const CornerColumn* c : columns_of(s)) {
    if (c->group == told) continue;
    const std::string why = why_missing(s.description.suspension, *c);
    if (why.empty()) continue;
    told = c->group;
    warn("output.quantities", fmt::format("'{}' has no values: {}", c->group, why), {});
  }
}

/// The study with the travels that its grid has: fewer when it was interrupted in its first row.
SweepStudy with_travels_of(SweepStudy study, const GridPositions& solved) {
  const auto first = study.travels.begin() + static_cast<std::ptrdiff_t>(solved.first_travel);
  study.travels = {first, first + static_cast<std::ptrdiff_t>(solved.travels)};
  return study;
}

struct Grid {
  const SweepStudy& study;
  GridPositions solved;
  std::size_t racks = 0;  ///< racks that were done

  std::size_t rows() const { return racks * study.travels.size(); }
  double travel(std::size_t row) const { return study.travels[row % study.travels.size()]; }
  double rack(std::size_t row) const { return study.racks[row / study.travels.size()]; }
  CornerRow row(std::size_t i) const {
    const WheelParameters& w = solved.wheels[i];
    return {solved.positions[i], w, study.lock};
  }
};

/// The diameter at which toe is wanted as a length, as garages measure it; nothing where toe is not wanted.
std::optional<double> rim_of(const SweepStudy& s) {
  const auto columns = columns_of(s);
  const bool wanted =
      std::any_of(columns.begin(), columns.end(), [](const CornerColumn* c) { return c->key == "toe_rad"; });
  return wanted ? s.description.rim_diameter : std::nullopt;
}

double toe_at(double rim, const WheelAngles& angles) { return rim * std::sin(angles.toe); }

Table sweep_table(const Grid& grid, std::string name) {
  Table table{.name = std::move(name)};
  const std::size_t rows = grid.rows();
  const auto add = [&](std::string_view key, std::string_view label, auto&& value) {
    std::vector<double> values(rows);
    for (std::size_t i = 0; i < rows; ++i) values[i] = value(i);
    table.add(std::string(key), std::string(label), std::move(values));
  };
  add("travel_m", "travel (m)", [&](std::size_t i) { return grid.travel(i); });
  add("rack_m", "rack (m)", [&](std::size_t i) { return grid.rack(i); });
  for (const CornerColumn* c : columns_of(grid.study))
    add(c->key, c->label, [&](std::size_t i) { return value_of(*c, grid.row(i)); });
  if (const auto rim = rim_of(grid.study))
    add("toe_at_rim_m", "toe at the rim (m)", [&](std::size_t i) {
      const bool there = grid.solved.positions[i].status == Status::done;
      return there ? toe_at(*rim, grid.solved.wheels[i].angles) : WheelParameters::missing;
    });
  add("closure_residual_m", "closure residual (m)",
      [&](std::size_t i) { return grid.solved.positions[i].residual; });
  const bool complete = std::all_of(grid.solved.positions.begin(), grid.solved.positions.end(),
                                    [](const CornerPosition& p) { return p.status == Status::done; });
  if (!complete)
    for (const CornerPosition& p : grid.solved.positions) table.status.emplace_back(to_string(p.status));
  return table;
}

/// Toe and camber less those of the static position, with the rack at or next to its middle: steering would
/// hide them. Without rows when the static position is missing.
Table bump_table(const Grid& grid, std::string name) {
  Table table{.name = std::move(name)};
  const std::size_t rack = next_to_zero(grid.study.racks), count = grid.study.travels.size();
  if (rack >= grid.racks) return table;
  const std::size_t first = rack * count, still = first + next_to_zero(grid.study.travels);
  if (grid.solved.positions[still].status != Status::done) return table;
  const WheelAngles& at_rest = grid.solved.wheels[still].angles;
  const auto rim = rim_of(grid.study);
  std::vector<double> toe, camber, at_rim;
  for (std::size_t i = first; i < first + count; ++i) {
    const bool there = grid.solved.positions[i].status == Status::done;
    const WheelAngles& now = grid.solved.wheels[i].angles;
    toe.push_back(there ? now.toe - at_rest.toe : WheelParameters::missing);
    camber.push_back(there ? now.camber - at_rest.camber : WheelParameters::missing);
    if (rim) at_rim.push_back(there ? toe_at(*rim, now) - toe_at(*rim, at_rest) : WheelParameters::missing);
  }
  table.add("travel_m", "travel (m)", grid.study.travels);
  for (const CornerColumn* c : columns_of(grid.study)) {
    if (c->key == "toe_rad") table.add("toe_change_rad", "change of toe (rad)", toe);
    if (c->key == "camber_rad") table.add("camber_change_rad", "change of camber (rad)", camber);
  }
  if (rim) table.add("toe_change_at_rim_m", "change of toe at the rim (m)", at_rim);
  return table;
}

Table limits_table(const std::vector<double>& racks, const std::vector<TravelLimits>& limits) {
  Table table{.name = "limits"};
  std::vector<double> low, high;
  for (const TravelLimits& l : limits) {
    // Without a fold the wheel goes further than anyone asks.
    low.push_back(l.status[0] == Status::no_assembly ? l.value[0] : WheelParameters::missing);
    high.push_back(l.status[1] == Status::no_assembly ? l.value[1] : WheelParameters::missing);
  }
  table.add("rack_m", "rack (m)",
            {racks.begin(), racks.begin() + static_cast<std::ptrdiff_t>(limits.size())});
  table.add("lowest_travel_m", "lowest travel that the links reach (m)", low);
  table.add("highest_travel_m", "highest travel that the links reach (m)", high);
  return table;
}

/// At the position next to the reference.
void add_assemblies(study::Result& result, const SweepStudy& s, const CornerPlan& plan) {
  const CornerInput input{s.travels[next_to_zero(s.travels)], s.racks[next_to_zero(s.racks)]};
  Table table{.name = "assemblies"};
  std::array<std::vector<double>, 7> c;
  for (const Assembly& a : assemblies(plan, s.travel, input)) {
    const WheelAngles angles = wheel_angles(plan.side, plan.wheel, a.place.carrier.rotation);
    const Vec3& centre = a.place.carrier.centre;
    const std::array<double, 7> row{centre.x,
                                    centre.y,
                                    centre.z,
                                    angles.toe,
                                    angles.camber,
                                    angles.carrier_pitch,
                                    static_cast<double>(a.hits)};
    for (std::size_t i = 0; i < row.size(); ++i) c[i].push_back(row[i]);
  }
  constexpr std::array<std::pair<const char*, const char*>, 7> keys{
      {{"centre_x_m", "wheel centre x (m)"},
       {"centre_y_m", "wheel centre y (m)"},
       {"centre_z_m", "wheel centre z (m)"},
       {"toe_rad", "toe (rad)"},
       {"camber_rad", "camber (rad)"},
       {"carrier_pitch_rad", "carrier pitch (rad)"},
       {"hits", "random starts that ended here"}}};
  for (std::size_t i = 0; i < keys.size(); ++i) table.add(keys[i].first, keys[i].second, c[i]);
  result.facts.push_back({"assembly modes found", say("{}", table.rows())});
  result.tables.push_back(std::move(table));
}

void add_plots(study::Result& result, const SweepStudy& s) {
  // Diagrams follow the custom of the trade: travel upwards.
  if (s.travels.size() > 1) {
    const study::AddPlot from_static{
        result, {.table = "bump", .x = "travel_m", .scene = scene_name, .upright = true}};
    const double rack = s.racks[next_to_zero(s.racks)];
    const std::string at = s.racks.size() > 1 ? fmt::format(", rack {:.4g} mm", 1e3 * rack) : "";
    from_static("bump-steer", "Bump steer: change of toe from static" + at, {"toe_change_rad"});
    from_static("bump-steer-at-rim", "Bump steer at the rim: change of toe from static" + at,
                {"toe_change_at_rim_m"});
    from_static("bump-camber", "Change of camber from static" + at, {"camber_change_rad"});
  }
  const study::AddPlot over_travel{
      result,
      {.table = "sweep", .x = "travel_m", .scene = scene_name, .group = s.racks.size() > 1 ? "rack_m" : ""}};
  over_travel("toe", "Toe over travel", {"toe_rad"});
  over_travel("camber", "Camber over travel", {"camber_rad"});
  over_travel("track", "Half-track change over travel", {"half_track_change_m"});
  over_travel("wheelbase", "Wheelbase change over travel", {"wheelbase_change_m"});
  over_travel("roll-centre", "Roll-centre height over travel", {"roll_centre_height_m"});
  over_travel("caster", "Caster over travel", {"caster_rad"});
  over_travel("kingpin-inclination", "Kingpin inclination over travel", {"kingpin_inclination_rad"});
  over_travel("trail", "Trail over travel", {"trail_m"});
  over_travel("scrub-radius", "Scrub radius over travel", {"scrub_radius_m"});
  over_travel("motion-ratio", "Motion ratio of the spring over travel", {"motion_ratio"});
  over_travel("wheel-rate", "Wheel rate over travel",
              {"wheel_rate_N_per_m", "total_wheel_rate_N_per_m", "ride_rate_N_per_m"});
  over_travel("wheel-force", "Force of springs and stops at the wheel over travel", {"total_wheel_force_N"});
  over_travel("anti-roll-bar", "Rate of the anti-roll bar at each wheel over travel",
              {"anti_roll_bar_wheel_rate_N_per_m"});
  over_travel("carrier_pitch", "Carrier pitch over travel", {"carrier_pitch_rad"});
}

/// The same table of the other suspension, laid behind the diagrams.
void add_baseline(study::Result& result, const SweepStudy& s, RunContext& context) {
  SweepStudy other = s;
  other.description = *s.baseline;
  if (!other.description.suspension.spring) other.lock = Driver::wheel_centre_z;
  if (s.travel == Driver::spring && !other.description.suspension.spring) {
    study::AddWarning{result.diagnostics}("baseline", "it has no spring to travel by", {});
    return;
  }
  GridPositions solved =
      solve_grid(prepare_suspension(other.description.suspension), s.travel, s.travels, s.racks, &context);
  const std::size_t positions = solved.positions.size();
  if (positions < s.travels.size() * s.racks.size()) result.status = context.interruption();
  if (positions == 0) return;
  other = with_travels_of(std::move(other), solved);
  const Grid grid{other, std::move(solved), positions / other.travels.size()};
  for (const auto& [of, make] : {std::pair{"sweep", &sweep_table}, std::pair{"bump", &bump_table}}) {
    Table table = make(grid, of == std::string_view("sweep") ? "baseline" : "baseline bump");
    if (table.columns.size() < 2) continue;
    for (study::Plot& plot : result.plots)
      if (plot.table == of &&
          std::all_of(plot.y.begin(), plot.y.end(), [&](const std::string& key) { return table.find(key); }))
        plot.baseline = table.name;
    result.tables.push_back(std::move(table));
  }
}

/// Curves of other designs and of measurements beside those of the suspension.
void add_beside(study::Result& result, const SweepStudy& s, const RunContext& context) {
  if (s.others.empty() && s.measured.empty()) return;
  const double rack = s.racks[next_to_zero(s.racks)];
  std::vector<OverlaidTable> tables{{"this design", sweep_columns_at(s, s.travels, {rack}, context)}};
  std::vector<std::string> quantities;
  const auto add_quantity = [&](const std::string& key) {
    if (std::find(quantities.begin(), quantities.end(), key) == quantities.end()) quantities.push_back(key);
  };
  if (!s.others.empty())
    for (const char* key :
         {"toe_rad", "camber_rad", "half_track_change_m", "wheelbase_change_m", "roll_centre_height_m",
          "caster_rad", "kingpin_inclination_rad", "trail_m", "scrub_radius_m", "motion_ratio",
          "wheel_rate_N_per_m", "total_wheel_rate_N_per_m"})
      add_quantity(key);
  for (const OtherDesign& other : s.others) {
    SweepStudy of = s;
    of.description = other.description;
    if (!of.description.suspension.spring) {
      of.lock = Driver::wheel_centre_z;
      if (s.travel == Driver::spring) {
        study::AddWarning{result.diagnostics}("other_design",
                                              fmt::format("'{}' has no spring to travel by", other.name), {});
        continue;
      }
    }
    tables.push_back({other.name, sweep_columns_at(of, s.travels, {rack}, context)});
  }
  SweepStudy whole = s;
  whole.quantities.clear();  // whatever was measured
  for (std::size_t i = 0; i < s.measured.size(); ++i) {
    const Measurement& m = s.measured[i];
    // A rig goes up and down: each travel is solved once.
    std::vector<double> travels = m.travels;
    std::sort(travels.begin(), travels.end());
    travels.erase(std::unique(travels.begin(), travels.end()), travels.end());
    const Table solved = sweep_columns_at(whole, travels, {m.rack}, context);
    Table computed{.name = solved.name};
    for (const Column& c : solved.columns) {
      std::vector<double> values;
      for (const double travel : m.travels)
        values.push_back(c.values[static_cast<std::size_t>(
            std::lower_bound(travels.begin(), travels.end(), travel) - travels.begin())]);
      computed.add(c.key, c.label, std::move(values));
    }
    Table absolute =
        add_measured(result, m, computed, sweep_columns_at(whole, {0}, {m.rack}, context), i + 1);
    for (const MeasuredCurve& curve : m.curves) add_quantity(curve.key);
    tables.push_back({m.name, std::move(absolute)});
  }
  add_overlaid(result, tables, quantities);
}

Measured angle(double value) { return degrees_of(value).fixed(3); }
Measured angle_by_travel(double value) { return measured("deg_per_m", value).fixed(3); }
Measured length(double value) { return millimetres(value).fixed(2); }

void add_facts(study::Result& result, const SweepStudy& s, const Grid& grid, const TravelLimits& limits) {
  const Suspension& suspension = s.description.suspension;
  const study::AddFact fact{result.facts};
  fact("structure", structure_name(structure_of(suspension)));
  const std::size_t rack = next_to_zero(s.racks), first = rack * s.travels.size();
  if (rack >= grid.racks) return;
  const Sentence centred = s.racks[rack] == 0 ? Sentence() : say(" (rack {})", length(s.racks[rack]));
  const auto span = [&](const char* label, auto&& value, auto&& text) {
    study::Extreme least, greatest;
    for (std::size_t i = first; i < first + s.travels.size(); ++i) {
      if (grid.solved.positions[i].status != Status::done) continue;
      const double now = value(grid.solved.wheels[i].angles);
      least.least(now, i);
      greatest.greatest(now, i);
    }
    if (least.any()) fact(label + centred, say("{} to {}", text(least.value), text(greatest.value)));
  };
  span(
      "toe over the travel", [](const WheelAngles& a) { return a.toe; }, angle);
  if (const auto rim = rim_of(s))
    span(
        "toe at the rim over the travel", [&](const WheelAngles& a) { return toe_at(*rim, a); }, length);
  span(
      "camber over the travel", [](const WheelAngles& a) { return a.camber; }, angle);
  const std::size_t middle = first + next_to_zero(s.travels);
  const WheelParameters& w = grid.solved.wheels[middle];
  if (grid.solved.positions[middle].status == Status::done && w.status == Status::done) {
    const Sentence here =
        s.travels[next_to_zero(s.travels)] == 0 ? centred : say(" (travel {})", length(grid.travel(middle)));
    fact("bump steer" + here, angle_by_travel(w.toe_by_travel));
    fact("camber by travel" + here, angle_by_travel(w.camber_by_travel));
    fact("roll-centre height" + here, length(w.roll_centre_height));
    if (suspension.spring) fact("motion ratio" + here, plain_number(w.motion_ratio).fixed(4));
    if (std::isfinite(w.arms.roll_centre_height))
      fact("roll-centre height by arm planes" + here, length(w.arms.roll_centre_height));
    if (const SteeringAxis* axis = steering_axis_of(w, s.lock)) {
      const std::string held = s.lock == Driver::spring      ? "spring held"
                               : s.lock == Driver::contact_z ? "contact point's height held"
                                                             : "wheel centre's height held";
      fact("caster, kingpin inclination" + here,
           say("{}, {} ({})", angle(axis->caster), angle(axis->inclination), held));
      fact("trail, scrub radius" + here, say("{}, {}", length(axis->trail), length(axis->scrub)));
    }
    if (const auto& axis = w.geometric_axis) {
      fact("caster, kingpin inclination by ball joints" + here,
           say("{}, {}", angle(axis->caster), angle(axis->inclination)));
      fact("trail, scrub radius by ball joints" + here,
           say("{}, {}", length(axis->trail), length(axis->scrub)));
    }
  }
  if (const std::string why = why_no_axis(suspension); !why.empty())
    fact("geometric steering axis", "none: " + why);
  if (const std::string why = why_no_planes(suspension); !why.empty())
    fact("roll centre by arm planes", "none: " + why);
  const auto limit = [&](int i) {
    return limits.status[static_cast<std::size_t>(i)] == Status::no_assembly
               ? Sentence(length(limits.value[static_cast<std::size_t>(i)]))
               : say("none within {}", at_place("travel", metres(1)));
  };
  fact("travel limits of the links, rack centred", say("{} and {}", limit(0), limit(1)));
}

/// Every so manieth value, with both ends and the one next to zero.
std::vector<std::size_t> thinned(std::span<const double> values, std::size_t most) {
  std::vector<std::size_t> out;
  const std::size_t step = (values.size() + most - 1) / most, middle = next_to_zero(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % step == 0 || i + 1 == values.size() || i == middle) out.push_back(i);
  return out;
}

study::Scene scene_of(const SweepStudy& s, const Grid& grid) {
  const auto racks = thinned(std::span(s.racks).first(grid.racks), 41);
  const auto travels = thinned(s.travels, std::max<std::size_t>(2, max_scene_samples / racks.size()));
  std::vector<double> rack_values, travel_values;
  std::vector<CornerPosition> positions;
  std::vector<WheelParameters> wheels;
  for (const std::size_t t : travels) travel_values.push_back(s.travels[t]);
  for (const std::size_t r : racks) {
    rack_values.push_back(s.racks[r]);
    for (const std::size_t t : travels) {
      positions.push_back(grid.solved.positions[r * s.travels.size() + t]);
      wheels.push_back(grid.solved.wheels[r * s.travels.size() + t]);
    }
  }
  CornerGrid shown{s.travel, travel_values, rack_values, positions, wheels, s.lock};
  if (s.packaging) {
    if (s.packaging->half_shaft) shown.half_shaft = shaft_of(*s.packaging->half_shaft);
    for (const BoxForm& box : s.packaging->boxes) shown.boxes.push_back(box_of(box));
  }
  return corner_scene(s.description.suspension, scene_name, "wheel travel and rack", shown);
}

}  // namespace

std::vector<const CornerColumn*> columns_of(const SweepStudy& s) {
  std::vector<const CornerColumn*> out;
  for (const CornerColumn& c : corner_columns()) {
    const bool listed = std::find(s.quantities.begin(), s.quantities.end(), c.group) != s.quantities.end();
    if (listed || (s.quantities.empty() && why_missing(s.description.suspension, c).empty()))
      out.push_back(&c);
  }
  return out;
}

GridPositions solve_grid(const CornerPlan& plan, Driver travel, std::span<const double> travels,
                         std::span<const double> racks, const RunContext* context) {
  constexpr std::size_t between_looks = 256;
  GridPositions out;
  const CornerPosition reference = reference_position(plan, travel);
  const auto middle = static_cast<std::ptrdiff_t>(next_to_zero(travels)),
             end = static_cast<std::ptrdiff_t>(travels.size());
  std::vector<CornerPosition> row(travels.size());
  std::vector<WheelParameters> wheels(travels.size());
  std::size_t solved = 0;
  bool stopped = false;
  for (const double rack : racks) {
    if (context && context->interrupted()) break;
    std::ptrdiff_t first = middle, last = middle;  // positions that the row has, first <= i < last
    const auto from = [&](const CornerPosition& start, std::ptrdiff_t at) {
      const auto i = static_cast<std::size_t>(at);
      row[i] = start.status == Status::done ? solve_position(plan, travel, {travels[i], rack}, start) : start;
      const bool there = row[i].status == Status::done;
      if (there) {
        wheels[i] = wheel_parameters(plan, row[i]);
      } else {
        wheels[i] = {};
        wheels[i].status = row[i].status;
      }
      first = std::min(first, at);
      last = std::max(last, at + 1);
      if (++solved % between_looks == 0 && context && context->interrupted()) stopped = true;
      return there;
    };
    from(reference, middle);
    // Outwards, each from the last one that was reached.
    const CornerPosition begin =
        row[next_to_zero(travels)].status == Status::done ? row[next_to_zero(travels)] : reference;
    for (const int way : {-1, 1}) {
      CornerPosition near = begin;
      for (std::ptrdiff_t i = middle + way; i >= 0 && i < end && !stopped; i += way)
        if (from(near, i)) near = row[static_cast<std::size_t>(i)];
    }
    const bool whole = first == 0 && last == end;
    if (!whole && !out.positions.empty()) break;  // a grid has all travels for each of its racks
    out.first_travel = static_cast<std::size_t>(first);
    out.travels = static_cast<std::size_t>(last - first);
    out.positions.insert(out.positions.end(), std::make_move_iterator(row.begin() + first),
                         std::make_move_iterator(row.begin() + last));
    out.wheels.insert(out.wheels.end(), wheels.begin() + first, wheels.begin() + last);
    if (stopped) break;
  }
  return out;
}

Table sweep_columns_at(const SweepStudy& study, std::vector<double> travels, std::vector<double> racks,
                       const RunContext& context) {
  SweepStudy at = study;
  at.travels = std::move(travels);
  at.racks = std::move(racks);
  Grid grid{at, solve_grid(prepare_suspension(at.description.suspension), at.travel, at.travels, at.racks),
            0};
  grid.racks = at.racks.size();
  study::Result result;
  result.tables.push_back(sweep_table(grid, "sweep"));
  if (has_springs(at.description))
    add_springs(result, at.description, at.ride, grid.solved.positions, {}, false, context);
  return std::move(result.tables[0]);
}

Table empty_sweep_table(const SweepStudy& study) { return sweep_table(Grid{study, {}}, "sweep"); }

study::Result run_sweep_study(const SweepStudy& asked, RunContext& context) {
  study::Result result;
  const CornerPlan plan = prepare_suspension(asked.description.suspension);
  GridPositions solved = solve_grid(plan, asked.travel, asked.travels, asked.racks, &context);
  const std::size_t positions = solved.positions.size();
  if (positions < asked.travels.size() * asked.racks.size()) result.status = context.interruption();
  if (positions == 0) {
    result.headline = "Interrupted before the first position.";
    return result;
  }
  const SweepStudy s = with_travels_of(asked, solved);
  Grid grid{s, std::move(solved), positions / s.travels.size()};
  result.tables.push_back(sweep_table(grid, "sweep"));
  if (has_springs(s.description)) {
    const std::size_t middle = next_to_zero(s.racks) * s.travels.size() + next_to_zero(s.travels);
    add_springs(result, s.description, s.ride, grid.solved.positions, middle, !s.other_wheel, context);
  }
  std::vector<TravelLimits> limits;
  const CornerPosition reference = reference_position(plan, s.travel);
  TravelLimits centred;
  if (reference.status == Status::done) {
    for (std::size_t i = 0; i < grid.racks && (i == 0 || !context.interrupted()); ++i)
      limits.push_back(travel_limits(plan, s.travel, s.racks[i], reference));
    centred = travel_limits(plan, s.travel, 0, reference);
    result.tables.push_back(limits_table(s.racks, limits));
  }
  if (s.assemblies) add_assemblies(result, s, plan);
  result.tables.push_back(hard_point_table(points_of(s.description.suspension)));
  add_lists(result, s.lists, s.description, s.description.suspension,
            s.other_wheel ? &*s.other_wheel : nullptr);
  if (Table bump = bump_table(grid, "bump"); bump.columns.size() > 1)
    result.tables.push_back(std::move(bump));
  add_plots(result, s);
  if (s.baseline) add_baseline(result, s, context);
  add_beside(result, s, context);
  add_facts(result, s, grid, centred);
  tell_missing(result, s);
  if (s.vehicle) {
    const std::size_t middle = next_to_zero(s.racks) * s.travels.size() + next_to_zero(s.travels);
    add_anti_features(result, *s.vehicle, grid.solved.wheels, middle,
                      s.travels[next_to_zero(s.travels)] == 0 || middle >= grid.solved.wheels.size()
                          ? Sentence()
                          : say(" (travel {})", length(grid.travel(middle))));
  }
  if (s.adjust) add_adjustment(result, s.description.suspension, *s.adjust, s.travel, s.lock);
  if (s.packaging) add_packaging(result, s.description.suspension, plan, *s.packaging, grid.solved.positions);
  if (s.axle) {
    const AxleDescription both = axle_of(s.description, s.other_wheel);
    if (s.axle->opposite) add_opposite_travel(result, both, s.ride, *s.axle->opposite->values, context);
    add_axle(result, both, *s.axle, s.vehicle, context);
  }
  const SensitivityInputs inputs{s.travel, s.travels, s.racks[next_to_zero(s.racks)], s.lock};
  if (s.sensitivity) add_sensitivity(result, s.description.suspension, *s.sensitivity, inputs);
  if (s.tolerances) add_tolerances(result, s.description.suspension, *s.tolerances, inputs, context);
  if (s.compliance)
    add_compliance(
        result, s.description, s.other_wheel, *s.compliance,
        {s.travels, std::span(s.racks).first(grid.racks), grid.solved.positions, grid.solved.wheels},
        context);
  if (s.data_sheet) {
    const std::size_t rack = next_to_zero(s.racks);
    const std::string& title = s.data_sheet->title;
    if (rack < grid.racks)
      result.files.push_back(
          {"data-sheet.txt", data_sheet(result, title.empty() ? "Wheel suspension" : title, s.racks[rack],
                                        rack * s.travels.size() + next_to_zero(s.travels))});
  }
  if (s.drawn) result.scenes.push_back(scene_of(s, grid));

  const study::AddWarning warn{result.diagnostics};
  std::size_t lost = 0;
  double worst = 0;
  for (std::size_t i = 0; i < grid.rows(); ++i) {
    const CornerPosition& p = grid.solved.positions[i];
    if (p.status == Status::done) {
      worst = std::max(worst, p.residual);
      continue;
    }
    if (result.status == Status::done) result.status = p.status;
    if (lost++ < 5)
      warn(say("travel {}, rack {}: {}: {}", millimetres(grid.travel(i), 6), millimetres(grid.rack(i), 6),
               to_string(p.status), p.reason),
           "the table `limits` lists the travel that the links allow");
  }
  if (lost > 5) warn(say("{} more positions are not reached", lost - 5));
  result.headline =
      lost == 0 ? say("{} wheel suspension: all {} positions reached (largest closure residual {}).",
                      structure_name(structure_of(s.description.suspension)), grid.rows(), metres(worst, 1))
                : say("{} wheel suspension: {} of {} positions are not reached.",
                      structure_name(structure_of(s.description.suspension)), lost, grid.rows());
  return result;
}

}  // namespace linkwright::suspension
