// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/cli/messages_fixture.h"

// The same of what the mechanisms of first studies are made of.
namespace linkwright::cli {
namespace {

using namespace linkwright::cli::test;
using MessagesOfMechanisms = Messages;

// Paths.
std::vector<Row> paths() {
  return {
      {"transmission angle",
       path,
       {{"\"transmission_angle\"", "\"transmission angle\""}},
       {},
       "s.toml:31:11: error: constraint[1].type: is 'transmission angle', must be one of: "
       "crank_rotates_fully, order, transmission_angle, packaging, no_defects; did you mean "
       "'transmission_angle'?\n"},
      {"two points",
       path,
       {{all_points, "points_mm = [[0,0],[100,50]]"}},
       {},
       "s.toml:18:13: error: target.points_mm: 2 points make no path, at least 3 are needed; add points "
       "between them\n"},
      {"repeated points",
       path,
       {{all_points, "points_mm = [[0,0],[100,50],[100,50],[0,0],[3,4]]"}},
       {},
       "s.toml:18:13: error: target.points_mm: point 3 repeats point 2: (0.1, 0.05); remove one of them\n"},
      {"min > max",
       path,
       {{"[target]", "[mechanism.parameters]\ncrank_mm = { min = 200, max = 100 }\n\n[target]"}},
       {},
       "s.toml:15:12: error: mechanism.parameters.crank_mm: min is 200 mm, larger than max, which is 100 "
       "mm\n"},
      {"transmission 95",
       path,
       {{"min_deg = 30.0", "min_deg = 95"}},
       {},
       "s.toml:32:11: error: constraint[1].min_deg: is 95 deg, must be at most 90 deg\n"},
      {"grashof",
       path,
       {{"\"crank_rotates_fully\"", "\"grashof\""}},
       {},
       "s.toml:28:8: error: constraint[0].type: is 'grashof', must be one of: crank_rotates_fully, order, "
       "transmission_angle, packaging, no_defects; did you mean 'crank_rotates_fully' (the crank rotates "
       "fully)?\n"},
      {"3 coordinates",
       path,
       {{"[500, 1100]", "[500, 1100, 3]"}},
       {},
       "s.toml:19:3: error: target.points_mm[0]: has 3 numbers, must have 2\n"},
  };
}

// Bodies, joints and drives.
std::vector<Row> linkages() {
  return {
      {"unknown body",
       linkage,
       {{"second = \"rocker.B\"", "second = \"roker.B\""}},
       {},
       "s.toml:43:10: error: mechanism.joint[2].second: there is no body 'roker'; did you mean 'rocker'?\n"},
      {"unknown point",
       linkage,
       {{"second = \"rocker.B\"", "second = \"rocker.C\""}},
       {},
       "s.toml:43:10: error: mechanism.joint[2].second: body 'rocker' has no point 'C'; there are: B0, B\n"},
      {"unknown type of joint",
       linkage,
       {{"name   = \"B\"\n", "name   = \"B\"\ntype = \"hinge\"\n"}},
       {},
       "s.toml:42:8: error: mechanism.joint[2].type: is 'hinge', must be one of: revolute, prismatic, "
       "pin_in_slot, fixed, gear, rack, screw, geneva; did you mean 'revolute' (the two points coincide)?\n"},
      {"type pin",
       linkage,
       {{"name   = \"B\"\n", "name   = \"B\"\ntype = \"pin\"\n"}},
       {},
       "s.toml:42:8: error: mechanism.joint[2].type: is 'pin', must be one of: revolute, prismatic, "
       "pin_in_slot, fixed, gear, rack, screw, geneva; did you mean 'revolute' (the two points coincide)?\n"},
      {"joint missing",
       linkage,
       {{"[[mechanism.joint]]\nname   = \"B0\"\nfirst  = \"ground.B0\"\nsecond = \"rocker.B0\"\n", ""}},
       {},
       "s.toml:20:13: error: mechanism.body[2].name: 'coupler' and 'rocker' keep 2 degrees of freedom "
       "without a drive; the linkage has 3 degrees of freedom and 1 drive: drive one more joint, or add a "
       "joint\n"},
      {"redundant joint",
       linkage,
       {{"# A pair of bodies",
         "[[mechanism.joint]]\nname = \"A2\"\nfirst = \"crank.A\"\nsecond = \"coupler.A\"\n\n# A pair"}},
       {},
       "s.toml:51:8: error: mechanism.joint[4].name: a redundant constraint: 'crank' and 'coupler' are "
       "placed by other joints already, so the linkage closes for special dimensions only; leave the joint "
       "out, or one of the links beside it\n"},
      {"no drive",
       linkage,
       {{"[[drive]]\njoint     = \"O\"\nspeed_rpm = 300.0\n", ""}},
       {},
       "s.toml:15:13: error: mechanism.body[1].name: 'crank', 'coupler' and 'rocker' keep 1 degree of "
       "freedom without a drive; the linkage has 1 degree of freedom and 0 drives: drive one more joint, or "
       "add a joint\n"},
      {"drive of unknown joint",
       linkage,
       {{"[[drive]]\njoint     = \"O\"", "[[drive]]\njoint     = \"motor\""}},
       {},
       "s.toml:56:13: error: drive[0].joint: there is no joint 'motor'; there are: O, A, B, B0\n"},
      {"two bodies of one name",
       linkage,
       {{"name      = \"rocker\"", "name      = \"crank\""}},
       {},
       "s.toml:25:13: error: mechanism.body[3].name: the name 'crank' is given twice; give every body a name "
       "of its own\n"},
      {"mass missing",
       linkage,
       {{"mass_kg   = 1.3\n", ""}},
       {},
       "s.toml:10:1: error: mechanism.body: forces and torques need the mass of every body: 'coupler' has "
       "none; give mass_kg, or list quantities that need no masses: output.quantities = [\"position\", "
       "\"rates\", \"transmission_angle\"]\n"},
  };
}

// Built-in linkages.
std::vector<Row> samples() {
  const std::string begin = "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\n";
  const std::string all =
      "four_bar, slider_crank, offset_slider_crank, inverted_slider_crank, scotch_yoke, whitworth, "
      "toggle_press, hoeken, chebyshev, watt_1, watt_2, stephenson_2, stephenson_3, triad, klann_leg, "
      "jansen_leg, peaucellier, pantograph, geared_five_bar, andrews_squeezer, arm, four_bar_chain";
  return {
      {"sample misspelt",
       nullptr,
       {},
       {{"s.toml", begin + "sample = \"jansen_lag\"\n"}},
       "s.toml:5:10: error: mechanism.sample: is 'jansen_lag', must be one of: " + all +
           "; did you mean 'jansen_leg'?\n"},
      {"key of the sample misspelt",
       nullptr,
       {},
       {{"s.toml", begin + "sampl = \"jansen_leg\"\n"}},
       "s.toml:5:1: error: mechanism.sampl: unknown key; did you mean 'sample'?\n"},
  };
}

// Hard points and links.
std::vector<Row> suspensions() {
  return {
      {"hard-point typo",
       corner,
       {{"points   = [\"tie_inner\", \"tie_outer\"]", "points   = [\"tie_inner\", \"tie_outr\"]"}},
       {},
       "s.toml:46:12: error: mechanism.link[2].points: there is no hard point 'tie_outr'; there are: "
       "lower_front, lower_rear, lower_ball, upper_front, upper_rear, upper_ball, tie_inner, tie_outer, "
       "spring_top, spring_bottom, wheel_centre; did you mean 'tie_outer'?\n"},
      {"link type wishbone",
       corner,
       {{"type   = \"RS\"\npoints = [\"lower_front\"", "type   = \"wishbone\"\npoints = [\"lower_front\""}},
       {},
       "s.toml:35:10: error: mechanism.link[0].type: is 'wishbone', must be one of: R, RR, S, RS, SR, SP, "
       "US, SS; did you mean 'RS' (wishbone: hinged to the body (two points), ball joint at the carrier)?\n"},
      {"link type A-arm",
       corner,
       {{"type   = \"RS\"\npoints = [\"lower_front\"", "type   = \"A-arm\"\npoints = [\"lower_front\""}},
       {},
       "s.toml:35:10: error: mechanism.link[0].type: is 'A-arm', must be one of: R, RR, S, RS, SR, SP, US, "
       "SS; did you mean 'RS' (wishbone: hinged to the body (two points), ball joint at the carrier)?\n"},
      {"too few links",
       corner,
       {{"[[mechanism.link]]\nname     = \"tie rod\"\ntype     = \"US\"\npoints   = [\"tie_inner\", "
         "\"tie_outer\"]\nmoved_by = \"rack\"\n",
         ""},
        {"[sweep.rack]\nvalues_mm = [-60.0, -30.0, 0.0, 30.0, 60.0]", ""}},
       {},
       "s.toml:6:1: error: mechanism.links: the links constrain 4 of the carrier's 6 degrees of freedom (2 "
       "RS: 4), 5 must be constrained; the wheel would have 2 degrees of freedom: add links\n"},
      {"unit = m",
       corner,
       {{all_hard_points, listed("m")}},
       {{"points.txt", hard_points()}},
       "s.toml:12:1: error: mechanism.hard_points: the farthest point of the suspension lies 443.4 m from "
       "the wheel centre; are these millimetres in keys of metres? check the unit in the key: _mm, _cm, _m "
       "or _in\ns.toml:16:1: error: mechanism.wheel: the tyre's radius is 320 mm, the joints lie 379.5 m "
       "from the wheel centre in the middle, and the track is 1520 m; check tyre_diameter and the points: "
       "_mm, _cm, _m or _in\n2 errors\n"},
      {"unreadable list",
       corner,
       {{all_hard_points, listed("mm")}},
       {{"points.txt", replaced(hard_points(), "715.0", "7l5.0")}},
       "s.toml:13:8: error: mechanism.hard_points.file: points.txt:3:1: lower_ball: 'lower_ball 8.0 7l5.0 "
       "-130.0' is not read: '7l5.0' is not a number; write a point as: name x y z; put remarks behind #, "
       "and "
       "# before a line that is not meant\n"},
      {"wrong side",
       corner,
       {{"[-125.0, 415.0,  -47.0]", "[-125.0, -415.0, -47.0]"},
        {"[   0.0, 760.0,    0.0]", "[0.0, -760.0, 0.0]"}},
       {},
       "s.toml:25:1: error: mechanism.wheel: y of the wheel centre is -0.76 m on the left side; y points to "
       "the left\n"},
      {"same point twice, same place",
       corner,
       {{all_hard_points, listed("mm")}},
       {{"points.txt", hard_points() + "lower_front 180.0 370.0 -110.0\n"}},
       ""},
      {"same point twice, other place",
       corner,
       {{all_hard_points, listed("mm")}},
       {{"points.txt", hard_points() + "lower_front 1 2 3\n"}},
       "s.toml:13:8: error: mechanism.hard_points.file: points.txt:12:1: lower_front: is given twice, at "
       "different positions: (0.18, 0.37, -0.11) m in line 1 and (0.001, 0.002, 0.003) m here; neither is "
       "taken; "
       "remove the line that no longer holds, or give every point a name of its own\n"},
      {"type macpherson",
       corner,
       {{"\"suspension.corner\"", "\"macpherson\""}},
       {},
       "s.toml:7:8: error: mechanism.type: is 'macpherson', must be one of: planar.four_bar, planar.linkage, "
       "planar.slider_crank, planar.serial_arm, planar.cam, suspension.corner, "
       "suspension.beam_axle, parallel.pi_joint, parallel.delta, "
       "parallel.hexa, parallel.five_bar, parallel.constant_orientation, parallel.serial_pi_arm, "
       "flexible.hub_link, clearance.linkage; did you mean 'suspension.corner'?\n"},
      {"sample double wishbone",
       corner,
       {{"side = \"left\"", "side = \"left\"\nsample = \"double wishbone\""}},
       {},
       "s.toml:9:10: error: mechanism.sample: there is no sample 'double wishbone'; there are: R, RR-US, "
       "S-2US, 2RS-US, RS-SR-US, RS-SP-US, 2SR-US, SR-SP-US, RS-3US, SR-3US, SP-3US, 5US, front_5US, "
       "strut_SP-3US, interconnected, rear_5US; did you mean '2RS-US'?\n"},
  };
}

TEST_F(MessagesOfMechanisms, Paths) { expect(paths()); }
TEST_F(MessagesOfMechanisms, Linkages) { expect(linkages()); }
TEST_F(MessagesOfMechanisms, Samples) { expect(samples()); }
TEST_F(MessagesOfMechanisms, Suspensions) { expect(suspensions()); }

}  // namespace
}  // namespace linkwright::cli
