// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/dexterity.h"

#include "linkwright/core/check.h"
#include "linkwright/core/kernels.h"
#include "linkwright/parallel/dexterity/detail/kernel.h"

namespace linkwright::parallel {
namespace {

PreparedRobot prepare(const DesignedRobot& designed, const WorkingMode& mode, const DexterityMeasures& what,
                      const Mat3& rotation) {
  LINKWRIGHT_REQUIRE(what.length > 0, "the characteristic length must be more than 0, got {} m", what.length);
  PreparedRobot out{.count = designed.count,
                    .output = what.output,
                    .constraint = what.constraint && designed.robot.freedom == Freedom::space_translation,
                    .per_length = 1 / what.length,
                    .assembly = static_cast<double>(designed.assembly),
                    .turned = static_cast<double>(designed.constraint),
                    .origin = designed.offset * designed.ahead};
  for (int i = 0; i < designed.robot.legs(); ++i) {
    PreparedLeg& leg = out.leg[i];
    leg.leg = designed.robot.leg[i];
    leg.axis = cross(leg.leg.ahead, leg.leg.aside);
    leg.lever = rotation * leg.leg.platform;
    leg.mode = mode[i];
    out.assembly *= mode[i];
    leg.sense = designed.sense[i];
    for (int j = 0; j < designed.count; ++j) {
      const LegRate& rate = designed.by[j][i];
      PreparedLeg::By& by = leg.by[j];
      by.lever = rotation * rate.platform;
      by.joint = by.lever - rate.base;
      if (j == designed.count - 1) by.joint += designed.ahead;
      by.along = dot(by.joint, leg.leg.ahead);
      by.aside = dot(by.joint, leg.leg.aside);
      by.across = dot(by.joint, leg.axis);
      by.arm = rate.arm;
      by.rod = rate.rod;
    }
  }
  return out;
}

// Wider registers do not pay here.
#ifdef LINKWRIGHT_X86_KERNELS
constexpr KernelSet<MeasureKernel> measures{measure_set_baseline, measure_set_avx2};
#else
constexpr KernelSet<MeasureKernel> measures{measure_set_baseline};
#endif

void enlarge(std::vector<double>& values, std::size_t size) {
  if (values.size() < size) values.resize(size);
}

}  // namespace

void measure(const DesignedRobot& designed, const WorkingMode& mode, const DexterityMeasures& what,
             const Vec3& place, const Mat3& rotation, PoseDexterity<double>& out) {
  const PreparedRobot robot = prepare(designed, mode, what, rotation);
  switch (designed.robot.legs()) {
    case 2:
      return measure<2, true>(robot, place, out);
    case 3:
      return measure<3, true>(robot, place, out);
    default:
      return measure<6, true>(robot, place, out);
  }
}

void measure(const DesignedRobot& designed, const WorkingMode& mode, const DexterityMeasures& what,
             const PoseSet& poses, bool derivatives, SetDexterity& out) {
  static MeasureKernel* const kernel = widest(measures).run;
  const std::size_t size = poses.size();
  const int legs = designed.robot.legs();
  enlarge(out.conditioning, size);
  enlarge(out.constraint, size);
  for (int i = 0; i < legs; ++i)
    for (auto* values : {&out.input_square[i], &out.cosine[i], &out.sine[i], &out.side[i], &out.output[i]})
      enlarge(*values, size);
  for (int j = 0; derivatives && j < designed.count; ++j) enlarge(out.conditioning_by[j], size);
  kernel(prepare(designed, mode, what, poses.rotation), legs, poses, derivatives, out);
}

}  // namespace linkwright::parallel
