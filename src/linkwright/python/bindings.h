#pragma once

// Not included: pybind11 costs seconds, and these declarations do without.
namespace pybind11 {
class module_;
}

namespace linkwright::python {

/// Studies, their results and tables, and what there is to begin with.
void bind_studies(pybind11::module_& module);

}  // namespace linkwright::python
