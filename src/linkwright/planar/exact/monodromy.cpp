// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/monodromy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

constexpr int max_monodromy_loops = 80, first_mechanisms = 40;
constexpr std::uint64_t first_seed = 1;
constexpr double identity_tolerance = 1e-9;

// The coefficients of a dyad at the point P0 + d, D when the body has turned by g, G: s d D + u d + v D + w =
// 0.
struct DyadAtPoint {
  double s;
  std::complex<double> u, v, w;
};
DyadAtPoint dyad_of_pins(const ComplexNumber& pin, const ComplexNumber& pivot,
                         const ComplexNumber& pin_partner, const ComplexNumber& pivot_partner,
                         const std::complex<double>& g, const std::complex<double>& G) {
  const auto x = standard_complex(pin), a = standard_complex(pivot), X = standard_complex(pin_partner),
             A = standard_complex(pivot_partner);
  return {1, X - A + X * G, x - a + x * g, -A * x * g - a * X * G};
}
template <class System>
std::array<DyadAtPoint, 2> dyads_of(const System&, const ComplexFourBar<>& z, const std::complex<double>& g,
                                    const std::complex<double>& G) {
  return {dyad_of_pins(z[pin_x], z[pivot_a], z[pin_X], z[pivot_A], g, G),
          dyad_of_pins(z[pin_y], z[pivot_b], z[pin_Y], z[pivot_B], g, G)};
}
template <template <class> class Curve>
std::array<DyadAtPoint, 2> dyads_of(const PosesAndPoints<Curve, ComplexSliderCrank>&,
                                    const ComplexSliderCrank& z, const std::complex<double>& g,
                                    const std::complex<double>& G) {
  const auto y = standard_complex(z[slider_y]), Y = standard_complex(z[slider_Y]),
             nu = standard_complex(z[guide_nu]);
  constexpr bool inverted = std::is_same_v<Curve<ComplexNumber>, InvertedCurveEquation<ComplexNumber>>;
  return {dyad_of_pins(z[slider_x], z[slider_a], z[slider_X], z[slider_A], g, G),
          inverted ? DyadAtPoint{0, 1.0 + G, nu * (1.0 + g), -nu * Y * g - y * G}
                   : DyadAtPoint{0, 1, nu, y * g + nu * Y * G}};
}

// The point of the coupler curve of a complex linkage when its coupler has turned by `rotation`: the first
// dyad's equation and a linear one, the second or its difference from the first.
template <class System>
void complex_curve_point(const System& system, const typename System::Bars& z,
                         const std::complex<double>& rotation, ComplexNumber& d, ComplexNumber& D) {
  const std::complex<double> g = rotation - 1.0, G = 1.0 / rotation - 1.0;
  const std::array<DyadAtPoint, 2> dyad = dyads_of(system, z, g, G);
  const double s = dyad[1].s;
  const auto u = dyad[0].u * s - dyad[1].u, v = dyad[0].v * s - dyad[1].v, w = dyad[0].w * s - dyad[1].w;
  // D = -(u d + w) / v
  const auto linear = dyad[0].u * v - dyad[0].v * u - w, constant = dyad[0].w * v - dyad[0].v * w;
  const auto place = (-linear + std::sqrt(linear * linear + 4.0 * u * constant)) / (-2.0 * u);
  d = complex_number(place);
  D = complex_number(-(u * place + w) / v);
}

// A linkage with points of its curve, from which paths start well: among some, the one whose equations are
// the farthest from singular.
template <class System>
void first_solution(const System& system, RandomStream& stream, SystemData<System>& data,
                    SystemPoint<System>& point) {
  double best = infinity;
  for (int trial = 0; trial < first_mechanisms; ++trial) {
    typename System::Bars bars;
    for (ComplexNumber& value : bars) value = random_complex(stream);
    std::array<ComplexNumber, System::others> d, D, turns;
    for (std::size_t j = 0; j < System::others; ++j) {
      const auto rotation = std::polar(std::exp(0.3 * stream.normal()), stream.uniform(0, 2 * pi));
      complex_curve_point(system, bars, rotation, d[j], D[j]);
      turns[j] = complex_number(rotation);
    }
    SystemData<System> p;
    SystemPoint<System> z;
    System::put(bars, d.data(), D.data(), turns.data(), p, z);
    double worst = 0;
    for (int side = 0; side < 3; ++side) {
      ComplexNumber values[System::unknowns], right[1][System::unknowns];
      math::tracker::Lu<double, System::unknowns> lu;
      system.evaluate(z.data(), p.data(), values, lu.a);
      for (ComplexNumber& value : right[0]) value = random_complex(stream);
      lu.solve(right);
      worst = std::max(worst, math::tracker::size(right[0]));
    }
    if (worst < best) best = worst, data = p, point = z;
  }
}

template <class System>
SystemData<System> random_data(RandomStream& stream) {
  SystemData<System> p;
  for (ComplexNumber& value : p) value = random_complex(stream);
  return p;
}

}  // namespace

bool same_identity(const ComplexNumber& a, const ComplexNumber& b) {
  const double size = 1 + std::sqrt(math::norm(a));
  return math::norm(a - b) < identity_tolerance * identity_tolerance * size * size;
}

int Identities::find(const ComplexNumber& identity) const {
  const double reach = identity_tolerance * (1 + std::sqrt(math::norm(identity)));
  auto at = std::lower_bound(sorted_.begin(), sorted_.end(), identity.re - reach,
                             [](const Entry& e, double re) { return e.identity.re < re; });
  for (; at != sorted_.end() && at->identity.re <= identity.re + reach; ++at)
    if (same_identity(identity, at->identity)) return at->number;
  return -1;
}

void Identities::add(const ComplexNumber& identity) {
  const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), identity.re,
                                   [](const Entry& e, double re) { return e.identity.re < re; });
  sorted_.insert(at, {identity, count_++});
}

template <class System>
StartSet<System> find_starts(std::uint64_t seed, std::size_t expected, RunContext& context,
                             std::string_view stage, const System& system) {
  RandomStream stream({.seed = seed, .run = System::data});
  const math::TrackerOptions options;
  StartSet<System> out;
  Paths<System> known(1);
  SystemData<System> first;
  first_solution<System>(system, stream, first, known[0].z);
  out.base = random_data<System>(stream);
  scale_solution<System>(scale_towards<System>(out.base, first), known[0].z);
  known = follow(system, first, out.base, known, options, context);
  out.followed = 1;
  Identities identities;
  // Takes what is not known yet among the ends of closed paths.
  const auto take = [&](Paths<System>& ends) {
    for (auto& end : ends) {
      if (!end.arrived) continue;
      System::settle(end.z);
      if (!(polish(system, out.base, end.z, 1e-14) < 1e-11)) continue;
      const ComplexNumber identity = System::identity(end.z);
      if (identities.find(identity) >= 0) continue;
      identities.add(identity);
      out.points.push_back(end.z);
    }
  };
  take(known);
  for (std::size_t quiet = 0; quiet < 1 || out.points.size() < expected;) {
    if (context.interrupted() || out.points.empty() || out.loops == max_monodromy_loops) break;
    SystemData<System> a = random_data<System>(stream), b = random_data<System>(stream);
    scale_towards<System>(out.base, a);
    scale_towards<System>(out.base, b);
    Paths<System> paths(out.points.size());
    for (std::size_t i = 0; i < paths.size(); ++i) paths[i].z = out.points[i];
    const SystemData<System>* from = &out.base;
    const std::array<const SystemData<System>*, 3> corners = {&a, &b, &out.base};
    for (const SystemData<System>* to : corners) {
      paths = follow(system, *from, *to, paths, options, context);
      out.followed += static_cast<int>(paths.size());
      const std::size_t before = paths.size();
      std::erase_if(paths, [](const auto& path) { return !path.arrived; });
      out.lost += static_cast<int>(before - paths.size());
      for (auto& path : paths) path.at = 0;
      from = to;
    }
    const std::size_t before = out.points.size();
    take(paths);
    quiet = out.points.size() == before ? quiet + 1 : 0;
    ++out.loops;
    if (!stage.empty())
      context.report({stage,
                      std::min(1.0, static_cast<double>(out.points.size()) / static_cast<double>(expected)),
                      nan});
  }
  out.status = context.interrupted()           ? context.interruption()
               : out.points.size() == expected ? Status::done
                                               : Status::not_converged;
  return out;
}

template <class System>
std::shared_ptr<const StartSet<System>> kept_starts(std::size_t expected, RunContext& context,
                                                    const System& system) {
  static std::mutex one_at_a_time;
  static std::map<std::size_t, std::shared_ptr<const StartSet<System>>> kept;
  const std::lock_guard lock(one_at_a_time);
  auto& known = kept[expected];
  if (known) return known;
  auto found = std::make_shared<StartSet<System>>(
      find_starts<System>(first_seed, expected, context, "start set", system));
  if (found->status == Status::done) known = found;
  return found;
}

#define LINKWRIGHT_FIND_STARTS(System)                                                             \
  template StartSet<System> find_starts(std::uint64_t, std::size_t, RunContext&, std::string_view, \
                                        const System&);
#define LINKWRIGHT_STARTS(System) \
  LINKWRIGHT_FIND_STARTS(System)  \
  template std::shared_ptr<const StartSet<System>> kept_starts(std::size_t, RunContext&, const System&);
LINKWRIGHT_FIND_STARTS(NinePoints)
LINKWRIGHT_STARTS(FivePointsTwoPivots)
LINKWRIGHT_STARTS(SevenPointsOnePivot)
LINKWRIGHT_STARTS(FourBarPoses)
LINKWRIGHT_STARTS(SliderPoses)
LINKWRIGHT_STARTS(InvertedPoses)
#undef LINKWRIGHT_STARTS
#undef LINKWRIGHT_FIND_STARTS

}  // namespace linkwright::planar
