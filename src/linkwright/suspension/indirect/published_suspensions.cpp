// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/published_suspensions.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

constexpr PublishedPosition example_1[] = {
    // Tab. 6-1
    {-0.2, 0, 0.00286, 0.68267, -6.68868, -1.65205, 0.16808},
    {-0.15, 0, 0.00573, 0.72351, -2.28735, 0.26875, 1.21942},
    {-0.1, 0, 0.00457, 0.74807, -1.03087, 0.47833, 1.02304},
    {-0.05, 0, 0.00249, 0.76231, -0.41431, 0.09084, 0.57018},
    {0, 0, 0, 0.768, 0, -0.7, 0},
    {0.05, 0, -0.0027, 0.76572, 0.39064, -1.88428, -0.63814},
    {0.1, 0, -0.0055, 0.75532, 0.88664, -3.55989, -1.3071},
    {0.15, 0, -0.00828, 0.73589, 1.65289, -5.97141, -1.94319},
    {0.2, 0, -0.01079, 0.70505, 3.02181, -9.69996, -2.36504},
    {0, -0.075, -0.01876, 0.7702, -23.45925, 2.51056, -2.65058},
    {0, -0.05, -0.01135, 0.77064, -14.94174, 1.24749, -1.61232},
    {0, -0.025, -0.00523, 0.76983, -7.26331, 0.23075, -0.75295},
    {0, 0.025, 0.00453, 0.7652, 7.10769, -1.64021, 0.71668},
    {0, 0.05, 0.00847, 0.7614, 14.26762, -2.65437, 1.47738},
    {0, 0.075, 0.01188, 0.75644, 21.69163, -3.78659, 2.38455},
};
constexpr PublishedPosition example_2[] = {
    // Tab. 6-5
    {-0.1, 0, 0.00052, 0.77239, -0.2617, 3.86103, 0.73284},
    {-0.05, 0, 0.00053, 0.78309, -0.15502, 2.0377, 0.41289},
    {0, 0, 0, 0.787, -0.26, 0.69, 0},
    {0.05, 0, -0.00076, 0.78443, -0.48079, -0.09407, -0.54445},
    {0.1, 0, -0.00152, 0.77519, -0.73197, -0.09735, -1.27209},
    {-0.025, 0.03, -0.01796, 0.78543, -13.18805, 3.40746, -2.60349},
    {0.025, 0.03, -0.01805, 0.78572, -12.98695, 2.51997, -3.32029},
    {-0.025, -0.03, 0.0168, 0.77988, 11.96576, 0.23702, 3.14642},
    {0.025, -0.03, 0.01553, 0.78098, 11.46179, -0.94909, 2.93294},
    {-0.075, 0.06, -0.03994, 0.76879, -29.21545, 8.08066, -3.90131},
    {0.075, 0.06, -0.03866, 0.76854, -27.19489, 6.62681, -6.6417},
    {-0.075, -0.06, 0.03363, 0.7603, 24.61019, 1.62397, 5.62808},
    {0.075, -0.06, 0.02841, 0.76531, 22.1646, -1.90516, 5.68552},
    {0, 0.09, -0.06618, 0.74511, -50.65332, 13.45535, -6.4223},
    {0, -0.09, 0.04559, 0.75176, 36.63099, -0.05422, 9.08452},
};
constexpr PublishedPosition example_3[] = {
    // Tab. 6-9
    {-0.1, 0, 0.02289, 0.7648, -1.1898, 3.04616, -6.12819},
    {-0.08, 0, 0.01576, 0.77063, -0.68124, 2.51092, -5.08648},
    {-0.06, 0, 0.01005, 0.77495, -0.33368, 1.94463, -3.93761},
    {-0.04, 0, 0.00558, 0.77789, -0.11707, 1.34334, -2.70072},
    {-0.02, 0, 0.00225, 0.77956, -0.0109, 0.69877, -1.38635},
    {0, 0, 0, 0.78, 0, 0, 0},
    {0.02, 0, -0.00123, 0.77924, -0.07233, -0.76613, 1.45616},
    {0.04, 0, -0.00144, 0.77727, -0.21755, -1.61504, 2.98242},
    {0.06, 0, -0.00065, 0.77408, -0.42602, -2.56492, 4.58125},
    {0.08, 0, 0.00116, 0.76962, -0.68799, -3.63745, 6.2573},
    {0.1, 0, 0.00405, 0.76381, -0.99274, -4.85909, 8.01788},
};
constexpr PublishedPosition example_4[] = {
    // Tab. 6-13
    {-0.15, 0, 0.03287, -0.04604, -0.2393, -0.21556, not_printed},
    {-0.125, 0, 0.02591, -0.03232, -0.17909, -0.01385, not_printed},
    {-0.1, 0, 0.01965, -0.02142, -0.119, 0.00291, not_printed},
    {-0.075, 0, 0.01399, -0.01296, -0.06998, -0.12678, not_printed},
    {-0.05, 0, 0.00886, -0.00668, -0.03469, -0.38336, not_printed},
    {-0.025, 0, 0.00421, -0.0024, -0.01222, -0.75824, not_printed},
    {0, 0, 0, 0, 0, -1.25, not_printed},
    {0.025, 0, -0.00378, 0.0006, 0.00522, -1.86275, not_printed},
    {0.05, 0, -0.00714, -0.00057, 0.00686, -2.60537, not_printed},
    {0.075, 0, -0.0101, -0.00348, 0.00816, -3.49151, not_printed},
    {0.1, 0, -0.01265, -0.00815, 0.0117, -4.54007, not_printed},
    {0.125, 0, -0.0148, -0.01462, 0.01901, -5.77608, not_printed},
    {0.15, 0, -0.01654, -0.02296, 0.02975, -7.23218, not_printed},
};

// Appendix 1: true coordinate less the one found.
constexpr double run_of_the_appendix[] = {
    3.166e-06,  5.574e-08,  1.879e-07,  1.13e-08,   2.911e-08,  1.105e-07,  -1.553e-07, 1.69e-08,
    5.531e-08,  -2.265e-08, -2.027e-08, 7.732e-08,  9.481e-07,  -1.316e-07, 2.841e-07,  2.383e-07,
    -1.96e-07,  2.712e-07,  -1.962e-06, 3.785e-07,  -7.364e-07, -2.129e-07, 3.303e-07,  -5.637e-07,
    -5.914e-07, 6.523e-08,  -2.14e-07,  -1.211e-07, 3.512e-08,  -1.605e-07};

constexpr std::array<double, 2> none{not_printed, not_printed};

// Tabs. 6-2 to 6-4, 6-6 to 6-8, 6-10 to 6-12, 6-14 to 6-16.
constexpr PublishedSuspension suspensions[] = {
    {1,
     "Tab. 6-1",
     "front_5US",
     example_1,
     {100,
      1998,
      7.2e-7,
      {{1.5e-8, 3.4e-9}, {1.3e-8, 2.4e-9}, {8.9e-6, 1.8e-6}, {5.1e-6, 9.5e-7}, {4.8e-6, 1.1e-6}}},
     0.027},
    {2,
     "Tab. 6-5",
     "strut_SP-3US",
     example_2,
     {100,
      1138,
      2.2e-6,
      {{3.5e-8, 1.3e-8}, {5.7e-8, 2.0e-8}, {1.2e-5, 3.6e-6}, {1.3e-5, 4.1e-6}, {1.1e-5, 3.9e-6}}},
     0.028},
    {3,
     "Tab. 6-9",
     "interconnected",
     example_3,
     {40,
      40240,
      0.010,
      {{5.3e-7, 1.0e-7}, {1.6e-7, 4.8e-8}, {3.2e-5, 8.4e-6}, {7.2e-5, 1.9e-5}, {2.1e-4, 4.3e-5}}},
     0.044},
    {4,
     "Tab. 6-13",
     "rear_5US",
     example_4,
     {40, 12502, 0.015, {{1.6e-7, 4.8e-8}, {9.0e-8, 2.8e-8}, {2.0e-4, 4.4e-5}, {7.7e-5, 2.0e-5}, none}},
     not_printed},
};
constexpr PublishedEvolution quadratic{
    40, 50000, 0.033, {{3.0e-5, 7.1e-6}, {1.1e-5, 2.3e-6}, {0.019, 0.004}, {0.005, 0.001}, none}};
constexpr PublishedEvolution dyad{
    40, 50000, 0.032, {{2.0e-5, 3.9e-6}, {6.6e-6, 1.2e-6}, {0.018, 0.003}, {0.005, 8.9e-4}, none}};

PointBox box(const Vec3& p, RandomStream& random) {
  const auto shift = [&] { return random.uniform(-0.075, 0.075); };
  const double x = shift(), y = shift(), z = shift();
  return box_around(p + Vec3{x, y, z}, 0.15);
}

}  // namespace

std::span<const PublishedSuspension> published_suspensions() { return suspensions; }
const PublishedEvolution& published_quadratic() { return quadratic; }
const PublishedEvolution& published_dyad() { return dyad; }
std::span<const double> published_run() { return run_of_the_appendix; }

Suspension strut_as_printed() {
  Suspension suspension = corner_sample("strut_SP-3US").suspension;
  suspension.links[1].carrier[0].x = -0.0059;
  suspension.links[3].carrier[0].x = -0.0366;
  suspension.links[3].carrier[0].y = 0.6755;
  return suspension;
}

CarrierTargets published_targets(const PublishedSuspension& published) {
  const Suspension& suspension = corner_sample(published.sample).suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition start = reference_position(plan);
  CarrierTargets targets{.wheel = suspension.wheel, .rack_direction = suspension.rack_direction, .poses = {}};
  for (const PublishedPosition& row : published.positions) {
    const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, {row.travel, row.rack}, start);
    LINKWRIGHT_REQUIRE(at.status == Status::done, "example {}: {}", published.example, at.reason);
    const CarrierPose& pose = at.place.carrier;
    targets.poses.push_back(
        {row.rack, pose.centre, wheel_angles(Side::left, suspension.wheel, pose.rotation)});
  }
  return targets;
}

std::vector<LinkTask> published_tasks(const Suspension& suspension, std::uint64_t seed) {
  std::vector<LinkTask> tasks;
  RandomStream random({seed, 61});
  for (const CornerLink& link : suspension.links) {
    LinkTask task = given_link(link);
    for (std::size_t k = 0; k < link.body.size(); ++k) task.body[k] = box(link.body[k], random);
    for (std::size_t k = 0; k < link.carrier.size(); ++k) {
      const Vec3& p = link.carrier[k];
      task.carrier[k] = box(p, random);
      if (link.type == LinkType::SR) task.carrier[k].lower.y = task.carrier[k].upper.y = p.y;
      if (link.type == LinkType::SP) task.carrier[k].lower.z = task.carrier[k].upper.z = p.z;
    }
    tasks.push_back(task);
  }
  return tasks;
}

std::vector<CouplerTask> published_coupler_tasks(const Suspension& suspension, std::uint64_t seed) {
  std::vector<CouplerTask> tasks;
  RandomStream random({seed, 62});
  for (const Coupler& coupler : suspension.couplers) {
    const CornerLink& first = suspension.links[static_cast<std::size_t>(coupler.first)];
    tasks.push_back({.name = coupler.name,
                     .first = coupler.first,
                     .second = coupler.second,
                     .min_offset = 0.1,
                     .max_offset = norm(first.carrier[0] - first.body[0]),
                     .point = box(coupler.point, random)});
  }
  return tasks;
}

double coordinate_error(std::span<const LinkTask> tasks, std::span<const CornerLink> links,
                        std::span<const Coupler> couplers, const Suspension& truth) {
  double sum = 0;
  int count = 0;
  for (std::size_t l = 0; l < tasks.size(); ++l) {
    const LinkCoordinates coordinates(tasks[l]);
    for (const int place : coordinates.free()) {
      sum += std::abs(LinkCoordinates::get(links[l], place) - LinkCoordinates::get(truth.links[l], place));
      ++count;
    }
  }
  for (std::size_t k = 0; k < couplers.size(); ++k) {
    const Vec3 d = couplers[k].point - truth.couplers[k].point;
    sum += std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    count += 3;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace linkwright::suspension
