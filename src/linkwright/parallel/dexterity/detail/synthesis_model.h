// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/parallel/dexterity/dexterity.h"
#include "linkwright/parallel/dexterity/synthesis.h"

/// The model that the searches of dexterity_synthesis.h share. Their unknowns are the dimensions of the
/// family, then, where the travel of the arms counts, the least and the largest outward angle, then mounting
/// and ratio.
namespace linkwright::parallel {

/// A limit of one pose, one entry of a working set.
struct PoseLimit {
  enum Kind { conditioning, input, output, side_swing, arm_low, arm_high, constraint } kind = conditioning;
  int leg = 0;
  std::size_t pose = 0;
  friend bool operator==(const PoseLimit&, const PoseLimit&) = default;
};
inline constexpr int pose_limit_kinds = 7;

/// A limit that is missed by less, dimensionless, is met.
inline constexpr double feasible = 1e-9;

/// The pose that is closest to a limit, of all that were looked at.
struct Extreme {
  double value = 0;
  std::size_t pose = 0;
};
/// Extremes of all nodes, a leg each: input_square, output, side; outward angles of the arms.
struct Extremes {
  Extreme conditioning, constraint;
  std::array<Extreme, max_legs> input_square, output, side, lowest, highest;
};

class DexterityModel {
 public:
  /// Passes over many nodes or cells look at `context`, if there is one, and throw Interrupted: the first
  /// some thousand are always looked at.
  explicit DexterityModel(const DexterityTask& task, const RunContext* context = nullptr);

  const DexterityTask& task() const { return task_; }
  int dimensions() const { return dimensions_; }
  int legs() const { return legs_; }
  bool travels() const { return travels_; }  ///< angles of the arms are unknowns
  int unknowns() const { return dimensions_ + 2 * travels_ + 2 * task_.pi_joint.has_value(); }
  std::span<const double> lower() const { return lower_; }
  std::span<const double> upper() const { return upper_; }
  int low_angle() const { return dimensions_; }
  int mounting() const { return dimensions_ + 2; }
  int ratio() const { return dimensions_ + 3; }
  std::size_t nodes() const { return nodes_; }

  /// Place of a pose, local to the region, and its orientation.
  struct At {
    Vec3 place;
    std::size_t orientation = 0;
    std::array<double, 3> coordinates{};
  };
  At at(std::size_t node) const;

  /// The robot of these unknowns, with the sign of det C that it has in the middle of the region.
  DesignedRobot designed(std::span<const double> unknowns) const;
  const DexterityMeasures& measures() const { return measures_; }

  /// At all nodes, or at a few of them that stand for all. `work` is scratch.
  struct Work {
    SetDexterity set;
  };
  Extremes extremes(const DesignedRobot& designed, Work& work, bool few = false) const;
  std::size_t poses(bool few) const { return few ? few_points_.size() * groups_.size() : nodes_; }
  /// Nodes of the few.
  std::vector<std::size_t> few() const;
  /// One index at all nodes, as it is in Extremes.
  void indices(const DesignedRobot& designed, PoseLimit::Kind kind, int leg, Work& work,
               std::vector<double>& out) const;
  /// Mean of the conditioning over the cells, with derivatives if there is room for them.
  double mean(const DesignedRobot& designed, Work& work, std::span<double> by) const;
  std::size_t cells() const { return cell_weight_.size() * task_.orientations.size(); }

  /// Number of legs that a limit counts for: all, or one that stands for the pose.
  int entries(PoseLimit::Kind kind) const {
    return kind == PoseLimit::conditioning || kind == PoseLimit::constraint ? 1 : legs_;
  }
  /// Limits that are asked for, of each pose.
  bool wants(PoseLimit::Kind kind) const;
  /// Bound on the index, for kinds that have one; for `side_swing` on the sine.
  double bound(PoseLimit::Kind kind) const;
  /// g <= 0 of a pose from what was measured there, dimensionless, with derivatives by all unknowns.
  double limit(const PoseLimit& which, const PoseDexterity<double>& there, std::span<const double> unknowns,
               std::span<double> by) const;
  /// The same from an extreme of all nodes, without derivatives.
  double limit(PoseLimit::Kind kind, const Extreme& extreme, std::span<const double> unknowns) const;

  /// Limits of the design as a whole: g <= 0 of each, with the derivatives by all unknowns one after the
  /// other.
  struct Whole {
    DexterityLimit limit;
    double value, bound;
    bool at_least;
    double excess;
  };
  void whole(std::span<const double> unknowns, std::vector<Whole>& out, std::vector<double>* by) const;

  /// Unknowns of a design; angles are those that it uses.
  std::vector<double> unknowns_of(std::span<const double> x, const Extremes& extremes) const;
  std::vector<double> design_of(std::span<const double> unknowns) const;
  /// Outward angles that are used (rad).
  struct Travel {
    double low, high;
  };
  Travel travel(const Extremes& extremes) const;

  /// The cost to be minimised, for given extremes (and mean, where it is the goal).
  double cost(std::span<const double> unknowns, const Extremes& extremes, double mean) const;
  /// Sum of what limits are missed by, with the angles that are used.
  double violation(std::span<const double> x, const Extremes& extremes) const;

 private:
  /// In parts, between which a pass may end; of one orientation.
  using Parts = std::vector<PoseSet>;
  struct Group {
    Parts all, few, cells;
  };
  DexterityTask task_;
  const RunContext* context_;
  int dimensions_, legs_;
  bool travels_;
  DexterityMeasures measures_;
  std::vector<RegionPoint> points_;
  std::vector<std::size_t> few_points_;
  std::vector<double> cell_weight_;
  std::vector<Group> groups_;
  std::size_t nodes_ = 0;
  std::vector<double> lower_, upper_;
};

}  // namespace linkwright::parallel
