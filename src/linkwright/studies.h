// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Study files: they are read, run and described by the kinds of all domains.

#include "linkwright/app/catalogue.h"
#include "linkwright/study/absent.h"
#include "linkwright/study/checks.h"
#include "linkwright/study/display_units.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/read.h"
#include "linkwright/study/reproduction.h"
#include "linkwright/study/result.h"
#include "linkwright/study/scene.h"
#include "linkwright/study/study.h"
