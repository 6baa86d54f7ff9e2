// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/masses.h"

#include <fmt/core.h>

#include <array>
#include <string_view>

#include "linkwright/study/bind_write.h"

namespace linkwright::parallel {

std::optional<RobotMasses> read_masses(study::ObjectReader& document, const RobotDescription& d,
                                       Value& canonical) {
  auto table = document.table("masses");
  if (!table) return std::nullopt;
  MassesForm form;
  table->read(form);
  if (document.document().has_errors()) return std::nullopt;
  constexpr std::array<std::string_view, 3> of_arms = {"arm_inertia", "arm_mass", "arm_centre"};
  if (form.pi) {
    for (const std::string_view key : of_arms)
      if (table->has(key)) {
        table->error(key, "is given for plain arms together with the masses of the Pi-joints",
                     "keep [masses.pi_joint], or the arm's masses");
        return std::nullopt;
      }
    form.leg.pi = *form.pi;
  }
  if (!form.gravity)
    form.gravity = d.robot.freedom == Freedom::plane_translation ? Coordinates{0, -standard_gravity, 0}
                                                                 : Coordinates{0, 0, -standard_gravity};
  RobotMasses out = equal_legs(form.platform, form.leg, vec(*form.gravity));
  for (int i = 0; i < d.robot.legs(); ++i)
    if (out.leg[i].pi) out.leg[i].pi->lead = d.motors[i].screw.lead;
  if (const auto wrong = problem(d.robot, d.drives, out)) {
    table->error("", *wrong);
    return std::nullopt;
  }
  canonical["masses"] = form.pi ? without(study::write_fields(form), of_arms) : study::write_fields(form);
  return out;
}

void describe_masses(study::SchemaWriter& document) {
  document.property(field::entry("masses", "of the platform and of each leg"),
                    study::schema_fields<MassesForm>());
}

}  // namespace linkwright::parallel
