// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_search_tables.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/result.h"

namespace linkwright::planar {

/// The run of a study of machines of any type, and its result: search, refinement, list, drawings and tables.
/// A sort of target has what is its own: its errors, how machines are sorted by them, and words.
class AnyReport {
 public:
  AnyReport(const AnyStudy& study, const study::Common& common);
  virtual ~AnyReport() = default;
  AnyReport(const AnyReport&) = delete;
  AnyReport& operator=(const AnyReport&) = delete;

  /// Runs the study. Called once.
  study::Result make(RunContext& context);

 protected:
  using Column = std::vector<double>;

  /// Looks at the machines of the list, before the refinement and, where there is one, after it.
  virtual void look_at_machines(RunContext& /*context*/, bool /*refined*/) {}
  /// The error that the refinement limits, of a function.
  virtual FunctionErrorLimit error_limit() { return {}; }
  virtual SearchError search_error() const = 0;
  /// The column of the table of machines over which diagrams show their figures.
  virtual std::string compared_by() const = 0;

  /// A machine of the list in a sentence, and its own numbers.
  virtual Sentence label_of(std::size_t i) const = 0;
  virtual void describe(std::size_t i, const FoundLinkage& of, study::Solution& out) const = 0;
  /// Crank angles at which a machine is drawn.
  virtual std::vector<double> crank_angles(std::size_t i, const FoundLinkage& of) const = 0;
  /// Adds tables, diagrams and what a drawing shows beside the machine: `states` are those of the body of its
  /// output at the crank angles, by the solver of any linkage.
  virtual void add_motion(std::size_t i, const FoundLinkage& of, const std::vector<double>& crank,
                          std::span<const PartState<double>> states, study::Scene& scene) = 0;

  /// Columns of the table of machines before the measures that all have, and after them.
  virtual void add_columns(Table& table) const = 0;
  virtual void add_last_columns(Table& /*table*/) const {}

  /// Facts that a study has without a machine, too.
  virtual void introduce(const study::AddFact& /*fact*/) const {}
  /// Headline and facts of the best machine; a remark comes last.
  virtual void tell_of_best(const study::AddFact& fact, const Sentence& links,
                            const Measured& pair_angle) = 0;
  virtual void add_remarks(const study::AddFact& /*fact*/) {}
  /// The error of the machine with the fewest links, for its fact; empty where errors are none.
  virtual Sentence error_in_words(std::size_t /*machine*/) const { return {}; }
  /// The error of a machine outside the limits.
  virtual Measured error_outside(const MachineMeasures& measures) const = 0;

  const std::vector<FoundMachine>& machines() const { return answer_.machines; }
  /// A size of the target (m), and so many sizes as a length.
  double size() const { return motion_.stroke.size; }
  Measured length(double sizes, int digits = 3) const { return millimetres(sizes * size(), digits); }
  /// One value for each machine of the list.
  template <class Value>
  Column column_of(Value&& value) const {
    Column out;
    for (std::size_t i = 0; i < answer_.machines.size(); ++i) out.push_back(value(i));
    return out;
  }
  template <class Value>
  Column measures_of(Value&& value) const {
    return column_of([&](std::size_t i) { return value(answer_.machines[i].measures); });
  }
  /// Keeps machines of the list with these numbers, in this order.
  void keep(std::span<const std::size_t> kept);
  /// "-3" for the third machine, empty for the first: ends of the names of tables.
  static std::string suffix_of(std::size_t i);

  const AnyStudy& s_;
  const study::Common& common_;
  const MotionTarget& motion_;
  const MachineLimits limits_;
  TypeSearchAnswer answer_;
  ListFigures figures_;
  study::Result result_;

 private:
  void add_solution(std::size_t i);
  void draw(std::size_t i, const FoundLinkage& of, study::Solution& out);
  std::string limited_by(const FoundMachine& found) const;
  void add_machine_table();
  void add_findings();
  void add_simplest(const study::AddFact& fact) const;
};

}  // namespace linkwright::planar
