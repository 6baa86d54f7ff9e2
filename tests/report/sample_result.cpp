// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/sample_result.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/study/write.h"

namespace linkwright::report::test {
namespace {

using Complex = std::complex<double>;
constexpr std::array<double, 18> target_x = {0.50, 0.40, 0.30, 0.20, 0.10, 0.05, 0.02, 0.00, 0.00,
                                             0.03, 0.10, 0.15, 0.20, 0.30, 0.40, 0.50, 0.60, 0.60};
constexpr std::array<double, 18> target_y = {1.10, 1.10, 1.10, 1.00, 0.90, 0.75, 0.60, 0.50, 0.40,
                                             0.30, 0.25, 0.20, 0.30, 0.40, 0.50, 0.70, 0.90, 1.00};

struct Linkage {
  double ground, crank, coupler, rocker, u, v, x, y, frame, start;
};

struct Pose {
  Complex o, b0, a, b, c;
  double transmission;  // rad
};

Pose pose(const Linkage& l, double angle) {
  Pose p;
  p.o = {l.x, l.y};
  p.b0 = p.o + std::polar(l.ground, l.frame);
  p.a = p.o + std::polar(l.crank, l.frame + angle);
  const Complex d = p.b0 - p.a;
  const double cosine =
      (l.coupler * l.coupler + std::norm(d) - l.rocker * l.rocker) / (2 * l.coupler * std::abs(d));
  const double theta = std::abs(cosine) > 1 ? nan : std::arg(d) + std::acos(cosine);
  p.b = p.a + std::polar(l.coupler, theta);
  p.c = p.a + Complex(l.u, l.v) * std::polar(1.0, theta);
  const double folded = std::abs(std::remainder(std::arg((p.b - p.b0) / (p.b - p.a)), pi));
  p.transmission = std::isnan(theta) ? nan : folded;
  if (std::isnan(theta)) p.b = p.c = {nan, nan};
  return p;
}

struct Sweep {
  study::Scene scene;
  Table table;
  double error = 0;
};

Sweep sweep(const Linkage& l, const std::string& name, const std::string& title) {
  Sweep out;
  study::Scene& scene = out.scene;
  scene.name = name;
  scene.title = title;
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  const Pose first = pose(l, 0);
  scene.points = {{"O", {first.o.real()}, {first.o.imag()}},
                  {"B0", {first.b0.real()}, {first.b0.imag()}},
                  {"A", {}, {}},
                  {"B", {}, {}},
                  {"C", {}, {}}};
  std::vector<double> transmission;
  for (int i = 0; i <= 360; ++i) {
    const double angle = 2 * pi * i / 360;
    const Pose p = pose(l, angle);
    scene.input.push_back(angle);
    scene.status.push_back(std::isnan(p.transmission) ? "no_assembly" : "done");
    const Complex moving[] = {p.a, p.b, p.c};
    for (std::size_t k = 0; k < 3; ++k) {
      scene.points[k + 2].x.push_back(moving[k].real());
      scene.points[k + 2].y.push_back(moving[k].imag());
    }
    transmission.push_back(p.transmission);
  }
  using Style = study::Scene::BodyStyle;
  using Joint = study::Scene::JointStyle;
  scene.bodies = {{"ground", {0, 1}, Style::ground},
                  {"crank", {0, 2}, Style::bar},
                  {"coupler", {2, 3, 4}, Style::plate},
                  {"rocker", {1, 3}, Style::bar}};
  scene.joints = {{"O", 0, Joint::ground_pivot},
                  {"B0", 1, Joint::ground_pivot},
                  {"A", 2, Joint::pivot},
                  {"B", 3, Joint::pivot},
                  {"C", 4, Joint::tracer}};
  scene.traces = {{4, "coupler point", true}};
  study::Scene::Target target;
  target.name = "target";
  target.closed = true;
  for (std::size_t i = 0; i < target_x.size(); ++i) {
    const double angle = l.start + pi / 9 * static_cast<double>(i);
    const Pose p = pose(l, angle);
    target.x.push_back(target_x[i]);
    target.y.push_back(target_y[i]);
    target.achieved_x.push_back(p.c.real());
    target.achieved_y.push_back(p.c.imag());
    target.achieved_input.push_back(std::isnan(p.transmission) ? nan : angle);
    if (!std::isnan(p.transmission)) out.error += std::norm(p.c - Complex(target_x[i], target_y[i]));
  }
  scene.targets = {target};
  out.table.name = "motion of " + name;
  out.table.add("crank_angle_rad", "crank angle (rad)", scene.input);
  out.table.add("coupler_x_m", "coupler point x (m)", scene.points[4].x);
  out.table.add("coupler_y_m", "coupler point y (m)", scene.points[4].y);
  out.table.add("transmission_angle_rad", "transmission angle (rad)", transmission);
  out.table.status = scene.status;
  return out;
}

}  // namespace

study::Result sample_result() {
  struct Named {
    const char* label;
    Linkage linkage;
    const char* type;
    std::vector<Sentence> defects;
  };
  // Boskovic 2018, Table 4.1, columns 6 and 5; the third does not rotate fully.
  const Named list[] = {
      {"crank-rocker, open",
       {1.10427, 0.4197, 0.98857, 0.5824, 0.40047, 0.44529, 0.28691, 0.09855, 0.33948, 0.84827},
       "crank-rocker",
       {}},
      {"crank-rocker, open (2)",
       {1.00429, 0.4218, 0.87821, 0.58013, 0.35907, 0.38081, 0.26886, 0.17715, 0.29294, 0.88595},
       "crank-rocker",
       {}},
      {"double rocker, open",
       {0.9, 0.62, 0.7, 0.6, 0.35, 0.38, 0.3, 0.2, 0.3, 1.5},
       "triple rocker",
       {"circuit", "crank does not rotate fully"}},
  };
  study::Result result;
  int number = 0;
  for (const auto& [label, l, type, defects] : list) {
    const std::string name = fmt::format("solution-{}", ++number);
    Sweep s = sweep(l, name, label);
    study::Solution solution;
    solution.label = label;
    solution.scene = name;
    solution.parameters = {{"ground_m", "ground length", l.ground, 0, 50},
                           {"crank_m", "crank length", l.crank, 0, 50},
                           {"coupler_m", "coupler length", l.coupler, 0, 50},
                           {"rocker_m", "rocker length", l.rocker, 0.1, l.rocker},
                           {"coupler_u_m", "tracing point along the coupler", l.u, -50, 50},
                           {"coupler_v_m", "tracing point beside the coupler", l.v, -50, 50},
                           {"pivot_x_m", "crank pivot x", l.x, l.x, l.x},
                           {"frame_angle_rad", "angle of the ground link", l.frame, 0, 2 * pi}};
    solution.objectives["path_error_sum_sq_m2"] = s.error;
    solution.classification["type"] = type;
    solution.classification["branch"] = "open";
    solution.classification["transmission_angle_min_rad"] = 0.3 + 0.1 * number;
    solution.defects = defects;
    if (number < 3) {  // the last one has no study
      solution.study["schema"] = 1;
      solution.study["kind"] = "analysis";
      solution.study["title"] = "Four-bar through 18 points: " + std::string(label);
      solution.study["mechanism"]["type"] = "planar.four_bar";
      solution.study["mechanism"]["parameters"]["crank_mm"] = 1000 * l.crank;
    }
    result.solutions.push_back(solution);
    study::Plot path{"coupler",
                     "Coupler point over the turn",
                     s.table.name,
                     "crank_angle_rad",
                     {"coupler_x_m", "coupler_y_m"},
                     study::Plot::Style::line,
                     false,
                     name};
    study::Plot angle{"transmission",
                      "Transmission angle over the turn",
                      s.table.name,
                      "crank_angle_rad",
                      {"transmission_angle_rad"},
                      study::Plot::Style::line,
                      false,
                      name};
    result.plots.push_back(path);
    result.plots.push_back(angle);
    result.scenes.push_back(std::move(s.scene));
    result.tables.push_back(std::move(s.table));
  }
  const double best = result.solutions.front().objectives["path_error_sum_sq_m2"].as_number();
  result.headline =
      fmt::format("A crank-rocker follows the 18 points with a sum of squared distances of {:.6g} m²", best);
  result.facts = {{"path error (sum of squares)", fmt::format("{:.6g} m²", best), study::Fact::Verdict::good},
                  {"largest distance",
                   say("{} at point {}; root mean square of all points {}", millimetres(0.0401),
                       at_place("point", plain_number(7)), millimetres(0.0224)),
                   study::Fact::Verdict::plain},
                  {"type", "crank-rocker, open", study::Fact::Verdict::plain},
                  {"smallest transmission angle", "22.9°", study::Fact::Verdict::bad},
                  {"closure residual", "1.1e-16 m", study::Fact::Verdict::plain}};
  const auto add_check = [&result](const char* quantity, double value, const char* limit) {
    study::Check check;
    check.quantity = quantity;
    check.value = value;
    check.limit = limit;
    check.passed = true;
    result.checks.push_back(check);
  };
  add_check("best.path_error_sum_sq_m2", best, "at_most 0.0091");
  add_check("statistics.success_rate", 1, "at_least 1");
  result.statistics["best"] = best;
  result.statistics["median"] = 1.004 * best;
  result.statistics["success_rate"] = 1.0;
  result.statistics["evaluations"] = 240000;
  result.log = Value::array();
  for (int seed = 1; seed <= 12; ++seed) {
    Value entry, history = Value::array();
    const double end = best * (1 + 0.01 * ((seed * 7) % 12 / 4));
    for (int i = 0; i < 40; ++i) history.push_back(end * (1 + std::exp(7 - 0.3 * i - 0.2 * (seed % 5))));
    entry["seed"] = seed;
    entry["best"] = end;
    entry["evaluations"] = 20000 + 13 * seed;
    entry["status"] = "done";
    entry["history"] = history;
    result.log.push_back(entry);
  }
  result.comparisons = {{"Table 4.1, column 6", "Boskovic 2018", 0.00908, 0.0090983, "reproduced",
                         "with the printed digits of the design"},
                        {"Table 4.1, column 1", "Kunjur and Krishnamurty 1997", 0.043, 0.0660725,
                         "not reproduced", "the printed design gives another error"}};
  Diagnostic remark;
  remark.severity = Diagnostic::Severity::warning;
  remark.key = "constraint[1]";
  remark.message = "transmission angle falls below 30° on 41 % of the turn";
  remark.hint = "enable the constraint transmission_angle";
  result.diagnostics.push_back(remark);
  return result;
}

study::Result sample_simulation() {
  using Body = study::Scene::BodyStyle;
  using Joint = study::Scene::JointStyle;
  using Quantity = study::Scene::Quantity;
  constexpr double crank = 0.1, rod = 0.3, speed = 2 * pi;  // m, m, rad/s
  enum { O, A, B, wall, rim, left, right, block };
  study::Scene scene;
  scene.name = "motion";
  scene.title = "Slider-crank with a spring";
  scene.input_key = "time_s";
  scene.input_label = "time";
  scene.points = {{"O", {0}, {0}},          {"A", {}, {}},   {"B", {}, {}},
                  {"wall", {0.6}, {0}},     {"rim", {}, {}}, {"left", {0.15}, {-0.02}},
                  {"right", {0.5}, {-0.02}}};
  for (const char* corner : {"1", "2", "3", "4"}) scene.points.push_back({corner, {}, {}});
  std::vector<double> force_x, force_y, torque, slider_speed;
  const auto put = [&](int point, double x, double y) {
    scene.points[static_cast<std::size_t>(point)].x.push_back(x);
    scene.points[static_cast<std::size_t>(point)].y.push_back(y);
  };
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.01 * i, c = std::cos(speed * t), s = std::sin(speed * t);
    const double along = std::sqrt(rod * rod - crank * crank * s * s), x = crank * c + along;
    scene.input.push_back(t);
    put(A, crank * c, crank * s);
    put(B, x, 0);
    put(rim, 0.06 * c, 0.06 * s);
    for (int k = 0; k < 4; ++k) put(block + k, x + (k == 0 || k == 3 ? -0.025 : 0.025), k < 2 ? -0.02 : 0.02);
    force_x.push_back(20 + 30 * c);
    force_y.push_back(30 * s);
    torque.push_back(-2 * s);
    slider_speed.push_back(-crank * speed * s * (1 + crank * c / along));
  }
  scene.bodies = {
      {"ground", {O, wall}, Body::ground}, {"guide", {left, right}, Body::guide},
      {"spring", {B, wall}, Body::spring}, {"crank", {O, A}, Body::bar},
      {"rod", {A, B}, Body::bar},          {"slider", {block, block + 1, block + 2, block + 3}, Body::plate}};
  scene.joints = {{"O", O, Joint::ground_pivot}, {"A", A, Joint::pivot}, {"B", B, Joint::pivot}};
  scene.circles = {{"wheel", O, rim}};
  scene.vectors = {{"crank on rod at A", Quantity::force, "N", A, force_x, force_y, "F A"},
                   {"weight of the slider", Quantity::force, "N", B, {0}, {-10}, "G"},
                   {"velocity of B", Quantity::velocity, "m/s", B, slider_speed, {0}, "v B"}};
  scene.moments = {{"drive torque", "N m", O, torque, "M"}};

  study::Scene chain;
  chain.name = "chain";
  chain.title = "Chain of 81 bars";
  chain.input_key = "time_s";
  chain.input_label = "time";
  for (int i = 0; i <= 40; ++i) chain.input.push_back(0.05 * i);
  for (int k = 0; k <= 81; ++k) {
    study::Scene::Point point{std::to_string(k), {}, {}};
    for (const double t : chain.input) {
      point.x.push_back(k * 0.0125);
      point.y.push_back(0.1 * std::sin(pi * k / 27) * std::cos(speed * t));
    }
    chain.points.push_back(point);
    chain.joints.push_back({std::to_string(k), k, Joint::pivot});
    if (k > 0) chain.bodies.push_back({"bar " + std::to_string(k), {k - 1, k}, Body::bar});
  }

  study::Result result;
  result.headline = "The force at A reaches 50 N.";
  Table table;
  table.name = "simulation";
  table.add("time_s", "time (s)", scene.input);
  table.add("A_x_N", "A x, crank on rod (N)", force_x);
  table.add("A_y_N", "A y, crank on rod (N)", force_y);
  result.tables = {table};
  study::Plot polar;
  polar.name = "polar";
  polar.title = "Polar diagram of the force at A";
  polar.table = "simulation";
  polar.x = "time_s";
  polar.y = {"A_x_N", "A_y_N"};
  polar.style = study::Plot::Style::polar;
  polar.scene = "motion";
  study::Plot line = polar;
  line.name = "force";
  line.title = "Force at A";
  line.style = study::Plot::Style::line;
  result.plots = {line, polar};
  result.scenes = {scene, chain};
  return result;
}

study::Result sample_maps() {
  study::Result result;
  result.headline = "The workspace is a ball.";
  const auto slices = [&result](const char* name, const std::vector<double>& levels) {
    std::vector<double> x, y, z, index;
    for (const double level : levels)
      for (int j = -10; j <= 10; ++j)
        for (int i = -10; i <= 10; ++i) {
          x.push_back(0.05 * i);
          y.push_back(0.05 * j);
          z.push_back(level);
          const double share = std::hypot(x.back(), y.back(), level + 0.7) / 0.4;
          index.push_back(share <= 1 ? 1 - share : nan);
        }
    Table table;
    table.name = name;
    table.add("x_m", "x (m)", x);
    table.add("y_m", "y (m)", y);
    table.add("z_m", "z (m)", z);
    table.add("transmission", "transmission index", index);
    result.tables.push_back(table);
    study::Plot plot;
    plot.name = plot.table = name;
    plot.title = "Workspace: transmission index";
    plot.x = "x_m";
    plot.y = {"y_m", "transmission"};
    plot.style = study::Plot::Style::map;
    plot.group = levels.size() > 1 ? "z_m" : "";
    result.plots.push_back(plot);
  };
  slices("slices", {-0.9, -0.8, -0.7, -0.5});
  slices("slice", {-0.7});
  return result;
}

study::Result sample_compared() {
  study::Result result;
  result.headline = "3 studies compared: 1 of 2 results differ.";
  study::Scene scene;
  scene.name = "turn";
  scene.title = "short";
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  scene.runs = {"short", "middle", "long"};
  Table sweep, draws;
  sweep.name = "sweep";
  draws.name = "draws-of-each";
  for (int i = 0; i <= 36; ++i) scene.input.push_back(i * pi / 18);
  sweep.add("crank_angle_rad", "crank angle (rad)", scene.input);
  std::vector<double> study, few, many;
  study::Plot heights;
  heights.name = "height";
  heights.title = "Height";
  heights.table = "sweep";
  heights.x = "crank_angle_rad";
  heights.scene = "turn";
  for (int run = 0; run < 3; ++run) {
    const double length = 0.1 + 0.02 * run;
    study::Scene::Point tip{"A", {}, {}};
    for (const double angle : scene.input) {
      tip.x.push_back(length * std::cos(angle));
      tip.y.push_back(length * std::sin(angle));
    }
    const int first = static_cast<int>(scene.points.size());
    scene.points.push_back({"O", {0}, {0}});
    scene.points.push_back(tip);
    scene.points.push_back({"B", {0.5 * length}, {0.8 * length}});
    const auto style = run == 1 ? study::Scene::BodyStyle::plate : study::Scene::BodyStyle::bar;
    std::vector<int> points = {first, first + 1};
    if (run == 1) points.push_back(first + 2);
    scene.bodies.push_back({"crank of " + scene.runs[static_cast<std::size_t>(run)], points, style, run});
    scene.traces.push_back({first + 1, "A", true, run});
    const std::string key = "height_" + std::to_string(run + 1) + "_m";
    sweep.add(key, scene.runs[static_cast<std::size_t>(run)] + ": height (m)", tip.y);
    heights.y.push_back(key);
    for (int k = 0; k < 80; ++k) {
      study.push_back(run + 1);
      few.push_back(k < 4 ? length + 0.001 * k : nan);
      many.push_back(length + 0.01 * std::sin(k));
    }
  }
  scene.joints = {{"O", 0, study::Scene::JointStyle::ground_pivot}};
  result.scenes.push_back(scene);
  draws.add("study", "study", study);
  draws.add("few_m", "length (m)", few);
  draws.add("many_m", "length (m)", many);
  result.tables = {sweep, draws};
  result.plots.push_back(heights);
  for (const char* key : {"few_m", "many_m"}) {
    study::Plot plot;
    plot.name = plot.title = key;
    plot.table = draws.name;
    plot.y = {key};
    plot.style = study::Plot::Style::histogram;
    plot.group = "study";
    plot.group_names = scene.runs;
    result.plots.push_back(plot);
  }
  return result;
}

study::Result sample_diagrams() {
  study::Result result;
  result.headline = "Solved to rounding.";
  study::Scene scene;
  scene.name = "turn";
  scene.title = "Crank";
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  scene.points = {{"O", {0}, {0}}, {"A", {}, {}}};
  scene.bodies = {{"crank", {0, 1}, study::Scene::BodyStyle::bar}};
  scene.joints = {{"O", 0, study::Scene::JointStyle::ground_pivot}};
  for (int i = 0; i <= 360; ++i) {
    scene.input.push_back(i * pi / 180);
    scene.points[1].x.push_back(0.1 * std::cos(scene.input.back()));
    scene.points[1].y.push_back(0.1 * std::sin(scene.input.back()));
  }
  Table table;
  table.name = "turn";
  table.add("crank_angle_rad", "crank angle (rad)", scene.input);
  table.add("body_angle_rad", "angle of the body (rad)", scene.input);
  std::vector<std::string> waves;
  for (int k = 0; k < 9; ++k) {
    std::vector<double> values;
    for (const double angle : scene.input) values.push_back(std::sin(angle + k));
    waves.push_back(fmt::format("wave_{}_m_per_s", k));
    table.add(waves.back(), fmt::format("wave {} (m/s)", k), values);
  }
  std::vector<double> tiny;
  for (int i = 0; i <= 360; ++i) tiny.push_back(std::pow(10, -5 - i / 10.0));
  table.add("error_m2", "squared error (m2)", tiny);
  std::vector<std::string> forces;
  for (int k = 0; k < 7; ++k)
    for (const char axis : {'x', 'y'}) {
      std::vector<double> values;
      for (const double angle : scene.input)
        values.push_back((k + 1) * (axis == 'x' ? std::cos(angle) : std::sin(angle)));
      forces.push_back(fmt::format("O{}_{}_N", k, axis));
      table.add(forces.back(), fmt::format("O{} {} (N)", k, axis), values);
    }
  const auto add = [&](const char* name, std::vector<std::string> y) -> study::Plot& {
    study::Plot plot;
    plot.name = plot.title = name;
    plot.table = plot.scene = "turn";
    plot.x = "crank_angle_rad";
    plot.y = std::move(y);
    result.plots.push_back(plot);
    return result.plots.back();
  };
  add("angle", {"body_angle_rad"});
  add("seven", {waves.begin(), waves.begin() + 7});
  add("nine", waves);
  add("errors", {"error_m2"}).logarithmic_y = true;
  add("roses", forces).style = study::Plot::Style::polar;
  result.scenes = {std::move(scene)};
  result.tables = {std::move(table)};
  result.log = Value::array();
  for (int seed = 1; seed <= 2; ++seed) {
    Value entry, history = Value::array();
    for (int i = 0; i < 20; ++i) history.push_back(std::pow(10, -1.5 * (i + seed)));
    if (seed == 2) history.push_back(0.0);
    entry["seed"] = seed;
    entry["best"] = history.as_array().back().as_number();
    entry["status"] = "done";
    entry["history"] = history;
    result.log.push_back(entry);
  }
  return result;
}

std::string sample_json(const study::Result& result) {
  Value doc;
  doc["schema"] = 1;
  doc["status"] = to_string(result.status);
  doc["checks"] = Value::array();
  for (const auto& c : result.checks) {
    Value v;
    v["quantity"] = c.quantity;
    v["value"] = c.value;
    v["limit"] = c.limit;
    v["passed"] = c.passed;
    doc["checks"].push_back(v);
  }
  doc["solutions"] = Value::array();
  for (const auto& s : result.solutions) {
    Value v;
    v["label"] = to_string(s.label);
    for (const auto& p : s.parameters) v["parameters"][p.key] = p.value;
    v["objectives"] = s.objectives;
    v["classification"] = s.classification;
    v["defects"] = Value::array();
    for (const Sentence& defect : s.defects) v["defects"].push_back(to_string(defect));
    doc["solutions"].push_back(v);
  }
  doc["statistics"] = result.statistics;
  doc["log"] = result.log;
  doc["tables"] = Value::array();
  for (const auto& t : result.tables) {
    Value v, status = Value::array();
    v["name"] = t.name;
    for (const auto& c : t.columns) {
      Value column;
      column["key"] = c.key;
      column["label"] = c.label;
      v["columns"].push_back(column);
      v["data"].push_back(Value(c.values));
    }
    for (const auto& s : t.status) status.push_back(s);
    Value column;
    column["key"] = "status";
    column["label"] = "status";
    v["columns"].push_back(column);
    v["data"].push_back(status);
    doc["tables"].push_back(v);
  }
  doc["diagnostics"] = Value::array();
  for (const auto& d : result.diagnostics) {
    Value v;
    v["severity"] = "warning";
    v["key"] = d.key;
    v["message"] = to_string(d.message);
    v["hint"] = to_string(d.hint);
    doc["diagnostics"].push_back(v);
  }
  return study::to_json_readable(doc);
}

std::string sample_study() {
  return "schema = 1\nkind   = \"synthesis\"\ntitle  = \"Four-bar through 18 points of a closed "
         "path\"\n\n[mechanism]\ntype   = "
         "\"planar.four_bar\"\nbranch = \"open\"\n";
}

}  // namespace linkwright::report::test
