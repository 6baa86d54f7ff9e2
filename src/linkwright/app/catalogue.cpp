#include "linkwright/app/catalogue.h"

#include <fmt/format.h>

#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

#include "linkwright/clearance/reproductions.h"
#include "linkwright/clearance/studies.h"
#include "linkwright/flexible/reproductions.h"
#include "linkwright/flexible/studies.h"
#include "linkwright/parallel/reproductions.h"
#include "linkwright/parallel/studies.h"
#include "linkwright/planar/reproductions.h"
#include "linkwright/planar/studies.h"
#include "linkwright/study/renamed.h"
#include "linkwright/study/study.h"
#include "linkwright/suspension/reproductions.h"
#include "linkwright/suspension/studies.h"
#include "linkwright/version.h"

namespace linkwright::app {
namespace {

using Kinds = std::vector<study::Kind>;

Kinds join(std::initializer_list<Kinds> domains) {
  Kinds all;
  for (const Kinds& kinds : domains) all.insert(all.end(), kinds.begin(), kinds.end());
  return all;
}

}  // namespace

std::span<const study::Kind> catalogue() {
  // One line for each domain.
  static const Kinds kinds = join({planar::studies(), suspension::studies(), parallel::studies(),
                                   flexible::studies(), clearance::studies()});
  return kinds;
}

const study::Kind* find_kind(std::string_view name, std::span<const study::Kind> kinds,
                             Diagnostics& diagnostics) {
  const std::string today = study::todays_kind(name);
  std::vector<const study::Kind*> fitting;
  std::vector<std::string> names;
  for (const study::Kind& kind : kinds) {
    names.push_back(name_of(kind));
    if (names.back() == today) return &kind;
    if (names.back().starts_with(today + "/")) fitting.push_back(&kind);
  }
  if (fitting.size() == 1) return fitting.front();
  Diagnostic problem;
  if (fitting.empty()) {
    problem.message = fmt::format("there is no kind of study '{}'", name);
    const std::vector<std::string_view> allowed(names.begin(), names.end());
    problem.hint = did_you_mean(name, allowed, fmt::format("there is: {}", fmt::join(names, ", ")));
  } else {
    std::vector<std::string> several;
    for (const study::Kind* kind : fitting) several.push_back(name_of(*kind));
    problem.message = fmt::format("several kinds of study begin with '{}'", name);
    problem.hint = fmt::format("write one of: {}", fmt::join(several, ", "));
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
