// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/scan.h"

namespace linkwright::planar {
namespace {

constexpr int nodes = 240;

// A branch in one direction from the start. Pieces follow each other along `sense`; joints[i] is where piece
// i ends.
struct Way {
  double sense = 1;
  std::vector<BranchPiece> pieces;
  std::vector<RangeEnd> joints;
  RangeEnd origin;   // event at the start itself
  bool cut = false;  // ends before the bound that was given
};

// Gives the pieces of a path the modes of group k, which starts with `sign`; splits pieces at its change
// points and cuts the path at its limit. Returns the sign behind the last joint.
double add_group(GroupScan& scan, AtChangePoint policy, Way& way, std::size_t k, double sign) {
  Way out{way.sense, {}, {}, way.origin, way.cut};
  const int group = static_cast<int>(k);
  const bool forward = way.sense > 0;
  const auto reach = [&](RangeEnd& end, double value, EndKind kind) {
    if (kind == EndKind::bound) return;
    if (end.kind != kind) end = {value, kind, {}};
    end.groups.push_back(group);
  };
  bool ended = false;
  for (std::size_t i = 0; i < way.pieces.size() && !ended; ++i) {
    const BranchPiece& piece = way.pieces[i];
    const double begin = forward ? piece.from : piece.to, end = forward ? piece.to : piece.from;
    std::vector<Stretch> parts = scan.stretches(k, piece.modes, piece.from, piece.to);
    if (!forward) {
      std::reverse(parts.begin(), parts.end());
      for (Stretch& s : parts) {
        std::swap(s.from, s.to);
        std::swap(s.from_kind, s.to_kind);
      }
    }
    RangeEnd& near = out.pieces.empty() ? out.origin : out.joints.back();
    if (parts.empty() || parts.front().from != begin) {
      reach(near, begin, EndKind::limit);
      out.cut = true;
      break;
    }
    if (out.pieces.empty() && parts.front().from_kind == EndKind::change_point) {
      // The modes at the start are those of the forward side.
      reach(near, begin, EndKind::change_point);
      if (!forward && policy == AtChangePoint::smooth) sign = -sign;
      if (!forward && policy == AtChangePoint::stop) {
        out.cut = true;
        break;
      }
    }
    for (const Stretch& s : parts) {
      out.pieces.push_back({std::min(s.from, s.to), std::max(s.from, s.to), piece.modes});
      out.pieces.back().modes[k] = sign;
      RangeEnd joint = s.to == end ? way.joints[i] : RangeEnd{s.to, EndKind::bound, {}};
      joint.value = s.to;
      reach(joint, s.to, s.to_kind);
      out.joints.push_back(joint);
      if (s.to_kind == EndKind::change_point && policy == AtChangePoint::smooth) sign = -sign;
      ended = s.to_kind == EndKind::limit || s.to_kind == EndKind::singular ||
              (s.to_kind == EndKind::change_point && policy == AtChangePoint::stop);
      if (ended) break;
    }
    out.cut = out.cut || ended;
  }
  way = std::move(out);
  return sign;
}

void shift(Way& way, double by) {
  for (BranchPiece& p : way.pieces) p.from += by, p.to += by;
  for (RangeEnd& j : way.joints) j.value += by;
}

// The same periodic path, followed backwards from the start.
Way backwards(Way way, double period) {
  Way out{-1, {}, {}, way.joints.back(), false};
  shift(way, -period);
  out.origin.value += -period;
  for (std::size_t i = way.pieces.size(); i-- > 0;) {
    out.pieces.push_back(way.pieces[i]);
    out.joints.push_back(i > 0 ? way.joints[i - 1] : RangeEnd{way.pieces[0].from, EndKind::bound, {}});
  }
  return out;
}

}  // namespace

BranchPath branch_path(const LinkagePlan& plan, std::span<const double> inputs, int input,
                       std::span<const double> modes, double from, double to, AtChangePoint policy) {
  GroupScan scan(plan, inputs, input);
  LINKWRIGHT_REQUIRE(modes.size() == plan.groups.size(), "{} groups, got {} modes", plan.groups.size(),
                     modes.size());
  BranchPath out;
  out.start = inputs[at(input)];
  LINKWRIGHT_REQUIRE(from <= out.start && out.start <= to && from < to && std::isfinite(to - from),
                     "the start {} does not lie in {} to {}", out.start, from, to);
  const std::vector<double> unset(plan.groups.size(), 1.0);
  bool repeats = periodic(plan, input);
  double period = full_turn;
  Way forward, backward;
  backward.sense = -1;
  const auto begin_way = [&](Way& way, double end) {
    way.origin.value = out.start;
    if (end == out.start) return;
    way.pieces = {{std::min(out.start, end), std::max(out.start, end), unset}};
    way.joints = {{end, EndKind::bound, {}}};
  };
  begin_way(forward, repeats ? out.start + full_turn : to);
  if (!repeats) begin_way(backward, from);
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    const GroupTraits traits = traits_of(plan.groups[k]);
    if (!traits.has_limits) continue;
    const double sign = traits.has_modes ? modes[k] : 1;
    if (repeats) {
      Way before = forward;
      const double end_sign = add_group(scan, policy, forward, k, sign);
      if (forward.cut) {
        repeats = false;
        backward = backwards(std::move(before), period);
        add_group(scan, policy, backward, k, sign);
      } else if (end_sign != sign) {
        LINKWRIGHT_REQUIRE(period < 4096 * full_turn, "the branch does not repeat itself within {} turns",
                           period / full_turn);
        Way again = forward;
        shift(again, period);
        for (BranchPiece& p : again.pieces) p.modes[k] = -p.modes[k];
        forward.pieces.insert(forward.pieces.end(), again.pieces.begin(), again.pieces.end());
        forward.joints.insert(forward.joints.end(), again.joints.begin(), again.joints.end());
        period *= 2;
      }
    } else {
      add_group(scan, policy, forward, k, sign);
      add_group(scan, policy, backward, k, sign);
    }
  }
  if (forward.pieces.empty() && backward.pieces.empty()) {
    out.status = Status::no_assembly;
    out.low = out.high = forward.origin;
    return out;
  }
  const auto note = [&](const RangeEnd& joint) {
    if (joint.kind == EndKind::change_point) out.change_points.push_back(joint);
  };
  if (repeats) {
    out.period = period;
    out.low = {out.start, EndKind::bound, {}};
    out.high = {out.start + period, EndKind::bound, {}};
    out.pieces = std::move(forward.pieces);
    for (const RangeEnd& j : forward.joints) note(j);
    return out;
  }
  out.low = backward.pieces.empty() ? backward.origin : backward.joints.back();
  out.high = forward.pieces.empty() ? forward.origin : forward.joints.back();
  for (std::size_t i = backward.pieces.size(); i-- > 0;) {
    out.pieces.push_back(backward.pieces[i]);
    if (i > 0) note(backward.joints[i - 1]);
  }
  if (!forward.pieces.empty() && !backward.pieces.empty()) note(forward.origin);
  for (std::size_t i = 0; i < forward.pieces.size(); ++i) {
    out.pieces.push_back(forward.pieces[i]);
    if (i + 1 < forward.pieces.size()) note(forward.joints[i]);
  }
  return out;
}

Status modes_at(const BranchPath& path, double value, std::span<double> modes) {
  LINKWRIGHT_REQUIRE(!path.pieces.empty() && modes.size() == path.pieces.front().modes.size(),
                     "{} pieces, room for {} modes", path.pieces.size(), modes.size());
  double v = value;
  if (path.period > 0) v -= path.period * std::floor((value - path.start) / path.period);
  auto piece = std::upper_bound(path.pieces.begin(), path.pieces.end(), v,
                                [](double x, const BranchPiece& p) { return x < p.from; });
  if (piece != path.pieces.begin()) --piece;
  std::copy(piece->modes.begin(), piece->modes.end(), modes.begin());
  const bool inside = path.period > 0 || (v >= path.low.value && v <= path.high.value);
  return inside ? Status::done : Status::limit_reached;
}

std::vector<DeadCentre> dead_centres(const Linkage& linkage, const LinkagePlan& plan,
                                     std::span<const double> inputs, int input, const BranchPath& path,
                                     int joint) {
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs() && input >= 0 && at(input) < inputs.size(),
                     "the linkage has {} inputs, got {} and number {}", plan.inputs(), inputs.size(), input);
  LinkageMotion motion(plan);
  std::vector<InputMotion> in;
  for (double v : inputs) in.push_back({v, 0, 0});
  const auto moved = [&](double value) {
    in[at(input)] = {value, 1, 0};
    modes_at(path, value, motion.modes);
    solve_motion(plan, in, motion);
    return motion.status == Status::done ? joint_motion(linkage, plan, motion, joint)
                                         : JointMotion{nan, nan, nan};
  };
  struct Sample {
    double input, rate;
  };
  std::vector<Sample> rates;
  const auto look = [&](double x) {
    const double rate = moved(x).rate;
    if (std::isfinite(rate)) rates.push_back({x, rate});
  };
  if (path.pieces.empty()) return {};
  if (path.period == 0 && path.low.kind == EndKind::bound) look(path.low.value);
  for (const BranchPiece& p : path.pieces)
    for (int i = 0; i < nodes; ++i)
      look((p.from + p.to) / 2 - (p.to - p.from) / 2 * std::cos((i + 0.5) * pi / nodes));
  if (path.period == 0 && path.high.kind == EndKind::bound) look(path.high.value);
  if (path.period > 0 && !rates.empty())
    rates.push_back({rates.front().input + path.period, rates.front().rate});
  double largest = 0;
  for (const auto& r : rates) largest = std::max(largest, std::abs(r.rate));
  std::vector<DeadCentre> out;
  const auto add = [&](double x) {
    // A rate that jumps (a kink of the branch) changes sign without a zero.
    const JointMotion m = moved(x);
    if (std::abs(m.rate) > 1e-6 * largest) return;
    if (path.period > 0 && x >= path.start + path.period) x -= path.period;
    if (!out.empty() && std::abs(x - out.back().input) <= 1e-12 * std::abs(path.high.value - path.low.value))
      return;
    out.push_back({x, m.value, m.acceleration});
  };
  const double rounding = 1e-13 * largest;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const bool end = path.period == 0 && (i == 0 || i + 1 == rates.size());
    if (rates[i].rate == 0 || (end && std::abs(rates[i].rate) <= rounding)) {
      add(rates[i].input);
    } else if (i > 0 && rates[i - 1].rate != 0 && (rates[i - 1].rate < 0) != (rates[i].rate < 0)) {
      if (path.period == 0 && i == 1 && std::abs(rates[0].rate) <= rounding) continue;
      add(math::zero_between([&](double x) { return moved(x).rate; }, rates[i - 1].input, rates[i].input));
    }
  }
  std::sort(out.begin(), out.end(),
            [](const DeadCentre& a, const DeadCentre& b) { return a.input < b.input; });
  return out;
}

}  // namespace linkwright::planar
