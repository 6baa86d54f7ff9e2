#include "linkwright/core/units.h"

#include <array>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

constexpr std::array length_units{Unit{"m"}, Unit{"mm", 1, 1e3}, Unit{"cm", 1, 1e2}, Unit{"um", 1, 1e6},
                                  Unit{"in", 254, 1e4}};
constexpr std::array angle_units{Unit{"rad"}, Unit{"deg", pi, 180}};
constexpr std::array time_units{Unit{"s"}, Unit{"ms", 1, 1e3}};
constexpr std::array speed_angular_units{Unit{"rad_per_s"}, Unit{"deg_per_s", pi, 180}, Unit{"rpm", pi, 30}};
constexpr std::array acceleration_angular_units{Unit{"rad_per_s2"}, Unit{"deg_per_s2", pi, 180}};
constexpr std::array speed_units{Unit{"m_per_s"}, Unit{"mm_per_s", 1, 1e3}};
constexpr std::array acceleration_units{Unit{"m_per_s2"}, Unit{"mm_per_s2", 1, 1e3}};
constexpr std::array mass_units{Unit{"kg"}, Unit{"g", 1, 1e3}};
constexpr std::array inertia_units{Unit{"kg_m2"}, Unit{"kg_cm2", 1, 1e4}, Unit{"kg_mm2", 1, 1e6},
                                   Unit{"g_mm2", 1, 1e9}};
constexpr std::array area_units{Unit{"m2"}, Unit{"cm2", 1, 1e4}, Unit{"mm2", 1, 1e6}};
constexpr std::array force_units{Unit{"N"}, Unit{"kN", 1e3, 1}};
constexpr std::array torque_units{Unit{"N_m"}, Unit{"N_mm", 1, 1e3}};
constexpr std::array frequency_units{Unit{"Hz"}, Unit{"per_min", 1, 60}};
constexpr std::array jerk_units{Unit{"m_per_s3"}, Unit{"mm_per_s3", 1, 1e3}};
constexpr std::array jerk_angular_units{Unit{"rad_per_s3"}, Unit{"deg_per_s3", pi, 180}};
constexpr std::array power_units{Unit{"W"}, Unit{"kW", 1e3, 1}};
constexpr std::array energy_units{Unit{"J"}, Unit{"kJ", 1e3, 1}};

constexpr std::array stiffness_units{Unit{"N_per_m"}, Unit{"N_per_mm", 1e3, 1}};
constexpr std::array stiffness_angular_units{Unit{"N_m_per_rad"}, Unit{"N_m_per_deg", 180, pi}};
constexpr std::array damping_units{Unit{"N_s_per_m"}};
constexpr std::array damping_angular_units{Unit{"N_m_s_per_rad"}};
constexpr std::array angle_by_length_units{Unit{"rad_per_m"}, Unit{"deg_per_m", pi, 180},
                                           Unit{"deg_per_mm", 1e3 * pi, 180}};

constexpr std::array density_units{Unit{"kg_per_m3"}, Unit{"g_per_cm3", 1e3, 1}};
constexpr std::array pressure_units{Unit{"Pa"}, Unit{"kPa", 1e3, 1}, Unit{"MPa", 1e6, 1},
                                    Unit{"GPa", 1e9, 1}};
constexpr std::array second_moment_of_area_units{Unit{"m4"}, Unit{"cm4", 1, 1e8}, Unit{"mm4", 1, 1e12}};

constexpr std::array all_dimensions{Dimension::length,
                                    Dimension::angle,
                                    Dimension::time,
                                    Dimension::speed_angular,
                                    Dimension::speed,
                                    Dimension::acceleration,
                                    Dimension::mass,
                                    Dimension::acceleration_angular,
                                    Dimension::inertia,
                                    Dimension::area,
                                    Dimension::force,
                                    Dimension::torque,
                                    Dimension::frequency,
                                    Dimension::jerk,
                                    Dimension::jerk_angular,
                                    Dimension::power,
                                    Dimension::energy,
                                    Dimension::stiffness,
                                    Dimension::stiffness_angular,
                                    Dimension::damping,
                                    Dimension::damping_angular,
                                    Dimension::angle_by_length,
                                    Dimension::density,
                                    Dimension::pressure,
                                    Dimension::second_moment_of_area};

}  // namespace

std::span<const Unit> units(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return {};
    case Dimension::length:
      return length_units;
    case Dimension::angle:
      return angle_units;
    case Dimension::time:
      return time_units;
    case Dimension::speed_angular:
      return speed_angular_units;
    case Dimension::acceleration_angular:
      return acceleration_angular_units;
    case Dimension::speed:
      return speed_units;
    case Dimension::acceleration:
      return acceleration_units;
    case Dimension::mass:
      return mass_units;
    case Dimension::inertia:
      return inertia_units;
    case Dimension::area:
      return area_units;
    case Dimension::force:
      return force_units;
    case Dimension::torque:
      return torque_units;
    case Dimension::frequency:
      return frequency_units;
    case Dimension::jerk:
      return jerk_units;
    case Dimension::jerk_angular:
      return jerk_angular_units;
    case Dimension::power:
      return power_units;
    case Dimension::energy:
      return energy_units;
    case Dimension::stiffness:
      return stiffness_units;
    case Dimension::stiffness_angular:
      return stiffness_angular_units;
    case Dimension::damping:
      return damping_units;
    case Dimension::damping_angular:
      return damping_angular_units;
    case Dimension::angle_by_length:
      return angle_by_length_units;
    case Dimension::density:
      return density_units;
    case Dimension::pressure:
      return pressure_units;
    case Dimension::second_moment_of_area:
      return second_moment_of_area_units;
  }
  return {};
}

const Unit* find_unit(Dimension dimension, std::string_view suffix) {
  for (const Unit& unit : units(dimension))
    if (unit.suffix == suffix) return &unit;
  return nullptr;
}

std::string si_key(std::string_view base, Dimension dimension) {
  std::string key(base);
  if (dimension != Dimension::none) key.append("_").append(units(dimension).front().suffix);
  return key;
}

std::optional<UnitKey> split_unit(std::string_view key) {
  std::optional<UnitKey> longest;
  for (Dimension dimension : all_dimensions) {
    for (const Unit& unit : units(dimension)) {
      const std::size_t n = unit.suffix.size();
      if (key.size() < n + 2 || !key.ends_with(unit.suffix) || key[key.size() - n - 1] != '_') continue;
      if (!longest || n > longest->unit->suffix.size())
        longest = UnitKey{key.substr(0, key.size() - n - 1), &unit, dimension};
    }
  }
  return longest;
}

std::string_view describe(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "a number without unit";
    case Dimension::length:
      return "a length";
    case Dimension::angle:
      return "an angle";
    case Dimension::time:
      return "a time";
    case Dimension::speed_angular:
      return "an angular speed";
    case Dimension::acceleration_angular:
      return "an angular acceleration";
    case Dimension::speed:
      return "a speed";
    case Dimension::acceleration:
      return "an acceleration";
    case Dimension::mass:
      return "a mass";
    case Dimension::inertia:
      return "a moment of inertia";
    case Dimension::area:
      return "an area";
    case Dimension::force:
      return "a force";
    case Dimension::torque:
      return "a torque";
    case Dimension::frequency:
      return "a frequency";
    case Dimension::jerk:
      return "a jerk";
    case Dimension::jerk_angular:
      return "an angular jerk";
    case Dimension::power:
      return "a power";
    case Dimension::energy:
      return "an energy";
    case Dimension::stiffness:
      return "a stiffness";
    case Dimension::stiffness_angular:
      return "a torsional stiffness";
    case Dimension::damping:
      return "a damping";
    case Dimension::damping_angular:
      return "a torsional damping";
    case Dimension::angle_by_length:
      return "an angle by length";
    case Dimension::density:
      return "a density";
    case Dimension::pressure:
      return "a stress or modulus";
    case Dimension::second_moment_of_area:
      return "a second moment of area";
  }
  return "a number";
}

std::string readable_unit(std::string_view suffix) {
  std::string text;
  if (const std::size_t at = suffix.find("_per_"); at != std::string_view::npos) {
    text = suffix.substr(0, at);
    text += '/';
    suffix.remove_prefix(at + 5);
  }
  for (char c : suffix) text += c == '_' ? ' ' : c;
  return text;
}

}  // namespace linkwright
