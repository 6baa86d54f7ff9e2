// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/mass_redistribution.h"

#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/cone_programme.h"

namespace linkwright::planar {
namespace {

using Eigen::Index;
using optimise::Affine;
using optimise::Cone;
using Matrix = Eigen::MatrixXd;

Affine constant(double v) { return {{}, {}, v}; }
Affine variable(std::size_t j, double factor = 1, double shift = 0) { return {{j}, {factor}, shift}; }
Affine sum(const Affine& a, double factor, const Affine& b) {
  Affine out = a;
  out.constant += factor * b.constant;
  for (std::size_t i = 0; i < b.variables.size(); ++i) {
    const auto at = std::find(out.variables.begin(), out.variables.end(), b.variables[i]);
    if (at != out.variables.end()) {
      out.factors[static_cast<std::size_t>(at - out.variables.begin())] += factor * b.factors[i];
    } else {
      out.variables.push_back(b.variables[i]);
      out.factors.push_back(factor * b.factors[i]);
    }
  }
  return out;
}
Affine scaled(double factor, const Affine& a) { return sum({}, factor, a); }

// Base parameters as functions of the unknowns.
using BaseForms = std::array<Affine, base_parameter_count>;  // mass, moment x, moment y, inertia

BaseParameters value(const BaseForms& forms, std::span<const double> x) {
  return {optimise::value(forms[0], x),
          {optimise::value(forms[1], x), optimise::value(forms[2], x)},
          optimise::value(forms[3], x)};
}

// A cone that a person knows by a limit: how its slack changes with it.
struct NamedCone {
  std::string name;
  double limit = 0;
  double size = 1;  // size of the limited quantity, to judge its price
  std::size_t cone = 0;
  Affine bound_by_limit;  // derivative of the cone's bound, and of its last part
  double last_by_limit = 0;
};

// True if the place of a counterweight is fixed.
bool fixed_place(const Counterweight& w) {
  if (w.rectangle) return (*w.rectangle)[0].fixed() && (*w.rectangle)[1].fixed();
  return w.radius.fixed();
}

class Balancer {
 public:
  explicit Balancer(const MassBalancing& b) : b_(b) {}
  BalancedMasses run(RunContext& context);

 private:
  void require_good() const;
  std::size_t add_unknown() {
    programme_.cost.push_back(0);
    return programme_.cost.size() - 1;
  }
  void add(Cone cone) { programme_.cones.push_back(std::move(cone)); }
  void add(Cone cone, std::string name, double limit, double size, Affine bound_by_limit,
           double last_by_limit = 0) {
    named_.push_back(
        {std::move(name), limit, size, programme_.cones.size(), std::move(bound_by_limit), last_by_limit});
    add(std::move(cone));
  }
  // lower <= form <= upper
  void add_range(const Affine& form, const Range& range, const std::string& name);
  bool felt(std::size_t link) const;  // inertia of the link
  void open(const OpenLink& link);
  void open(const Counterweight& weight);
  void add_objectives();
  void add_objective(std::size_t k, std::size_t t);
  double cost(std::span<const double> measures) const;
  BalancedMasses answer(const optimise::ConeReport& report);
  void report_active(const optimise::ConeReport& report, BalancedMasses& out) const;
  void check_link(const OpenLink& open, const LinkMass& mass, BalancedMasses& out) const;
  void check_weight(const Counterweight& weight, const PlacedCounterweight& at, BalancedMasses& out) const;
  const std::string& name(std::size_t link) const { return b_.forces.links[link]; }

  const MassBalancing& b_;
  optimise::ConeProgramme programme_;
  std::vector<NamedCone> named_;
  std::vector<const OpenLink*> open_;  // masses of each link, null when they stay
  std::vector<bool> inertia_free_;     // true for each link whose inertia has no effect
  std::vector<BaseForms> links_, weights_;
  std::size_t unknowns_ = 0;  // number of unknown masses; epigraphs follow
  std::vector<double> before_, references_;
};

void Balancer::require_good() const {
  const std::size_t n = b_.forces.links.size();
  const auto ordered = [](const Range& r, std::string_view what, const std::string& of) {
    LINKWRIGHT_REQUIRE(r.lower >= 0 && r.lower <= r.upper && std::isfinite(r.lower),
                       "{} of {}: {} to {}, must be ordered and not negative", what, of, r.lower, r.upper);
  };
  std::vector<bool> seen(n, false);
  for (const OpenLink& link : b_.links) {
    LINKWRIGHT_REQUIRE(link.link < n, "link {} of {}", link.link, n);
    LINKWRIGHT_REQUIRE(!seen[link.link], "link '{}' is given twice", name(link.link));
    seen[link.link] = true;
    ordered(link.mass, "mass", name(link.link));
    ordered(link.centre_distance, "centre distance", name(link.link));
    ordered(link.inertia, "inertia", name(link.link));
    LINKWRIGHT_REQUIRE(link.mass.upper > 0, "mass of {}: 0 to 0 leaves nothing to choose", name(link.link));
    if (link.envelope)
      LINKWRIGHT_REQUIRE(link.envelope->radius > 0 && std::isfinite(link.envelope->radius) &&
                             std::isfinite(std::abs(link.envelope->centre)),
                         "envelope of {}: radius {} must be more than 0", name(link.link),
                         link.envelope->radius);
  }
  for (const Counterweight& w : b_.counterweights) {
    if (w.rectangle)
      for (const Range& r : *w.rectangle)
        LINKWRIGHT_REQUIRE(std::isfinite(r.lower) && std::isfinite(r.upper) && r.lower <= r.upper,
                           "place of counterweight '{}': {} to {}", w.name, r.lower, r.upper);
    LINKWRIGHT_REQUIRE(w.link < n, "counterweight '{}' on link {} of {}", w.name, w.link, n);
    ordered(w.mass, "mass", w.name);
    ordered(w.radius, "radius", w.name);
    LINKWRIGHT_REQUIRE(std::isfinite(w.mass.upper) && std::isfinite(w.radius.upper),
                       "mass {} and radius {} of counterweight '{}' must be bounded", w.mass.upper,
                       w.radius.upper, w.name);
    LINKWRIGHT_REQUIRE(!w.angle || std::isfinite(*w.angle), "angle {} of counterweight '{}'", *w.angle,
                       w.name);
  }
  LINKWRIGHT_REQUIRE(!b_.links.empty() || !b_.counterweights.empty(),
                     "there is nothing to choose: open a link or add a counterweight");
  LINKWRIGHT_REQUIRE(!b_.objectives.empty(), "there is no objective");
  for (const ForceObjective& o : b_.objectives) {
    LINKWRIGHT_REQUIRE(o.weight >= 0 && std::isfinite(o.weight), "weight {} of {}", o.weight, o.quantity);
    LINKWRIGHT_REQUIRE(!o.reference || (*o.reference > 0 && std::isfinite(*o.reference)),
                       "reference {} of {} must be more than 0", *o.reference, o.quantity);
    LINKWRIGHT_REQUIRE(!o.at_most || (*o.at_most >= 0 && std::isfinite(*o.at_most)),
                       "limit {} of {} must not be negative", *o.at_most, o.quantity);
  }
}

void Balancer::add_range(const Affine& form, const Range& range, const std::string& name) {
  if (form.variables.empty()) return;
  const double width = std::isfinite(range.upper) ? std::max(range.upper - range.lower, range.upper)
                                                  : std::max(range.lower, 1.0);
  add({.bound = sum(form, 1, constant(-range.lower)), .parts = {}}, name, range.lower, width, constant(-1));
  if (std::isfinite(range.upper))
    add({.bound = sum(constant(range.upper), -1, form), .parts = {}}, name, range.upper, width, constant(1));
}

bool Balancer::felt(std::size_t link) const {
  const std::size_t n = b_.forces.samples;
  for (const ForceObjective& o : b_.objectives)
    for (const LinearComponent* c : quantity(b_.forces, o.quantity)) {
      const auto largest = [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (std::size_t i = first; i < last; ++i) most = std::max(most, std::abs(c->factors[i]));
        return most;
      };
      const std::size_t own = base_parameter_count * link * n;
      // Rounding of the columns, which were made as differences.
      if (largest(own + 3 * n, own + 4 * n) > 1e-13 * largest(0, c->factors.size())) return true;
    }
  return false;
}

void Balancer::open(const OpenLink& link) {
  BaseForms& form = links_[link.link];
  const std::string& of = name(link.link);
  form[0] = link.mass.fixed() ? constant(link.mass.lower) : variable(add_unknown());
  add_range(form[0], link.mass, "mass of " + of);
  const bool centred = link.centre_distance.upper == 0;
  for (const std::size_t axis : {1, 2}) form[axis] = centred ? constant(0) : variable(add_unknown());
  if (!centred && std::isfinite(link.centre_distance.upper))
    add({.bound = scaled(link.centre_distance.upper, form[0]), .parts = {form[1], form[2]}},
        "centre distance of " + of, link.centre_distance.upper, link.centre_distance.upper, form[0]);
  inertia_free_[link.link] = !felt(link.link) && !link.envelope;
  if (inertia_free_[link.link]) {
    form[3] = constant(0);
    return;
  }
  form[3] = variable(add_unknown());
  // I - J >= |S|^2 / m for the least J.
  const double least = link.inertia.lower, most = link.inertia.upper;
  add(optimise::rotated_cone({form[1], form[2]}, form[0], sum(form[3], 1, constant(-least))),
      "inertia of " + of, least,
      std::isfinite(most) ? most : std::max(least, b_.forces.initial[link.link].inertia), constant(-1), 1);
  if (std::isfinite(most) && std::isfinite(link.centre_distance.upper))
    add({.bound = sum(sum(constant(most), std::pow(link.centre_distance.upper, 2), form[0]), -1, form[3]),
         .parts = {}},
        "largest inertia of " + of + " about its joint", most, most, constant(1));
  if (link.envelope) {
    const std::complex<double> c = link.envelope->centre;
    const double r = link.envelope->radius;
    Affine slack = sum(scaled(r * r - std::norm(c), form[0]), 2 * c.real(), form[1]);
    slack = sum(sum(slack, 2 * c.imag(), form[2]), -1, form[3]);
    add({.bound = slack, .parts = {}}, "envelope of " + of, r, r, scaled(2 * r, form[0]));
  }
}

void Balancer::open(const Counterweight& w) {
  BaseForms form;
  form[0] = w.mass.fixed() ? constant(w.mass.lower) : variable(add_unknown());
  add_range(form[0], w.mass, "mass of " + w.name);
  const double near = w.radius.lower, far = w.radius.upper;
  const bool feels = felt(w.link);
  if (w.rectangle) {
    // On an interval x^2 <= (lower + upper) x - lower upper, with equality at its ends.
    Affine most = constant(0);
    for (const std::size_t axis : {0, 1}) {
      const Range& r = (*w.rectangle)[axis];
      Affine& s = form[axis + 1];
      s = r.fixed() ? scaled(r.lower, form[0]) : variable(add_unknown());
      if (!r.fixed()) {
        const std::string of = fmt::format("{} of {}", axis == 0 ? "x" : "y", w.name);
        const double size = std::max({std::abs(r.lower), std::abs(r.upper)});
        add({.bound = sum(s, -r.lower, form[0]), .parts = {}}, of, r.lower, size, scaled(-1, form[0]));
        add({.bound = sum(scaled(r.upper, form[0]), -1, s), .parts = {}}, of, r.upper, size, form[0]);
      }
      most = sum(sum(most, r.lower + r.upper, s), -r.lower * r.upper, form[0]);
    }
    if (fixed_place(w)) {
      form[3] = most;
    } else if (feels) {
      form[3] = variable(add_unknown());
      add(optimise::rotated_cone({form[1], form[2]}, form[0], form[3]));
      add({.bound = sum(most, -1, form[3]), .parts = {}});
    }
  } else if (w.angle) {
    // First moment u along the ray; points between the two radii have u^2 / m <= I <= (near + far) u - near
    // far m.
    const Affine u = w.radius.fixed() ? scaled(far, form[0]) : variable(add_unknown());
    if (!w.radius.fixed()) {
      add({.bound = sum(u, -near, form[0]), .parts = {}}, "radius of " + w.name, near, far,
          scaled(-1, form[0]));
      add({.bound = sum(scaled(far, form[0]), -1, u), .parts = {}}, "radius of " + w.name, far, far, form[0]);
    }
    form[1] = scaled(std::cos(*w.angle), u);
    form[2] = scaled(std::sin(*w.angle), u);
    if (w.radius.fixed()) {
      form[3] = scaled(far * far, form[0]);
    } else if (feels) {
      form[3] = variable(add_unknown());
      add(optimise::rotated_cone({u}, form[0], form[3]));
      add({.bound = sum(sum(scaled(near + far, u), -near * far, form[0]), -1, form[3]), .parts = {}});
    }
  } else {
    for (const std::size_t axis : {1, 2}) form[axis] = far == 0 ? constant(0) : variable(add_unknown());
    if (far > 0)
      add({.bound = scaled(far, form[0]), .parts = {form[1], form[2]}}, "radius of " + w.name, far, far,
          form[0]);
    if (w.radius.fixed()) {
      form[3] = scaled(far * far, form[0]);
    } else if (feels) {
      form[3] = variable(add_unknown());
      add(optimise::rotated_cone({form[1], form[2]}, form[0], form[3]));
      add({.bound = sum(scaled(far * far, form[0]), -1, form[3]), .parts = {}});
    }
  }
  for (std::size_t p = 0; p < base_parameter_count; ++p)
    links_[w.link][p] = sum(links_[w.link][p], 1, form[p]);
  weights_.push_back(std::move(form));
}

// measure / reference <= x_t
void Balancer::add_objective(std::size_t k, std::size_t t) {
  const ForceObjective& o = b_.objectives[k];
  const auto parts = quantity(b_.forces, o.quantity);
  const std::size_t n = b_.forces.samples;
  const auto columns = static_cast<Index>(unknowns_);
  double over = 1 / references_[k];
  if (o.measure == Measure::rss_over_n) over /= static_cast<double>(n - 1);
  const std::size_t used = counted(o.measure, n, b_.forces.closes);
  if (o.measure == Measure::rms) over /= std::sqrt(static_cast<double>(used));
  if (o.measure == Measure::mean_abs) over /= static_cast<double>(used);

  // All samples that count over the unknowns; the constants in the last column.
  const auto rows = static_cast<Index>(parts.size() * used);
  Matrix all = Matrix::Zero(rows, columns + 1);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const auto block = [&](const std::vector<double>& list, std::size_t first) {
      return Eigen::Map<const Eigen::VectorXd>(list.data() + first, static_cast<Index>(used));
    };
    auto out = all.middleRows(static_cast<Index>(c * used), static_cast<Index>(used));
    out.col(columns) = over * block(parts[c]->constant, 0);
    for (std::size_t p = 0; p < base_parameter_count * links_.size(); ++p) {
      const Affine& form = links_[p / base_parameter_count][p % base_parameter_count];
      const auto column = block(parts[c]->factors, p * n);
      if (form.constant != 0) out.col(columns) += (over * form.constant) * column;
      for (std::size_t i = 0; i < form.variables.size(); ++i)
        out.col(static_cast<Index>(form.variables[i])) += (over * form.factors[i]) * column;
    }
  }
  const auto row = [&](const Matrix& m, Index i) {
    Affine form = constant(m(i, columns));
    for (Index j = 0; j < columns; ++j)
      if (m(i, j) != 0) {
        form.variables.push_back(static_cast<std::size_t>(j));
        form.factors.push_back(m(i, j));
      }
    return form;
  };
  if (properties(o.measure).quadratic) {
    // |all (x, 1)| = |R (x, 1)|
    if (rows > columns + 1) {
      const Eigen::HouseholderQR<Matrix> qr(all);
      all = Matrix(qr.matrixQR().topRows(columns + 1).triangularView<Eigen::Upper>());
    }
    Cone cone{.bound = variable(t), .parts = {}};
    for (Index i = 0; i < all.rows(); ++i) cone.parts.push_back(row(all, i));
    return add(std::move(cone));
  }
  // One cone a sample: below t, or below the difference of two partial sums, the last of which is t.
  Affine before = constant(0);
  for (std::size_t i = 0; i < used; ++i) {
    Cone cone{.bound = variable(t), .parts = {}};
    if (o.measure == Measure::mean_abs) {
      const Affine after = variable(i + 1 == used ? t : add_unknown());
      cone.bound = sum(after, -1, before);
      before = after;
    }
    for (std::size_t c = 0; c < parts.size(); ++c)
      cone.parts.push_back(row(all, static_cast<Index>(c * used + i)));
    add(std::move(cone));
  }
}

void Balancer::add_objectives() {
  unknowns_ = programme_.cost.size();
  const bool largest = b_.cost == ForceCost::largest;
  const std::size_t most = largest ? add_unknown() : 0;
  if (largest) programme_.cost[most] = 1;
  for (std::size_t k = 0; k < b_.objectives.size(); ++k) {
    const ForceObjective& o = b_.objectives[k];
    const std::size_t t = add_unknown();
    if (largest)
      add({.bound = sum(variable(most), -o.weight, variable(t)), .parts = {}});
    else
      programme_.cost[t] = o.weight;
    if (o.at_most) {
      const double limit = *o.at_most / references_[k];
      add({.bound = sum(constant(limit), -1, variable(t)), .parts = {}},
          fmt::format("{} ({})", o.quantity, name_of(o.measure)), *o.at_most, *o.at_most,
          constant(1 / references_[k]));
    }
    add_objective(k, t);
  }
}

void Balancer::report_active(const optimise::ConeReport& report, BalancedMasses& out) const {
  const bool proof = report.status == Status::infeasible;
  const double cost = proof ? 1 : std::abs(out.cost);
  std::vector<std::pair<double, ActiveBound>> found;
  for (const NamedCone& named : named_) {
    const optimise::ConeMultiplier& z = report.multipliers[named.cone];
    const double bound =
        proof ? named.bound_by_limit.constant : optimise::value(named.bound_by_limit, report.x);
    const double last = z.parts.empty() ? 0 : z.parts.back() * named.last_by_limit;
    const double price = -(z.bound * bound + last);
    // When bounds contradict, each with a multiplier takes part.
    const double effect = proof ? z.bound * named.size : std::abs(price) * named.size;
    if (effect > 1e-6 * cost) found.push_back({effect, {named.name, named.limit, proof ? 0 : price}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [effect, bound] : found) out.active.push_back(std::move(bound));
}

void Balancer::check_link(const OpenLink& open, const LinkMass& mass, BalancedMasses& out) const {
  // The answer is good to some 1e-7 of its bounds, less where the cost is flat.
  if (mass.centre_distance < open.centre_distance.lower * (1 - 1e-6))
    out.broken.push_back(fmt::format("centre distance of {} is {:.6g} m, less than its lower bound {:.6g} m",
                                     name(open.link), mass.centre_distance, open.centre_distance.lower));
  if (mass.inertia > open.inertia.upper * (1 + 1e-6))
    out.broken.push_back(fmt::format("inertia of {} is {:.6g} kg m2, more than its upper bound {:.6g} kg m2",
                                     name(open.link), mass.inertia, open.inertia.upper));
}

void Balancer::check_weight(const Counterweight& w, const PlacedCounterweight& at,
                            BalancedMasses& out) const {
  const double distance = std::abs(at.mass.distance);
  if (at.mass.mass <= 1e-9 * std::max(w.mass.upper, 1e-300)) return;
  double reach = w.radius.upper;
  if (w.rectangle)
    for (const Range& r : *w.rectangle) reach = std::max({reach, std::abs(r.lower), std::abs(r.upper)});
  if (!w.rectangle && distance < w.radius.lower * (1 - 1e-6))
    out.broken.push_back(fmt::format("{} is at {:.6g} m, nearer than its lower bound {:.6g} m", w.name,
                                     distance, w.radius.lower));
  else if (at.spread > 1e-6 * at.mass.mass * reach * reach)
    out.broken.push_back(
        fmt::format("{} is not a point: its inertia about its centre is {:.6g} kg m2", w.name, at.spread));
}

double Balancer::cost(std::span<const double> measures) const {
  double cost = 0;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    const double share = b_.objectives[k].weight * measures[k] / references_[k];
    cost = b_.cost == ForceCost::sum ? cost + share : std::max(cost, share);
  }
  return cost;
}

BalancedMasses Balancer::answer(const optimise::ConeReport& report) {
  BalancedMasses out{.status = report.status, .before = before_, .iterations = report.iterations};
  out.lower_bound = report.lower_bound;
  if (report.x.empty() || report.end == optimise::ConeEnd::unbounded) {
    if (report.status == Status::infeasible) report_active(report, out);
    return out;
  }
  std::vector<BaseParameters> weights;
  for (const BaseForms& form : weights_) weights.push_back(value(form, report.x));
  for (std::size_t k = 0; k < links_.size(); ++k) out.bases.push_back(value(links_[k], report.x));
  for (std::size_t w = 0; w < weights.size(); ++w) {
    const Counterweight& given = b_.counterweights[w];
    BaseParameters& base = weights[w];
    const double distance = base.mass > 0 ? std::abs(base.moment) / base.mass : 0;
    const double point = base.mass * distance * distance;
    if (!fixed_place(given) && !felt(given.link)) {
      out.bases[given.link].inertia += point;
      base.inertia = point;
    }
    out.counterweights.push_back({{base.mass, distance, given.angle ? *given.angle : std::arg(base.moment)},
                                  std::max(0.0, base.inertia - point)});
    check_weight(given, out.counterweights.back(), out);
  }
  for (std::size_t k = 0; k < links_.size(); ++k) {
    if (!open_[k]) {
      out.links.push_back(b_.forces.initial[k]);
      continue;
    }
    BaseParameters own = out.bases[k];
    for (std::size_t w = 0; w < weights.size(); ++w)
      if (b_.counterweights[w].link == k) {
        own.mass -= weights[w].mass;
        own.moment -= weights[w].moment;
        own.inertia -= weights[w].inertia;
      }
    LinkMass mass{.mass = std::max(0.0, own.mass)};
    mass.centre_distance = mass.mass > 0 ? std::abs(own.moment) / mass.mass : 0;
    mass.centre_angle = std::arg(own.moment);
    if (mass.centre_angle < 0) mass.centre_angle += 2 * pi;
    const double steiner = mass.mass * mass.centre_distance * mass.centre_distance;
    if (inertia_free_[k]) {
      mass.inertia =
          std::clamp(b_.forces.initial[k].inertia, open_[k]->inertia.lower, open_[k]->inertia.upper);
      out.bases[k].inertia += mass.inertia + steiner;
    } else {
      mass.inertia = std::max(0.0, own.inertia - steiner);
    }
    check_link(*open_[k], mass, out);
    out.links.push_back(mass);
  }
  out.after = force_measures(b_, out.bases);
  out.cost = cost(out.after);
  out.gap = std::max(0.0, out.cost - out.lower_bound) / std::max({out.cost, 1e-3 * cost(before_), 1e-300});
  report_active(report, out);
  return out;
}

BalancedMasses Balancer::run(RunContext& context) {
  require_good();
  for (const ForceObjective& o : b_.objectives) quantity(b_.forces, o.quantity);
  if (b_.forces.status != Status::done) return {.status = b_.forces.status};

  const std::size_t n = b_.forces.links.size();
  links_.resize(n);
  open_.assign(n, nullptr);
  inertia_free_.assign(n, false);
  std::vector<BaseParameters> initial;
  for (std::size_t k = 0; k < n; ++k) {
    initial.push_back(base_parameters(b_.forces.initial[k]));
    links_[k] = {constant(initial[k].mass), constant(initial[k].moment.real()),
                 constant(initial[k].moment.imag()), constant(initial[k].inertia)};
  }
  before_ = force_measures(b_, initial);
  for (std::size_t k = 0; k < b_.objectives.size(); ++k) {
    const ForceObjective& o = b_.objectives[k];
    LINKWRIGHT_REQUIRE(o.reference || before_[k] > 0,
                       "{} is 0 with the initial masses: give a reference for it", o.quantity);
    references_.push_back(o.reference ? *o.reference : before_[k]);
  }
  for (const OpenLink& link : b_.links) {
    open_[link.link] = &link;
    open(link);
  }
  for (const Counterweight& w : b_.counterweights) open(w);
  LINKWRIGHT_REQUIRE(!programme_.cost.empty(), "there is nothing to choose: all bounds are closed");
  add_objectives();
  return answer(optimise::solve(programme_, {.absolute_gap = 1e-12 * cost(before_)}, context));
}

}  // namespace

std::vector<double> force_measures(const MassBalancing& balancing, std::span<const BaseParameters> links) {
  std::vector<double> out;
  for (const ForceObjective& o : balancing.objectives)
    out.push_back(measure(o.measure, values(balancing.forces, o.quantity, links), balancing.forces.closes));
  return out;
}

BalancedMasses balance(const MassBalancing& balancing, RunContext& context) {
  return Balancer(balancing).run(context);
}

}  // namespace linkwright::planar
