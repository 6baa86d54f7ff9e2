// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/linkage.h"

#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

struct Names {
  std::string body, ground, end;  // the link or slide, its joint with the ground and that with the body
};

Complex foot(const GuidingDyad& dyad) { return dyad.offset * dyad.normal; }
double along(const GuidingDyad& dyad) { return std::arg(Complex(0, 1) * dyad.normal); }

// Points of the ground and of the body that a dyad needs.
void add_points(const GuidingDyad& dyad, const Names& n, std::vector<LinkagePoint>& ground,
                std::vector<LinkagePoint>& body) {
  ground.push_back({n.ground, dyad.type == GuidingDyadType::pr ? foot(dyad) : dyad.fixed});
  body.push_back({n.end, dyad.type == GuidingDyadType::rp ? foot(dyad) : dyad.moving});
}

void add_dyad(Linkage& l, const GuidingDyad& dyad, const Names& n, const BodyPose& pose) {
  const std::string ground = "ground." + n.ground, body = "body." + n.end;
  switch (dyad.type) {
    case GuidingDyadType::rr: {
      add_bar(l, n.body, n.ground, n.end, dyad.length);
      set_start(l, n.body, dyad.fixed, std::arg(place(pose, dyad.moving) - dyad.fixed));
      add_pin(l, n.ground, ground, n.body + "." + n.ground);
      add_pin(l, n.end, n.body + "." + n.end, body);
      return;
    }
    case GuidingDyadType::pr: {
      add_body(l, n.body, {{n.end, 0}});
      set_start(l, n.body, place(pose, dyad.moving), along(dyad));
      add_slide(l, n.ground, ground, n.body + "." + n.end, along(dyad), 0);
      add_pin(l, n.end, n.body + "." + n.end, body);
      return;
    }
    case GuidingDyadType::rp:
      break;
  }
  add_body(l, n.body, {{n.ground, 0}});
  set_start(l, n.body, dyad.fixed, pose.angle + along(dyad));
  add_pin(l, n.ground, ground, n.body + "." + n.ground);
  add_slide(l, n.end, body, n.body + "." + n.ground, along(dyad), 0);
}

}  // namespace

Linkage guided_body(const GuidingDyad& driver, const GuidingDyad& other, const BodyPose& pose) {
  const Names a{"drive", "O", "A"}, b{"guide", "G", "B"};
  std::vector<LinkagePoint> ground, body;
  add_points(driver, a, ground, body);
  add_points(other, b, ground, body);
  body.push_back({"P", 0});
  Linkage l = grounded(std::move(ground));
  add_body(l, "body", std::move(body));
  set_start(l, "body", pose.origin, pose.angle);
  add_dyad(l, driver, a, pose);
  add_dyad(l, other, b, pose);
  add_drive(l, driver.type == GuidingDyadType::rp ? a.end : a.ground);
  return l;
}

}  // namespace linkwright::planar
