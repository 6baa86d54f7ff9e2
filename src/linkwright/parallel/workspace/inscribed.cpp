// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/inscribed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/zero.h"

namespace linkwright::parallel {

namespace {

constexpr std::size_t between_looks = 64;

// Counts work in nodes looked at, and looks at the context from time to time.
class Work {
 public:
  void done(std::size_t nodes, const RunContext& context) {
    constexpr std::size_t much = 4'000'000;  // some milliseconds
    if ((nodes_ += nodes) < much) return;
    nodes_ = 0;
    throw_if_interrupted(context);
  }

 private:
  std::size_t nodes_ = 0;
};

// Squares of the distances, in steps, to the nearest node outside the set along the first `axes` axes; beyond
// the grid all is outside.
std::vector<double> squared_distances(const WorkspaceMap& map, const NodeSet& set, int axes,
                                      const RunContext& context) {
  Work work;
  std::vector<double> out(map.count());
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = set[n] ? 1e18 : 0;
  std::size_t stride = 1;
  for (int axis = 0; axis < axes; ++axis) {
    const std::size_t length = map.nodes[axis];
    std::vector<double> line(length);
    for (std::size_t start = 0; start < out.size(); ++start) {
      if (start / stride % length != 0) continue;
      for (std::size_t i = 0; i < length; ++i) line[i] = out[start + i * stride];
      for (std::size_t i = 0; i < length; ++i) {
        if (i % between_looks == between_looks - 1) work.done(length, context);
        double best = line[i];
        for (std::size_t t = 1; static_cast<double>(t * t) < best; ++t) {
          const double square = static_cast<double>(t * t);
          best = std::min(
              {best, square + (t <= i ? line[i - t] : 0), square + (i + t < length ? line[i + t] : 0)});
        }
        out[start + i * stride] = best;
      }
    }
    stride *= length;
  }
  return out;
}

struct GridBody {
  Vec3 centre, half;
  double value = 0;  // product of the half sizes that are not 0
};

// Product of half sizes; in the plane of the two.
double value_of(const Vec3& half) { return half.x * half.y * (half.z > 0 ? half.z : 1); }

GridBody ball_on_grid(const WorkspaceMap& map, const NodeSet& set, const RunContext& context) {
  const std::vector<double> square = squared_distances(map, set, map.axes, context);
  const auto most = std::max_element(square.begin(), square.end());
  // The nearest node outside is a step further than what is known to pass.
  const double r = std::max(std::sqrt(*most) - 1, 0.5) * map.grid.step;
  if (*most == 0) return {};
  const Vec3 half{r, r, map.axes == 3 ? r : 0};
  return {map.position(static_cast<std::size_t>(most - square.begin())), half, value_of(half)};
}

GridBody cylinder_on_grid(const WorkspaceMap& map, const NodeSet& set, const InscribedTask& task,
                          const RunContext& context) {
  const std::vector<double> square = squared_distances(map, set, 2, context);
  const double step = map.grid.step;
  Work work;
  GridBody best;
  double best_rank = 0;
  const std::size_t layer = map.nodes[0] * map.nodes[1];
  std::size_t first = 0, last = layer;
  if (task.axis) {
    const auto along = [&](double low, double value, std::size_t nodes) {
      return static_cast<std::size_t>(
          std::clamp(std::round((value - low) / step), 0.0, static_cast<double>(nodes - 1)));
    };
    first = map.number(along(map.grid.low.x, task.axis->x, map.nodes[0]),
                       along(map.grid.low.y, task.axis->y, map.nodes[1]), 0);
    last = first + 1;
  }
  for (std::size_t column = first; column < last; ++column)
    for (std::size_t k = 0; k < map.nodes[2]; ++k) {
      work.done(map.nodes[2] - k, context);
      double least = 1e18;
      for (std::size_t end = k; end < map.nodes[2] && set[column + layer * end]; ++end) {
        least = std::min(least, square[column + layer * end]);
        double r = std::max(std::sqrt(least) - 1, 0.5) * step;
        double half_height = std::max(0.5 * static_cast<double>(end - k), 0.25) * step;
        if (task.height > 0) {
          if (2 * half_height < task.height * (1 - 1e-9)) continue;
          half_height = 0.5 * task.height;
        }
        if (task.ratio > 0) {
          r = std::min(r, half_height / task.ratio);
          half_height = task.ratio * r;
        }
        const double rank = task.height > 0 ? r : r * r * half_height;
        if (rank > best_rank) {
          best_rank = rank;
          const Vec3 low = map.position(column + layer * k), high = map.position(column + layer * end);
          best = {0.5 * (low + high), {r, r, half_height}, 0};
        }
      }
    }
  best.value = value_of(best.half);
  return best;
}

// Largest rectangle of nodes in each layer that several layers share, by the stack over a row's heights.
GridBody box_on_grid(const WorkspaceMap& map, const NodeSet& set, const RunContext& context) {
  const auto [nx, ny, nz] = map.nodes;
  const double step = map.grid.step;
  Work work;
  GridBody best;
  std::vector<std::uint8_t> shared(nx * ny);
  std::vector<std::size_t> height(nx + 1), stack;
  for (std::size_t k = 0; k < nz; ++k) {
    std::fill(shared.begin(), shared.end(), std::uint8_t{1});
    for (std::size_t end = k; end < nz; ++end) {
      work.done(nx * ny, context);
      bool any = false;
      for (std::size_t n = 0; n < nx * ny; ++n) any = (shared[n] &= set[n + nx * ny * end]) || any;
      if (!any) break;
      std::fill(height.begin(), height.end(), std::size_t{0});
      for (std::size_t j = 0; j < ny; ++j) {
        for (std::size_t i = 0; i < nx; ++i) height[i] = shared[i + nx * j] ? height[i] + 1 : 0;
        stack.clear();
        for (std::size_t i = 0; i <= nx; ++i) {
          while (!stack.empty() && height[stack.back()] >= height[i]) {
            const std::size_t rows = height[stack.back()];
            stack.pop_back();
            const std::size_t from = stack.empty() ? 0 : stack.back() + 1;
            if (rows < 2 || i - from < 2 || (nz > 1 && end == k)) continue;
            const Vec3 low = map.position(map.number(from, j + 1 - rows, k)),
                       high = map.position(map.number(i - 1, j, end));
            const Vec3 half = 0.5 * (high - low);
            if (value_of(half) > best.value) best = {0.5 * (low + high), half, value_of(half)};
          }
          stack.push_back(i);
        }
      }
    }
  }
  // A set of single nodes has no box; half a cell about one of them is a start.
  if (best.value == 0)
    for (std::size_t n = 0; n < set.size(); ++n)
      if (set[n]) {
        const double h = 0.25 * step;
        best = {map.position(n), {h, h, nz > 1 ? h : 0}, 0};
        best.value = value_of(best.half);
        break;
      }
  return best;
}

// Points on the surface of the shape with half sizes 1; `fine` times as many along each direction.
std::vector<Vec3> surface(InscribedShape shape, bool plane, int fine) {
  std::vector<Vec3> out;
  const int around = 72 * fine, across = 8 * fine;
  const auto part = [&](int i) { return 2.0 * i / across - 1; };
  const auto circle = [&](double r, double z) {
    const int points = std::max(6, static_cast<int>(std::lround(r * around)));
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * pi * i / points;
      out.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  };
  if (shape == InscribedShape::cylinder) {
    for (int i = 0; i <= across; ++i) circle(1, part(i));
    for (int i = 1; i < across / 2; ++i)
      for (const int end : {-1, 1}) circle(2.0 * i / across, end);
    out.push_back({0, 0, -1});
    out.push_back({0, 0, 1});
  } else if (shape == InscribedShape::ball && plane) {
    circle(1, 0);
  } else if (shape == InscribedShape::ball) {
    const int rings = around / 2;
    for (int i = 1; i < rings; ++i) circle(std::sin(pi * i / rings), std::cos(pi * i / rings));
    out.push_back({0, 0, -1});
    out.push_back({0, 0, 1});
  } else if (plane) {
    for (int i = 0; i <= 4 * across; ++i) {
      const double along = 0.5 * i / across - 1;
      for (const int end : {-1, 1}) {
        out.push_back({along, static_cast<double>(end), 0});
        out.push_back({static_cast<double>(end), -along, 0});
      }
    }
  } else {
    for (int i = 0; i <= across; ++i)
      for (int j = 0; j <= across; ++j)
        for (const int end : {-1, 1}) {
          const double e = end;
          out.push_back({part(i), part(j), e});
          out.push_back({part(i), e, part(j)});
          out.push_back({e, part(i), part(j)});
        }
  }
  return out;
}

// Candidates of the search: the centre and logarithms of ratios of the half sizes, and the size that scales
// them.
class Search {
 public:
  Search(const WorkspaceMap& map, const NodeSet& set, const InscribedTask& task)
      : map_(map), set_(set), task_(task), plane_(map.axes == 2) {
    const bool box = task.shape == InscribedShape::box;
    const bool free_height = task.shape == InscribedShape::cylinder && task.height == 0 && task.ratio == 0;
    free_ = {!task.axis, !task.axis, !plane_, box, (box && !plane_) || free_height};
  }

  Inscribed run(const GridBody& start, const RunContext& context) {
    Inscribed out;
    Candidate best = candidate(start);
    const auto moves = all_moves();
    // Finer and finer points, with shorter and shorter steps: a body that lies between coarse points comes
    // down, and finds another way up.
    const int finer = plane_ ? 4 : 2;
    int fine = 1;
    for (const auto& [from, to] : {std::array{1.0, 1e-2}, std::array{0.25, 1e-3}, std::array{0.25, 1e-4}}) {
      unit_ = surface(task_.shape, plane_, fine);
      first_ = 0;
      fine *= finer;
      int shrinks = 0;
      while (!fits(best) && ++shrinks < 400) best.size *= 0.98;
      if (shrinks >= 400) {
        out.status = Status::infeasible;
        return out;
      }
      best.size = grown(best, 1e-7);
      for (double scale = from; scale >= to && out.status == Status::done; scale *= 0.5)
        while (improved(best, moves, scale, context, out.status)) {
        }
    }
    out.centre = best.centre;
    out.half = half(best);
    return out;
  }

 private:
  struct Candidate {
    Vec3 centre;
    std::array<double, 2> ratio{1, 1};  // half.y / half.x, half.z / half.x
    double size = 0;                    // half.x
  };

  Candidate candidate(const GridBody& b) const {
    Candidate out{b.centre, {b.half.y / b.half.x, b.half.z / b.half.x}, b.half.x};
    if (task_.axis) out.centre.x = task_.axis->x, out.centre.y = task_.axis->y;
    return out;
  }
  // Tries all moves of a length, and as many again in between: along a ridge, where the body touches at
  // several places, few directions lead up. Continues along each that makes the body larger.
  bool improved(Candidate& best, const std::vector<std::array<double, 5>>& moves, double scale,
                const RunContext& context, Status& status) {
    bool better = false;
    const Candidate before = best;
    const std::size_t between = std::max<std::size_t>(moves.size(), 100);
    for (std::size_t n = 0; n < moves.size() + between; ++n) {
      std::array<double, 5> move = moves[n % moves.size()];
      if (n >= moves.size())
        for (std::size_t k = 0; k < move.size(); ++k) move[k] = free_[k] ? random_.uniform(-1, 1) : 0;
      do {
        if ((status = context.interruption()) != Status::done) return false;
      } while (went(best, move, scale) && (better = true));
    }
    if (!better) return false;
    // The displacement of the whole round leads along the ridge.
    const Vec3 way = (1 / (scale * map_.grid.step)) * (best.centre - before.centre);
    const auto turn = [&](int r) { return std::log(best.ratio[r] / before.ratio[r]) / (0.1 * scale); };
    const std::array<double, 5> whole{way.x, way.y, way.z, turn(0), turn(1)};
    while (went(best, whole, scale)) {
    }
    return true;
  }

  bool went(Candidate& best, const std::array<double, 5>& move, double scale) {
    Candidate next = best;
    next.centre += scale * map_.grid.step * Vec3{move[0], move[1], move[2]};
    for (int r = 0; r < 2; ++r) next.ratio[r] *= std::exp(0.1 * scale * move[3 + r]);
    // The size that makes it better than the best; whether it fits is one look.
    next.size = size_for((1 + 1e-6) * rank(best), next);
    if (!fits(next)) return false;
    next.size = grown(next, 1e-7 + 1e-3 * scale);
    best = next;
    return true;
  }

  Vec3 half(const Candidate& c) const {
    return {c.size, c.ratio[0] * c.size, task_.height > 0 ? 0.5 * task_.height : c.ratio[1] * c.size};
  }
  double rank(const Candidate& c) const { return task_.height > 0 ? c.size : value_of(half(c)); }
  double size_for(double rank, const Candidate& c) const {
    if (task_.height > 0) return rank;
    return plane_ ? std::sqrt(rank / c.ratio[0]) : std::cbrt(rank / (c.ratio[0] * c.ratio[1]));
  }

  // Steps of centre and ratios, each -1, 0 or 1, in all combinations.
  std::vector<std::array<double, 5>> all_moves() const {
    std::vector<std::array<double, 5>> out{{}};
    for (int k = 0; k < 5; ++k) {
      if (!free_[k]) continue;
      const std::size_t count = out.size();
      for (std::size_t n = 0; n < count; ++n)
        for (const int sign : {-1, 1}) {
          out.push_back(out[n]);
          out.back()[k] = sign;
        }
    }
    out.erase(out.begin());  // no move at all
    return out;
  }

  bool fits(const Candidate& c) {
    const Vec3 h = half(c);
    if (!within_grid(c.centre, h)) return false;  // nothing is known there
    constexpr std::size_t block = 256;
    std::array<Vec3, block> place;
    std::array<Criterion, block> criterion;
    // The block in which the last body did not fit is looked at first: there the next one most likely does
    // not fit either.
    const std::size_t blocks = (unit_.size() + block - 1) / block;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t first = (first_ + b) % blocks * block, here = std::min(block, unit_.size() - first);
      for (std::size_t i = 0; i < here; ++i) {
        const Vec3& u = unit_[first + i];
        place[i] = c.centre + Vec3{h.x * u.x, h.y * u.y, h.z * u.z};
      }
      check_poses(task_.conditions, std::span(place).first(here), task_.rotation,
                  {.criterion = std::span(criterion).first(here)});
      for (std::size_t i = 0; i < here; ++i)
        if (criterion[i] != Criterion::none) {
          first_ = first / block;
          return false;
        }
    }
    return holds_nodes_of_the_set(c.centre, h);
  }

  bool holds_nodes_of_the_set(const Vec3& centre, const Vec3& h) const {
    const auto range = [&](double low, double middle, double extent, std::size_t nodes) {
      const double from = std::ceil((middle - extent - low) / map_.grid.step),
                   to = std::floor((middle + extent - low) / map_.grid.step);
      return std::array{std::max(from, 0.0), std::min(to, static_cast<double>(nodes) - 1)};
    };
    const auto& low = map_.grid.low;
    const auto x = range(low.x, centre.x, h.x, map_.nodes[0]), y = range(low.y, centre.y, h.y, map_.nodes[1]),
               z = range(low.z, centre.z, h.z, map_.nodes[2]);
    const auto size = [](double a) { return static_cast<std::size_t>(a); };
    for (double k = z[0]; k <= z[1]; ++k)
      for (double j = y[0]; j <= y[1]; ++j)
        for (double i = x[0]; i <= x[1]; ++i) {
          const std::size_t n = map_.number(size(i), size(j), size(k));
          if (!set_[n] && inside(map_.position(n) - centre, h)) return false;
        }
    return true;
  }
  bool within_grid(const Vec3& centre, const Vec3& h) const {
    const Vec3 &low = map_.grid.low, high = map_.position(map_.count() - 1);
    // An end of the grid may be met up to rounding.
    const double slack = 1e-9 * map_.grid.step;
    const auto within = [&](double from, double to, double middle, double extent) {
      return middle - extent >= from - slack && middle + extent <= to + slack;
    };
    return within(low.x, high.x, centre.x, h.x) && within(low.y, high.y, centre.y, h.y) &&
           within(low.z, high.z, centre.z, h.z);
  }
  bool inside(const Vec3& d, const Vec3& h) const {
    if (task_.shape == InscribedShape::box) return true;  // a box takes the whole range
    const double across = (d.x * d.x + d.y * d.y) / (h.x * h.x);
    if (task_.shape == InscribedShape::cylinder || plane_) return across < 1;
    return across + d.z * d.z / (h.z * h.z) < 1;
  }

  // The largest size near by that fits, from one that does.
  double grown(Candidate c, double tolerance) {
    double inside = c.size, outside = 0;
    for (double factor = 1.001;; factor = std::min(factor * factor, 1.05)) {
      c.size = outside = inside * factor;
      if (!fits(c)) break;
      inside = outside;
    }
    while (outside - inside > tolerance * inside) {
      c.size = 0.5 * (inside + outside);
      (fits(c) ? inside : outside) = c.size;
    }
    return inside;
  }

  const WorkspaceMap& map_;
  const NodeSet& set_;
  const InscribedTask& task_;
  bool plane_;
  std::array<bool, 5> free_{};  // freedoms of the centre and the ratios
  RandomStream random_{StreamKey{}};
  std::vector<Vec3> unit_;  // points on the surface of the body with half sizes 1
  std::size_t first_ = 0;   // block of these that did not pass last time
};

double measure(InscribedShape shape, const Vec3& half) {
  const bool plane = half.z == 0;
  switch (shape) {
    case InscribedShape::cylinder:
      return 2 * pi * value_of(half);
    case InscribedShape::ball:
      return (plane ? pi : 4 * pi / 3) * value_of(half);
    case InscribedShape::box:
      break;
  }
  return (plane ? 4 : 8) * value_of(half);
}

// Makes the body smaller about its centre until it is proven.
void make_proven(const InscribedTask& task, Inscribed& out) {
  // Without a prescribed assembly no such proof is asked for.
  const bool delta = task.conditions.robot.freedom == Freedom::space_translation;
  if (task.conditions.assembly == 0 || (delta && task.conditions.constraint == 0)) return;
  const auto home = trouble_task(task.conditions.robot, {out.centre, task.rotation}, task.conditions.mode,
                                 task.conditions.characteristic_length, task.conditions.least_constraint);
  if (!home) return;
  const auto smaller = [&](double factor) {
    Vec3 half = factor * out.half;
    if (task.height > 0) half.z = out.half.z;  // the height is given
    return half;
  };
  bool settled = true;  // else the proof was given up, and would be for other sizes
  const auto proven = [&](double factor) {
    const BodyProof found = prove(*home, {task.shape, out.centre, smaller(factor)}, task.rotation);
    settled = settled && (found.proven || found.violated);
    return found.proven;
  };
  if ((out.proven = proven(1))) return;
  constexpr int most = 60;
  double fits = 1, beyond = 1;
  for (int k = 0; k < most && settled && !out.proven; ++k) {
    beyond = fits;
    fits *= 0.97;
    out.proven = proven(fits);
  }
  if (!out.proven) return;
  const auto still_proven = [&](double factor) { return settled && proven(factor); };
  out.half = smaller(math::bisect(still_proven, fits, beyond, {.halvings = 12}).inside);
}

}  // namespace

Inscribed inscribed(const WorkspaceMap& map, const NodeSet& set, const InscribedTask& task,
                    const RunContext& context) {
  LINKWRIGHT_REQUIRE(set.size() == map.count(), "a set of {} nodes for a map of {}", set.size(), map.count());
  LINKWRIGHT_REQUIRE(map.nodes[0] > 1 && map.nodes[1] > 1,
                     "a grid of {} x {} x {} nodes: bodies need both x and y", map.nodes[0], map.nodes[1],
                     map.nodes[2]);
  const bool cylinder = task.shape == InscribedShape::cylinder;
  LINKWRIGHT_REQUIRE(!cylinder || map.axes == 3, "a cylinder needs a grid in space");
  LINKWRIGHT_REQUIRE(cylinder || (!task.axis && task.height == 0 && task.ratio == 0),
                     "axis, height and ratio are those of a cylinder");
  LINKWRIGHT_REQUIRE(task.height >= 0 && task.ratio >= 0 && !(task.height > 0 && task.ratio > 0),
                     "height {} m and ratio {}: at most one is given", task.height, task.ratio);
  GridBody start;
  try {
    switch (task.shape) {
      case InscribedShape::cylinder:
        start = cylinder_on_grid(map, set, task, context);
        break;
      case InscribedShape::ball:
        start = ball_on_grid(map, set, context);
        break;
      case InscribedShape::box:
        start = box_on_grid(map, set, context);
        break;
    }
  } catch (const Interrupted& why) {
    return {.status = why.status()};  // no body has been found yet
  }
  if (start.value == 0) return {.status = Status::infeasible};
  Inscribed out = Search(map, set, task).run(start, context);
  if (out.status == Status::done) make_proven(task, out);
  out.on_grid = measure(task.shape, start.half);
  out.measure = out.status == Status::infeasible ? 0 : measure(task.shape, out.half);
  return out;
}

}  // namespace linkwright::parallel
