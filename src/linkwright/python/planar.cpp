// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/four_bar/sweep.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/sweep.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/python/arrays.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/rows.h"
#include "linkwright/python/study_source.h"
#include "linkwright/python/values.h"
#include "linkwright/study/bind.h"

namespace linkwright::python {
namespace py = pybind11;
namespace {

/// The numbers of a struct with a field list, from the attributes of their names.
struct FromAttributes {
  py::handle object;
  template <class T>
  void operator()(const Field& field, T& member) const {
    const py::object value = object.attr(std::string(field.key).c_str());
    if constexpr (std::is_same_v<T, double>)
      member = value.cast<double>();
    else
      fields(FromAttributes{value}, member);
  }
};

// 1. Four-bars

constexpr std::array<const char*, planar::four_bar_row_count> row_names = {"crank_x",
                                                                           "crank_y",
                                                                           "coupler_x",
                                                                           "coupler_y",
                                                                           "rocker_x",
                                                                           "rocker_y",
                                                                           "transmission_sine",
                                                                           "coupler_speed",
                                                                           "rocker_speed",
                                                                           "coupler_acceleration",
                                                                           "rocker_acceleration",
                                                                           "ground_on_crank_x",
                                                                           "ground_on_crank_y",
                                                                           "crank_on_coupler_x",
                                                                           "crank_on_coupler_y",
                                                                           "rocker_on_coupler_x",
                                                                           "rocker_on_coupler_y",
                                                                           "ground_on_rocker_x",
                                                                           "ground_on_rocker_y",
                                                                           "drive_torque",
                                                                           "shaking_force_x",
                                                                           "shaking_force_y",
                                                                           "shaking_moment",
                                                                           "shaking_moment_with_drive"};

planar::FourBar four_bar_of(const py::handle& object) {
  planar::FourBar out;
  fields(FromAttributes{object}, out);
  const auto word = object.attr("branch").cast<std::string>();
  if (word != "open" && word != "crossed")
    throw py::value_error(fmt::format("branch is '{}', must be 'open' or 'crossed'", word));
  out.branch = word == "open" ? planar::Branch::open : planar::Branch::crossed;
  return out;
}

planar::FourBarMasses masses_of(const py::handle& object) {
  planar::FourBarMasses out;
  if (!object.is_none()) fields(FromAttributes{object}, out);
  return out;
}

/// Sweeps of many samples: Ctrl-C ends them. Few take less than it costs to look after them.
template <class Run>
void run_samples(std::size_t count, Run&& run) {
  constexpr std::size_t few = 100'000;
  if (count < few) {
    const Unlocked unlocked;
    return run(nullptr);
  }
  RunContext context;
  work_beside_python([&] { run(&context); }, [] {}, [&] { context.cancel(); });
}

/// A sweep whose memory is used again once nobody looks at the rows of the last run.
template <class Sweep>
class Reused {
 public:
  template <class Make>
  std::shared_ptr<Sweep> take(Make&& make) {
    std::shared_ptr<Sweep> mine = std::move(sweep_);  // another thread of Python finds none and makes its own
    return mine && mine.use_count() == 1 ? mine : make();
  }
  void give_back(std::shared_ptr<Sweep> sweep) { sweep_ = std::move(sweep); }

 private:
  std::shared_ptr<Sweep> sweep_;
};

class FourBarSweeps {
 public:
  FourBarSweeps(bool directions, bool rates, bool forces, bool shaking)
      : wanted_{directions, rates, forces, shaking} {}

  Rows run(const py::object& linkage, const Array& angle, const Array& speed, const Array& acceleration,
           const py::object& masses, double gravity) {
    const planar::FourBar four_bar = four_bar_of(linkage);
    const planar::FourBarMasses m = masses_of(masses);
    const planar::SweepInput crank{samples(angle, "crank_angle"), samples(speed, "crank_speed"),
                                   samples(acceleration, "crank_acceleration")};
    auto sweep = reused_.take([&] { return std::make_shared<planar::FourBarSweep>(wanted_); });
    run_samples(crank.value.size(),
                [&](const RunContext* context) { sweep->run(four_bar, m, gravity, crank, context); });
    Rows out{sweep, {}, sweep->status()};
    const std::array<bool, 4> kept{wanted_.directions, wanted_.rates, wanted_.forces, wanted_.shaking};
    constexpr std::array<std::size_t, 4> ends{7, 11, 19, planar::four_bar_row_count};
    for (std::size_t row = 0, part = 0; row < planar::four_bar_row_count; ++row) {
      if (row == ends[part]) ++part;
      if (kept[part]) out.rows.emplace_back(row_names[row], sweep->row(static_cast<planar::FourBarRow>(row)));
    }
    reused_.give_back(std::move(sweep));
    return out;
  }

 private:
  planar::FourBarWanted wanted_;
  Reused<planar::FourBarSweep> reused_;
};

py::array_t<double> coupler_points(const py::object& linkage, const Array& angle) {
  const planar::FourBar l = four_bar_of(linkage);
  const std::span<const double> angles = samples(angle, "crank_angle");
  py::array_t<double> out = new_samples(angles.size(), 2);
  double* at = out.mutable_data();
  run_samples(angles.size(), [&](const RunContext* context) {
    planar::FourBarSweep sweep({.directions = true, .rates = false, .forces = false, .shaking = false});
    // A block at a time, so that the rows stay in the cache.
    constexpr std::size_t block = 4096;
    for (std::size_t first = 0; first < angles.size(); first += block) {
      const std::size_t count = std::min(block, angles.size() - first);
      sweep.run(l, {}, 0, {angles.subspan(first, count), {}, {}}, context);
      const auto cx = sweep.row(planar::FourBarRow::crank_x), cy = sweep.row(planar::FourBarRow::crank_y),
                 kx = sweep.row(planar::FourBarRow::coupler_x), ky = sweep.row(planar::FourBarRow::coupler_y);
      for (std::size_t i = 0; i < count; ++i, at += 2) {
        at[0] = l.pivot_x + l.crank * cx[i] + l.coupler_u * kx[i] - l.coupler_v * ky[i];
        at[1] = l.pivot_y + l.crank * cy[i] + l.coupler_u * ky[i] + l.coupler_v * kx[i];
      }
    }
  });
  return out;
}

// 2. Any linkage, as a study describes it

planar::LinkageType type_of(std::string_view mechanism) {
  if (mechanism == "planar.four_bar") return planar::LinkageType::four_bar;
  if (mechanism == "planar.slider_crank") return planar::LinkageType::slider_crank;
  if (mechanism == "planar.linkage") return planar::LinkageType::linkage;
  throw py::value_error(fmt::format(
      "the mechanism is a {}, must be a planar.linkage, planar.four_bar or planar.slider_crank", mechanism));
}

planar::LinkageStudy linkage_of(const StudySource& source) {
  Diagnostics diagnostics;
  const auto study = prepared(source, diagnostics);
  if (!study) raise_study_error(diagnostics);
  if (study->kind->kind != "analysis")
    throw py::value_error(fmt::format("the study is of kind '{}', must be an analysis", study->kind->kind));
  const planar::LinkageType type = type_of(study->kind->mechanism);
  study::DocumentReader reader(source.document, source.file, diagnostics);
  study::ObjectReader root = reader.root();
  auto out =
      planar::read_linkage_study(root, study->common, type, nullptr, planar::WithoutMasses::motion_alone);
  if (!out) raise_study_error(diagnostics);
  return std::move(*out);
}

/// Rows of a linkage, which know where its points are.
struct LinkageRows : Rows {
  std::shared_ptr<const planar::LinkageStudy> study;
  std::shared_ptr<const planar::LinkageSweep> sweep;

  /// Places of a point, "body.point".
  py::array_t<double> point(const std::string& name) const {
    const auto dot = name.rfind('.');
    const int body = dot == name.npos ? -1 : planar::body_index(study->linkage, name.substr(0, dot));
    const auto b = static_cast<std::size_t>(std::max(body, 0));
    const int index = body < 0 ? -1 : planar::point_index(study->linkage.bodies[b], name.substr(dot + 1));
    if (index < 0) throw py::key_error(fmt::format("the linkage has no point '{}'", name));
    const planar::BodyOnPart& on = study->plan.bodies[b];
    const std::complex<double> local = std::complex<double>(on.origin.x, on.origin.y) +
                                       study->linkage.bodies[b].points[static_cast<std::size_t>(index)].at *
                                           std::complex<double>(on.turn.x, on.turn.y);
    py::array_t<double> out = new_samples(status.size(), 2);
    double* to = out.mutable_data();
    if (on.part == 0) {
      for (std::size_t i = 0; i < status.size(); ++i, to += 2) to[0] = local.real(), to[1] = local.imag();
      return out;
    }
    using enum planar::PartRow;
    const auto ox = sweep->part(on.part, x), oy = sweep->part(on.part, y),
               c = sweep->part(on.part, direction_x), s = sweep->part(on.part, direction_y);
    for (std::size_t i = 0; i < status.size(); ++i, to += 2) {
      to[0] = ox[i] + c[i] * local.real() - s[i] * local.imag();
      to[1] = oy[i] + s[i] * local.real() + c[i] * local.imag();
    }
    return out;
  }
};

class LinkageSweeps {
 public:
  LinkageSweeps(const StudySource& source, bool rates, bool forces)
      : study_(std::make_shared<planar::LinkageStudy>(linkage_of(source))), wanted_{rates, forces} {
    reused_.give_back(make());  // says now what is missing
  }

  std::vector<std::string> inputs() const {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < study_->plan.inputs(); ++i)
      out.push_back(planar::input_joint(study_->linkage, i).name);
    return out;
  }
  std::vector<std::string> points() const {
    std::vector<std::string> out;
    for (const planar::LinkageBody& body : study_->linkage.bodies)
      for (const planar::LinkagePoint& point : body.points) out.push_back(body.name + "." + point.name);
    return out;
  }

  LinkageRows run(const std::vector<Array>& values, const std::vector<Array>& rates,
                  const std::vector<Array>& accelerations) {
    const std::size_t n = study_->plan.inputs();
    if (values.size() != n || rates.size() != n || accelerations.size() != n)
      throw py::value_error(
          fmt::format("the linkage has {} inputs, got {} values, {} rates and {} accelerations", n,
                      values.size(), rates.size(), accelerations.size()));
    std::vector<planar::SweepInput> inputs;
    for (std::size_t i = 0; i < n; ++i)
      inputs.push_back({samples(values[i], "value"), samples(rates[i], "rate"),
                        samples(accelerations[i], "acceleration")});
    auto sweep = reused_.take([&] { return make(); });
    run_samples(inputs.empty() ? 0 : inputs[0].value.size(),
                [&](const RunContext* context) { sweep->run(inputs, {}, context); });
    LinkageRows out{{sweep, {}, sweep->status()}, study_, sweep};
    add_parts(*sweep, out);
    if (wanted_.forces) add_forces(*sweep, out);
    reused_.give_back(std::move(sweep));
    return out;
  }

 private:
  std::shared_ptr<planar::LinkageSweep> make() const {
    return std::make_shared<planar::LinkageSweep>(study_->linkage, study_->plan, wanted_);
  }

  void add_parts(const planar::LinkageSweep& sweep, Rows& out) const {
    constexpr std::array<const char*, 10> names{
        "x",          "y",     "direction_x",    "direction_y",    "velocity_x",
        "velocity_y", "speed", "acceleration_x", "acceleration_y", "angular_acceleration"};
    for (std::size_t part = 1; part < study_->plan.parts.size(); ++part)
      for (std::size_t row = 0; row < (wanted_.rates ? names.size() : 4); ++row)
        out.rows.emplace_back(fmt::format("{}.{}", study_->plan.parts[part], names[row]),
                              sweep.part(static_cast<int>(part), static_cast<planar::PartRow>(row)));
  }

  void add_forces(const planar::LinkageSweep& sweep, Rows& out) const {
    constexpr std::array<const char*, 3> names{"force_x", "force_y", "moment"};
    for (std::size_t joint = 0; joint < study_->linkage.joints.size(); ++joint)
      for (std::size_t row = 0; row < names.size(); ++row)
        out.rows.emplace_back(fmt::format("{}.{}", study_->linkage.joints[joint].name, names[row]),
                              sweep.joint(static_cast<int>(joint), static_cast<planar::JointRow>(row)));
    for (std::size_t input = 0; input < study_->plan.inputs(); ++input)
      out.rows.emplace_back(fmt::format("{}.drive", planar::input_joint(study_->linkage, input).name),
                            sweep.drive(static_cast<int>(input)));
    constexpr std::array<const char*, 3> shaking{"shaking.force_x", "shaking.force_y",
                                                 "shaking.moment_with_drive"};
    for (std::size_t row = 0; row < shaking.size(); ++row)
      out.rows.emplace_back(shaking[row], sweep.shaking(static_cast<planar::ShakingRow>(row)));
  }

  std::shared_ptr<const planar::LinkageStudy> study_;
  planar::SweepWanted wanted_;
  Reused<planar::LinkageSweep> reused_;
};

}  // namespace

void bind_planar(py::module_& module) {
  py::class_<Rows>(module, "Rows")
      .def("keys",
           [](const Rows& r) {
             std::vector<std::string> out;
             for (const auto& row : r.rows) out.push_back(row.first);
             return out;
           })
      .def("row",
           [](const Rows& r, const std::string& key) {
             for (const auto& row : r.rows)
               if (row.first == key) return shown(row.second, r.owner);
             throw py::key_error(key);
           })
      .def("done",
           [](const Rows& r) {
             py::array_t<bool> out(static_cast<py::ssize_t>(r.status.size()));
             std::transform(r.status.begin(), r.status.end(), out.mutable_data(),
                            [](Status s) { return s == Status::done; });
             return out;
           })
      .def("status",
           [](const Rows& r, std::size_t sample) {
             if (sample >= r.status.size())
               throw py::index_error(fmt::format("{} samples, counted from 0", r.status.size()));
             return to_string(r.status[sample]);
           })
      .def("__len__", [](const Rows& r) { return r.status.size(); });
  py::class_<FourBarSweeps>(module, "FourBarSweep")
      .def(py::init<bool, bool, bool, bool>())
      .def("run", &FourBarSweeps::run);
  module.def("coupler_points", &coupler_points);
  py::class_<LinkageRows, Rows>(module, "LinkageRows").def("point", &LinkageRows::point);
  py::class_<LinkageSweeps>(module, "LinkageSweep")
      .def(py::init<const StudySource&, bool, bool>())
      .def("inputs", &LinkageSweeps::inputs)
      .def("points", &LinkageSweeps::points)
      .def("run", &LinkageSweeps::run);
}

}  // namespace linkwright::python
