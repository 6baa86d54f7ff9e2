// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "linkwright/suspension/corner/detail/list_lines.h"

namespace linkwright::suspension::lists {
namespace {

/// Words of one meaning in the names of points.
constexpr std::array<std::pair<std::string_view, std::string_view>, 37> meanings{{
    {"front", "front"},   {"for", "front"},     {"fore", "front"},     {"fwd", "front"},
    {"forward", "front"}, {"rear", "rear"},     {"aft", "rear"},       {"rearward", "rear"},
    {"lower", "lower"},   {"low", "lower"},     {"bottom", "lower"},   {"lca", "lower"},
    {"upper", "upper"},   {"upp", "upper"},     {"top", "upper"},      {"uca", "upper"},
    {"ball", "outer"},    {"outer", "outer"},   {"outboard", "outer"}, {"upright", "outer"},
    {"upri", "outer"},    {"inner", "inner"},   {"inboard", "inner"},  {"chassis", "inner"},
    {"chas", "inner"},    {"tie", "tie"},       {"track", "tie"},      {"tierod", "tie"},
    {"tiepnt", "tie"},    {"wheel", "wheel"},   {"spindle", "wheel"},  {"hub", "wheel"},
    {"centre", "centre"}, {"center", "centre"}, {"right", "right"},    {"pushrod", "push"},
    {"push", "push"},
}};

/// The words of a name by their meaning; a capital within a word begins another one.
std::set<std::string> words_of(std::string_view name) {
  std::string apart;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto sign = static_cast<unsigned char>(name[i]);
    if (i > 0 && std::isupper(sign) && std::islower(static_cast<unsigned char>(name[i - 1]))) apart += ' ';
    apart += name[i];
  }
  std::set<std::string> out;
  const std::string plain = plain_name(apart);
  for (std::string_view rest = plain; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find('_'));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    const auto* const found =
        std::find_if(meanings.begin(), meanings.end(), [&](const auto& m) { return m.first == word; });
    out.emplace(found != meanings.end() ? found->second : word);
  }
  return out;
}

/// The point of the list that is most like a name; nullptr if there is none or more than one.
const ListedPoint* most_alike(const std::string& name, std::span<const ListedPoint> listed) {
  const std::set<std::string> wanted = words_of(name);
  const ListedPoint* best = nullptr;
  int most = 0;
  for (const ListedPoint& p : listed) {
    int score = 0;
    for (const std::string& word : words_of(p.label)) score += wanted.contains(word) ? 3 : -1;
    if (score == most) best = nullptr;
    if (score > most) best = &p, most = score;
  }
  return best;
}

}  // namespace

std::optional<PointNames> read_point_names(std::string_view text, const std::string& file,
                                           std::span<const ListedPoint> listed, Diagnostics& diagnostics) {
  PointNames out;
  bool good = true;
  std::vector<std::string_view> known;
  for (const ListedPoint& p : listed) known.push_back(p.point.name);
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view row = take_line(text);
    if (row.empty() || row.front() == '#') continue;
    const auto wrong = [&](std::string message, std::string hint) {
      diagnostics.push_back(
          {Diagnostic::Severity::error, file, {line, 1}, {}, std::move(message), std::move(hint)});
      good = false;
    };
    const std::size_t sign = row.find('=');
    const std::string study = plain_name(row.substr(0, sign)),
                      list = sign == row.npos ? std::string() : plain_name(row.substr(sign + 1));
    if (study.empty() || list.empty())
      wrong(fmt::format("{} has not two names", quoted(row)), "write: name in the study = name in the list");
    else if (std::any_of(out.begin(), out.end(), [&](const auto& one) { return one.first == study; }))
      wrong(fmt::format("'{}' is given twice", without_blanks(row.substr(0, sign))),
            "remove one of the lines");
    else if (std::find(known.begin(), known.end(), list) == known.end())
      wrong(fmt::format("the list has no point '{}'", without_blanks(row.substr(sign + 1))),
            did_you_mean(list, known));
    else
      out.emplace_back(study, list);
  }
  if (!good) return std::nullopt;
  return out;
}

std::string proposed_point_names(std::span<const std::string> wanted, std::span<const ListedPoint> listed,
                                 std::string_view list_file) {
  std::string out = fmt::format(
      "# Points of the study = points of {}. Check each line and complete it, then save this file beside the "
      "study.\n",
      list_file);
  std::set<std::string> used;
  for (const std::string& name : wanted) {
    const ListedPoint* found = nullptr;
    for (const ListedPoint& p : listed)
      if (p.point.name == plain_name(name)) found = &p;
    if (!found) found = most_alike(name, listed);
    out += fmt::format("{} ={}\n", name, found ? " " + found->label : std::string());
    if (found) used.insert(found->point.name);
  }
  std::string rest;
  for (const ListedPoint& p : listed)
    if (!used.contains(p.point.name)) rest += fmt::format("# {}\n", p.label);
  return rest.empty() ? out : out + "# Points of the list that are not used above:\n" + rest;
}

}  // namespace linkwright::suspension::lists
