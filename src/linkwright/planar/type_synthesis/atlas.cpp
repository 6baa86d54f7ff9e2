// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/atlas.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"

namespace linkwright::planar {
namespace {

constexpr std::uint64_t atlas_seed = 20260617, rocking_seed = 20261129;
constexpr double least_part = 20 * pi / 180, most_part = 320 * pi / 180;  // of a turn of a drive that rocks
constexpr std::size_t drawn_a_piece = 4000, most_in_a_cell = 6;
constexpr std::size_t turn = 64;        // crank angles of a curve
constexpr std::size_t arc_points = 64;  // of which harmonics are taken
constexpr double bin = 0.045;
constexpr int half = curve_harmonics / 2;
using Descriptor = std::array<std::complex<double>, curve_harmonics>;
using Cell = std::array<std::int16_t, 6>;

/// Order of a harmonic: 0 ... 7 are -8 ... -1, 8 ... 15 are 1 ... 8.
constexpr int order_of(std::size_t i) {
  return static_cast<int>(i) < half ? static_cast<int>(i) - half : static_cast<int>(i) - half + 1;
}
constexpr std::size_t opposite(std::size_t i) { return curve_harmonics - 1 - i; }

/// Harmonics of points at equal steps of a closed curve, of which all squares add up to 1.
Descriptor descriptor_of(std::span<const std::complex<double>> points) {
  static const auto roots = [] {
    std::array<std::complex<double>, arc_points> out;
    for (std::size_t k = 0; k < arc_points; ++k)
      out[k] = std::polar(1.0, -2 * pi * static_cast<double>(k) / arc_points);
    return out;
  }();
  const std::complex<double> mean =
      std::accumulate(points.begin(), points.end(), std::complex<double>{}) / static_cast<double>(arc_points);
  double squares = 0;
  for (const auto& p : points) squares += std::norm(p - mean);
  const double by = squares > 0 ? 1 / std::sqrt(squares * arc_points) : 0;
  Descriptor out;
  for (std::size_t i = 0; i < curve_harmonics; ++i) {
    const auto step =
        static_cast<std::size_t>((order_of(i) + static_cast<int>(arc_points)) % static_cast<int>(arc_points));
    double re = 0, im = 0;
    for (std::size_t k = 0, at = 0; k < arc_points; ++k, at = (at + step) % arc_points) {
      const std::complex<double> p = points[k] - mean;
      re += p.real() * roots[at].real() - p.imag() * roots[at].imag();
      im += p.real() * roots[at].imag() + p.imag() * roots[at].real();
    }
    out[i] = {re * by, im * by};
  }
  return out;
}

/// Curves that look alike share a cell, mirror images and both senses among them.
Cell cell_of(const FamilyAtlas::Entry& e) {
  Cell one{}, other{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto up = static_cast<std::size_t>(half) + k, down = opposite(up);
    one[2 * k] = other[2 * k + 1] = static_cast<std::int16_t>(e.magnitude[up] / static_cast<float>(bin));
    one[2 * k + 1] = other[2 * k] = static_cast<std::int16_t>(e.magnitude[down] / static_cast<float>(bin));
  }
  return std::min(one, other);
}

/// Fills what an entry tells of its curve, over the turn or a part of it; false where that is none.
bool describe(const MachineShape& shape, std::optional<CrankPart> part, FamilyAtlas::Entry& e) {
  alignas(64) std::array<double, turn> angle, x, y;
  for (std::size_t k = 0; k < turn; ++k)
    angle[k] = part ? part->from + part->range * static_cast<double>(k) / (turn - 1)
                    : 2 * pi * static_cast<double>(k) / turn;
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = angle.data(),
                 .count = turn,
                 .px = x.data(),
                 .py = y.data()});
  std::array<std::complex<double>, turn> curve;
  double extent = 0;
  for (std::size_t k = 0; k < turn; ++k)
    curve[k] = {x[k], y[k]}, extent = std::max(extent, std::abs(curve[k] - curve[0]));
  if (!(extent > 1e-3) || !std::isfinite(extent)) return false;
  const auto points = equal_steps(curve, !part, arc_points);
  const Descriptor d = descriptor_of(points);
  for (std::size_t i = 0; i < curve_harmonics; ++i) {
    e.magnitude[i] = static_cast<float>(std::abs(d[i]));
    e.real[i] = static_cast<float>(d[i].real()), e.imaginary[i] = static_cast<float>(d[i].imag());
  }
  const std::complex<double> mean =
      std::accumulate(points.begin(), points.end(), std::complex<double>{}) / static_cast<double>(arc_points);
  double largest = 0;
  for (const auto& p : points)
    largest = std::max({largest, std::abs((p - mean).real()), std::abs((p - mean).imag())});
  const double by = std::numeric_limits<std::int16_t>::max() / largest;
  for (std::size_t k = 0; k < 32; ++k) {
    const std::complex<double> p = by * (points[2 * k] - mean);
    e.points[0][k] = static_cast<std::int16_t>(std::lround(p.real())),
    e.points[1][k] = static_cast<std::int16_t>(std::lround(p.imag()));
  }
  e.program = shape.program, e.signs = shape.signs;
  if (part) e.from = static_cast<float>(part->from), e.range = static_cast<float>(part->range);
  std::transform(shape.x.begin(), shape.x.end() - 4, e.x.begin(),
                 [](double v) { return static_cast<float>(v); });
  return true;
}

std::size_t pieces_of(MachineFamily family) {
  switch (family) {
    case MachineFamily::four_bar:
    case MachineFamily::slider_crank:
    case MachineFamily::inverted_slider:
      return 5;
    case MachineFamily::geared_five_bar:
      return 6;
    case MachineFamily::watt_1:
    case MachineFamily::stephenson_1:
    case MachineFamily::stephenson_2:
    case MachineFamily::stephenson_3:
      return 10;
    case MachineFamily::eight_bar:
      return 24;
    case MachineFamily::ten_bar:
    case MachineFamily::watt_2:
      return 0;
  }
  return 0;
}

/// A part of the turn. A group of four links is followed from crank angle zero, which is in it.
CrankPart drawn_part(const PointProgram& program, RandomStream& random) {
  CrankPart out{.range = random.uniform(least_part, most_part), .rocks = true};
  out.from = program.group < 0 ? random.uniform(0, 2 * pi) : -out.range * random.uniform();
  // As an entry keeps it.
  out.from = static_cast<float>(out.from), out.range = static_cast<float>(out.range);
  return out;
}

std::shared_ptr<const FamilyAtlas> make_atlas(MachineFamily family, bool rocks, const RunContext& context) {
  const std::span<const PointProgram* const> programs = programs_of(family);
  const std::size_t pieces = pieces_of(family);
  std::vector<std::vector<FamilyAtlas::Entry>> found(pieces);
  optimise::parallel_for(pieces, context.threads(), [&](std::size_t piece) {
    std::map<Cell, std::size_t> cells;
    for (std::size_t k = 0; k < drawn_a_piece; ++k) {
      if (k % 64 == 0 && context.interrupted()) return;
      RandomStream random({.seed = rocks ? rocking_seed : atlas_seed,
                           .run = static_cast<std::uint32_t>(family),
                           .generation = static_cast<std::uint32_t>(piece),
                           .individual = static_cast<std::uint32_t>(k)});
      MachineShape shape{.program = programs[(piece * drawn_a_piece + k) % programs.size()]};
      FamilyAtlas::Entry e;
      const std::optional<CrankPart> part =
          rocks ? std::optional(drawn_part(*shape.program, random)) : std::nullopt;
      if (!draw_shape(shape, 0, random, part) || !describe(shape, part, e)) continue;
      if (++cells[cell_of(e)] <= most_in_a_cell) found[piece].push_back(e);
    }
  });
  if (context.interrupted()) return nullptr;
  auto out = std::make_shared<FamilyAtlas>();
  std::map<Cell, std::size_t> cells;
  for (const auto& piece : found)
    for (const FamilyAtlas::Entry& e : piece)
      if (++cells[cell_of(e)] <= most_in_a_cell) out->entries.push_back(e);
  out->drawn = static_cast<std::int64_t>(pieces * drawn_a_piece);
  return out;
}

/// Best correlation of a curve, given by its harmonics, with a stroke over all starts; exact on 64 starts.
double best_overlap(const Descriptor& stroke, const Descriptor& curve) {
  std::array<double, arc_points> re{}, im{};
  static const auto roots = [] {
    std::array<std::array<std::array<double, arc_points>, 2>, curve_harmonics> out;
    for (std::size_t i = 0; i < curve_harmonics; ++i)
      for (std::size_t k = 0; k < arc_points; ++k) {
        const double a = 2 * pi * order_of(i) * static_cast<double>(k) / arc_points;
        out[i][0][k] = std::cos(a), out[i][1][k] = std::sin(a);
      }
    return out;
  }();
  for (std::size_t i = 0; i < curve_harmonics; ++i) {
    const std::complex<double> c = std::conj(stroke[i]) * curve[i];
    for (std::size_t k = 0; k < arc_points; ++k) {
      re[k] += c.real() * roots[i][0][k] - c.imag() * roots[i][1][k];
      im[k] += c.real() * roots[i][1][k] + c.imag() * roots[i][0][k];
    }
  }
  double best = 0;
  for (std::size_t k = 0; k < arc_points; ++k) best = std::max(best, re[k] * re[k] + im[k] * im[k]);
  return best;
}

AtlasMatch match_closed(const FamilyAtlas::Entry& e, const Descriptor& stroke) {
  AtlasMatch out;
  for (const bool mirror : {false, true})
    for (const bool reverse : {false, true}) {
      Descriptor d;
      for (std::size_t i = 0; i < curve_harmonics; ++i) {
        // Reversal takes z_h to z_-h, a mirror to conj(z_-h).
        const std::size_t from = reverse != mirror ? opposite(i) : i;
        d[i] = {e.real[from], mirror ? -e.imaginary[from] : e.imaginary[from]};
      }
      if (const double score = 1 - best_overlap(stroke, d); score < out.score)
        out.score = score, out.mirrored = mirror;
    }
  return out;
}

std::vector<AtlasMatch> closed_matches(const FamilyAtlas& atlas, const SampledStroke& target,
                                       std::size_t count, const RunContext& context) {
  std::vector<std::complex<double>> points;
  for (std::size_t k = 0; k < stroke_samples; ++k) points.emplace_back(target.x[k], target.y[k]);
  const Descriptor stroke = descriptor_of(equal_steps(points, true, arc_points));
  std::array<float, curve_harmonics> magnitude;
  for (std::size_t i = 0; i < curve_harmonics; ++i) magnitude[i] = static_cast<float>(std::abs(stroke[i]));
  // The overlap of all starts, senses and mirror images is at most the larger of two sums of products of
  // magnitudes.
  std::vector<std::pair<float, std::size_t>> bound(atlas.entries.size());
  for (std::size_t k = 0; k < bound.size(); ++k) {
    float along = 0, across = 0;
    for (std::size_t i = 0; i < curve_harmonics; ++i) {
      along += magnitude[i] * atlas.entries[k].magnitude[i];
      across += magnitude[i] * atlas.entries[k].magnitude[opposite(i)];
    }
    const float most = std::max(along, across);
    bound[k] = {1 - most * most, k};
  }
  std::sort(bound.begin(), bound.end());
  constexpr std::size_t together = 256;
  std::vector<AtlasMatch> best;
  for (std::size_t begin = 0; begin < bound.size() && !context.interrupted(); begin += together) {
    if (best.size() == count && bound[begin].first > best.back().score) break;
    const std::size_t n = std::min(together, bound.size() - begin);
    std::vector<AtlasMatch> found(n);
    optimise::parallel_for(n / 64 + 1, context.threads(), [&](std::size_t part) {
      for (std::size_t i = 64 * part; i < std::min(64 * part + 64, n); ++i) {
        found[i] = match_closed(atlas.entries[bound[begin + i].second], stroke);
        found[i].entry = bound[begin + i].second;
      }
    });
    best.insert(best.end(), found.begin(), found.end());
    std::sort(best.begin(), best.end(), [](const AtlasMatch& a, const AtlasMatch& b) {
      return std::pair(a.score, a.entry) < std::pair(b.score, b.entry);
    });
    if (best.size() > count) best.resize(count);
  }
  return best;
}

/// Parts of curves against an open stroke, coarsely: eight points, 32 starts, eight widths, both senses and
/// mirror images. A curve that is open itself has parts within its ends, and is one.
class OpenMatcher {
 public:
  explicit OpenMatcher(const SampledStroke& target) {
    float squares = 0, mx = 0, my = 0;
    for (std::size_t k = 0; k < few; ++k) {
      const std::size_t from = (k * (stroke_samples - 1) + (few - 1) / 2) / (few - 1);
      x_[k] = static_cast<float>(target.x[from]), y_[k] = static_cast<float>(target.y[from]);
      mx += x_[k] / few, my += y_[k] / few;
    }
    for (std::size_t k = 0; k < few; ++k) x_[k] -= mx, y_[k] -= my, squares += x_[k] * x_[k] + y_[k] * y_[k];
    by_target_ = 1 / squares;
  }

  AtlasMatch match(const FamilyAtlas::Entry& e) const {
    std::array<float, 2 * starts> cx, cy;
    for (std::size_t k = 0; k < starts; ++k) {
      cx[k] = cx[k + starts] = static_cast<float>(e.points[0][k]) / 32767.0F;
      cy[k] = cy[k + starts] = static_cast<float>(e.points[1][k]) / 32767.0F;
    }
    AtlasMatch out;
    const bool open = e.range != 0;
    for (const float width : {0.18F, 0.26F, 0.35F, 0.45F, 0.56F, 0.68F, 0.80F, 0.93F, 1.0F}) {
      if (width == 1 && !open) continue;
      const float steps = open ? starts - 1 : starts;
      // Sums over the points for all starts at once: the stroke along and against the curve, and the part's
      // own.
      std::array<float, starts> are{}, aim{}, bre{}, bim{}, cre{}, cim{}, dre{}, dim{}, mx{}, my{}, squares{};
      for (std::size_t k = 0; k < few; ++k) {
        const auto shift =
            static_cast<std::size_t>(std::lround(width * steps * static_cast<float>(k) / (few - 1)));
        const float tx = x_[k], ty = y_[k], rx = x_[few - 1 - k], ry = y_[few - 1 - k];
        for (std::size_t s = 0; s < starts; ++s) {
          const float vx = cx[s + shift], vy = cy[s + shift];
          are[s] += vx * tx + vy * ty, aim[s] += vx * ty - vy * tx;
          bre[s] += vx * tx - vy * ty, bim[s] += vx * ty + vy * tx;
          cre[s] += vx * rx + vy * ry, cim[s] += vx * ry - vy * rx;
          dre[s] += vx * rx - vy * ry, dim[s] += vx * ry + vy * rx;
          mx[s] += vx, my[s] += vy, squares[s] += vx * vx + vy * vy;
        }
      }
      const std::size_t last =
          open ? starts - static_cast<std::size_t>(std::lround(width * steps)) : std::size_t{starts};
      for (std::size_t s = 0; s < last; ++s) {
        const float own = squares[s] - (mx[s] * mx[s] + my[s] * my[s]) / few;
        const float direct = std::max(are[s] * are[s] + aim[s] * aim[s], cre[s] * cre[s] + cim[s] * cim[s]);
        const float mirror = std::max(bre[s] * bre[s] + bim[s] * bim[s], dre[s] * dre[s] + dim[s] * dim[s]);
        const float score = 1 - std::max(direct, mirror) * by_target_ / std::max(own, 1e-6F);
        if (score < static_cast<float>(out.score)) out.score = score, out.mirrored = mirror > direct;
      }
    }
    return out;
  }

 private:
  static constexpr std::size_t few = 8, starts = 32;
  std::array<float, few> x_, y_;
  float by_target_ = 1;
};

/// The atlases of all families, each made once.
class AtlasShelf {
 public:
  template <class Make>
  std::shared_ptr<const FamilyAtlas> take(MachineFamily family, const Make& make) {
    Kept& kept = all_[static_cast<std::size_t>(family)];
    const std::lock_guard lock(kept.mutex);
    if (!kept.atlas) kept.atlas = make();
    return kept.atlas;
  }

 private:
  struct Kept {
    std::mutex mutex;
    std::shared_ptr<const FamilyAtlas> atlas;
  };
  std::array<Kept, names(MachineFamily{}).size()> all_;
};

}  // namespace

MachineShape FamilyAtlas::shape(std::size_t i) const {
  const Entry& e = entries[i];
  MachineShape out{.program = e.program,
                   .signs = e.signs,
                   .x = std::vector<double>(static_cast<std::size_t>(e.program->parameters))};
  std::copy_n(e.x.begin(), out.x.size() - 4, out.x.begin());
  out.x[out.x.size() - 2] = 1;
  return out;
}

std::optional<CrankPart> FamilyAtlas::part(std::size_t i) const {
  const Entry& e = entries[i];
  if (e.range == 0) return std::nullopt;
  return CrankPart{.from = e.from, .range = e.range, .rocks = true};
}

std::shared_ptr<const FamilyAtlas> family_atlas(MachineFamily family, const RunContext& context) {
  static AtlasShelf shelf;
  return shelf.take(family, [&] { return make_atlas(family, false, context); });
}

std::shared_ptr<const FamilyAtlas> rocking_atlas(MachineFamily family, const RunContext& context) {
  static AtlasShelf shelf;
  return shelf.take(family, [&] { return make_atlas(family, true, context); });
}

std::vector<AtlasMatch> match_atlas(const FamilyAtlas& atlas, const SampledStroke& target, std::size_t count,
                                    const RunContext& context) {
  if (target.closed) return closed_matches(atlas, target, count, context);
  const OpenMatcher matcher(target);
  std::vector<AtlasMatch> all(atlas.entries.size());
  constexpr std::size_t together = 512;
  optimise::parallel_for((all.size() + together - 1) / together, context.threads(), [&](std::size_t part) {
    if (context.interrupted()) return;
    for (std::size_t i = part * together; i < std::min(part * together + together, all.size()); ++i) {
      all[i] = matcher.match(atlas.entries[i]);
      all[i].entry = i;
    }
  });
  std::sort(all.begin(), all.end(), [](const AtlasMatch& a, const AtlasMatch& b) {
    return std::pair(a.score, a.entry) < std::pair(b.score, b.entry);
  });
  if (all.size() > count) all.resize(count);
  return all;
}

}  // namespace linkwright::planar
