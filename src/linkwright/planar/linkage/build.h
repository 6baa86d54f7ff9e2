// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/linkage/linkage.h"

// Writing a linkage down by names. All functions throw ContractError on names that do not exist; what they
// cannot see (freedoms, lengths, names given twice) is left to `check` and `plan_linkage`.
namespace linkwright::planar {

/// A linkage that has a ground with the given points (global frame, m) and nothing else.
Linkage grounded(std::vector<LinkagePoint> points);

/// Adds a body; points in its own frame (m). Returns its index.
int add_body(Linkage& linkage, std::string name, std::vector<LinkagePoint> points);

/// Adds a bar along its own x axis, from its origin to `length`, with a point at each end. Returns its index.
int add_bar(Linkage& linkage, std::string name, std::string from, std::string to, double length);

/// Adds a body whose points are drawn where they are at the start, in the global frame: its own frame lies on
/// the global one there. Gives the assembly modes of its pairs. Returns its index.
int add_drawn(Linkage& linkage, std::string name, std::vector<LinkagePoint> points);

/// Says where a body is at the start: its origin, and the angle of its x axis (rad).
void set_start(Linkage& linkage, std::string_view body, std::complex<double> origin, double angle);

/// A point as "body.point".
BodyPoint point_named(const Linkage& linkage, std::string_view name);

std::vector<BodyPoint> points_named(const Linkage& linkage, std::initializer_list<std::string_view> names);

/// Adds a joint between two points, each "body.point"; slides run along the given directions (rad) in the
/// frames of the bodies. Returns its index.
int add_pin(Linkage& linkage, std::string name, std::string_view first, std::string_view second);
int add_slide(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
              double direction_first = 0, double direction_second = 0);
/// The pin is a point of the second body, the slot a line of the first.
int add_slot(Linkage& linkage, std::string name, std::string_view slot, std::string_view pin,
             double direction = 0);
int add_weld(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double angle = 0);
/// Bodies by name; see LinkageJoint for the meaning.
int add_gear(Linkage& linkage, std::string name, std::string_view first, std::string_view second,
             double ratio, double phase = 0, std::string_view carrier = "ground");

/// Drives a joint; the order of calls is the order of the inputs.
void add_drive(Linkage& linkage, std::string_view joint);

/// The assembly mode of a dyad; see AssemblyMode.
void set_mode(Linkage& linkage, std::string_view first, std::string_view second, AssemblyMode mode);

/// Mass centre and inertia of a body whose mass is spread evenly: of a slender bar between its outermost
/// joints when these lie on a line, else of a plate over the convex hull of its joints. Points without a
/// joint count only when all its joints are in one place: first those of springs and forces, then all.
void set_uniform(Linkage& linkage, std::string_view body, double mass);
/// ... for every body but the ground, with a mass per metre between its outermost points; points of no length
/// (sliders) get `mass_per_metre` times the size of the linkage over ten.
void set_uniform_all(Linkage& linkage, double mass_per_metre);

}  // namespace linkwright::planar
