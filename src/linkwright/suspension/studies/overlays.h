// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/kind.h"

// Curves that were measured on a rig, for comparison with those of a wheel suspension.
namespace linkwright::suspension {

/// `[[measured.column]]`.
struct MeasuredColumnForm {
  std::string quantity;
  std::string heading;
  std::vector<double> values;
  double factor = 1, offset = 0;
  bool from_static = false;
};
template <class Visitor>
void fields(Visitor&& visit, MeasuredColumnForm& c) {
  visit(
      field::entry("quantity", "column of the table sweep, with the unit of the numbers: toe_deg").required(),
      c.quantity);
  visit(field::entry("heading", "of its column in the file"), c.heading);
  visit(field::entry("values", "its numbers, one for each travel, instead of a file"), c.values);
  visit(field::entry("factor", "by which the numbers are multiplied, as -1 for another sign"), c.factor);
  visit(field::entry("offset", "that is then added, in the unit of the numbers"), c.offset);
  visit(field::entry("from_static", "they count from the position at travel 0"), c.from_static);
}

/// `[[measured]]`: data of a rig, in a file or here.
struct MeasuredForm {
  std::string name;
  std::string file, travel;
  std::vector<double> travels;
  double travel_factor = 1, travel_offset = 0, rack = 0;
  std::vector<MeasuredColumnForm> columns;
};
template <class Visitor>
void fields(Visitor&& visit, MeasuredForm& m) {
  visit(field::entry("name", "of the measurement, for diagrams").required(), m.name);
  visit(field::entry("file", "CSV file with headings"), m.file);
  visit(field::entry("travel", "heading of its column of the wheel's travel, with unit: \"Wheel Z [mm]\""),
        m.travel);
  visit(field::length("travels", "travels of the wheel instead of a file"), m.travels);
  visit(field::entry("travel_factor", "by which the travels are multiplied, as -1 where bump is negative"),
        m.travel_factor);
  visit(field::length("travel_offset", "that is then added to the travels"), m.travel_offset);
  visit(field::length("rack", "displacement of the rack during the measurement"), m.rack);
  visit(field::entry("column", "what was measured"), m.columns);
}

/// A measured curve.
struct MeasuredCurve {
  std::string key;             ///< of the column of the table sweep: "toe_rad"
  std::vector<double> values;  ///< one for each travel, in SI units; NaN = none
  bool from_static = false;    ///< changes from the position at travel 0
};
/// The curves of a measurement.
struct Measurement {
  std::string name;
  std::vector<double> travels;  ///< m, in the order in which they were measured
  double rack = 0;              ///< m
  std::vector<MeasuredCurve> curves;
};

/// Reads `[[measured]]` and its files; problems go to the reader. `sweep` is the table whose columns can be
/// measured.
std::vector<Measurement> read_measured(study::ObjectReader& document, const study::Common& common,
                                       const Table& sweep);
/// The tables as a canonical study holds them: with the numbers, without files.
Value write_measured(std::span<const Measurement> measured);
void describe_measured(study::SchemaWriter& document);

/// A curve family of another source over the same travel.
struct OverlaidTable {
  std::string name;  ///< for the legend
  Table table;       ///< with travel_m and columns of the table sweep
};
/// Adds for each of these quantities a table `beside_toe` with the curves of all tables that have it, and a
/// diagram, where at least two have it.
void add_overlaid(study::Result& result, std::span<const OverlaidTable> tables,
                  std::span<const std::string> quantities);

/// Adds a table with the measured numbers, what the suspension has at the same travels, and the differences,
/// and facts with the largest and the mean square difference of each quantity.
///
/// @param computed table sweep at these travels
/// @param at_rest the same at travel 0, one row
/// @returns the measured numbers as absolute ones, for diagrams
Table add_measured(study::Result& result, const Measurement& measured, const Table& computed,
                   const Table& at_rest, std::size_t number);

}  // namespace linkwright::suspension
