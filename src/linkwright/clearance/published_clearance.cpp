// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/mass_synthesis.h"
#include "linkwright/clearance/path_synthesis.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/differences.h"

namespace linkwright::clearance {
namespace {

constexpr double clearance = 1e-3, phase = 10 * full_turn / 360;

planar::FourBar linkage(double ground, double crank, double coupler, double rocker, double distance,
                        double angle_degrees, double pivot_x, double pivot_y, double frame_degrees) {
  const double angle = math::radians(angle_degrees);
  return {.ground = ground,
          .crank = crank,
          .coupler = coupler,
          .rocker = rocker,
          .coupler_u = distance * std::cos(angle),
          .coupler_v = distance * std::sin(angle),
          .pivot_x = pivot_x,
          .pivot_y = pivot_y,
          .frame_angle = math::radians(frame_degrees)};
}

}  // namespace

ClearanceFourBar published_design_1() {
  return {.linkage = linkage(0.2, 0.1, 0.2, 0.25, 0.1, 45, 0, 0, 0),
          .clearance = clearance,
          .coupler = {0.0737, 0.000202, {0.09, 0}},
          .rocker = {0.049, 0.0000619, {0.06, 0}},
          .gravity = 0};
}
ClearanceFourBar published_design_2() {
  return {.linkage = linkage(0.2027109, 0.0994677, 0.2009446, 0.2506397, 0.1008002, 44.9, 0.00019004,
                             -0.0011355, 0.51),
          .clearance = clearance,
          .coupler = {0.0654, 0.0000145, {0.00038, 0}},
          .rocker = {0.052, 0.0000245, {0.00435, 0}},
          .gravity = 0};
}

ClearancePathProblem published_path_problem() {
  ClearancePathProblem p;
  ClearanceFourBar ideal = published_design_1();
  ideal.clearance = 0;
  for (int k = 0; k < 36; ++k) {
    const double angle = full_turn * k / 36;
    const std::complex<double> point = clearance_position(ideal, angle, 0).point;
    p.x.push_back(point.real());
    p.y.push_back(point.imag());
    p.crank_angles.push_back(angle);
  }
  p.clearance = clearance;
  p.phase = phase;
  const double tenth = math::radians(10);
  p.bounds = {{{0.15, 0.25},
               {0.06, 0.14},
               {0.15, 0.25},
               {0.2, 0.3},
               {0.05, 0.15},
               {-0.01, 0.01},
               {-0.01, 0.01},
               {math::radians(20), math::radians(70)},
               {-tenth, tenth}}};
  return p;
}

double inferred_clearance() {
  ClearancePathProblem p = published_path_problem();
  const std::vector<double> x = path_variables(p, published_design_2().linkage);
  const auto misfit = [&](std::span<const double> r, std::span<double> residuals, std::span<double>) {
    p.clearance = r[0];
    return clearance_path_residuals(p, x, residuals, {});
  };
  const std::size_t m = 2 * p.x.size();
  const auto residuals = [&](std::span<const double> r, std::span<double> out, std::span<double> jacobian) {
    const std::vector<double> scale{0.01};
    return misfit(r, out, {}) &&
           (jacobian.empty() || math::central_jacobian(misfit, m, r, jacobian, scale) == Status::done);
  };
  math::LeastSquaresWorkspace workspace;
  std::vector<double> r{clearance};
  math::minimise_least_squares(residuals, m, r, {.decrease_tolerance = 0, .step_tolerance = 1e-12},
                               workspace);
  return r[0];
}

ClearanceMassProblem published_mass_problem() {
  ClearanceMassProblem p;
  p.model = published_design_2();
  p.crank = {0, 10};
  p.phase = phase;
  p.bounds = {{{0.02, 0.2},
               {-0.05, 0.2},
               {-0.05, 0.05},
               {1e-6, 5e-4},
               {0.02, 0.2},
               {-0.05, 0.25},
               {-0.05, 0.05},
               {1e-6, 5e-4}}};
  return p;
}

std::vector<ClearanceComparison> compare_with_published_clearance() {
  std::vector<ClearanceComparison> out;
  const ClearancePathProblem path = published_path_problem();
  const auto add = [&](const char* quantity, const char* published, double ours, const char* verdict,
                       const char* note) {
    out.push_back({quantity, published, ours, verdict, note});
  };
  add("radial clearance, mm", "not printed", 1e3 * inferred_clearance(), "not reproduced",
      "of the closest fit; 1 mm is taken");
  add("objective of design 2, mm", "not printed",
      1e3 * clearance_path_design(path, path_variables(path, published_design_2().linkage)).objective,
      "not reproduced", "the source prints no value of its objectives");
  std::vector<double> x = path_variables(path, published_design_2().linkage);
  polish_clearance_path(path, x);
  add("objective of the best design, mm", "not printed", 1e3 * clearance_path_design(path, x).objective,
      "not reproduced", "four times less than design 2, by least squares from there");

  const UniformCrank crank{0, 10};
  const LinkState start{phase, 10};
  const std::vector<double> times{0, full_turn / 10};
  const ClearanceRun calm =
      simulate_clearance(published_design_2(), math::ConstantSpeed{0, 10}, start, times);
  const ClearanceRun wild =
      simulate_clearance(published_design_1(), math::ConstantSpeed{0, 10}, start, times);
  add("minimum tension of design 2, N", "contact is kept (figure 5)", calm.min_tension, "reproduced",
      "positive over the whole turn");
  add("fastest clearance link of design 2, of the crank's speed", "smooth (figure 5)", calm.fastest_link / 10,
      "reproduced", "");
  add("fastest clearance link of design 1, of the crank's speed", "violent (figure 4)",
      wild.fastest_link / 10, "reproduced", "about 37; the motion is chaotic");
  add("changes of sign of the tension of design 1 in a turn", "not tested", wild.sign_changes, "corrected",
      "contact is lost, so that the printed peaks lie outside of the model");
  const ClearanceOrbit orbit = find_orbit(published_design_2(), crank, 0.15, -0.3);
  add("least root mean square difference from a phase of 10 degrees on the orbit, degrees",
      "agreement (figure 5)",
      math::degrees(phase_error(published_design_2(), crank, orbit.start(crank), phase, 72)) *
          std::sqrt(72.0),
      "corrected",
      "a passive coupler in contact cannot stay ahead throughout: over a turn no work is done on it");
  return out;
}

}  // namespace linkwright::clearance
