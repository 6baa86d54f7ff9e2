#include "linkwright/core/csv.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace linkwright {
namespace {

constexpr std::size_t most_columns = 1000, most_problems = 20;

struct Cell {
  std::string text;
  Position position;
};

// Splits text into rows of cells; quotes may hold separators and line ends.
class Scanner {
 public:
  Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }

  bool done() const { return at_ >= text_.size(); }

  /// False when a quote is not closed.
  bool row(std::vector<Cell>& cells) {
    cells.clear();
    bool closed = true;
    while (true) {
      Cell cell{{}, {line_, static_cast<int>(at_ - line_start_) + 1}};
      if (!done() && text_[at_] == '"') {
        closed = quoted(cell.text) && closed;
        while (!done() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
          cell.text += text_[at_++];
      } else {
        while (!done() && text_[at_] != ',' && text_[at_] != '\n' && text_[at_] != '\r')
          cell.text += text_[at_++];
      }
      cells.push_back(std::move(cell));
      if (done() || text_[at_] != ',') break;
      ++at_;
    }
    if (!done() && text_[at_] == '\r') ++at_;
    if (!done() && text_[at_] == '\n') ++at_;
    ++line_;
    line_start_ = at_;
    return closed;
  }

 private:
  bool quoted(std::string& out) {
    for (++at_; !done(); ++at_) {
      if (text_[at_] == '\n') ++line_, line_start_ = at_ + 1;
      if (text_[at_] != '"') {
        out += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        out += text_[++at_];
      } else {
        ++at_;
        return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

std::string shown(std::string_view text) { return std::string(text.substr(0, 40)); }

}  // namespace

std::optional<Table> read_csv(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const auto problem = [&](Position position, std::string key, std::string message, std::string hint = {}) {
    if (diagnostics.size() - before < most_problems)
      diagnostics.push_back(
          {Diagnostic::Severity::error, file, position, std::move(key), std::move(message), std::move(hint)});
  };
  Scanner scanner(text);
  std::vector<Cell> cells;
  if (scanner.done()) {
    problem({1, 1}, {}, "the file is empty", "give a header line with the column keys, for example x_m,y_m");
    return std::nullopt;
  }
  if (!scanner.row(cells)) problem(cells.back().position, {}, "a quote is not closed");
  if (cells.size() > most_columns) {
    problem({1, 1}, {}, fmt::format("{} columns, at most {} are allowed", cells.size(), most_columns));
    return std::nullopt;
  }
  Table table;
  const bool has_status = trimmed(cells.back().text) == "status";
  const std::size_t first = trimmed(cells[0].text) == "name" ? 1 : 0;
  for (std::size_t c = first; c + (has_status ? 1 : 0) < cells.size(); ++c) {
    const std::string key(trimmed(cells[c].text));
    double number;
    if (key.empty() ||
        std::from_chars(key.data(), key.data() + key.size(), number).ptr == key.data() + key.size())
      problem(cells[c].position, {},
              fmt::format("the header has '{}' where a column key is expected", shown(key)),
              "the first line names the columns, for example x_m,y_m");
    if (table.find(key)) problem(cells[c].position, key, "this column stands twice");
    table.add(key, key);
  }
  while (!scanner.done()) {
    const bool closed = scanner.row(cells);
    if (!closed) problem(cells.back().position, {}, "a quote is not closed");
    if (cells.size() == 1 && trimmed(cells[0].text).empty()) continue;
    const std::size_t expected = first + table.columns.size() + (has_status ? 1 : 0);
    if (cells.size() != expected) {
      problem(cells[0].position, {},
              fmt::format("{} values, the header has {} columns", cells.size(), expected));
      continue;
    }
    if (first == 1) table.names.emplace_back(trimmed(cells[0].text));
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::string_view cell = trimmed(cells[first + c].text);
      double value = std::numeric_limits<double>::quiet_NaN();
      const std::string_view digits = cell.starts_with('+') ? cell.substr(1) : cell;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      if (!cell.empty() && (error != std::errc() || end != digits.data() + digits.size()))
        problem(cells[first + c].position, table.columns[c].key,
                fmt::format("'{}' is not a number", shown(cell)),
                "write numbers like 0.25 or 1e-3, columns separated by commas");
      else if (!cell.empty() && !std::isfinite(value))
        problem(cells[first + c].position, table.columns[c].key,
                fmt::format("'{}' is not finite", shown(cell)));
      table.columns[c].values.push_back(value);
    }
    if (has_status) table.status.push_back(cells.back().text);
  }
  if (diagnostics.size() > before) return std::nullopt;
  return table;
}

}  // namespace linkwright
