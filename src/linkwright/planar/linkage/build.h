// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/linkage/linkage.h"

/// @file
/// Functions that write a linkage down by names. Freedoms, lengths and names given twice are examined by
/// `check` and `plan_linkage`.
namespace linkwright::planar {

/// Makes a linkage that has a ground and nothing else.
///
/// @param points points of the ground in the global frame (m)
/// @returns the linkage; its only body is named "ground"
Linkage grounded(std::vector<LinkagePoint> points);

/// Adds a body.
///
/// @param linkage the linkage that receives it
/// @param name name of the body
/// @param points points in the frame of the body (m)
/// @returns index of the body
int add_body(Linkage& linkage, std::string name, std::vector<LinkagePoint> points);

/// Adds a bar along its own x axis, from its origin to `length`, with a point at each end.
///
/// @param linkage the linkage that receives it
/// @param name name of the bar
/// @param from name of the point at the origin
/// @param to name of the point at the other end
/// @param length length of the bar (m)
/// @returns index of the body
int add_bar(Linkage& linkage, std::string name, std::string from, std::string to, double length);

/// Adds a body whose points are given at the start position in the global frame: its own frame coincides with
/// the global one there. The start position gives the assembly modes of its pairs.
///
/// @param linkage the linkage that receives it
/// @param name name of the body
/// @param points points at the start position, global frame (m)
/// @returns index of the body
int add_drawn(Linkage& linkage, std::string name, std::vector<LinkagePoint> points);

/// Sets the pose of a body at the start.
///
/// @param linkage the linkage that has the body
/// @param body name of the body
/// @param origin origin of its frame, global (m)
/// @param angle angle of its x axis from the global one (rad)
/// @throws ContractError if there is no such body
void set_start(Linkage& linkage, std::string_view body, std::complex<double> origin, double angle);

/// A point by its name.
///
/// @param linkage the linkage that has the point
/// @param name the name as "body.point"
/// @returns the indices of body and point
/// @throws ContractError if there is no such body or point
BodyPoint point_named(const Linkage& linkage, std::string_view name);

/// Points by their names.
///
/// @param linkage the linkage that has the points
/// @param names the names, each as "body.point"
/// @returns the indices, in the order of the names
/// @throws ContractError if there is no such body or point
std::vector<BodyPoint> points_named(const Linkage& linkage, std::initializer_list<std::string_view> names);

/// Adds a revolute joint.
///
/// @param linkage the linkage that receives it
/// @param name name of the joint
/// @param first point of the first body, as "body.point"
/// @param second point of the second body, as "body.point"
/// @returns index of the joint
/// @throws ContractError if there is no such body or point
int add_pin(Linkage& linkage, std::string name, std::string_view first, std::string_view second);

/// Adds a prismatic joint.
///
/// @param linkage the linkage that receives it
/// @param name name of the joint
/// @param first point of the first body, as "body.point"
/// @param second point of the second body, as "body.point"
/// @param direction_first direction of the slide in the frame of the first body (rad)
/// @param direction_second the same direction in the frame of the second body (rad)
/// @returns index of the joint
/// @throws ContractError if there is no such body or point
int add_slide(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
              double direction_first = 0, double direction_second = 0);

/// Adds a pin in a slot: the pin is a point of the second body, the slot a line of the first.
///
/// @param linkage the linkage that receives it
/// @param name name of the joint
/// @param slot point of the first body on the line of the slot, as "body.point"
/// @param pin point of the second body, as "body.point"
/// @param direction direction of the slot in the frame of the first body (rad)
/// @returns index of the joint
/// @throws ContractError if there is no such body or point
int add_slot(Linkage& linkage, std::string name, std::string_view slot, std::string_view pin,
             double direction = 0);

/// Welds one body to another.
///
/// @param linkage the linkage that receives the joint
/// @param name name of the joint
/// @param first point of the first body, as "body.point"
/// @param second point of the second body, as "body.point"
/// @param angle angle of the second frame from the first (rad)
/// @returns index of the joint
/// @throws ContractError if there is no such body or point
int add_weld(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double angle = 0);

/// Adds a gear: (second - carrier) = ratio (first - carrier) + phase for the angles of the frames.
///
/// @param linkage the linkage that receives it
/// @param name name of the joint
/// @param first name of the first body
/// @param second name of the second body
/// @param ratio speed of the second body by that of the first, both seen from the carrier; negative: external
///   teeth
/// @param phase angle of the second body from the carrier where that of the first is zero (rad)
/// @param carrier name of the body that carries both axes
/// @returns index of the joint
/// @throws ContractError if there is no such body
int add_gear(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double ratio, double phase = 0, std::string_view carrier = "ground");

/// Adds a rack and its pinion.
///
/// @param linkage the linkage that receives it
/// @param name name of the joint
/// @param pinion centre of the pinion, as "body.point"
/// @param rack point of the pitch line, as "body.point"
/// @param radius radius of the pinion (m), negative where its centre lies to the right of the direction
/// @param direction direction of the pitch line in the frame of the rack (rad)
/// @param phase angle of the pinion from the rack where its centre is beside the point of the rack (rad)
/// @returns index of the joint
/// @throws ContractError if there is no such body or point
int add_rack(Linkage& linkage, std::string name, std::string_view pinion, std::string_view rack,
             double radius, double direction = 0, double phase = 0);

/// Drives a joint; the order of calls is the order of the inputs.
///
/// @param linkage the linkage that has the joint
/// @param joint name of the joint
/// @throws ContractError if there is no such joint
void add_drive(Linkage& linkage, std::string_view joint);

/// Sets the assembly mode of a dyad, see AssemblyMode.
///
/// @param linkage the linkage that has the bodies
/// @param first name of the first body of the dyad
/// @param second name of its second body
/// @param mode the assembly mode
/// @throws ContractError if there is no such body
void set_mode(Linkage& linkage, std::string_view first, std::string_view second, AssemblyMode mode);

/// Mass centre and inertia of a body whose mass is spread evenly: of a slender bar between its outermost
/// joints when these lie on a line, else of a plate over the convex hull of its joints. Points without a
/// joint count only when all its joints are in one place: first those of springs and forces, then all.
///
/// @param linkage the linkage that has the body and its joints
/// @param body name of the body
/// @param mass mass of the body (kg)
/// @throws ContractError if there is no such body, or it has no points
void set_uniform(Linkage& linkage, std::string_view body, double mass);

/// Gives every body but the ground the mass and inertia of set_uniform by a mass per metre between its
/// outermost points. Points of no length (sliders) get `mass_per_metre` times the size of the linkage over
/// ten.
///
/// @param linkage the linkage
/// @param mass_per_metre mass by length (kg/m)
/// @throws ContractError if a body has no points
void set_uniform_all(Linkage& linkage, double mass_per_metre);

}  // namespace linkwright::planar
