#include "linkwright/planar/linkage_trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/core/check.h"
#include "linkwright/planar/linkage_curve.h"

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
  }

  InputLimits run() {
    for (int s = 0; s < search_.stations + (out_.closed ? 0 : 1); s += search_.look_every) {
      values_[input_] = station(s);
      for (const AssembledMode& mode : assembly_modes(plan_, values_, search_.modes).found)
        if (!seen(values_[input_], mode.parts)) trace(mode);
    }
    join();
    return std::move(out_);
  }

 private:
  double station(int s) const {
    return out_.from + (out_.to - out_.from) * static_cast<double>(s) / static_cast<double>(search_.stations);
  }
  bool alike(const Parts& a, const Parts& b, double tolerance) const {
    for (std::size_t p = 1; p < a.size(); ++p)
      if (!(norm(a[p].origin - b[p].origin) <= tolerance * plan_.size) ||
          !(norm(a[p].direction - b[p].direction) <= tolerance))
        return false;
    return true;
  }
  // Whether a place lies on a range that is known; one that takes several turns has it once a turn.
  bool seen(double value, const Parts& parts) {
    for (ModeCurve& curve : curves_)
      for (int turn = -most_turns; turn <= most_turns; ++turn) {
        if (turn != 0 && !out_.closed) continue;
        const double there = value + turn * full_turn;
        if (there < curve.low().value || there > curve.high().value) continue;
        if (curve.place(there, motion_) == Status::done && alike(motion_.parts, parts, 1e-6)) return true;
      }
    return false;
  }
  void trace(const AssembledMode& mode) {
    const double start = values_[input_], turns = out_.closed ? most_turns * full_turn : 0;
    ModeCurve curve(plan_, along_input(values_, out_.input), start, mode.parts,
                    out_.closed ? start - turns : out_.from, out_.closed ? start + turns : out_.to,
                    out_.closed ? full_turn : 0, AtChangePoint::stop, true);
    InputRange range{curve.low(), curve.high(), curve.period() > 0, mode.modes, 0};
    Ends ends;
    if (!range.full_turn) {
      curve.place(curve.low().value, motion_);
      ends.from = motion_.parts;
      curve.place(curve.high().value, motion_);
      ends.to = motion_.parts;
    }
    out_.ranges.push_back(std::move(range));
    ends_.push_back(std::move(ends));
    curves_.push_back(std::move(curve));
  }

  // Ranges whose ends meet are of one circuit. Ends are known to about 1e-10 of the interval, and positions
  // go with its square root.
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
  std::vector<ModeCurve> curves_;
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
