// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/tolerances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/looks.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/memory_checkpoint.h"

namespace linkwright::suspension {
namespace {

ToleranceTask task_of(const char* name, double tolerance) {
  ToleranceTask task{.suspension = corner_sample(name).suspension};
  for (const DesignNumber& number : hard_points(task.suspension)) task.numbers.push_back({number, tolerance});
  for (double z : {-0.06, 0.01, 0.06}) task.inputs.push_back({z, 0});
  task.curves = {WheelQuantity::toe, WheelQuantity::camber, WheelQuantity::roll_centre_height};
  return task;
}

TEST(Tolerances, OfOneNumberAreItsDerivative) {
  ToleranceTask task = task_of("2RS-US", 0);
  task.numbers = {{{DesignKind::body, 2, 0, 2}, 1e-5}};
  RunContext context;
  const ToleranceBands found = tolerance_bands(task, {}, context);
  ASSERT_EQ(found.status, Status::done);
  for (std::size_t i = 0; i < task.inputs.size(); ++i) {
    const auto toe = [&](double by) {
      Suspension suspension = task.suspension;
      design_value(suspension, task.numbers[0].number) += by;
      const CornerPlan plan = prepare_suspension(suspension);
      return wheel_parameters(
                 plan, solve_position(plan, Driver::wheel_centre_z, task.inputs[i], reference_position(plan)))
          .angles.toe;
    };
    const Band& band = found.bands[0][i];
    EXPECT_NEAR(band.nominal, toe(0), 1e-15);
    // To first order in 1e-5 m; the third order is a millionth of it.
    EXPECT_NEAR(band.shares[0], (toe(1e-5) - toe(-1e-5)) / 2, 1e-6 * band.worst_case + 1e-14);
    EXPECT_EQ(band.worst_case, std::abs(band.shares[0]));
    EXPECT_DOUBLE_EQ(band.root_sum_square, band.worst_case);
    EXPECT_TRUE(std::isnan(band.mean));
  }
}

TEST(Tolerances, AddUpBySizeAndBySquare) {
  RunContext context;
  const ToleranceBands found = tolerance_bands(task_of("5US", 5e-4), {}, context);
  for (const auto& curve : found.bands)
    for (const Band& band : curve) {
      double sum = 0, square = 0;
      for (const double share : band.shares) {
        sum += std::abs(share);
        square += share * share;
      }
      EXPECT_DOUBLE_EQ(band.worst_case, sum);
      EXPECT_DOUBLE_EQ(band.root_sum_square, std::sqrt(square));
      EXPECT_GT(band.worst_case, band.root_sum_square);
    }
}

TEST(Tolerances, SmallOnesScatterAsTheRootSumOfSquaresSays) {
  // The curves are linear for 0.01 mm: the standard deviation of n draws lies within 1 / sqrt(2 n) of its
  // own, relative, the mean within the standard deviation / sqrt(n). Four times that for eighteen figures.
  const int n = 4000;
  for (const Scatter scatter : {Scatter::uniform, Scatter::normal}) {
    RunContext context;
    const ToleranceBands found =
        tolerance_bands(task_of("5US", 1e-5), {.samples = n, .scatter = scatter, .seed = 7}, context);
    EXPECT_EQ(found.samples, n);
    for (const auto& curve : found.bands)
      for (const Band& band : curve) {
        const double sigma = band.root_sum_square / (scatter == Scatter::uniform ? std::sqrt(3) : 3);
        EXPECT_EQ(band.solved, n);
        EXPECT_NEAR(band.standard_deviation, sigma, 4 * sigma / std::sqrt(2.0 * n));
        EXPECT_NEAR(band.mean, band.nominal, 4 * sigma / std::sqrt(n));
        // Second order: a hundredth of a millimetre in lengths of a tenth of a metre.
        if (scatter == Scatter::uniform) {
          EXPECT_LT(band.greatest, band.nominal + 1.001 * band.worst_case);
          EXPECT_GT(band.least, band.nominal - 1.001 * band.worst_case);
        }
        EXPECT_GT(band.greatest, band.nominal + sigma);
        EXPECT_LT(band.least, band.nominal - sigma);
      }
  }
}

TEST(Tolerances, ThreadsDoNotMatter) {
  const ToleranceTask task = task_of("2RS-US", 1e-3);
  std::vector<ToleranceBands> found;
  for (const int threads : {1, 3}) {
    RunContext context;
    context.set_threads(threads);
    found.push_back(tolerance_bands(task, {.samples = 300, .seed = 3}, context));
  }
  for (std::size_t c = 0; c < task.curves.size(); ++c)
    for (std::size_t i = 0; i < task.inputs.size(); ++i) {
      EXPECT_EQ(found[0].bands[c][i].mean, found[1].bands[c][i].mean);
      EXPECT_EQ(found[0].bands[c][i].standard_deviation, found[1].bands[c][i].standard_deviation);
      EXPECT_EQ(found[0].bands[c][i].greatest, found[1].bands[c][i].greatest);
    }
}

TEST(Tolerances, KeepToWhatIsThere) {
  ToleranceTask task = task_of("5US", 1e-4);
  task.inputs.push_back({0.5, 0});
  RunContext context;
  const ToleranceBands found = tolerance_bands(task, {.samples = 10}, context);
  EXPECT_EQ(found.status, Status::no_assembly);
  EXPECT_TRUE(std::isfinite(found.bands[0][2].worst_case));
  EXPECT_TRUE(std::isnan(found.bands[0][3].worst_case));
  EXPECT_EQ(found.bands[0][3].solved, 0);
  RunContext stopped;
  stopped.cancel();
  const ToleranceBands none = tolerance_bands(task_of("5US", 1e-4), {.samples = 10}, stopped);
  EXPECT_EQ(none.status, Status::cancelled);
  EXPECT_EQ(none.samples, 0);
  EXPECT_TRUE(std::isfinite(none.bands[0][0].worst_case));
}

// Draws of a piece that is cut short are not used; the pieces before it are kept, and the run that goes on
// from them ends with the bits of one that was not interrupted.
TEST(Tolerances, InterruptedKeepThePiecesSoFar) {
  const ToleranceTask task = task_of("5US", 1e-4);
  const MonteCarlo options{.samples = 3000, .seed = 5};
  RunContext free_run;
  const ToleranceBands whole = tolerance_bands(task, options, free_run);
  ASSERT_EQ(whole.samples, 3000);
  test::MemoryCheckpoint kept;
  RunContext context;
  context.set_threads(1);
  context.set_checkpoint(&kept);
  {
    const LooksAllowed looks(1500);  // one before each design and each piece but the first
    const ToleranceBands part = tolerance_bands(task, options, context);
    EXPECT_EQ(part.status, Status::cancelled);
    EXPECT_EQ(part.samples, 23 * 64) << "of pieces of 64";
    EXPECT_EQ(kept.entries.size(), 23u);
    EXPECT_NEAR(part.bands[0][0].mean, whole.bands[0][0].mean, 3 * whole.bands[0][0].standard_deviation / 38);
  }
  const ToleranceBands found = tolerance_bands(task, options, context);
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.samples, 3000);
  for (std::size_t c = 0; c < task.curves.size(); ++c)
    for (std::size_t i = 0; i < task.inputs.size(); ++i) {
      EXPECT_EQ(found.bands[c][i].mean, whole.bands[c][i].mean);
      EXPECT_EQ(found.bands[c][i].standard_deviation, whole.bands[c][i].standard_deviation);
      EXPECT_EQ(found.bands[c][i].least, whole.bands[c][i].least);
      EXPECT_EQ(found.bands[c][i].greatest, whole.bands[c][i].greatest);
      EXPECT_EQ(found.bands[c][i].solved, whole.bands[c][i].solved);
    }
  kept.entries["designs 2"] = Value(3);
  EXPECT_THROW(tolerance_bands(task, options, context), CheckpointError);
}

TEST(Tolerances, ContractsAreChecked) {
  RunContext context;
  ToleranceTask task = task_of("5US", -1e-4);
  EXPECT_THAT([&] { tolerance_bands(task, {}, context); },
              ::testing::ThrowsMessage<ContractError>(
                  ::testing::HasSubstr("tolerance -0.0001 of lower front rod.body_x")));
  task = task_of("5US", 1e-4);
  task.curves.clear();
  EXPECT_THAT([&] { tolerance_bands(task, {}, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("3 positions, 0 curves")));
}

}  // namespace
}  // namespace linkwright::suspension
