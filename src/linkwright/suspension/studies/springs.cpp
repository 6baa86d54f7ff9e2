// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/springs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/compliance/springs.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/studies/anti_roll.h"
#include "linkwright/suspension/studies/axle.h"
#include "linkwright/suspension/studies/damping.h"
#include "linkwright/suspension/studies/spring_parts.h"

namespace linkwright::suspension {
namespace {

constexpr double missing = WheelParameters::missing;

/// The angle of a torsion bar, counted so that it winds up as the wheel rises from the reference: a length
/// that shortens.
TravelRates wound(const TravelRates& angle, double sense) {
  return {-sense * angle.value, -sense * angle.ratio, -sense * angle.by_travel};
}

double sum_of(std::initializer_list<const WheelRate*> parts, double WheelRate::*member) {
  double sum = 0;
  for (const WheelRate* part : parts) sum += part->*member;
  return sum;
}

/// Length of the heave spring of a symmetric axle at the reference.
double length_across(const Suspension& suspension, const HeaveSpringDescription& heave) {
  return 2 * std::abs(suspension.elements[heave.element].second.at.y);
}

/// A position with all that acts at its wheel.
struct SpringRow {
  CornerMotions motions;
  WheelRate spring, torsion, bump, rebound;
  WheelRate heave;           ///< both wheels travelling equally; half of its effect is at each wheel
  double damping = missing;  ///< at the wheel, N s/m
  bool bottomed = false;
  /// Rate and force at the wheel of what acts on this wheel alone.
  double own_rate() const { return sum_of({&spring, &torsion, &bump, &rebound}, &WheelRate::rate); }
  double own_force() const { return sum_of({&spring, &torsion, &bump, &rebound}, &WheelRate::wheel_force); }
  /// The same with the heave spring.
  double rate() const { return own_rate() + heave.rate / 2; }
  double force() const { return own_force() + heave.wheel_force / 2; }
};

/// The parts of the sum that are the same at all positions.
class SpringModel {
 public:
  SpringModel(const CornerDescription& description, const RideForm& ride)
      : description_(description), ride_(ride), plan_(prepare_derivatives(description.suspension, {})) {
    const CornerPosition reference = reference_position(plan_.plan);
    const auto& torsion = description.springs.torsion_bar;
    if (torsion && reference.status == Status::done) {
      const double ratio = corner_motions(plan_, reference, ride.coordinate).elements[torsion->element].ratio;
      if (ratio < 0) sense_ = -1;
    }
  }

  const CornerPlan& plan() const { return plan_.plan; }

  SpringRow at(const CornerPosition& position) const {
    SpringRow out{.motions = corner_motions(plan_, position, ride_.coordinate)};
    const SpringParts& parts = description_.springs;
    if (description_.spring)
      out.spring = effect(*out.motions.spring, length_of(StopPlace::spring), *description_.spring);
    if (parts.torsion_bar)
      out.torsion =
          effect(wound(out.motions.elements[parts.torsion_bar->element], sense_), 0, parts.torsion_bar->law);
    if (parts.heave_spring)
      out.heave =
          effect(out.motions.elements[parts.heave_spring->element],
                 length_across(description_.suspension, *parts.heave_spring), parts.heave_spring->law);
    if (parts.damper && parts.damper->damping) {
      const double ratio = rates(out.motions, StopPlace::damper).ratio;
      out.damping = *parts.damper->damping * ratio * ratio;
    }
    if (parts.bump_stop) {
      const TravelRates length = rates(out.motions, parts.bump_stop->on);
      const double compression = length_of(parts.bump_stop->on) - length.value;
      out.bump = wheel_rate(length, force_of(parts.bump_stop->law, compression));
      out.bottomed = bottoms(parts.bump_stop->law, compression);
    }
    if (parts.rebound_stop) {
      const TravelRates length = rates(out.motions, parts.rebound_stop->on);
      SpringForce pull = force_of(parts.rebound_stop->law, length.value - length_of(parts.rebound_stop->on));
      pull.force = -pull.force;
      out.rebound = wheel_rate(length, pull);
      out.bottomed =
          out.bottomed || bottoms(parts.rebound_stop->law, length.value - length_of(parts.rebound_stop->on));
    }
    return out;
  }

  /// Distance of the stop past its engagement, or past its end: below 0 before (m).
  double past(const CornerPosition& position, const StopDescription& stop, bool rebound, bool end) const {
    const TravelRates length = rates(corner_motions(plan_, position, ride_.coordinate), stop.on);
    const double compression = (length_of(stop.on) - length.value) * (rebound ? -1 : 1);
    return compression - stop.law.clearance - (end ? *stop.law.solid_at : 0);
  }

  TravelRates rates(const CornerMotions& motions, StopPlace place) const {
    const auto& damper = description_.springs.damper;
    if (place == StopPlace::damper && damper && damper->element) return motions.elements[*damper->element];
    return *motions.spring;
  }

 private:
  static WheelRate effect(const TravelRates& length, double reference, const SpringLaw& law) {
    return wheel_rate(length, force_of(law, reference - length.value));
  }
  double length_of(StopPlace place) const {
    const auto& damper = description_.springs.damper;
    if (place == StopPlace::spring || !damper || !damper->element) return plan_.plan.spring->length;
    const CornerElement& element = description_.suspension.elements[*damper->element];
    return norm(element.second.at - element.first.at);
  }

  const CornerDescription& description_;
  const RideForm& ride_;
  DerivativePlan plan_;
  double sense_ = 1;
};

double in_series(double rate, const std::optional<double>& tyre) {
  return tyre ? rate * *tyre / (rate + *tyre) : rate;
}
double natural_frequency(double rate, const RideForm& ride) {
  return rate > 0 ? std::sqrt(in_series(rate, ride.tyre_stiffness) / *ride.sprung_mass) / (2 * pi) : missing;
}
double damping_ratio(double rate, double damping, const RideForm& ride) {
  return rate > 0 ? damping / (2 * std::sqrt(rate * *ride.sprung_mass)) : missing;
}

/// Columns of rows that are known.
class SpringTable {
 public:
  SpringTable(Table& table, const std::vector<std::optional<SpringRow>>& rows, std::string by)
      : table_(table), rows_(rows), by_(std::move(by)) {}

  template <class Value>
  void add(std::string key, std::string label, Value&& value) {
    std::vector<double> column;
    for (const auto& row : rows_) column.push_back(row ? value(*row) : missing);
    table_.add(std::move(key), std::move(label), std::move(column));
  }

  /// A length or an angle with its ratio, both ways.
  template <class Rates>
  void add_rates(const std::string& key, const std::string& words, bool angle, bool value, Rates&& rates) {
    if (value)
      add(key + (angle ? "_angle_rad" : "_length_m"), words + (angle ? " angle (rad)" : " length (m)"),
          [&](const SpringRow& r) { return rates(r).value; });
    if (angle)
      add(key + "_by_travel_rad_per_m", words + " angle by " + by_ + " (rad/m)",
          [&](const SpringRow& r) { return rates(r).ratio; });
    else
      add(key + "_length_by_travel", words + " length by " + by_ + ", dl/dz",
          [&](const SpringRow& r) { return rates(r).ratio; });
    add("travel_by_" + key + (angle ? "_angle_m_per_rad" : "_length"),
        by_ + " by " + words + (angle ? " angle (m/rad)" : " length, 1 / (dl/dz)"),
        [&](const SpringRow& r) { return 1 / rates(r).ratio; });
  }

 private:
  Table& table_;
  const std::vector<std::optional<SpringRow>>& rows_;
  std::string by_;
};

std::string arm_words(const CornerDescription& d) {
  return d.springs.anti_roll_bar->post_top ? "T bar's tilt" : "anti-roll bar's arm";
}

void add_columns(Table& table, const CornerDescription& d, const RideForm& ride, const SpringModel& model,
                 const std::vector<std::optional<SpringRow>>& rows) {
  const bool centre = ride.coordinate == Driver::wheel_centre_z;
  const std::string by = centre ? "height of the wheel centre" : "height of the contact point",
                    at = centre ? " at the wheel centre" : " at the contact point";
  SpringTable out(table, rows, by);
  using R = SpringRow;
  if (d.spring) {
    out.add("wheel_force_N", "force of the spring" + at + " (N)",
            [](const R& r) { return r.spring.wheel_force; });
    out.add("wheel_rate_N_per_m", "wheel rate (N/m)", [](const R& r) { return r.spring.rate; });
    out.add("motion_ratio_by_travel", "motion ratio by travel (1/m)",
            [](const R& r) { return r.spring.motion_ratio_by_travel; });
    out.add("spring_force_N", "force of the spring (N)", [](const R& r) { return r.spring.spring_force; });
    out.add("wheel_rate_force_share", "share of the spring's force in the wheel rate, -F d2l/dz2",
            [](const R& r) { return r.spring.by_motion_ratio / r.spring.rate; });
  }
  const Suspension& suspension = d.suspension;
  if (suspension.spring && (d.spring || !suspension.rockers.empty()))
    out.add_rates("spring", "spring", false, false, [](const R& r) { return *r.motions.spring; });
  for (std::size_t i = 0; i < suspension.rockers.size(); ++i) {
    const std::string& name = suspension.rockers[i].name;
    out.add_rates(plain_name(name), name == bar_arm ? arm_words(d) : name, true, true,
                  [i](const R& r) { return r.motions.rockers[i]; });
  }
  const SpringParts& parts = d.springs;
  if (parts.damper) {
    if (parts.damper->element)
      out.add_rates("damper", "damper", false, true,
                    [&](const R& r) { return model.rates(r.motions, StopPlace::damper); });
    if (parts.damper->damping)
      out.add("wheel_damping_N_s_per_m", "damping" + at + " (N s/m)", [](const R& r) { return r.damping; });
  }
  if (parts.torsion_bar) {
    out.add_rates("torsion_bar", "torsion bar", true, true,
                  [&](const R& r) { return r.motions.elements[parts.torsion_bar->element]; });
    out.add("torsion_bar_moment_N_m", "moment of the torsion bar (N m)",
            [](const R& r) { return r.torsion.spring_force; });
    out.add("torsion_bar_wheel_force_N", "force of the torsion bar" + at + " (N)",
            [](const R& r) { return r.torsion.wheel_force; });
    out.add("torsion_bar_wheel_rate_N_per_m", "wheel rate of the torsion bar (N/m)",
            [](const R& r) { return r.torsion.rate; });
  }
  if (parts.anti_roll_bar)
    out.add("anti_roll_bar_wheel_rate_N_per_m",
            "rate of the anti-roll bar at each wheel, both travelling oppositely from here (N/m)",
            [&](const R& r) { return anti_roll_rate(d, r.motions); });
  if (parts.heave_spring) {
    out.add_rates("heave_spring", "heave spring", false, true,
                  [&](const R& r) { return r.motions.elements[parts.heave_spring->element]; });
    out.add("heave_spring_force_N", "force of the heave spring (N)",
            [](const R& r) { return r.heave.spring_force; });
    out.add("heave_spring_wheel_force_N",
            "force of the heave spring at each wheel, both travelling equally (N)",
            [](const R& r) { return r.heave.wheel_force / 2; });
    out.add("heave_spring_wheel_rate_N_per_m",
            "rate of the heave spring at each wheel, both travelling equally (N/m)",
            [](const R& r) { return r.heave.rate / 2; });
  }
  if (parts.bump_stop)
    out.add("bump_stop_force_N", "force of the bump stop (N)",
            [](const R& r) { return r.bump.spring_force; });
  if (parts.rebound_stop)
    out.add("rebound_stop_force_N", "force of the rebound stop (N)",
            [](const R& r) { return -r.rebound.spring_force; });
  if (parts.bump_stop || parts.rebound_stop)
    out.add("stop_bottomed", "1 where a stop is at its end",
            [](const R& r) { return r.bottomed ? 1.0 : 0.0; });
  if (parts.heave_spring || parts.torsion_bar || parts.bump_stop || parts.rebound_stop) {
    out.add("total_wheel_force_N", "force of springs and stops" + at + " (N)",
            [](const R& r) { return r.force(); });
    out.add("total_wheel_rate_N_per_m", "wheel rate of springs and stops (N/m)",
            [](const R& r) { return r.rate(); });
  }
  if (ride.tyre_stiffness)
    out.add("ride_rate_N_per_m", "ride rate: wheel rate and tyre in series (N/m)",
            [&](const R& r) { return in_series(r.rate(), ride.tyre_stiffness); });
  if (ride.sprung_mass) {
    out.add("natural_frequency_Hz", "natural frequency of the sprung mass (Hz)",
            [&](const R& r) { return natural_frequency(r.rate(), ride); });
    if (parts.damper && parts.damper->damping)
      out.add("damping_ratio", "damping ratio, c / (2 sqrt(k m)) by the wheel rate",
              [&](const R& r) { return damping_ratio(r.rate(), r.damping, ride); });
  }
}

/// Second derivative of the length across a symmetric axle by opposite travel, whose first one is zero. With
/// the ends e(z) and, mirrored, e(-z), their distance is (x(z) - x(-z), y(z) + y(-z), z(z) - z(-z)).
double by_opposite_travel(const std::array<TravelRates, 3>& end) {
  const double y = std::abs(end[1].value), sign = end[1].value < 0 ? -1 : 1;
  return 2 * (sign * end[1].by_travel + (end[0].ratio * end[0].ratio + end[2].ratio * end[2].ratio) / y);
}

/// Roll rate of a symmetric axle, t^2 (k_w + k_bar) / 2 with the track t and the rates at the contact points:
/// the second derivative of the energy by roll on a plane road, the mean height of the contacts held.
void add_roll_rates(study::Result& result, const CornerDescription& d, const CornerPosition& position) {
  const RideForm by_contact{.coordinate = Driver::contact_z};
  const SpringModel model(d, by_contact);
  const SpringRow here = model.at(position);
  if (here.motions.status != Status::done) return;
  const WheelParameters wheel = wheel_parameters(model.plan(), position);
  const double half_track = std::abs(wheel.contact.y);
  const auto roll_rate = [&](double rate) {
    return measured("N_m_per_deg", 2 * half_track * half_track * rate).fixed(3);
  };
  const study::AddFact fact{result.facts};
  const bool sprung = d.spring || d.springs.torsion_bar;
  double together = 0;
  if (sprung) fact("roll rate of the springs", roll_rate(together = here.own_rate()));
  if (d.springs.anti_roll_bar) {
    const double rate = anti_roll_rate(d, here.motions);
    together += rate;
    fact("roll rate of the anti-roll bar", roll_rate(rate));
  }
  if (d.springs.heave_spring) {
    const double rate = -here.heave.spring_force * by_opposite_travel(here.motions.ends_across[0]) / 2;
    together += rate;
    fact("roll rate of the heave spring, by its force", roll_rate(rate));
  }
  if (!sprung) return;
  // Rolling by a raises the contacts by s and -s, s = t a / 2, and shifts both by y' s to one side, so that
  // the body rises above the road by y' s a; its load is that of both springs. E = k s^2 + load y' s a.
  const double load = 2 * here.force(), shift = wheel.roll_centre_height_geometric / half_track;
  const double jacking = 2 * load * shift * half_track;
  fact("roll rate by the energy of the axle, load held and track free",
       say("{}; {} of it by jacking: the contacts shift sideways against the body, which the roll thus lifts "
           "against the load of {}",
           measured("N_m_per_deg", 2 * half_track * half_track * together + jacking).fixed(3),
           measured("N_m_per_deg", jacking).fixed(3), newtons(load)));
}

/// The place between two positions at which a stop engages or ends: bisection, so that it does not depend on
/// the rows.
double travel_between(const SpringModel& model, CornerPosition before, const CornerPosition& after,
                      const StopDescription& stop, bool rebound, bool end) {
  double low = before.input.value, high = after.input.value;
  for (int i = 0; i < 50 && low != high; ++i) {
    const double middle = (low + high) / 2;
    CornerPosition there = solve_position(model.plan(), before.driver, {middle, before.input.rack}, before);
    if (there.status != Status::done) break;
    if (model.past(there, stop, rebound, end) < 0) {
      low = middle;
      before = std::move(there);
    } else {
      high = middle;
    }
  }
  return (low + high) / 2;
}

void add_stop_facts(study::Result& result, const SpringModel& model, const StopDescription& stop,
                    bool rebound, std::span<const CornerPosition> positions, double rack) {
  const study::AddFact fact{result.facts};
  const std::string name = rebound ? "rebound stop" : "bump stop";
  for (const bool end : {false, true}) {
    if (end && !stop.law.solid_at) continue;
    const CornerPosition* before = nullptr;
    for (const CornerPosition& here : positions) {
      if (here.status != Status::done || here.input.rack != rack) continue;
      if (before) {
        const bool was = model.past(*before, stop, rebound, end) >= 0,
                   is = model.past(here, stop, rebound, end) >= 0;
        if (was != is)
          fact(name + (end ? " bottoms at travel" : " engages at travel"),
               say("{}", millimetres(is ? travel_between(model, *before, here, stop, rebound, end)
                                        : travel_between(model, here, *before, stop, rebound, end))
                             .fixed(3)));
      }
      before = &here;
    }
  }
}

}  // namespace

void check_ride(study::ObjectReader& document, const RideForm& ride, const CornerDescription& description) {
  auto table = document.table("ride");
  if (ride.coordinate == Driver::spring)
    table->error("coordinate", "ratios and rates refer to a height of the wheel",
                 "take wheel_centre_z or contact_z");
  const bool sprung = description.spring || description.springs.torsion_bar;
  if ((ride.sprung_mass || ride.tyre_stiffness) && !sprung)
    table->error(ride.sprung_mass ? "sprung_mass" : "tyre_stiffness",
                 "there is no spring whose stiffness is known",
                 "write stiffness_N_per_mm in [mechanism.spring]");
  if (!ride.wheel_speeds) return;
  const auto& damper = description.springs.damper;
  const auto& speeds = *ride.wheel_speeds;
  if (!damper || (!damper->damping && !damper->curve))
    table->error("wheel_speeds", "there is no damper whose force is known",
                 "write damping_N_s_per_m or a curve in [mechanism.damper]");
  else if (speeds.empty() || std::any_of(speeds.begin(), speeds.end(), [](double v) { return v == 0; }))
    table->error("wheel_speeds", speeds.empty() ? "holds no speed" : "has 0, at which nothing is damped",
                 "for example wheel_speeds_m_per_s = [-0.3, -0.1, 0.1, 0.3]");
  else if (static_cast<double>(speeds.size()) > most_wheel_speeds)
    table->error("wheel_speeds",
                 fmt::format("{} speeds, at most {} are allowed", speeds.size(), most_wheel_speeds));
}

bool has_springs(const CornerDescription& d) {
  return d.spring || !d.suspension.rockers.empty() || d.springs.damper || d.springs.torsion_bar ||
         d.springs.heave_spring;
}

void add_springs(study::Result& result, const CornerDescription& d, const RideForm& ride,
                 std::span<const CornerPosition> positions, std::optional<std::size_t> stated,
                 bool symmetric_axle, const RunContext& context) {
  constexpr std::size_t between_looks = 256;
  const SpringModel model(d, ride);
  std::vector<std::optional<SpringRow>> rows(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i > 0 && i % between_looks == 0 && context.interrupted()) {
      result.status = context.interruption();
      break;
    }
    if (positions[i].status != Status::done) continue;
    rows[i] = model.at(positions[i]);
    if (rows[i]->motions.status != Status::done) rows[i].reset();
  }
  Table& table = result.tables.front();
  add_columns(table, d, ride, model, rows);
  if (!stated || *stated >= rows.size() || !rows[*stated]) return;
  if (const auto& damper = d.springs.damper; damper && (damper->curve || ride.wheel_speeds)) {
    std::vector<DampedPosition> damped;
    std::size_t at = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (positions[i].input.rack != positions[*stated].input.rack) continue;
      if (i == *stated) at = damped.size();
      if (rows[i])
        damped.push_back({positions[i].input.value, model.rates(rows[i]->motions, StopPlace::damper).ratio,
                          rows[i]->rate()});
    }
    add_damping(result, *damper, ride, damped, at);
  }
  const SpringRow& here = *rows[*stated];
  const study::AddFact fact{result.facts};
  const auto rate = [](double value) { return measured("N_per_mm", value).fixed(3); };
  if (ride.tyre_stiffness) {
    fact("wheel rate", rate(here.rate()));
    fact("ride rate", rate(in_series(here.rate(), ride.tyre_stiffness)));
  }
  if (ride.sprung_mass) {
    fact("natural frequency", measured("Hz", natural_frequency(here.rate(), ride)).fixed(3));
    if (std::isfinite(here.damping))
      fact("damping ratio", plain_number(damping_ratio(here.rate(), here.damping, ride)).fixed(3));
  }
  if (d.springs.anti_roll_bar)
    fact("rate of the anti-roll bar at each wheel, opposite travel", rate(anti_roll_rate(d, here.motions)));
  if (symmetric_axle && (ride.sprung_mass || ride.tyre_stiffness || d.springs.anti_roll_bar))
    add_roll_rates(result, d, positions[*stated]);
  const double rack = positions[*stated].input.rack;
  if (d.springs.bump_stop) add_stop_facts(result, model, *d.springs.bump_stop, false, positions, rack);
  if (d.springs.rebound_stop) add_stop_facts(result, model, *d.springs.rebound_stop, true, positions, rack);
}

namespace {

/// Springs and bars of both wheels at one opposite travel: the left wheel, the right one.
using OppositeRows = std::array<SpringRow, 2>;

/// The table of opposite travel: rows without a position have no numbers.
struct OppositeTable {
  Table table{.name = "opposite"};
  std::vector<std::optional<OppositeRows>> found;

  template <class Value>
  void add(std::string key, std::string label, Value&& value) {
    std::vector<double> column;
    for (const auto& row : found) column.push_back(row ? value(*row) : missing);
    table.add(std::move(key), std::move(label), std::move(column));
  }
};

void add_opposite_wheels(OppositeTable& out, const AxleDescription& both) {
  const std::array<const CornerDescription*, 2> wheels{&both.left, &both.right};
  for (const std::size_t side : {0U, 1U}) {
    const std::string word = side == 0 ? "left" : "right";
    const CornerDescription& wheel = *wheels[side];
    for (std::size_t k = 0; k < wheel.suspension.rockers.size(); ++k) {
      const std::string& name = wheel.suspension.rockers[k].name;
      if (name == bar_arm && wheel.springs.anti_roll_bar->post_top) continue;
      out.add(fmt::format("{}_{}_angle_rad", word, plain_name(name)),
              fmt::format("{} {} angle (rad)", word, name == bar_arm ? arm_words(wheel) : name),
              [=](const OppositeRows& rows) { return rows[side].motions.rockers[k].value; });
    }
    if (wheel.spring || wheel.springs.torsion_bar) {
      out.add(word + "_wheel_force_N", fmt::format("force of springs and stops at the {} wheel (N)", word),
              [=](const OppositeRows& rows) { return rows[side].own_force(); });
      out.add(word + "_wheel_rate_N_per_m", fmt::format("{} wheel rate of springs and stops (N/m)", word),
              [=](const OppositeRows& rows) { return rows[side].own_rate(); });
    }
  }
}

void add_opposite_bar(OppositeTable& out, const AxleDescription& both) {
  const auto &left_bar = both.left.springs.anti_roll_bar, &right_bar = both.right.springs.anti_roll_bar;
  if (!left_bar || !right_bar) return;
  const double k = left_bar->stiffness;
  // The twist by a path on which both wheels travel by these shares of its coordinate.
  const auto twist = [&](const OppositeRows& rows, double left, double right) {
    return bar_twist(both, rows[0].motions, rows[1].motions, left, right);
  };
  const auto opposite = [=](const OppositeRows& rows) { return twist(rows, 1, -1); };
  if (left_bar->post_top)
    out.add("anti_roll_bar_tilt_rad", "tilt of the T bar (rad)",
            [=](const OppositeRows& rows) { return opposite(rows).tilt; });
  out.add("twist_rad",
          left_bar->post_top ? "twist of the T bar's post (rad)"
                             : "twist of the anti-roll bar, left less right arm (rad)",
          [=](const OppositeRows& rows) { return opposite(rows).value; });
  out.add("twist_by_travel_rad_per_m", "twist by travel (rad/m)",
          [=](const OppositeRows& rows) { return opposite(rows).by_travel; });
  out.add("anti_roll_bar_moment_N_m", "moment of the anti-roll bar (N m)",
          [=](const OppositeRows& rows) { return k * opposite(rows).value; });
  out.add("left_anti_roll_bar_force_N", "force of the anti-roll bar at the left wheel (N)",
          [=](const OppositeRows& rows) { return k * opposite(rows).value * twist(rows, 1, 0).by_travel; });
  out.add("right_anti_roll_bar_force_N", "force of the anti-roll bar at the right wheel (N)",
          [=](const OppositeRows& rows) { return k * opposite(rows).value * twist(rows, 0, 1).by_travel; });
  out.add("anti_roll_bar_wheel_rate_N_per_m",
          "rate of the anti-roll bar at each wheel, by its stiffness (N/m)", [=](const OppositeRows& rows) {
            const double by_travel = opposite(rows).by_travel;
            return k * by_travel * by_travel / 2;
          });
  out.add("anti_roll_bar_geometric_rate_N_per_m",
          "rate of the anti-roll bar at each wheel, by its moment (N/m)",
          [=](const OppositeRows& rows) { return k * opposite(rows).value * opposite(rows).change / 2; });
}

void add_opposite_heave_spring(OppositeTable& out, const AxleDescription& both) {
  if (!both.left.springs.heave_spring || !both.right.springs.heave_spring) return;
  const SpringLaw& law = both.left.springs.heave_spring->law;
  const auto reference = [](const CornerDescription& d) {
    return d.suspension.elements[d.springs.heave_spring->element].second.at;
  };
  const double drawn = norm(reference(both.left) - reference(both.right));
  const auto across = [](const OppositeRows& rows) {
    Vec3 out;
    const auto &l = rows[0].motions.ends_across[0], &r = rows[1].motions.ends_across[0];
    out.x = l[0].value - r[0].value, out.y = l[1].value - r[1].value, out.z = l[2].value - r[2].value;
    return out;
  };
  const auto push = [=](const OppositeRows& rows) { return force_of(law, drawn - norm(across(rows))).force; };
  out.add("heave_spring_length_m", "length of the heave spring (m)",
          [=](const OppositeRows& rows) { return norm(across(rows)); });
  out.add("heave_spring_force_N", "force of the heave spring (N)", push);
  for (const std::size_t side : {0U, 1U}) {
    const std::string word = side == 0 ? "left" : "right";
    out.add(
        word + "_heave_spring_force_N", fmt::format("force of the heave spring at the {} wheel (N)", word),
        [=](const OppositeRows& rows) {
          const auto& end = rows[side].motions.ends_across[0];
          const Vec3 d = across(rows);
          const double lengthens = (d.x * end[0].ratio + d.y * end[1].ratio + d.z * end[2].ratio) / norm(d);
          return push(rows) * (side == 0 ? -lengthens : lengthens);
        });
  }
}

}  // namespace

void add_opposite_travel(study::Result& result, const AxleDescription& both, const RideForm& ride,
                         std::span<const double> travels, const RunContext& context) {
  const AxlePlan plan = prepare_axle(both.left.suspension, both.right.suspension);
  if (reference_position(plan).status != Status::done) return;  // the sweep says why
  const auto positions =
      sweep_axle(plan, AxleMotion::opposite, travels, {.driver = ride.coordinate}, &context);
  if (positions.size() < travels.size()) result.status = context.interruption();
  const std::array models{SpringModel(both.left, ride), SpringModel(both.right, ride)};
  OppositeTable out;
  for (const AxleRow& row : positions) {
    out.found.emplace_back();
    if (row.position.status != Status::done) continue;
    const OppositeRows at{models[0].at(row.position.left), models[1].at(row.position.right)};
    if (at[0].motions.status == Status::done && at[1].motions.status == Status::done) out.found.back() = at;
  }
  std::vector<double> values;
  for (const AxleRow& row : positions) values.push_back(row.value);
  out.table.add("travel_m", "travel of the left wheel, that of the right one is opposite (m)",
                std::move(values));
  if (std::any_of(out.found.begin(), out.found.end(), [](const auto& row) { return !row; }))
    for (std::size_t i = 0; i < positions.size(); ++i)
      out.table.status.emplace_back(to_string(out.found[i] ? Status::done
                                              : positions[i].position.status == Status::done
                                                  ? Status::singular
                                                  : positions[i].position.status));
  add_opposite_wheels(out, both);
  add_opposite_bar(out, both);
  add_opposite_heave_spring(out, both);
  result.tables.push_back(std::move(out.table));
  const study::AddPlot plot{result, {.table = "opposite", .x = "travel_m"}};
  plot("opposite-twist", "Twist of the anti-roll bar over opposite travel", {"twist_rad"});
  plot("opposite-forces", "Force of the anti-roll bar at the wheels over opposite travel",
       {"left_anti_roll_bar_force_N", "right_anti_roll_bar_force_N"});
  remark_lost(result, positions, "opposite travel (m)");
}

}  // namespace linkwright::suspension
