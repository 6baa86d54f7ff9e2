#define LINKWRIGHT_KERNELS baseline
#define LINKWRIGHT_LANES 2
#include "linkwright/optimise/detail/kernels_body.h"
