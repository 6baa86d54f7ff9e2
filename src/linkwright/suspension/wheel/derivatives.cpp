// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/derivatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "linkwright/math/small_lu.h"
#include "linkwright/suspension/wheel/detail/parameters_kernel.h"

namespace linkwright::suspension {
namespace {

/// Numbers with the derivatives of one pass.
constexpr int W = derivative_width;
using T = math::Dual<W>;

template <class D>
Vector3<D> constant(const Vec3& a) {
  return {D(a.x), D(a.y), D(a.z)};
}
template <class D>
std::vector<Vector3<D>> constants(const std::vector<Vec3>& points) {
  std::vector<Vector3<D>> out;
  for (const Vec3& point : points) out.push_back(constant<D>(point));
  return out;
}

template <class D>
BasicSuspension<D> constant(const Suspension& suspension) {
  BasicSuspension<D> out{.side = suspension.side,
                         .wheel = {constant<D>(suspension.wheel.centre), D(suspension.wheel.toe),
                                   D(suspension.wheel.camber), suspension.wheel.tyre_diameter},
                         .rack_direction = suspension.rack_direction,
                         .steering_linkage = suspension.steering_linkage};
  for (const CornerLink& link : suspension.links) {
    out.links.push_back({.type = link.type,
                         .body = constants<D>(link.body),
                         .carrier = constants<D>(link.carrier),
                         .moved_by_rack = link.moved_by_rack,
                         .cross_axis = link.cross_axis});
    if (link.length) out.links.back().length = D(*link.length);
    if (link.made) out.links.back().made = {D((*link.made)[0]), D((*link.made)[1])};
  }
  for (const Coupler& coupler : suspension.couplers) {
    out.couplers.push_back({.first = coupler.first,
                            .fraction = D(coupler.fraction),
                            .second = coupler.second,
                            .point = constant<D>(coupler.point)});
    if (coupler.begin) out.couplers.back().begin = constant<D>(*coupler.begin);
  }
  if (suspension.spring)
    out.spring = {constant<D>(suspension.spring->body), constant<D>(suspension.spring->moving),
                  suspension.spring->link, suspension.spring->rocker, suspension.spring->body_part};
  const auto fixed = [](const FixedPoint& point) {
    return BasicFixedPoint<D>{constant<D>(point.at), point.part};
  };
  for (const Rocker& rocker : suspension.rockers) {
    out.rockers.push_back({.axis = {constant<D>(rocker.axis[0]), constant<D>(rocker.axis[1])},
                           .rod = constant<D>(rocker.rod),
                           .driven_by = fixed(rocker.driven_by)});
    if (rocker.length) out.rockers.back().length = D(*rocker.length);
  }
  for (const CornerElement& element : suspension.elements)
    out.elements.push_back({.first = fixed(element.first),
                            .second = fixed(element.second),
                            .turn = element.turn,
                            .across = element.across});
  return out;
}

BasicCornerPlace<T> constant(const CornerPlace& place) {
  BasicCornerPlace<T> out;
  out.carrier.centre = constant<T>(place.carrier.centre);
  for (int i = 0; i < 3; ++i) out.carrier.rotation.row[i] = constant<T>(place.carrier.rotation.row[i]);
  out.arm = T(place.arm);
  return out;
}

template <int N>
using Column = std::array<double, N>;

/// A number in each direction.
struct Directions {
  std::array<double, W> of{};
  double& operator[](int k) { return of[k]; }
  double operator[](int k) const { return of[k]; }
  Directions& operator-=(const Directions& other) {
    for (int k = 0; k < W; ++k) of[k] -= other.of[k];
    return *this;
  }
  friend Directions operator*(double factor, Directions a) {
    for (double& value : a.of) value *= factor;
    return a;
  }
};
template <int N>
using Columns = std::array<Directions, N>;  // [row][direction]

template <int N>
Column<N> direction(const Columns<N>& columns, int k) {
  Column<N> out;
  for (int i = 0; i < N; ++i) out[i] = columns[i][k];
  return out;
}

/// A metre of travel that turns the wheel by a million radians is no motion any more.
bool slow_enough(std::span<const double> rates) {
  double square = 0;
  for (const double rate : rates) square += rate * rate;
  return std::sqrt(square) < 1e6;
}

template <int N>
Twist twist(const Column<N>& x) {
  Twist out{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  if constexpr (N == 7) out.arm = x[6];
  return out;
}

/// The place with its derivatives.
template <int N>
BasicCornerPlace<T> moved(const CornerPosition& position, const Columns<N>& shifts) {
  BasicCornerPlace<T> out = constant(position.place);
  const Mat3& rotation = position.place.carrier.rotation;
  for (int k = 0; k < W; ++k) {
    const Twist by = twist<N>(direction<N>(shifts, k));
    out.carrier.centre.x.by[k] = by.velocity.x;
    out.carrier.centre.y.by[k] = by.velocity.y;
    out.carrier.centre.z.by[k] = by.velocity.z;
    const auto& [x, y, z] = rotation.row;
    const auto set = [&](Vector3<T>& row, const Vec3& change) {
      row.x.by[k] = change.x;
      row.y.by[k] = change.y;
      row.z.by[k] = change.z;
    };
    // turning x (each column of the rotation), by rows
    set(out.carrier.rotation.row[0], by.turning.y * z - by.turning.z * y);
    set(out.carrier.rotation.row[1], by.turning.z * x - by.turning.x * z);
    set(out.carrier.rotation.row[2], by.turning.x * y - by.turning.y * x);
    out.arm.by[k] = by.arm;
  }
  return out;
}

/// A motion and its change along the directions of the place: J x = b gives J x' = b' - J' x.
template <int N>
BasicTwist<T> rate_with_change(const BasicCornerEquations<T>& equations, const Column<N>& x, bool steering,
                               const math::SmallLu<N>& lu) {
  Columns<N> right;
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < W; ++k) {
      double sum = steering ? -equations.by_rack[i].by[k] : 0;
      for (int j = 0; j < N; ++j) sum -= equations.jacobian[i][j].by[k] * x[j];
      right[i][k] = sum;
    }
  const Columns<N> change = lu.solve(right);
  std::array<T, N> dual;
  for (int i = 0; i < N; ++i) {
    dual[i].value = x[i];
    for (int k = 0; k < W; ++k) dual[i].by[k] = change[i][k];
  }
  BasicTwist<T> made{{dual[0], dual[1], dual[2]}, {dual[3], dual[4], dual[5]}};
  if constexpr (N == 7) made.arm = dual[6];
  return made;
}

/// The equations at a position: what all derivatives there have in common.
template <int N>
class Linearised {
 public:
  Linearised(const CornerPlan& plan, const CornerPosition& position) : position_(position) {
    CornerEquations equations;
    const double rack = position.input.rack;
    const auto factors = [&](Driver driver) {
      evaluate(plan, position.place, rack, driver, 0, equations);
      math::SmallLu<N> lu;
      lu.factor(equations.jacobian);
      return lu;
    };
    by_height_ = factors(Driver::wheel_centre_z);
    by_driver_ = position.driver == Driver::wheel_centre_z ? by_height_ : factors(position.driver);
    Columns<N> right{};
    right[N - 1][0] = 1;
    for (int i = 0; i < N - 1; ++i) right[i][1] = -equations.by_rack[i];
    const Columns<N> motions = by_height_.solve(right);
    bump_ = direction<N>(motions, 0);
    steer_ = direction<N>(motions, 1);
    moves_ = slow_enough(bump_) && slow_enough(steer_);
  }

  bool moves() const { return moves_; }
  const Column<N>& bump() const { return bump_; }
  const Column<N>& steer() const { return steer_; }

  /// Derivatives of the position by the numbers of `plan`.
  Columns<N> shifts(const BasicCornerPlan<T>& plan) const {
    BasicCornerEquations<T> equations;
    kernel::evaluate(plan, constant(position_.place), T(position_.input.rack), position_.driver,
                     T(position_.input.value), equations);
    Columns<N> right;
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < W; ++k) right[i][k] = -equations.residual[i].by[k];
    return by_driver_.solve(right);
  }

  /// The place with its derivatives.
  BasicCornerPlace<T> moved(const Columns<N>& shifts) const {
    return suspension::moved<N>(position_, shifts);
  }

  /// Adds what the motions show.
  void add_rates(const BasicCornerPlan<T>& plan, const BasicCornerPlace<T>& place, const T& rack,
                 BasicWheelParameters<T>& out) const {
    BasicCornerEquations<T> equations;
    kernel::evaluate(plan, place, rack, Driver::wheel_centre_z, T(0), equations);
    kernel::add_rates(plan, place, rack, rate_with_change<N>(equations, bump_, false, by_height_),
                      rate_with_change<N>(equations, steer_, true, by_height_), out);
  }

 private:
  const CornerPosition& position_;
  math::SmallLu<N> by_height_, by_driver_;
  Column<N> bump_{}, steer_{};
  bool moves_ = true;
};

/// Values and derivatives out of dual parameters; `by[k]` may end before the last direction.
void take_apart(const BasicWheelParameters<T>& from, WheelParameters& values, std::span<WheelParameters> by) {
  for_each_number(from, values, [](const T& a, double& to) { to = a.value; });
  for (std::size_t k = 0; k < by.size(); ++k)
    for_each_number(from, by[k], [k](const T& a, double& to) {
      to = std::isfinite(a.value) ? a.by[k] : WheelParameters::missing;
    });
}

WheelParameters unknown(Status status) {
  WheelParameters out;
  const BasicWheelParameters<double> nothing;
  for_each_number(nothing, out, [](double, double& to) { to = WheelParameters::missing; });
  out.status = status;
  return out;
}

template <int N>
WheelDerivatives by_numbers(const DerivativePlan& plan, const CornerPosition& position, Extent extent) {
  WheelDerivatives out;
  out.by.resize(plan.numbers.size());
  out.shift.resize(plan.numbers.size());
  const Linearised<N> linear(plan.plan, position);
  if (!linear.moves() || plan.passes.empty()) out.parameters = wheel_parameters(plan.plan, position);
  if (!linear.moves()) {
    out.status = Status::singular;
    for (WheelParameters& by : out.by) by = unknown(out.status);
    const Vec3 none{WheelParameters::missing, WheelParameters::missing, WheelParameters::missing};
    for (Twist& shift : out.shift) shift = {none, none, WheelParameters::missing};
    return out;
  }
  const T rack(position.input.rack);
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const auto& pass = plan.passes[i];
    const Columns<N> shifts = linear.shifts(pass);
    const auto place = linear.moved(shifts);
    auto parameters = kernel::parameters_at_rest(pass, place, rack);
    if (extent == Extent::all) {
      kernel::add_constructions(pass, place, rack, parameters);
      linear.add_rates(pass, place, rack, parameters);
    }
    const std::size_t first = i * W, count = std::min<std::size_t>(W, plan.numbers.size() - first);
    take_apart(parameters, out.parameters, std::span(out.by).subspan(first, count));
    for (std::size_t k = 0; k < count; ++k)
      out.shift[first + k] = twist<N>(direction<N>(shifts, static_cast<int>(k)));
  }
  return out;
}

template <int N>
InputDerivatives by_inputs(const DerivativePlan& plan, const CornerPosition& position) {
  InputDerivatives out;
  const Linearised<N> linear(plan.plan, position);
  if (!linear.moves()) {
    out.status = Status::singular;
    out.parameters = wheel_parameters(plan.plan, position);
    out.by_travel = out.by_rack = unknown(out.status);
    return out;
  }
  Columns<N> shifts{};
  for (int i = 0; i < N; ++i) {
    shifts[i][0] = linear.bump()[i];
    shifts[i][1] = linear.steer()[i];
  }
  const auto place = linear.moved(shifts);
  const auto rack = T::variable(position.input.rack, 1);
  auto parameters = kernel::parameters_at_rest(plan.inputs, place, rack);
  kernel::add_constructions(plan.inputs, place, rack, parameters);
  linear.add_rates(plan.inputs, place, rack, parameters);
  std::array<WheelParameters, 2> by;
  take_apart(parameters, out.parameters, by);
  out.by_travel = by[0];
  out.by_rack = by[1];
  return out;
}

template <int N>
CornerMotions motions(const DerivativePlan& plan, const CornerPosition& position, Driver travel) {
  CornerMotions out;
  const double rack = position.input.rack;
  CornerEquations equations;
  evaluate(plan.plan, position.place, rack, travel, 0, equations);
  math::SmallLu<N> lu;
  lu.factor(equations.jacobian);
  Column<N> unit_travel{};
  unit_travel[N - 1] = 1;
  const Column<N> motion = lu.solve(unit_travel);
  if (!slow_enough(motion)) {
    out.status = Status::singular;
    out.rockers.resize(plan.plan.rockers.size());
    out.elements.resize(plan.plan.elements.size());
    for (const auto& element : plan.plan.elements)
      if (element.across) out.ends_across.emplace_back();
    out.rod_ends.resize(plan.plan.rockers.size());
    if (plan.plan.spring) out.spring.emplace();
    return out;
  }
  Columns<N> shifts{};
  for (int i = 0; i < N; ++i) shifts[i][0] = motion[i];
  const auto place = moved<N>(position, shifts);
  const kernel::Placed<T> placed{plan.inputs, place, T(rack)};
  BasicCornerEquations<T> changes;
  kernel::evaluate(plan.inputs, place, T(rack), travel, T(0), changes);
  const BasicTwist<T> motion_and_change = rate_with_change<N>(changes, motion, false, lu);
  const auto rates = [&](auto&& value_of) {
    std::array<T, max_unknowns> by{};
    T by_rack(0);
    kernel::Row<T> row{by, by_rack};
    const T value = value_of(row);
    const T rate = kernel::rate_of(row, motion_and_change, 0);
    return TravelRates{value.value, rate.value, rate.by[0]};
  };
  for (const auto& rocker : plan.inputs.rockers)
    out.rockers.push_back(rates([&](kernel::Row<T>& row) {
      const auto pose = kernel::rocker_pose(placed, rocker);
      kernel::add_rocker_angle(placed, rocker, pose, T(1), row);
      return atan2(pose.sine, pose.cosine);
    }));
  for (const auto& element : plan.inputs.elements)
    out.elements.push_back(
        rates([&](kernel::Row<T>& row) { return kernel::element_value(placed, element, row); }));
  const auto coordinates = [&](const BasicPartPoint<T>& point) {
    std::array<TravelRates, 3> end;
    for (std::size_t i = 0; i < 3; ++i)
      end[i] = rates([&](kernel::Row<T>& row) {
        math::Vector3<T> along;
        (i == 0 ? along.x : i == 1 ? along.y : along.z) = T(1);
        kernel::add_part_point(placed, point, along, row);
        return dot(along, kernel::part_point(placed, point));
      });
    return end;
  };
  for (const auto& element : plan.inputs.elements)
    if (element.across) out.ends_across.push_back(coordinates(element.second));
  for (const auto& rocker : plan.inputs.rockers) out.rod_ends.push_back(coordinates(rocker.driver));
  if (plan.inputs.spring)
    out.spring = rates([&](kernel::Row<T>& row) { return kernel::spring_length(placed, row); });
  return out;
}

/// Numbers with the derivatives of one pass, and those along the travel of the wheel.
using M = math::MixedDual<W>;

Vector3<M> mixed(const Vector3<T>& value, const Vector3<T>& by) {
  return {M(value.x, by.x), M(value.y, by.y), M(value.z, by.z)};
}

/// The place with its derivatives by numbers, and its motion along the travel with those of the motion.
BasicCornerPlace<M> mixed(const BasicCornerPlace<T>& place, const BasicTwist<T>& motion) {
  BasicCornerPlace<M> out;
  out.carrier.centre = mixed(place.carrier.centre, motion.velocity);
  const auto& [x, y, z] = place.carrier.rotation.row;
  const Vector3<T>& turn = motion.turning;
  auto& rows = out.carrier.rotation.row;
  rows[0] = mixed(x, turn.y * z - turn.z * y);
  rows[1] = mixed(y, turn.z * x - turn.x * z);
  rows[2] = mixed(z, turn.x * y - turn.y * x);
  out.arm = M(place.arm, motion.arm);
  return out;
}

template <int N>
BasicTwist<T> dual_twist(const Column<N>& x, const Columns<N>& by) {
  std::array<T, N> dual;
  for (int i = 0; i < N; ++i) {
    dual[i].value = x[i];
    for (int k = 0; k < W; ++k) dual[i].by[k] = by[i][k];
  }
  BasicTwist<T> out{{dual[0], dual[1], dual[2]}, {dual[3], dual[4], dual[5]}};
  if constexpr (N == 7) out.arm = dual[6];
  return out;
}

/// A pass of `motions_by_numbers`: the place, the motion x of J x = b along the travel and its change x' of J
/// x' = -J' x, all with their derivatives by the numbers of the pass.
template <int N>
void motions_of_pass(const BasicCornerPlan<M>& pass, const CornerPosition& position, Driver travel,
                     const math::SmallLu<N>& by_travel, const math::SmallLu<N>& by_driver,
                     const Column<N>& motion, std::size_t count, std::size_t first, MotionDerivatives& out) {
  const M rack(position.input.rack);
  BasicCornerEquations<M> equations;
  const BasicTwist<T> still;
  kernel::evaluate(pass, mixed(constant(position.place), still), rack, position.driver,
                   M(position.input.value), equations);
  Columns<N> right{};
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < W; ++k) right[i][k] = -equations.residual[i].value.by[k];
  const BasicCornerPlace<T> shifted = moved<N>(position, by_driver.solve(right));

  kernel::evaluate(pass, mixed(shifted, still), rack, travel, M(0), equations);
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < W; ++k) {
      right[i][k] = 0;
      for (int j = 0; j < N; ++j) right[i][k] -= equations.jacobian[i][j].value.by[k] * motion[j];
    }
  const Columns<N> motion_by = by_travel.solve(right);
  const BasicTwist<T> twist = dual_twist<N>(motion, motion_by);

  const BasicCornerPlace<M> place = mixed(shifted, twist);
  kernel::evaluate(pass, place, rack, travel, M(0), equations);
  Column<N> bend{};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) bend[i] -= equations.jacobian[i][j].by.value * motion[j];
  const Column<N> change = by_travel.solve(bend);
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < W; ++k) {
      right[i][k] = 0;
      for (int j = 0; j < N; ++j) {
        const M& entry = equations.jacobian[i][j];
        right[i][k] -=
            entry.by.by[k] * motion[j] + entry.by.value * motion_by[j][k] + entry.value.by[k] * change[j];
      }
    }
  const BasicTwist<T> turn = dual_twist<N>(change, by_travel.solve(right));
  const BasicTwist<M> both{mixed(twist.velocity, turn.velocity), mixed(twist.turning, turn.turning),
                           M(twist.arm, turn.arm)};

  const kernel::Placed<M> placed{pass, place, rack};
  // Values, and derivatives by the numbers of this pass.
  const auto take = [&](auto&& value_of, TravelRates& value, auto&& of) {
    std::array<M, max_unknowns> by{};
    M by_rack(0);
    kernel::Row<M> row{by, by_rack};
    const M length = value_of(row), rate = kernel::rate_of(row, both, 0);
    value = {length.value.value, rate.value.value, rate.by.value};
    for (std::size_t k = 0; k < count; ++k)
      of(out.by[first + k]) = {length.value.by[k], rate.value.by[k], rate.by.by[k]};
  };
  for (std::size_t r = 0; r < pass.rockers.size(); ++r)
    take(
        [&](kernel::Row<M>& row) {
          const auto pose = kernel::rocker_pose(placed, pass.rockers[r]);
          kernel::add_rocker_angle(placed, pass.rockers[r], pose, M(1), row);
          return atan2(pose.sine, pose.cosine);
        },
        out.motions.rockers[r], [r](MotionRates& rates) -> TravelRates& { return rates.rockers[r]; });
  for (std::size_t e = 0; e < pass.elements.size(); ++e)
    take([&](kernel::Row<M>& row) { return kernel::element_value(placed, pass.elements[e], row); },
         out.motions.elements[e], [e](MotionRates& rates) -> TravelRates& { return rates.elements[e]; });
  if (!pass.spring) return;
  take([&](kernel::Row<M>& row) { return kernel::spring_length(placed, row); }, out.motions.spring,
       [](MotionRates& rates) -> TravelRates& { return rates.spring; });
  out.motions.spring_drawn = pass.spring->length.value.value;
  for (std::size_t k = 0; k < count; ++k) out.by[first + k].spring_drawn = pass.spring->length.value.by[k];
}

template <int N>
MotionDerivatives motions_by_numbers(const MotionPlan& plan, const CornerPosition& position, Driver travel) {
  MotionDerivatives out;
  out.motions.rockers.resize(plan.plan.rockers.size());
  out.motions.elements.resize(plan.plan.elements.size());
  out.by.resize(plan.numbers, out.motions);
  CornerEquations equations;
  const auto factors = [&](Driver driver) {
    evaluate(plan.plan, position.place, position.input.rack, driver, 0, equations);
    math::SmallLu<N> lu;
    lu.factor(equations.jacobian);
    return lu;
  };
  const math::SmallLu<N> by_travel = factors(travel);
  const math::SmallLu<N> by_driver = position.driver == travel ? by_travel : factors(position.driver);
  Column<N> unit_travel{};
  unit_travel[N - 1] = 1;
  const Column<N> motion = by_travel.solve(unit_travel);
  if (!slow_enough(motion)) {
    out.status = Status::singular;
    return out;
  }
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const std::size_t first = i * W,
                      count = std::min<std::size_t>(W, plan.numbers - std::min(first, plan.numbers));
    motions_of_pass<N>(plan.passes[i], position, travel, by_travel, by_driver, motion, count, first, out);
  }
  return out;
}

}  // namespace

DerivativePlan prepare_derivatives(const Suspension& suspension, std::vector<DesignNumber> numbers) {
  DerivativePlan out{.plan = prepare_suspension(suspension), .numbers = std::move(numbers)};
  const auto constants = constant<T>(suspension);
  for (std::size_t first = 0; first < out.numbers.size(); first += derivative_width) {
    auto varied = constants;
    for (std::size_t k = first; k < out.numbers.size() && k < first + derivative_width; ++k)
      design_value(varied, out.numbers[k]).by[k - first] = 1;
    out.passes.push_back(kernel::prepare(varied));
  }
  out.inputs = kernel::prepare(constants);
  return out;
}

WheelDerivatives wheel_derivatives(const DerivativePlan& plan, const CornerPosition& position,
                                   Extent extent) {
  return plan.plan.unknowns == 7 ? by_numbers<7>(plan, position, extent)
                                 : by_numbers<6>(plan, position, extent);
}

InputDerivatives input_derivatives(const DerivativePlan& plan, const CornerPosition& position) {
  return plan.plan.unknowns == 7 ? by_inputs<7>(plan, position) : by_inputs<6>(plan, position);
}

CornerMotions corner_motions(const DerivativePlan& plan, const CornerPosition& position, Driver travel) {
  return plan.plan.unknowns == 7 ? motions<7>(plan, position, travel) : motions<6>(plan, position, travel);
}

MotionPlan prepare_motions(const Suspension& suspension, std::span<const DesignNumber> numbers) {
  MotionPlan out{.plan = prepare_suspension(suspension), .numbers = numbers.size(), .passes = {}};
  const auto constants = constant<M>(suspension);
  for (std::size_t first = 0; first == 0 || first < numbers.size(); first += derivative_width) {
    auto varied = constants;
    for (std::size_t k = first; k < numbers.size() && k < first + derivative_width; ++k)
      design_value(varied, numbers[k]).value.by[k - first] = 1;
    out.passes.push_back(kernel::prepare(varied));
  }
  return out;
}

MotionDerivatives motion_derivatives(const MotionPlan& plan, const CornerPosition& position, Driver travel) {
  return plan.plan.unknowns == 7 ? motions_by_numbers<7>(plan, position, travel)
                                 : motions_by_numbers<6>(plan, position, travel);
}

}  // namespace linkwright::suspension
