// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <utility>

#include "linkwright/clearance/reproductions.h"
#include "linkwright/clearance/studies.h"
#include "linkwright/flexible/reproductions.h"
#include "linkwright/flexible/studies.h"
#include "linkwright/parallel/reproductions.h"
#include "linkwright/parallel/studies.h"
#include "linkwright/parameter_study/studies.h"
#include "linkwright/planar/reproductions.h"
#include "linkwright/planar/studies.h"
#include "linkwright/study/renamed.h"
#include "linkwright/study/reproduction.h"
#include "linkwright/study/study.h"
#include "linkwright/suspension/reproductions.h"
#include "linkwright/suspension/studies.h"
#include "linkwright/version.h"

namespace linkwright::app {
namespace {

using Kinds = std::vector<study::Kind>;

// The tasks of users, in the order of lists.
constexpr std::string_view find_motion = "Find motion and forces", follow_path = "Follow a path",
                           guide_body = "Guide a body", generate_function = "Generate a function",
                           find_structure = "Choose a structure", balance = "Balance a machine",
                           suspensions = "Wheel suspensions", robots = "Robots and Pi-joints",
                           real_joints = "Real joints: clearance and tolerances",
                           flexible_links = "Flexible links", parameter_studies = "Parameter studies",
                           no_group = "Other studies";
constexpr std::array titles{well_known,     find_motion,       follow_path, guide_body, generate_function,
                            find_structure, balance,           suspensions, robots,     real_joints,
                            flexible_links, parameter_studies, no_group};

/// The group of a study; the first that fits counts.
struct Group {
  std::string_view kind;       ///< empty = any
  std::string_view mechanism;  ///< its beginning
  std::string_view target;     ///< empty = any
  std::string_view title;
};
constexpr Group groups[] = {
    {"synthesis", "planar.", "path_points", follow_path},
    {"synthesis", "planar.", "poses", guide_body},
    {"synthesis", "planar.", "", generate_function},
    {"enumeration", "planar.", "", find_structure},
    {"balancing", "planar.", "", balance},
    {"analysis", "planar.serial_arm", "", robots},
    {"", "planar.", "", find_motion},
    {"", "suspension.", "", suspensions},
    {"", "parallel.", "", robots},
    {"", "clearance.", "", real_joints},
    {"", "flexible.", "", flexible_links},
    {"sweep", "", "", parameter_studies},
};

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

Kinds join(std::initializer_list<Kinds> domains) {
  Kinds all;
  for (const Kinds& kinds : domains) all.insert(all.end(), kinds.begin(), kinds.end());
  return all;
}

}  // namespace

std::span<const study::Kind> catalogue() {
  // One line for each domain.
  static const Kinds domains = join({planar::studies(), suspension::studies(), parallel::studies(),
                                     flexible::studies(), clearance::studies()});
  static const Kinds kinds = join({domains, parameter_study::studies(domains)});
  return kinds;
}

std::string_view group_of(std::string_view kind, std::string_view mechanism, std::string_view target) {
  for (const Group& group : groups)
    if ((group.kind.empty() || group.kind == kind) && mechanism.starts_with(group.mechanism) &&
        (group.target.empty() || group.target == target))
      return group.title;
  return no_group;
}

std::size_t place_of_group(std::string_view title) {
  return static_cast<std::size_t>(std::find(titles.begin(), titles.end(), title) - titles.begin());
}

bool holds_words(std::span<const std::string> words, std::initializer_list<std::string_view> texts) {
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::any_of(texts.begin(), texts.end(), [&](std::string_view text) {
      return lower_case(text).find(lower_case(word)) != std::string::npos;
    });
  });
}

const study::Kind* find_kind(std::string_view name, std::span<const study::Kind> kinds,
                             Diagnostics& diagnostics) {
  const std::string today = study::todays_kind(name);
  std::vector<const study::Kind*> fitting, with_part;
  std::vector<std::string> names;
  for (const study::Kind& kind : kinds) {
    names.push_back(name_of(kind));
    if (names.back() == today) return &kind;
    if (names.back().starts_with(today + "/")) fitting.push_back(&kind);
    if (names.back().find(today) != std::string::npos) with_part.push_back(&kind);
  }
  if (fitting.empty()) fitting = with_part;
  if (fitting.size() == 1) return fitting.front();
  Diagnostic problem;
  if (fitting.empty() || today.empty()) {
    problem.message = fmt::format("there is no kind of study '{}'", name);
    const std::vector<std::string_view> allowed(names.begin(), names.end());
    problem.hint = did_you_mean(name, allowed, "`linkwright catalogue` lists them");
  } else {
    problem.message = fmt::format("several kinds of study fit '{}'", name);
    problem.hint = "write one of:";
    for (const study::Kind* kind : fitting)
      problem.hint += fmt::format("\n  {}\n      {}", name_of(*kind), kind->summary);
  }
  diagnostics.push_back(std::move(problem));
  return nullptr;
}

std::span<const study::Reproduction> reproductions() {
  static const auto all = [] {
    std::vector<study::Reproduction> joined = planar::reproductions();
    for (study::Reproduction& r : suspension::reproductions()) joined.push_back(std::move(r));
    for (study::Reproduction& r : parallel::reproductions()) joined.push_back(std::move(r));
    for (study::Reproduction& r : flexible::reproductions()) joined.push_back(std::move(r));
    for (study::Reproduction& r : clearance::reproductions()) joined.push_back(std::move(r));
    return joined;
  }();
  return all;
}

std::vector<const study::Reproduction*> find_reproductions(std::string_view id,
                                                           std::span<const study::Reproduction> all,
                                                           Diagnostics& diagnostics) {
  std::vector<const study::Reproduction*> found;
  std::vector<std::string_view> ids;
  for (const study::Reproduction& r : all) {
    ids.push_back(r.id);
    if (r.id == id) return {&r};
    if (id == "all" || r.id.starts_with(id)) found.push_back(&r);
  }
  if (found.empty()) {
    diagnostics.push_back({Diagnostic::Severity::error,
                           {},
                           {},
                           {},
                           fmt::format("there is no published table '{}'", id),
                           did_you_mean(id, ids, fmt::format("there is: {}, or all", fmt::join(ids, ", ")))});
  }
  return found;
}

std::string_view version() { return LINKWRIGHT_VERSION; }

}  // namespace linkwright::app
