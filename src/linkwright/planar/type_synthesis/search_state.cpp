// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/search_state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"

namespace linkwright::planar {
namespace {

constexpr std::string_view what = "the saved search over types";
constexpr std::int64_t most_counted = std::int64_t{1} << 56;
constexpr std::size_t machine_numbers = 2 + 14 + stroke_samples;  // and the parameters

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
                              static_cast<double>(found.origin)};
  numbers.insert(numbers.end(), m.angle.begin(), m.angle.end());
  numbers.insert(numbers.end(), m.shape.x.begin(), m.shape.x.end());
  Value value;
  value["program"] = m.shape.program->name;
  value["numbers"] = pack_numbers(numbers);
  return value;
}

FoundMachine load_machine(const Value& value) {
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
  std::copy_n(n.begin() + 16, stroke_samples, out.machine.angle.begin());
  out.measures = {.error = n[2],
                  .distance = n[11],
                  .largest_deviation = n[3],
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

std::vector<FoundMachine> load_machines(const Value& family, std::string_view key) {
  const Value& list = load_member(family, key, what);
  if (!list.is_array() || list.as_array().size() > 1000)
    throw CheckpointError(std::string(what) + ": a list of machines is none");
  std::vector<FoundMachine> out;
  for (const Value& machine : list.as_array()) out.push_back(load_machine(machine));
  return out;
}

/// The counts of a family, saved and loaded by one list.
template <class Visit>
void counts(FamilyState& f, Visit&& visit) {
  visit("polished", f.report.polished), visit("hops", f.report.hops), visit("grown", f.report.grown);
  visit("curves", f.report.curves), visit("best_at", f.report.best_at);
  visit("atlas_entries", f.report.atlas_entries);
}

Value saved_family(FamilyState f) {
  Value out;
  out["family"] = std::string(name_of(f.report.family));
  counts(f, [&](const char* key, std::int64_t& count) { out[key] = static_cast<std::int64_t>(count); });
  out["next_in_pool"] = static_cast<std::int64_t>(f.next_in_pool);
  out["rounds"] = static_cast<std::int64_t>(f.rounds);
  out["numbers"] = pack_numbers(std::vector{f.report.error, f.last_gain, f.grown_from});
  out["elite"] = saved_machines(f.elite);
  out["archive"] = saved_machines(f.archive);
  out["outside"] = saved_machines(f.outside ? std::vector{*f.outside} : std::vector<FoundMachine>{});
  return out;
}

void load_family(const Value& value, FamilyState& f) {
  const Value& name = load_member(value, "family", what);
  const std::vector<double> n = unpack_numbers(load_member(value, "numbers", what), what);
  if (!name.is_string() || name.as_string() != name_of(f.report.family) || n.size() != 3)
    throw CheckpointError(std::string(what) + ": its families are others");
  counts(f, [&](const char* key, std::int64_t& count) {
    count = load_integer(value, key, 0, most_counted, what);
  });
  f.next_in_pool = static_cast<std::size_t>(load_integer(value, "next_in_pool", 0, 1'000'000, what));
  f.rounds = static_cast<int>(load_integer(value, "rounds", 0, 2'000'000'000, what));
  f.report.error = n[0], f.last_gain = n[1], f.grown_from = n[2];
  f.elite = load_machines(value, "elite"), f.archive = load_machines(value, "archive");
  std::vector<FoundMachine> outside = load_machines(value, "outside");
  if (!outside.empty()) f.outside = std::move(outside[0]);
}

}  // namespace

Value saved_state(const SearchState& state) {
  Value out;
  out["rounds"] = state.rounds;
  out["curves"] = state.curves;
  out["turns"] = state.turns;
  out["families"] = Value::array();
  for (const FamilyState& f : state.families) out["families"].push_back(saved_family(f));
  std::vector<double> progress;
  for (const TypeSearchPoint& p : state.progress)
    progress.insert(progress.end(), {static_cast<double>(p.curves), static_cast<double>(p.family), p.error});
  out["progress"] = pack_numbers(progress);
  return out;
}

void load_state(const Value& value, SearchState& state) {
  state.rounds = load_integer(value, "rounds", 0, std::int64_t{1} << 31, what);
  state.curves = load_integer(value, "curves", 0, most_counted, what);
  const Value& turns = load_member(value, "turns", what);
  if (!turns.is_bool() || turns.as_bool() != state.turns)
    throw CheckpointError(std::string(what) +
                          ": its drives turn, and those of the study rock, or the other way");
  const Value& families = load_member(value, "families", what);
  const std::vector<double> progress = unpack_numbers(load_member(value, "progress", what), what);
  if (!families.is_array() || families.as_array().size() != state.families.size() || progress.size() % 3 != 0)
    throw CheckpointError(std::string(what) + ": its families are others");
  for (std::size_t i = 0; i < state.families.size(); ++i)
    load_family(families.as_array()[i], state.families[i]);
  state.progress.clear();
  for (std::size_t i = 0; i < progress.size(); i += 3) {
    if (!(progress[i] >= 0 && progress[i] < 1e17 && progress[i + 1] >= 0 &&
          progress[i + 1] < static_cast<double>(names(MachineFamily{}).size())))
      throw CheckpointError(std::string(what) + ": its progress is none");
    state.progress.push_back({.curves = static_cast<std::int64_t>(progress[i]),
                              .family = static_cast<MachineFamily>(static_cast<int>(progress[i + 1])),
                              .error = progress[i + 2]});
  }
}

}  // namespace linkwright::planar
