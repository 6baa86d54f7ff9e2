#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/planar/four_bar/rates.h"
#include "linkwright/planar/four_bar/reactions.h"
#include "linkwright/planar/path/problem.h"
#include "linkwright/study/scene.h"

namespace linkwright::planar {

/// The crank angles that a design is shown at: one turn from the first target point in its sense of rotation,
/// or, when the crank does not rotate fully, the interval of inputs that holds the first point. `samples` >=
/// 2 angles in radians.
std::vector<double> shown_angles(const PathDesign& design, int samples);

/// Names of the joints O, A, B, B0 in a drawing.
using JointNames = std::array<std::string_view, 4>;

/// Drawing of a linkage over the given crank angles (rad, from the ground link), without targets.
/// `coupler_point`: the coupler point C and its curve are drawn, too.
study::Scene four_bar_scene(const FourBar& linkage, std::vector<double> crank_angles, std::string name,
                            std::string title, bool coupler_point,
                            const JointNames& joints = {"O", "A", "B", "B0"});
/// The same where the poses are known, one an angle: of a linkage that does not stay on its branch.
study::Scene four_bar_scene(const FourBar& linkage, std::vector<double> crank_angles,
                            const std::vector<FourBarPosition>& poses, std::string name, std::string title,
                            bool coupler_point, const JointNames& joints);

/// Adds the velocities (m/s) and accelerations (m/s2) of the moving joints, and of the coupler point if it is
/// drawn, to a four_bar_scene of the same linkage. `rates`: one a sample.
void add_motion_arrows(study::Scene& scene, const FourBar& linkage, const std::vector<FourBarRates>& rates);

/// Adds joint forces to a four_bar_scene: at O1 and O4 those of the ground on the linkage, at O2 and O3 those
/// on the coupler. `forces`: one a sample.
void add_joint_forces(study::Scene& scene, const std::vector<FourBarReactions>& forces);

/// Adds discs at the mass centres of crank, coupler and rocker to a four_bar_scene of the same linkage, as
/// large as steel discs of these masses (see drawn_radius).
void add_mass_centres(study::Scene& scene, const FourBar& linkage, const FourBarMasses& masses);

/// Adds the couple of the drive on the crank to a four_bar_scene.
void add_drive_torque(study::Scene& scene, const std::vector<FourBarReactions>& forces);

/// Adds the shaking force on the ground to a four_bar_scene. It is drawn at the middle of the ground link:
/// its line of action follows from the shaking moment.
void add_shaking_force(study::Scene& scene, const std::vector<FourBarReactions>& forces);

/// Drawing of a design in motion with the target path.
study::Scene path_scene(const PathProblem& problem, const PathDesign& design, std::string name,
                        std::string title, int samples);

/// Motion over the shown angles: crank, coupler, rocker and transmission angles, coupler point.
Table motion_table(const PathDesign& design, std::string name, int samples);

/// Target points, where the design comes, and how far off.
Table point_table(const PathProblem& problem, const PathDesign& design, std::string name);

}  // namespace linkwright::planar
