// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/polish.h"
#include "support/published.h"

// Strokes and machines that the tests of type synthesis share.
namespace linkwright::planar::test {

/// Names of the published strokes.
inline const std::vector<std::string>& stroke_names() {
  static const std::vector<std::string> all{"superellipse", "figure_eight", "d_shape", "leg",    "triangle",
                                            "letter_s",     "letter_u",     "heart",   "square", "star3",
                                            "lens",         "line_return",  "step",    "spiral"};
  return all;
}

inline const Value& stroke_case(const std::string& name) {
  return linkwright::test::published_case("draw-a-motion.json", name);
}

inline Stroke stroke_of(const Value& published) {
  Stroke out;
  out.closed = linkwright::test::at(published, "closed").as_bool();
  for (const Value& point : linkwright::test::at(published, "points").as_array()) {
    const std::vector<double> xy = linkwright::test::numbers(point);
    out.points.emplace_back(xy[0], xy[1]);
  }
  return out;
}

/// Every program up to eight links.
inline std::vector<const PointProgram*> all_programs() {
  std::vector<const PointProgram*> out;
  for (const auto& family : names(MachineFamily{}))
    for (const PointProgram* p : programs_of(family.value)) out.push_back(p);
  return out;
}

/// Every program whose output is a link or a slider on the ground.
inline std::vector<const PointProgram*> function_programs() {
  std::vector<const PointProgram*> out;
  for (const MachineOutput output : {MachineOutput::angle, MachineOutput::slide})
    for (const auto& family : names(MachineFamily{}))
      for (const PointProgram* p : programs_of(family.value, output)) out.push_back(p);
  return out;
}

/// A shape of a program that turns fully; the draw is repeated until it does.
inline MachineShape some_shape(const PointProgram& p, std::uint64_t seed) {
  for (std::uint32_t k = 0; k < 100'000; ++k) {
    RandomStream random({.seed = seed, .individual = k});
    MachineShape shape{.program = &p};
    if (draw_shape(shape, 0, random)) return shape;
  }
  ADD_FAILURE() << p.name << " cannot be drawn";
  return {};
}

/// Traced points of a machine at crank angles.
inline std::vector<std::complex<double>> traced(const MachineShape& shape, std::vector<double> angles) {
  const std::size_t count = angles.size();
  angles.resize((count + 7) / 8 * 8, angles.back());
  std::vector<double> x(angles.size()), y(angles.size());
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angles.data(),
                 .count = angles.size(),
                 .px = x.data(),
                 .py = y.data()});
  std::vector<std::complex<double>> out;
  for (std::size_t k = 0; k < count; ++k) out.emplace_back(x[k], y[k]);
  return out;
}

/// A machine that draws its own curve, so that its error is nothing but rounding.
struct OwnCurve {
  MotionTarget target;
  MachineFitter fitter;
  FittedMachine machine;
  MachineMeasures measures;

  explicit OwnCurve(const PointProgram& p) : OwnCurve(shape_of(p)) {}

 private:
  static MachineShape shape_of(const PointProgram& p) {
    MachineShape shape = some_shape(p, 5);
    double* x = shape.x.data() + shape.x.size() - 4;
    x[0] = 0.1, x[1] = -0.05, x[2] = 0.03, x[3] = 0.06;
    return shape;
  }
  static std::vector<double> turn() {
    std::vector<double> out;
    for (int k = 0; k < 480; ++k) out.push_back(2 * pi * k / 480);
    return out;
  }
  explicit OwnCurve(const MachineShape& shape)
      : target(sampled_stroke({traced(shape, turn()), true})), fitter(target, {.min_pair_angle = 0.02}) {
    machine.shape = shape;
    double* x = machine.shape.x.data() + machine.shape.x.size() - 4;
    const std::complex<double> place =
        (std::complex<double>(x[0], x[1]) - target.stroke.centre) / target.stroke.size;
    x[0] = place.real(), x[1] = place.imag(), x[2] /= target.stroke.size, x[3] /= target.stroke.size;
    for (std::size_t k = 0; k < stroke_samples; ++k) machine.angle[k] = 2 * pi * static_cast<double>(k) / 96;
    measures = fitter.measure(machine);
  }
};

}  // namespace linkwright::planar::test
