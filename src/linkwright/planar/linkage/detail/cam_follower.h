// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/cam/detail/contour.h"
#include "linkwright/planar/linkage/motion.h"

// The follower of a cam as its linkage guides it, without the cam: its joint is driven instead. From its
// motion follow the place on the base circle and the contour of the cam.
namespace linkwright::planar {

// The linkage whose cam runs against the second roller of a conjugate cam.
Linkage with_second_roller(Linkage linkage, int cam);

// The bodies of a cam: what carries it, what turns with it.
struct CamBodies {
  BodyPoint base, cam;  // with the centre of the cam on each
};
// Nothing where no body has both joints of the cam.
std::optional<CamBodies> bodies_of(const Linkage& linkage, const LinkageCam& cam);

class CamFollower {
 public:
  // `known` are coordinates of the joints that cams move where their programmes are 0, as far as they are
  // known already; the others are taken from the start poses, or are 0.
  CamFollower(const Linkage& linkage, int cam, const std::vector<double>& known);

  // Why the follower cannot be moved by its joint; empty where it can.
  const Diagnostics& problems() const { return problems_; }
  // The coordinate of the moved joint that the start poses show.
  std::optional<double> drawn() const;
  // The distance of the centre of the cam from roller centre, edge or face (m) at a coordinate of the moved
  // joint; of a face negative where it lies to the left of the direction. NaN where it does not assemble.
  double distance(double coordinate);
  // The coordinate where the follower touches the base circle: the one nearest to the drawn one, or without a
  // drawing nearest to 0 of those where the programme moves it away from the cam. Nothing if there is none.
  std::optional<double> on_base_circle(double base_radius);

  // The contour at a motion of the programme and an angle of the cam; `offset` is the coordinate where the
  // programme is 0. Lever and pressure angle are those of the way in which the cam pushes. NaN where the
  // follower does not assemble.
  CamState contour(double offset, const math::Motion& motion, double angle);

 private:
  void move(const math::Motion& motion);
  math::Vec2 in_base(const math::Vec2& vector) const;

  Linkage linkage_;
  const LinkageCam cam_;
  CamBodies bodies_;
  std::size_t input_ = 0;
  std::vector<InputMotion> inputs_;
  LinkagePlan plan_;
  Diagnostics problems_;
  std::optional<LinkageMotion> motion_;
};

// The extremes of the contour of a cam in its linkage, for a roller of the follower.
CamExtremes linkage_cam_extremes(const LinkagePlan& plan, int cam, CamFollower& follower, double roller);

}  // namespace linkwright::planar
