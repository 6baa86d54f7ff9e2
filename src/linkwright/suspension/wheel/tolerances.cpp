// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/tolerances.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/pieces.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

// Designs are drawn in pieces of at most this many, unless there would be too many of them: each holds its
// sums.
constexpr int max_of_piece = 64;
constexpr int solved_by_piece = 2048;  ///< about so many positions, if one design has fewer
constexpr double max_pieces = 1024, max_bytes = 1e8;

std::vector<CornerPosition> solved(const CornerPlan& plan, const ToleranceTask& task) {
  std::vector<CornerPosition> out;
  CornerPosition at = reference_position(plan, task.driver);
  for (const CornerInput& input : task.inputs) {
    out.push_back(at.status == Status::done ? solve_position(plan, task.driver, input, at) : at);
    if (out.back().status == Status::done) at = out.back();
  }
  return out;
}

/// Values of one drawn design from out[0] on, [curve][position]. The nominal positions are near, so that each
/// is found in a few Newton steps.
void draw(const ToleranceTask& task, const MonteCarlo& options, int sample,
          const std::vector<CornerPosition>& nominal, std::span<double> out) {
  RandomStream random({options.seed, 0, 0, static_cast<std::uint32_t>(sample)});
  Suspension suspension = task.suspension;
  for (const auto& [number, tolerance] : task.numbers)
    design_value(suspension, number) +=
        tolerance * (options.scatter == Scatter::uniform ? random.uniform(-1, 1) : random.normal() / 3);
  std::fill(out.begin(), out.end(), WheelParameters::missing);
  if (!check(suspension).empty()) return;
  const CornerPlan plan = prepare_suspension(suspension);
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    if (nominal[i].status != Status::done) continue;
    const CornerPosition position = solve_position(plan, task.driver, task.inputs[i], nominal[i]);
    if (position.status != Status::done) continue;
    const WheelParameters parameters = wheel_parameters(plan, position);
    for (std::size_t c = 0; c < task.curves.size(); ++c)
      out[c * nominal.size() + i] = value_of(parameters, task.curves[c]);
  }
}

/// The sums over all designs of one value, taken about the nominal value, which is near: no digits are lost
/// in the squares.
struct Sums {
  double solved = 0, sum = 0, square = 0, least = HUGE_VAL, greatest = -HUGE_VAL;

  void add(double value, double nominal) {
    if (!std::isfinite(value)) return;
    ++solved;
    sum += value - nominal;
    square += (value - nominal) * (value - nominal);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  void add(const Sums& other) {
    solved += other.solved;
    sum += other.sum;
    square += other.square;
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};
constexpr std::size_t numbers_of_sums = 5;

void summarise(const Sums& of, Band& band) {
  band.solved = static_cast<int>(of.solved);
  if (band.solved == 0) return;
  const double n = of.solved;
  band.mean = band.nominal + of.sum / n;
  band.least = of.least;
  band.greatest = of.greatest;
  if (band.solved > 1)
    band.standard_deviation = std::sqrt(std::max(0.0, (of.square - of.sum * of.sum / n) / (n - 1)));
}

/// The sums of the samples of one piece, of [curve][position].
struct Piece {
  std::vector<Sums> sums;
  int samples = 0;  ///< 0 if it was interrupted

  Value kept() const {
    if (samples == 0) return {};
    std::vector<double> numbers;
    for (const Sums& s : sums)
      numbers.insert(numbers.end(), {s.solved, s.sum, s.square, s.least, s.greatest});
    return pack_numbers(numbers);
  }
  void restore(const Value& value, std::string_view what, int size) {
    const std::vector<double> numbers = unpack_numbers(value, what);
    if (numbers.size() != numbers_of_sums * sums.size())
      throw CheckpointError(fmt::format("{}: holds {} numbers, must be {}", what, numbers.size(),
                                        numbers_of_sums * sums.size()));
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double* n = &numbers[numbers_of_sums * i];
      if (!(n[0] >= 0 && n[0] <= size && std::isfinite(n[1]) && n[2] >= 0))
        throw CheckpointError(fmt::format("{}: sums of designs that cannot be", what));
      sums[i] = {n[0], n[1], n[2], n[3], n[4]};
    }
    samples = size;
  }
};

}  // namespace

ToleranceBands tolerance_bands(const ToleranceTask& task, const MonteCarlo& options, RunContext& context) {
  LINKWRIGHT_REQUIRE(!task.inputs.empty() && !task.curves.empty(), "{} positions, {} curves",
                     task.inputs.size(), task.curves.size());
  LINKWRIGHT_REQUIRE(options.samples >= 0, "{} samples", options.samples);
  std::vector<DesignNumber> numbers;
  for (const auto& [number, tolerance] : task.numbers) {
    LINKWRIGHT_REQUIRE(tolerance >= 0 && std::isfinite(tolerance), "tolerance {} of {}", tolerance,
                       label(task.suspension, number));
    numbers.push_back(number);
  }
  const DerivativePlan plan = prepare_derivatives(task.suspension, numbers);
  const std::vector<CornerPosition> nominal = solved(plan.plan, task);
  const std::size_t positions = nominal.size(), curves = task.curves.size();

  ToleranceBands out;
  out.bands.assign(curves, std::vector<Band>(positions));
  for (std::size_t i = 0; i < positions; ++i) {
    const bool there = nominal[i].status == Status::done;
    WheelDerivatives exact;
    if (there) exact = wheel_derivatives(plan, nominal[i]);
    if (!there || exact.status != Status::done) out.status = there ? exact.status : nominal[i].status;
    for (std::size_t c = 0; c < curves; ++c) {
      Band& band = out.bands[c][i];
      band.nominal = there ? value_of(exact.parameters, task.curves[c]) : WheelParameters::missing;
      band.mean = band.standard_deviation = band.least = band.greatest = WheelParameters::missing;
      if (!there) {
        band.worst_case = band.root_sum_square = WheelParameters::missing;
        band.shares.assign(numbers.size(), WheelParameters::missing);
        continue;
      }
      double squares = 0;
      for (std::size_t j = 0; j < numbers.size(); ++j) {
        const double share = value_of(exact.by[j], task.curves[c]) * task.numbers[j].tolerance;
        band.shares.push_back(share);
        band.worst_case += std::abs(share);
        squares += share * share;
      }
      band.root_sum_square = std::sqrt(squares);
    }
  }

  if (options.samples == 0) return out;
  const std::size_t stride = curves * positions;
  const int most =
      static_cast<int>(std::clamp(max_bytes / static_cast<double>(sizeof(Sums) * stride), 8.0, max_pieces));
  const int size = std::max(std::clamp(solved_by_piece / static_cast<int>(positions), 1, max_of_piece),
                            (options.samples + most - 1) / most);
  const auto count = static_cast<std::size_t>((options.samples + size - 1) / size);
  const auto samples_of = [&](std::size_t k) {
    return std::min(size, options.samples - static_cast<int>(k) * size);
  };
  std::vector<Piece> pieces(count);
  const auto name = [](std::size_t k) { return fmt::format("designs {}", k + 1); };
  const optimise::PieceLoop loop = optimise::for_each_piece(
      count, context, "tolerances", name,
      [&](std::size_t k) {
        Piece& piece = pieces[k];
        piece.sums.resize(stride);
        std::vector<double> values(stride);
        for (int s = 0; s < samples_of(k); ++s) {
          if (context.interrupted()) return infinity;
          draw(task, options, static_cast<int>(k) * size + s, nominal, values);
          for (std::size_t c = 0; c < curves; ++c)
            for (std::size_t i = 0; i < positions; ++i)
              piece.sums[c * positions + i].add(values[c * positions + i], out.bands[c][i].nominal);
        }
        piece.samples = samples_of(k);
        return infinity;
      },
      [&](std::size_t k) { return pieces[k].kept(); },
      [&](std::size_t k, const Value& value) {
        pieces[k].sums.resize(stride);
        pieces[k].restore(value, name(k), samples_of(k));
        return infinity;
      });
  // Pieces that were cut short do not count.
  for (const Piece& piece : pieces) out.samples += piece.samples;
  if (out.samples < options.samples) out.status = loop.status;
  if (out.samples == 0) return out;
  for (std::size_t c = 0; c < curves; ++c)
    for (std::size_t i = 0; i < positions; ++i) {
      Sums all;
      for (const Piece& piece : pieces)
        if (piece.samples > 0) all.add(piece.sums[c * positions + i]);
      summarise(all, out.bands[c][i]);
    }
  return out;
}

}  // namespace linkwright::suspension
