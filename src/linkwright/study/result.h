// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/core/value.h"
#include "linkwright/study/scene.h"

namespace linkwright::study {

/// One `[[check]]` of a study and how it came out.
struct Check {
  std::string quantity;  ///< "best.path_error_sum_sq_m2"
  double value = 0;      ///< NaN when the result has no such quantity
  std::string limit;     ///< "at_most 0.009029"
  bool passed = false;   ///< true if the value meets the limit
  std::string at;        ///< row of the table: "travel_mm = 50, rack_mm = 0"; empty = no row
  std::string message;   ///< says why there is no value, with keys and numbers as the study writes them
};

/// One line of the headline panel of a report and of the summary on the terminal.
struct Fact {
  Sentence label;  ///< "path error (sum of squares)"
  Sentence text;   ///< "5.567 N m at 343°": its first number that says no place is the value
  /// How a fact is to be seen.
  enum class Verdict {
    plain,                     ///< neither good nor bad
    good,                      ///< meets what was asked for
    bad                        ///< does not
  } verdict = Verdict::plain;  ///< its verdict
  /// The label as an identifier, in whichever units people are shown it; empty = that of the label as it is.
  std::string key = {};
  /// The value of a fact whose text gives it in words: 360° for "assembles over the full turn".
  std::optional<Measured> number = {};
  /// @returns `number` if there is one, else the first number of the text that says no place
  std::optional<Measured> value() const { return number ? number : text.value(); }
};
constexpr std::array<EnumName<Fact::Verdict>, 3> names(Fact::Verdict) {
  using Verdict = Fact::Verdict;
  return {{{Verdict::plain, "plain"}, {Verdict::good, "good"}, {Verdict::bad, "bad"}}};
}

/// One designed or fixed number of the answer.
struct Parameter {
  std::string key;    ///< key with unit: "crank_m"
  std::string label;  ///< "crank length"
  double value = 0;   ///< in the unit of the key
  double lower = 0,   ///< lower bound; -infinity = none
      upper = 0;      ///< upper bound, equal to the lower one of a fixed number; infinity = none
};

/// A diagram of columns of one table.
struct Plot {
  /// Kinds of diagrams.
  enum class Style {
    line,    ///< a line through the rows
    points,  ///< a mark at each row
    /// Counts of the values of y; a group column gives one outline for each of its values.
    histogram,
    /// y lists columns in pairs (x, y), each pair a curve such as the hodograph of a force or the path of a
    /// point; the axes are equal and the origin is marked.
    polar,
    /// y lists two columns, the second coordinate and a value; each row is a place (x, y) of a regular grid
    /// that is coloured by its value. Axes are equal; a group column gives one map for each of its values,
    /// all with one scale of colours.
    map
  };
  std::string name;   ///< "transmission"
  std::string title;  ///< "Transmission angle over the turn"
  std::string table;  ///< name of the table
  std::string x;      ///< column key; unused for a histogram; polar: the input, needed only with `scene`
  std::vector<std::string> y;  ///< column keys, as the style needs them
  Style style = Style::line;   ///< kind of diagram
  bool logarithmic_y = false;  ///< true if the y axis is logarithmic
  std::string scene;  ///< x is the input of this scene: the cursor follows the animation; empty = not linked
  /// Column whose values, few and repeated, split the rows into one curve each: the rack of a travel-rack
  /// grid; empty = one curve of all rows.
  std::string group = {};
  /// The names of the values 1, 2, ... of the group column; empty = by their numbers.
  std::vector<std::string> group_names = {};
  /// A region to stay in: two columns of the table, its lower and its upper edge (NaN = none there).
  struct Band {
    std::string lower,  ///< column key of the lower edge
        upper;          ///< column key of the upper edge
    std::string label;  ///< "target toe"
  };
  /// Regions to stay in.
  std::vector<Band> bands = {};
  /// Table with the same columns whose curves are drawn pale behind: the design before; empty = none.
  std::string baseline = {};
  /// x points up, as the travel of a wheel does in a bump-steer diagram; for lines and points.
  bool upright = false;
};
constexpr std::array<EnumName<Plot::Style>, 5> names(Plot::Style) {
  using Style = Plot::Style;
  return {{{Style::line, "line"},
           {Style::points, "points"},
           {Style::histogram, "histogram"},
           {Style::polar, "polar"},
           {Style::map, "map"}}};
}

/// One row "published / ours / verdict".
struct Comparison {
  std::string item;      ///< "Boskovic 2018, Table 4.1, column 6"
  std::string source;    ///< where it is printed
  double published = 0;  ///< number as printed
  double ours = 0;       ///< number as computed
  std::string verdict;   ///< "reproduced", "corrected", "not reproduced", "improved"
  std::string note;      ///< remark; may be empty
};
/// Rows in the order of the source.
using Comparisons = std::vector<Comparison>;

/// One row "before and after" of a change of design.
struct Change {
  std::string quantity;  ///< column: "shaking_force_N"
  std::string label;     ///< for people, with unit
  std::string measure;   ///< measure of the column: "rms"
  double before = 0,     ///< measure of the design before
      after = 0;         ///< measure of the design after
  bool wanted = false;   ///< true if it was to be minimised
  /// @returns signed change in per cent of before; NaN when that is 0
  double percent() const { return before != 0 ? 100 * (after / before - 1) : nan; }
};

/// One of the distinct answers of a synthesis.
struct Solution {
  Sentence label;                     ///< "crank-rocker, open"
  std::vector<Parameter> parameters;  ///< designed and fixed numbers
  Value objectives;                   ///< object of numbers by key
  Value classification;               ///< object: type, branch, sense, transmission angle, ...
  std::vector<Sentence> defects;      ///< what is wrong with the answer; empty = nothing
  std::string scene;                  ///< name of its scene; empty = none
  /// A study of this design to continue with, as study/design.h completes it. The domain gives the tables, in
  /// any units: the mechanism with the found numbers and what an analysis of it needs. null = there is none.
  Value study;
};

/// An obstacle to an answer: a limit that is exceeded, a place that cannot be reached.
struct Trouble {
  /// A coordinate of the place of an obstacle.
  struct Place {
    std::string key;   ///< key with unit: "crank_angle_rad", "time_s"
    double value = 0;  ///< in the unit of the key
  };
  std::string what;          ///< "torque of drive 2", "no_assembly"
  std::vector<Place> where;  ///< input, time and place, as far as they are known
  /// The used part of the limit: 1.96 for 96 % more than allowed. +infinity = it cannot be passed at all, as
  /// where a drive would need a force without bound. NaN = cannot be compared.
  double share = nan;
  Sentence why;  ///< one sentence
};

/// A file of another program that goes with a result: a list of points for CAD.
struct ResultFile {
  std::string name;  ///< name of the file without folder: "list-hardpoints.txt"
  std::string text;  ///< its content, UTF-8
};

/// The result of a study. Tables, scenes and plots are all that a report draws.
struct Result {
  Status status = Status::done;     ///< done, or why the result is not complete
  Sentence headline;                ///< the answer in one sentence
  std::vector<Fact> facts;          ///< what is to be seen at once, in order
  std::vector<Solution> solutions;  ///< best first
  Value statistics;                 ///< object: best, median, worst, success_rate, evaluations, ...
  /// Array of objects, one a seed: `seed`, `status`, `best` (final cost, null if infeasible), `evaluations`,
  /// and `history`, an array of { evaluations, best } for each better candidate.
  Value log;
  std::vector<Table> tables;            ///< all numbers
  std::vector<Scene> scenes;            ///< mechanisms in motion
  std::vector<Plot> plots;              ///< diagrams of the tables
  std::vector<Comparison> comparisons;  ///< with published numbers
  std::vector<Change> changes;          ///< before and after
  std::vector<Check> checks;            ///< checks of the study
  std::vector<Trouble> troubles;        ///< in the order in which they occur; see study/answer.h
  Diagnostics diagnostics;              ///< remarks and warnings about the answer
  std::vector<ResultFile> files;        ///< files for other programs

  /// @param name name of a table
  /// @returns the table; nullptr if there is none
  const Table* table(std::string_view name) const {
    for (const Table& t : tables)
      if (t.name == name) return &t;
    return nullptr;
  }
};

}  // namespace linkwright::study
