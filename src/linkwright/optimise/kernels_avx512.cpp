#define LINKWRIGHT_KERNELS avx512
#define LINKWRIGHT_LANES 8
#include "linkwright/optimise/detail/kernels_body.h"
