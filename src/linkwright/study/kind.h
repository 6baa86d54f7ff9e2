// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
#include "linkwright/study/result.h"

// In which units numbers are shown to people and, on request, written to files.
namespace linkwright::study {

/// A unit for each dimension; SI where none is chosen.
class DisplayUnits {
 public:
  /// Chooses the unit of its dimension.
  /// @param unit the unit, as split_unit gives it
  void choose(const UnitKey& unit) { chosen_[unit.dimension] = unit.unit; }
  /// Lets speeds, areas and stiffnesses go with the chosen lengths, angular speeds with the chosen angles:
  /// mm/s and N/mm with mm, deg/s with deg, deg/100mm with both, unless they were chosen themselves.
  void follow();
  /// @param dimension any dimension
  /// @returns true if a unit was chosen for it
  bool chosen(Dimension dimension) const { return chosen_.contains(dimension); }

  /// @param dimension a dimension that has a unit
  /// @returns its unit, in SI where none is chosen
  /// @throws ContractError for Dimension::none
  const Unit& of(Dimension dimension) const;
  /// A number with its unit: 0.0031 m as "3.1 mm".
  /// @param si value in SI
  /// @param dimension dimension of the value
  /// @param digits significant digits, >= 1
  /// @returns the number in the unit of its dimension
  Measured measured(double si, Dimension dimension, int digits = 4) const;
  /// @param si value in SI
  /// @param dimension dimension of the value
  /// @param digits significant digits, >= 1
  /// @returns text of the number in the unit of its dimension
  std::string text(double si, Dimension dimension, int digits = 4) const {
    return to_string(measured(si, dimension, digits));
  }

  /// A key and how its numbers change: "crank_m" becomes "crank_mm" and numbers take the factor 1000.
  struct Key {
    std::string key;             ///< key with the chosen unit
    const Unit* from = nullptr;  ///< unit of the given key; nullptr = it has none
    const Unit* to = nullptr;    ///< chosen unit; nullptr = the key has none
    /// @param value number in the unit of the given key
    /// @returns number in the chosen unit
    double convert(double value) const { return from == to ? value : to->from_si(from->to_si(value)); }
  };
  /// @param key any key
  /// @returns the key with the chosen unit; unchanged when it has no unit
  Key key(std::string_view key) const;

 private:
  std::map<Dimension, const Unit*> chosen_;
};

/// @param document a study
/// @returns the units that its keys carry: for each dimension the most frequent one, the first of equally
/// frequent ones
DisplayUnits units_of(const Value& document);

/// @param table a table with units in its keys
/// @param units units to be shown
/// @returns the table in these units: keys, labels and values
Table in_units(Table table, const DisplayUnits& units);
/// @param object an object of numbers by key, such as parameters and objectives
/// @param units units to be shown
/// @returns the object in these units; what is no number stays
Value in_units(const Value& object, const DisplayUnits& units);

/// @param sentence any sentence
/// @param units units to be shown
/// @returns the sentence with its numbers in these units, those of other dimensions as they were
Sentence in_units(const Sentence& sentence, const DisplayUnits& units);

/// @param value any number
/// @returns the number with six significant digits
double six_digits(double value);

/// `units` of `[output]`: "si", "study" (those of its own keys) or a list of unit suffixes, ["mm", "deg"].
struct OutputUnits {
  /// Units of results.
  enum class Choice {
    si,                           ///< SI
    study,                        ///< those of the study's own keys
    list                          ///< those of `list`
  } choice = Choice::si;          ///< the choice
  std::vector<std::string> list;  ///< suffixes: "mm", "deg"
};

/// @param choice `output.units` of a study
/// @param study units of the study's own keys
/// @returns the units that the choice gives
DisplayUnits chosen_units(const OutputUnits& choice, const DisplayUnits& study);

/// A key, or one of its words, that a study of a related kind has and this kind has not.
struct Absent {
  std::string_view key;     ///< key with its tables and without unit: "target.gates", "constraint.type"
  std::string_view word;    ///< the word of that key that is not here; empty = the key itself
  std::string_view reason;  ///< says why it is absent, and what comes nearest
};

class ObjectReader;  // study/bind.h

/// One `[[check]]` of a study. The limits are in the unit that the quantity's name ends in.
struct CheckRequest {
  std::string quantity;           ///< see `evaluate`
  std::optional<double> at_most,  ///< upper limit
      at_least,                   ///< lower limit
      equals,                     ///< expected value
      tolerance;                  ///< allowed distance from it, >= 0
  /// Row of a table: numbers by column key, any unit of the column's dimension; { travel_mm = 50.0, rack_mm =
  /// 0.0 }.
  std::vector<std::pair<std::string, double>> at;
};
template <class Visitor>
void fields(Visitor&& visit, CheckRequest& c) {
  visit(
      field::entry("quantity", "what is checked: best.<key>, statistics.<key>, <table>.<column>.<statistic>")
          .required(),
      c.quantity);
  visit(field::entry("at_most", "upper limit"), c.at_most);
  visit(field::entry("at_least", "lower limit"), c.at_least);
  visit(field::entry("equals", "expected value"), c.equals);
  visit(field::entry("tolerance", "allowed distance from the expected value").not_negative(), c.tolerance);
}

/// Reads the row of a table that a quantity belongs to.
/// @param reader table of the study that may have the key `at`
/// @param check receives the row; unchanged if there is no key
void read_row(ObjectReader& reader, CheckRequest& check);

/// Reads `[[check]]`: each needs limits that fit together.
/// @param document the study, whose reader takes what is wrong
/// @returns the checks in their order
std::vector<CheckRequest> read_checks(ObjectReader& document);

/// @param checks checks of a study
/// @returns them as a canonical study holds them
Value write_checks(const std::vector<CheckRequest>& checks);

/// Compares a result with a check. Quantities are
///
/// - `best.KEY`: objective, parameter or classification (a number) of the first solution;
/// - `statistics.KEY`: number of the statistics;
/// - `TABLE.COLUMN` with `at`: the row whose columns have these values (to 1e-6 of the column's span);
/// - `TABLE.COLUMN.WHAT`: max, min, max_abs, mean, rms, first or last of the rows that have a value; mean and
///   rms count one of the two ends of a period;
/// - `TABLE.COLUMN` of a table with one row.
///
/// Keys match in any unit of their dimension: sweep.toe_deg is found in the column toe_rad and converted.
/// @param request the check
/// @param result result of the study
/// @returns the check with its value; a quantity that cannot be found is a failed check whose message says
/// why
Check evaluate(const CheckRequest& request, const Result& result);

class ObjectReader;  // study/bind.h
class SchemaWriter;  // study/bind_schema.h

/// Files that a run writes.
enum class Format {
  json,  ///< result.json: everything
  csv,   ///< one file for each table
  html,  ///< report.html: the report for people
  svg,   ///< a drawing of each solution
  dxf,   ///< a drawing of each solution for CAD, in millimetres, 1:1
  step   ///< the links of each solution as solids for CAD, with pins and holes
};
constexpr std::array<EnumName<Format>, 6> names(Format) {
  return {{{Format::json, "json", "result.json: everything"},
           {Format::csv, "csv", "one file for each table"},
           {Format::html, "html", "report.html: the report for people"},
           {Format::svg, "svg", "a drawing of each solution"},
           {Format::dxf, "dxf", "a drawing of each solution for CAD, in millimetres, 1:1"},
           {Format::step, "step", "the links of each solution as solids for CAD, with pins and holes"}}};
}

/// Digits of the numbers in result.json and CSV.
enum class Digits {
  full,  ///< as many as read back to the same number
  six    ///< six significant digits
};
constexpr std::array<EnumName<Digits>, 2> names(Digits) {
  return {{{Digits::full, "full", "as many as read back to the same number"},
           {Digits::six, "six", "six significant digits"}}};
}

/// `[output.parts]` of a study: the sizes of flat links in STEP files. What is not given follows from the
/// size of the mechanism.
struct PartSizes {
  std::optional<double> width;         ///< m, of bars, and twice the radius of the corners of plates
  std::optional<double> thickness;     ///< m
  std::optional<double> pin_diameter;  ///< m, of pins and holes
};
template <class Visitor>
void fields(Visitor&& visit, PartSizes& p) {
  visit(field::length("width", "width of bars (5 % of the size of the mechanism)").positive(), p.width);
  visit(field::length("thickness", "thickness of the links (2 %)").positive(), p.thickness);
  visit(field::length("pin_diameter", "diameter of the pins and their holes (2 %)").positive(),
        p.pin_diameter);
}

/// `[output]` of a study.
struct Output {
  std::string dir;  ///< folder, relative to the current one; empty = "out/" and the name of the study file
  std::vector<Format> formats{Format::json, Format::csv, Format::html};  ///< files to write
  int samples = 361;                    ///< number of samples of curves and animations
  OutputUnits units;                    ///< units of tables, parameters and objectives in result.json and CSV
  Digits digits = Digits::full;         ///< digits of the numbers in result.json and CSV
  std::optional<PartSizes> parts;       ///< sizes of the links in STEP files
  std::vector<std::string> quantities;  ///< out of Kind::quantities; empty = all
};
template <class Visitor>
void fields(Visitor&& visit, Output& o) {
  visit(field::entry("dir", "folder of the results"), o.dir);
  visit(field::entry("formats", "files to write"), o.formats);
  visit(field::entry("samples", "samples of curves and animations").between(2, 100000), o.samples);
  visit(field::entry("units", "units of the numbers in result.json and CSV"), o.units);
  visit(field::entry("digits", "digits of the numbers in result.json and CSV"), o.digits);
  visit(field::entry("parts", "sizes of the links in STEP files"), o.parts);
}

/// `[optimiser] seeds` of a study: the seeds first, first + 1, ..., each an independent run.
struct Seeds {
  std::int64_t first = 1;  ///< first seed, >= 0
  int count = 1;           ///< number of seeds, >= 1
};
template <class Visitor>
void fields(Visitor&& visit, Seeds& s) {
  visit(field::entry("first", "first seed").not_negative(), s.first);
  visit(field::entry("count", "number of seeds, one run each").between(1, 100000), s.count);
}

/// The part that every study has and the study module reads: a domain finds it here and never reads these
/// keys itself.
struct Common {
  std::string title;                 ///< title of the study; may be empty
  std::string source;                ///< where the numbers come from; may be empty
  Output output;                     ///< files and units
  Seeds seeds;                       ///< seeds of a search
  std::vector<CheckRequest> checks;  ///< what the result is compared with
  std::filesystem::path folder;      ///< folder of the study file: file names in a study are relative to it
  DisplayUnits units;                ///< units of the study's keys: for messages, facts and headlines
};

/// The part of a study that its domain has read.
struct Prepared {
  /// The domain's top-level tables with defaults filled in and in SI units ("mechanism", "target", "sweep",
  /// "optimiser", ...). The common parts, `type` of mechanism and target and `seeds` of the optimiser are
  /// added to it.
  Value canonical;
  /// Runs the study. Called only when the document has no errors, possibly more than once.
  std::function<Result(RunContext&)> run;
  /// The tables of its result without rows, as far as they are known before it runs.
  std::vector<Table> tables = {};
};

/// One kind of study, registered by a domain and chosen by `kind`, `mechanism.type` and `target.type` of the
/// file.
struct Kind {
  std::string kind;       ///< "synthesis"
  std::string mechanism;  ///< "planar.four_bar"; empty = the study has no mechanism of its own
  std::string target;     ///< "path_points"; empty = the study has no target
  std::string summary;    ///< one sentence for the catalogue
  std::string example;    ///< a complete study as TOML: what `linkwright new` writes

  /// Words that `output.quantities` may list; empty = the kind has no such key.
  std::vector<Word> quantities;
  bool seeded = false;  ///< has `optimiser.seeds`
  /// Keys and words of related kinds that this kind does not have, with the reason: for messages, schema and
  /// help.
  std::span<const Absent> absent;

  /// Describes the domain's top-level tables: document.property(field::entry("mechanism", ...),
  /// schema_fields<...>()).
  std::function<void(SchemaWriter& document)> schema;
  /// Reads the domain's tables through the reader of the document, which also takes the problems, all of them
  /// and not just the first. Keys that nobody asked for are reported afterwards by the study module.
  std::function<Prepared(ObjectReader& document, const Common& common)> prepare;
};

}  // namespace linkwright::study
