// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/simulation/elastic_body.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

// A steel strip of 20 mm x 4 mm that bends about its thin side.
constexpr double modulus = 2.1e11, area = 8e-5, second_moment = 0.02 * 4e-3 * 4e-3 * 4e-3 / 12,
                 density = 7850, stiffness = modulus * second_moment;
inline ElasticBody strip(int body, int segments) {
  return {.body = body,
          .elastic_modulus = modulus,
          .second_moment = second_moment,
          .area = area,
          .density = density,
          .segments = segments,
          .fibre_distance = 2e-3};
}

inline ElasticLinkage made(const Linkage& l, const std::vector<ElasticBody>& bodies,
                           const std::vector<InputMotion>& inputs) {
  ElasticLinkage e = with_elastic_bodies(l, bodies, inputs);
  for (const Diagnostic& d : e.problems) ADD_FAILURE() << to_string(d);
  EXPECT_EQ(e.status, Status::done);
  return e;
}

// x of a x = b, by Gauss's elimination with row pivots.
inline std::vector<double> solved(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

// A linkage held at rest by its drives, in its free inputs about where it is not bent: forces, and masses and
// stiffnesses by central differences.
class AtRest {
 public:
  AtRest(const ElasticLinkage& e, const std::vector<InputMotion>& drives)
      : e_(e), inputs_(drives), dynamics_(e.linkage, e.plan, mask(drives.size(), e.free.size())) {
    for (const InputDrive& c : e.free) inputs_.push_back({c.value, 0, 0});
  }
  std::size_t free() const { return e_.free.size(); }
  LinkageMotion& motion() { return dynamics_.motion; }
  double& value(std::size_t k) { return inputs_[inputs_.size() - free() + k].value; }

  std::vector<double> forces() {
    EXPECT_EQ(dynamics_.solve(0, inputs_), Status::done);
    mass.assign(free(), std::vector<double>(free()));
    std::vector<double> out(free());
    for (std::size_t i = 0; i < free(); ++i)
      for (std::size_t j = 0; j < free(); ++j) {
        mass[i][j] = dynamics_.inertia()[i * free() + j];
        out[i] += mass[i][j] * inputs_[inputs_.size() - free() + j].acceleration;
      }
    return out;
  }
  std::vector<std::vector<double>> stiffnesses() {
    std::vector<std::vector<double>> k(free(), std::vector<double>(free()));
    const double h = 1e-5;  // the error of the differences is of order h^2 = 1e-10
    for (std::size_t j = 0; j < free(); ++j) {
      value(j) += h;
      const std::vector<double> above = forces();
      value(j) -= 2 * h;
      const std::vector<double> below = forces();
      value(j) += h;
      for (std::size_t i = 0; i < free(); ++i) k[i][j] = (below[i] - above[i]) / (2 * h);
    }
    return k;
  }
  // Two steps of Newton's method: loads of these tests bend little.
  void settle() {
    for (int step = 0; step < 2; ++step) {
      const auto k = stiffnesses();
      const std::vector<double> by = solved(k, forces());
      for (std::size_t i = 0; i < free(); ++i) value(i) += by[i];
    }
    forces();
  }
  // First frequency (rad/s), by inverse iteration.
  double first_frequency() {
    const auto k = stiffnesses();
    forces();
    std::vector<double> x(free());
    for (std::size_t i = 0; i < free(); ++i) x[i] = 1.0 + 0.1 * static_cast<double>(i);
    double square = 0;
    for (int step = 0; step < 40; ++step) {
      std::vector<double> mx(free());
      for (std::size_t i = 0; i < free(); ++i)
        for (std::size_t j = 0; j < free(); ++j) mx[i] += mass[i][j] * x[j];
      const std::vector<double> y = solved(k, mx);
      double above = 0, below = 0;  // Rayleigh's quotient of y: y.M x / y.M y
      for (std::size_t i = 0; i < free(); ++i) {
        above += y[i] * mx[i];
        for (std::size_t j = 0; j < free(); ++j) below += y[i] * mass[i][j] * y[j];
      }
      square = above / below;
      for (std::size_t i = 0; i < free(); ++i) x[i] = y[i] / std::sqrt(below);
    }
    return std::sqrt(square);
  }
  std::vector<std::vector<double>> mass;

 private:
  static std::vector<bool> mask(std::size_t drives, std::size_t free) {
    std::vector<bool> out(drives, false);
    out.resize(drives + free, true);
    return out;
  }
  const ElasticLinkage& e_;
  std::vector<InputMotion> inputs_;
  LinkageDynamics dynamics_;
};

// Four-bar with coupler A-B of 0.4 m.
inline Linkage four_bar() {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.45, 0}}});
  add_bar(l, "crank", "O", "A", 0.1);
  add_bar(l, "coupler", "A", "B", 0.4);
  add_bar(l, "rocker", "C", "B", 0.25);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "C", "ground.C", "rocker.C");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 1);
  l.gravity = 0;
  return l;
}

// Crank of 50 mm, rod of 300 mm, slider of 0.2 kg; no weight.
inline Linkage slider_crank() {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "B", 0.3);
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.O", "slider.B");
  add_drive(l, "O");
  set_mode(l, "rod", "slider", AssemblyMode::plus);
  set_uniform(l, "crank", 0.1);
  set_uniform(l, "rod", density * area * 0.3);
  l.bodies[3].mass = BodyMass{0.2, 0, 0};
  l.gravity = 0;
  return l;
}

inline std::vector<InputDrive> drives(const ElasticLinkage& e, double speed) {
  std::vector<InputDrive> out{{math::ConstantSpeed{0, speed}, 0, 0}};
  out.insert(out.end(), e.free.begin(), e.free.end());
  return out;
}
inline std::vector<double> times_to(double end, int rows) {
  std::vector<double> out;
  for (int i = 0; i <= rows; ++i) out.push_back(end * i / rows);
  return out;
}

}  // namespace linkwright::planar::test
