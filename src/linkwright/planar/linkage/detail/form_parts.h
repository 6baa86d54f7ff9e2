// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <complex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/form.h"

/// Parts of reading a linkage from its form, and of writing it.
namespace linkwright::planar {

/// Resolves the names of a form against the parts of the linkage that exist, and collects what is wrong.
class FormNames {
 public:
  FormNames(const Linkage& linkage, std::vector<FormProblem>& problems) : l_(linkage), problems_(problems) {}

  /// True if there is no problem yet.
  bool clean() const { return problems_.empty(); }
  /// Names the entry that is read next.
  void at(std::string list, std::size_t index) { list_ = std::move(list), index_ = index; }
  /// Index of a body; 0 with a problem if there is none of that name.
  int body(const std::string& key, const std::string& name) {
    const int found = body_index(l_, name);
    if (found < 0) {
      std::vector<std::string_view> known;
      for (const LinkageBody& b : l_.bodies) known.push_back(b.name);
      problem(key, fmt::format("there is no body '{}'", name), nearest(name, known));
    }
    return std::max(found, 0);
  }
  /// The point "body.point".
  BodyPoint point(const std::string& key, const std::string& name) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) {
      problem(key, fmt::format("'{}' is not a point", name), "write body.point, as \"crank.A\"");
      return {};
    }
    const std::size_t before = problems_.size();
    const int b = body(key, name.substr(0, dot));
    if (problems_.size() > before) return {};
    const LinkageBody& body = l_.bodies[static_cast<std::size_t>(b)];
    const int p = point_index(body, name.substr(dot + 1));
    if (p < 0) {
      std::vector<std::string_view> known;
      for (const LinkagePoint& q : body.points) known.push_back(q.name);
      problem(key, fmt::format("body '{}' has no point '{}'", body.name, name.substr(dot + 1)),
              nearest(name.substr(dot + 1), known));
    }
    return {b, std::max(p, 0)};
  }
  /// Index of a joint; -1 with a problem if there is none of that name.
  int joint(const std::string& key, const std::string& name) {
    const int found = joint_index(l_, name);
    if (found < 0) {
      std::vector<std::string_view> known;
      for (const LinkageJoint& j : l_.joints) known.push_back(j.name);
      problem(key, fmt::format("there is no joint '{}'", name), nearest(name, known));
    }
    return found;
  }
  /// The wheel of a gear: a body, or its centre.
  BodyPoint wheel(const std::string& key, const std::string& name) {
    const bool centre = body_index(l_, name) < 0 && name.find('.') != std::string::npos;
    return centre ? point(key, name) : BodyPoint{body(key, name), 0};
  }
  /// Adds a problem at a key of the entry that is read.
  void problem(const std::string& key, std::string message, std::string hint, bool warning = false) {
    problems_.push_back({list_, index_, key, std::move(message), std::move(hint), warning});
  }

 private:
  static std::string nearest(std::string_view name, const std::vector<std::string_view>& known) {
    std::string all;
    for (std::string_view k : known) all += fmt::format("{}{}", all.empty() ? "there are: " : ", ", k);
    return did_you_mean(name, known, all);
  }
  const Linkage& l_;
  std::vector<FormProblem>& problems_;
  std::string list_;
  std::size_t index_ = 0;
};

/// The speed of the second wheel of a gear by that of the first.
double ratio_of(const JointForm& form, FormNames& names);
/// Finds the carrier of a gear where the form does not name it, and the pressure angle at which its teeth
/// work; checks the distance of its centres.
void complete_gear(const Linkage& linkage, const JointForm& form, LinkageJoint& gear, FormNames& names);
/// The radius of a pinion, with the side of the pitch line on which its centre lies; and its angle where it
/// is beside the point of the rack.
void measure_rack(const Linkage& linkage, const JointForm& form, bool drawn, LinkageJoint& rack,
                  FormNames& names);
Belt belt_of(const BeltForm& form, FormNames& names);
/// Finds the body that carries a closed belt, the direction in which it runs, and checks its way.
void complete_belt(const Linkage& linkage, const BeltForm& form, bool drawn, Belt& belt, FormNames& names);

LinkageCam cam_of(const Linkage& linkage, const CamMemberForm& form, FormNames& names);
CamMemberForm form_of(const LinkageCam& cam, const Linkage& linkage);

}  // namespace linkwright::planar
