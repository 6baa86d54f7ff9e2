#include "linkwright/suspension/wheel/tolerances.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

constexpr int most_of_block = 64;      ///< samples of a task of a thread
constexpr int solved_by_block = 2048;  ///< about so many positions, if one sample has fewer
constexpr int round_blocks = 16;       ///< tasks between reports of the progress

std::vector<GuidePosition> solved(const GuidePlan& plan, const ToleranceTask& task) {
  std::vector<GuidePosition> out;
  GuidePosition at = reference_position(plan, task.driver);
  for (const GuideInput& input : task.inputs) {
    out.push_back(at.status == Status::done ? solve_position(plan, task.driver, input, at) : at);
    if (out.back().status == Status::done) at = out.back();
  }
  return out;
}

/// Values of one drawn design from out[0] on, [curve][position]. The nominal positions are near, so that each
/// is found in a few Newton steps.
void draw(const ToleranceTask& task, const MonteCarlo& options, int sample,
          const std::vector<GuidePosition>& nominal, std::span<double> out) {
  RandomStream random({options.seed, 0, 0, static_cast<std::uint32_t>(sample)});
  WheelGuide guide = task.guide;
  for (const auto& [number, tolerance] : task.numbers)
    design_value(guide, number) +=
        tolerance * (options.scatter == Scatter::uniform ? random.uniform(-1, 1) : random.normal() / 3);
  std::fill(out.begin(), out.end(), WheelParameters::missing);
  if (!check(guide).empty()) return;
  const GuidePlan plan = prepare_guide(guide);
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    if (nominal[i].status != Status::done) continue;
    const GuidePosition position = solve_position(plan, task.driver, task.inputs[i], nominal[i]);
    if (position.status != Status::done) continue;
    const WheelParameters parameters = wheel_parameters(plan, position);
    for (std::size_t c = 0; c < task.curves.size(); ++c)
      out[c * nominal.size() + i] = value_of(parameters, task.curves[c]);
  }
}

void summarise(std::span<const double> values, std::size_t stride, std::size_t offset, int samples,
               Band& band) {
  // About the nominal value, which is near: no digits are lost in the squares.
  double sum = 0, square = 0, least = HUGE_VAL, greatest = -HUGE_VAL;
  for (int s = 0; s < samples; ++s) {
    const double value = values[static_cast<std::size_t>(s) * stride + offset];
    if (!std::isfinite(value)) continue;
    ++band.solved;
    sum += value - band.nominal;
    square += (value - band.nominal) * (value - band.nominal);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  if (band.solved == 0) return;
  const double n = band.solved;
  band.mean = band.nominal + sum / n;
  band.least = least;
  band.greatest = greatest;
  if (band.solved > 1) band.standard_deviation = std::sqrt(std::max(0.0, (square - sum * sum / n) / (n - 1)));
}

}  // namespace

ToleranceBands tolerance_bands(const ToleranceTask& task, const MonteCarlo& options, RunContext& context) {
  LINKWRIGHT_REQUIRE(!task.inputs.empty() && !task.curves.empty(), "{} positions, {} curves",
                     task.inputs.size(), task.curves.size());
  LINKWRIGHT_REQUIRE(options.samples >= 0, "{} samples", options.samples);
  std::vector<DesignNumber> numbers;
  for (const auto& [number, tolerance] : task.numbers) {
    LINKWRIGHT_REQUIRE(tolerance >= 0 && std::isfinite(tolerance), "tolerance {} of {}", tolerance,
                       label(task.guide, number));
    numbers.push_back(number);
  }
  const DerivativePlan plan = prepare_derivatives(task.guide, numbers);
  const std::vector<GuidePosition> nominal = solved(plan.plan, task);
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

  const std::size_t stride = curves * positions;
  // Filled as it is needed: to fill the memory of many samples takes seconds.
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(options.samples) * stride);
  const int block = std::clamp(solved_by_block / static_cast<int>(positions), 1, most_of_block);
  while (out.samples < options.samples) {
    const int first = out.samples, end = std::min(options.samples, first + block * round_blocks);
    values.resize(static_cast<std::size_t>(end) * stride);
    std::atomic<Status> stop{Status::done};
    optimise::parallel_for(static_cast<std::size_t>((end - first + block - 1) / block), context.threads(),
                           [&](std::size_t b) {
                             const int from = first + static_cast<int>(b) * block;
                             for (int s = from; s < std::min(end, from + block); ++s) {
                               if (const Status why = context.interruption(); why != Status::done) {
                                 stop = why;
                                 return;
                               }
                               draw(task, options, s, nominal,
                                    std::span(values).subspan(static_cast<std::size_t>(s) * stride, stride));
                             }
                           });
    if (stop != Status::done) {  // a round that was cut short does not count
      out.status = stop;
      break;
    }
    out.samples = end;
    context.report({.stage = "tolerances", .fraction = static_cast<double>(end) / options.samples});
  }
  for (std::size_t c = 0; c < curves; ++c)
    for (std::size_t i = 0; i < positions; ++i)
      if (out.samples > 0) summarise(values, stride, c * positions + i, out.samples, out.bands[c][i]);
  return out;
}

}  // namespace linkwright::suspension
