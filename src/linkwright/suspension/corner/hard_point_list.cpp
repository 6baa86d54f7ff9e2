// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/hard_point_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>

#include "linkwright/core/csv.h"
#include "linkwright/core/units.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_points = 1000, max_problems = 20;
constexpr double farthest_point = 1e3;  ///< m: no vehicle reaches further; a slip of the unit does
constexpr std::string_view blanks = " \t\r";

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The line with signs of ASCII: typographic minus signs and spaces that do not break come from documents.
std::string plain_signs(std::string_view line) {
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line.substr(i).starts_with("\xE2\x88\x92"))
      out += '-', i += 2;
    else if (line.substr(i).starts_with("\xC2\xA0"))
      out += ' ', i += 1;
    else
      out += line[i];
  return out;
}

/// A line as messages quote it.
std::string quoted(std::string_view line) {
  constexpr std::size_t longest = 60;
  line = without_blanks(line);
  return line.size() <= longest ? fmt::format("'{}'", line) : fmt::format("'{}...'", line.substr(0, longest));
}

const Unit* unit_of(std::string_view word) {
  return find_unit(Dimension::length, word == "inch" || word == "inches" ? "in" : word);
}

/// True if a comment begins here.
bool begins_comment(std::string_view rest) {
  return !rest.empty() &&
         (std::string_view("#$!%").find(rest[0]) != std::string_view::npos || rest.starts_with("//"));
}

struct Word {
  std::string text;
  std::optional<double> number;
  const Unit* unit = nullptr;  ///< unit of the number, where the list gives one
  bool quoted = false;

  /// It begins as a number does.
  bool numeric() const {
    if (number) return true;
    if (quoted || text.empty()) return false;
    const std::size_t first = text.find_first_not_of("+-.");
    return first < 3 && first < text.size() && is_digit(text[first]);
  }
};

/// A number that fills the whole word but for a unit; a comma may be its decimal point, and the exponent of
/// Fortran its exponent.
Word word_of(std::string text, bool comma_is_point) {
  std::string plain = text;
  if (comma_is_point) std::replace(plain.begin(), plain.end(), ',', '.');
  for (std::size_t i = 1; i + 1 < plain.size(); ++i)
    if ((plain[i] == 'D' || plain[i] == 'd') && (is_digit(plain[i - 1]) || plain[i - 1] == '.') &&
        (is_digit(plain[i + 1]) || plain[i + 1] == '-' || plain[i + 1] == '+'))
      plain[i] = 'e';
  Word out{.text = std::move(text), .number = {}};
  const char* begin = plain.data() + (plain.starts_with('+') ? 1 : 0);
  const char* end = plain.data() + plain.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || begin == end) return out;
  if (stop != end && !(out.unit = unit_of({stop, static_cast<std::size_t>(end - stop)}))) return out;
  out.number = value;
  return out;
}

struct Words {
  std::vector<Word> all;
  std::string comment;  ///< behind three numbers
};

/// Splits a line at blanks, semicolons, brackets, = and :, and at commas if they are no decimal points;
/// quoted words stay whole, and so do times (12:30).
Words split(std::string_view line, bool comma_separates) {
  Words out;
  std::string word;
  const auto close = [&] {
    if (!word.empty()) out.all.push_back(word_of(word, !comma_separates));
    word.clear();
  };
  const auto numbers = [&] {
    return std::count_if(out.all.begin(), out.all.end(), [](const Word& w) { return w.number.has_value(); });
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (begins_comment(line.substr(i)) && (word.empty() || word_of(word, !comma_separates).number)) {
      close();
      if (numbers() >= 3) {
        out.comment = without_blanks(line.substr(line.find_first_not_of("#$!%/", i) < line.size()
                                                     ? line.find_first_not_of("#$!%/", i)
                                                     : line.size()));
        return out;
      }
    }
    if (word.empty() && (c == '"' || c == '\'')) {
      if (const std::size_t end = line.find(c, i + 1); end != std::string_view::npos) {
        out.all.push_back(
            {.text = std::string(line.substr(i + 1, end - i - 1)), .number = {}, .quoted = true});
        i = end;
        continue;
      }
    }
    const bool time =
        c == ':' && i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
    if (std::string_view(" \t\r;()[]{}<>=").find(c) != std::string_view::npos || (c == ':' && !time) ||
        (c == ',' && comma_separates))
      close();
    else
      word += c;
  }
  close();
  return out;
}

/// A line of a list: a point, or the reason why it is none.
struct Line {
  bool point = false;
  std::string name, number_in_name;
  std::array<Word, 3> at{};
  std::vector<Word> words;
  std::size_t numbers = 0;  ///< words that are numbers or begin like one
  std::string problem;      ///< says why a line with numbers is no point
};

std::string joined(std::span<const Word> words) {
  std::string out;
  for (const Word& w : words) out += (out.empty() ? "" : " ") + w.text;
  return out;
}

/// Units behind numbers go to the numbers; x, y and z before the coordinates go.
std::vector<Word> with_units(std::vector<Word> words) {
  std::vector<Word> out;
  for (Word& word : words) {
    const Unit* unit = word.quoted || word.number ? nullptr : unit_of(word.text);
    if (unit && !out.empty() && out.back().number) {
      for (auto w = out.rbegin(); w != out.rend() && w->number && !w->unit; ++w) w->unit = unit;
    } else {
      out.push_back(std::move(word));
    }
  }
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i + 5 < out.size(); ++i) {
    bool labelled = true;
    for (std::size_t k = 0; k < 3; ++k)
      labelled = labelled && plain_name(out[i + 2 * k].text) == axes[k] && out[i + 2 * k + 1].number;
    if (!labelled) continue;
    for (std::size_t k = 3; k-- > 0;) out.erase(out.begin() + static_cast<std::ptrdiff_t>(i + 2 * k));
    break;
  }
  return out;
}

Line read_words(Words split) {
  Line out;
  out.words = with_units(std::move(split.all));
  const std::span<const Word> all(out.words);
  // The first run of three or more numbers holds the coordinates.
  std::size_t begin = 0, end = 0, runs = 0, garbage = all.size();
  for (std::size_t i = 0; i < all.size();) {
    if (all[i].numeric()) ++out.numbers;
    if (!all[i].number) {
      if (all[i].numeric()) garbage = i;
      ++i;
      continue;
    }
    std::size_t stop = i + 1;
    for (; stop < all.size() && all[stop].number; ++stop) ++out.numbers;
    if (stop - i >= 3 && ++runs == 1) begin = i, end = stop;
    i = stop;
  }
  if (out.numbers == 0) return out;
  if (runs != 1 || (garbage < all.size() && garbage >= end && garbage > begin)) {
    const std::size_t first = static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [](const Word& w) { return w.numeric(); }) - all.begin());
    out.name = plain_name(joined(all.first(first)));
    out.problem = garbage < all.size() ? fmt::format("'{}' is not a number", all[garbage].text)
                  : runs > 1           ? "it holds the coordinates of two points"
                                       : fmt::format("it has {} number{}, a point has three", out.numbers,
                                           out.numbers == 1 ? "" : "s");
    return out;
  }
  const std::size_t extra = end - begin - 3;
  const bool whole = extra == 0 || all[begin].text.find_first_not_of("0123456789.") == std::string::npos;
  std::span<const Word> before = all.first(begin + extra), after = all.subspan(end);
  if (before.size() > 1 && before[0].number && !before[0].quoted && whole && !before[1].number)
    before = before.subspan(1);
  const bool named_before =
      std::any_of(before.begin(), before.end(), [](const Word& w) { return !w.number; });
  if (named_before)
    out.name = joined(before);
  else
    out.name = !after.empty() ? joined(after) : split.comment;
  if (extra > 1 || !whole) {
    out.name = plain_name(named_before ? joined(all.first(begin)) : out.name);
    out.problem = fmt::format("it has {} numbers in a row, a point has three", end - begin);
    return out;
  }
  if (named_before && extra == 1) out.number_in_name = all[begin].text;
  for (std::size_t i = 0; i < 3; ++i) out.at[i] = all[end - 3 + i];
  out.point = true;
  return out;
}

/// A line with commas has two readings: they separate, or they are decimal points.
Line read_line(std::string_view line) {
  bool separates = false;
  const bool other = line.find_first_of(" \t;([{=") != std::string_view::npos;
  bool thousands = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != ',') continue;
    const bool between = i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
    if (!between || !other) separates = true;
    if (between && i + 4 < line.size() && is_digit(line[i + 2]) && is_digit(line[i + 3]) &&
        line[i + 4] == '.')
      thousands = true;
  }
  if (line.find(',') == std::string_view::npos) return read_words(split(line, true));
  if (!separates)
    if (Line decimal = read_words(split(line, false)); decimal.point) return decimal;
  Line out = read_words(split(line, true));
  if (thousands && ((!separates && out.point) || !out.number_in_name.empty() || !out.problem.empty())) {
    out.point = false;
    out.problem = "write thousands without a separator, like 1000.5";
  }
  return out;
}

class ListCollector {
 public:
  ListCollector(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void problem(int line, std::string key, std::string message, std::string hint = {}) {
    if (++problems_ <= max_problems)
      add(Diagnostic::Severity::error, line, std::move(key), std::move(message), std::move(hint));
  }

  /// A line with numbers that is not read. Whether it may be a point is known when all lines are.
  void unread(int line, std::string_view text, const Line& read) {
    unread_.push_back({line, read.name, fmt::format("{} is not read: {}", quoted(text), read.problem),
                       read.numbers > 2 || (read.numbers > 1 && !points_.empty())});
  }

  void add(int line, std::string_view name, const Vec3& at, std::string number_in_name = {}) {
    const std::string plain = plain_name(name);
    if (plain.empty())
      return problem(line, {}, "a point has no name", "write a name before x, y and z, or behind them");
    if (!(std::abs(at.x) <= farthest_point && std::abs(at.y) <= farthest_point &&
          std::abs(at.z) <= farthest_point))
      return problem(line, plain, fmt::format("lies at ({:.6g}, {:.6g}, {:.6g}) m", at.x, at.y, at.z),
                     "is the unit of the list right?");
    const auto same =
        std::find_if(points_.begin(), points_.end(), [&](const Entry& p) { return p.point.name == plain; });
    if (same != points_.end()) {
      const Vec3& first = same->point.at;
      if (!(first == at))
        problem(
            line, plain,
            fmt::format("is given twice, at different positions: ({:.6g}, {:.6g}, {:.6g}) m in line {} and "
                        "({:.6g}, {:.6g}, {:.6g}) m here; neither is taken",
                        first.x, first.y, first.z, same->line, at.x, at.y, at.z),
            "remove the line that no longer holds, or give every point a name of its own");
      return;
    }
    if (points_.size() == max_points)
      return problem(line, {}, fmt::format("more than {} points", max_points));
    points_.push_back({{plain, at}, line, std::move(number_in_name)});
  }

  std::optional<std::vector<HardPoint>> finish() {
    const auto known = [&](std::string_view name) {
      return std::any_of(points_.begin(), points_.end(),
                         [&](const Entry& p) { return p.point.name == name; });
    };
    for (Unread& u : unread_) {
      if (u.may_be_point || known(u.name))
        problem(u.line, u.name, u.message,
                "write a point as: name x y z; put remarks behind #, and # before a line that is not meant");
      else
        add(Diagnostic::Severity::warning, u.line, u.name, u.message,
            "put # before a line that is not meant");
    }
    // "lower ball joint 1 10 20 30" is the name of a point, "lower ball joint 10 20 30 40" a slip.
    for (const Entry& p : points_)
      if (const std::string number = plain_name(p.number_in_name);
          !number.empty() && p.point.name.ends_with("_" + number))
        if (const auto base = p.point.name.substr(0, p.point.name.size() - number.size() - 1); known(base))
          problem(p.line, base,
                  fmt::format("has four numbers here, and is also a point without the {}", p.number_in_name),
                  "give three coordinates, or write the name with its number in quotes");
    if (problems_ > 0) return std::nullopt;
    std::vector<HardPoint> out;
    for (Entry& p : points_) out.push_back(std::move(p.point));
    if (!out.empty()) return out;
    problem(0, {}, "holds no point",
            "one point a line: name x y z; or CSV with the columns name,x_mm,y_mm,z_mm");
    return std::nullopt;
  }

  bool failed() const { return problems_ > 0; }

 private:
  struct Entry {
    HardPoint point;
    int line;
    std::string number_in_name;
  };
  struct Unread {
    int line;
    std::string name, message;
    bool may_be_point;
  };

  void add(Diagnostic::Severity severity, int line, std::string key, std::string message, std::string hint) {
    diagnostics_.push_back(
        {severity, file_, {line, line > 0 ? 1 : 0}, std::move(key), std::move(message), std::move(hint)});
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
  std::vector<Entry> points_;
  std::vector<Unread> unread_;
  std::size_t problems_ = 0;
};

struct Axis {
  int axis = -1;  ///< 0 x, 1 y, 2 z
  const Unit* unit = nullptr;
};

/// A heading such as x, x_mm or "X [mm]".
Axis axis_of(std::string_view heading) {
  const std::string plain = plain_name(heading);
  const Unit* unit = nullptr;
  std::string base = plain;
  if (plain.size() > 2 && plain[1] == '_') unit = unit_of(plain.substr(2));
  if (unit) base = plain.substr(0, 1);
  const auto at = std::string_view("xyz").find(base);
  return base.size() == 1 && at != std::string_view::npos ? Axis{static_cast<int>(at), unit} : Axis{};
}

/// The cells of a line as they are written, with their quotes.
std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> out;
  bool open = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') open = !open;
    if (i < line.size() && (open || line[i] != separator)) continue;
    out.push_back(without_blanks(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return out;
}

/// The line without a comment behind its last number.
std::string_view without_comment(std::string_view line, char separator) {
  std::size_t cell = 0;
  bool open = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') open = !open;
    if (open) continue;
    if (line[i] == separator) cell = i + 1;
    if (begins_comment(line.substr(i)) &&
        word_of(std::string(without_blanks(line.substr(cell, i - cell))), separator != ',').number)
      return line.substr(0, i);
  }
  return line;
}

struct Header {
  char separator = 0;
  std::size_t columns = 0;
  std::optional<std::size_t> name;
  std::array<std::optional<std::size_t>, 3> at;
  std::array<const Unit*, 3> units{};
};

/// The header of a list in columns; nothing for plain text.
std::optional<Header> header_of(std::string_view line, char separator) {
  if (separator == 0) {
    for (const char c : {';', '\t', ','})
      if (separator == 0 && line.find(c) != std::string_view::npos) separator = c;
    if (separator == 0) return std::nullopt;
  }
  Header out{.separator = separator, .name = {}, .at = {}};
  std::vector<std::string_view> cells = cells_of(line, separator);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  out.columns = cells.size();
  std::optional<std::size_t> text;
  int axes = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Axis axis = axis_of(cells[i]);
    const std::string plain = plain_name(cells[i]);
    if (axis.axis >= 0) {
      const auto k = static_cast<std::size_t>(axis.axis);
      if (out.at[k]) return std::nullopt;
      out.at[k] = i;
      out.units[k] = axis.unit;
      ++axes;
    } else if (!out.name && (plain == "name" || plain == "point" || plain == "hard_point" ||
                             plain == "hardpoint" || plain == "label" || plain == "joint")) {
      out.name = i;
    } else if (!text) {
      text = i;
    }
  }
  if (axes == 0 || (axes < 3 && !out.name)) return std::nullopt;
  if (!out.name) out.name = text;
  return out;
}

/// A list in columns, brought into the order name, x, y, z line by line and read as CSV.
std::optional<std::vector<HardPoint>> read_columns(std::string_view text, int header_line, Header header,
                                                   const std::string& file, const Unit* given,
                                                   Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics);
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::string axis(1, "xyz"[i]); !header.at[i])
      collect.problem(header_line, axis, "this column is missing", fmt::format("write {}_mm", axis));
  if (!header.name)
    collect.problem(header_line, "name", "this column is missing", "write name,x_mm,y_mm,z_mm");
  if (collect.failed()) return std::nullopt;
  std::string body;
  bool first = true;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string plain = plain_signs(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line <= header_line) continue;
    const std::string_view row = without_comment(plain, header.separator);
    body += '\n';
    if (begins_comment(without_blanks(row))) continue;
    std::vector<std::string_view> cells = cells_of(row, header.separator);
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    if (cells.empty()) continue;
    const bool decimals = header.separator == ',' && cells.size() == 2 * header.columns;
    const std::size_t needed = std::max({*header.name, *header.at[0], *header.at[1], *header.at[2]}) + 1;
    if (cells.size() > header.columns || (cells.size() < needed && cells.size() < 3)) {
      collect.problem(line, plain_name(*header.name < cells.size() ? cells[*header.name] : ""),
                      fmt::format("{} is not read: {} values, the header has {} columns", quoted(plain),
                                  cells.size(), header.columns),
                      decimals ? "with decimal commas separate the columns by semicolons"
                               : "put remarks behind #, or give their column a heading");
      continue;
    }
    cells.resize(std::max(cells.size(), needed));
    // A row of units below the headings.
    std::array<const Unit*, 3> units{};
    for (std::size_t i = 0; i < 3; ++i) units[i] = unit_of(plain_name(cells[*header.at[i]]));
    if (first && units[0] && units[1] && units[2]) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (header.units[i] && header.units[i] != units[i])
          collect.problem(line, std::string(1, "xyz"[i]),
                          fmt::format("is in {} here and in {} in the header", units[i]->suffix,
                                      header.units[i]->suffix));
        header.units[i] = units[i];
      }
      continue;
    }
    first = false;
    body += cells[*header.name];
    for (std::size_t i = 0; i < 3; ++i) (body += header.separator) += cells[*header.at[i]];
  }
  std::string ordered(static_cast<std::size_t>(header_line - 1), '\n');
  ordered += "name";
  for (std::size_t i = 0; i < 3; ++i)
    ordered += fmt::format("{}{}_{}", header.separator, "xyz"[i],
                           (header.units[i] ? header.units[i] : given) -> suffix);
  ordered += body;
  std::vector<int> lines;
  Diagnostics problems;
  const std::optional<Table> table = read_csv(ordered, file, problems, &lines);
  for (Diagnostic& d : problems) {
    d.position.column = 1;  // the column in the reordered line means nothing to the user
    diagnostics.push_back(std::move(d));
  }
  if (!table) return std::nullopt;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = (header.units[i] ? header.units[i] : given)->to_si(table->columns[i].values[row]);
    if (std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]))
      collect.add(lines[row], table->names[row], {at[0], at[1], at[2]});
    else
      collect.problem(lines[row], plain_name(table->names[row]), "a coordinate is missing");
  }
  return collect.finish();
}

/// A heading of plain text: it may name the axes, in one order, and the unit of all of them.
void read_heading(int line, std::span<const Word> words, ListCollector& collect, const Unit*& unit) {
  std::string axes;
  const Unit* found = nullptr;
  bool one = true, units_alone = true;
  for (const Word& word : words) {
    const Axis axis = axis_of(word.text);
    const Unit* own = axis.unit ? axis.unit : unit_of(plain_name(word.text));
    if (axis.axis >= 0) axes += "xyz"[axis.axis];
    if (own) one = one && (!found || found == own), found = own;
    if (!own && !plain_name(word.text).empty()) units_alone = false;
  }
  const bool named = axes.size() == 3;
  if (named && axes != "xyz")
    collect.problem(
        line, {}, fmt::format("the coordinates are in the order {}, {}, {}", axes[0], axes[1], axes[2]),
        "write them in the order x, y, z, or the list as CSV with the columns name,x_mm,y_mm,z_mm");
  const bool declared = !words.empty() && plain_name(words[0].text).starts_with("unit");
  if (!found || !(named || units_alone || declared)) return;
  if (one)
    unit = found;
  else
    collect.problem(line, {}, "the coordinates have different units",
                    "give such a list as CSV with the columns name,x_mm,y_mm,z_m");
}

/// The next line of a text without blanks at its ends, which it loses.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return without_blanks(line);
}

/// The name of a section of a property file, as in [HARDPOINT], in small letters; empty for other lines.
std::string section_of(std::string_view line) {
  if (line.size() < 3 || line.front() != '[' || line.back() != ']') return {};
  const std::string_view inner = line.substr(1, line.size() - 2);
  if (std::any_of(inner.begin(), inner.end(),
                  [](char c) { return !(std::isalpha(static_cast<unsigned char>(c)) || c == '_'); }))
    return {};
  return plain_name(inner);
}

/// The text of a word in quotes, which the line loses; empty for others.
std::string_view take_quoted(std::string_view& line) {
  line = without_blanks(line);
  if (line.empty() || (line.front() != '\'' && line.front() != '"')) return {};
  const std::size_t end = line.find(line.front(), 1);
  if (end == line.npos) return {};
  const std::string_view out = line.substr(1, end - 1);
  line.remove_prefix(end + 1);
  return out;
}

/// The table of hard points of a property file: rows of a name, its symmetry, x, y and z, and the unit of
/// length. A point of both sides is given for the left one; one of the right side alone is called so.
std::optional<std::vector<HardPoint>> read_property_table(std::string_view text, const std::string& file,
                                                          const Unit* unit, Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics);
  std::string section;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = take_line(rest);
    if (const std::string begun = section_of(line); !begun.empty()) section = begun;
    if (section != "units" || !plain_name(line).starts_with("length")) continue;
    line.remove_prefix(std::min(line.find('=') + 1, line.size()));
    const std::string_view word = take_quoted(line);
    const std::string plain = plain_name(word);
    if (const Unit* found = unit_of(plain == "meter" ? "m" : plain))
      unit = found;
    else
      collect.problem(0, "units", fmt::format("'{}' is not a known unit of length", word),
                      "write LENGTH = 'mm'");
  }
  section.clear();
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    if (const std::string begun = section_of(line); !begun.empty()) {
      section = begun;
      continue;
    }
    if (section != "hardpoint" || line.empty() || begins_comment(line) || line.front() == '{') continue;
    const std::string_view name = take_quoted(line), symmetry = take_quoted(line);
    const std::string side = plain_name(symmetry);
    const Line read = read_line("point " + std::string(line));
    if (name.empty() || !read.point || !read.number_in_name.empty() ||
        !(side == "left_right" || side == "left" || side == "right" || side == "single")) {
      collect.problem(number, plain_name(name), "is not a row of hard points",
                      "write 'name' 'left/right' x y z; the symmetry is left/right, left, right or single");
      continue;
    }
    std::array<double, 3> at{};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = (read.at[i].unit ? read.at[i].unit : unit)->to_si(*read.at[i].number);
    collect.add(number, side == "right" ? std::string(name) + " right" : std::string(name),
                {at[0], at[1], at[2]});
  }
  return collect.finish();
}

}  // namespace

std::optional<std::vector<HardPoint>> read_hard_points(std::string_view text, const std::string& file,
                                                       PointUnit given, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::string_view rest = text; !rest.empty();)
    if (section_of(take_line(rest)) == "hardpoint")
      return read_property_table(text, file, find_unit(Dimension::length, name_of(given)), diagnostics);
  const Unit* unit = find_unit(Dimension::length, name_of(given));
  ListCollector collect(file, diagnostics);
  const std::string_view whole = text;
  char separator = 0;
  bool first = true;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string plain = plain_signs(text.substr(0, end));
    const std::string_view row = without_blanks(plain);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (first && row.size() == 5 && row.starts_with("sep=")) separator = row.back();
    // A semicolon begins comments of some programs, and rows without a name.
    const bool comment = begins_comment(row) || (row.starts_with(';') && row.find(';', 1) == row.npos);
    if (row.empty() || comment || row.starts_with("sep=")) continue;
    if (first)
      if (const auto header = header_of(row, separator))
        return read_columns(whole, line, *header, file, unit, diagnostics);
    first = false;
    Line read = read_line(row);
    if (read.point) {
      std::array<double, 3> at{};
      for (std::size_t i = 0; i < 3; ++i)
        at[i] = (read.at[i].unit ? read.at[i].unit : unit)->to_si(*read.at[i].number);
      if (std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]))
        collect.add(line, read.name, {at[0], at[1], at[2]}, read.number_in_name);
      else
        collect.problem(line, plain_name(read.name), "a coordinate is not finite");
    } else if (read.numbers > 0) {
      collect.unread(line, row, read);
    } else {
      read_heading(line, read.words, collect, unit);
    }
  }
  return collect.finish();
}

}  // namespace linkwright::suspension
