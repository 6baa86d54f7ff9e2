#include "linkwright/suspension/link_synthesis.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "linkwright/core/check.h"
#include "linkwright/suspension/link_fit_direct.h"

namespace linkwright::suspension {
namespace {

constexpr std::array axes{"x", "y", "z"};

double& component(Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
double component(const Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

struct Totals {
  double sum = 0, square = 0, largest = 0;
};

Totals add_up(LinkType type, std::span<const double> errors, std::size_t positions) {
  Totals t;
  const std::size_t count = positions * static_cast<std::size_t>(error_count(type));
  const std::size_t parts = errors.size() / count;
  for (std::size_t i = 0; i < errors.size(); i += parts) {
    double square = 0;
    for (std::size_t k = 0; k < parts; ++k) square += errors[i + k] * errors[i + k];
    const double error = std::sqrt(square);
    t.sum += error;
    t.square += square;
    t.largest = std::max(t.largest, error);
  }
  return t;
}

double objective_of(const Totals& t, LinkType type, std::size_t positions, ErrorTotal total) {
  return total == ErrorTotal::sum ? t.sum : t.sum / static_cast<double>(positions * error_count(type));
}

struct Coordinate {
  bool body = false;
  std::size_t point = 0;
  int axis = 0;
};

/// What the objective is computed from; shared by the copies of the problem.
struct LinkData {
  LinkMotion motion;
  GuideLink given;
  std::vector<Coordinate> free;
  std::vector<optimise::Variable> variables;
  ErrorTotal total = ErrorTotal::mean;

  void place(GuideLink& link, std::size_t variable, double value) const {
    const Coordinate& c = free[variable];
    component(c.body ? link.body[c.point] : link.carrier[c.point], c.axis) = value;
  }
};

std::shared_ptr<LinkData> link_data(const CarrierTargets& targets, const LinkTask& task, ErrorTotal total) {
  LINKWRIGHT_REQUIRE(static_cast<int>(task.body.size()) == body_points(task.type) &&
                         static_cast<int>(task.carrier.size()) == carrier_points(task.type),
                     "link '{}' of type {} has boxes for {} points on the body and {} on the carrier",
                     task.name, name_of(task.type), task.body.size(), task.carrier.size());
  auto data = std::make_shared<LinkData>();
  data->motion = link_motion(targets, task.moved_by_rack);
  LINKWRIGHT_REQUIRE(data->motion.size() >= 1, "link '{}': no position besides the reference", task.name);
  data->given = {.name = task.name, .type = task.type, .moved_by_rack = task.moved_by_rack};
  data->total = total;
  for (const bool body : {true, false}) {
    const auto& boxes = body ? task.body : task.carrier;
    for (std::size_t p = 0; p < boxes.size(); ++p) {
      (body ? data->given.body : data->given.carrier).push_back(boxes[p].lower);
      for (int k = 0; k < 3; ++k) {
        const double low = component(boxes[p].lower, k), high = component(boxes[p].upper, k);
        if (low == high) continue;
        data->free.push_back({body, p, k});
        data->variables.push_back(
            {fmt::format("{}_{}_{}_m", body ? "body" : "carrier", p + 1, axes[k]), low, high});
      }
    }
  }
  return data;
}

optimise::Problem problem_of(std::shared_ptr<const LinkData> data) {
  optimise::Problem problem;
  problem.variables = data->variables;
  problem.evaluate = [data](const optimise::PopulationView& candidates, std::span<double> cost,
                            std::span<double> violation) {
    GuideLink link = data->given;
    const std::size_t n = data->motion.size();
    std::vector<double> errors(error_rows(link.type, n));
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t v = 0; v < data->free.size(); ++v) data->place(link, v, candidates(v, i));
      const bool there = structural_errors(data->motion, link, errors, {}, {});
      violation[i] = there ? 0 : 1;
      cost[i] = there ? objective_of(add_up(link.type, errors, n), link.type, n, data->total)
                      : std::numeric_limits<double>::infinity();
    }
  };
  problem.explain = [](std::span<const double>) {
    return std::vector<optimise::Violation>{{"points_apart", 1}};
  };
  return problem;
}

}  // namespace

optimise::Problem link_problem(const CarrierTargets& targets, const LinkTask& task, ErrorTotal total) {
  return problem_of(link_data(targets, task, total));
}

double link_objective(const CarrierTargets& targets, const GuideLink& link, ErrorTotal total) {
  const LinkMotion motion = link_motion(targets, link.moved_by_rack);
  LINKWRIGHT_REQUIRE(motion.size() >= 1, "link '{}': no position besides the reference", link.name);
  std::vector<double> errors(error_rows(link.type, motion.size()));
  if (!structural_errors(motion, link, errors, {}, {})) return std::numeric_limits<double>::infinity();
  return objective_of(add_up(link.type, errors, motion.size()), link.type, motion.size(), total);
}

LinkEvolution evolve_link(const CarrierTargets& targets, const LinkTask& task, std::uint64_t seed,
                          RunContext& context, int generations) {
  const auto data = link_data(targets, task, ErrorTotal::mean);
  const optimise::Problem problem = problem_of(data);
  optimise::MinimiseOptions options;
  options.stop.spread = problem.variables.size() < 30 ? 1e-5 : 1e-4;
  options.log = false;
  options.progress = false;
  optimise::OptimiserOptions method;
  method.method = optimise::Method::differential_evolution;
  method.differential_evolution.generations = generations;
  const optimise::Report report = optimise::minimise(problem, method, options, {.seed = seed}, context);
  LinkEvolution result;
  result.objective = report.cost;
  result.generations = report.generations;
  result.fit.status = report.status;
  result.fit.evaluations = report.evaluations;
  result.fit.starts = 1;
  result.fit.link = data->given;
  for (std::size_t v = 0; v < report.x.size(); ++v) data->place(result.fit.link, v, report.x[v]);
  const std::size_t n = data->motion.size();
  std::vector<double> errors(error_rows(task.type, n));
  if (structural_errors(data->motion, result.fit.link, errors, {}, {})) {
    const Totals t = add_up(task.type, errors, n);
    result.fit.rms = std::sqrt(t.square / static_cast<double>(n * error_count(task.type)));
    result.fit.largest = t.largest;
  }
  return result;
}

}  // namespace linkwright::suspension
