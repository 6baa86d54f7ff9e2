#define LINKWRIGHT_KERNELS baseline
#define LINKWRIGHT_LANES 2
#include "linkwright/optimise/kernels_body.h"
