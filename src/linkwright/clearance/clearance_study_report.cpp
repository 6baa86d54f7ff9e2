#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/clearance/clearance_study.h"
#include "linkwright/clearance/contact_analysis.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }
// A share of the energy that went through the linkage: beyond it an answer is not to be trusted.
constexpr double poor_balance = 1e-5;
// Rows beyond which not every one is compared with the ideal path.
constexpr std::size_t most_compared = 20000;

// Distance of a place from a line through places, m.
double distance_from(const std::vector<std::complex<double>>& path, std::complex<double> place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const planar::Vec<double> along = planar::vec(path[i + 1] - path[i]), way = planar::vec(place - path[i]);
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(along, way) / square, 0.0, 1.0) : 0;
    const planar::Vec<double> off = way - share * along;
    least = std::min(least, dot(off, off));
  }
  return std::isfinite(least) ? std::sqrt(least) : nan;
}

class Reporter {
 public:
  Reporter(const ClearanceStudy& s, ClearanceRecording recording) : s_(s), r_(std::move(recording)) {}

  study::Result report() {
    result_.status = r_.status;
    motion();
    ideal();
    pins();
    if (real()) add(contacts_table(s_, r_));
    if (rows() > 0) add(contact_map_table(s_, r_));
    add(spectrum_table(s_, r_));
    add(section_table(s_, r_));
    if (r_.regime && r_.regime->orbit && r_.regime->orbit->status == Status::done) {
      add(orbit_table(s_, *r_.regime->orbit));
      add(multipliers_table(*r_.regime->orbit));
    }
    if (!r_.rows.empty()) result_.scenes.push_back(clearance_scene(s_, r_));
    plots();
    facts();
    headline();
    return std::move(result_);
  }

 private:
  void add(Table table) {
    if (!table.columns.empty()) result_.tables.push_back(std::move(table));
  }
  bool contact() const { return s_.model != PinModel::continuous; }
  // Whether there was real contact.
  bool real() const { return s_.model == PinModel::contact || switched(); }
  bool switched() const { return !std::isnan(r_.switched); }
  std::size_t rows() const { return r_.rows.size(); }
  const std::string& name(std::size_t pin) const { return s_.linkage.joints[at(s_.joint_of(pin))].name; }
  std::string key(std::size_t pin) const { return planar::identifier(name(pin)); }
  std::string trace_key(std::size_t k) const {
    const planar::LinkageBody& b = s_.linkage.bodies[at(s_.traces[k].body)];
    return planar::identifier(b.name) + "_" + planar::identifier(b.points[at(s_.traces[k].point)].name);
  }
  std::string trace_name(std::size_t k) const {
    const planar::LinkageBody& b = s_.linkage.bodies[at(s_.traces[k].body)];
    return b.name + "." + b.points[at(s_.traces[k].point)].name;
  }
  template <class F>
  static std::vector<double> column(const std::vector<RecordedRow>& rows, F&& of) {
    std::vector<double> out;
    for (const RecordedRow& row : rows) out.push_back(of(row));
    return out;
  }

  // ---- tables
  // -------------------------------------------------------------------------------------------------

  void add_inputs(Table& table, const std::vector<RecordedRow>& rows) {
    const planar::Linkage& l = s_.linkage;
    table.add("time_s", "time (s)", column(rows, [](const RecordedRow& r) { return r.time; }));
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k) {
      const bool rotary = s_.plan.rotary[k];
      const std::string& joint = planar::input_joint(l, k).name;
      const char *rate = rotary ? "rad_per_s" : "m_per_s", *unit = rotary ? "rad/s" : "m/s";
      table.add(planar::input_key(l, s_.plan, k), planar::input_label(l, s_.plan, k),
                column(rows, [k](const RecordedRow& r) { return r.inputs[k].value; }));
      table.add(fmt::format("{}_joint_speed_{}", planar::identifier(joint), rate),
                fmt::format("{} joint speed ({})", joint, unit),
                column(rows, [k](const RecordedRow& r) { return r.inputs[k].rate; }));
    }
  }
  void add_values(Table& table, const std::vector<RecordedRow>& rows) {
    for (std::size_t c = 0; c < r_.columns.size(); ++c) {
      std::vector<double> values = column(rows, [c](const RecordedRow& r) { return r.values[c]; });
      if (r_.columns[c].angle) math::unwrap_angles(values);
      table.add(r_.columns[c].key, r_.columns[c].label, std::move(values));
    }
  }
  static void add_status(Table& table, const std::vector<RecordedRow>& rows) {
    for (const RecordedRow& row : rows) table.status.emplace_back(to_string(row.status));
  }

  void motion() {
    Table table{.name = "motion"};
    add_inputs(table, r_.rows);
    add_values(table, r_.rows);
    for (std::size_t k = 0; k < s_.traces.size(); ++k) add_path(table, k);
    const auto energy = [&](const char* key, const char* label, double RecordedRow::*of) {
      table.add(key, label, column(r_.rows, [of](const RecordedRow& r) { return r.*of; }));
    };
    energy("kinetic_energy_J", "kinetic energy (J)", &RecordedRow::kinetic);
    energy("potential_energy_J", "potential energy of weight and springs (J)", &RecordedRow::potential);
    if (contact()) {
      energy("contact_energy_J", "elastic energy of the contacts (J)", &RecordedRow::elastic);
      energy("dissipated_energy_J", "energy lost in the contacts (J)", &RecordedRow::dissipated);
    }
    energy("work_J", "work of drives and loads (J)", &RecordedRow::work);
    energy("energy_drift_J", "energy drift (J)", &RecordedRow::drift);
    add_status(table, r_.rows);
    result_.tables.push_back(std::move(table));
  }
  // Where the point would be without clearance, how far it is from there and from the ideal path.
  void add_path(Table& table, std::size_t k) {
    const std::string key = trace_key(k), label = trace_name(k);
    const auto columns_of = [&](std::string_view end) {
      for (std::size_t c = 0; c < r_.columns.size(); ++c)
        if (r_.columns[c].key == key + std::string(end)) return c;
      return r_.columns.size();
    };
    const std::size_t x = columns_of("_x_m"), y = columns_of("_y_m");
    if (x == r_.columns.size() || y == r_.columns.size()) return;
    std::vector<double> ideal_x(rows(), nan), ideal_y(rows(), nan), error(rows(), nan), off(rows(), nan);
    for (std::size_t i = 0; i < rows(); ++i) {
      const std::complex<double> place{r_.rows[i].values[x], r_.rows[i].values[y]};
      if (i % (1 + rows() / most_compared) == 0) off[i] = distance_from(r_.ideal_paths[k], place);
      if (i >= r_.ideal.size()) continue;
      ideal_x[i] = r_.ideal[i].values[x], ideal_y[i] = r_.ideal[i].values[y];
      error[i] = std::abs(place - std::complex<double>(ideal_x[i], ideal_y[i]));
    }
    for (const double d : off)
      if (d > path_error_ || std::isnan(path_error_)) path_error_ = d, farthest_ = k;
    for (const double d : error)
      if (d > place_error_ || std::isnan(place_error_)) place_error_ = d;
    table.add(key + "_ideal_x_m", label + " x without clearance (m)", std::move(ideal_x));
    table.add(key + "_ideal_y_m", label + " y without clearance (m)", std::move(ideal_y));
    table.add(key + "_place_error_m", label + " distance from where it is without clearance (m)",
              std::move(error));
    table.add(key + "_path_error_m", label + " distance from the path without clearance (m)", std::move(off));
  }

  void ideal() {
    if (r_.ideal.empty()) return;
    Table table{.name = "ideal"};
    add_inputs(table, r_.ideal);
    add_values(table, r_.ideal);
    add_status(table, r_.ideal);
    result_.tables.push_back(std::move(table));
  }

  // With one rotary drive the clearance link runs before it.
  bool leads() const { return s_.plan.inputs() == 1 && s_.plan.rotary[0]; }
  void add_lead(Table& table, std::size_t k) {
    std::vector<double> lead =
        column(r_.rows, [&](const RecordedRow& r) { return r.pins[k].angle - r.inputs[0].value; });
    if (!lead.empty()) {
      const double turns = lead[0] - math::wrap_angle(lead[0]);
      for (double& v : lead) v -= turns;
    }
    table.add(
        key(k) + "_lead_rad",
        fmt::format("{} clearance link before {} (rad)", name(k), planar::input_joint(s_.linkage, 0).name),
        std::move(lead));
  }
  static void unwrap_known(std::vector<double>& angles) {
    double last = nan;
    for (double& a : angles) {
      if (std::isnan(a)) continue;
      if (!std::isnan(last)) a = last + math::angle_difference(a, last);
      last = a;
    }
  }

  void pins() {
    Table table{.name = "pins"}, hodograph{.name = "hodograph"};
    table.add("time_s", "time (s)", column(r_.rows, [](const RecordedRow& r) { return r.time; }));
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      const std::string& j = name(k);
      const auto add = [&](const char* end, std::string label, auto&& of) -> Column& {
        return table.add(key(k) + end, j + " " + std::move(label),
                         column(r_.rows, [&](const RecordedRow& r) { return double(of(r.pins[k])); }));
      };
      add("_eccentricity_x_m", "eccentricity x (m)",
          [](const PinInstant& p) { return p.eccentricity.real(); });
      add("_eccentricity_y_m", "eccentricity y (m)",
          [](const PinInstant& p) { return p.eccentricity.imag(); });
      if (contact()) {
        add("_depth_m", "depth (m)", [](const PinInstant& p) { return p.depth; });
        add("_contact_N", "contact force (N)", [](const PinInstant& p) { return p.normal; });
        add("_friction_N", "friction (N)", [](const PinInstant& p) { return p.friction; });
        add("_touches", "in contact (1) or not (0)", [](const PinInstant& p) { return p.contact; });
        Column& angle = add("_contact_angle_rad", "direction of the pin in its bush where they touch (rad)",
                            [](const PinInstant& p) { return p.contact ? std::arg(p.eccentricity) : nan; });
        unwrap_known(angle.values);
      } else {
        add("_link_angle_rad", "direction of the clearance link (rad)",
            [](const PinInstant& p) { return p.angle; });
        add("_link_speed_rad_per_s", "speed of the clearance link (rad/s)",
            [](const PinInstant& p) { return p.angle_rate; });
        add("_link_acceleration_rad_per_s2", "acceleration of the clearance link (rad/s2)",
            [](const PinInstant& p) { return p.angle_acceleration; });
        add("_tension_N", "tension of the clearance link, positive in contact (N)",
            [](const PinInstant& p) { return p.normal; });
        if (leads()) add_lead(table, k);
      }
      // The way of the pin beside the circle that it is in.
      std::vector<double> circle_x, circle_y;
      for (std::size_t i = 0; i < rows(); ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(std::max<std::size_t>(rows() - 1, 1));
        circle_x.push_back(s_.clearance_of(k) * std::cos(angle));
        circle_y.push_back(s_.clearance_of(k) * std::sin(angle));
      }
      for (const char* end : {"_eccentricity_x_m", "_eccentricity_y_m"})
        hodograph.columns.push_back(*table.find(key(k) + end));
      const std::string circle = fmt::format("{} clearance circle, {:.4g} mm", j, 1e3 * s_.clearance_of(k));
      hodograph.add(key(k) + "_clearance_x_m", circle + " x (m)", std::move(circle_x));
      hodograph.add(key(k) + "_clearance_y_m", circle + " y (m)", std::move(circle_y));
    }
    add_status(table, r_.rows);
    result_.tables.push_back(std::move(table));
    result_.tables.push_back(std::move(hodograph));
  }

  // ---- plots
  // --------------------------------------------------------------------------------------------------

  const Table* table(std::string_view name) const {
    for (const Table& t : result_.tables)
      if (t.name == name) return &t;
    return nullptr;
  }
  using Style = study::Plot::Style;
  study::Plot& plot(std::string name, std::string title, const char* of, std::string x,
                    std::vector<std::string> y, Style style = Style::line) {
    static study::Plot none;
    const Table* t = table(of);
    if (t) std::erase_if(y, [&](const std::string& key) { return !t->find(key); });
    if (!t || t->rows() == 0 || y.empty()) return none = {};
    result_.plots.emplace_back();
    study::Plot& p = result_.plots.back();
    p.name = std::move(name);
    p.title = std::move(title);
    p.table = of;
    p.scene = x == "time_s" ? "motion" : "";
    p.x = std::move(x);
    p.y = std::move(y);
    p.style = style;
    return p;
  }
  void against_ideal(study::Plot& p) {
    if (table("ideal")) p.baseline = "ideal";
  }
  void plots() {
    std::vector<std::string> paths, errors, hodograph, forces, spectrum, reactions, drives, map, angles;
    for (std::size_t k = 0; k < s_.traces.size(); ++k) {
      const std::string t = trace_key(k);
      for (const char* end : {"_x_m", "_y_m", "_ideal_x_m", "_ideal_y_m"}) paths.push_back(t + end);
      errors.push_back(t + "_path_error_m");
      errors.push_back(t + "_place_error_m");
    }
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      for (const char* end : {"_eccentricity_x_m", "_eccentricity_y_m", "_clearance_x_m", "_clearance_y_m"})
        hodograph.push_back(key(k) + end);
      forces.push_back(key(k) + (contact() ? "_contact_N" : "_tension_N"));
      spectrum.push_back(key(k) + "_amplitude_N");
      for (const char* end : {"_force_x_N", "_force_y_N"}) map.push_back(key(k) + end);
      angles.push_back(key(k) + (contact() ? "_contact_angle_rad" : "_lead_rad"));
    }
    plot("hodograph", "Ways of the pins in their bushes", "hodograph", "", hodograph, Style::polar);
    plot("contact-forces",
         contact() ? "Contact forces" : "Tension of the clearance links: contact while positive", "pins",
         "time_s", forces);
    plot("contact-map", "Contact map: the largest force on each place of the bush, in the frame of the bush",
         "contact_map", "", map, Style::polar);
    plot("contact-angles",
         contact() ? "Where the pins touch: directions in their bushes" : "Leads of the clearance links",
         "pins", "time_s", angles, contact() ? Style::points : Style::line);
    if (!contact()) {
      std::vector<std::string> speeds;
      for (std::size_t k = 0; k < s_.pins(); ++k) speeds.push_back(key(k) + "_link_speed_rad_per_s");
      plot("link-speeds", "Speeds of the clearance links", "pins", "time_s", speeds);
    }
    plot("paths", "Paths of the traced points, with and without clearance", "motion", "time_s", paths,
         Style::polar);
    plot("path-errors", "How far the traced points are off", "motion", "time_s", errors);
    for (std::size_t k = 0; k < s_.traces.size(); ++k)
      against_ideal(
          plot("acceleration-" + trace_key(k),
               "Acceleration of " + trace_name(k) + " (pale: without clearance)", "motion", "time_s",
               {trace_key(k) + "_acceleration_x_m_per_s2", trace_key(k) + "_acceleration_y_m_per_s2"}));
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k)
      if (s_.plan.rotary[k])
        drives.push_back(planar::identifier(planar::input_joint(s_.linkage, k).name) + "_drive_torque_N_m");
    for (const planar::LinkageJoint& j : s_.linkage.joints)
      if (j.type != planar::JointType::gear && reactions.size() < 6)
        reactions.push_back(planar::identifier(j.name) + "_N");
    against_ideal(plot("torque", "Drive torque (pale: without clearance)", "motion", "time_s", drives));
    against_ideal(plot("reactions", "Joint forces (pale: without clearance)", "motion", "time_s", reactions));
    plot("spectrum", contact() ? "Spectrum of the contact forces" : "Spectrum of the tensions", "spectrum",
         "frequency_Hz", spectrum)
        .logarithmic_y = true;
    for (std::size_t k = 0; k < s_.pins(); ++k)
      plot("section-" + key(k), "Once a turn: " + name(k), "section",
           key(k) + (contact() ? "_eccentricity_x_m" : "_link_angle_rad"),
           {key(k) + (contact() ? "_eccentricity_rate_x_m_per_s" : "_link_speed_rad_per_s")}, Style::points);
    plot("energies", "Energies", "motion", "time_s",
         {"kinetic_energy_J", "potential_energy_J", "contact_energy_J", "dissipated_energy_J", "work_J"});
    plot("energy-audit", "Energy audit: what does not balance", "motion", "time_s", {"energy_drift_J"});
  }

  // ---- facts
  // --------------------------------------------------------------------------------------------------

  using Verdict = study::Fact::Verdict;
  void fact(std::string label, std::string text, Verdict verdict = Verdict::plain) {
    result_.facts.push_back({std::move(label), std::move(text), verdict});
  }
  void warn(std::string message, std::string hint) {
    result_.diagnostics.push_back(
        {Diagnostic::Severity::warning, {}, {}, {}, std::move(message), std::move(hint)});
  }
  double duration() const { return r_.time - r_.from; }

  void facts() {
    if (r_.regime) regime_facts();
    if (s_.model == PinModel::automatic) switch_fact();
    if (real())
      contact_facts();
    else
      continuous_facts();
    if (!std::isnan(path_error_))
      fact("path error",
           fmt::format("{} is at most {:.4g} mm from the ideal path{}", trace_name(farthest_),
                       1e3 * path_error_,
                       std::isnan(place_error_)
                           ? ""
                           : fmt::format(", {:.4g} mm from its ideal place", 1e3 * place_error_)));
    if (rows() > 0) {
      const double share = r_.peak_energy > 0 ? r_.largest_drift / r_.peak_energy : 0;
      const std::string text = fmt::format("within {:.2g} J ({:.2g} of the peak energy {:.4g} J)",
                                           r_.largest_drift, share, r_.peak_energy);
      fact("energy balance", text, share > poor_balance ? Verdict::bad : Verdict::good);
      if (share > poor_balance) warn("the energies do not balance: " + text, "take a smaller rtol");
    }
    fact("integration",
         fmt::format("{} steps, {} evaluations of the equations of motion", r_.steps, r_.evaluations));
    if (!r_.message.empty()) warn(r_.message, "");
  }
  void regime_facts() {
    const ClearanceRegime& regime = *r_.regime;
    if (regime.orbit) orbit_facts(*regime.orbit);
    if (regime.turns > 0 && regime.waited > 0)
      fact("periodic regime",
           fmt::format("repeats every {} ({:.6g} s) after {}, within {:.2g}", periods(regime.turns),
                       regime.turns * s_.period, periods(regime.waited), regime.change),
           Verdict::good);
    else if (regime.turns == 0)
      fact("periodic regime",
           std::isnan(regime.change)
               ? std::string("not found")
               : fmt::format("not found within {}: the last one changed the motion by {:.3g}",
                             periods(regime.waited), regime.change),
           Verdict::bad);
  }
  static std::string periods(int count) {
    return count == 1 ? std::string("turn") : fmt::format("{} turns", count);
  }
  void orbit_facts(const JointOrbit& orbit) {
    const bool taken = r_.regime->waited == 0;
    if (orbit.status != Status::done) {
      fact("shooting", "no periodic motion in continuous contact: " + orbit.message);
      return;
    }
    fact(taken ? "periodic regime" : "shooting",
         fmt::format(
             "{:.6g} s, in continuous contact; found in {} steps of Newton's method, a period changes it by "
             "{:.2g}{}",
             s_.period, orbit.iterations, orbit.residual,
             taken ? "" : "; but pins part on it, or it is unstable"),
         taken ? Verdict::good : Verdict::plain);
    std::string multipliers;
    for (const std::complex<double>& m : orbit.multipliers)
      multipliers += fmt::format("{}{:.6f}{:+.6f}i", multipliers.empty() ? "" : ", ", m.real(), m.imag());
    const bool unstable = orbit.stability == OrbitStability::unstable;
    fact("stability",
         fmt::format("{}: {}; Floquet multipliers {}", name_of(orbit.stability), summary_of(orbit.stability),
                     multipliers),
         unstable ? Verdict::bad : Verdict::good);
    if (unstable && taken)
      warn("the periodic motion is unstable: a real linkage leaves it",
           "model = \"automatic\" goes on turn after turn to the motion that it comes to");
  }
  static std::string_view summary_of(OrbitStability stability) {
    for (const auto& word : names(OrbitStability{}))
      if (word.value == stability) return word.summary;
    return {};
  }
  // Where the first input was when pins parted: "O2 at 71 deg".
  std::string where_switched() const {
    if (r_.switched_inputs.empty()) return {};
    const double value = r_.switched_inputs[0].value;
    const std::string& joint = planar::input_joint(s_.linkage, 0).name;
    return s_.plan.rotary[0]
               ? fmt::format(", {} at {:.4g} deg", joint, math::degrees(math::wrap_angle(value)))
               : fmt::format(", {} at {:.4g} mm", joint, 1e3 * value);
  }
  void switch_fact() {
    if (!(duration() > 0)) return;
    if (!switched()) {
      fact("model", "continuous contact holds throughout", Verdict::good);
      return;
    }
    fact("model", fmt::format("pin {} parted from its bush at {:.6g} s{}; from there on real contact{}",
                              name(at(r_.parted)), r_.switched, where_switched(),
                              s_.pins() > 1 ? " of all loose pins" : ""));
  }
  void contact_facts() {
    if (!(duration() > 0)) return;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < s_.pins(); ++k) {
      std::size_t count = 0;
      double touching = switched() ? std::max(r_.switched - r_.from, 0.0) : 0;
      double force = 0, approach = 0, depth = 0;
      for (const ContactEvent& e : r_.events) {
        if (at(e.joint) != k) continue;
        ++count;
        touching += (std::isnan(e.end) ? r_.time : e.end) - std::max(e.start, r_.from);
        force = std::max(force, e.force);
        approach = std::max(approach, e.approach);
        depth = std::max(depth, e.depth);
        if (!std::isnan(e.end)) shortest = std::min(shortest, e.end - e.start);
      }
      fact(fmt::format("contacts of {}", name(k)),
           count == 0 ? std::string("none: the pin stays free in its bush")
                      : fmt::format("{}, {:.3g} % of the time in contact; at most {:.4g} N, {:.3g} um deep, "
                                    "approach of {:.3g} m/s",
                                    count, 100 * touching / duration(), force, 1e6 * depth, approach));
      largest_force_ = std::max(largest_force_, force);
    }
    if (rows() < 2) return;
    const double interval = (r_.rows.back().time - r_.rows.front().time) / double(rows() - 1);
    if (shortest < interval)
      fact("shortest contact",
           fmt::format("{:.3g} s, less than the {:.3g} s between rows: plots and spectrum miss peaks of the "
                       "forces, the table of contacts has them",
                       shortest, interval));
    else if (std::isfinite(shortest))
      fact("shortest contact", fmt::format("{:.3g} s, rows every {:.3g} s", shortest, interval));
  }
  void continuous_facts() {
    if (!(duration() > 0)) return;
    for (std::size_t k = 0; k < r_.validity.size(); ++k) {
      const ContactValidity& v = r_.validity[k];
      const bool lost = !std::isnan(v.first_separation);
      lost_ = lost_ || lost;
      if (!lost) {
        fact(fmt::format("contact of {}", name(k)),
             fmt::format("kept: least tension {:.4g} N", v.least_tension), Verdict::good);
        continue;
      }
      fact(fmt::format("contact of {}", name(k)),
           fmt::format("lost at {:.4g} s; without contact {:.3g} % of the time, least tension {:.4g} N",
                       v.first_separation, 100 * v.separated, v.least_tension),
           Verdict::bad);
      warn(fmt::format("the pin of '{}' is taken to touch its bush always, but they part at {:.4g} s: what "
                       "follows is outside of the model",
                       name(k), v.first_separation),
           "model = \"contact\" computes flights and impacts, model = \"automatic\" from there on");
    }
  }

  void headline() {
    std::string& text = result_.headline;
    if (rows() == 0) {
      const bool interrupted = r_.status == Status::cancelled || r_.status == Status::deadline;
      text =
          (interrupted ? "Ended before its first row: " : "The linkage does not start: ") + r_.message + ".";
      return;
    }
    if (r_.regime) text = regime_headline();
    text += motion_headline();
    if (!std::isnan(path_error_))
      text +=
          fmt::format("; {} leaves its path by up to {:.4g} mm", trace_name(farthest_), 1e3 * path_error_);
    text += ".";
    if (r_.status != Status::done && !(r_.regime && r_.time >= s_.to()))
      text +=
          fmt::format(" It ends at {:.6g} s, before {:.6g} s: {}.", r_.time, s_.to(), to_string(r_.status));
  }
  std::string regime_headline() const {
    const ClearanceRegime& regime = *r_.regime;
    if (regime.turns == 0)
      return fmt::format("The motion did not become periodic within {} turns: ", s_.periodic()->max_turns);
    if (regime.waited == 0)
      return fmt::format("The periodic motion is {}: ", name_of(regime.orbit->stability));
    return fmt::format("The motion repeats every {} after {}: ", periods(regime.turns),
                       periods(regime.waited));
  }
  std::string motion_headline() const {
    const bool begins = result_.headline.empty();
    if (switched())
      return fmt::format(
          "{} {} parts from its bush at {:.4g} s{}, and {} contacts with up to {:.4g} N follow",
          begins ? "Pin" : "pin", name(at(r_.parted)), r_.switched, where_switched(), r_.events.size(),
          largest_force_);
    if (real())
      return fmt::format("{} {:.4g} s {} contacts of pin and bush, with up to {:.4g} N", begins ? "In" : "in",
                         duration(), r_.events.size(), largest_force_);
    if (lost_)
      return begins ? "Pin and bush do not stay in contact: the motion is outside of the model"
                    : "pin and bush do not stay in contact, so it is outside of the model";
    return fmt::format("{} and bush stay in contact for all {:.4g} s", begins ? "Pin" : "pin", duration());
  }

  const ClearanceStudy& s_;
  ClearanceRecording r_;
  double path_error_ = nan, place_error_ = nan, largest_force_ = 0;
  std::size_t farthest_ = 0;
  bool lost_ = false;
  study::Result result_;
};

}  // namespace

study::Result report_clearance(const ClearanceStudy& study, ClearanceRecording recording) {
  return Reporter(study, std::move(recording)).report();
}

}  // namespace linkwright::clearance
