// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/suspension/corner/detail/list_lines.h"
#include "linkwright/suspension/corner/hard_point_list.h"

namespace linkwright::suspension::lists {

/// Collects the points of a list and its problems.
class ListCollector {
 public:
  ListCollector(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void problem(int line, std::string key, std::string message, std::string hint = {});

  /// A line with numbers that is not read. Whether it may be a point is known when all lines are.
  void unread(int line, std::string_view text, const Line& read);

  /// A point (m) and the places of its coordinates in the text.
  void add(int line, std::string_view name, const Vec3& at, const std::array<ListNumber, 3>& places,
           std::string number_in_name = {});

  /// The points; nothing if there is a problem. Those of a text without any are a problem.
  std::optional<std::vector<ListedPoint>> finish();

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
  std::vector<Entry> points_;
  std::vector<Unread> unread_;
  std::size_t problems_ = 0;
};

}  // namespace linkwright::suspension::lists
