// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/design_synthesis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/dual.h"
#include "linkwright/optimise/nlopt_bridge.h"
#include "linkwright/optimise/nonnegative_fit.h"

namespace linkwright::parallel {

namespace {

constexpr double infinite = infinity;

// Searches that end within this share of each other found the same size.
constexpr double same_size = 1e-7;
// A limit is active where it is met by no more than this share.
constexpr double at_limit = 1e-6;
// Ratios below it are no parallelograms that anybody builds; arms as long as that are no small joints.
constexpr double min_ratio = 1e-3;

// J must be at least this everywhere, and what says so.
struct LeastJacobian {
  double value = 0;
  PiLimit limit = PiLimit::torque;
};
LeastJacobian min_jacobian(const PiRequirements& r) {
  const double torque = r.torque / r.force_limit, resolution = r.quantum / r.resolution;
  return torque >= resolution ? LeastJacobian{torque, PiLimit::torque}
                              : LeastJacobian{resolution, PiLimit::resolution};
}

double greatest_centre(const PiRequirements& r) { return pi / 2 - r.half_travel - r.end_margin; }

// Unknowns: log(a / m), k, theta_c. Everything that is limited is a ratio, so constraints and cost are of
// order 1 whatever the size of the joint.
using Number = math::Dual<3>;

PiTerms<Number> terms_at(const Number& arm, const Number& ratio, const Number& angle) {
  const Number half = 0.5 * angle + pi / 4;
  return pi_terms(arm, ratio, sin(half), cos(half));
}

class Task {
 public:
  explicit Task(const PiRequirements& r) : r_(r), min_(min_jacobian(r)) {
    add(min_.limit);
    add(min_.limit);
    if (r.speed > 0 && r.rate_limit < infinite) add(PiLimit::speed);
    if (r.transmission > 0) {
      add(PiLimit::transmission);
      add(PiLimit::transmission);
    }
    if (r.stroke < infinite) add(PiLimit::stroke);
    if (r.telescoping < infinite) add(PiLimit::telescoping);
    const double a = std::log(min_.value);
    // J is at most b, so a >= b is at least what J must be.
    lower_ = {a, min_ratio, -greatest_centre(r)};
    upper_ = {a - 2 * std::log(min_ratio), 1, greatest_centre(r)};
  }

  std::size_t constraints() const { return limits_.size(); }
  const std::vector<PiLimit>& limits() const { return limits_; }
  const std::array<double, 3>& lower() const { return lower_; }
  const std::array<double, 3>& upper() const { return upper_; }

  // log(a + b)
  static Number cost(std::span<const double> x) {
    const Number k = Number::variable(x[1], 1);
    return Number::variable(x[0], 0) + math::chained(k, std::log1p(x[1]), 1 / (1 + x[1]));
  }

  // In the order of limits(), met when <= 0.
  std::vector<Number> values(std::span<const double> x) const {
    const Number arm = math::chained(Number::variable(x[0], 0), std::exp(x[0]), std::exp(x[0]));
    const Number ratio = Number::variable(x[1], 1), centre = Number::variable(x[2], 2);
    const auto low = terms_at(arm, ratio, centre - r_.half_travel);
    const auto high = terms_at(arm, ratio, centre + r_.half_travel);
    const std::array<Number, 2> ends = {pi_jacobian(low), pi_jacobian(high)};
    std::vector<Number> out = {1.0 - ends[0] / min_.value, 1.0 - ends[1] / min_.value};
    if (has(PiLimit::speed)) {
      // J is largest, b, where sin(theta) = -k; else at the end that is nearer to it, smoothly.
      const double peak = -std::asin(x[1]);
      const Number top = peak < x[2] - r_.half_travel   ? ends[0]
                         : peak > x[2] + r_.half_travel ? ends[1]
                                                        : arm * ratio;
      out.push_back(top * (r_.speed / r_.rate_limit) - 1.0);
    }
    if (has(PiLimit::transmission))
      for (const Number& end : ends) out.push_back(1.0 - end / (arm * std::sin(r_.transmission)));
    const Number shortest = pi_diagonal(low), longest = pi_diagonal(high);
    if (has(PiLimit::stroke)) out.push_back((longest - shortest) / r_.stroke - 1.0);
    if (has(PiLimit::telescoping)) out.push_back(longest / (r_.telescoping * shortest) - 1.0);
    return out;
  }

  PiDesign design(std::span<const double> x) const {
    PiDesign out{.joint = {.arm = std::exp(x[0]), .ratio = x[1]}, .centre = x[2]};
    out.size = out.joint.arm * (1 + out.joint.ratio);
    for (const Number& value : values(x)) out.violation = std::max(out.violation, value.value);
    if (out.violation <= tolerance::feasibility) out.violation = 0;
    return out;
  }

 private:
  void add(PiLimit limit) { limits_.push_back(limit); }
  bool has(PiLimit limit) const { return std::find(limits_.begin(), limits_.end(), limit) != limits_.end(); }

  PiRequirements r_;
  LeastJacobian min_;
  std::vector<PiLimit> limits_;
  std::array<double, 3> lower_{}, upper_{};
};

std::array<double, 3> unknowns(const PiDesign& design) {
  return {std::log(design.joint.arm), design.joint.ratio, design.centre};
}

// Active limits and their multipliers: those that leave least of the gradient of the cost.
void price(const Task& task, std::span<const double> x, PiDesignReport& report) {
  std::vector<PiLimit> limits;
  std::vector<double> columns;
  const auto add = [&](PiLimit limit, const std::array<double, 3>& gradient) {
    limits.push_back(limit);
    columns.insert(columns.end(), gradient.begin(), gradient.end());
  };
  const auto values = task.values(x);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i].value > -at_limit) add(task.limits()[i], values[i].by);
  if (x[1] > 1 - at_limit) add(PiLimit::ratio, {0, 1, 0});
  if (x[2] < task.lower()[2] + at_limit) add(PiLimit::ends, {0, 0, -1});
  if (x[2] > task.upper()[2] - at_limit) add(PiLimit::ends, {0, 0, 1});
  std::array<double, 3> wanted = Task::cost(x).by;
  double length = 0;
  for (double& w : wanted) {
    length = std::hypot(length, w);
    w = -w;
  }
  std::vector<double> prices(limits.size());
  report.stationarity = optimise::fit_nonnegative(columns, wanted, prices) / length;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto same = [&](const PiActiveLimit& a) { return a.limit == limits[i]; };
    const auto known = std::find_if(report.active.begin(), report.active.end(), same);
    if (known != report.active.end())
      known->price += prices[i];
    else
      report.active.push_back({limits[i], prices[i]});
  }
  std::stable_sort(report.active.begin(), report.active.end(),
                   [](const PiActiveLimit& a, const PiActiveLimit& b) { return a.price > b.price; });
}

bool better(const PiDesign& a, const PiDesign& b) {
  return a.violation != b.violation ? a.violation < b.violation : a.size < b.size;
}

}  // namespace

PiRangeValues range_values(const PiJoint& joint, double centre, double half_travel) {
  const double low = centre - half_travel, high = centre + half_travel;
  const double peak = -std::asin(std::min(joint.ratio, 1 / joint.ratio));
  PiRangeValues out;
  out.min_jacobian = std::min(jacobian(joint, low), jacobian(joint, high));
  out.greatest_jacobian = jacobian(joint, std::clamp(peak, low, high));
  out.min_diagonal = diagonal(joint, low);
  out.greatest_diagonal = diagonal(joint, high);
  out.min_transmission = std::asin(std::min(out.min_jacobian / joint.arm, 1.0));
  return out;
}

double best_centre(const PiJoint& joint, double half_travel) {
  return -std::asin(std::min(joint.ratio, 1 / joint.ratio) * std::cos(half_travel));
}

double centred_ratio_limit(double half_travel, double telescoping) {
  const double q = std::isinf(telescoping) ? 1 : (telescoping - 1) / (telescoping + 1);
  return q / std::hypot(std::sin(half_travel), q * std::cos(half_travel));
}

double symmetric_ratio_limit(double half_travel, double telescoping) {
  const double share = 1 / (telescoping * telescoping);
  const double kappa = std::sin(half_travel) * (1 + share) / (1 - share);
  return kappa <= 1 ? 1 : 1 / (kappa + std::sqrt(kappa * kappa - 1));
}

std::optional<std::string> problem(const PiRequirements& r) {
  const auto at_least_zero = [](double x) { return x >= 0 && std::isfinite(x); };
  if (!(r.half_travel > 0 && r.half_travel < pi / 2))
    return fmt::format("half travel = {} rad, allowed: above 0, below pi/2", r.half_travel);
  if (!(r.end_margin > 0 && r.half_travel + r.end_margin < pi / 2))
    return fmt::format("a half travel of {} rad leaves no margin of {} rad to +-pi/2", r.half_travel,
                       r.end_margin);
  if (!at_least_zero(r.torque)) return fmt::format("torque = {} N m", r.torque);
  if (!(r.force_limit > 0)) return fmt::format("force limit = {} N", r.force_limit);
  if (!at_least_zero(r.speed)) return fmt::format("speed = {} rad/s", r.speed);
  if (!(r.rate_limit > 0)) return fmt::format("rate limit = {} m/s", r.rate_limit);
  if (!at_least_zero(r.quantum)) return fmt::format("quantum = {} m", r.quantum);
  if (!(r.resolution > 0)) return fmt::format("resolution = {} rad", r.resolution);
  if (!(r.transmission >= 0 && r.transmission < pi / 2))
    return fmt::format("transmission angle = {} rad, allowed: at least 0, below pi/2", r.transmission);
  if (!(r.stroke > 0)) return fmt::format("stroke = {} m", r.stroke);
  if (!(r.telescoping > 1)) return fmt::format("telescoping ratio = {}, allowed: above 1", r.telescoping);
  if (!(min_jacobian(r).value > 0))
    return "neither a torque with a force limit nor a quantum with a resolution is required: the joint could "
           "become arbitrarily small";
  return {};
}

Sentence words_of(const PiConflict& c) {
  const auto length = [&](double value) { return c.of_ratio ? plain_number(value) : millimetres(value); };
  return say("{} asks for a {} of at least {}, {} allows at most {}", name_of(c.low),
             c.of_ratio ? "ratio of base to arm" : "base", length(c.at_least), name_of(c.high),
             length(c.at_most));
}

PiClosedForm closed_form_design(const PiRequirements& r) {
  const auto wrong = problem(r);
  LINKWRIGHT_REQUIRE(!wrong, "{}", *wrong);
  const double sine = std::sin(r.half_travel), cosine = std::cos(r.half_travel);
  struct Bound {
    PiLimit limit;
    double value;
  };
  const Bound smallest[] = {{PiLimit::torque, r.torque / (r.force_limit * cosine)},
                            {PiLimit::resolution, r.quantum / (r.resolution * cosine)}};
  const Bound largest[] = {{PiLimit::speed, r.rate_limit / r.speed},
                           {PiLimit::stroke, r.stroke / (2 * sine)}};
  const Bound least[] = {{PiLimit::transmission, std::sin(r.transmission) / cosine}};
  // The range about the best centre ends at -pi/2 + margin when k cos(Delta) = cos(Delta + margin).
  const Bound most[] = {{PiLimit::telescoping, centred_ratio_limit(r.half_travel, r.telescoping)},
                        {PiLimit::ends, std::cos(r.half_travel + r.end_margin) / cosine}};
  PiClosedForm out;
  const auto collect = [&](std::span<const Bound> low, std::span<const Bound> high, bool of_ratio) {
    for (const Bound& l : low)
      for (const Bound& h : high)
        if (l.value > h.value * (1 + tolerance::feasibility))
          out.conflicts.push_back({l.limit, h.limit, of_ratio, l.value, h.value});
  };
  collect(smallest, largest, false);
  collect(least, most, true);
  if (!out.conflicts.empty()) return out;
  const double base = std::max(smallest[0].value, smallest[1].value);
  const double ratio = std::min(most[0].value, most[1].value);
  PiDesign design{.joint = {.arm = base / ratio, .ratio = ratio}};
  design.centre = best_centre(design.joint, r.half_travel);
  design.size = design.joint.arm + base;
  out.design = design;
  return out;
}

PiDesignReport design_pi_joint(const PiRequirements& requirements, const PiDesignOptions& options,
                               const optimise::Seed& seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(options.starts >= 0, "{} starts", options.starts);
  PiDesignReport report{.closed_form = closed_form_design(requirements)};
  const Task task(requirements);
  const auto cost = [](std::span<const double> x, std::span<double> gradient) {
    const Number value = Task::cost(x);
    std::copy_n(value.by.begin(), gradient.size(), gradient.begin());
    return value.value;
  };
  const auto constraints = [&](std::span<const double> x, std::span<double> values, std::span<double> by) {
    const auto found = task.values(x);
    for (std::size_t i = 0; i < found.size(); ++i) {
      values[i] = found[i].value;
      if (!by.empty()) std::copy_n(found[i].by.begin(), 3, by.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  };

  std::vector<PiDesign> ends;
  const auto search = [&](std::array<double, 3> x) {
    const auto local =
        optimise::minimise_local(cost, task.constraints(), constraints, x, task.lower(), task.upper(),
                                 {.max_evaluations = 300, .constraint_tolerance = 1e-11}, context);
    report.evaluations += local.evaluations;
    ends.push_back(task.design(x));
  };
  // Requirements may conflict about the best centre, and another one may still meet them.
  if (report.closed_form.design) {
    search(unknowns(*report.closed_form.design));
  } else {
    search({task.lower()[0] + 1, 0.5, 0});
  }
  for (int i = 0; i < options.starts && !context.interrupted(); ++i) {
    RandomStream random(
        {.seed = seed.seed, .run = seed.run, .generation = 0, .individual = static_cast<std::uint32_t>(i)});
    // Arms up to some fifty times what J must be.
    search({task.lower()[0] + random.uniform(0, 4), random.uniform(0.05, 1),
            random.uniform(task.lower()[2], task.upper()[2])});
  }

  report.best = *std::min_element(ends.begin(), ends.end(), better);
  if (const auto& closed = report.closed_form.design)
    if (report.best.violation > 0 || closed->size <= report.best.size * (1 + same_size)) {
      report.closed_form_is_best = true;
      report.best = *closed;
    }
  report.starts = static_cast<int>(ends.size());
  for (const PiDesign& end : ends)
    report.reached_best +=
        end.violation == report.best.violation && end.size <= report.best.size * (1 + same_size);
  if (report.best.violation > 0)
    report.status = Status::infeasible;
  else
    price(task, unknowns(report.best), report);
  if (const Status interruption = context.interruption(); interruption != Status::done)
    report.status = interruption;
  return report;
}

}  // namespace linkwright::parallel
