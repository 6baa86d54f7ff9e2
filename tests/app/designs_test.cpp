// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/closing_row.h"
#include "linkwright/study/design.h"
#include "linkwright/study/study.h"

// Studies of designs, from every kind that finds designs: a study of each, which runs as it is and says the
// same.
namespace linkwright::app {
namespace {

using study::Result;
using study::Solution;

const Table& table_of(const Result& result, const std::string& name) {
  const Table* table = result.table(name);
  if (!table) throw std::runtime_error("there is no table '" + name + "'");
  return *table;
}
const std::vector<double>& column(const Table& table, const std::string& key) {
  const Column* found = table.find(key);
  if (!found) throw std::runtime_error("there is no column '" + table.name + "." + key + "'");
  return found->values;
}
double number(const Value& object, const std::string& key) {
  const Value* found = object.find(key);
  if (!found) throw std::runtime_error("there is no figure '" + key + "'");
  return found->as_number();
}

/// Numbers of the design are written with 15 digits; what follows from them may lose some in an iteration.
constexpr double exact = 1e-9;

void expect_same(const std::vector<double>& found, const std::vector<double>& again, double tolerance,
                 const std::string& what) {
  ASSERT_EQ(found.size(), again.size()) << what;
  ASSERT_FALSE(found.empty()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_NEAR(found[i], again[i], tolerance) << what << ' ' << i;
}

/// A solution by its number from 0, what found it, and its study as run.
struct Designed {
  const Result& found;
  std::size_t number;
  const Result& again;
  const Solution& solution() const { return found.solutions[number]; }
  /// "motion", "motion-2", ...
  std::string numbered(const std::string& name) const {
    return number == 0 ? name : name + "-" + std::to_string(number + 1);
  }
};

/// Root mean square of the distances of the targets from a curve of straight pieces.
double distance_from(const Table& targets, const std::vector<double>& x, const std::vector<double>& y) {
  const auto &tx = column(targets, "target_x_m"), &ty = column(targets, "target_y_m");
  double sum = 0;
  for (std::size_t k = 0; k < tx.size(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double dx = x[i] - x[i - 1], dy = y[i] - y[i - 1];
      const double along =
          std::clamp(((tx[k] - x[i - 1]) * dx + (ty[k] - y[i - 1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      least = std::min(least, std::hypot(x[i - 1] + along * dx - tx[k], y[i - 1] + along * dy - ty[k]));
    }
    sum += least * least;
  }
  return std::sqrt(sum / static_cast<double>(tx.size()));
}

void four_bar_path(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &motion = table_of(d.found, d.numbered("motion"));
  expect_same(column(motion, "coupler_x_m"), column(sweep, "coupler_C_x_m"), exact, "x");
  expect_same(column(motion, "coupler_y_m"), column(sweep, "coupler_C_y_m"), exact, "y");
  const auto& transmission = column(sweep, "coupler_rocker_transmission_angle_rad");
  expect_same(column(motion, "transmission_angle_rad"), transmission, exact, "transmission angle");
  EXPECT_NEAR(number(d.solution().classification, "min_transmission_angle_rad"),
              *std::min_element(transmission.begin(), transmission.end()), 2e-3)
      << "at steps of a degree";
  // For free timing each point is as far from the curve as from where the design meets it.
  const double rms = number(d.solution().objectives, "path_error_rms_m");
  EXPECT_NEAR(distance_from(table_of(d.found, d.numbered("points")), column(sweep, "coupler_C_x_m"),
                            column(sweep, "coupler_C_y_m")),
              rms, 1e-3 * rms + 1e-5)
      << "path error";
}

void slider_crank_path(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &motion = table_of(d.found, d.numbered("motion"));
  expect_same(column(motion, "point_x_m"), column(sweep, "rod_C_x_m"), exact, "x");
  expect_same(column(motion, "point_y_m"), column(sweep, "rod_C_y_m"), exact, "y");
  const auto& slider = column(sweep, "guide_displacement_m");
  const auto [least, most] = std::minmax_element(slider.begin(), slider.end());
  const double stroke = number(d.solution().objectives, "stroke_m");
  EXPECT_NEAR(*most - *least, stroke, 1e-3 * stroke) << "at steps of a degree";
}

void poses(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &motion = table_of(d.found, d.numbered("motion"));
  const std::string point = sweep.find("coupler_C_x_m") ? "coupler_C" : "body_P";
  const std::size_t rows = column(sweep, point + "_x_m").size();
  for (const char* axis : {"x_m", "y_m"}) {
    std::vector<double> found = column(motion, axis);
    ASSERT_EQ(found.size(), rows);
    expect_same(found, column(sweep, point + "_" + axis), exact, axis);
  }
}

void function(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &error = table_of(d.found, d.numbered("structural_error"));
  const bool slider = error.find("output_m") != nullptr;
  std::vector<double> found = column(error, slider ? "output_m" : "output_rad"),
                      again = column(sweep, slider ? "guide_displacement_m" : "rocker_angle_rad");
  const double from = found[0], from_again = again[0];
  for (double& v : found) v -= from;
  for (double& v : again) v -= from_again;
  expect_same(found, again, exact, "output");
}

void strokes(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &motion = table_of(d.found, d.numbered("motion"));
  const bool slider = motion.find("slider_m") != nullptr;
  const auto &found = column(motion, slider ? "slider_m" : "rocker_angle_rad"),
             &again = column(sweep, slider ? "guide_displacement_m" : "rocker_angle_rad");
  std::vector<double> moved = again;
  for (double& v : moved) v += found[0] - again[0];
  expect_same(found, moved, exact, "output");
  const auto [least, most] = std::minmax_element(again.begin(), again.end());
  const double stroke = number(d.solution().objectives, slider ? "stroke_m" : "swing_angle_rad");
  EXPECT_NEAR(*most - *least, stroke, 1e-3 * stroke) << "at steps of a degree";
}

void six_bar_function(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &error = table_of(d.found, d.numbered("structural_error"));
  std::vector<double> again = column(sweep, "output_angle_rad");
  const auto& found = column(error, "output_rad");
  // Structural errors are small where the motion begins, too: outputs differ by a constant.
  const double apart = found[0] - again[0];
  for (double& v : again) v += apart;
  expect_same(found, again, exact, "output");
}

void cam(const Designed& d) {
  const Table &found = table_of(d.found, "cam"), &again = table_of(d.again, "cam");
  for (const char* key : {"profile_x_m", "profile_y_m", "pressure_angle_rad", "lift_m"})
    expect_same(column(found, key), column(again, key), exact, key);
}

void dwell(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &motion = table_of(d.found, d.numbered("motion"));
  std::vector<double> again = column(sweep, "output_angle_rad");
  const auto& found = column(motion, "output_angle_rad");
  const double apart = found[0] - again[0];
  for (double& v : again) v += apart;
  expect_same(found, again, exact, "output");
}

/// The curve of the search, and that of the solver of any linkage.
void any_path(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &curve = table_of(d.found, d.numbered("curve"));
  const std::string point = d.solution().classification.find("traced_point")->as_string();
  for (const char* axis : {"_x_m", "_y_m"}) {
    std::string key = point + axis;
    std::replace(key.begin(), key.end(), '.', '_');
    expect_same(column(curve, std::string("point") + axis), column(sweep, key), exact, key);
  }
}

/// The curve as above, and the turning of the body.
void any_poses(const Designed& d) {
  any_path(d);
  const std::string point = d.solution().classification.find("traced_point")->as_string();
  std::vector<double> found = column(table_of(d.found, d.numbered("curve")), "body_angle_rad"),
                      again =
                          column(table_of(d.again, "sweep"), point.substr(0, point.find('.')) + "_angle_rad");
  const double from = found[0], from_again = again[0];
  for (double& v : found) v = std::cos(v - from);
  for (double& v : again) v = std::cos(v - from_again);
  expect_same(found, again, exact, "cosine of the rotation of the body");
}

/// The output of a function, a link or a slider.
void any_function(const Designed& d) {
  const Table &sweep = table_of(d.again, "sweep"), &error = table_of(d.found, d.numbered("structural_error"));
  const std::string output = d.solution().classification.find("output")->as_string();
  if (output == "slider") {
    expect_same(column(error, "output_m"), column(sweep, "slider_x_m"), exact, "travel");
    return;
  }
  std::vector<double> found = column(error, "output_rad"), again = column(sweep, output + "_angle_rad");
  const double on_link = number(d.solution().classification, "output_angle_on_link_rad");
  for (double& v : found) v = std::cos(v - on_link);
  for (double& v : again) v = std::cos(v);
  expect_same(found, again, exact, "cosine of the output");
}

/// Forces, torques and energies after balancing, by the measures that have no settings.
void balanced(const Designed& d) {
  ASSERT_EQ(d.number, 0u);
  const Table& sweep = d.again.tables.front();
  int compared = 0;
  for (const study::Change& change : d.found.changes) {
    std::vector<double> values = column(sweep, change.quantity);
    if (has_closing_row(sweep)) values.pop_back();  // the first row once more
    double sum = 0, largest = 0;
    for (const double v : values) sum += v * v, largest = std::max(largest, std::abs(v));
    const double scale = exact * (largest + 1);
    if (change.measure == "rms")
      EXPECT_NEAR(std::sqrt(sum / static_cast<double>(values.size())), change.after, scale)
          << change.quantity;
    else if (change.measure == "max_abs")
      EXPECT_NEAR(largest, change.after, scale) << change.quantity;
    else
      continue;
    compared += change.wanted;
  }
  EXPECT_GT(compared, 0) << "what was to become small is among them";
}

void carrier_poses(const Designed& d) {
  const Table &poses = table_of(d.found, "poses"), &sweep = table_of(d.again, "sweep");
  const auto &travel = column(sweep, "travel_m"), &rack = column(sweep, "rack_m");
  for (std::size_t k = 0; k < column(poses, "travel_m").size(); ++k) {
    std::size_t row = 0;
    const auto off = [&](std::size_t i) {
      return std::hypot(travel[i] - column(poses, "travel_m")[k], rack[i] - column(poses, "rack_m")[k]);
    };
    for (std::size_t i = 1; i < travel.size(); ++i)
      if (off(i) < off(row)) row = i;
    ASSERT_LT(off(row), exact) << "every position is in the grid";
    for (const char* key : {"centre_x_m", "centre_y_m", "toe_rad", "camber_rad", "carrier_pitch_rad"})
      ASSERT_NEAR(column(poses, key)[k], column(sweep, key)[row], exact) << key << " of position " << k;
  }
}

void wheel_parameters(const Designed& d) {
  const Table &found = table_of(d.found, "sweep"), &again = table_of(d.again, "sweep");
  for (const char* key : {"travel_m", "toe_rad", "camber_rad", "roll_centre_height_m", "caster_rad"})
    expect_same(column(found, key), column(again, key), exact, key);
}

void region(const Designed& d) {
  const Table& poses = table_of(d.again, "poses");
  const auto worst = std::find(poses.names.begin(), poses.names.end(), "worst");
  ASSERT_NE(worst, poses.names.end());
  EXPECT_NEAR(number(d.solution().objectives, "worst_conditioning"),
              column(poses, "local_conditioning")[static_cast<std::size_t>(worst - poses.names.begin())],
              exact);
}

void pi_joint(const Designed& d) {
  const Table &found = table_of(d.found, "curves"), &again = table_of(d.again, "curves");
  for (const char* key : {"angle_rad", "diagonal_m", "jacobian_m", "transmission_angle_rad"})
    for (const bool last : {false, true})
      EXPECT_NEAR(last ? column(found, key).back() : column(found, key).front(),
                  last ? column(again, key).back() : column(again, key).front(), exact)
          << key;
}

/// Without masses nobody knows where the pin lies: not farther from the ideal path than the clearance allows.
void clearance_lengths(const Designed& d) {
  const Table &turn = table_of(d.found, "turn"), &ideal = table_of(d.again, "values"),
              &errors = table_of(d.again, "errors");
  const auto &x = column(turn, "point_x_m"), &y = column(turn, "point_y_m");
  const auto &ix = column(ideal, "coupler_P_x_m"), &iy = column(ideal, "coupler_P_y_m"),
             &allowed = column(errors, "coupler_P_worst_m");
  ASSERT_EQ(x.size(), ix.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = std::hypot(x[i] - ix[i], y[i] - iy[i]);
    ASSERT_GT(off, 0.1 * allowed[i]) << "the pin is at one side of its bush";
    ASSERT_LT(off, 1.05 * allowed[i]) << "which is to first order the worst case, at row " << i;
  }
}

void clearance_masses(const Designed& d) {
  const Table &turn = table_of(d.found, "turn"), &motion = table_of(d.again, "motion");
  // Both integrate; the design by its own equations, the simulation by those of any linkage.
  constexpr double integrated = 1e-6;
  expect_same(column(turn, "point_x_m"), column(motion, "coupler_P_x_m"), integrated, "x");
  expect_same(column(turn, "point_y_m"), column(motion, "coupler_P_y_m"), integrated, "y");
  const auto& pin = column(motion, "A_N");
  EXPECT_NEAR(number(d.solution().objectives, "least_tension_N"), *std::min_element(pin.begin(), pin.end()),
              1e-3 * *std::max_element(pin.begin(), pin.end()))
      << "the pin force is the tension but for its small part across";
}

const std::map<std::string, std::function<void(const Designed&)>> agreements = {
    {"synthesis/planar.four_bar/path_points", four_bar_path},
    {"synthesis/planar.slider_crank/path_points", slider_crank_path},
    {"synthesis/planar.any/path_points", any_path},
    {"synthesis/planar.any/poses", any_poses},
    {"synthesis/planar.any/function", any_function},
    {"synthesis/planar.four_bar/poses", poses},
    {"synthesis/planar.four_bar/function", function},
    {"synthesis/planar.slider_crank/function", function},
    {"synthesis/planar.four_bar/swing", strokes},
    {"synthesis/planar.slider_crank/stroke", strokes},
    {"synthesis/planar.six_bar/function", six_bar_function},
    {"synthesis/planar.six_bar/dwell", dwell},
    {"synthesis/planar.cam", cam},
    {"balancing/planar.four_bar", balanced},
    {"balancing/planar.linkage", balanced},
    {"balancing/planar.slider_crank", balanced},
    {"balancing/planar.serial_arm", balanced},
    {"synthesis/suspension.corner/carrier_poses", carrier_poses},
    {"synthesis/suspension.corner/wheel_parameters", wheel_parameters},
    {"synthesis/parallel.delta/region", region},
    {"synthesis/parallel.hexa/region", region},
    {"synthesis/parallel.five_bar/region", region},
    {"synthesis/parallel.pi_joint/requirements", pi_joint},
    {"synthesis/clearance.four_bar/path_points", clearance_lengths},
    {"synthesis/clearance.four_bar/phase", clearance_masses},
    {"synthesis/clearance.four_bar/path_points_and_phase", clearance_masses},
};

study::Study study_in(const std::string& text) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "s.toml", diagnostics);
  auto study = study::prepare(document, "s.toml", ".", catalogue(), diagnostics);
  std::string said;
  for (const Diagnostic& d : diagnostics) said += to_string(d) + "\n";
  if (!study || !said.empty()) throw std::runtime_error(said + text);
  return *std::move(study);
}

std::vector<std::string> finders() {
  std::vector<std::string> out;
  for (const study::Kind& kind : catalogue())
    if (kind.kind == "synthesis" || kind.kind == "balancing") out.push_back(name_of(kind));
  return out;
}

class DesignsOf : public ::testing::TestWithParam<std::string> {};

TEST_P(DesignsOf, RunAsTheyAreAndAgree) {
  const auto agree = agreements.find(GetParam());
  ASSERT_NE(agree, agreements.end()) << "say here by which figures a found design and its study agree";
  const auto kind = std::find_if(catalogue().begin(), catalogue().end(),
                                 [](const study::Kind& k) { return name_of(k) == GetParam(); });
  const study::Study source = study_in(kind->example);
  RunContext context;
  const Result found = study::run_study(source, context);
  ASSERT_EQ(found.status, Status::done);
  ASSERT_FALSE(found.solutions.empty());
  for (std::size_t i = 0; i < std::min(found.solutions.size(), study::max_designs); ++i) {
    const Solution& solution = found.solutions[i];
    ASSERT_FALSE(solution.study.is_null()) << to_string(solution.label);
    const std::string text = study::design_toml(solution, i + 1, title_of(source), "linkwright");
    SCOPED_TRACE(text);
    const study::Study design = study_in(text);
    EXPECT_EQ(design.common.title, source.common.title + ": " + to_string(solution.label));
    for (const Dimension dimension : {Dimension::length, Dimension::angle})
      if (source.common.units.chosen(dimension) && design.common.units.chosen(dimension)) {
        EXPECT_EQ(design.common.units.of(dimension).suffix, source.common.units.of(dimension).suffix);
      }
    const Result again = study::run_study(design, context);
    EXPECT_EQ(again.status, Status::done);
    for (const Diagnostic& d : again.diagnostics) ADD_FAILURE() << to_string(d);
    agree->second({found, i, again});
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, DesignsOf, ::testing::ValuesIn(finders()), [](const auto& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

// A drive that rocks goes over its range, within which the machine assembles though it need not turn.
TEST(Designs, OfDrivesThatRockRunOverTheirRange) {
  const study::Study source = study_in(R"(
schema = 1
kind = "synthesis"
[mechanism]
type = "planar.any"
most_links = 6
[target]
type = "path_points"
closed = false
points_mm = [[0, 0], [8, 30], [30, 52], [60, 60], [120, 60], [200, 60], [300, 60], [400, 60]]
[limits]
crank_turns = false
[optimiser]
evaluations = 60000
max_solutions = 6
)");
  RunContext context;
  const Result found = study::run_study(source, context);
  ASSERT_GE(found.solutions.size(), 3U);
  for (std::size_t i = 0; i < found.solutions.size(); ++i) {
    const std::string text = study::design_toml(found.solutions[i], i + 1, title_of(source), "linkwright");
    SCOPED_TRACE(text);
    const Result again = study::run_study(study_in(text), context);
    EXPECT_EQ(again.status, Status::done);
    for (const Diagnostic& d : again.diagnostics) ADD_FAILURE() << to_string(d);
    any_path({found, i, again});
  }
}

// A crank that locks has no determined speed there, and an analysis that goes there has no answer.
TEST(Designs, OfCranksThatDoNotTurnFullyStayOffTheirDeadPoints) {
  const study::Study source = study_in(R"(
schema = 1
kind = "synthesis"
title = "Rocker"
[mechanism]
type = "planar.four_bar"
[mechanism.parameters]
ground_mm = 400
crank_mm = { min = 299, max = 301 }
coupler_mm = { min = 299, max = 301 }
rocker_mm = { min = 299, max = 301 }
coupler_u_mm = { min = 0, max = 300 }
coupler_v_mm = { min = 0, max = 300 }
pivot_x_mm = 0
pivot_y_mm = 0
frame_angle_deg = 0
[target]
type = "path_points"
points_mm = [[100, 400], [150, 410], [200, 415], [250, 410]]
)");
  RunContext context;
  const Result found = study::run_study(source, context);
  ASSERT_FALSE(found.solutions.empty());
  ASSERT_FALSE(found.solutions[0].classification.find("crank_rotates_fully")->as_bool());
  const Result again = study::run_study(
      study_in(study::design_toml(found.solutions[0], 1, title_of(source), "linkwright")), context);
  EXPECT_EQ(again.status, Status::done);
  const auto &swept = column(again.tables.front(), "O1_angle_rad"),
             &shown = column(table_of(found, "motion"), "crank_angle_rad");
  EXPECT_NEAR(std::abs(swept.back() - swept.front()), 0.98 * std::abs(shown.back() - shown.front()), exact);
}

TEST(Designs, AgreementsAreOfKindsThatThereAre) {
  std::vector<std::string> known;
  for (const auto& [name, agree] : agreements) known.push_back(name);
  std::vector<std::string> all = finders();
  std::sort(all.begin(), all.end());
  EXPECT_EQ(known, all);
}

}  // namespace
}  // namespace linkwright::app
