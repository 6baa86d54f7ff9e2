#pragma once

// Arms with flexible links.

#include "linkwright/flexible/arm.h"
#include "linkwright/flexible/beam.h"
#include "linkwright/flexible/beam_form.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/chain_equations.h"
#include "linkwright/flexible/continuum.h"
#include "linkwright/flexible/drive.h"
#include "linkwright/flexible/input_shaping.h"
#include "linkwright/flexible/joint_kernel.h"
#include "linkwright/flexible/links.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/reference_beam.h"
#include "linkwright/flexible/response.h"
#include "linkwright/flexible/samples.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/statics.h"
#include "linkwright/flexible/vec2.h"
