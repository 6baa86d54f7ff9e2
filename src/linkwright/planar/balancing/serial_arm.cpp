// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/serial_arm.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <utility>
#include <variant>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/balancing/linear_forces.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

double sample_time(const ArmTask& task, int i) { return task.start + task.duration * i / task.intervals; }

std::vector<math::Motion> motion_of(const ArmTask& task) {
  std::vector<math::MotionCurve> curves;
  for (const math::MotionLaw& law : task.laws) curves.emplace_back(law);
  std::vector<math::Motion> out;
  for (int i = 0; i <= task.intervals; ++i)
    for (const math::MotionCurve& curve : curves) out.push_back(curve(sample_time(task, i)));
  return out;
}

Complex ray(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Written out: products of std::complex take care of infinities that cannot be here.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// e'' of a link, the second derivative of its direction.
Complex swing_of(const math::Motion& m, const Complex& direction) {
  return times({-m.rate * m.rate, m.acceleration}, direction);
}

struct Unknowns {
  std::size_t links = 0, per_law = 0;  // free coefficients of each law
  std::size_t laws() const { return links * per_law; }
};
Unknowns unknowns(const ArmTask& task, const ArmDesign& design) {
  return {task.arm.links.size(), static_cast<std::size_t>(design.degree - 5)};
}

std::vector<PointMass> placed(const ArmDesign& design, std::span<const double> x) {
  std::vector<PointMass> out;
  std::size_t j = 0;
  for (const Counterweight& w : design.counterweights) {
    const double mass = x[j++];
    out.push_back({mass, w.radius.fixed() ? w.radius.lower : x[j++], *w.angle});
  }
  return out;
}

// The cost with all that does not change: linear in the free coefficients are the angles, and through the
// first moments S_kj of the chain, linear in the counterweights, the forces R_k = sum over j of S_kj e_j'' +
// i g M_k.
class ArmCost {
 public:
  ArmCost(const ArmTask& task, const ArmDesign& design);
  double operator()(std::span<const double> x, std::span<double> gradient, double smoothing) const;
  std::vector<optimise::Variable> variables() const;
  // a_3, a_4, a_5 of each law within their bound, as values that are <= 0; rows of the constant Jacobian.
  std::size_t limits() const { return unknowns_.per_law > 1 ? 6 * unknowns_.links : 0; }
  void limit_values(std::span<const double> x, std::span<double> values, std::span<double> jacobian) const;
  std::size_t size() const { return size_; }
  double scale() const { return scale_; }

 private:
  ArmTask task_;
  ArmDesign design_;
  Unknowns unknowns_;
  std::vector<ArmElement> elements_;
  std::size_t size_ = 0, samples_ = 0;
  std::vector<double> stroke_;
  std::vector<math::Motion> base_;    // sample by sample, all links
  std::vector<Complex> swing_;        // positions of those
  std::vector<math::Motion> higher_;  // sample by sample, all free coefficients, of a stroke of 1
  std::vector<double> end_terms_;     // a_3, a_4, a_5 by each free coefficient; in front those without any
  double factor_ = 1, scale_ = 1;
};

ArmCost::ArmCost(const ArmTask& task, const ArmDesign& design)
    : task_(task), design_(design), unknowns_(unknowns(task, design)), elements_(elements(task.arm)) {
  require_valid(task, design);
  const auto n = static_cast<double>(task.intervals);
  factor_ = task.measure == Measure::rms ? 1 / std::sqrt(n + 1) : 1 / n;
  samples_ = static_cast<std::size_t>(task.intervals) + 1;
  if (unknowns_.per_law > 0) {
    for (std::size_t p = 0; p <= unknowns_.per_law; ++p) {
      math::Polynomial345 law;
      law.higher.assign(p, 0.0);
      if (p > 0) law.higher.back() = 1;
      const std::vector<double> c = coefficients(law);
      for (std::size_t q = 0; q < 3; ++q) end_terms_.push_back(c[3 + q] - (p > 0 ? end_terms_[q] : 0));
    }
    for (math::MotionLaw& law : task_.laws) {
      auto& own = std::get<math::Polynomial345>(law);
      own.higher.clear();
      stroke_.push_back(own.to - own.from);
    }
    // At the times of each law: strokes of 1 with and without the coefficient.
    higher_.resize(samples_ * unknowns_.laws());
    for (std::size_t j = 0; j < unknowns_.links; ++j)
      for (std::size_t p = 0; p < unknowns_.per_law; ++p) {
        math::Polynomial345 law = std::get<math::Polynomial345>(task_.laws[j]);
        law.from = 0, law.to = 1;
        const math::MotionCurve without{math::MotionLaw(law)};
        law.higher.assign(p + 1, 0.0);
        law.higher.back() = 1;
        const math::MotionCurve with{math::MotionLaw(law)};
        for (std::size_t i = 0; i < samples_; ++i) {
          const double t = sample_time(task_, static_cast<int>(i));
          const math::Motion a = with(t), b = without(t);
          higher_[i * unknowns_.laws() + j * unknowns_.per_law + p] = {a.value - b.value, a.rate - b.rate,
                                                                       a.acceleration - b.acceleration, 0};
        }
      }
  }
  base_ = motion_of(task_);
  for (const math::Motion& m : base_) swing_.push_back(swing_of(m, ray(m.value)));
  size_ = unknowns_.laws();
  for (const Counterweight& w : design.counterweights) size_ += w.radius.fixed() ? 1 : 2;
  // The size of the cost before anything is chosen.
  std::vector<double> still(size_, 0.0);
  scale_ = std::max((*this)(still, {}, 0), 1e-300);
}

double ArmCost::operator()(std::span<const double> x, std::span<double> gradient, double smoothing) const {
  const std::size_t n = unknowns_.links, per_law = unknowns_.per_law, laws = unknowns_.laws();
  const std::vector<PointMass> weights = placed(design_, x.subspan(laws));
  std::vector<BaseParameters> base(n);
  std::vector<Complex> rays;
  for (std::size_t j = 0; j < n; ++j) base[j] = elements_[j].base;
  for (std::size_t w = 0; w < weights.size(); ++w) {
    BaseParameters& b = base[design_.counterweights[w].link];
    b.mass += weights[w].mass;
    rays.push_back(ray(weights[w].angle));
    b.moment += weights[w].mass * weights[w].distance * rays[w];
  }
  std::vector<double> outer(n + 1, 0.0);  // mass from link k outwards
  for (std::size_t k = n; k-- > 0;) outer[k] = outer[k + 1] + base[k].mass;
  const auto length = [&](std::size_t j) { return elements_[j].length; };
  const auto moment = [&](std::size_t k, std::size_t j) {
    return j < k ? Complex(length(j) * outer[k]) : base[j].moment + length(j) * outer[j + 1];
  };

  std::vector<double> squares(n, 0.0), slopes(gradient.empty() ? 0 : n * size_, 0.0);
  std::vector<Complex> swing(n), by_coefficient(laws);  // e_j'', and its derivative
  for (std::size_t i = 0; i < samples_; ++i) {
    const math::Motion* higher = higher_.data() + i * laws;
    for (std::size_t j = 0; j < n; ++j) {
      math::Motion m = base_[i * n + j];
      for (std::size_t p = 0; p < per_law; ++p) {
        const double a = x[j * per_law + p] * stroke_[j];
        const math::Motion& h = higher[j * per_law + p];
        m.value += a * h.value, m.rate += a * h.rate, m.acceleration += a * h.acceleration;
      }
      if (per_law == 0) {
        swing[j] = swing_[i * n + j];
        continue;
      }
      const Complex direction = ray(m.value);
      swing[j] = swing_of(m, direction);
      for (std::size_t p = 0; p < per_law; ++p) {
        const math::Motion& h = higher[j * per_law + p];
        by_coefficient[j * per_law + p] =
            stroke_[j] *
            (times({-2 * m.rate * h.rate, h.acceleration}, direction) + times({0, h.value}, swing[j]));
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      Complex force(0, task_.gravity * outer[k]);
      for (std::size_t j = 0; j < n; ++j) force += times(moment(k, j), swing[j]);
      squares[k] += std::norm(force);
      if (gradient.empty()) continue;
      double* slope = slopes.data() + k * size_;
      const auto add = [&](std::size_t unknown, const Complex& derivative) {
        slope[unknown] += force.real() * derivative.real() + force.imag() * derivative.imag();
      };
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t p = 0; p < per_law; ++p)
          add(j * per_law + p, times(moment(k, j), by_coefficient[j * per_law + p]));
      std::size_t unknown = laws;
      for (std::size_t w = 0; w < weights.size(); ++w) {
        const std::size_t link = design_.counterweights[w].link;
        const bool carried = link >= k;  // by joint k
        const Complex along = carried ? times(rays[w], swing[link]) : Complex(0);
        Complex by_mass = weights[w].distance * along;
        if (carried) by_mass += Complex(0, task_.gravity);
        for (std::size_t j = 0; j < n && carried; ++j)
          if (j < link) by_mass += length(j) * swing[j];
        add(unknown++, by_mass);
        if (!design_.counterweights[w].radius.fixed()) add(unknown++, weights[w].mass * along);
      }
    }
  }
  double cost = 0;
  std::fill(gradient.begin(), gradient.end(), 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const double norm = std::sqrt(squares[k] + smoothing * smoothing);
    cost += task_.weights[k] * factor_ * norm;
    if (norm > 0)
      for (std::size_t j = 0; j < gradient.size(); ++j)
        gradient[j] += task_.weights[k] * factor_ * slopes[k * size_ + j] / norm;
  }
  return cost;
}

std::vector<optimise::Variable> ArmCost::variables() const {
  std::vector<optimise::Variable> out;
  const double most = design_.largest_coefficient;
  for (std::size_t j = 0; j < unknowns_.links; ++j)
    for (std::size_t p = 0; p < unknowns_.per_law; ++p) {
      Range range{-most, most};
      // The bounds of the other coefficients are bounds of a single free coefficient.
      for (std::size_t q = 0; q < 3 && unknowns_.per_law == 1; ++q) {
        const double at_zero = end_terms_[q], slope = end_terms_[3 + q];
        const double a = (-most - at_zero) / slope, b = (most - at_zero) / slope;
        range = {std::max(range.lower, std::min(a, b)), std::min(range.upper, std::max(a, b))};
      }
      out.push_back({fmt::format("a{}_{}", p + 6, j + 1), range.lower, range.upper});
    }
  for (const Counterweight& w : design_.counterweights) {
    out.push_back({w.name + "_mass_kg", w.mass.lower, w.mass.upper});
    if (!w.radius.fixed()) out.push_back({w.name + "_radius_m", w.radius.lower, w.radius.upper});
  }
  return out;
}

void ArmCost::limit_values(std::span<const double> x, std::span<double> values,
                           std::span<double> jacobian) const {
  const double most = design_.largest_coefficient;
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  std::size_t row = 0;
  for (std::size_t j = 0; j < unknowns_.links; ++j)
    for (std::size_t q = 0; q < 3; ++q) {
      double a = end_terms_[q];
      for (std::size_t p = 0; p < unknowns_.per_law; ++p)
        a += end_terms_[3 * (p + 1) + q] * x[j * unknowns_.per_law + p];
      for (const double sign : {1.0, -1.0}) {
        values[row] = sign * a / most - 1;
        for (std::size_t p = 0; p < unknowns_.per_law && !jacobian.empty(); ++p)
          jacobian[row * size_ + j * unknowns_.per_law + p] = sign * end_terms_[3 * (p + 1) + q] / most;
        ++row;
      }
    }
}

}  // namespace

void require_valid(const ArmTask& task, const ArmDesign& design) {
  const std::size_t n = task.arm.links.size();
  LINKWRIGHT_REQUIRE(task.laws.size() == n && task.weights.size() == n, "{} laws and {} weights for {} links",
                     task.laws.size(), task.weights.size(), n);
  LINKWRIGHT_REQUIRE(task.intervals >= 2, "needs at least 2 intervals, got {}", task.intervals);
  LINKWRIGHT_REQUIRE(task.duration > 0 && std::isfinite(task.duration), "duration {} s must be more than 0",
                     task.duration);
  LINKWRIGHT_REQUIRE(properties(task.measure).quadratic,
                     "measure {}: the cost of an arm takes rss_over_n or rms", name_of(task.measure));
  double sum = 0;
  for (const double w : task.weights) {
    LINKWRIGHT_REQUIRE(w >= 0 && std::isfinite(w), "weight {} must not be negative", w);
    sum += w;
  }
  LINKWRIGHT_REQUIRE(sum > 0, "all weights are 0");
  LINKWRIGHT_REQUIRE(design.degree >= 5 && design.degree <= 20, "degree {} must be from 5 to 20",
                     design.degree);
  LINKWRIGHT_REQUIRE(design.largest_coefficient > 15 && std::isfinite(design.largest_coefficient),
                     "largest coefficient {} must be more than 15, that of the law of degree 5",
                     design.largest_coefficient);
  for (std::size_t k = 0; k < n && design.degree > 5; ++k)
    LINKWRIGHT_REQUIRE(std::holds_alternative<math::Polynomial345>(task.laws[k]),
                       "law {} is not a polynomial 3-4-5, degree {} has no meaning for it", k + 1,
                       design.degree);
  for (const Counterweight& w : design.counterweights) {
    LINKWRIGHT_REQUIRE(w.link < n, "counterweight '{}' on link {} of {}", w.name, w.link, n);
    LINKWRIGHT_REQUIRE(w.angle && std::isfinite(*w.angle), "counterweight '{}' needs an angle", w.name);
    for (const Range& r : {w.mass, w.radius})
      LINKWRIGHT_REQUIRE(r.lower >= 0 && r.lower <= r.upper && std::isfinite(r.upper),
                         "counterweight '{}': {} to {} must be ordered and not negative", w.name, r.lower,
                         r.upper);
  }
  LINKWRIGHT_REQUIRE(design.degree > 5 || !design.counterweights.empty(),
                     "there is nothing to choose: raise the degree or add a counterweight");
}

ArmTask designed(const ArmTask& task, const ArmDesign& design, std::span<const double> x) {
  const Unknowns u = unknowns(task, design);
  ArmTask out = task;
  for (std::size_t j = 0; j < u.links && u.per_law > 0; ++j)
    std::get<math::Polynomial345>(out.laws[j])
        .higher.assign(x.begin() + static_cast<std::ptrdiff_t>(j * u.per_law),
                       x.begin() + static_cast<std::ptrdiff_t>((j + 1) * u.per_law));
  const std::vector<PointMass> weights = placed(design, x.subspan(u.laws()));
  for (std::size_t w = 0; w < weights.size(); ++w)
    out.arm.links[design.counterweights[w].link].attached.push_back(weights[w]);
  return out;
}

double arm_cost(const ArmTask& task, const ArmDesign& design, std::span<const double> x,
                std::span<double> gradient, double smoothing) {
  const ArmCost cost(task, design);
  LINKWRIGHT_REQUIRE(x.size() == cost.size() && (gradient.empty() || gradient.size() == x.size()),
                     "{} numbers and {} derivatives for {} unknowns", x.size(), gradient.size(), cost.size());
  return cost(x, gradient, smoothing);
}

optimise::Problem arm_problem(const ArmTask& task, const ArmDesign& design) {
  const auto cost = std::make_shared<const ArmCost>(task, design);
  const auto violation = [cost](std::span<const double> x) {
    std::vector<double> values(cost->limits());
    if (!values.empty()) cost->limit_values(x, values, {});
    double sum = 0;
    for (const double v : values) sum += std::max(0.0, v);
    return sum;
  };
  return {.variables = cost->variables(),
          .evaluate =
              [cost, violation](const optimise::PopulationView& all, std::span<double> costs,
                                std::span<double> violations) {
                std::vector<double> x(all.dimension);
                for (std::size_t i = 0; i < all.size; ++i) {
                  for (std::size_t j = 0; j < x.size(); ++j) x[j] = all(j, i);
                  costs[i] = (*cost)(x, {}, 0);
                  violations[i] = violation(x);
                }
              },
          .explain =
              [violation](std::span<const double> x) {
                std::vector<Violation> out;
                if (const double v = violation(x); v > 0) out.push_back({"largest_coefficient", v});
                return out;
              }};
}

ArmSearchReport search_arm(const ArmTask& task, const ArmDesign& design, const ArmSearchOptions& options,
                           const optimise::Seed& seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(options.starts >= 1, "starts must be at least 1, got {}", options.starts);
  const ArmCost cost(task, design);
  const std::vector<optimise::Variable> variables = cost.variables();
  std::vector<double> lower, upper, x(cost.size());
  for (const optimise::Variable& v : variables) {
    lower.push_back(v.lower);
    upper.push_back(v.upper);
  }
  // In shares of the largest cost, so that tolerances mean the same for every arm.
  std::vector<double> smoothings = {0};
  if (!design.counterweights.empty()) smoothings = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  const double norm = cost.scale() / (task.measure == Measure::rms ? 1.0 : 1.0 / task.intervals);

  ArmSearchReport report;
  for (int start = 0; start < options.starts; ++start) {
    RandomStream random({seed.seed, seed.run, 0, static_cast<std::uint32_t>(start)});
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = random.uniform(lower[j], upper[j]);
    optimise::LocalReport local;
    for (const double smoothing : smoothings) {
      local = optimise::minimise_local(
          [&](std::span<const double> at, std::span<double> gradient) {
            const double value = cost(at, gradient, smoothing * norm) / cost.scale();
            for (double& g : gradient) g /= cost.scale();
            return value;
          },
          cost.limits(),
          [&](std::span<const double> at, std::span<double> values, std::span<double> jacobian) {
            cost.limit_values(at, values, jacobian);
          },
          x, lower, upper, options.local, context);
      report.evaluations += local.evaluations;
      if (local.end == optimise::LocalEnd::interrupted) break;
    }
    if (local.violation == 0 && std::isfinite(local.cost)) {
      double value = cost(x, {}, 0);
      // The law of a link that no longer affects any joint force is noise: back to the one of degree 5.
      const std::size_t per_law = static_cast<std::size_t>(design.degree - 5);
      for (std::size_t j = 0; j < per_law * task.arm.links.size(); j += per_law) {
        std::vector<double> plain = x;
        std::fill_n(plain.begin() + static_cast<std::ptrdiff_t>(j), per_law, 0.0);
        const double with = cost(plain, {}, 0);
        if (with > value * (1 + options.same_cost)) continue;
        x = plain;
        value = with;
      }
      const auto same = std::find_if(report.minima.begin(), report.minima.end(), [&](const ArmMinimum& m) {
        return std::abs(m.cost - value) <= options.same_cost * std::max(m.cost, value);
      });
      if (same == report.minima.end()) {
        report.minima.push_back({value, x, 1});
      } else {
        ++same->ends;
        if (value < same->cost) same->cost = value, same->x = x;
      }
    }
    report.status = context.interruption();
    if (report.status != Status::done) break;
  }
  std::stable_sort(report.minima.begin(), report.minima.end(),
                   [](const ArmMinimum& a, const ArmMinimum& b) { return a.cost < b.cost; });
  if (report.status == Status::done && report.minima.empty()) report.status = Status::infeasible;
  return report;
}

MassBalancing arm_counterweights(const ArmTask& task, const std::vector<Counterweight>& counterweights) {
  require_valid(task, {.degree = 5, .counterweights = counterweights});
  MassBalancing out{.forces = linear_forces(task.arm, motion_of(task), task.gravity),
                    .counterweights = counterweights};
  for (std::size_t k = 0; k < task.weights.size(); ++k)
    if (task.weights[k] > 0)
      out.objectives.push_back({.quantity = fmt::format("O{}_N", k + 1),
                                .measure = task.measure,
                                .weight = task.weights[k],
                                .reference = 1});
  return out;
}

std::vector<ArmPeaks> arm_peaks(const ArmTask& task) {
  const std::vector<ArmElement> arm = elements(task.arm);
  const std::vector<math::Motion> motion = motion_of(task);
  const std::size_t n = arm.size();
  LINKWRIGHT_REQUIRE(task.laws.size() == n, "{} laws for {} links", task.laws.size(), n);
  std::vector<ArmLinkRates> rate(n);
  std::vector<ArmJointLoads> loads(n);
  std::vector<ArmPeaks> peaks(n);
  for (std::size_t i = 0; i < motion.size(); i += n) {
    rates(arm, task.arm.base, std::span(motion).subspan(i, n), rate);
    reactions(arm, rate, task.gravity, loads);
    for (std::size_t k = 0; k < n; ++k) {
      peaks[k].force = std::max(peaks[k].force, std::abs(loads[k].force));
      peaks[k].absolute_torque = std::max(peaks[k].absolute_torque, std::abs(loads[k].absolute_torque));
      peaks[k].joint_torque = std::max(peaks[k].joint_torque, std::abs(loads[k].joint_torque));
    }
  }
  return peaks;
}

}  // namespace linkwright::planar
