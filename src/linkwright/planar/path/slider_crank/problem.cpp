#include "linkwright/planar/path/slider_crank/problem.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"
#include "linkwright/planar/path/slider_crank/objective.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using P = SliderParameter;

bool is_link(std::size_t j) { return j == index(P::crank) || j == index(P::rod); }

void add_violation(SliderPathDesign& design, const char* reason, double amount) {
  if (amount > tolerance::feasibility || std::isnan(amount)) design.violations.push_back({reason, amount});
}

}  // namespace

std::string_view name(SliderParameter parameter) {
  constexpr std::string_view all[] = {"crank",  "rod",     "point_distance", "point_angle", "guide_angle",
                                      "offset", "pivot_x", "pivot_y",        "start_angle"};
  return all[index(parameter)];
}

void require_valid(const SliderPathProblem& p) {
  require_valid_targets(p);
  if (!p.free_timing) {
    LINKWRIGHT_REQUIRE(p.offsets.size() == p.x.size(), "{} angles for {} points", p.offsets.size(),
                       p.x.size());
    for (std::size_t k = 0; k < p.offsets.size(); ++k)
      LINKWRIGHT_REQUIRE(std::isfinite(p.offsets[k]), "angle {} is {}", k + 1, p.offsets[k]);
  }
  for (std::size_t j = 0; j < slider_parameter_count; ++j)
    LINKWRIGHT_REQUIRE(std::isfinite(p.bounds[j].lower) && std::isfinite(p.bounds[j].upper) &&
                           p.bounds[j].lower <= p.bounds[j].upper && (!is_link(j) || p.bounds[j].upper > 0) &&
                           (j != index(P::point_distance) || p.bounds[j].upper >= 0),
                       "bounds of {} are {} to {}", name(P(j)), p.bounds[j].lower, p.bounds[j].upper);
  LINKWRIGHT_REQUIRE(p.max_pressure_angle > 0 && p.max_pressure_angle <= pi / 2,
                     "the greatest pressure angle must be more than 0 and at most pi/2, got {}",
                     p.max_pressure_angle);
  LINKWRIGHT_REQUIRE(p.stroke.lower >= 0 && p.stroke.lower <= p.stroke.upper && p.stroke.upper > 0,
                     "the stroke is limited to {} to {}", p.stroke.lower, p.stroke.upper);
  LINKWRIGHT_REQUIRE(p.crank_rotates_fully || (p.stroke.lower == 0 && p.stroke.upper == infinity),
                     "the stroke is limited, but the crank need not rotate fully");
}

std::array<Range, slider_parameter_count> derive_slider_bounds(const std::vector<double>& x,
                                                               const std::vector<double>& y) {
  const auto [x0, x1] = std::minmax_element(x.begin(), x.end());
  const auto [y0, y1] = std::minmax_element(y.begin(), y.end());
  const double size = std::hypot(*x1 - *x0, *y1 - *y0), far = 50 * size;
  const double mx = 0.5 * (*x0 + *x1), my = 0.5 * (*y0 + *y1);
  const Range link{1e-3 * size, far}, turn{0, 2 * pi};
  return {link,
          link,
          Range{0, far},
          turn,
          turn,
          Range{-far, far},
          Range{mx - far, mx + far},
          Range{my - far, my + far},
          turn};
}

SliderCrankPose slider_crank_pose(const SliderCrankMechanism& m, double crank_angle) {
  const SliderCrankForm& f = m.parameters;
  SliderCrankPose out;
  const double phase = crank_angle - f.guide_angle;
  const double ax = f.crank * std::cos(phase), ay = f.crank * std::sin(phase);
  const Complex guide = std::polar(1.0, f.guide_angle), pivot(f.pivot_x, f.pivot_y);
  out.crank_pin = pivot + guide * Complex(ax, ay);
  const RodClosure<double> closure = close_rod(ay, f.offset, 1 / f.rod);
  const double gap = std::abs(f.offset - ay) - f.rod;
  if (gap > tolerance::closure * (f.rod + f.crank + std::abs(f.offset)) || !std::isfinite(gap)) {
    out.status = Status::no_assembly;
    out.gap = gap;
    out.slider = out.point = Complex(nan, nan);
    out.rod_angle = out.displacement = out.pressure_angle = nan;
    return out;
  }
  const Vec<double> v = rod_direction(closure, sign(m.branch));
  const Complex rod = guide * Complex(v.x, v.y);
  out.slider = out.crank_pin + f.rod * rod;
  out.point = out.crank_pin + Complex(f.rod_u, f.rod_v) * rod;
  out.rod_angle = std::arg(rod);
  out.displacement = ax + f.rod * v.x;
  out.pressure_angle = std::atan2(std::abs(v.y), std::abs(v.x));
  if (pi / 2 - out.pressure_angle < tolerance::toggle_angle) out.status = Status::singular;
  return out;
}

double rotation_margin(const SliderCrankForm& f) { return f.rod - f.crank - std::abs(f.offset); }

double stroke(const SliderCrankForm& f) {
  // An answer may rest on the limit.
  const double size = f.rod + f.crank + std::abs(f.offset);
  return rotation_margin(f) >= -tolerance::feasibility * size ? slider_stroke(f.crank, f.rod, f.offset) : nan;
}

double greatest_pressure_angle(const SliderCrankForm& f) {
  const double size = f.rod + f.crank + std::abs(f.offset);
  if (rotation_margin(f) < -tolerance::feasibility * size) return nan;
  return std::asin(std::min(1.0, (f.crank + std::abs(f.offset)) / f.rod));
}

double greatest_pressure_sine(const SliderCrankForm& f, double low, double high) {
  double greatest = 0;
  const auto at = [&](double crank_sine) {
    greatest = std::max(greatest, std::abs((f.offset - f.crank * crank_sine) / f.rod));
  };
  at(std::sin(low - f.guide_angle));
  at(std::sin(high - f.guide_angle));
  for (const double turn : {0.5 * pi, 1.5 * pi})
    if (2 * pi * std::floor((high - f.guide_angle - turn) / (2 * pi)) + turn >= low - f.guide_angle)
      at(turn < pi ? 1 : -1);
  return greatest;
}

std::array<double, slider_parameter_count> parameter_values(const SliderPathProblem& problem,
                                                            const SliderPathDesign& d) {
  const SliderCrankForm& f = d.mechanism.parameters;
  // The start angle of the design, whole turns and offsets of the problem taken away.
  const double start = problem.free_timing ? 0 : d.angles[0] - d.sense * problem.offsets[0];
  return {f.crank,
          f.rod,
          std::hypot(f.rod_u, f.rod_v),
          f.rod_u == 0 && f.rod_v == 0 ? 0 : std::atan2(f.rod_v, f.rod_u),
          f.guide_angle,
          f.offset,
          f.pivot_x,
          f.pivot_y,
          start};
}

SliderPathDesign measure(const SliderPathProblem& problem, const SliderCrankMechanism& mechanism,
                         double sense, std::vector<double> angles) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(angles.size() == problem.x.size(), "{} angles for {} points", angles.size(),
                     problem.x.size());
  const SliderCrankForm& f = mechanism.parameters;
  SliderPathDesign d;
  d.mechanism = mechanism;
  d.sense = sense;
  d.angles = std::move(angles);
  d.stroke = stroke(f);
  const double total = f.crank + f.rod + std::abs(f.offset);

  double gap = 0;
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const SliderCrankPose pose = slider_crank_pose(mechanism, d.angles[k]);
    gap = std::max(gap, pose.gap);
    const TargetMiss miss = target_miss(problem, k, pose.point.real(), pose.point.imag());
    const double square = miss.x * miss.x + miss.y * miss.y;
    d.error += std::isnan(square) ? infinity : square;
  }
  // Whatever the tolerance of the other constraints: an error that does not exist is never feasible.
  if (!std::isfinite(d.error)) d.violations.push_back({"no_assembly", gap > 0 ? gap / total : 1});
  if (problem.crank_rotates_fully) add_violation(d, "crank_rotates_fully", -rotation_margin(f) / total);
  if (problem.max_pressure_angle < pi / 2) {
    double sine = (f.crank + std::abs(f.offset)) / f.rod;
    if (!problem.crank_rotates_fully) {
      const auto [low, high] = std::minmax_element(d.angles.begin(), d.angles.end());
      sine = greatest_pressure_sine(f, *low, *high);
    }
    add_violation(d, "pressure_angle", sine - std::sin(problem.max_pressure_angle));
  }
  if (problem.stroke.lower > 0 || problem.stroke.upper < infinity) {
    const double outside = std::max(d.stroke - problem.stroke.upper, problem.stroke.lower - d.stroke);
    add_violation(d, "stroke", std::isnan(d.stroke) ? 1 : outside / path_size(problem));
  }
  if (problem.free_timing) add_violation(d, "order", out_of_order(d.angles, sense));

  const auto values = parameter_values(problem, d);
  double out_of_bounds = 0;
  for (std::size_t j = 0; j < slider_parameter_count; ++j) {
    if (problem.free_timing && P(j) == P::start_angle) continue;
    if (P(j) == P::point_angle && values[index(P::point_distance)] == 0) continue;
    const Range& range = problem.bounds[j];
    double value = is_angle(P(j)) ? math::into_range(values[j], range.lower, range.upper) : values[j];
    // A fixed angle is met from both sides.
    if (is_angle(P(j)) && range.fixed()) value = range.lower + math::wrap_angle(values[j] - range.lower);
    const double width = range.fixed() ? std::max(1.0, std::abs(range.lower)) : range.upper - range.lower;
    out_of_bounds = std::max({out_of_bounds, (range.lower - value) / width, (value - range.upper) / width});
    const double near = tolerance::active_bound * width;
    if (!range.fixed() && !(is_angle(P(j)) && width >= 2 * pi * (1 - 1e-9)) &&
        (value <= range.lower + near || value >= range.upper - near))
      d.active_bounds.emplace_back(name(P(j)));
  }
  add_violation(d, "bounds", out_of_bounds);
  return d;
}

double total_violation(const SliderPathDesign& design) {
  double sum = 0;
  for (const auto& violation : design.violations) sum += violation.amount;
  return sum;
}

SliderCrankMechanism forward_form(SliderCrankMechanism m) {
  if (m.branch == SliderSide::forward) return m;
  m.branch = SliderSide::forward;
  m.parameters.offset = -m.parameters.offset;
  m.parameters.guide_angle = math::wrap_angle(m.parameters.guide_angle + pi);
  return m;
}

bool same_mechanism(const SliderCrankMechanism& first, const SliderCrankMechanism& second) {
  const SliderCrankForm a = forward_form(first).parameters, b = forward_form(second).parameters;
  const double size = std::max(a.crank + a.rod, b.crank + b.rod);
  const double turn = math::wrap_angle(a.guide_angle - b.guide_angle);
  const double difference[] = {a.crank - b.crank, a.rod - b.rod,        a.offset - b.offset,
                               a.rod_u - b.rod_u, a.rod_v - b.rod_v,    a.pivot_x - b.pivot_x,
                               turn * size,       a.pivot_y - b.pivot_y};
  return std::all_of(std::begin(difference), std::end(difference),
                     [&](double d) { return std::abs(d) <= tolerance::same_design * size; });
}

void rank(std::vector<SliderPathDesign>& designs) {
  std::stable_sort(designs.begin(), designs.end(), [](const SliderPathDesign& a, const SliderPathDesign& b) {
    return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
  });
}

SliderCrankMechanism slider_crank_cognate(const SliderCrankMechanism& m, double crank_angle) {
  const SliderCrankForm& f = m.parameters;
  const Complex point(f.rod_u, f.rod_v);
  LINKWRIGHT_REQUIRE(point != 0.0, "the tracing point is the crank pin: there is no cognate");
  // C = O + crank + arm = O + arm + crank: the parallelogram O-A-C-A'. The slider of the cognate is carried
  // by the triangle A'-C-B', similar to the original's A-B-C, so its guide is the original's, turned and
  // scaled by lambda = A->C over A->B.
  const Complex lambda = point / f.rod;
  SliderCrankMechanism out;
  out.parameters = {.crank = std::abs(point),
                    .rod = std::abs(lambda) * f.crank,
                    .offset = std::abs(lambda) * f.offset,
                    .guide_angle = math::wrap_angle(f.guide_angle + std::arg(lambda)),
                    .pivot_x = f.pivot_x,
                    .pivot_y = f.pivot_y};
  const Complex arm = std::conj(lambda) / std::abs(lambda) * f.crank;
  out.parameters.rod_u = arm.real();
  out.parameters.rod_v = arm.imag();
  // The rod of the cognate goes with the crank of the original.
  out.branch = std::cos(crank_angle - f.guide_angle) >= 0 ? SliderSide::forward : SliderSide::backward;
  return out;
}

PathErrors path_errors(const SliderPathProblem& problem, const SliderPathDesign& design) {
  std::vector<Complex> reached;
  for (const double angle : design.angles)
    reached.push_back(slider_crank_pose(design.mechanism, angle).point);
  return path_errors(problem, reached);
}

namespace {

optimise::Problem population_problem(const SliderPathProblem& problem, SliderSide side, double sense,
                                     const SliderPathScales* scales) {
  require_valid(problem);
  optimise::Problem out;
  const std::size_t count = slider_parameter_count - (problem.free_timing ? 1 : 0);
  for (std::size_t j = 0; j < count; ++j)
    out.variables.push_back({std::string(name(P(j))) + (is_angle(P(j)) ? "_rad" : "_m"),
                             problem.bounds[j].lower, problem.bounds[j].upper});
  if (problem.free_timing)
    for (std::size_t k = 0; k < problem.x.size(); ++k)
      out.variables.push_back({"crank_angle_" + std::to_string(k + 1) + "_rad", 0, 2 * pi});
  SliderPathObjective laid_out = slider_path_objective(problem, side, sense);
  if (scales) {
    out.objectives = 2;
    laid_out.with_stroke = true;
    laid_out.scales = *scales;
  }
  const auto objective = std::make_shared<const SliderPathObjective>(std::move(laid_out));
  out.evaluate = [objective](const optimise::PopulationView& candidates, std::span<double> cost,
                             std::span<double> violation) {
    evaluate(*objective, candidates, cost, violation);
  };
  out.explain = [problem, side, sense](std::span<const double> x) {
    return slider_path_design(problem, side, sense, x).violations;
  };
  return out;
}

}  // namespace

optimise::Problem slider_path_population_problem(const SliderPathProblem& problem, SliderSide side,
                                                 double sense) {
  return population_problem(problem, side, sense, nullptr);
}

optimise::Problem slider_path_front_problem(const SliderPathProblem& problem, SliderSide side, double sense,
                                            const SliderPathScales& scales) {
  LINKWRIGHT_REQUIRE(problem.crank_rotates_fully, "the stroke is that of a full turn");
  LINKWRIGHT_REQUIRE(scales.error > 0 && scales.stroke > 0, "scales are {} and {}", scales.error,
                     scales.stroke);
  return population_problem(problem, side, sense, &scales);
}

SliderPathDesign slider_path_design(const SliderPathProblem& problem, SliderSide side, double sense,
                                    std::span<const double> x) {
  const std::size_t points = problem.x.size(), first = index(P::start_angle);
  const std::size_t expected = problem.free_timing ? first + points : slider_parameter_count;
  LINKWRIGHT_REQUIRE(x.size() == expected, "{} values for {} variables", x.size(), expected);
  // A link of length zero is allowed by the published bounds; it is no linkage, so it becomes the smallest.
  const auto value = [&](P j) { return x[index(j)]; };
  const Complex point = std::polar(1.0, value(P::point_angle)) * value(P::point_distance);
  const SliderCrankMechanism mechanism{.branch = side,
                                       .parameters = {.crank = std::max(value(P::crank), shortest_link),
                                                      .rod = std::max(value(P::rod), shortest_link),
                                                      .offset = value(P::offset),
                                                      .guide_angle = value(P::guide_angle),
                                                      .pivot_x = value(P::pivot_x),
                                                      .pivot_y = value(P::pivot_y),
                                                      .rod_u = point.real(),
                                                      .rod_v = point.imag()},
                                       .masses = {}};
  std::vector<double> angles(points);
  for (std::size_t k = 0; k < points; ++k) {
    if (!problem.free_timing) {
      angles[k] = x[first] + sense * problem.offsets[k];
    } else {
      // Unwrapped: each angle is the next one in the sense of rotation.
      const double step = k == 0 ? 0 : sense * (x[first + k] - x[first + k - 1]);
      angles[k] = k == 0 ? x[first] : angles[k - 1] + sense * (step - 2 * pi * std::floor(step / (2 * pi)));
    }
  }
  return measure(problem, mechanism, sense, std::move(angles));
}

}  // namespace linkwright::planar
