#include "linkwright/suspension/guide/hard_points.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "linkwright/core/csv.h"
#include "linkwright/core/units.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t most_points = 1000, most_problems = 20;
constexpr double farthest = 1e3;  ///< m: no vehicle reaches further; a slip of the unit does

/// Axis of the vehicle (0 x, 1 y, 2 z) and its sign.
struct Along {
  int axis;
  double sign;
};
Along along(Direction direction) {
  switch (direction) {
    case Direction::forward:
      return {0, 1};
    case Direction::rearward:
      return {0, -1};
    case Direction::left:
      return {1, 1};
    case Direction::right:
      return {1, -1};
    case Direction::up:
      return {2, 1};
    case Direction::down:
      break;
  }
  return {2, -1};
}

/// A number that fills the whole word; a comma may be its decimal point.
std::optional<double> number(std::string_view word, bool comma_is_point) {
  std::string text(word);
  if (comma_is_point) std::replace(text.begin(), text.end(), ',', '.');
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end) return std::nullopt;
  return value;
}

struct Words {
  std::vector<std::string> all;
  bool comma_separates = false;
};

/// Splits a line at blanks and semicolons, and at commas if they are no decimal points; quoted words stay
/// whole.
Words split(std::string_view line) {
  Words out;
  // A comma between two digits, in a line that blanks or semicolons take apart as well, is a decimal point.
  const bool other = line.find_first_of(" \t;") != std::string_view::npos;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != ',') continue;
    const bool between = i > 0 && i + 1 < line.size() &&
                         std::isdigit(static_cast<unsigned char>(line[i - 1])) &&
                         std::isdigit(static_cast<unsigned char>(line[i + 1]));
    if (!between || !other) out.comma_separates = true;
  }
  std::string word;
  bool open = false;
  const auto close = [&] {
    if (open) out.all.push_back(word);
    word.clear();
    open = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!open && (c == '"' || c == '\'')) {
      const std::size_t end = line.find(c, i + 1);
      if (end != std::string_view::npos) {
        out.all.emplace_back(line.substr(i + 1, end - i - 1));
        i = end;
        continue;
      }
    }
    if (c == ' ' || c == '\t' || c == ';' || c == '\r' || (c == ',' && out.comma_separates)) {
      close();
    } else {
      word += c;
      open = true;
    }
  }
  close();
  return out;
}

class Collector {
 public:
  Collector(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void problem(int line, std::string key, std::string message, std::string hint = {}) {
    if (++problems_ <= most_problems)
      diagnostics_.push_back({Diagnostic::Severity::error,
                              file_,
                              {line, line > 0 ? 1 : 0},
                              std::move(key),
                              std::move(message),
                              std::move(hint)});
  }

  void add(int line, std::string_view name, const Vec3& at) {
    const std::string plain = plain_name(name);
    if (plain.empty()) return problem(line, {}, "a point has no name", "write a name before x, y and z");
    if (!(std::abs(at.x) <= farthest && std::abs(at.y) <= farthest && std::abs(at.z) <= farthest))
      return problem(line, plain, fmt::format("lies at ({:.6g}, {:.6g}, {:.6g}) m", at.x, at.y, at.z),
                     "is the unit of the list right?");
    const auto same =
        std::find_if(points.begin(), points.end(), [&](const HardPoint& p) { return p.name == plain; });
    if (same != points.end()) {
      if (!(same->at == at))
        problem(line, plain, "is given twice, at different places", "give every point a name of its own");
      return;
    }
    if (points.size() == most_points)
      return problem(line, {}, fmt::format("more than {} points", most_points));
    points.push_back({plain, at});
  }

  std::optional<std::vector<HardPoint>> finish() {
    if (problems_ > 0) return std::nullopt;
    if (points.empty()) {
      problem(0, {}, "holds no point",
              "one point a line: name x y z; or CSV with the columns name,x_mm,y_mm,z_mm");
      return std::nullopt;
    }
    return std::move(points);
  }

  std::vector<HardPoint> points;

 private:
  const std::string& file_;
  Diagnostics& diagnostics_;
  std::size_t problems_ = 0;
};

std::optional<std::vector<HardPoint>> from_csv(std::string_view text, const std::string& file,
                                               Diagnostics& diagnostics) {
  std::vector<int> lines;
  const std::optional<Table> table = read_csv(text, file, diagnostics, &lines);
  if (!table) return std::nullopt;
  Collector collect(file, diagnostics);
  if (table->names.size() != table->rows()) {
    collect.problem(1, "name", "this column is missing", "write name,x_mm,y_mm,z_mm");
    return std::nullopt;
  }
  std::array<std::vector<double>, 3> at;
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Column* found = nullptr;
    const Unit* unit = nullptr;
    for (const Column& column : table->columns)
      if (const auto key = split_unit(column.key);
          key && key->base == axes[i] && key->dimension == Dimension::length) {
        found = &column;
        unit = key->unit;
      }
    if (!found) {
      collect.problem(1, std::string(axes[i]), "this column is missing", fmt::format("write {}_mm", axes[i]));
      continue;
    }
    for (double value : found->values) at[i].push_back(unit->to_si(value));
  }
  if (at[0].size() == table->rows() && at[1].size() == table->rows() && at[2].size() == table->rows())
    for (std::size_t row = 0; row < table->rows(); ++row) {
      const Vec3 p{at[0][row], at[1][row], at[2][row]};
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
        collect.add(lines[row], table->names[row], p);
      else
        collect.problem(lines[row], plain_name(table->names[row]), "a coordinate is missing");
    }
  return collect.finish();
}

/// Whether the first line that is no remark is a header whose first column is called `name`; blanks, tabs and
/// semicolons also separate the headings of printed lists, which have no units.
bool is_csv(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t begin = line.find_first_not_of(" \t\r\"");
    if (begin == std::string_view::npos || line[begin] == '#' || line.starts_with("sep=")) continue;
    std::string first;
    for (const char c : line.substr(begin, 4))
      first += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const std::size_t next = line.find_first_not_of(" \"", begin + 4);
    if (first != "name" || next == std::string_view::npos) return false;
    const bool units = line.find_first_of("_[(") != std::string_view::npos;
    return line[next] == ',' || ((line[next] == ';' || line[next] == '\t') && units);
  }
  return false;
}

}  // namespace

std::string problem(const PointFrame& frame) {
  constexpr std::array<std::string_view, 3> lines{"forward and rearward", "left and right", "up and down"};
  const std::array<std::pair<char, Along>, 3> all{
      {{'x', along(frame.x)}, {'y', along(frame.y)}, {'z', along(frame.z)}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      if (all[i].second.axis == all[j].second.axis)
        return fmt::format("{} and {} both lie along {}", all[i].first, all[j].first,
                           lines[static_cast<std::size_t>(all[i].second.axis)]);
  return {};
}

Vec3 to_vehicle(const PointFrame& frame, const Vec3& at) {
  std::array<double, 3> out{frame.origin.x, frame.origin.y, frame.origin.z};
  const auto add = [&](Direction direction, double value) {
    const auto [axis, sign] = along(direction);
    out[static_cast<std::size_t>(axis)] += sign * value;
  };
  add(frame.x, at.x);
  add(frame.y, at.y);
  add(frame.z, at.z);
  return {out[0], out[1], out[2]};
}

Vec3 from_vehicle(const PointFrame& frame, const Vec3& at) {
  const Vec3 d = at - frame.origin;
  const std::array<double, 3> from{d.x, d.y, d.z};
  const auto take = [&](Direction direction) {
    const auto [axis, sign] = along(direction);
    return sign * from[static_cast<std::size_t>(axis)];
  };
  return {take(frame.x), take(frame.y), take(frame.z)};
}

std::vector<HardPoint> points_of(const WheelGuide& guide) {
  std::vector<HardPoint> out;
  const auto add = [&](const std::string& link, std::string_view end, const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      out.push_back({plain_name(fmt::format("{} {}{}", link, end,
                                            points.size() > 1 ? fmt::format(" {}", i + 1) : std::string())),
                     points[i]});
  };
  for (std::size_t i = 0; i < guide.links.size(); ++i) {
    const std::string name = link_label(guide, static_cast<int>(i));
    add(name, "body", guide.links[i].body);
    add(name, "carrier", guide.links[i].carrier);
  }
  for (std::size_t i = 0; i < guide.couplers.size(); ++i) {
    const std::string& name = guide.couplers[i].name;
    add(name.empty() ? fmt::format("coupler {}", i + 1) : name, "point", {guide.couplers[i].point});
    if (guide.couplers[i].begin)
      add(name.empty() ? fmt::format("coupler {}", i + 1) : name, "first point", {*guide.couplers[i].begin});
  }
  if (guide.spring) {
    add("spring", "body", {guide.spring->body});
    add("spring", "moving", {guide.spring->moving});
  }
  add("wheel", "centre", {guide.wheel.centre});
  return out;
}

std::string plain_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter))
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

std::optional<std::vector<HardPoint>> read_hard_points(std::string_view text, const std::string& file,
                                                       PointUnit unit, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (is_csv(text)) return from_csv(text, file, diagnostics);
  const Unit* in = find_unit(Dimension::length, name_of(unit));
  Collector collect(file, diagnostics);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view all = text.substr(0, end);
    const Words words = split(all);
    const auto& w = words.all;
    const bool comment =
        w.empty() || std::string_view("#$!%").find(w[0].empty() ? '#' : w[0][0]) != std::string_view::npos;
    text.remove_prefix(std::min(end + 1, text.size()));
    if (comment || w.size() < 3) continue;
    // The last three words are the coordinates, what is before them the name, less a number of the list.
    std::array<std::optional<double>, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = number(w[w.size() - 3 + i], !words.comma_separates);
    if (!at[0] || !at[1] || !at[2]) {
      // Headings are passed over; two numbers beside something with digits are a slip.
      if (w.size() > 3 && !number(w[0], true) && int{!at[0]} + int{!at[1]} + int{!at[2]} == 1)
        for (std::size_t i = 0; i < 3; ++i)
          if (const std::string& word = w[w.size() - 3 + i];
              !at[i] && word.find_first_of("0123456789") != std::string::npos)
            diagnostics.push_back({Diagnostic::Severity::warning,
                                   file,
                                   {line, 1},
                                   plain_name(w[0]),
                                   fmt::format("'{}' is not a number, the line is passed over", word),
                                   {}});
      continue;
    }
    std::size_t begin = 0;
    if (w.size() > 4 && w[0].find_first_not_of("0123456789.:)") == std::string::npos) begin = 1;
    std::string name;
    for (std::size_t i = begin; i + 3 < w.size(); ++i) name += (name.empty() ? "" : " ") + w[i];
    if (!std::isfinite(*at[0]) || !std::isfinite(*at[1]) || !std::isfinite(*at[2])) {
      collect.problem(line, plain_name(name), "a coordinate is not finite");
      continue;
    }
    collect.add(line, name, {in->to_si(*at[0]), in->to_si(*at[1]), in->to_si(*at[2])});
  }
  return collect.finish();
}

Table hard_point_table(const std::vector<HardPoint>& points) {
  Table table{.name = "hard_points"};
  table.add("x_m", "x (m)");
  table.add("y_m", "y (m)");
  table.add("z_m", "z (m)");
  for (const HardPoint& point : points) {
    table.names.push_back(point.name);
    table.columns[0].values.push_back(point.at.x);
    table.columns[1].values.push_back(point.at.y);
    table.columns[2].values.push_back(point.at.z);
  }
  return table;
}

}  // namespace linkwright::suspension
