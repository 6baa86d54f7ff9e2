// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/samples.h"

#include <gtest/gtest.h>

#include "flexible/beams.h"

namespace linkwright::flexible {
namespace {

void expect_inputs(const Beam& beam, std::string_view id) {
  const Value& in = test::at(test::published_case("flexible-link.json", id), "inputs.params");
  EXPECT_EQ(beam.length, test::number_at(in, "L_m"));
  EXPECT_EQ(beam.density, test::number_at(in, "rho_kg_m3"));
  EXPECT_EQ(beam.area, test::number_at(in, "A_m2"));
  EXPECT_EQ(beam.second_moment, test::number_at(in, "I_m4"));
  EXPECT_EQ(beam.elastic_modulus, test::number_at(in, "E_Pa"));
  EXPECT_EQ(beam.hub_radius, test::number_at(in, "rH_m"));
  EXPECT_EQ(beam.hub_inertia, test::number_at(in, "JH_kgm2"));
  EXPECT_EQ(beam.tip_mass, test::number_at(in, "mp_kg"));
}

TEST(FlexibleSamples, AreThoseOfThePublications) {
  expect_inputs(spin_up_beam(), "freq-T31");
  expect_inputs(torque_beam(), "freq-T32");
  const Beam kane = kane_beam();
  EXPECT_DOUBLE_EQ(kane.bending_stiffness(), 1.4e4);
  EXPECT_DOUBLE_EQ(kane.elastic_modulus * kane.area, 2.8e7);
  EXPECT_DOUBLE_EQ(kane.density * kane.area, 1.2);
}

}  // namespace
}  // namespace linkwright::flexible
