// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Not included: pybind11 costs seconds, and these declarations do without.
namespace pybind11 {
class module_;
}

namespace linkwright::python {

/// Studies, their results and tables, and what there is to begin with.
void bind_studies(pybind11::module_& module);
/// Four-bars and any linkage at many inputs.
void bind_planar(pybind11::module_& module);
/// Wheel parameters over travel and rack.
void bind_suspension(pybind11::module_& module);
/// Arm angles and poses of parallel robots.
void bind_robots(pybind11::module_& module);
/// Objectives in Python for the population methods.
void bind_optimise(pybind11::module_& module);

}  // namespace linkwright::python
