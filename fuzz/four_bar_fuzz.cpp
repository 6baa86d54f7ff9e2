// SPDX-License-Identifier: BSD-3-Clause

// Eleven doubles: four lengths, coupler point, pivot, frame angle, crank angle, and one whose sign is the
// branch.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "linkwright/core/check.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  using namespace linkwright::planar;
  std::array<double, 11> q{};
  if (size < sizeof(q)) return 0;
  std::memcpy(q.data(), data, sizeof(q));
  const FourBar linkage{.ground = q[0],
                        .crank = q[1],
                        .coupler = q[2],
                        .rocker = q[3],
                        .coupler_u = q[4],
                        .coupler_v = q[5],
                        .pivot_x = q[6],
                        .pivot_y = q[7],
                        .frame_angle = q[8],
                        .branch = q[10] >= 0 ? Branch::open : Branch::crossed};
  try {
    const FourBarPosition pose = position(linkage, q[9]);
    FUZZ_REQUIRE((pose.gap > 0) == (pose.status == Status::no_assembly));
    if (pose.status == Status::done)
      FUZZ_REQUIRE(std::isfinite(pose.coupler_angle) && pose.transmission_angle > 0);
    const FourBarClass type = classify(linkage);
    FUZZ_REQUIRE(type.inputs.empty() == (type.circuits == 0));
    for (const AngleInterval& interval : type.inputs) FUZZ_REQUIRE(interval.from <= interval.to);
    const TransmissionAngles mu = transmission_angles(linkage);
    FUZZ_REQUIRE(mu.minimum >= 0 && mu.minimum <= mu.maximum && mu.maximum < 1.6);
    FUZZ_REQUIRE(cognates(linkage, q[9]).size() <= 2);
  } catch (const ContractError&) {
  }
  return 0;
}
