// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/elastic.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

// Beyond it the mass that a file gives is not that of the beam.
constexpr double other_mass = 0.01;

// Index of a point that may be left out; -1 then, and when there is none.
int point_of(study::ObjectReader& entry, const LinkageBody& body, std::string_view key,
             const std::optional<std::string>& name) {
  if (!name) return -1;
  const int index = point_index(body, *name);
  if (index >= 0) return index;
  std::vector<std::string_view> known;
  for (const LinkagePoint& p : body.points) known.push_back(p.name);
  entry.error(key, fmt::format("body '{}' has no point '{}'", body.name, *name), did_you_mean(*name, known));
  return -1;
}

// The mass of the beam instead of that of the body, so that the rigid linkage has the same.
void give_mass(study::ObjectReader& entry, LinkageBody& body, const ElasticPieces& pieces) {
  const double mass = pieces.beam.density * pieces.beam.area * pieces.length;
  if (body.mass && std::abs(body.mass->mass - mass) > other_mass * mass)
    entry.warning("body",
                  fmt::format("body '{}' is given {:.4g} kg, but its beam weighs {:.4g} kg, which takes the "
                              "place of it",
                              body.name, body.mass->mass, mass),
                  "attach other masses to it: attached = [{ mass_kg = ..., at_mm = [...] }]");
  const std::complex<double> middle =
      (body.points[at(pieces.beam.from)].at + body.points[at(pieces.beam.to)].at) / 2.0;
  body.mass = BodyMass{mass, mass * pieces.length * pieces.length / 12, middle};
}

}  // namespace

std::vector<ElasticBody> read_elastic(study::ObjectReader& document, const Linkage& l,
                                      Value::Array& canonical) {
  std::vector<ElasticBody> out;
  for (study::ObjectReader& entry : document.tables("elastic")) {
    ElasticBodyForm form;
    entry.read(form);
    if (form.body.empty()) continue;
    form.beam.body = body_index(l, form.body);
    if (form.beam.body < 0) {
      std::vector<std::string_view> known;
      for (std::size_t b = 1; b < l.bodies.size(); ++b) known.push_back(l.bodies[b].name);
      entry.no_such("body", "body", form.body, known);
      continue;
    }
    form.beam.from = point_of(entry, l.bodies[at(form.beam.body)], "from", form.from);
    form.beam.to = point_of(entry, l.bodies[at(form.beam.body)], "to", form.to);
    canonical.push_back(study::write_fields(form));
    out.push_back(form.beam);
  }
  return out;
}

std::vector<ElasticPieces> place_elastic(study::ObjectReader& document, Linkage& l,
                                         const std::vector<ElasticBody>& bodies,
                                         const std::vector<InputMotion>& start) {
  ElasticLinkage made = with_elastic_bodies(l, bodies, start);
  auto entries = document.tables("elastic");
  for (const Diagnostic& d : made.problems) {
    bool told = false;
    for (study::ObjectReader& entry : entries) {
      const Value* own = entry.value().find("body");
      if (told || !own || !own->is_string() || d.key != "elastic_body." + own->as_string()) continue;
      entry.error("body", fmt::format("'{}' {}", own->as_string(), to_string(d.message)), to_string(d.hint));
      told = true;
    }
    if (!told) document.error("elastic", to_string(d.message), to_string(d.hint));
  }
  for (std::size_t e = 0; e < made.pieces.size(); ++e)
    give_mass(entries[e], l.bodies[at(made.pieces[e].beam.body)], made.pieces[e]);
  return std::move(made.pieces);
}

void describe_elastic(study::SchemaWriter& document) {
  document.property(field::entry("elastic", "flexible bodies, as beams"),
                    study::schema_array(study::schema_fields<ElasticBodyForm>()));
}

std::vector<InputMotion> inputs_at(const std::vector<InputDrive>& drives, double time) {
  std::vector<InputMotion> out;
  for (const InputDrive& c : drives) {
    if (!c.law) {
      out.push_back({c.value, c.rate, 0});
      continue;
    }
    const math::Motion m = math::MotionCurve(*c.law)(time);
    out.push_back({m.value, m.rate, m.acceleration});
  }
  return out;
}

SuggestedMethod suggested_method(const Linkage& l, const std::vector<ElasticPieces>& bodies) {
  double damped = 0;
  const ElasticBody* most = nullptr;
  for (const ElasticPieces& p : bodies) {
    // Damping of a spring and damper side by side, as a share of the critical damping.
    const double here = highest_frequency(p.beam, p.length) * p.beam.damping / 2;
    if (here > damped) damped = here, most = &p.beam;
  }
  if (!most) return {math::OdeMethod::explicit_runge_kutta_8, "no body is damped"};
  const std::string of = fmt::format("the fastest vibration of {} has {:.3g} of its critical damping",
                                     l.bodies[at(most->body)].name, damped);
  if (damped > 1) return {math::OdeMethod::bdf, of + " and dies out at once"};
  return {math::OdeMethod::explicit_runge_kutta_8, of + " and swings on"};
}

}  // namespace linkwright::planar
