// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/flexible/chain.h"

/// Beams of publications, for tests, examples and benchmarks.
namespace linkwright::flexible {

/// The 8 m link that is accelerated to its speed (Boskovic 2018, Table 3.1, after Cai, Hong and Yang 2005). G
/// and k are not printed: nu = 0.3 and k = 5/6 are assumed where Timoshenko's theory is asked for.
Beam spin_up_beam(Theory theory = Theory::rayleigh);

/// The strip on a hub under torque (Boskovic 2018, Table 3.2); G and k as above.
Beam torque_beam(Theory theory = Theory::rayleigh);

/// The 10 m beam of Kane, Ryan and Banerjee (1987) and of Simo and Vu-Quoc: E I = 1.4e4 N m2, E A = 2.8e7 N,
/// rho A = 1.2 kg/m, without tip mass.
Beam kane_beam();

}  // namespace linkwright::flexible
