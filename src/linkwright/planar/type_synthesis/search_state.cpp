// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/search_state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"

namespace linkwright::planar {
namespace {

constexpr std::string_view what_state = "the saved search over types";
constexpr std::int64_t most_counted = std::int64_t{1} << 56;
constexpr std::size_t machine_numbers = 2 + 15 + stroke_samples;  // and the parameters

Value saved_machine(const FoundMachine& found) {
  const FittedMachine& m = found.machine;
  const MachineMeasures& s = found.measures;
  std::vector<double> numbers{static_cast<double>(m.shape.signs),
                              m.sense,
                              s.error,
                              s.largest_deviation,
                              s.min_pair_angle,
                              s.min_length,
                              s.max_length,
                              s.size,
                              s.span,
                              s.peak_acceleration,
                              static_cast<double>(s.defect),
                              s.distance,
                              s.rotation,
                              s.largest_rotation,
                              m.body_angle,
                              static_cast<double>(found.origin),
                              s.beyond_tolerance};
  numbers.insert(numbers.end(), m.angle.begin(), m.angle.end());
  numbers.insert(numbers.end(), m.shape.x.begin(), m.shape.x.end());
  Value value;
  value["program"] = m.shape.program->name;
  value["numbers"] = pack_numbers(numbers);
  return value;
}

FoundMachine load_machine(const Value& value, std::string_view what) {
  const Value& name = load_member(value, "program", what);
  const PointProgram* program = name.is_string() ? program_named(name.as_string()) : nullptr;
  const std::vector<double> n = unpack_numbers(load_member(value, "numbers", what), what);
  const bool possible = program &&
                        n.size() == machine_numbers + static_cast<std::size_t>(program->parameters) &&
                        std::all_of(n.begin(), n.end(), [](double v) { return std::abs(v) < 1e12; }) &&
                        n[0] >= 0 && n[0] < 256 && (n[1] == 1 || n[1] == -1) && n[10] >= 0 &&
                        n[10] < static_cast<double>(names(MachineDefect{}).size());
  if (!possible) throw CheckpointError(std::string(what) + ": a machine is not what a search finds");
  FoundMachine out;
  out.machine.shape = {
      .program = program, .signs = static_cast<unsigned>(n[0]), .x = {n.begin() + machine_numbers, n.end()}};
  out.machine.sense = n[1];
  out.machine.error = n[2];
  out.machine.body_angle = n[14];
  out.origin = static_cast<std::int64_t>(n[15]);
  std::copy_n(n.begin() + 17, stroke_samples, out.machine.angle.begin());
  out.measures = {.error = n[2],
                  .distance = n[11],
                  .largest_deviation = n[3],
                  .beyond_tolerance = n[16],
                  .rotation = n[12],
                  .largest_rotation = n[13],
                  .min_pair_angle = n[4],
                  .min_length = n[5],
                  .max_length = n[6],
                  .size = n[7],
                  .span = n[8],
                  .peak_acceleration = n[9],
                  .defect = static_cast<MachineDefect>(static_cast<int>(n[10]))};
  return out;
}

Value saved_machines(const std::vector<FoundMachine>& machines) {
  Value out = Value::array();
  for (const FoundMachine& found : machines) out.push_back(saved_machine(found));
  return out;
}

std::vector<FoundMachine> load_machines(const Value& family, std::string_view key, std::string_view what) {
  const Value& list = load_member(family, key, what);
  if (!list.is_array() || list.as_array().size() > 1000)
    throw CheckpointError(std::string(what) + ": a list of machines is none");
  std::vector<FoundMachine> out;
  for (const Value& machine : list.as_array()) out.push_back(load_machine(machine, what));
  return out;
}

/// The counts of a family, saved and loaded by one list.
template <class Report, class Visit>
void counts(Report& f, Visit&& visit) {
  visit("polished", f.polished), visit("hops", f.hops), visit("grown", f.grown);
  visit("curves", f.curves), visit("best_at", f.best_at), visit("atlas_entries", f.atlas_entries);
}

Value saved_report(const FamilyReport& f) {
  Value out;
  out["family"] = std::string(name_of(f.family));
  counts(f, [&](const char* key, std::int64_t count) { out[key] = count; });
  return out;
}

void load_report(const Value& value, FamilyReport& f, std::string_view what) {
  const Value& name = load_member(value, "family", what);
  if (!name.is_string() || name.as_string() != name_of(f.family))
    throw CheckpointError(std::string(what) + ": its families are others");
  counts(f, [&](const char* key, std::int64_t& count) {
    count = load_integer(value, key, 0, most_counted, what);
  });
}

Value saved_progress(const std::vector<TypeSearchPoint>& points) {
  std::vector<double> progress;
  for (const TypeSearchPoint& p : points)
    progress.insert(progress.end(), {static_cast<double>(p.curves), static_cast<double>(p.family), p.error});
  return pack_numbers(progress);
}

std::vector<TypeSearchPoint> load_progress(const Value& value, std::string_view what) {
  const std::vector<double> progress = unpack_numbers(load_member(value, "progress", what), what);
  std::vector<TypeSearchPoint> out;
  for (std::size_t i = 0; i < progress.size(); i += 3) {
    if (!(i + 2 < progress.size() && progress[i] >= 0 && progress[i] < 1e17 && progress[i + 1] >= 0 &&
          progress[i + 1] < static_cast<double>(names(MachineFamily{}).size())))
      throw CheckpointError(std::string(what) + ": its progress is none");
    out.push_back({.curves = static_cast<std::int64_t>(progress[i]),
                   .family = static_cast<MachineFamily>(static_cast<int>(progress[i + 1])),
                   .error = progress[i + 2]});
  }
  return out;
}

Value saved_family(const FamilyState& f) {
  Value out = saved_report(f.report);
  out["next_in_pool"] = static_cast<std::int64_t>(f.next_in_pool);
  out["rounds"] = static_cast<std::int64_t>(f.rounds);
  out["numbers"] = pack_numbers(std::vector{f.report.error, f.last_gain, f.grown_from});
  out["elite"] = saved_machines(f.elite);
  out["archive"] = saved_machines(f.archive);
  out["outside"] = saved_machines(f.outside ? std::vector{*f.outside} : std::vector<FoundMachine>{});
  return out;
}

void load_family(const Value& value, FamilyState& f) {
  load_report(value, f.report, what_state);
  const std::vector<double> n = unpack_numbers(load_member(value, "numbers", what_state), what_state);
  if (n.size() != 3) throw CheckpointError(std::string(what_state) + ": its families are others");
  f.next_in_pool = static_cast<std::size_t>(load_integer(value, "next_in_pool", 0, 1'000'000, what_state));
  f.rounds = static_cast<int>(load_integer(value, "rounds", 0, 2'000'000'000, what_state));
  f.report.error = n[0], f.last_gain = n[1], f.grown_from = n[2];
  f.elite = load_machines(value, "elite", what_state);
  f.archive = load_machines(value, "archive", what_state);
  std::vector<FoundMachine> outside = load_machines(value, "outside", what_state);
  if (!outside.empty()) f.outside = std::move(outside[0]);
}

/// The list of families of a saved table, as many as there are.
const std::vector<Value>& load_list(const Value& value, std::size_t count, std::string_view what) {
  const Value& families = load_member(value, "families", what);
  if (!families.is_array() || families.as_array().size() != count)
    throw CheckpointError(std::string(what) + ": its families are others");
  return families.as_array();
}

}  // namespace

Value saved_state(const SearchState& state) {
  Value out;
  out["rounds"] = state.rounds;
  out["curves"] = state.curves;
  out["turns"] = state.turns;
  out["families"] = Value::array();
  for (const FamilyState& f : state.families) out["families"].push_back(saved_family(f));
  out["progress"] = saved_progress(state.progress);
  return out;
}

void load_state(const Value& value, SearchState& state) {
  state.rounds = load_integer(value, "rounds", 0, std::int64_t{1} << 31, what_state);
  state.curves = load_integer(value, "curves", 0, most_counted, what_state);
  const Value& turns = load_member(value, "turns", what_state);
  if (!turns.is_bool() || turns.as_bool() != state.turns)
    throw CheckpointError(std::string(what_state) +
                          ": its drives turn, and those of the study rock, or the other way");
  const auto& families = load_list(value, state.families.size(), what_state);
  for (std::size_t i = 0; i < state.families.size(); ++i) load_family(families[i], state.families[i]);
  state.progress = load_progress(value, what_state);
}

Value saved_answer(const TypeSearchAnswer& answer) {
  Value out;
  out["curves"] = answer.curves;
  out["families"] = Value::array();
  std::vector<double> errors;
  for (const FamilyReport& f : answer.families) {
    out["families"].push_back(saved_report(f));
    errors.push_back(f.error);
  }
  out["errors"] = pack_numbers(errors);
  out["machines"] = saved_machines(answer.machines);
  out["outside"] = saved_machines(answer.outside);
  out["progress"] = saved_progress(answer.progress);
  return out;
}

TypeSearchAnswer load_answer(const Value& value, std::span<const MachineFamily> families,
                             std::string_view what) {
  TypeSearchAnswer out;
  out.curves = load_integer(value, "curves", 0, most_counted, what);
  const auto& list = load_list(value, families.size(), what);
  const std::vector<double> errors = unpack_numbers(load_member(value, "errors", what), what);
  if (errors.size() != families.size() ||
      !std::all_of(errors.begin(), errors.end(), [](double e) { return e >= 0; }))
    throw CheckpointError(std::string(what) + ": its errors are none");
  for (std::size_t i = 0; i < families.size(); ++i) {
    FamilyReport& f = out.families.emplace_back();
    f.family = families[i], f.error = errors[i];
    load_report(list[i], f, what);
  }
  out.machines = load_machines(value, "machines", what), out.outside = load_machines(value, "outside", what);
  out.progress = load_progress(value, what);
  return out;
}

}  // namespace linkwright::planar
