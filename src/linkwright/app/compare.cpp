// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "linkwright/app/compare_diagrams.h"
#include "linkwright/app/run.h"
#include "linkwright/core/check.h"
#include "linkwright/core/status.h"
#include "linkwright/core/units.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/study.h"

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

using study::Fact;
using study::Scene;

/// The value of a fact in the unit of another; NaN if it has none or another dimension.
double value_in(const Fact& fact, const std::optional<Measured>& other) {
  const std::optional<Measured> own = fact.value();
  if (!own || !other || own->dimension != other->dimension) return nan;
  if (own->dimension == Dimension::none && own->unit != other->unit) return nan;
  return own->unit ? other->unit->from_si(own->si) : own->si;
}

const Fact* find_fact(const study::Result& result, const Sentence& label) {
  for (const Fact& fact : result.facts)
    if (fact.label == label) return &fact;
  return nullptr;
}

/// Zeros but for rounding, of a residual or a balance: that they differ says nothing.
bool is_rounding(double value) { return std::abs(value) < 1e-12; }

Sentence difference(double value, double first) {
  const double share = value / first - 1;
  if ((is_rounding(value) && is_rounding(first)) || !std::isfinite(share) || value == first) return {};
  return say(" ({})", percent(share, 3).with_sign());
}

class Merger {
 public:
  explicit Merger(std::span<const Compared> all) : all_(all), first_(all.front().result) {}

  study::Result merged() {
    studies();
    facts();
    objectives();
    for (const Scene& scene : first_.scenes) scenes(scene);
    std::vector<std::string> drawn;
    for (const Scene& scene : out_.scenes) drawn.push_back(scene.name);
    ComparedDiagrams diagrams = compare_diagrams(all_, drawn);
    out_.plots = std::move(diagrams.plots);
    out_.tables = std::move(diagrams.tables);
    solutions();
    checks();
    out_.headline = say("{} studies compared: {} of {} results differ.", all_.size(), different_, compared_);
    if (!figures_.names.empty()) out_.tables.insert(out_.tables.begin(), figures());
    for (Table& table : diagrams.differences) out_.tables.push_back(std::move(table));
    return std::move(out_);
  }

 private:
  static std::string tag(std::size_t study) { return std::to_string(study + 1); }

  /// The studies and their statuses; the comparison is as good as the worst of them.
  void studies() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const study::Result& result = all_[i].result;
      const study::Verdict verdict = study::answer_of(result).verdict;
      out_.facts.push_back({tag(i), fmt::format("{}: {}", all_[i].name, to_string(result.status)),
                            verdict == study::Verdict::passed   ? Fact::Verdict::good
                            : verdict == study::Verdict::failed ? Fact::Verdict::bad
                                                                : Fact::Verdict::plain});
      if (out_.status == Status::done) out_.status = result.status;
      for (Diagnostic d : result.diagnostics) {
        d.message = say("{}: {}", all_[i].name, d.message);
        out_.diagnostics.push_back(std::move(d));
      }
    }
  }

  void figure(std::string label, const std::vector<double>& values) {
    figures_.names.push_back(std::move(label));
    values_.push_back(values);
  }

  /// Equal texts once, different ones side by side, with the difference to the first.
  void facts() {
    std::vector<Sentence> labels;
    for (const Compared& one : all_)
      for (const Fact& fact : one.result.facts)
        if (std::find(labels.begin(), labels.end(), fact.label) == labels.end()) labels.push_back(fact.label);
    for (const Sentence& label : labels) {
      Fact fact{label, {}, Fact::Verdict::plain};
      std::set<std::string> texts;
      std::optional<Measured> first;
      std::vector<double> values;
      for (const Compared& one : all_) {
        const Fact* own = find_fact(one.result, label);
        texts.insert(own ? to_string(own->text) : "");
        if (own && own->verdict == Fact::Verdict::bad) fact.verdict = Fact::Verdict::bad;
        if (own && values.empty()) first = own->value();
        values.push_back(own ? value_in(*own, first) : nan);
        fact.text += values.size() == 1 ? "" : " | ";
        fact.text += own ? own->text : Sentence("-");
        fact.text += difference(values.back(), values.front());
      }
      if (const Fact* same = find_fact(first_, label); same && texts.size() == 1) fact.text = same->text;
      out_.facts.push_back(fact);
      ++compared_;
      different_ += texts.size() > 1 && !std::all_of(values.begin(), values.end(), is_rounding);
      if (!std::isnan(values.front()))
        figure(to_string(label) + (first->unit ? fmt::format(" ({})", first->unit_words()) : ""), values);
    }
  }

  void objectives() {
    if (first_.solutions.empty() || !first_.solutions.front().objectives.is_object()) return;
    for (const Value::Member& member : first_.solutions.front().objectives.as_object()) {
      std::vector<double> values;
      for (const Compared& one : all_) {
        const Value* v = one.result.solutions.empty() || !one.result.solutions.front().objectives.is_object()
                             ? nullptr
                             : one.result.solutions.front().objectives.find(member.key);
        values.push_back(v && v->is_number() ? v->as_number() : nan);
      }
      if (std::isnan(values.front())) continue;
      figure(member.key, values);
      ++compared_;
      different_ += std::any_of(values.begin(), values.end(), [&](double v) { return v != values.front(); });
    }
  }

  Table figures() {
    figures_.name = "figures";
    const auto add = [&](std::string key, std::string label, auto&& value) {
      std::vector<double> column;
      for (const std::vector<double>& row : values_) column.push_back(value(row));
      figures_.add(std::move(key), std::move(label), std::move(column));
    };
    for (std::size_t i = 0; i < all_.size(); ++i)
      add("study_" + tag(i), all_[i].name, [&](const auto& row) { return row[i]; });
    for (std::size_t i = 1; i < all_.size(); ++i)
      add(fmt::format("difference_{}_to_1", tag(i)), fmt::format("{} minus {}", all_[i].name, all_[0].name),
          [&](const auto& row) { return row[i] - row[0]; });
    return std::move(figures_);
  }

  /// The scene of another study that shows the same: that of its best solution, or of the same name.
  const Scene* counterpart(const Scene& scene, const study::Result& other) const {
    const bool best = !first_.solutions.empty() && first_.solutions.front().scene == scene.name;
    if (best && other.solutions.empty()) return nullptr;
    const std::string& name = best ? other.solutions.front().scene : scene.name;
    for (const Scene& s : other.scenes)
      if (s.name == name) return &s;
    return nullptr;
  }

  /// A scene of the first study with the others behind it; those with other inputs get a scene of their own.
  void scenes(const Scene& scene) {
    // The best of several solutions are compared.
    if (!first_.solutions.empty() && !first_.solutions.front().scene.empty() &&
        first_.solutions.front().scene != scene.name)
      return;
    Scene together = scene;
    std::vector<Scene> apart;
    for (std::size_t i = 1; i < all_.size(); ++i) {
      const Scene* other = counterpart(scene, all_[i].result);
      if (!other) continue;
      if (same_values(scene.input, other->input) && same_values(scene.second, other->second) &&
          scene.spatial() == other->spatial()) {
        add_ghost_of(together, *other, i);
      } else {
        Scene alone = *other;
        alone.name = fmt::format("{}-{}", scene.name, tag(i));
        alone.title = all_[i].name;
        apart.push_back(std::move(alone));
      }
    }
    together.title = all_[0].name;
    out_.scenes.push_back(std::move(together));
    for (Scene& alone : apart) out_.scenes.push_back(std::move(alone));
  }

  /// The links and traces of another study behind those of the first.
  void add_ghost_of(Scene& scene, const Scene& other, std::size_t study) const {
    if (scene.runs.empty())
      for (const Compared& one : all_) scene.runs.push_back(one.name);
    const std::string& name = all_[study].name;
    const int before = static_cast<int>(scene.points.size()), run = static_cast<int>(study);
    scene.points.insert(scene.points.end(), other.points.begin(), other.points.end());
    for (Scene::Body body : other.bodies) {
      if (body.style != Scene::BodyStyle::bar && body.style != Scene::BodyStyle::plate) continue;
      for (int& point : body.points) point += before;
      body.name = fmt::format("{} of {}", body.name, name);
      body.run = run;
      scene.bodies.push_back(std::move(body));
    }
    for (Scene::Trace trace : other.traces) {
      trace.point += before;
      trace.name = fmt::format("{} of {}", trace.name, name);
      trace.run = run;
      scene.traces.push_back(std::move(trace));
    }
  }

  void solutions() {
    for (const Compared& one : all_) {
      if (one.result.solutions.empty()) continue;
      study::Solution best = one.result.solutions.front();
      best.label = best.label.empty() ? Sentence(one.name) : say("{}: {}", one.name, best.label);
      best.scene = out_.scenes.empty() ? "" : out_.scenes.front().name;
      out_.solutions.push_back(std::move(best));
    }
  }

  void checks() {
    for (const Compared& one : all_)
      for (study::Check check : one.result.checks) {
        check.at = check.at.empty() ? one.name : fmt::format("{}, {}", one.name, check.at);
        out_.checks.push_back(std::move(check));
      }
  }

  std::span<const Compared> all_;
  const study::Result& first_;
  study::Result out_;
  Table figures_;                             ///< its rows
  std::vector<std::vector<double>> values_;   ///< values of the rows, one a study
  std::size_t compared_ = 0, different_ = 0;  ///< facts and objectives
};

}  // namespace

std::optional<ComparisonInput> load_compared(const fs::path& path, std::span<const study::Kind> kinds,
                                             Diagnostics& diagnostics) {
  const auto refuse = [&](const fs::path& file, std::string message, std::string hint) {
    diagnostics.push_back(
        {Diagnostic::Severity::error, file.string(), {}, {}, std::move(message), std::move(hint)});
    return std::nullopt;
  };
  const bool folder = fs::is_directory(path);
  const fs::path file = folder ? path / "result.json" : path;
  if (folder && !fs::exists(file))
    return refuse(path, "holds no result.json", "name the folder of a run, or a study, which is then run");
  if (folder || file.extension() == ".json") {
    const std::size_t before = diagnostics.size();
    const Value document = study::read_file(file, diagnostics);
    if (diagnostics.size() != before) return std::nullopt;
    const Value *own = document.find("study"), *status = document.find("status");
    if (own && own->is_object() && document.find("study_sha256") && status && status->is_string()) {
      if (own->find("compare"))
        return refuse(file, "is a comparison", "compare the studies that it is made of");
      if (status->as_string() == to_string(Status::deadline) ||
          status->as_string() == to_string(Status::cancelled))
        return refuse(file, "was stopped before its end and cannot be computed again",
                      "let it end with --resume, or compare its study");
      Diagnostics problems;
      auto study = study::prepare(*own, file.string(), file.parent_path(), kinds, problems);
      if (!study)
        return refuse(file,
                      fmt::format("holds a study that cannot be run again ({}: {})", problems.front().key,
                                  to_string(problems.front().message)),
                      "compare the study file that it comes from");
      return ComparisonInput{std::move(*study), file.parent_path()};
    }
  }
  auto study = load_study(path, {}, kinds, diagnostics);
  if (!study) return std::nullopt;
  return ComparisonInput{std::move(*study), {}};
}

std::vector<std::string> names_of(std::span<const fs::path> paths,
                                  std::span<const study::Study* const> studies) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string& title = studies[i]->common.title;
    const auto with_it = std::count_if(studies.begin(), studies.end(), [&](const study::Study* other) {
      return other->common.title == title;
    });
    names.push_back(title.empty() || with_it > 1 ? paths[i].string() : title);
  }
  return names;
}

study::Result compare(std::span<const Compared> all) {
  LINKWRIGHT_REQUIRE(all.size() >= 2, "a comparison needs two results, got {}", all.size());
  return Merger(all).merged();
}

study::Study comparison_study(std::span<const Compared> all) {
  LINKWRIGHT_REQUIRE(!all.empty(), "a comparison of nothing");
  study::Study study;
  study.kind = all.front().study.kind;
  study.common.units = all.front().study.common.units;
  study.common.output.units = all.front().study.common.output.units;
  study.common.output.digits = all.front().study.common.output.digits;
  study.canonical["compare"] = Value::array();
  for (const Compared& one : all) {
    study.common.title += (study.common.title.empty() ? "" : " | ") + one.name;
    study.canonical["compare"].push_back(one.study.canonical);
  }
  return study;
}

}  // namespace linkwright::app
