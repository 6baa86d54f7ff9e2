// SPDX-License-Identifier: BSD-3-Clause
#pragma once

struct _generic_N_Vector;  // SUNDIALS' vector

namespace linkwright::math {

/// Gives a serial vector of SUNDIALS, and those that will be cloned from it, our loops for what every step
/// does. Debian builds SUNDIALS without optimisation, which shows: its own loops are several times slower.
/// Part of ode.h.
void use_our_loops(_generic_N_Vector* vector);

}  // namespace linkwright::math
