#define LINKWRIGHT_KERNELS avx2
#define LINKWRIGHT_LANES 4
#include "linkwright/optimise/detail/kernels_body.h"
