// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup studies Study files
/// Study files, which are read, run and described by the kinds of all domains. Every kind of study is reached
/// this way, the syntheses that have no public header among them.
///
/// @include any_study.cpp

/// @namespace linkwright::study
/// Study files: what they hold, how they are read and run, and their results.

/// @namespace linkwright::app
/// Kinds of studies of all domains.

#include "linkwright/app/catalogue.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"
#include "linkwright/study/scene.h"
#include "linkwright/study/study.h"
