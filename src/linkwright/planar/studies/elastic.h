// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/planar/studies/elastic_scene.h"
#include "linkwright/planar/studies/simulation.h"

// Simulations of linkages with flexible bodies: what their tables `[[elastic]]` hold, how they are read, run
// and reported beside the rigid linkage.
namespace linkwright::planar {

/// One entry of `[[elastic]]`, as the file holds it.
struct ElasticBodyForm {
  std::string body;
  std::optional<std::string> from, to;
  ElasticBody beam;
};
template <class Visitor>
void fields(Visitor&& visit, ElasticBodyForm& f) {
  const auto number = [&](std::string_view key, std::string_view summary, Dimension dimension, double most,
                          double& value) {
    visit(field::of(dimension, key, summary).positive().at_most(most).required(), value);
  };
  visit(field::entry("body", "flexible body").required(), f.body);
  visit(field::entry("from", "its point where the beam begins; default: at a joint"), f.from);
  visit(field::entry("to", "its point where the beam ends; default: at another joint"), f.to);
  visit(field::entry("segments", "cells of the beam, with a spring in the middle of each").between(1, 64),
        f.beam.segments);
  number("density", "of its material", Dimension::density, 1e6, f.beam.density);
  number("area", "of its cross-section", Dimension::area, 1e4, f.beam.area);
  number("second_moment", "of its cross-section, for bending in the plane", Dimension::second_moment_of_area,
         1e8, f.beam.second_moment);
  number("elastic_modulus", "of its material", Dimension::pressure, 1e15, f.beam.elastic_modulus);
  visit(field::length("fibre_distance", "of the outer fibre from the neutral line, for the stress")
            .between(0, 1e3),
        f.beam.fibre_distance);
  visit(field::time("stiffness_damping", "Kelvin and Voigt's: retardation time of the material")
            .between(0, 1e3),
        f.beam.damping);
}

/// The integration of an elastic linkage when the file leaves it open.
struct SuggestedMethod {
  math::OdeMethod method = math::OdeMethod::explicit_runge_kutta_8;
  std::string why;
};
/// bdf where the fastest vibration of the pieces has more than its critical damping: explicit steps would be
/// bound by what has died out. Else explicit_runge_kutta_8: bdf would damp vibrations itself.
SuggestedMethod suggested_method(const Linkage& linkage, const std::vector<ElasticPieces>& bodies);

/// Reads `[[elastic]]` into bodies with indices, and into `canonical`. Problems go to the reader.
std::vector<ElasticBody> read_elastic(study::ObjectReader& document, const Linkage& linkage,
                                      Value::Array& canonical);
/// Gives the bodies the mass of their beams, and returns these. What the model says against them is put where
/// the file has its cause; nothing is returned then.
std::vector<ElasticPieces> place_elastic(study::ObjectReader& document, Linkage& linkage,
                                         const std::vector<ElasticBody>& bodies,
                                         const std::vector<InputMotion>& start);
void describe_elastic(study::SchemaWriter& document);

/// Values and rates of the inputs at a time: of laws there, of free ones where they start.
std::vector<InputMotion> inputs_at(const std::vector<InputDrive>& drives, double time);

/// The deviation of a body that turns on the ground, a slide on it or a traced point from the rigid linkage.
struct OutputError {
  enum class Of { angle, displacement, path };
  std::string key, label;
  Of of = Of::angle;
  int index = 0;               ///< index of the body, joint or trace
  std::vector<double> values;  ///< rad or m; of a path the distance. One a row, NaN where not known
};
/// The values of a bent body over the rows: of the worst section, and (deflections) of the beam.
struct BeamRows {
  std::vector<double> middle, largest, moment, normal, bending, stress, place;
};
/// An elastic linkage over time beside the rigid one. Rows up to where the motion ends.
struct ElasticRecording {
  ElasticLinkage elastic;
  std::vector<double> times;
  std::vector<BeamRows> beams;  ///< one an elastic body
  std::vector<OutputError> errors;
  std::vector<ElasticRecord> records;
  Table motion, rigid;      ///< `rigid` has columns of `motion`, by the same keys
  Sentence rigid_message;   ///< says why the rigid linkage ends early; else empty
  double largest_rate = 0;  ///< largest rate of the inputs, rad/s or m/s
  SimulationReport report;
};
/// Tables, scene, plots, facts and headline.
study::Result report_elastic_simulation(const LinkageSimulationStudy& study,
                                        const ElasticRecording& recording);

/// Integrates with flexible bodies and the rigid linkage beside it, and reports.
study::Result run_elastic_simulation(const LinkageSimulationStudy& study, RunContext& context);

}  // namespace linkwright::planar
