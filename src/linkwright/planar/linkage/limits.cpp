// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/limits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/scan.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t max_ranges = 4096;
// Ends are computed twice at most by different routes: rounding times a few.
constexpr double same_place = 1e-9;

// The end of a range when one more group has been looked at.
RangeEnd refined(const RangeEnd& end, double value, EndKind kind, int group) {
  if (kind == EndKind::bound) return end;
  RangeEnd out{value, kind, {group}};
  // A change point where groups before have theirs as well.
  if (kind == EndKind::change_point && end.kind == kind && end.value == value) {
    out.groups = end.groups;
    out.groups.push_back(group);
  }
  return out;
}

bool same_modes(const InputRange& a, const InputRange& b, const std::vector<int>& apart_from,
                const std::vector<int>& and_from) {
  for (std::size_t k = 0; k < a.modes.size(); ++k)
    if (a.modes[k] != b.modes[k] &&
        std::find(apart_from.begin(), apart_from.end(), static_cast<int>(k)) == apart_from.end() &&
        std::find(and_from.begin(), and_from.end(), static_cast<int>(k)) == and_from.end())
      return false;
  return true;
}

// Ranges that were only cut by the ends of the turn become one.
void join_over_turn(InputLimits& l) {
  for (std::size_t i = 0; i < l.ranges.size(); ++i) {
    if (l.ranges[i].to.kind != EndKind::bound) continue;
    for (std::size_t k = 0; k < l.ranges.size(); ++k) {
      InputRange &last = l.ranges[i], &first = l.ranges[k];
      if (first.from.kind != EndKind::bound || !same_modes(last, first, {}, {})) continue;
      if (i == k) {
        last.full_turn = true;
      } else {
        last.to = first.to;
        last.to.value += full_turn;
        l.ranges.erase(l.ranges.begin() + static_cast<std::ptrdiff_t>(k));
        if (k < i) --i;
      }
      break;
    }
  }
}

void number_circuits(InputLimits& l) {
  std::vector<std::size_t> root(l.ranges.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto meet = [&](const InputRange& a, const RangeEnd& x, const InputRange& b, const RangeEnd& y) {
    if (x.kind != y.kind || (x.kind != EndKind::limit && x.kind != EndKind::change_point)) return false;
    const double apart = l.closed ? math::angle_difference(x.value, y.value) : x.value - y.value;
    return std::abs(apart) <= same_place * (l.to - l.from) && same_modes(a, b, x.groups, y.groups);
  };
  for (std::size_t i = 0; i < l.ranges.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const InputRange &a = l.ranges[i], &b = l.ranges[k];
      if (meet(a, a.from, b, b.from) || meet(a, a.from, b, b.to) || meet(a, a.to, b, b.from) ||
          meet(a, a.to, b, b.to))
        root[std::max(find(i), find(k))] = std::min(find(i), find(k));
    }
  std::vector<int> number(l.ranges.size(), 0);
  for (std::size_t i = 0; i < l.ranges.size(); ++i) {
    int& n = number[find(i)];
    if (n == 0) n = ++l.circuits;
    l.ranges[i].circuit = n;
  }
}

Measured place(bool rotary, double value) {
  return rotary ? degrees_of(value).fixed(1).spelled() : millimetres(value);
}
Sentence from_to(bool rotary, double from, double to) {
  return say("from {} to {}", place(rotary, from).sharing_unit(), place(rotary, to));
}
/// Two digits, and all before the point: a hundred is 100, not 1e+02.
Measured short_by(double gap) { return gap < 99.5e-3 ? millimetres(gap, 2) : millimetres(gap).fixed(0); }

}  // namespace

InputLimits input_limits(const LinkagePlan& plan, std::span<const double> inputs, int input, double from,
                         double to) {
  GroupScan scan(plan, inputs, input);
  LINKWRIGHT_REQUIRE(std::isfinite(from) && std::isfinite(to) && from < to, "no interval: {} to {}", from,
                     to);
  InputLimits out;
  out.input = input;
  out.rotary = plan.rotary[at(input)];
  out.from = from;
  out.to = to;
  out.closed = periodic(plan, input) && std::abs(to - from - full_turn) <= 1e-12 * full_turn;
  out.ranges.push_back({{from, EndKind::bound, {}},
                        {to, EndKind::bound, {}},
                        false,
                        std::vector<double>(plan.groups.size(), 1.0),
                        0});
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    const GroupTraits traits = traits_of(plan.groups[k]);
    if (!traits.has_limits) continue;
    std::vector<InputRange> next;
    for (const InputRange& r : out.ranges)
      for (const Stretch& s : scan.stretches(k, r.modes, r.from.value, r.to.value))
        for (int side = 0; side < (traits.has_modes ? 2 : 1); ++side) {
          InputRange one = r;
          one.from = refined(r.from, s.from, s.from_kind, static_cast<int>(k));
          one.to = refined(r.to, s.to, s.to_kind, static_cast<int>(k));
          one.modes[k] = side == 0 ? 1 : -1;
          next.push_back(std::move(one));
          LINKWRIGHT_REQUIRE(next.size() <= max_ranges, "more than {} ranges: too many groups with modes",
                             max_ranges);
        }
    out.ranges = std::move(next);
  }
  std::stable_sort(out.ranges.begin(), out.ranges.end(), [](const InputRange& a, const InputRange& b) {
    if (a.modes != b.modes) return a.modes > b.modes;
    return a.from.value < b.from.value;
  });
  if (out.closed) join_over_turn(out);
  number_circuits(out);
  return out;
}

const InputRange* range_at(const InputLimits& limits, std::span<const double> modes, double value) {
  for (const InputRange& r : limits.ranges) {
    if (!std::equal(modes.begin(), modes.end(), r.modes.begin(), r.modes.end())) continue;
    double v = value;
    if (limits.closed) v -= full_turn * std::floor((value - r.from.value) / full_turn);
    if (r.full_turn || (v >= r.from.value && v <= r.to.value)) return &r;
  }
  return nullptr;
}

double assembly_range(const InputLimits& limits, std::span<const double> modes) {
  double sum = 0;
  for (const InputRange& r : limits.ranges)
    if (std::equal(modes.begin(), modes.end(), r.modes.begin(), r.modes.end()))
      sum += r.full_turn ? full_turn : r.to.value - r.from.value;
  return sum;
}

Sentence assembly_range_text(const InputLimits& limits, std::span<const double> modes) {
  const bool rotary = limits.rotary;
  struct Part {
    double from, to;
  };
  std::vector<Part> parts;
  for (const InputRange& r : limits.ranges) {
    if (!std::equal(modes.begin(), modes.end(), r.modes.begin(), r.modes.end())) continue;
    if (r.full_turn) return "assembles over the full turn";
    // A range across the end of the turn is counted from the start when more of it lies there: -96 to 96 deg.
    const bool beyond = limits.closed && (r.from.value + r.to.value) / 2 >= limits.to - same_place;
    const double from = r.from.value - (beyond ? full_turn : 0), to = r.to.value - (beyond ? full_turn : 0);
    // Ranges that meet at a change point are one to the reader.
    if (!parts.empty() && std::abs(parts.back().to - from) <= same_place * (limits.to - limits.from))
      parts.back().to = to;
    else
      parts.push_back({from, to});
  }
  if (parts.empty()) return say("assembles nowhere {}", from_to(rotary, limits.from, limits.to));
  if (limits.closed && parts.size() == 1 &&
      parts[0].to - parts[0].from >= (1 - same_place) * (limits.to - limits.from))
    return "assembles over the full turn";
  Sentence out = "assembles";
  for (std::size_t i = 0; i < parts.size(); ++i)
    out += say("{} {}",
               i == 0                  ? ""
               : i + 1 == parts.size() ? " and"
                                       : ",",
               from_to(rotary, parts[i].from, parts[i].to));
  return out;
}

Sentence assembly_gap_text(const LinkagePlan& plan, const LinkageMotion& motion, int input, double value) {
  LINKWRIGHT_REQUIRE(input >= 0 && at(input) < plan.inputs(), "there is no input {} of {}", input,
                     plan.inputs());
  const bool rotary = plan.rotary[at(input)];
  const Sentence where = say("at {}", place(rotary, value));
  if (motion.status == Status::done) return where + " it assembles";
  const std::string group =
      motion.failed_group >= 0 ? fmt::format(" ('{}')", plan.groups[at(motion.failed_group)].name) : "";
  if (motion.status == Status::no_assembly && motion.gap > 0)
    return say("{} short by {}{}", where, short_by(motion.gap), group);
  if (motion.status == Status::singular) return where + " at a dead point" + group;
  return say("{} {}{}", where, to_string(motion.status), group);
}

std::string mode_text(const LinkagePlan& plan, std::span<const double> modes) {
  std::string out;
  for (std::size_t k = 0; k < plan.groups.size() && k < modes.size(); ++k)
    if (traits_of(plan.groups[k]).has_modes)
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", plan.groups[k].name,
                         modes[k] < 0 ? "minus" : "plus");
  return out.empty() ? "only one mode" : out;
}

}  // namespace linkwright::planar
