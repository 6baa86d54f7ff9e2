// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/stick_efforts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace linkwright::planar {
namespace {

// The rank is that of pivots above this share of the diagonal.
constexpr double rank_tolerance = 1e-10;
// Most choices of joints that are compared where efforts are not unique.
constexpr double most_choices = 5000;

// Cholesky's factor with pivots of the matrix whose diagonal is scaled to 1: the rows of `row` belong to the
// joints, the first `rank` of `order` are the pivots.
struct Factor {
  std::size_t rank = 0;
  std::vector<std::size_t> order;
  std::vector<std::vector<double>> row;
  std::vector<double> scale;  // of a joint; 0: nothing moves it
};

Factor factor_of(std::span<const double> matrix, std::size_t n) {
  Factor f;
  f.row.assign(n, std::vector<double>(n, 0.0));
  f.scale.assign(n, 0.0);
  std::vector<double> rest(n * n);
  for (std::size_t i = 0; i < n; ++i)
    if (matrix[i * n + i] > 0) f.scale[i] = 1 / std::sqrt(matrix[i * n + i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      rest[i * n + k] = (matrix[i * n + k] + matrix[k * n + i]) / 2 * f.scale[i] * f.scale[k];
  f.order.resize(n);
  std::iota(f.order.begin(), f.order.end(), std::size_t{0});
  for (; f.rank < n; ++f.rank) {
    const std::size_t s = f.rank;
    std::size_t best = s;
    for (std::size_t i = s; i < n; ++i)
      if (rest[f.order[i] * (n + 1)] > rest[f.order[best] * (n + 1)]) best = i;
    std::swap(f.order[s], f.order[best]);
    const std::size_t p = f.order[s];
    const double pivot = rest[p * (n + 1)];
    if (!(pivot > rank_tolerance)) break;
    for (std::size_t i = s; i < n; ++i) f.row[f.order[i]][s] = rest[f.order[i] * n + p] / std::sqrt(pivot);
    for (std::size_t i = s; i < n; ++i)
      for (std::size_t k = s; k < n; ++k) {
        const std::size_t a = f.order[i], b = f.order[k];
        rest[a * n + b] -= f.row[a][s] * f.row[b][s];
      }
  }
  return f;
}

// A vector across the given rows of the factor, one fewer than its rank; empty where they depend on each
// other.
std::vector<double> across(const Factor& f, std::span<const std::size_t> joints) {
  const std::size_t n = f.rank;
  std::vector<std::vector<double>> rows;
  for (const std::size_t k : joints) rows.push_back(f.row[k]);
  std::vector<std::size_t> column(n);
  std::iota(column.begin(), column.end(), std::size_t{0});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t row = i, best = i;
    double largest = 0;
    for (std::size_t a = i; a < rows.size(); ++a)
      for (std::size_t b = i; b < n; ++b)
        if (std::abs(rows[a][column[b]]) > largest) largest = std::abs(rows[a][column[b]]), row = a, best = b;
    if (!(largest > 1e-8)) return {};
    std::swap(rows[i], rows[row]);
    std::swap(column[i], column[best]);
    for (std::size_t a = i + 1; a < rows.size(); ++a) {
      const double share = rows[a][column[i]] / rows[i][column[i]];
      for (std::size_t b = i; b < n; ++b) rows[a][column[b]] -= share * rows[i][column[b]];
    }
  }
  std::vector<double> out(n, 0.0);
  out[column[n - 1]] = 1;
  for (std::size_t i = rows.size(); i-- > 0;) {
    double sum = 0;
    for (std::size_t b = i + 1; b < n; ++b) sum += rows[i][column[b]] * out[column[b]];
    out[column[i]] = -sum / rows[i][column[i]];
  }
  return out;
}

double product(std::span<const double> a, std::span<const double> b, std::size_t n) {
  return std::inner_product(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(n), b.begin(), 0.0);
}

// The motion that is nearest to being set free, and the share of what the joints bear that it asks for.
struct Mode {
  std::vector<double> direction;
  double share = -1;
};
Mode nearest_mode(const Factor& f, std::span<const double> pushed, std::span<const double> capacity) {
  const std::size_t n = capacity.size(), held = f.rank - 1;
  Mode best;
  double choices = 1;
  for (std::size_t i = 0; i < held; ++i) choices *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  if (choices > most_choices) return best;
  std::vector<std::size_t> chosen(held);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  while (true) {
    if (const std::vector<double> v = across(f, chosen); !v.empty()) {
      double borne = 0;
      for (std::size_t k = 0; k < n; ++k)
        if (f.scale[k] > 0) borne += capacity[k] / f.scale[k] * std::abs(product(f.row[k], v, f.rank));
      const double push = std::abs(product(pushed, v, f.rank)), share = borne > 0 ? push / borne : 0;
      if (share > best.share) best = {v, share};
    }
    std::size_t i = held;
    while (i > 0 && chosen[i - 1] == n - held + i - 1) --i;
    if (i == 0) return best;
    ++chosen[i - 1];
    for (; i < held; ++i) chosen[i] = chosen[i - 1] + 1;
  }
}

}  // namespace

std::size_t stuck_motions(std::span<const double> matrix, std::size_t count) {
  return factor_of(matrix, count).rank;
}

std::vector<double> stick_efforts(std::span<const double> matrix, std::span<const double> wanted,
                                  std::span<const double> capacity) {
  const std::size_t n = wanted.size();
  std::vector<double> out(n, 0.0);
  const Factor f = factor_of(matrix, n);
  const std::size_t r = f.rank;
  if (r == 0) return out;
  std::vector<double> pushed(r);  // what the independent motions are accelerated by
  for (std::size_t i = 0; i < r; ++i) {
    const std::size_t k = f.order[i];
    pushed[i] = (f.scale[k] * wanted[k] - product(f.row[k], pushed, i)) / f.row[k][i];
  }
  const Mode mode = r < n ? nearest_mode(f, pushed, capacity) : Mode{};
  if (mode.share < 0) {  // all are independent, or too many to compare: the pivots bear it
    for (std::size_t i = r; i-- > 0;) {
      double sum = pushed[i];
      for (std::size_t m = i + 1; m < r; ++m) sum -= f.row[f.order[m]][i] * out[f.order[m]];
      out[f.order[i]] = sum / f.row[f.order[i]][i];
    }
    for (std::size_t k = 0; k < n; ++k) out[k] *= f.scale[k];
    return out;
  }
  const double push = product(pushed, mode.direction, r);
  double largest = 0;
  std::vector<double> part(n);
  for (std::size_t k = 0; k < n; ++k) {
    part[k] = product(f.row[k], mode.direction, r);
    largest = std::max(largest, std::abs(part[k]));
  }
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < n; ++k) {
    if (std::abs(part[k]) > 1e-9 * largest && f.scale[k] > 0)
      out[k] = mode.share * capacity[k] * (part[k] * push > 0 ? 1 : -1);
    else
      rest.push_back(k);
  }
  if (rest.empty() || rest.size() == n) return out;
  std::vector<double> smaller, left, borne;
  for (const std::size_t i : rest) {
    double sum = wanted[i];
    for (std::size_t k = 0; k < n; ++k) sum -= matrix[i * n + k] * out[k];
    left.push_back(sum);
    borne.push_back(capacity[i]);
    for (const std::size_t k : rest) smaller.push_back(matrix[i * n + k]);
  }
  const std::vector<double> others = stick_efforts(smaller, left, borne);
  for (std::size_t i = 0; i < rest.size(); ++i) out[rest[i]] = others[i];
  return out;
}

}  // namespace linkwright::planar
