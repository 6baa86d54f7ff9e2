#pragma once

// Linkages with clearance in their joints.

#include "linkwright/clearance/automatic_contact.h"
#include "linkwright/clearance/contact_analysis.h"
#include "linkwright/clearance/contact_law.h"
#include "linkwright/clearance/contact_pins.h"
#include "linkwright/clearance/contact_simulation.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/four_bar_clearance_motion.h"
#include "linkwright/clearance/joint_clearance.h"
#include "linkwright/clearance/joint_orbit.h"
#include "linkwright/clearance/mass_synthesis.h"
#include "linkwright/clearance/open_linkage.h"
#include "linkwright/clearance/path_synthesis.h"
#include "linkwright/clearance/published_clearance.h"
#include "linkwright/clearance/sensitivity.h"
#include "linkwright/clearance/step_pace.h"
