// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/dwell_synthesis.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/dual.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Crank, coupler, rocker, C (u, v), E0 (x, y), link, output, middle of the dwell, output angle in the dwell.
constexpr std::size_t dwell_numbers = 11;
using Numbers = std::array<double, dwell_numbers>;
using DwellDual = math::Dual<static_cast<int>(dwell_numbers)>;

// Places of the turn and of the dwell where a search looks.
constexpr std::size_t turn_places = 72, dwell_places = 25;
// Starts that are refined, and designs that are kept.
constexpr std::size_t max_refined = 24, max_kept = 5;
// Directions and lengths of the output that are tried about the centre of a circle.
constexpr int output_directions = 24, output_lengths = 6;
// Longest crank, in grounds: one as long as the ground link passes a change point.
constexpr double longest_crank = 0.95;
// The share of the swing that a start must have.
constexpr double short_swing = 0.7;
constexpr int dwell_passes = 3;
// By how much the transmission angle may be less between two places than at them (rad).
constexpr double between_places = 3e-3;
// Designs whose numbers agree to this share are one.
constexpr double same_dwell = 2e-2;

Numbers numbers_of(const DwellLinkage& l, double angle) {
  return {l.crank,   l.coupler, l.rocker, l.point_u, l.point_v, l.pivot_x,
          l.pivot_y, l.link,    l.output, l.middle,  angle};
}
DwellLinkage linkage_with(std::span<const double> x, double side) {
  return {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8], side, x[9]};
}

template <class T>
struct DwellPlace {
  bool there = false;  // true if the loop assembles; `angle` also needs the dyad
  T cosine{}, angle{};
  bool closed = false;
};
// The six-bar at a crank angle from the middle of the dwell.
template <class T>
DwellPlace<T> place_dwell(const std::array<T, dwell_numbers>& x, double side, double from_middle) {
  using std::atan2, std::cos, std::sin, std::sqrt;
  DwellPlace<T> out;
  const auto& [crank, coupler, rocker, u, v, px, py, link, output, middle, rest] = x;
  const T phi = middle + from_middle;
  const T ax = crank * cos(phi), ay = crank * sin(phi);
  const T dx = 1.0 - ax, dy = -ay;
  const T square = dx * dx + dy * dy;
  const T along = (square + coupler * coupler - rocker * rocker) / (2.0 * square);
  const T across = coupler * coupler / square - along * along;
  if (!(across > 0.0)) return out;
  const T root = sqrt(across);
  const T ex = (along * dx - root * dy) / coupler, ey = (along * dy + root * dx) / coupler;
  const T gx = ax + u * ex - v * ey - px, gy = ay + u * ey + v * ex - py;  // from E0 to C
  const T reach = gx * gx + gy * gy;
  out.there = true;
  out.cosine = (link * link + output * output - reach) / (2.0 * link * output);
  const T along_c = (reach + output * output - link * link) / (2.0 * reach);
  const T across_c = output * output / reach - along_c * along_c;
  if (!(across_c > 0.0)) return out;
  const T root_c = -side * sqrt(across_c);
  out.angle = atan2(along_c * gy + root_c * gx, along_c * gx - root_c * gy);
  out.closed = true;
  return out;
}

double place_of_turn(std::size_t k) { return 2 * pi * static_cast<double>(k) / turn_places; }

// A start: how far it promises to be from a dwell.
struct DwellStart {
  DwellLinkage linkage;
  double angle = 0, score = infinity;
};

struct FittedCircle {
  Complex centre;
  double radius = 0, error = infinity;  // root mean square of the radial errors
};
// Least squares of |z|^2 = 2 Re(conj(centre) z) + k (Kasa 1976).
FittedCircle fit_circle(std::span<const Complex> points) {
  FittedCircle out;
  const double n = static_cast<double>(points.size());
  Complex mean = 0;
  for (const Complex& p : points) mean += p / n;
  double xx = 0, xy = 0, yy = 0, xw = 0, yw = 0, w = 0;
  for (const Complex& p : points) {
    const Complex z = p - mean;
    xx += z.real() * z.real(), xy += z.real() * z.imag(), yy += z.imag() * z.imag();
    xw += z.real() * std::norm(z), yw += z.imag() * std::norm(z), w += std::norm(z);
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-12 * w * w)) return out;
  const Complex centre(0.5 * (yy * xw - xy * yw) / determinant, 0.5 * (xx * yw - xy * xw) / determinant);
  out.centre = mean + centre;
  out.radius = std::sqrt(std::norm(centre) + w / n);
  double sum = 0;
  for (const Complex& p : points) sum += std::pow(std::abs(p - out.centre) - out.radius, 2);
  out.error = std::sqrt(sum / n);
  return out;
}

class DwellFinder {
 public:
  DwellFinder(const DwellProblem& problem, RunContext& context)
      : p_(problem), context_(context), max_cosine_(std::cos(problem.transmission + between_places)) {}

  DwellAnswer find() {
    for (int k = 0; k < p_.starts; ++k) {
      if (k % 100 == 0 && stopped("starts", static_cast<double>(k) / p_.starts)) break;
      try_four_bar(static_cast<std::uint32_t>(k));
      ++out_.starts;
    }
    std::stable_sort(starts_.begin(), starts_.end(),
                     [](const DwellStart& a, const DwellStart& b) { return a.score < b.score; });
    for (std::size_t k = 0; k < std::min(max_refined, starts_.size()); ++k) {
      if (stopped("refinement", static_cast<double>(k) / max_refined)) break;
      refine(starts_[k]);
    }
    rank();
    if (out_.status == Status::done && out_.designs.empty()) out_.status = Status::infeasible;
    return std::move(out_);
  }

 private:
  void try_four_bar(std::uint32_t individual) {
    RandomStream random({.seed = 1, .individual = individual});
    const auto length = [&](double from, double to) { return from * std::pow(to / from, random.uniform()); };
    DwellLinkage l;
    l.crank = length(p_.shortest, longest_crank);
    l.coupler = length(p_.shortest, p_.longest);
    l.rocker = length(p_.shortest, p_.longest);
    for (const double crank : {l.crank, -l.crank}) {
      const double cosine = (l.coupler * l.coupler + l.rocker * l.rocker - (1 - crank) * (1 - crank)) /
                            (2 * l.coupler * l.rocker);
      if (!(std::abs(cosine) < max_cosine_)) return;
    }
    const double reach = length(0.2, p_.longest), direction = random.uniform(-pi, pi);
    l.point_u = reach * std::cos(direction), l.point_v = reach * std::sin(direction);
    std::array<Complex, 2 * turn_places> curve;
    for (std::size_t k = 0; k < turn_places; ++k) {
      const Complex pin = std::polar(l.crank, place_of_turn(k)), d = 1.0 - pin;
      const double along = (std::norm(d) + l.coupler * l.coupler - l.rocker * l.rocker) / (2 * std::norm(d));
      const double root = std::sqrt(l.coupler * l.coupler / std::norm(d) - along * along);
      const Complex unit = d * Complex(along, root) / l.coupler;
      curve[k] = curve[k + turn_places] = pin + unit * Complex(l.point_u, l.point_v);
    }
    // The stretch of the dwell that is nearest to a circle.
    const std::size_t steps =
        std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(p_.dwell / (2 * pi) * turn_places)));
    FittedCircle best;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < turn_places; ++k) {
      const FittedCircle circle = fit_circle(std::span(curve).subspan(k, steps + 1));
      if (circle.radius < p_.shortest || circle.radius > p_.longest) continue;
      if (circle.error < best.error) best = circle, begin = k;
    }
    if (!std::isfinite(best.error)) return;
    l.link = best.radius;
    l.middle = place_of_turn(begin) + place_of_turn(steps) / 2;
    const DwellStart start =
        best_output(l, best, std::span(curve).first(turn_places), curve[begin + steps / 2]);
    if (std::isfinite(start.score)) starts_.push_back(start);
  }

  // The output about the centre of the circle with the least promised deviation for its swing.
  DwellStart best_output(DwellLinkage l, const FittedCircle& circle, std::span<const Complex> curve,
                         Complex rest) const {
    DwellStart best;
    for (int i = 0; i < output_lengths; ++i)
      for (int j = 0; j < output_directions; ++j) {
        l.output = p_.shortest * std::pow(p_.longest / p_.shortest, (i + 0.5) / output_lengths);
        const Complex pivot = circle.centre - std::polar(l.output, 2 * pi * j / output_directions);
        if (std::max(std::abs(pivot.real()), std::abs(pivot.imag())) > p_.longest) continue;
        const Complex from_c = pivot - rest, to_e = circle.centre - rest;
        l.side = std::imag(std::conj(from_c) * to_e) >= 0 ? 1 : -1;
        l.pivot_x = pivot.real(), l.pivot_y = pivot.imag();
        const Complex arm = circle.centre - pivot;
        double low = 0, high = 0;
        bool good = true;
        for (std::size_t k = 0; k < turn_places && good; ++k) {
          const Complex g = curve[k] - pivot;
          const double reach = std::norm(g);
          const double cosine = (l.link * l.link + l.output * l.output - reach) / (2 * l.link * l.output);
          good = std::abs(cosine) < max_cosine_;
          if (!good) break;
          const double along = (reach + l.output * l.output - l.link * l.link) / (2 * reach);
          const double root = -l.side * std::sqrt(l.output * l.output / reach - along * along);
          const double angle = std::arg(g * Complex(along, root) * std::conj(arm));
          low = std::min(low, angle), high = std::max(high, angle);
        }
        if (!good || high - low < short_swing * p_.swing) continue;
        const double sine = std::abs(std::imag(std::conj(arm) * to_e)) / (l.output * std::abs(to_e));
        const double score = circle.error / (l.output * sine);
        if (score < best.score) best = {l, std::arg(arm), score};
      }
    return best;
  }

  // Smallest departure within the dwell; transmission angles and swing at places of the turn are constraints.
  void refine(const DwellStart& start) {
    const double side = start.linkage.side;
    const auto duals = [](std::span<const double> x) {
      std::array<DwellDual, dwell_numbers> out;
      for (std::size_t j = 0; j < dwell_numbers; ++j) out[j] = DwellDual::variable(x[j], static_cast<int>(j));
      return out;
    };
    const auto store = [](const DwellDual& value, double factor, std::size_t row, std::span<double> values,
                          std::span<double> gradients) {
      values[row] = factor * value.value;
      if (gradients.empty()) return;
      for (std::size_t j = 0; j < dwell_numbers; ++j)
        gradients[row * dwell_numbers + j] = factor * value.by[j];
    };
    const double unit = 1e-3;  // rad, so that objectives and constraints are of like size
    const auto departures = [&](std::span<const double> x, std::span<double> values,
                                std::span<double> gradients) {
      const std::array<DwellDual, dwell_numbers> numbers = duals(x);
      for (std::size_t k = 0; k < dwell_places; ++k) {
        const double from = p_.dwell * (static_cast<double>(k) / (dwell_places - 1) - 0.5);
        const DwellPlace<DwellDual> place = place_dwell(numbers, side, from);
        DwellDual off(1e3);
        if (place.closed) {
          off = place.angle - numbers[10];
          off.value = math::wrap_angle(off.value);
        }
        store(off, 1 / unit, 2 * k, values, gradients);
        store(off, place.closed ? -1 / unit : 1 / unit, 2 * k + 1, values, gradients);
      }
    };
    // Cosines of both transmission angles, either sign, and the swing.
    constexpr std::size_t rows = 4 + 2 * turn_places + 1;
    const auto conditions = [&](std::span<const double> x, std::span<double> values,
                                std::span<double> gradients) {
      const std::array<DwellDual, dwell_numbers> numbers = duals(x);
      const auto& crank = numbers[0];
      const auto& coupler = numbers[1];
      const auto& rocker = numbers[2];
      std::size_t row = 0;
      const auto below = [&](const DwellDual& cosine) {
        store(cosine - max_cosine_, 1, row++, values, gradients);
        store(-cosine - max_cosine_, 1, row++, values, gradients);
      };
      for (const double sign : {1.0, -1.0}) {
        const DwellDual distance = 1.0 - sign * crank;
        below((coupler * coupler + rocker * rocker - distance * distance) / (2.0 * coupler * rocker));
      }
      DwellDual low(infinity), high(-infinity);
      for (std::size_t k = 0; k < turn_places; ++k) {
        const DwellPlace<DwellDual> place = place_dwell(numbers, side, place_of_turn(k));
        below(place.there ? place.cosine : DwellDual(2));
        if (!place.closed) continue;
        DwellDual angle = place.angle - numbers[10];
        angle.value = math::wrap_angle(angle.value);
        if (angle < low) low = angle;
        if (angle > high) high = angle;
      }
      const DwellDual swing = high > low ? high - low : DwellDual(0);
      store(p_.swing - swing, 1, row++, values, gradients);
    };
    Numbers x = numbers_of(start.linkage, start.angle), lower, upper;
    const double l = p_.longest, least = p_.shortest;
    lower = {least, least, least, -l, -l, -l, -l, least, least, -10, -10};
    upper = {longest_crank, l, l, l, l, l, l, l, l, 20, 10};
    // A search that begins again forgets the curvature that led it astray.
    for (int pass = 0; pass < dwell_passes; ++pass)
      optimise::minimise_largest(2 * dwell_places, departures, {}, rows, conditions, x, lower, upper,
                                 {.max_evaluations = 400}, context_);
    ++out_.refined;
    const std::optional<DwellDesign> design = assess_dwell(p_, linkage_with(x, side));
    if (design && design->swing >= p_.swing && design->four_bar_angle >= p_.transmission &&
        design->dyad_angle >= p_.transmission)
      out_.designs.push_back(*design);
  }

  void rank() {
    std::stable_sort(out_.designs.begin(), out_.designs.end(),
                     [](const DwellDesign& a, const DwellDesign& b) { return a.deviation < b.deviation; });
    std::vector<DwellDesign> kept;
    for (const DwellDesign& d : out_.designs) {
      const Numbers x = numbers_of(d.linkage, 0);
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const DwellDesign& k) {
        const Numbers y = numbers_of(k.linkage, 0);
        double apart = 0, size = 0;
        for (std::size_t j = 0; j < 9; ++j) apart += std::abs(x[j] - y[j]), size += std::abs(x[j]);
        return apart < same_dwell * size;
      });
      if (!known && kept.size() < max_kept) kept.push_back(d);
    }
    out_.designs = std::move(kept);
  }

  bool stopped(const char* stage, double fraction) {
    if (out_.status == Status::done) out_.status = context_.interruption();
    if (out_.status != Status::done) return true;
    context_.report({stage, fraction, nan});
    return false;
  }

  const DwellProblem& p_;
  RunContext& context_;
  double max_cosine_;
  std::vector<DwellStart> starts_;
  DwellAnswer out_;
};

}  // namespace

Linkage linkage_of(const DwellLinkage& d, double ground) {
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {ground, 0}}, {"E0", ground * Complex(d.pivot_x, d.pivot_y)}});
  add_bar(l, "crank", "O", "A", ground * d.crank);
  add_body(l, "coupler",
           {{"A", {0, 0}}, {"B", {ground * d.coupler, 0}}, {"C", ground * Complex(d.point_u, d.point_v)}});
  add_bar(l, "rocker", "B0", "B", ground * d.rocker);
  add_bar(l, "link", "C", "E", ground * d.link);
  add_bar(l, "output", "E0", "E", ground * d.output);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "B0", "ground.B0", "rocker.B0");
  add_pin(l, "C", "coupler.C", "link.C");
  add_pin(l, "E", "link.E", "output.E");
  add_pin(l, "E0", "ground.E0", "output.E0");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_mode(l, "link", "output", d.side > 0 ? AssemblyMode::plus : AssemblyMode::minus);
  return l;
}

std::optional<DwellOutput> output_of(const DwellLinkage& linkage, double crank_angle) {
  const DwellPlace<double> place =
      place_dwell(numbers_of(linkage, 0), linkage.side, crank_angle - linkage.middle);
  if (!place.closed) return std::nullopt;
  return DwellOutput{place.angle, place.cosine};
}

std::optional<DwellDesign> assess_dwell(const DwellProblem& problem, const DwellLinkage& l, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 8, "{} samples", samples);
  DwellDesign out;
  out.linkage = l;
  out.linkage.middle = l.middle - 2 * pi * std::floor(l.middle / (2 * pi));
  const std::optional<DwellOutput> rest = output_of(l, l.middle);
  if (!rest) return std::nullopt;
  const auto from_rest = [&](const DwellOutput& o) { return math::wrap_angle(o.angle - rest->angle); };
  double low = 0, high = 0, cosine = 0;
  for (int k = 0; k < samples; ++k) {
    const std::optional<DwellOutput> at = output_of(l, l.middle + 2 * pi * k / samples);
    if (!at) return std::nullopt;
    low = std::min(low, from_rest(*at)), high = std::max(high, from_rest(*at));
    cosine = std::max(cosine, std::abs(at->cosine));
  }
  out.swing = high - low;
  out.dyad_angle = std::atan2(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
  low = high = 0;
  for (int k = 0; k <= samples; ++k) {
    const auto at = output_of(l, l.middle + problem.dwell * (static_cast<double>(k) / samples - 0.5));
    if (!at) return std::nullopt;
    low = std::min(low, from_rest(*at)), high = std::max(high, from_rest(*at));
  }
  out.deviation = 0.5 * (high - low);
  double loop = 0;
  for (const double crank : {l.crank, -l.crank})
    loop = std::max(loop, std::abs((l.coupler * l.coupler + l.rocker * l.rocker - (1 - crank) * (1 - crank)) /
                                   (2 * l.coupler * l.rocker)));
  if (!(loop < 1)) return std::nullopt;
  out.four_bar_angle = std::atan2(std::sqrt((1 - loop) * (1 + loop)), loop);
  return out;
}

DwellAnswer find_dwells(const DwellProblem& problem, RunContext& context) {
  LINKWRIGHT_REQUIRE(problem.dwell > 0 && problem.dwell < 2 * pi, "dwell {} rad", problem.dwell);
  LINKWRIGHT_REQUIRE(problem.swing > 0 && problem.swing < pi, "swing {} rad", problem.swing);
  LINKWRIGHT_REQUIRE(problem.transmission >= 0 && problem.transmission < pi / 2, "transmission angle {} rad",
                     problem.transmission);
  LINKWRIGHT_REQUIRE(problem.shortest > 0 && problem.shortest < longest_crank && problem.longest > 1,
                     "links from {} to {} grounds", problem.shortest, problem.longest);
  return DwellFinder(problem, context).find();
}

}  // namespace linkwright::planar
