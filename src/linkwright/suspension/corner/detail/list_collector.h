// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/corner/detail/list_lines.h"
#include "linkwright/suspension/corner/hard_point_list.h"

namespace linkwright::suspension::lists {

/// A part of a list under a title, the word that the names of its points begin with.
struct ListSection {
  int line = 0;
  std::string title;  ///< Front, Rear
};

/// The sections of a list with the titles Front and Rear, each in a line of its own and without numbers; none
/// where it has not both of them.
std::vector<ListSection> sections_of(std::string_view text);

/// Collects the points of a list and its problems.
class ListCollector {
 public:
  ListCollector(const std::string& file, Diagnostics& diagnostics, std::vector<ListSection> sections = {})
      : file_(file), diagnostics_(diagnostics), sections_(std::move(sections)) {}

  void problem(int line, std::string key, std::string message, std::string hint = {});

  /// A line with numbers that is not read. Whether it may be a point is known when all lines are.
  void unread(int line, std::string_view text, const Line& read);

  /// A point (m) and the places of its coordinates in the text.
  void add(int line, std::string_view name, const Vec3& at, const std::array<ListNumber, 3>& places,
           std::string number_in_name = {});

  /// The points; nothing if there is a problem. Those of a text without any are a problem.
  std::optional<std::vector<ListedPoint>> finish();

  /// A problem that was reported elsewhere.
  void fail() { ++problems_; }

  bool failed() const { return problems_ > 0; }
  bool empty() const { return points_.empty(); }

 private:
  struct Entry {
    ListedPoint listed;
    int line;
    std::string number_in_name;
  };
  struct Unread {
    int line;
    std::string name, message;
    bool may_be_point;
  };

  void add(Diagnostic::Severity severity, int line, std::string key, std::string message, std::string hint);

  const std::string& file_;
  Diagnostics& diagnostics_;
  std::vector<ListSection> sections_;
  std::vector<Entry> points_;
  std::vector<Unread> unread_;
  std::size_t problems_ = 0;
};

}  // namespace linkwright::suspension::lists
