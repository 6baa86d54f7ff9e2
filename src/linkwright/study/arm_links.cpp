// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/arm_links.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace linkwright::study {
namespace {

// More is no arm, and its tables would fill the memory.
constexpr std::size_t max_links = 20;

bool begins_columns(std::string_view name) {
  return std::isalpha(static_cast<unsigned char>(name.front())) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); });
}

}  // namespace

void complete_arm_links(ObjectReader& mechanism, std::span<std::string* const> names) {
  std::vector<ObjectReader> tables = mechanism.tables("link");
  if (mechanism.has("link") && names.empty() && tables.empty())
    mechanism.error("link", "an arm has at least one link", "add [[mechanism.link]]");
  if (names.size() > max_links)
    mechanism.error("link", fmt::format("has {} links, at most {} are allowed", names.size(), max_links));
  for (std::size_t k = 0; k < std::min(names.size(), tables.size()); ++k) {
    std::string& name = *names[k];
    if (name.empty()) {
      if (tables[k].has("name")) tables[k].error("name", "is empty", "leave it out, or give one");
      name = fmt::format("link{}", k + 1);
    } else if (!begins_columns(name)) {
      tables[k].error(
          "name",
          fmt::format("is '{}', must begin with a letter and contain letters, digits and _ only", name),
          "it becomes the beginning of column names");
    }
    const auto before = names.first(k);
    if (std::any_of(before.begin(), before.end(), [&](const std::string* other) { return *other == name; }))
      tables[k].error("name", fmt::format("'{}' is also the name of another link", name));
  }
}

std::optional<std::size_t> driven_link(ObjectReader& drive, std::string_view link,
                                       std::span<const std::string_view> links) {
  const auto at = std::find(links.begin(), links.end(), link);
  if (at != links.end()) return static_cast<std::size_t>(at - links.begin());
  if (drive.has("link")) drive.no_such("link", "link", link, {links.begin(), links.end()});
  return std::nullopt;  // a missing key is reported as such
}

}  // namespace linkwright::study
