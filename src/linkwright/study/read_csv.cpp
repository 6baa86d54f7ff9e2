#include "linkwright/study/read_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "linkwright/core/units.h"
#include "linkwright/study/read.h"

namespace linkwright::study {
namespace {

constexpr std::size_t most_problems = 50;

struct Cell {
  std::string text;
  Position position;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file, Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics), first_(diagnostics.size()) {}

  std::optional<Table> run() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    Table table;
    std::vector<std::string> keys;
    while (!text_.empty() && count() < most_problems) {
      const std::vector<Cell> cells = line();
      if (cells.empty()) continue;
      if (keys.empty())
        header(cells, keys, table);
      else
        row(cells, keys, table);
    }
    if (keys.empty())
      problem({}, "the file is empty, expected a line of column keys");
    else if (table.rows() == 0 && count() == 0)
      problem({}, "has no rows below its column keys");
    return count() == 0 ? std::optional(std::move(table)) : std::nullopt;
  }

 private:
  std::size_t count() const { return diagnostics_.size() - first_; }
  void problem(Position position, std::string message, std::string hint = {}) {
    diagnostics_.push_back(
        {Diagnostic::Severity::error, file_, position, {}, std::move(message), std::move(hint)});
  }

  /// The cells of the next line, none when it is empty or a comment.
  std::vector<Cell> line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view rest = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_;
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    std::vector<Cell> cells;
    if (trimmed(rest).empty() || trimmed(rest).front() == '#') return cells;
    int column = 1;
    while (true) {
      std::size_t size = std::min(rest.find(','), rest.size());
      Cell cell{{}, {line_, column}};
      if (trimmed(rest).starts_with('"')) {
        std::size_t at = rest.find('"') + 1;
        while (at < rest.size()) {
          if (rest[at] == '"' && !rest.substr(at).starts_with("\"\"")) break;
          if (rest[at] == '"') ++at;  // two quotes stand for one
          cell.text += rest[at++];
        }
        size = std::min(rest.find(',', std::min(at + 1, rest.size())), rest.size());
        if (at >= rest.size() || !trimmed(rest.substr(at + 1, size - at - 1)).empty())
          problem(cell.position, "a cell in quotes must end in a quote on its line");
      } else {
        cell.text = trimmed(rest.substr(0, size));
      }
      cells.push_back(std::move(cell));
      if (size == rest.size()) return cells;
      rest.remove_prefix(size + 1);
      column += static_cast<int>(size) + 1;
    }
  }

  void header(const std::vector<Cell>& cells, std::vector<std::string>& keys, Table& table) {
    for (const Cell& cell : cells) {
      if (cell.text.empty()) problem(cell.position, "this column has no key");
      if (std::find(keys.begin(), keys.end(), cell.text) != keys.end())
        problem(cell.position, fmt::format("the column '{}' is given twice", cell.text));
      keys.push_back(cell.text);
      if (cell.text != "status") table.add(cell.text, cell.text);
    }
  }

  void row(const std::vector<Cell>& cells, const std::vector<std::string>& keys, Table& table) {
    if (cells.size() != keys.size()) {
      problem(cells.front().position, fmt::format("has {} cells, must have {}", cells.size(), keys.size()));
      return;
    }
    auto column = table.columns.begin();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string& text = cells[i].text;
      if (keys[i] == "status") {
        table.status.push_back(text);
        continue;
      }
      double value = std::numeric_limits<double>::quiet_NaN();
      const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
      const char* end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(begin, end, value);
      if (!text.empty() && (error != std::errc() || stop != end || !std::isfinite(value)))
        problem(cells[i].position,
                fmt::format("'{}' in the column '{}' is not a finite number", text.substr(0, 40), keys[i]),
                text.find(';') != std::string::npos ? "cells are separated by commas" : "");
      (column++)->values.push_back(value);
    }
  }

  std::string_view text_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  std::size_t first_;
  int line_ = 0;
};

}  // namespace

std::optional<Table> read_csv_text(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  return CsvReader(text, file, diagnostics).run();
}

std::optional<Table> read_csv(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const std::string text = load_file(file, diagnostics);
  if (diagnostics.size() != before) return std::nullopt;
  std::optional<Table> table = read_csv_text(text, file.string(), diagnostics);
  if (table) table->name = file.stem().string();
  return table;
}

std::optional<std::vector<double>> si_column(const Table& table, std::string_view base, Dimension dimension,
                                             const std::string& file, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message) {
    diagnostics.push_back({Diagnostic::Severity::error, file, {}, {}, std::move(message), {}});
    return std::nullopt;
  };
  std::string allowed = dimension == Dimension::none ? std::string(base) : std::string();
  const Column* found = dimension == Dimension::none ? table.find(base) : nullptr;
  const Unit* found_unit = nullptr;
  for (const Unit& unit : units(dimension)) {
    const std::string key = fmt::format("{}_{}", base, unit.suffix);
    allowed += (allowed.empty() ? "" : ", ") + key;
    if (const Column* column = table.find(key)) {
      if (found) return refuse(fmt::format("has the columns {} and {}; keep one of them", found->key, key));
      found = column;
      found_unit = &unit;
    }
  }
  if (!found) return refuse(fmt::format("has no column for '{}', expected one of: {}", base, allowed));
  std::vector<double> values = found->values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]))
      return refuse(fmt::format("has no value in row {} of the column '{}'", i + 1, found->key));
    if (found_unit) values[i] = found_unit->to_si(values[i]);
  }
  return values;
}

}  // namespace linkwright::study
