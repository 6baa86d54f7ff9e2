// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>

#include <exception>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/check.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/values.h"

PYBIND11_MODULE(_linkwright, module) {
  module.doc() = "What the package linkwright is made of; its names are those of the package.";
  module.attr("version") = linkwright::app::version();
  // A contract that was broken is a wrong argument in Python's words.
  pybind11::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const linkwright::ContractError& broken) {
      PyErr_SetString(PyExc_ValueError, broken.what());
    }
  });
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(&linkwright::python::end_work));
  if (const auto os = pybind11::module_::import("os"); pybind11::hasattr(os, "register_at_fork"))
    os.attr("register_at_fork")(pybind11::arg("after_in_child") =
                                    pybind11::cpp_function(&linkwright::python::forget_work));
  linkwright::python::bind_studies(module);
  linkwright::python::bind_planar(module);
  linkwright::python::bind_suspension(module);
  linkwright::python::bind_robots(module);
  linkwright::python::bind_optimise(module);
}
