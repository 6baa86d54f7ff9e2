// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/detail/load_formula.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {
namespace {

using Kind = LoadQuantity::Kind;

// The functions of a name in quotes.
struct QuantityWord {
  std::string_view word;
  Kind kind;
  Dimension dimension;  // of a coordinate: of one that slides
};
constexpr QuantityWord quantity_words[] = {
    {"q", Kind::coordinate, Dimension::length},  {"rate", Kind::rate, Dimension::speed},
    {"x", Kind::x, Dimension::length},           {"y", Kind::y, Dimension::length},
    {"vx", Kind::x_speed, Dimension::speed},     {"vy", Kind::y_speed, Dimension::speed},
    {"length", Kind::length, Dimension::length}, {"speed", Kind::lengthening, Dimension::speed},
};

template <class Items>
std::vector<std::string_view> names_of(const Items& items) {
  std::vector<std::string_view> out;
  for (const auto& item : items) out.push_back(item.name);
  return out;
}

class QuantityReader {
 public:
  QuantityReader(const Linkage& linkage, std::vector<LoadQuantity>& out) : l_(linkage), out_(out) {}

  std::optional<math::FormulaLookup::Found> find(std::string_view word, std::string_view name,
                                                 std::string& problem) {
    const QuantityWord& row = *std::find_if(std::begin(quantity_words), std::end(quantity_words),
                                            [&](const QuantityWord& w) { return w.word == word; });
    if (out_.size() >= max_load_quantities) {
      problem = fmt::format("the formula names more than {} quantities", max_load_quantities);
      return std::nullopt;
    }
    LoadQuantity quantity{.kind = row.kind};
    Dimension dimension = row.dimension;
    const bool known = row.kind == Kind::coordinate || row.kind == Kind::rate
                           ? joint(name, row.kind, quantity, dimension, problem)
                       : row.kind == Kind::length || row.kind == Kind::lengthening
                           ? ends(name, quantity, problem)
                           : point(name, quantity, problem);
    if (!known) return std::nullopt;
    out_.push_back(quantity);
    return math::FormulaLookup::Found{out_.size() - 1, dimension};
  }

 private:
  static bool unknown(std::string_view what, std::string_view name,
                      const std::vector<std::string_view>& known, std::string& problem) {
    const std::string_view near = nearest_word(name, known);
    problem = fmt::format("there is no {} '{}'", what, name);
    if (!near.empty()) problem += fmt::format("; did you mean '{}'?", near);
    return false;
  }
  bool joint(std::string_view name, Kind kind, LoadQuantity& q, Dimension& dimension, std::string& problem) {
    q.joint = joint_index(l_, name);
    if (q.joint < 0) return unknown("joint", name, names_of(l_.joints), problem);
    const JointType type = l_.joints[at(q.joint)].type;
    if (type == JointType::revolute)
      dimension = kind == Kind::coordinate ? Dimension::angle : Dimension::speed_angular;
    else if (type != JointType::prismatic && type != JointType::pin_in_slot)
      problem = fmt::format("joint '{}' has no coordinate; pins, slides and slots have one", name);
    return problem.empty();
  }
  bool ends(std::string_view name, LoadQuantity& q, std::string& problem) {
    const auto take = [&](const auto& items) {
      for (const auto& item : items)
        if (item.name == name) q.first = item.first, q.second = item.second;
      return q.first.body != q.second.body;
    };
    if (take(l_.struts) || take(l_.springs)) return true;
    std::vector<std::string_view> known = names_of(l_.struts);
    for (const LinearSpring& s : l_.springs) known.push_back(s.name);
    return unknown("strut or spring", name, known, problem);
  }
  bool point(std::string_view name, LoadQuantity& q, std::string& problem) {
    const auto dot = name.rfind('.');
    const std::string_view body = name.substr(0, dot);
    q.first.body = dot == std::string_view::npos ? -1 : body_index(l_, body);
    if (q.first.body < 0) {
      if (dot != std::string_view::npos) return unknown("body", body, names_of(l_.bodies), problem);
      problem = fmt::format("'{}' is not a point; write body.point", name);
      return false;
    }
    const LinkageBody& on = l_.bodies[at(q.first.body)];
    q.first.point = point_index(on, name.substr(dot + 1));
    if (q.first.point >= 0) return true;
    unknown("point", name.substr(dot + 1), names_of(on.points), problem);
    problem = fmt::format("body '{}': {}", body, problem);
    return false;
  }

  const Linkage& l_;
  std::vector<LoadQuantity>& out_;
};

double value_of(const LoadQuantity& q, const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                double time) {
  const auto point = [&] { return point_motion(l, plan, motion, q.first); };
  switch (q.kind) {
    case Kind::unused:
      break;
    case Kind::time:
      return time;
    case Kind::x:
      return point().position.x;
    case Kind::y:
      return point().position.y;
    case Kind::x_speed:
      return point().velocity.x;
    case Kind::y_speed:
      return point().velocity.y;
    case Kind::length:
      return span_of(l, plan, motion, q.first, q.second).length;
    case Kind::lengthening:
      return span_of(l, plan, motion, q.first, q.second).rate;
    case Kind::turning:
      return body_state(plan, motion, q.first.body).speed - body_state(plan, motion, q.second.body).speed;
    case Kind::rate:
      return joint_motion(l, plan, motion, q.joint).rate;
    case Kind::coordinate: {
      if (l.joints[at(q.joint)].type != JointType::revolute)
        return joint_motion(l, plan, motion, q.joint).value;
      const auto counted = std::find(l.counted_pins.begin(), l.counted_pins.end(), q.joint);
      return motion.twists[l.torsion_springs.size() + l.stops.size() +
                           static_cast<std::size_t>(counted - l.counted_pins.begin())];
    }
  }
  return 0;
}

using QuantityValues = std::array<double, max_load_quantities>;
std::span<const double> fill(const LoadFormula& f, const Linkage& l, const LinkagePlan& plan,
                             const LinkageMotion& motion, double time, QuantityValues& values) {
  for (std::size_t i = 0; i < f.quantities.size(); ++i)
    values[i] = value_of(f.quantities[i], l, plan, motion, time);
  return {values.data(), f.quantities.size()};
}

}  // namespace

std::shared_ptr<const LoadFormula> load_formula(Linkage& l, std::span<const std::string> texts,
                                                Dimension result, std::span<const NamedQuantity> known,
                                                std::string& problem) {
  auto out = std::make_shared<LoadFormula>();
  std::vector<math::FormulaName> words;
  for (const NamedQuantity& k : known) {
    words.push_back(k.name);
    out->quantities.push_back(k.quantity);
  }
  for_formulas(l, [&out](const auto& load) { out->first_kink += kinks_of(*load.formula); });
  QuantityReader reader(l, out->quantities);
  math::FormulaLookup lookup;
  for (const QuantityWord& w : quantity_words) lookup.functions.push_back(w.word);
  lookup.find = [&reader](std::string_view word, std::string_view name, std::string& problem) {
    return reader.find(word, name, problem);
  };
  for (const std::string& text : texts) {
    math::FormulaError error;
    auto formula = math::Formula::read(text, result, words, error, lookup);
    if (!formula) {
      problem = fmt::format("column {}: {}", error.column, error.message);
      if (texts.size() > 1) problem = fmt::format("\"{}\", {}", text, problem);
      return nullptr;
    }
    out->components.push_back(*std::move(formula));
  }
  for (std::size_t i = 0; i < out->quantities.size(); ++i) {
    LoadQuantity& q = out->quantities[i];
    if (std::none_of(out->components.begin(), out->components.end(),
                     [i](const math::Formula& f) { return f.uses(i); }))
      q.kind = Kind::unused;
    if (q.kind == Kind::coordinate && l.joints[at(q.joint)].type == JointType::revolute &&
        std::find(l.counted_pins.begin(), l.counted_pins.end(), q.joint) == l.counted_pins.end())
      l.counted_pins.push_back(q.joint);
  }
  return out;
}

std::vector<std::string> texts_of(const LoadFormula& formula) {
  std::vector<std::string> out;
  for (const math::Formula& f : formula.components) out.push_back(f.text());
  return out;
}

std::array<double, 2> values_of(const LoadFormula& f, const Linkage& l, const LinkagePlan& plan,
                                const LinkageMotion& motion, double time) {
  QuantityValues memory;
  const std::span<const double> values = fill(f, l, plan, motion, time, memory);
  std::array<double, 2> out{};
  std::size_t kink = f.first_kink;
  for (std::size_t i = 0; i < f.components.size(); ++i) {
    const math::Formula& c = f.components[i];
    out[i] = motion.branches.empty()
                 ? c(values)
                 : c.on_branches(values, std::span(motion.branches).subspan(kink, c.kinks()));
    kink += c.kinks();
  }
  return out;
}

std::size_t kinks_of(const LoadFormula& formula) {
  std::size_t sum = 0;
  for (const math::Formula& f : formula.components) sum += f.kinks();
  return sum;
}

void find_branches(const LoadFormula& f, const Linkage& l, const LinkagePlan& plan,
                   const LinkageMotion& motion, double time, std::span<double> branches) {
  QuantityValues memory;
  const std::span<const double> values = fill(f, l, plan, motion, time, memory);
  for (const math::Formula& c : f.components) {
    c.find_branches(values, branches.first(c.kinks()));
    branches = branches.subspan(c.kinks());
  }
}

void find_kinks(const LoadFormula& f, const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                double time, std::span<double> kinks) {
  QuantityValues memory;
  const std::span<const double> values = fill(f, l, plan, motion, time, memory);
  for (const math::Formula& c : f.components) {
    c.find_kinks(values, kinks.first(c.kinks()));
    kinks = kinks.subspan(c.kinks());
  }
}

std::string load_by_joint(const Linkage& linkage) {
  std::string found;
  for_formulas(linkage, [&found](const auto& load) {
    const std::vector<LoadQuantity>& all = load.formula->quantities;
    if (found.empty() && std::any_of(all.begin(), all.end(), [](const LoadQuantity& q) {
          return q.kind == Kind::coordinate || q.kind == Kind::rate;
        }))
      found = load.name;
  });
  return found;
}

bool formula_goes_by(const LoadFormula& formula, LoadArgument argument) {
  return std::any_of(formula.quantities.begin(), formula.quantities.end(), [argument](const LoadQuantity& q) {
    switch (q.kind) {
      case Kind::time:
        return argument == LoadArgument::time;
      case Kind::x_speed:
      case Kind::y_speed:
      case Kind::lengthening:
      case Kind::turning:
      case Kind::rate:
        return argument == LoadArgument::speed;
      default:
        return false;
    }
  });
}

}  // namespace linkwright::planar
