// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/elastic_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/study/drawn_scale.h"

namespace linkwright::planar {
namespace {

// Drawn size of a deflection, as a share of the size of the linkage.
constexpr double drawn_share = 0.05;

math::Vec2 across(const math::Vec2& away, const math::Vec2& line) {
  return dot(away, perpendicular(line)) * perpendicular(line);
}

class ElasticArtist {
 public:
  ElasticArtist(const Linkage& rigid, const LinkagePlan& plan, const std::vector<ElasticPieces>& pieces,
                const std::vector<ElasticRecord>& records, const std::vector<BodyPoint>& traces)
      : l_(rigid), plan_(plan), pieces_(pieces), records_(records), traces_(traces) {}

  study::Scene draw(std::optional<double> wanted) {
    scale_ = wanted ? *wanted : study::drawn_scale(largest(), drawn_share * plan_.size);
    std::vector<LinkageRecord> rigid;
    for (const ElasticRecord& r : records_) rigid.push_back(r.record);
    scene_ = linkage_scene(l_, plan_, rigid, traces_, "time_s", "time");
    if (scale_ != 1) scene_.title = fmt::format("deflections drawn {:g} x", scale_);
    for (std::size_t e = 0; e < pieces_.size(); ++e) bend(e);
    return std::move(scene_);
  }

 private:
  math::Vec2 line(std::size_t e, const PartState<double>& frame) const {
    const std::complex<double> way = pieces_[e].nodes.back() - pieces_[e].nodes.front();
    return rotate(frame.direction, math::vec(way / std::abs(way)));
  }
  double largest() const {
    double out = 0;
    for (const ElasticRecord& r : records_)
      for (std::size_t e = 0; e < r.away.size(); ++e)
        for (std::size_t i = 0; i < pieces_[e].nodes.size(); ++i)
          out = std::max(
              out,
              std::abs(dot(r.away[e][i], perpendicular(line(e, r.record.bodies[at(pieces_[e].beam.body)])))));
    return out;
  }
  // Sets the drawn positions of a node or point in every record.
  void put(std::size_t e, std::size_t index, std::complex<double> unbent, study::Scene::Point& p) const {
    p.x.clear();
    p.y.clear();
    for (const ElasticRecord& r : records_) {
      math::Vec2 drawn{nan, nan};
      if (!r.record.bodies.empty()) {
        const PartState<double>& frame = r.record.bodies[at(pieces_[e].beam.body)];
        const math::Vec2 away = r.away[e][index];
        drawn = point_on(frame, math::vec(unbent)) + away + (scale_ - 1) * across(away, line(e, frame));
      }
      p.x.push_back(drawn.x);
      p.y.push_back(drawn.y);
    }
  }

  void bend(std::size_t e) {
    const ElasticPieces& p = pieces_[e];
    const LinkageBody& body = l_.bodies[at(p.beam.body)];
    int first = 0;
    for (int b = 0; b < p.beam.body; ++b) first += static_cast<int>(l_.bodies[at(b)].points.size());
    for (std::size_t i = 0; i < body.points.size(); ++i)
      put(e, p.nodes.size() + i, body.points[i].at, scene_.points[at(first) + i]);
    std::erase_if(scene_.bodies, [&](const study::Scene::Body& b) {
      return b.name == body.name && !b.points.empty() && b.points[0] >= first &&
             b.points[0] < first + static_cast<int>(body.points.size());
    });
    std::vector<int> nodes;
    for (std::size_t i = 0; i < p.nodes.size(); ++i) {
      nodes.push_back(static_cast<int>(scene_.points.size()));
      study::Scene::Point node;
      put(e, i, p.nodes[i], node);
      scene_.points.push_back(std::move(node));
    }
    const auto bar = [&](int a, int b) {
      scene_.bodies.push_back({body.name, {a, b}, study::Scene::BodyStyle::bar});
    };
    scene_.bodies.push_back(
        {body.name + ", unbent", {nodes.front(), nodes.back()}, study::Scene::BodyStyle::axis});
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) bar(nodes[i], nodes[i + 1]);
    // A point off the beam is fixed to the node nearest to it.
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < p.nodes.size(); ++k)
        if (std::abs(p.nodes[k] - body.points[i].at) < std::abs(p.nodes[nearest] - body.points[i].at))
          nearest = k;
      const std::complex<double> way = p.nodes.back() - p.nodes.front();
      if (std::abs(std::imag((body.points[i].at - p.nodes[0]) / way)) > 1e-9)
        bar(nodes[nearest], first + static_cast<int>(i));
    }
  }

  const Linkage& l_;
  const LinkagePlan& plan_;
  const std::vector<ElasticPieces>& pieces_;
  const std::vector<ElasticRecord>& records_;
  const std::vector<BodyPoint>& traces_;
  double scale_ = 1;
  study::Scene scene_;
};

}  // namespace

PartState<double> chord_state(const ElasticLinkage& elastic, const ElasticPieces& p,
                              const LinkageMotion& motion) {
  const PointMotion a = point_motion(elastic.plan, motion, p.bodies.front(), p.nodes.front()),
                    b = point_motion(elastic.plan, motion, p.bodies.back(), p.nodes.back());
  const math::Vec2 way = b.position - a.position, rate = b.velocity - a.velocity,
                   change = b.acceleration - a.acceleration;
  const double square = dot(way, way), length = std::sqrt(square);
  const math::Vec2 unbent = math::vec(p.nodes.back() - p.nodes.front());
  PartState<double> s;
  s.direction = (1 / (length * norm(unbent))) * rotate_inverse(unbent, way);
  s.speed = cross(way, rate) / square;
  // The line gets shorter as the body bends: 2 (rate of its length) speed is not of the turn.
  s.angular_acceleration = cross(way, change) / square - 2 * dot(way, rate) / square * s.speed;
  const math::Vec2 arm = rotate(s.direction, math::vec(p.nodes.front()));
  s.origin = a.position - arm;
  s.velocity = a.velocity - s.speed * perpendicular(arm);
  s.acceleration = a.acceleration - s.angular_acceleration * perpendicular(arm) + s.speed * s.speed * arm;
  return s;
}

ElasticRecord elastic_record(const Linkage& rigid, const ElasticLinkage& elastic, const LinkageMotion& motion,
                             const LinkageForces* forces, double input) {
  ElasticRecord out;
  out.record = record_of(elastic.linkage, elastic.plan, motion, forces, input);
  if (out.record.bodies.empty()) return out;
  out.record.bodies.resize(rigid.bodies.size());
  if (!out.record.joints.empty()) out.record.joints.resize(rigid.joints.size());
  if (!out.record.drives.empty()) out.record.drives.resize(rigid.driven.size());
  for (const ElasticPieces& p : elastic.pieces) {
    const PartState<double> line = chord_state(elastic, p, motion);
    out.record.bodies[at(p.beam.body)] = line;
    std::vector<math::Vec2> away;
    const auto add = [&](int piece, std::complex<double> there) {
      away.push_back(point_motion(elastic.plan, motion, piece, there).position -
                     point_on(line, math::vec(there)));
    };
    for (std::size_t i = 0; i < p.nodes.size(); ++i) add(p.bodies[i], p.nodes[i]);
    for (const LinkagePoint& point : rigid.bodies[at(p.beam.body)].points)
      for (const int piece : p.bodies)
        if (const int k = point_index(elastic.linkage.bodies[at(piece)], point.name); k >= 0) {
          add(piece, point.at);
          break;
        }
    out.away.push_back(std::move(away));
  }
  return out;
}

study::Scene elastic_scene(const Linkage& rigid, const LinkagePlan& plan,
                           const std::vector<ElasticPieces>& pieces,
                           const std::vector<ElasticRecord>& records, const std::vector<BodyPoint>& traces,
                           std::optional<double> scale) {
  return ElasticArtist(rigid, plan, pieces, records, traces).draw(scale);
}

}  // namespace linkwright::planar
