// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_rows.h"

// `[path]` of an analysis: a point that is taken along a path, and the drives that do it.
namespace linkwright::planar {

/// `[path]` as a file holds it.
struct LinkagePathForm {
  std::string point;
  FollowedCoordinates along = FollowedCoordinates::point;
  std::vector<std::string> drives;
  std::optional<PathPlace> from;
  std::optional<double> from_angle;
  int samples = 201;
  PointPath path;
};
template <class Visitor>
void fields(Visitor&& visit, LinkagePathForm& p) {
  visit(field::entry("point", "point that follows the path, \"body.point\"").required(), p.point);
  visit(field::entry("along", "coordinates of the path that are followed"), p.along);
  visit(field::entry("drives", "joints whose drives follow; if absent all that have no law"), p.drives);
  visit(field::length("from",
                      "place where the path begins; if absent the first one of a table, or the place "
                      "of the point in the drawn position"),
        p.from);
  visit(field::angle("from_angle", "angle of the body there; if absent that of the drawn position"),
        p.from_angle);
  visit(
      field::entry("samples", "number of rows, evenly spaced in time, both ends included").between(2, 100000),
      p.samples);
  fields(visit, p.path);
}

/// Makes the joints that `drives` of `[path]` names inputs of the linkage, unless they are.
void read_path_drives(study::ObjectReader& document, Linkage& linkage, bool own_drives);

/// Reads `[path]`, and the files of its tables, without its start; nothing when there are problems, which go
/// to the reader.
std::optional<LinkagePath> read_path(study::ObjectReader& document, const study::Common& common,
                                     const Linkage& linkage, const LinkagePlan& plan, LinkagePathForm& form);

/// Finds the beginning of the path with the laws of the other drives; false, and the problem reported, when
/// the linkage does not reach it. `form` receives the place where it begins.
bool find_path_start(study::ObjectReader& document, const LinkageDescription& description,
                     const std::vector<LinkageDrive>& drives, LinkagePathForm& form, LinkagePath& path);

void describe_path(study::SchemaWriter& document);

/// The rows of a path, as far as it is reached.
LinkageRows path_rows(const LinkageStudy& study);

/// The columns of speeds, accelerations and powers of the drives.
void add_drive_motion_columns(const LinkageStudy& study, std::vector<LinkageColumn>& columns);

/// The table "path" without rows.
Table empty_path_table();

/// Adds table, facts, the path in the scene, and where and why it ends.
void add_path(const LinkageStudy& study, const LinkageRows& rows, study::Result& result);

}  // namespace linkwright::planar
