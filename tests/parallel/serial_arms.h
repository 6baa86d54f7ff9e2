// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

// The serial arm of the reference figures as a study.
namespace linkwright::parallel {

inline const std::string serial_mechanism =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.serial_pi_arm\"\nbase_mm = [0, 0]\n"
    "offset_mm = [60, -20]\narms_mm = [300, 250]\nmode = -1\n";
inline const std::string serial_drives =
    "[[mechanism.drive]]\ntype = \"pi_joint\"\nmounting_deg = 30\nlead_mm = 10\nforce_limit_N = 500\n"
    "rate_limit_m_per_s = 1\n"
    "[[mechanism.drive]]\ntype = \"pi_joint\"\nmirrored = true\nlead_mm = 10\nforce_limit_N = 500\n"
    "rate_limit_m_per_s = 1\n";
inline const std::string serial_masses =
    "[masses]\npayload_kg = 0.8\n"
    "[[masses.joint]]\narm_inertia_kg_m2 = 0.03\narm_mass_kg = 0.9\narm_centre_mm = 140\n"
    "coupler_mass_kg = 0.5\n"
    "[[masses.joint]]\narm_inertia_kg_m2 = 0.012\narm_mass_kg = 0.6\narm_centre_mm = 110\n"
    "coupler_mass_kg = 0.3\n";
inline const std::string serial_home = "[home]\nposition_mm = [330, 180, 0]\n";
inline const std::string serial_line =
    "[motion]\ninterval_s = 0.0005\n[motion.limits]\nspeed_m_per_s = 1\nacceleration_m_per_s2 = 10\n"
    "jerk_m_per_s3 = 500\n[[motion.step]]\ntype = \"line\"\nto_mm = [420, 240, 0]\n";
inline const std::string serial_motion =
    serial_mechanism + serial_drives + serial_masses + serial_home + serial_line;

}  // namespace linkwright::parallel
