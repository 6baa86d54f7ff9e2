#include "linkwright/planar/path/four_bar/problem.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/path/four_bar/objective.h"
#include "linkwright/planar/path/targets.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t start_index = index(FourBarParameter::start_angle);

bool is_angle(std::size_t parameter) { return parameter >= index(FourBarParameter::frame_angle); }

std::array<double, four_bar_parameter_count> parameters(const FourBar& l, double start) {
  return {l.ground,    l.crank,   l.coupler, l.rocker,      l.coupler_u,
          l.coupler_v, l.pivot_x, l.pivot_y, l.frame_angle, start};
}

void add_violation(PathDesign& design, const char* reason, double amount) {
  if (amount > tolerance::feasibility || std::isnan(amount)) design.violations.push_back({reason, amount});
}

}  // namespace

std::string_view name(FourBarParameter parameter) {
  static const auto all = [] {
    std::array<std::string_view, four_bar_parameter_count> keys;
    std::size_t j = 0;
    FourBar numbers;
    fields([&](const Field& field, double&) { keys[j++] = field.key; }, numbers);
    keys[j] = "start_angle";
    return keys;
  }();
  return all[index(parameter)];
}

void require_valid(const PathProblem& p) {
  require_valid_targets(p);
  if (p.timing == Timing::given || p.timing == Timing::increments) {
    LINKWRIGHT_REQUIRE(p.angles.size() == p.x.size(), "{} angles for {} points", p.angles.size(), p.x.size());
    for (std::size_t k = 0; k < p.angles.size(); ++k)
      LINKWRIGHT_REQUIRE(std::isfinite(p.angles[k]), "angle {} is {}", k + 1, p.angles[k]);
  }
  if (p.timing == Timing::equal_steps)
    LINKWRIGHT_REQUIRE(p.step != 0 && std::isfinite(p.step), "the step must not be zero, got {}", p.step);
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j)
    LINKWRIGHT_REQUIRE(std::isfinite(p.bounds[j].lower) && std::isfinite(p.bounds[j].upper) &&
                           p.bounds[j].lower <= p.bounds[j].upper &&
                           (j > index(FourBarParameter::rocker) || p.bounds[j].upper > 0),
                       "bounds of {} are {} to {}", name(FourBarParameter(j)), p.bounds[j].lower,
                       p.bounds[j].upper);
  LINKWRIGHT_REQUIRE(p.min_transmission_angle >= 0 && p.min_transmission_angle < pi / 2,
                     "the minimum transmission angle must be at least 0 and less than pi/2, got {}",
                     p.min_transmission_angle);
  if (p.packaging)
    LINKWRIGHT_REQUIRE(std::isfinite(p.packaging->x_min) && std::isfinite(p.packaging->x_max) &&
                           std::isfinite(p.packaging->y_min) && std::isfinite(p.packaging->y_max) &&
                           p.packaging->x_min <= p.packaging->x_max &&
                           p.packaging->y_min <= p.packaging->y_max,
                       "the packaging box is {} to {} by {} to {}", p.packaging->x_min, p.packaging->x_max,
                       p.packaging->y_min, p.packaging->y_max);
  if (p.rocker_pivot)
    LINKWRIGHT_REQUIRE(
        p.rocker_pivot->x_min <= p.rocker_pivot->x_max && p.rocker_pivot->y_min <= p.rocker_pivot->y_max,
        "the box of the rocker pivot is {} to {} by {} to {}", p.rocker_pivot->x_min, p.rocker_pivot->x_max,
        p.rocker_pivot->y_min, p.rocker_pivot->y_max);
  LINKWRIGHT_REQUIRE(p.least_step > 0 && p.least_step < 2 * pi, "the least step is {}", p.least_step);
}

std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x,
                                                          const std::vector<double>& y) {
  const auto [x0, x1] = std::minmax_element(x.begin(), x.end());
  const auto [y0, y1] = std::minmax_element(y.begin(), y.end());
  const double size = std::hypot(*x1 - *x0, *y1 - *y0), far = 50 * size;
  const double mx = 0.5 * (*x0 + *x1), my = 0.5 * (*y0 + *y1);
  const Range link{1e-3 * size, far}, point{-far, far}, turn{0, 2 * pi};
  return {link, link, link, link, point, point, Range{mx - far, mx + far}, Range{my - far, my + far},
          turn, turn};
}

double point_angle(const PathProblem& p, std::size_t k) {
  switch (p.timing) {
    case Timing::free:
      return 0;
    case Timing::equal_steps:
      return p.step * static_cast<double>(k);
    case Timing::increments:
    case Timing::given:
      return p.angles[k];
  }
  return 0;
}

PathDesign measure(const PathProblem& problem, const FourBar& linkage, double sense,
                   std::vector<double> angles) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(angles.size() == problem.x.size(), "{} angles for {} points", angles.size(),
                     problem.x.size());
  PathDesign d;
  d.linkage = linkage;
  d.sense = sense;
  d.angles = std::move(angles);
  const double total = linkage.ground + linkage.crank + linkage.coupler + linkage.rocker;

  double gap = 0;
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const FourBarPosition pose = position(linkage, d.angles[k]);
    gap = std::max(gap, pose.gap);
    const TargetMiss miss = target_miss(problem, k, pose.coupler_point.real(), pose.coupler_point.imag());
    const double square = miss.x * miss.x + miss.y * miss.y;
    d.error += std::isnan(square) ? infinity : square;
  }
  // Whatever the tolerance of the other constraints: an error that does not exist is never feasible.
  if (!std::isfinite(d.error)) d.violations.push_back({"no_assembly", gap > 0 ? gap / total : 1});
  if (problem.crank_rotates_fully)
    add_violation(d, "crank_rotates_fully", -classify(linkage).crank_margin / total);
  if (problem.min_transmission_angle > 0) {
    TransmissionAngles mu;
    if (problem.crank_rotates_fully) {
      mu = transmission_angles(linkage);
    } else {
      const auto [low, high] = std::minmax_element(d.angles.begin(), d.angles.end());
      mu = transmission_angles(linkage, *low, *high);
    }
    add_violation(d, "transmission_angle", std::cos(mu.minimum) - std::cos(problem.min_transmission_angle));
  }
  if (problem.timing == Timing::free) add_violation(d, "order", out_of_order(d.angles, sense));
  const auto outside = [&](const PackagingBox& box, const std::complex<double>& pivot) {
    return (std::max({0.0, box.x_min - pivot.real(), pivot.real() - box.x_max}) +
            std::max({0.0, box.y_min - pivot.imag(), pivot.imag() - box.y_max})) /
           path_size(problem);
  };
  if (problem.packaging)
    add_violation(d, "packaging",
                  outside(*problem.packaging, crank_pivot(linkage)) +
                      outside(*problem.packaging, rocker_pivot(linkage)));
  if (problem.rocker_pivot)
    add_violation(d, "rocker_pivot", outside(*problem.rocker_pivot, rocker_pivot(linkage)));

  const auto values = parameters(linkage, starts_anywhere(problem.timing) ? d.angles[0] : 0.0);
  double out_of_bounds = 0;
  const std::size_t count = starts_anywhere(problem.timing) ? four_bar_parameter_count : start_index;
  for (std::size_t j = 0; j < count; ++j) {
    const Range& range = problem.bounds[j];
    const double value = is_angle(j) ? math::into_range(values[j], range.lower, range.upper) : values[j];
    const double width = range.fixed() ? std::max(1.0, std::abs(range.lower)) : range.upper - range.lower;
    out_of_bounds = std::max({out_of_bounds, (range.lower - value) / width, (value - range.upper) / width});
    const double near = tolerance::active_bound * width;
    if (!range.fixed() && !(is_angle(j) && width >= 2 * pi * (1 - 1e-9)) &&
        (value <= range.lower + near || value >= range.upper - near))
      d.active_bounds.emplace_back(name(FourBarParameter(j)));
  }
  add_violation(d, "bounds", out_of_bounds);
  return d;
}

bool same_linkage(const FourBar& a, const FourBar& b) {
  if (a.branch != b.branch) return false;
  const double size =
      std::max(a.ground + a.crank + a.coupler + a.rocker, b.ground + b.crank + b.coupler + b.rocker);
  const double difference[] = {a.ground - b.ground,   a.crank - b.crank,         a.coupler - b.coupler,
                               a.rocker - b.rocker,   a.coupler_u - b.coupler_u, a.coupler_v - b.coupler_v,
                               a.pivot_x - b.pivot_x, a.pivot_y - b.pivot_y};
  for (double d : difference)
    if (std::abs(d) > tolerance::same_design * size) return false;
  return true;
}

double total_violation(const PathDesign& design) {
  double sum = 0;
  for (const auto& violation : design.violations) sum += violation.amount;
  return sum;
}

void rank(std::vector<PathDesign>& designs) {
  std::stable_sort(designs.begin(), designs.end(), [](const PathDesign& a, const PathDesign& b) {
    return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
  });
  for (std::size_t i = 0; i + 1 < designs.size(); ++i) {
    const double difference = designs[i + 1].error - designs[i].error;
    if (difference <= tolerance::equal_cost * designs[i].error &&
        designs[i].linkage.branch == Branch::crossed && designs[i + 1].linkage.branch == Branch::open)
      std::swap(designs[i], designs[i + 1]);
  }
}

PathErrors path_errors(const PathProblem& problem, const PathDesign& design) {
  std::vector<std::complex<double>> reached;
  for (const double angle : design.angles) {
    const FourBarPosition pose = position(design.linkage, angle);
    reached.push_back(pose.status != Status::no_assembly ? pose.coupler_point
                                                         : std::complex<double>(nan, nan));
  }
  return path_errors(problem, reached);
}

optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense) {
  require_valid(problem);
  optimise::Problem out;
  const std::size_t count = starts_anywhere(problem.timing) ? four_bar_parameter_count : start_index;
  for (std::size_t j = 0; j < count; ++j)
    out.variables.push_back({std::string(name(FourBarParameter(j))) + (is_angle(j) ? "_rad" : "_m"),
                             problem.bounds[j].lower, problem.bounds[j].upper});
  if (problem.timing == Timing::free)
    for (std::size_t k = 0; k < problem.x.size(); ++k)
      out.variables.push_back({"crank_angle_" + std::to_string(k + 1) + "_rad", 0, 2 * pi});
  const auto objective = std::make_shared<const PathObjective>(path_objective(problem, branch, sense));
  out.evaluate = [objective](const optimise::PopulationView& candidates, std::span<double> cost,
                             std::span<double> violation) {
    evaluate(*objective, candidates, cost, violation);
  };
  out.explain = [problem, branch, sense](std::span<const double> x) {
    return path_design(problem, branch, sense, x).violations;
  };
  return out;
}

PathDesign path_design(const PathProblem& problem, Branch branch, double sense, std::span<const double> x) {
  const std::size_t points = problem.x.size();
  const std::size_t expected = starts_anywhere(problem.timing)   ? four_bar_parameter_count
                               : problem.timing == Timing::given ? start_index
                                                                 : start_index + points;
  LINKWRIGHT_REQUIRE(x.size() == expected, "{} values for {} variables", x.size(), expected);
  // A link of length zero is allowed by the published bounds; it is no linkage, so it becomes the smallest
  // one.
  const auto value = [&](FourBarParameter j) { return x[index(j)]; };
  const auto length = [&](FourBarParameter j) { return std::max(value(j), shortest_link); };
  const FourBar linkage{.ground = length(FourBarParameter::ground),
                        .crank = length(FourBarParameter::crank),
                        .coupler = length(FourBarParameter::coupler),
                        .rocker = length(FourBarParameter::rocker),
                        .coupler_u = value(FourBarParameter::coupler_u),
                        .coupler_v = value(FourBarParameter::coupler_v),
                        .pivot_x = value(FourBarParameter::pivot_x),
                        .pivot_y = value(FourBarParameter::pivot_y),
                        .frame_angle = value(FourBarParameter::frame_angle),
                        .branch = branch};
  std::vector<double> angles(points);
  for (std::size_t k = 0; k < points; ++k) {
    if (problem.timing != Timing::free) {
      angles[k] = (starts_anywhere(problem.timing) ? x[start_index] : 0.0) + sense * point_angle(problem, k);
    } else {
      // Unwrapped: each angle is the next one in the sense of rotation.
      const double step = k == 0 ? 0 : sense * (x[start_index + k] - x[start_index + k - 1]);
      angles[k] =
          k == 0 ? x[start_index] : angles[k - 1] + sense * (step - 2 * pi * std::floor(step / (2 * pi)));
    }
  }
  return measure(problem, linkage, sense, std::move(angles));
}

}  // namespace linkwright::planar
