#include "linkwright/planar/linkage_trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }
constexpr double full_turn = 2 * std::numbers::pi;
constexpr int most_turns = 16;
using Parts = std::vector<PartState<double>>;

class Tracer {
 public:
  Tracer(const LinkagePlan& plan, std::span<const double> inputs, int input, double from, double to,
         const TraceSearch& search)
      : plan_(plan),
        search_(search),
        motion_(plan),
        input_(at(input)),
        values_(inputs.begin(), inputs.end()) {
    out_.input = input;
    out_.rotary = plan.rotary[input_];
    out_.from = from;
    out_.to = to;
    out_.closed = periodic(plan, input) && std::abs(to - from - full_turn) <= 1e-12 * full_turn;
    visited_.resize(at(search.stations) + 1);
  }

  InputLimits run() {
    for (int s = 0; s < search_.stations + (out_.closed ? 0 : 1); s += search_.look_every) {
      values_[input_] = station(s);
      for (const AssembledMode& mode : assembly_modes(plan_, values_, search_.modes).found)
        if (!seen(s, mode.parts)) trace(s, mode);
    }
    join();
    return std::move(out_);
  }

 private:
  double station(int s) const {
    return out_.from + (out_.to - out_.from) * static_cast<double>(s) / static_cast<double>(search_.stations);
  }
  std::size_t place(int s) const {
    const int n = search_.stations;
    return at(out_.closed ? ((s % n) + n) % n : s);
  }
  bool alike(const Parts& a, const Parts& b, double tolerance) const {
    for (std::size_t p = 1; p < a.size(); ++p)
      if (!(norm(a[p].origin - b[p].origin) <= tolerance * plan_.size) ||
          !(norm(a[p].direction - b[p].direction) <= tolerance))
        return false;
    return true;
  }
  bool seen(int s, const Parts& parts) const {
    return std::any_of(visited_[place(s)].begin(), visited_[place(s)].end(),
                       [&](const Parts& v) { return alike(v, parts, 1e-6); });
  }
  void solve(double value) {
    std::vector<InputMotion> in(values_.size());
    for (std::size_t i = 0; i < in.size(); ++i) in[i].value = values_[i];
    in[input_] = {value, 1, 0};
    solve_position(plan_, in, motion_);
    if (motion_.status == Status::done) solve_velocity(plan_, in, motion_);
  }
  FollowReport go(double from, double to) {
    std::vector<double> a = values_, b = values_;
    a[input_] = from;
    b[input_] = to;
    return follow(plan_, a, b, motion_);
  }
  // Falls to zero, in proportion to the distance, at a limit of motion.
  double slowness() const {
    double sum = 0;
    for (const PartState<double>& s : motion_.parts)
      sum += dot(s.velocity, s.velocity) / (plan_.size * plan_.size) + s.speed * s.speed;
    return 1 / sum;
  }
  std::size_t nearest_group() const {
    std::size_t nearest = 0;
    double least = 2;
    for (std::size_t k = 0; k < plan_.groups.size(); ++k) {
      const GroupType type = plan_.groups[k].type;
      if (type == GroupType::driver || type == GroupType::gear) continue;
      if (std::abs(motion_.groups[k].sine) < least) least = std::abs(motion_.groups[nearest = k].sine);
    }
    return nearest;
  }
  // The end of a range that could be followed to `last`, by what happens on the way there from a little
  // before.
  RangeEnd end_at(double last, double sense) {
    const double back = last - sense * 1e-6 * (out_.to - out_.from);
    solve(last);
    const double near_rate = slowness();
    const std::size_t group = nearest_group();
    const double near_sine = motion_.groups[group].sine;
    const Parts parts = motion_.parts;
    RangeEnd end{last, EndKind::limit, {static_cast<int>(group)}};
    if (go(last, back).arrived) {
      solve(back);
      const double far_rate = slowness(), far_sine = motion_.groups[group].sine;
      const bool limit = near_rate < 0.5 * far_rate;
      const double near_zero = limit ? near_rate : near_sine, far_zero = limit ? far_rate : far_sine;
      end.kind = limit ? EndKind::limit : EndKind::change_point;
      const double ahead = near_zero / (far_zero - near_zero) * (last - back);
      if (std::isfinite(ahead) && std::abs(ahead) < std::abs(last - back)) end.value = last + ahead;
    }
    motion_.parts = parts;
    return end;
  }
  struct Way {
    RangeEnd end;
    Parts parts;  // there
    bool closes = false;
  };
  Way way(int s, double sense, const Parts& start) {
    motion_.parts = start;
    const int step = sense > 0 ? 1 : -1, first = s;
    while (true) {
      if (!out_.closed && s == (sense > 0 ? search_.stations : 0))
        return {{station(s), EndKind::bound, {}}, motion_.parts};
      const FollowReport f = go(station(s), station(s + step));
      if (!f.arrived) {
        const double last = station(s) + f.reached * (station(s + step) - station(s));
        const RangeEnd end = end_at(last, sense);
        return {end, motion_.parts};
      }
      s += step;
      if (out_.closed && place(s) == place(first) && alike(motion_.parts, start, 1e-6))
        return {{station(s), EndKind::bound, {}}, motion_.parts, true};
      visited_[place(s)].push_back(motion_.parts);
      if (std::abs(s - first) > most_turns * search_.stations)
        return {{station(s), EndKind::bound, {}}, motion_.parts};
    }
  }
  void trace(int s, const AssembledMode& mode) {
    for (std::size_t k = 0; k < plan_.groups.size(); ++k)
      if (plan_.groups[k].type != GroupType::general) motion_.modes[k] = mode.modes[k];
    motion_.parts = mode.parts;
    solve(station(s));
    if (motion_.status != Status::done) return;
    const Parts start = motion_.parts;
    visited_[place(s)].push_back(start);
    InputRange range;
    range.modes = mode.modes;
    const Way forward = way(s, 1, start);
    range.to = forward.end;
    Way backward;
    if (forward.closes) {
      range.full_turn = true;
      range.from = {station(s), EndKind::bound, {}};
    } else {
      backward = way(s, -1, start);
      range.from = backward.end;
    }
    out_.ranges.push_back(std::move(range));
    ends_.push_back({backward.parts, forward.parts});
  }

  // Ranges whose ends meet are of one circuit. The ends are known at a little distance from where they meet,
  // and positions go with its square root.
  void join() {
    std::vector<std::size_t> root(out_.ranges.size());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i];
      return i;
    };
    const auto meet = [&](const RangeEnd& x, const Parts& a, const RangeEnd& y, const Parts& b) {
      if (x.kind == EndKind::bound || x.kind != y.kind || a.empty() || b.empty()) return false;
      double apart = x.value - y.value;
      if (out_.closed) apart = std::remainder(apart, full_turn);
      return std::abs(apart) <= 1e-6 * (out_.to - out_.from) && alike(a, b, 1e-2);
    };
    for (std::size_t i = 0; i < root.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const InputRange &a = out_.ranges[i], &b = out_.ranges[k];
        if (meet(a.from, ends_[i].from, b.from, ends_[k].from) ||
            meet(a.from, ends_[i].from, b.to, ends_[k].to) ||
            meet(a.to, ends_[i].to, b.from, ends_[k].from) || meet(a.to, ends_[i].to, b.to, ends_[k].to))
          root[std::max(find(i), find(k))] = std::min(find(i), find(k));
      }
    std::vector<int> number(root.size(), 0);
    for (std::size_t i = 0; i < root.size(); ++i) {
      int& n = number[find(i)];
      if (n == 0) n = ++out_.circuits;
      out_.ranges[i].circuit = n;
    }
  }

  struct Ends {
    Parts from, to;
  };
  const LinkagePlan& plan_;
  const TraceSearch& search_;
  LinkageMotion motion_;
  std::size_t input_;
  std::vector<double> values_;
  InputLimits out_;
  std::vector<Ends> ends_;
  std::vector<std::vector<Parts>> visited_;
};

}  // namespace

InputLimits trace_limits(const LinkagePlan& plan, std::span<const double> inputs, int input, double from,
                         double to, const TraceSearch& search) {
  LINKWRIGHT_REQUIRE(!plan.closed_form(), "the plan is in closed form: use input_limits");
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs() && input >= 0 && at(input) < inputs.size(),
                     "the linkage has {} inputs, got {} and number {}", plan.inputs(), inputs.size(), input);
  LINKWRIGHT_REQUIRE(std::isfinite(from) && std::isfinite(to) && from < to, "no interval: {} to {}", from,
                     to);
  LINKWRIGHT_REQUIRE(search.stations >= 1 && search.look_every >= 1, "{} stations, look every {}",
                     search.stations, search.look_every);
  return Tracer(plan, inputs, input, from, to, search).run();
}

}  // namespace linkwright::planar
