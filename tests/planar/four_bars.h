// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <numbers>
#include <ostream>

#include "linkwright/planar/four_bar/four_bar.h"
#include "support/generators.h"

namespace linkwright::planar {

/// Prints a counterexample of rapidcheck.
inline void showValue(const FourBar& l, std::ostream& out) {
  out << "{ground " << l.ground << ", crank " << l.crank << ", coupler " << l.coupler << ", rocker "
      << l.rocker << ", point " << l.coupler_u << ", " << l.coupler_v << ", pivot " << l.pivot_x << ", "
      << l.pivot_y << ", frame " << l.frame_angle << ", " << name_of(l.branch) << "}";
}

}  // namespace linkwright::planar

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

using linkwright::test::between;
using linkwright::test::log_between;

inline rc::Gen<double> any_angle() { return between(-7, 7); }
inline rc::Gen<Branch> any_branch() { return rc::gen::element(Branch::open, Branch::crossed); }

/// Any four-bar with links from 0.1 to 10 m; most of them assemble somewhere, few of them turn fully.
inline rc::Gen<FourBar> any_four_bar() {
  const auto link = log_between(0.1, 10), other = between(-5, 5);
  return rc::gen::build<FourBar>(
      rc::gen::set(&FourBar::ground, link), rc::gen::set(&FourBar::crank, link),
      rc::gen::set(&FourBar::coupler, link), rc::gen::set(&FourBar::rocker, link),
      rc::gen::set(&FourBar::coupler_u, other), rc::gen::set(&FourBar::coupler_v, other),
      rc::gen::set(&FourBar::pivot_x, other), rc::gen::set(&FourBar::pivot_y, other),
      rc::gen::set(&FourBar::frame_angle, any_angle()), rc::gen::set(&FourBar::branch, any_branch()));
}

/// A crank-rocker or double-crank by its slacks, off the change point: the crank rotates fully.
inline rc::Gen<FourBar> turning_four_bar() {
  return rc::gen::map(rc::gen::tuple(any_four_bar(), between(0.05, 2), between(0.05, 0.9), between(0.05, 0.9),
                                     rc::gen::arbitrary<bool>()),
                      [](const std::tuple<FourBar, double, double, double, bool>& t) {
                        auto [l, a1, a2, a3, crank_rocker] = t;
                        const double sign = crank_rocker ? 1 : -1;
                        l.ground = l.crank * (1 + 0.5 * sign * (a2 + a3));
                        l.coupler = l.crank * (1 + 0.5 * (a1 + sign * (crank_rocker ? a2 : a3)));
                        l.rocker = l.crank * (1 + 0.5 * (a1 + sign * (crank_rocker ? a3 : a2)));
                        return l;
                      });
}

}  // namespace linkwright::planar::test
