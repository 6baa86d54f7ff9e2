// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "linkwright/core/value.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/result.h"
#include "linkwright/suspension/corner/hard_point_list.h"
#include "linkwright/suspension/studies/corner.h"

// Lists of hard points that a study writes for CAD and for other programs.
namespace linkwright::suspension {

/// `[[list]]`: a list of the points of the suspension. Unit and frame are those of `[mechanism.hard_points]`
/// where nothing else is said.
struct ListForm {
  ListFormat format = ListFormat::text;
  std::optional<PointUnit> unit;
  std::optional<Direction> x, y, z;
  std::optional<std::array<double, 3>> origin;
};
template <class Visitor>
void fields(Visitor&& visit, ListForm& l) {
  visit(field::entry("format", "form of the list").required(), l.format);
  visit(field::entry("unit", "of its coordinates; default: that of mechanism.hard_points"), l.unit);
  visit(field::entry("x", "where its x axis points to; default: as in mechanism.hard_points"), l.x);
  visit(field::entry("y", "where its y axis points to; default: as in mechanism.hard_points"), l.y);
  visit(field::entry("z", "where its z axis points to; default: as in mechanism.hard_points"), l.z);
  visit(field::length("origin", "its origin in the vehicle's frame; default: that of mechanism.hard_points"),
        l.origin);
}

/// Reads `[[list]]` with defaults filled in; problems go to the reader.
std::vector<ListForm> read_lists(study::ObjectReader& document,
                                 const std::optional<CornerDescription>& description);
Value write_lists(const std::vector<ListForm>& lists);
void describe_lists(study::SchemaWriter& document);

/// Adds the lists that a study asks for of a suspension that was described or found for a description. Points
/// have the names of the list that they were read from, others that of their link and end. `other` is the
/// other wheel of an axle.
void add_lists(study::Result& result, const std::vector<ListForm>& lists,
               const CornerDescription& description, const Suspension& suspension,
               const CornerDescription* other = nullptr);

/// Adds the list that a description was read from, with the points of the suspension that was found for it.
/// Nothing is added where it was not read from a list; a point that has moved and is not in it is a warning.
void add_list_of_found(study::Result& result, const CornerDescription& description, const Suspension& found);

}  // namespace linkwright::suspension
