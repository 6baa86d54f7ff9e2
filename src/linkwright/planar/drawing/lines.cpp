// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/fault.h"

namespace linkwright::planar::drawing {
namespace {

using Point = std::complex<double>;

constexpr double reach = 1e-4;                     // sizes of the drawing within which ends meet
constexpr double farthest = 1e12;                  // mm from the origin
constexpr std::size_t max_curve_points = 500'000;  // of all curves of a drawing

/// The box around points.
struct Box {
  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
  void add(const Point& p) {
    left = std::min(left, p.real()), right = std::max(right, p.real());
    bottom = std::min(bottom, p.imag()), top = std::max(top, p.imag());
  }
  double size() const { return std::max(right - left, top - bottom); }
};

/// The distance within which ends meet: small beside the drawing, and beside the lengths of its lines.
double tolerance_of(const std::vector<Line>& lines) {
  Box box;
  std::vector<double> lengths;
  for (const Line& line : lines) {
    for (const Point& p : line.points) box.add(p);
    lengths.push_back(length_of(line));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max(std::min(reach * box.size(), *middle / 10), 1e-12 * box.size());
}

/// The numbers of the places that ends are at; ends within `tolerance` of a place are at it.
std::vector<std::size_t> places_of(const std::vector<Point>& ends, double tolerance) {
  Box box;
  for (const Point& p : ends) box.add(p);
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;  // places by the square that they are in
  std::vector<Point> places;
  const auto cell_of = [](std::int64_t i, std::int64_t k) {
    return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(k);
  };
  const auto place_of = [&](const Point& p) {
    const auto i = static_cast<std::int64_t>(std::floor((p.real() - box.left) / tolerance)),
               k = static_cast<std::int64_t>(std::floor((p.imag() - box.bottom) / tolerance));
    for (std::int64_t column = i - 1; column <= i + 1; ++column)
      for (std::int64_t row = k - 1; row <= k + 1; ++row)
        if (const auto cell = cells.find(cell_of(column, row)); cell != cells.end())
          for (const std::size_t n : cell->second)
            if (std::abs(p - places[n]) <= tolerance) return n;
    cells[cell_of(i, k)].push_back(places.size());
    places.push_back(p);
    return places.size() - 1;
  };
  std::vector<std::size_t> out;
  for (const Point& p : ends) out.push_back(place_of(p));
  return out;
}

/// A line whose ends meet is closed; one that only goes there and back is not.
Line ring(Line line) {
  if (line.points.size() > 3) line.points.pop_back(), line.closed = true;
  return line;
}

/// Joins open lines to chains. A line has two ends: 2 k at its first point, 2 k + 1 at its last.
class Chains {
 public:
  explicit Chains(const std::vector<Line>& all) {
    const double tolerance = tolerance_of(all);
    for (const Line& line : all)
      if (length_of(line) > tolerance) lines_.push_back(&line);  // shorter ones are within a place
    std::vector<Point> ends;
    for (const Line* line : lines_) ends.push_back(line->points.front()), ends.push_back(line->points.back());
    if (ends.empty()) return;
    place_ = places_of(ends, tolerance);
    free_.resize(*std::max_element(place_.begin(), place_.end()) + 1);
    for (std::size_t end = 0; end < place_.size(); ++end) free_[place_[end]].push_back(end);
    for (std::size_t k = 0; k < lines_.size(); ++k) used_.push_back(is_ring(k));
  }

  void append_to(std::vector<Line>& out) {
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (is_ring(k)) {
        out.push_back(ring(*lines_[k]));
        continue;
      }
      if (used_[k]) continue;
      used_[k] = true;
      const std::vector<std::size_t> after = follow(place_[2 * k + 1]);
      std::vector<std::size_t> entered = follow(place_[2 * k]);
      std::reverse(entered.begin(), entered.end());
      for (std::size_t& end : entered) end ^= 1u;
      entered.push_back(2 * k);
      entered.insert(entered.end(), after.begin(), after.end());
      Line chain = joined(entered);
      chain.name = entered.size() > 1 ? "the chain with " + lines_[k]->name : lines_[k]->name;
      out.push_back(place_[entered.front()] == place_[entered.back() ^ 1u] ? ring(std::move(chain))
                                                                           : std::move(chain));
    }
  }

 private:
  bool is_ring(std::size_t k) const { return place_[2 * k] == place_[2 * k + 1]; }

  /// The ends at which the next lines are entered from a place on.
  std::vector<std::size_t> follow(std::size_t at) {
    std::vector<std::size_t> entered;
    for (;;) {
      std::vector<std::size_t>& here = free_[at];
      while (!here.empty() && used_[here.back() / 2]) here.pop_back();
      if (here.empty()) return entered;
      used_[here.back() / 2] = true;
      entered.push_back(here.back());
      here.pop_back();
      at = place_[entered.back() ^ 1u];
    }
  }

  Line joined(const std::vector<std::size_t>& entered) const {
    Line out;
    for (const std::size_t end : entered) {
      std::vector<Point> own = lines_[end / 2]->points;
      if (end % 2 == 1) std::reverse(own.begin(), own.end());
      out.points.insert(out.points.end(), own.begin() + (out.points.empty() ? 0 : 1), own.end());
    }
    return out;
  }

  std::vector<const Line*> lines_;
  std::vector<std::size_t> place_;
  std::vector<std::vector<std::size_t>> free_;  // ends at each place
  std::vector<bool> used_;
};

/// The longest lines with their lengths.
std::string longest_of(const std::vector<Line>& lines) {
  std::vector<std::pair<double, const Line*>> all;
  for (const Line& line : lines) all.emplace_back(length_of(line), &line);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string out;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, all.size()); ++i)
    out += fmt::format("{}{} ({:.3g} mm long)", i == 0 ? "" : ", ", all[i].second->name, all[i].first);
  return out + (all.size() > 3 ? ", ..." : "");
}

}  // namespace

std::size_t curve_steps(std::size_t curves, std::size_t most) {
  return std::max<std::size_t>(2, std::min(most, max_curve_points / std::max<std::size_t>(1, curves)));
}

double length_of(const Line& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i) sum += std::abs(line.points[i] - line.points[i - 1]);
  if (line.closed && !line.points.empty()) sum += std::abs(line.points.front() - line.points.back());
  return sum;
}

Line one_line(std::vector<Line> all, const std::string& where, const std::string& hint) {
  for (const Line& line : all)
    if (!std::all_of(line.points.begin(), line.points.end(),
                     [](const Point& p) { return std::isfinite(p.real()) && std::isfinite(p.imag()); }))
      throw Fault{0, fmt::format("a coordinate of {} is not a finite number", line.name),
                  "save the drawing again: the file is damaged, or a number in it is too large"};
  for (const Line& line : all)
    for (const Point& p : line.points)
      if (std::max(std::abs(p.real()), std::abs(p.imag())) > farthest)
        throw Fault{0, fmt::format("a point of {} lies more than 1e9 m from the origin", line.name),
                    "check the number and the unit"};
  std::erase_if(all, [](const Line& line) { return !(length_of(line) > 0); });
  std::vector<Line> lines, open;
  for (Line& line : all) (line.closed ? lines : open).push_back(std::move(line));
  if (!open.empty()) Chains(open).append_to(lines);
  if (lines.empty())
    throw Fault{0, fmt::format("{} draws no line: all its points are at the same place", where),
                "give at least two different points; three for a closed path"};
  if (lines.size() > 1)
    throw Fault{0,
                fmt::format("{} has {} separate lines: {}; a traced point can follow only one", where,
                            lines.size(), longest_of(lines)),
                hint};
  return std::move(lines.front());
}

}  // namespace linkwright::planar::drawing
