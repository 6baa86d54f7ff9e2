// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_collector.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace linkwright::suspension::lists {
namespace {

constexpr std::size_t max_points = 1000, max_problems = 20;
constexpr double farthest_point = 1e3;  ///< m: no vehicle reaches further; a slip of the unit does

}  // namespace

std::vector<ListSection> sections_of(std::string_view text) {
  std::vector<ListSection> out;
  bool front = false, rear = false;
  for (int line = 1; !text.empty(); ++line) {
    const std::string plain = plain_name(take_line(text));
    for (const char* title : {"Front", "Rear"}) {
      const std::string word = plain_name(title);
      if (plain != word && plain != word + "_suspension" && plain != word + "_axle") continue;
      out.push_back({line, title});
      (*title == 'F' ? front : rear) = true;
    }
  }
  if (!front || !rear) out.clear();
  return out;
}

void ListCollector::problem(int line, std::string key, std::string message, std::string hint) {
  if (++problems_ <= max_problems)
    add(Diagnostic::Severity::error, line, std::move(key), std::move(message), std::move(hint));
}

void ListCollector::unread(int line, std::string_view text, const Line& read) {
  unread_.push_back({line, read.name, fmt::format("{} is not read: {}", quoted(text), read.problem),
                     read.numbers > 2 || (read.numbers > 1 && !points_.empty())});
}

void ListCollector::add(int line, std::string_view name, const Vec3& at,
                        const std::array<ListNumber, 3>& places, std::string number_in_name) {
  std::string label(without_blanks(name));
  for (const ListSection& section : sections_)
    if (section.line < line && !plain_name(name).empty())
      label = section.title + " " + std::string(without_blanks(name));
  const std::string plain = plain_name(label);
  if (plain.empty())
    return problem(line, {}, "a point has no name", "write a name before x, y and z, or behind them");
  if (!(std::abs(at.x) <= farthest_point && std::abs(at.y) <= farthest_point &&
        std::abs(at.z) <= farthest_point))
    return problem(line, plain, fmt::format("lies at ({:.6g}, {:.6g}, {:.6g}) m", at.x, at.y, at.z),
                   "is the unit of the list right?");
  const auto same = std::find_if(points_.begin(), points_.end(),
                                 [&](const Entry& p) { return p.listed.point.name == plain; });
  if (same != points_.end()) {
    const Vec3& first = same->listed.point.at;
    if (!(first == at))
      problem(line, plain,
              fmt::format("is given twice, at different positions: ({:.6g}, {:.6g}, {:.6g}) m in line {} and "
                          "({:.6g}, {:.6g}, {:.6g}) m here; neither is taken",
                          first.x, first.y, first.z, same->line, at.x, at.y, at.z),
              "remove the line that no longer holds, or give every point a name of its own");
    else
      same->listed.places.push_back(places);
    return;
  }
  if (points_.size() == max_points) return problem(line, {}, fmt::format("more than {} points", max_points));
  points_.push_back({{{plain, at}, std::move(label), {places}}, line, std::move(number_in_name)});
}

std::optional<std::vector<ListedPoint>> ListCollector::finish() {
  const auto known = [&](std::string_view name) {
    return std::any_of(points_.begin(), points_.end(),
                       [&](const Entry& p) { return p.listed.point.name == name; });
  };
  for (Unread& u : unread_) {
    if (u.may_be_point || known(u.name))
      problem(u.line, u.name, u.message,
              "write a point as: name x y z; put remarks behind #, and # before a line that is not meant");
    else
      add(Diagnostic::Severity::warning, u.line, u.name, u.message, "put # before a line that is not meant");
  }
  // "lower ball joint 1 10 20 30" is the name of a point, "lower ball joint 10 20 30 40" a slip.
  for (const Entry& p : points_)
    if (const std::string number = plain_name(p.number_in_name);
        !number.empty() && p.listed.point.name.ends_with("_" + number))
      if (const auto base = p.listed.point.name.substr(0, p.listed.point.name.size() - number.size() - 1);
          known(base))
        problem(p.line, base,
                fmt::format("has four numbers here, and is also a point without the {}", p.number_in_name),
                "give three coordinates, or write the name with its number in quotes");
  if (problems_ > 0) return std::nullopt;
  std::vector<ListedPoint> out;
  for (Entry& p : points_) out.push_back(std::move(p.listed));
  if (!out.empty()) return out;
  problem(0, {}, "holds no point",
          "one point a line: name x y z; or CSV with the columns name,x_mm,y_mm,z_mm");
  return std::nullopt;
}

void ListCollector::add(Diagnostic::Severity severity, int line, std::string key, std::string message,
                        std::string hint) {
  diagnostics_.push_back(
      {severity, file_, {line, line > 0 ? 1 : 0}, std::move(key), std::move(message), std::move(hint)});
}

}  // namespace linkwright::suspension::lists
