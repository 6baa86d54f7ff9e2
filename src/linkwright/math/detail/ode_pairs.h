// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace linkwright::math {

/// Pair of explicit Runge-Kutta formulas that share their stages. Part of ode.h.
struct RungeKuttaPair {
  int stages, order, embedded_order;
  std::span<const double> stage_weights;     ///< rows 1, 2, ... below the diagonal, one after the other
  std::span<const double> weights;           ///< weights of the formula that is carried on
  std::span<const double> embedded_weights;  ///< weights of the formula that gives the error
  std::span<const double> places;            ///< times of the stages, as parts of the step
};

namespace ode_pairs {

// clang-format off
inline constexpr double verner_stage_weights[] = {
    0.05,
    -0.0069931640625, 0.1135556640625,
    0.0399609375, 0, 0.1198828125,
    0.3613975628004574, 0, -1.3415240667004928, 1.3701265039000352,
    0.049047202797202797, 0, 0, 0.23509720422144048, 0.18085559298135672,
    0.061692890442890443, 0, 0, 0.11236568314640277, -0.038850460714513666, 0.01979188712522046,
    -1.7676302402223269, 0, 0, -62.5, -6.061889377376669, 5.6508231982227635, 65.62169641937624,
    -1.1809450665549708, 0, 0, -41.50473441114321, -4.434438319103725, 4.260408188586133, 43.75364022446172,
        0.0078714254899123107,
    -1.2814059994414884, 0, 0, -45.047139960139866, -4.7313620694495766, 4.514967016593808, 47.44909557172985,
        0.010592282971116612, -0.0057468422638446163,
    -1.7244701342624852, 0, 0, -60.92349008483054, -5.9515183762223929, 5.556523730698456, 63.98301198033305,
        0.014642028250414962, 0.06460408772358204, -0.07930323169008879,
    -3.301622667747079, 0, 0, -118.01127235975251, -10.141422388456112, 9.139311332232058, 123.37594282840427,
        4.6232443788745805, -3.3832777380682019, 4.5275921003246182, -5.8284954858116226,
    -3.0395150337663090, 0, 0, -109.26086808941763, -9.2906424974002934, 8.4305049817649112, 114.20100103783313,
        -0.96372713421454794, -5.0348840888021898, 5.9581308240029232, 0, 0,
};
inline constexpr double verner_weights[] = {
    0.04427989419007951, 0, 0, 0, 0, 0.35410493917244487, 0.24796921549564378, -15.694202038838084,
    25.084064965558564, -31.738367786260277, 22.938283273988784, -0.23613246330715422, 0};
inline constexpr double verner_embedded_weights[] = {
    0.044312615229089792, 0, 0, 0, 0, 0.35460956423432266, 0.24784804313665307, 4.4481347324757845,
    19.846886366118735, -23.581623377465619, 0, 0, -0.36016794372897754};
inline constexpr double verner_places[] = {
    0, 0.05, 0.1065625, 0.15984375, 0.39, 0.465, 0.155, 0.943, 0.90180204173585696, 0.909, 0.94, 1, 1};
// clang-format on

}  // namespace ode_pairs

/// Verner's efficient pair of orders 8 and 7 (Verner 2010, Numerical Algorithms 53, 383-396). SUNDIALS 6.4
/// has Fehlberg's, whose error estimate is zero wherever y' depends on t alone.
inline constexpr RungeKuttaPair verner_8_7 = {.stages = 13,
                                              .order = 8,
                                              .embedded_order = 7,
                                              .stage_weights = ode_pairs::verner_stage_weights,
                                              .weights = ode_pairs::verner_weights,
                                              .embedded_weights = ode_pairs::verner_embedded_weights,
                                              .places = ode_pairs::verner_places};

}  // namespace linkwright::math
