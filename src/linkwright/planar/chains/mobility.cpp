// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/mobility.h"

#include <algorithm>
#include <array>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::planar {
namespace {

// Numbers modulo the Mersenne prime 2^31 - 1: positions are drawn among them, so ranks need no tolerance. A
// position that hides a freedom by chance is one in about 10^8.
constexpr std::uint64_t prime = 2147483647;

std::uint64_t power(std::uint64_t base, std::uint64_t exponent) {
  std::uint64_t out = 1;
  for (; exponent != 0; exponent >>= 1, base = base * base % prime)
    if (exponent & 1) out = out * base % prime;
  return out;
}
std::uint64_t inverse(std::uint64_t value) { return power(value, prime - 2); }

constexpr int max_columns = 3 * max_chain_links;
using Row = std::array<std::uint64_t, max_columns>;

// The velocity equations. Unknowns are the angular velocity of each link and the velocity of its point at the
// origin; link 0 is held.
class Equations {
 public:
  explicit Equations(int links) : columns_(3 * links - 3) {}

  // A pin at a place leaves link b its rotation against link a, a slide its shift along a line with this
  // normal. Wheels in mesh have angular velocities against their carrier in a ratio.
  void pin(int a, int b, std::uint64_t x, std::uint64_t y) {
    Row along_x{}, along_y{};
    relative(along_x, a, b, 1, 1), relative(along_x, a, b, 0, prime - y);
    relative(along_y, a, b, 2, 1), relative(along_y, a, b, 0, x);
    rows_.push_back(along_x), rows_.push_back(along_y);
  }
  void slide(int a, int b, std::uint64_t normal_x, std::uint64_t normal_y) {
    Row across{};
    relative(across, a, b, 1, normal_x), relative(across, a, b, 2, normal_y);
    rows_.push_back(rate(a, b)), rows_.push_back(across);
  }
  void mesh(const GearPair& gear, std::uint64_t ratio) {
    Row row = rate(gear.carrier, gear.first);
    relative(row, gear.carrier, gear.second, 0, ratio);
    rows_.push_back(row);
  }
  Row rate(int a, int b) const {
    Row out{};
    relative(out, a, b, 0, 1);
    return out;
  }
  // The components of the velocity of a slide: both vanish where it does not move.
  std::array<Row, 2> velocity(int a, int b) const {
    std::array<Row, 2> out{};
    relative(out[0], a, b, 1, 1), relative(out[1], a, b, 2, 1);
    return out;
  }

  // Gauss-Jordan elimination; returns the rank.
  int eliminate() {
    int rank = 0;
    for (int c = 0; c < columns_ && rank < std::ssize(rows_); ++c) {
      const auto pivot =
          std::find_if(rows_.begin() + rank, rows_.end(), [&](const Row& r) { return r[at(c)] != 0; });
      if (pivot == rows_.end()) continue;
      std::swap(*pivot, rows_[at(rank)]);
      pivots_.push_back(c);
      clear_column(c, rank++);
    }
    return rank;
  }
  // True if the equations leave no motion that this row measures.
  bool implies(Row row) const {
    for (std::size_t k = 0; k < pivots_.size(); ++k) subtract(row, rows_[k], row[at(pivots_[k])]);
    return std::all_of(row.begin(), row.begin() + columns_, [](std::uint64_t v) { return v == 0; });
  }
  int columns() const { return columns_; }

 private:
  // Adds factor times (quantity of b - quantity of a).
  void relative(Row& row, int a, int b, int quantity, std::uint64_t factor) const {
    const auto add = [&](int link, std::uint64_t by) {
      if (link == 0) return;
      std::uint64_t& entry = row[at(3 * (link - 1) + quantity)];
      entry = (entry + by) % prime;
    };
    add(b, factor), add(a, prime - factor);
  }
  void subtract(Row& row, const Row& other, std::uint64_t factor) const {
    if (factor == 0) return;
    for (int c = 0; c < columns_; ++c) row[at(c)] = (row[at(c)] + (prime - factor) * other[at(c)]) % prime;
  }
  void clear_column(int column, int pivot) {
    const std::uint64_t scale = inverse(rows_[at(pivot)][at(column)]);
    for (std::uint64_t& v : rows_[at(pivot)]) v = v * scale % prime;
    for (int r = 0; r < std::ssize(rows_); ++r)
      if (r != pivot) subtract(rows_[at(r)], rows_[at(pivot)], rows_[at(r)][at(column)]);
  }

  int columns_;
  std::vector<Row> rows_;
  std::vector<int> pivots_;
};

}  // namespace

Mobility mobility(const ChainGraph& graph, std::uint32_t sliders, const std::optional<GearPair>& gear) {
  RandomStream random({.seed = 1});
  const auto draw = [&] { return 1 + random.bits() % (prime - 1); };
  const std::vector<JointEnds> joints = joints_of(graph);
  Equations equations(graph.links);
  const auto slides = [&](std::size_t k) { return (sliders >> k & 1) != 0; };
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const std::uint64_t x = draw(), y = draw();
    if (slides(k))
      equations.slide(joints[k][0], joints[k][1], x, y);
    else
      equations.pin(joints[k][0], joints[k][1], x, y);
  }
  if (gear) equations.mesh(*gear, draw());
  Mobility out{.freedoms = equations.columns() - equations.eliminate(), .each_joint_moves = true};
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto [a, b] = joints[k];
    const std::array<Row, 2> shift = equations.velocity(a, b);
    const bool still = slides(k) ? equations.implies(shift[0]) && equations.implies(shift[1])
                                 : equations.implies(equations.rate(a, b));
    out.each_joint_moves = out.each_joint_moves && !still;
  }
  return out;
}

}  // namespace linkwright::planar
