// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/swing.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

std::string angle_text(double angle) { return fmt::format("{:.4g}°", math::degrees(angle)); }

// |imbalance|; nothing where it has been reported.
std::optional<double> read_imbalance(study::ObjectReader& target, const std::optional<double>& ratio,
                                     const std::optional<double>& imbalance) {
  const bool has_angle = target.has(field::angle("imbalance_angle"));
  if (ratio && imbalance) {
    target.error("imbalance_angle", "the target has both a time ratio and an imbalance angle",
                 "keep one of them");
    return std::nullopt;
  }
  if (!ratio && !imbalance) {
    if (!target.has("time_ratio") && !has_angle)
      target.error("time_ratio", "the target has no time ratio",
                   "write time_ratio = 1.4, the time of the slow stroke over that of the quick one");
    return std::nullopt;
  }
  return ratio ? imbalance_of(*ratio) : *imbalance;
}

// Says why strokes cannot be made by any linkage, and what can.
void say_impossible(study::ObjectReader& target, const SwingStudy& s, std::optional<SlowSwing> slow) {
  const std::string_view key = target.has("time_ratio") ? "time_ratio" : "imbalance_angle";
  const double with = max_imbalance(s.swing, true), against = max_imbalance(s.swing, false);
  if (s.slider) {
    target.error(
        key,
        fmt::format("no slider-crank has a time ratio of {:.4g} (an imbalance angle of {})",
                    time_ratio_of(s.imbalance), angle_text(s.imbalance)),
        "a time ratio less than 3 (less than 90°) is possible, and one of 2 already transmits force badly");
    return;
  }
  const auto limit = [](double most) { return fmt::format("less than {:.4g}", time_ratio_of(most)); };
  std::string possible = slow && *slow == SlowSwing::with_crank ? limit(with)
                         : slow
                             ? limit(against)
                             : fmt::format("{} with the slow stroke in the sense of the crank, {} against it",
                                           limit(with), limit(against));
  target.error(key,
               fmt::format("no crank-rocker swings by {} with a time ratio of {:.4g}{}: {} is possible",
                           angle_text(s.swing), time_ratio_of(s.imbalance),
                           !slow                            ? ""
                           : *slow == SlowSwing::with_crank ? " and its slow stroke in the sense of the crank"
                                                            : " and its slow stroke against the crank",
                           possible),
               slow && *slow == SlowSwing::against_crank && s.imbalance < with
                   ? "write slow_stroke = \"with_crank\", or take a smaller time ratio or swing angle"
                   : "take a smaller time ratio");
}

// Lengths in the order in which the first is the scale.
void set_given(study::ObjectReader& mechanism, SwingStudy& s, const SwingMechanism& m) {
  std::vector<GivenLength> given;
  const auto add = [&](const std::optional<double>& length, StrokeLength which) {
    if (length) given.push_back({which, *length});
  };
  add(m.ground, StrokeLength::ground);
  add(m.crank, StrokeLength::crank);
  add(m.coupler, StrokeLength::coupler);
  add(m.rocker, StrokeLength::rocker);
  if (given.empty()) {
    bool any = false;
    for (const char* key : {"ground", "crank", "coupler", "rocker"})
      any = any || mechanism.has(field::length(key));
    if (!any)
      mechanism.error("ground", "the linkage has no length",
                      "write ground_mm = 100, or the length of the crank, coupler or rocker");
    return;
  }
  if (given.size() > 2) {
    mechanism.error("", fmt::format("{} lengths are given, two settle the linkage", given.size()),
                    "keep one for the scale, or two");
    return;
  }
  s.settled = given.size() == 2;
  std::copy(given.begin(), given.end(), s.given.begin());
}

std::string_view word_of(StrokeLength which, bool slider) {
  switch (which) {
    case StrokeLength::crank:
      return "crank";
    case StrokeLength::coupler:
      return slider ? "rod" : "coupler";
    case StrokeLength::rocker:
      return "rocker";
    case StrokeLength::ground:
      return "ground";
    case StrokeLength::chord:
      break;
  }
  return "stroke";
}

// Removes the senses for which the given lengths fit no linkage; says what would fit when none is left.
void require_fitting(study::ObjectReader& mechanism, SwingStudy& s) {
  if (!s.settled || s.senses.empty()) return;
  const auto [scale, other] = s.given;
  std::string fitting;
  for (const Strokes& strokes : s.senses) {
    double low = 0, high = 0;
    const double ends[] = {std::max(*shortest_crank(strokes), 1e-9), 1};
    for (int k = 0; k < 2; ++k) {
      const StrokeLinkage linkage = stroke_linkage(strokes, ends[k]);
      (k == 0 ? low : high) =
          scale.length * length_of(linkage, other.which) / length_of(linkage, scale.which);
    }
    if (low > high) std::swap(low, high);
    if (!fitting.empty()) fitting += ", or ";
    fitting += high < 1e3 * scale.length ? fmt::format("between {:.4g} and {:.4g} mm", low * 1e3, high * 1e3)
                                         : fmt::format("more than {:.4g} mm", low * 1e3);
    if (!s.slider && strokes.imbalance != 0)
      fitting += strokes.imbalance < 0 ? " (slow stroke with the crank)" : " (slow stroke against the crank)";
  }
  std::erase_if(s.senses, [&](const Strokes& strokes) { return !chosen_crank(s, strokes); });
  if (!s.senses.empty()) return;
  const std::string_view what = word_of(other.which, s.slider);
  mechanism.error(
      what,
      fmt::format("no {} of these strokes with a {} of {:.4g} mm has a {} of {:.4g} mm",
                  s.slider ? "slider-crank" : "crank-rocker", word_of(scale.which, s.slider),
                  scale.length * 1e3, what, other.length * 1e3),
      fmt::format("{} is possible; or leave it out, for the largest transmission angle", fitting));
}

SwingStudy study_of(study::ObjectReader& document, SwingMechanism& mechanism, SwingTarget& target) {
  SwingStudy s;
  auto body = document.table(field::entry("mechanism").required());
  if (body) {
    body->read(mechanism);
    set_given(*body, s, mechanism);
    s.largest_ratio = mechanism.largest_ratio;
    s.branch = mechanism.branch;
    s.rotation = mechanism.rotation;
  }
  if (auto table = document.table(field::entry("target").required())) {
    table->read(target);
    s.swing = target.swing;
    if (const auto imbalance = read_imbalance(*table, target.time_ratio, target.imbalance);
        imbalance && s.swing > 0) {
      s.imbalance = *imbalance;
      for (const SlowSwing slow : {SlowSwing::with_crank, SlowSwing::against_crank}) {
        const Strokes strokes{s.swing, slow == SlowSwing::with_crank ? -s.imbalance : s.imbalance};
        // Without imbalance both are the same linkages.
        const bool wanted = !target.slow || *target.slow == slow;
        if (wanted && shortest_crank(strokes) && (s.imbalance > 0 || s.senses.empty()))
          s.senses.push_back(strokes);
      }
      if (s.senses.empty()) say_impossible(*table, s, target.slow);
    }
  }
  if (body) require_fitting(*body, s);
  return s;
}

SwingStudy study_of(study::ObjectReader& document, StrokeMechanism& mechanism, StrokeTarget& target) {
  SwingStudy s;
  s.slider = true;
  auto body = document.table(field::entry("mechanism").required());
  if (body) {
    body->read(mechanism);
    s.largest_ratio = mechanism.largest_ratio;
    s.rotation = mechanism.rotation;
    if (mechanism.crank && mechanism.rod)
      body->error("rod", "crank and rod are both given, one of them settles the linkage", "keep one");
  }
  if (auto table = document.table(field::entry("target").required())) {
    table->read(target);
    s.given[0] = {StrokeLength::chord, target.stroke};
    if (const auto imbalance = read_imbalance(*table, target.time_ratio, target.imbalance)) {
      s.imbalance = *imbalance;
      // Seen in the mirror at the guide, the crank turns the other way.
      const bool inward = (target.slow == SlowStroke::inward) == (s.rotation == Rotation::counterclockwise);
      const Strokes strokes{0, inward ? s.imbalance : -s.imbalance};
      if (shortest_crank(strokes))
        s.senses.push_back(strokes);
      else
        say_impossible(*table, s, std::nullopt);
    }
    s.settled = mechanism.crank.has_value() != mechanism.rod.has_value();
    if (mechanism.crank) s.given[1] = {StrokeLength::crank, *mechanism.crank};
    if (mechanism.rod) s.given[1] = {StrokeLength::coupler, *mechanism.rod};
    if (body && mechanism.crank && s.imbalance == 0 && !s.senses.empty() && target.stroke > 0) {
      body->error("crank", "with a time ratio of 1 the crank is half the stroke",
                  "leave it out, or write the length of the rod");
      s.settled = false;
    }
  }
  if (body && s.given[0].length > 0) require_fitting(*body, s);
  return s;
}

template <class Target, class Mechanism>
void complete_stroke_kind(study::Kind& kind, std::string what) {
  kind.kind = "synthesis";
  kind.schema = [what](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", what), study::schema_fields<Mechanism>());
    document.property(field::entry("target", "its strokes"), study::schema_fields<Target>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    Mechanism mechanism;
    Target target;
    const SwingStudy s = study_of(document, mechanism, target);
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(mechanism);
    prepared.canonical["target"] = study::write_fields(target);
    prepared.run = [s, common](RunContext& context) { return run_swing_study(s, common, context); };
    return prepared;
  };
}

}  // namespace

std::optional<double> chosen_crank(const SwingStudy& s, const Strokes& strokes) {
  const std::optional<double> shortest = shortest_crank(strokes);
  if (!shortest) return std::nullopt;
  if (!s.settled) return std::max(best_crank(strokes), 1 / s.largest_ratio);
  const auto [scale, other] = s.given;
  const auto crank = crank_of_ratio(strokes, other.which, scale.which, other.length / scale.length);
  return crank && *crank > *shortest && *crank < 1 ? crank : std::nullopt;
}

study::Kind swing_kind() {
  study::Kind kind;
  kind.mechanism = "planar.four_bar";
  kind.target = "swing";
  kind.summary = "crank-rocker by its swing angle and the time ratio of slow and quick stroke (quick return)";
  kind.example = templates::synthesis_four_bar_swing();
  complete_stroke_kind<SwingTarget, SwingMechanism>(kind, "the crank-rocker");
  return kind;
}

study::Kind stroke_kind() {
  study::Kind kind;
  kind.mechanism = "planar.slider_crank";
  kind.target = "stroke";
  kind.summary = "slider-crank by its stroke and the time ratio of slow and quick stroke (quick return)";
  kind.example = templates::synthesis_slider_crank_stroke();
  complete_stroke_kind<StrokeTarget, StrokeMechanism>(kind, "the slider-crank");
  return kind;
}

}  // namespace linkwright::planar
