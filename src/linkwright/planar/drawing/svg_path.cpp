// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/svg_path.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/fault.h"

namespace linkwright::planar::drawing {
namespace {

using Point = std::complex<double>;

constexpr std::size_t most_curve_steps = 24;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Number of numbers that a command takes, from its capital letter; -1 for no command.
int numbers_of(char letter) {
  switch (letter) {
    case 'M':
    case 'L':
    case 'T':
      return 2;
    case 'H':
    case 'V':
      return 1;
    case 'S':
    case 'Q':
      return 4;
    case 'C':
      return 6;
    case 'A':
      return 7;
    case 'Z':
      return 0;
    default:
      return -1;
  }
}

/// Length of the number that a text begins with, 0 if it begins with none: sign, digits with a point,
/// exponent.
std::size_t number_length(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - from;
  };
  const auto skip_sign = [&] {
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  };
  skip_sign();
  std::size_t count = digits();
  if (at < text.size() && text[at] == '.') ++at, count += digits();
  if (count == 0) return 0;
  const std::size_t whole = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at, skip_sign();
    if (digits() == 0) at = whole;
  }
  return at;
}

/// Reads numbers one after the other.
class NumberReader {
 public:
  NumberReader(std::string_view text, std::size_t begin, std::string what, int line)
      : text_(text), at_(begin), what_(std::move(what)), line_(line) {}

  /// True if another number follows before `end`.
  bool more(std::size_t end) {
    while (at_ < end && (is_blank(text_[at_]) || text_[at_] == ',')) ++at_;
    return at_ < end;
  }
  /// The next number; `flag`: a single digit 0 or 1, which may touch what follows.
  double next(bool flag) {
    const std::string_view rest = text_.substr(at_);
    const std::size_t length = flag ? (rest[0] == '0' || rest[0] == '1' ? 1 : 0) : number_length(rest);
    if (length == 0)
      throw Fault{line_,
                  fmt::format("'{}' after {} is not a {}", shown(rest.substr(0, rest.find('\n')), 12), what_,
                              flag ? "flag (0 or 1) of an arc" : "number"),
                  "copy the whole attribute once more, without its quotation marks"};
    const char* begin = rest.data() + (rest[0] == '+' ? 1 : 0);
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, rest.data() + length, value);
    static_cast<void>(stop);
    // A number that is too small to be held is 0.
    const bool too_large = error == std::errc::result_out_of_range && !is_tiny(rest.substr(0, length));
    if (too_large || !std::isfinite(value))
      throw Fault{line_, fmt::format("the number {} after {} is too large", shown(rest, 12), what_),
                  "coordinates are less than 1e300"};
    at_ += length;
    return error == std::errc() ? value : 0;
  }

 private:
  /// True for a number out of range with a negative exponent, or with none and zeros behind the point.
  static bool is_tiny(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    if (exponent != number.npos) return number[exponent + 1] == '-';
    return number.find_first_of("123456789") > number.find('.');
  }

  std::string_view text_;
  std::size_t at_;
  std::string what_;
  int line_;
};

/// A Bezier curve through its control points, appended without its first point.
void add_bezier(std::span<const Point> control, std::size_t steps, std::vector<Point>& out) {
  std::array<Point, 4> row;
  for (std::size_t k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(steps);
    std::copy(control.begin(), control.end(), row.begin());
    for (std::size_t n = control.size() - 1; n > 0; --n)
      for (std::size_t i = 0; i < n; ++i) row[i] += t * (row[i + 1] - row[i]);
    out.push_back(row[0]);
  }
}

/// An elliptical arc between two points, appended without its first (SVG 1.1, appendix F.6.5). `n`: radii,
/// rotation of the ellipse (deg), flags of the larger arc and of the sense.
void add_arc(Point from, Point to, std::span<const double> n, std::size_t steps, std::vector<Point>& out) {
  const double rx = n[0], ry = n[1];
  if (rx == 0 || ry == 0 || from == to) {
    out.push_back(to);
    return;
  }
  const bool larger = n[3] != 0, sweep = n[4] != 0;
  const Point turn = std::polar(1.0, n[2] * pi / 180);
  const Point p = std::conj(turn) * (0.5 * (from - to));
  // Radii that are too small for the distance grow until they reach.
  const double grow = std::max(1.0, std::hypot(p.real() / rx, p.imag() / ry));
  const double a = std::abs(rx) * grow, b = std::abs(ry) * grow;
  const double below = std::hypot(p.real() / a, p.imag() / b);  // 1 where the chord is a diameter
  const double size =
      (larger == sweep ? -1 : 1) * std::sqrt(std::max(0.0, (1 - below) * (1 + below))) / below;
  const Point centre{size * a * (p.imag() / b), -size * b * (p.real() / a)};
  const double first = std::atan2((p.imag() - centre.imag()) / b, (p.real() - centre.real()) / a);
  double span = std::atan2((-p.imag() - centre.imag()) / b, (-p.real() - centre.real()) / a) - first;
  if (sweep && span < 0) span += full_turn;
  if (!sweep && span > 0) span -= full_turn;
  for (std::size_t k = 1; k < steps; ++k) {
    const double angle = first + span * static_cast<double>(k) / static_cast<double>(steps);
    out.push_back(turn * (centre + Point(a * std::cos(angle), b * std::sin(angle))) + 0.5 * (from + to));
  }
  out.push_back(to);
}

/// Follows the commands.
class Pen {
 public:
  explicit Pen(std::size_t steps) : steps_(steps) {}

  void follow(const PathCommand& command) {
    const char name = capital(command.letter);
    if (name == 'Z') {
      end(true);
      at_ = start_, curve_ = 0;
      return;
    }
    if (name == 'M')
      end(false);
    else if (points_.empty())
      points_.push_back(at_);  // after Z
    draw(name, command.letter == name ? Point() : at_, command.numbers);
    if (name == 'M') start_ = at_;
  }

  std::vector<Line> take() {
    end(false);
    return std::move(lines_);
  }

 private:
  void end(bool closed) {
    if (points_.size() > 1) lines_.push_back({.points = std::move(points_), .closed = closed, .name = {}});
    points_.clear();
  }

  void draw(char name, Point from, const std::array<double, 7>& n) {
    const auto place = [&](std::size_t i) { return from + Point(n[i], n[i + 1]); };
    const auto mirrored = [&](char kind) { return curve_ == kind ? 2.0 * at_ - control_ : at_; };
    switch (name) {
      case 'H':
        return line({from.real() + n[0], at_.imag()});
      case 'V':
        return line({at_.real(), from.imag() + n[0]});
      case 'C':
        return bezier('C', std::array{at_, place(0), place(2), place(4)});
      case 'S':
        return bezier('C', std::array{at_, mirrored('C'), place(0), place(2)});
      case 'Q':
        return bezier('Q', std::array{at_, place(0), place(2)});
      case 'T':
        return bezier('Q', std::array{at_, mirrored('Q'), place(0)});
      case 'A':
        add_arc(at_, place(5), n, steps_, points_);
        at_ = place(5), curve_ = 0;
        return;
      default:
        return line(place(0));
    }
  }

  void line(Point to) {
    points_.push_back(to);
    at_ = to, curve_ = 0;
  }

  template <std::size_t count>
  void bezier(char kind, const std::array<Point, count>& control) {
    add_bezier(control, steps_, points_);
    at_ = control[count - 1], control_ = control[count - 2], curve_ = kind;
  }

  std::size_t steps_;
  std::vector<Line> lines_;
  std::vector<Point> points_;
  Point at_, start_, control_;
  char curve_ = 0;  // C or Q: the kind of curve that the control point is of, which S and T mirror
};

}  // namespace

std::vector<double> numbers_in(std::string_view text, const std::string& what, int line) {
  NumberReader reader(text, 0, what, line);
  std::vector<double> out;
  while (reader.more(text.size())) out.push_back(reader.next(false));
  return out;
}

std::vector<PathCommand> path_commands(std::string_view data, const std::string& what, int line) {
  const std::size_t begin = data.find_first_not_of(" \t\r\n\v\f");
  if (begin == data.npos || capital(data[begin]) != 'M')
    throw Fault{line, what + "the path data do not begin with M or m",
                "copy the attribute d of the path from its first letter on, for example 'M 0 0 L 40 0 C 60 0 "
                "60 30 40 30 Z'"};
  const auto is_command = [](char c) { return is_letter(c) && capital(c) != 'E'; };
  std::vector<PathCommand> out;
  for (std::size_t from = begin; from < data.size();) {
    const char letter = data[from], name = capital(letter);
    std::size_t end = from + 1;
    while (end < data.size() && !is_command(data[end])) ++end;
    const std::string place =
        fmt::format("the command {} (character {} of the path data)", letter, from - begin + 1);
    const int count = numbers_of(name);
    if (count < 0)
      throw Fault{line,
                  fmt::format("{}SVG has no path command {} (character {} of the path data)", what, letter,
                              from - begin + 1),
                  "the commands are M L H V C S Q T A Z, in capital or small letters"};
    const auto per_command = static_cast<std::size_t>(count);
    NumberReader reader(data.substr(0, end), from + 1, place, line);
    std::size_t found = 0;
    PathCommand command{.letter = letter};
    if (count == 0) {
      if (reader.more(end))
        throw Fault{line, fmt::format("{}numbers follow {}, which takes none", what, place),
                    "put a command such as L before them, or remove them"};
      out.push_back(command);
    }
    while (count > 0 && reader.more(end)) {
      const std::size_t i = found++ % per_command;
      try {
        command.numbers[i] = reader.next(name == 'A' && (i == 3 || i == 4));
      } catch (Fault& fault) {
        fault.message = what + fault.message;
        throw;
      }
      if (i + 1 < per_command) continue;
      out.push_back(command);
      if (name == 'M') command.letter = letter == 'M' ? 'L' : 'l';
    }
    if (count > 0 && (found == 0 || found % per_command != 0))
      throw Fault{line,
                  fmt::format("{}{} has {} number{}; it takes {} at a time", what, place,
                              found == 0 ? "no" : fmt::format("{}", found), found == 1 ? "" : "s", count),
                  "copy the path once more: a number is missing, or there is one too many"};
    from = end;
  }
  return out;
}

std::size_t curves_in(const std::vector<PathCommand>& commands) {
  return static_cast<std::size_t>(std::count_if(commands.begin(), commands.end(), [](const PathCommand& c) {
    return std::string_view("CSQTA").find(capital(c.letter)) != std::string_view::npos;
  }));
}

std::vector<Line> path_lines(const std::vector<PathCommand>& commands, std::size_t steps) {
  Pen pen(steps);
  for (const PathCommand& command : commands) pen.follow(command);
  return pen.take();
}

Line svg_path_line(std::string_view data) {
  const std::vector<PathCommand> commands = path_commands(data, "", 0);
  std::vector<Line> lines = path_lines(commands, curve_steps(curves_in(commands), most_curve_steps));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    lines[k].name = fmt::format("part {}", k + 1);
    for (Point& p : lines[k].points) p = std::conj(p);
  }
  return one_line(std::move(lines), "the path",
                  "keep one part, from its M to the next M, or let each part begin where another one ends; "
                  "drawing programs call this \"break apart\"");
}

}  // namespace linkwright::planar::drawing
