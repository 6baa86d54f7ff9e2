// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace linkwright::planar {
namespace {

constexpr double box_margin = 0.002;  // the polish keeps pivots this much further inside, in sizes
constexpr double pivot_weight = 8;    // of pivots next to the other limits: they are placed to be met

/// The parameters of a bar of a group of four links.
std::array<int, 3> bar_of_group(const PointProgram& p, int bar) {
  const auto pin = static_cast<std::size_t>(p.group + bar);
  const PointStep& of_ground = p.steps[pin];
  return {p.steps[static_cast<std::size_t>(of_ground.first)].parameter, of_ground.parameter,
          p.steps[pin + 2].parameter};
}

/// The bar of a group of four links at crank angle zero, in cranks.
std::complex<double> bar_at_start(const std::array<int, 3>& bar, std::span<const double> x) {
  const auto at = [&](int i) {
    return std::complex<double>(x[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(i) + 1]);
  };
  return at(bar[0]) + at(bar[1]) - 1.0 - at(bar[2]);
}

std::vector<LengthTerm> length_terms(const PointProgram& p) {
  std::vector<LengthTerm> out{{}};  // the crank
  for (int bar = 0; p.group >= 0 && bar < 2; ++bar) out.push_back({-1, -1, false, bar_of_group(p, bar)});
  for (const PointStep& step : p.steps) {
    switch (step.operation) {
      case PointOperation::crank_pin:
        break;
      case PointOperation::ground_on_axis:
      case PointOperation::slide:
      case PointOperation::sleeve:
        out.push_back({-1, step.parameter});
        break;
      case PointOperation::ground:
      case PointOperation::crank_plate:
      case PointOperation::group_point:
        out.push_back({step.parameter, -1});
        break;
      case PointOperation::geared_crank:
        out.push_back({step.parameter, -1});
        out.push_back({step.parameter + 2, -1});
        break;
      case PointOperation::pair:
        out.push_back({-1, step.parameter});
        out.push_back({-1, step.parameter + 1});
        break;
      case PointOperation::plate: {
        const PointStep& pin = p.steps[static_cast<std::size_t>(step.second)];
        int factor = -1;
        if (pin.operation == PointOperation::slide) factor = pin.parameter;
        if (pin.operation == PointOperation::pair) factor = pin.parameter + (step.first == pin.first ? 0 : 1);
        out.push_back({step.parameter, factor, &step == &p.steps.back()});
        if (pin.operation == PointOperation::group_point)
          out.back().bar = bar_of_group(p, step.first - p.group);
        break;
      }
    }
  }
  return out;
}

std::complex<double> complex_at(std::span<const double> x, int i) {
  return {x[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(i) + 1]};
}

/// For each given pivot the nearest one of a machine, each of which is taken once, so that the squares of the
/// distances add up to the least sum. The machine has as many pivots as are given, at least.
class Assignment {
 public:
  Assignment(std::span<const std::complex<double>> given, std::span<const std::complex<double>> pivots)
      : given_(given), pivots_(pivots), chosen_(given.size()), taken_(pivots.size(), false) {
    choose(0, 0);
  }
  const std::vector<std::size_t>& best() const { return best_; }

 private:
  void choose(std::size_t i, double sum) {
    if (sum >= least_) return;
    if (i == given_.size()) {
      least_ = sum, best_ = chosen_;
      return;
    }
    for (std::size_t k = 0; k < pivots_.size(); ++k) {
      if (taken_[k]) continue;
      taken_[k] = true, chosen_[i] = k;
      choose(i + 1, sum + std::norm(pivots_[k] - given_[i]));
      taken_[k] = false;
    }
  }

  std::span<const std::complex<double>> given_, pivots_;
  std::vector<std::size_t> chosen_, best_;
  std::vector<bool> taken_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<LengthTerm> lengths_of(const PointProgram& program) { return length_terms(program); }

void DimensionLimits::set_program(const PointProgram& program) {
  if (program_ == &program) return;
  program_ = &program;
  lengths_ = length_terms(program);
  pivots_ = ground_pivots(program);
}

double DimensionLimits::length_of(const LengthTerm& term, std::span<const double> x, double scale) const {
  const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
  double out = scale;
  if (term.plate >= 0) out *= std::hypot(at(term.plate), at(term.plate + 1));
  if (term.factor >= 0) out *= std::abs(at(term.factor));
  if (term.bar[0] >= 0) out *= std::abs(bar_at_start(term.bar, x));
  return out;
}

/// Adds the gradient of the logarithm of a length, times `by`.
void DimensionLimits::add_log_gradient(const LengthTerm& term, std::span<const double> x, double by,
                                       std::span<double> gradient) const {
  const auto by_complex = [&](std::size_t i) {
    const double square = std::max(x[i] * x[i] + x[i + 1] * x[i + 1], 1e-24);
    gradient[i] += by * x[i] / square;
    gradient[i + 1] += by * x[i + 1] / square;
  };
  by_complex(static_cast<std::size_t>(program_->scale()));
  if (term.plate >= 0) by_complex(static_cast<std::size_t>(term.plate));
  if (term.factor >= 0)
    gradient[static_cast<std::size_t>(term.factor)] += by / x[static_cast<std::size_t>(term.factor)];
  if (term.bar[0] >= 0) {
    const std::complex<double> c = bar_at_start(term.bar, x);
    const std::complex<double> along = by / std::max(std::norm(c), 1e-24) * c;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(term.bar[k]);
      gradient[i] += k < 2 ? along.real() : -along.real();
      gradient[i + 1] += k < 2 ? along.imag() : -along.imag();
    }
  }
}

void DimensionLimits::add_lengths(std::span<const double> x, double weight, LimitRows& out) const {
  const auto s = static_cast<std::size_t>(program_->scale());
  const double scale = std::hypot(x[s], x[s + 1]);
  for (const LengthTerm& term : lengths_) {
    const double length = length_of(term, x, scale);
    const double side = length > limits_.max_length ? 1 : length < limits_.min_length ? -1 : 0;
    if (side == 0) continue;
    const double beyond = side > 0 ? std::log(length / limits_.max_length)
                                   : std::log(limits_.min_length / std::max(length, 1e-12));
    if (LimitRow* row = out.add(weight * beyond)) {
      std::fill_n(row->gradient.begin(), x.size(), 0.0);
      add_log_gradient(term, x, side * weight, row->gradient);
    }
  }
}

std::vector<std::complex<double>> DimensionLimits::pivots(std::span<const double> x) const {
  std::vector<std::complex<double>> out;
  for (const GroundPivot& pivot : pivots_) out.push_back(place_of(pivot, *program_, x));
  return out;
}

/// Adds the gradient of one coordinate of a pivot, times `by`.
void DimensionLimits::add_coordinate_gradient(std::span<const double> x, std::size_t pivot, bool upright,
                                              double by, std::span<double> gradient) const {
  const auto p = static_cast<std::size_t>(program_->place()), s = static_cast<std::size_t>(program_->scale());
  const GroundPivot& of = pivots_[pivot];
  const std::complex<double> scale{x[s], x[s + 1]}, g = own_place_of(of, x);
  gradient[p + (upright ? 1 : 0)] += by;
  gradient[s] += by * (upright ? g.imag() : g.real());
  gradient[s + 1] += by * (upright ? g.real() : -g.imag());
  if (of.parameter < 0) return;
  const auto i = static_cast<std::size_t>(of.parameter);
  gradient[i] += by * (upright ? scale.imag() : scale.real());
  if (!of.on_axis) gradient[i + 1] += by * (upright ? scale.real() : -scale.imag());
}

/// A row for one coordinate of a pivot: `value`, whose derivative by the coordinate is `by`.
void DimensionLimits::add_coordinate(std::span<const double> x, std::size_t pivot, bool upright, double by,
                                     double value, LimitRows& out) const {
  LimitRow* row = out.add(value);
  if (!row) return;
  std::fill_n(row->gradient.begin(), x.size(), 0.0);
  add_coordinate_gradient(x, pivot, upright, by, row->gradient);
}

void DimensionLimits::add_pivots(std::span<const double> x, double weight, LimitRows& out) const {
  if (!limits_.ground_box && limits_.ground_pivots.empty()) return;
  const double w = pivot_weight * weight;
  const std::vector<std::complex<double>> at = pivots(x);
  if (const auto& box = limits_.ground_box) {
    const auto keep = [&](std::size_t k, bool upright, double value, double low, double high) {
      const double margin = std::min(box_margin, 0.25 * (high - low));
      if (value < low + margin) add_coordinate(x, k, upright, -w, w * (low + margin - value), out);
      if (value > high - margin) add_coordinate(x, k, upright, w, w * (value - high + margin), out);
    };
    for (std::size_t k = 0; k < at.size(); ++k) {
      keep(k, false, at[k].real(), box->left, box->right);
      keep(k, true, at[k].imag(), box->bottom, box->top);
    }
  }
  if (limits_.ground_pivots.size() > at.size()) return;
  const Assignment assignment(limits_.ground_pivots, at);
  for (std::size_t i = 0; i < assignment.best().size(); ++i) {
    const std::size_t k = assignment.best()[i];
    const std::complex<double> apart = at[k] - limits_.ground_pivots[i];
    add_coordinate(x, k, false, w, w * apart.real(), out);
    add_coordinate(x, k, true, w, w * apart.imag(), out);
  }
}

void DimensionLimits::meet_pivots(std::span<double> x) const {
  const auto& given = limits_.ground_pivots;
  if (given.empty() || given.size() > pivots_.size()) return;
  const std::vector<std::size_t> best = Assignment(given, pivots(x)).best();
  const auto given_at = [&](std::size_t pivot) -> const std::complex<double>* {
    const auto found = std::find(best.begin(), best.end(), pivot);
    return found == best.end() ? nullptr : &given[static_cast<std::size_t>(found - best.begin())];
  };
  const auto p = static_cast<std::size_t>(program_->place()), s = static_cast<std::size_t>(program_->scale());
  std::complex<double> place = complex_at(x, program_->place()), scale = complex_at(x, program_->scale());
  // The pivot of the crank gives the place, one on the axis then turns and stretches the plane, or shifts it.
  const std::complex<double>* crank = given_at(0);
  if (crank) place = *crank;
  for (std::size_t k = 1; k < pivots_.size(); ++k)
    if (const std::complex<double>* at = given_at(k); at && pivots_[k].on_axis) {
      const std::complex<double> g = own_place_of(pivots_[k], x);
      if (!crank)
        place = *at - scale * g;
      else if (std::abs(g) > 0)
        scale = (*at - place) / g;
    }
  x[p] = place.real(), x[p + 1] = place.imag(), x[s] = scale.real(), x[s + 1] = scale.imag();
  for (std::size_t k = 1; k < pivots_.size(); ++k)
    if (const std::complex<double>* at = given_at(k); at && !pivots_[k].on_axis && std::abs(scale) > 0) {
      const std::complex<double> g = (*at - place) / scale;
      const auto i = static_cast<std::size_t>(pivots_[k].parameter);
      x[i] = g.real(), x[i + 1] = g.imag();
    }
}

void DimensionLimits::scale_freely(std::span<double> x) const {
  const auto s = static_cast<std::size_t>(program_->scale());
  MachineMeasures lengths;
  measure_lengths(x, lengths);
  const double ground = std::hypot(x[s], x[s + 1]) * std::abs(own_place_of(pivots_.back(), x));
  const double least = limits_.min_length / lengths.min_length,
               most = limits_.max_length / lengths.max_length;
  if (!(ground > 0) || !(least <= most)) return;
  const double by = std::clamp(1 / ground, least, most);
  x[s] *= by, x[s + 1] *= by;
}

std::size_t DimensionLimits::count() const {
  return 2 * lengths_.size() + (limits_.ground_box ? 4 * pivots_.size() : 0);
}

void DimensionLimits::missing(std::span<const double> x, std::span<double> values,
                              std::span<double> gradients) const {
  const auto s = static_cast<std::size_t>(program_->scale());
  const double scale = std::hypot(x[s], x[s + 1]);
  std::fill(gradients.begin(), gradients.end(), 0.0);
  std::size_t row = 0;
  const auto gradient = [&] { return gradients.subspan(row * x.size(), x.size()); };
  for (const LengthTerm& term : lengths_) {
    const double length = length_of(term, x, scale);
    for (const bool shortest : {true, false}) {
      values[row] = -std::log(shortest ? length / limits_.min_length : limits_.max_length / length);
      if (!gradients.empty()) add_log_gradient(term, x, shortest ? -1 : 1, gradient());
      ++row;
    }
  }
  const auto& box = limits_.ground_box;
  if (!box) return;
  const std::vector<std::complex<double>> at = pivots(x);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto keep = [&](bool upright, double by, double value) {
      values[row] = value;
      if (!gradients.empty()) add_coordinate_gradient(x, k, upright, by, gradient());
      ++row;
    };
    keep(false, -1, box->left - at[k].real()), keep(false, 1, at[k].real() - box->right);
    keep(true, -1, box->bottom - at[k].imag()), keep(true, 1, at[k].imag() - box->top);
  }
}

void DimensionLimits::measure_lengths(std::span<const double> x, MachineMeasures& out) const {
  const auto s = static_cast<std::size_t>(program_->scale());
  const double scale = std::hypot(x[s], x[s + 1]);
  out.min_length = infinity;
  for (const LengthTerm& term : lengths_) {
    const double length = length_of(term, x, scale);
    if (term.traced && length == 0) continue;
    out.min_length = std::min(out.min_length, length), out.max_length = std::max(out.max_length, length);
  }
}

bool DimensionLimits::pivots_in_box(std::span<const double> x) const {
  const auto& box = limits_.ground_box;
  if (!box) return true;
  const std::vector<std::complex<double>> at = pivots(x);
  return std::all_of(at.begin(), at.end(), [&](const std::complex<double>& p) {
    return p.real() >= box->left - 1e-9 && p.real() <= box->right + 1e-9 && p.imag() >= box->bottom - 1e-9 &&
           p.imag() <= box->top + 1e-9;
  });
}

bool DimensionLimits::pivots_as_given(std::span<const double> x) const {
  const auto& given = limits_.ground_pivots;
  if (given.empty()) return true;
  const std::vector<std::complex<double>> at = pivots(x);
  if (given.size() > at.size()) return false;
  const std::vector<std::size_t> best = Assignment(given, at).best();
  for (std::size_t i = 0; i < best.size(); ++i)
    if (!(std::abs(at[best[i]] - given[i]) <= limits_.pivot_tolerance)) return false;
  return true;
}

}  // namespace linkwright::planar
