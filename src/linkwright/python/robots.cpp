// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/robot/robot.h"
#include "linkwright/python/arrays.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/values.h"

namespace linkwright::python {
namespace py = pybind11;
namespace {

parallel::Robot valid(parallel::Robot robot) {
  if (const auto wrong = parallel::problem(robot)) throw py::value_error(*wrong);
  return robot;
}

std::size_t legs(const parallel::Robot& robot) { return static_cast<std::size_t>(robot.legs()); }

parallel::WorkingMode mode_of(const parallel::Robot& robot, const std::vector<int>& given) {
  parallel::WorkingMode mode = parallel::all_positive;
  if (given.empty()) return mode;
  const bool signs = std::all_of(given.begin(), given.end(), [](int s) { return s == 1 || s == -1; });
  if (given.size() != legs(robot) || !signs)
    throw py::value_error(fmt::format("mode: {} signs, 1 or -1, are needed", legs(robot)));
  std::copy(given.begin(), given.end(), mode.begin());
  return mode;
}

py::array_t<double> inverse(const parallel::Robot& robot, const Array& positions, const Array& rotations,
                            const std::vector<int>& given) {
  const std::span<const double> p = samples_of(positions, 3, "position");
  const std::size_t n = p.size() / 3, turns = static_cast<std::size_t>(rotations.size()) / 9;
  if (rotations.size() % 9 != 0 || (turns != 0 && turns != n))
    throw py::value_error(fmt::format("rotation: an array ({}, 3, 3) is needed, or none", n));
  const parallel::WorkingMode mode = mode_of(robot, given);
  py::array_t<double> out = new_samples(n, legs(robot));
  double* to = out.mutable_data();
  const double* r = rotations.data();
  const Unlocked unlocked;
  for (std::size_t i = 0; i < n; ++i) {
    parallel::Pose pose{{p[3 * i], p[3 * i + 1], p[3 * i + 2]}};
    for (std::size_t k = 0; turns != 0 && k < 3; ++k) {
      const double* row = r + 9 * i + 3 * k;
      pose.rotation.row[k] = {row[0], row[1], row[2]};
    }
    const parallel::ArmAngles arms = parallel::inverse(robot, pose, mode);
    to = std::copy_n(arms.angle.begin(), legs(robot), to);
  }
  return out;
}

py::array_t<double> direct(const parallel::Robot& robot, const Array& angles, int assembly) {
  const std::span<const double> a = samples_of(angles, legs(robot), "angle");
  const std::size_t n = a.size() / legs(robot);
  py::array_t<double> out = new_samples(n, 3);
  double* to = out.mutable_data();
  const Unlocked unlocked;
  for (std::size_t i = 0; i < n; ++i, to += 3) {
    const parallel::Placed placed =
        parallel::direct(robot, a.subspan(i * legs(robot), legs(robot)), assembly);
    const bool done = placed.status == Status::done;
    to[0] = done ? placed.pose.position.x : nan;
    to[1] = done ? placed.pose.position.y : nan;
    to[2] = done ? placed.pose.position.z : nan;
  }
  return out;
}

}  // namespace

void bind_robots(py::module_& module) {
  py::class_<parallel::Robot>(module, "Robot", "A parallel robot: made by `delta`, `hexa` and `five_bar`.")
      .def_property_readonly("legs", &parallel::Robot::legs);
  module.def("delta",
             [](double base, double platform, double arm, double rod, const std::array<double, 3>& azimuth) {
               return valid(parallel::delta({base, platform, arm, rod, azimuth}));
             });
  module.def("hexa", [](double base, double offset, double platform, double angle, double arm, double rod) {
    return valid(parallel::hexa({base, offset, platform, angle, arm, rod}));
  });
  module.def("five_bar", [](const std::array<std::array<double, 4>, 2>& legs) {
    const auto leg = [](const std::array<double, 4>& l) {
      return parallel::PlanarLeg{.base_x = l[0], .base_y = l[1], .arm = l[2], .rod = l[3]};
    };
    return valid(parallel::planar(leg(legs[0]), leg(legs[1])));
  });
  module.def("inverse", &inverse);
  module.def("direct", &direct);
}

}  // namespace linkwright::python
