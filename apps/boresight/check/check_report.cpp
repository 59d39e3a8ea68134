#include "check/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/contact/law_range.hpp"
#include "boresight/contact/turn_range.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/stepping/own_step.hpp"
#include "boresight_analyses/study/overrun_play.hpp"
#include "check/contact_findings.hpp"
#include "check/unlikely_masses.hpp"
#include "report_parts/report_parts.hpp"
#include "results/summary.hpp"
#include "terminal/interruption.hpp"

namespace boresight::app {
namespace {

report::Table mobility_table(const KinematicReport& k) {
  report::Table table{.title = "Mobility",
                      .caption =
                          "Mobility is six per body less the rank of the constraints; a redundant row says "
                          "what others already say.",
                      .columns = {{"What"}, {"Number"}}};
  table.rows = {{"Bodies", k.bodies},
                {"Joints", k.joints},
                {"Constraint rows", k.constraint_rows},
                {"Rank", k.rank},
                {"Redundant rows", k.redundant_rows},
                {"Mobility", k.mobility},
                {"Drives", k.drives},
                {"Freedoms left free", k.free_freedoms}};
  return table;
}

// Whether the drives move all six freedoms of the boresight body: only then are there condition numbers of its pose.
bool has_conditioning(const KinematicReport& k) {
  return std::any_of(k.along.begin(), k.along.end(),
                     [](const ConditioningSample& s) { return s.orientation > 0.0 || s.position > 0.0; });
}

report::Panels conditioning_panels(const KinematicReport& k) {
  std::vector<double> t, orientation, position, singular;
  for (const ConditioningSample& s : k.along) {
    t.push_back(s.t);
    orientation.push_back(s.orientation);
    position.push_back(s.position);
    singular.push_back(s.smallest_singular_value);
  }
  report::Chart inverse{.title = "Inverse condition number",
                        .caption = "1: as good as can be; 0: a singular pose, where the drives lose a motion.",
                        .x = {"Time", "s"},
                        .y = {"inverse condition number", "", false, std::array{0.0, 1.05}}};
  inverse.series = {{.name = "orientation", .x = t, .y = orientation}, {.name = "position", .x = t, .y = position}};
  report::Chart smallest{
      .title = "Smallest singular value",
      .caption = "Of the Jacobian of all ideal rows, lengths scaled; it goes to zero at a singular pose.",
      .x = {"Time", "s"},
      .y = {"smallest singular value", ""}};
  smallest.series = {{.name = "smallest singular value", .x = t, .y = singular}};
  for (const LostMotion& lost : k.lost) smallest.lines.push_back({'x', lost.t, "singular"});
  for (const double passed : k.passed) smallest.lines.push_back({'x', passed, "singular"});
  report::Panels panels{.title = "Distance from singular poses along the motion", .caption = {}, .columns = 2};
  if (has_conditioning(k)) panels.panels.push_back(std::move(inverse));
  panels.panels.push_back(std::move(smallest));
  return panels;
}

report::Table contact_frequencies(const std::vector<ContactFrequency>& contacts) {
  report::Table table{
      .title = "Contact frequencies",
      .caption =
          "K: stiffness of the bore (Hertz) and of the end faces. Mass: the smallest that the offset moves. "
          "Reaction: RMS along the "
          "ideal motion, and the depth at which the journal rests under it. An explicit integrator must "
          "resolve the contact's frequency ω: RK4 blows up "
          "above a step of 2.785 / ω. Valid to: the impact speed up to which contact laws hold (Love 1944; Sun et al., "
          "Eq. 26).",
      .columns = {{"Joint"},
                  {"K, Hertz", "N/m^1.5"},
                  {"K, axial", "N/m"},
                  {"Mass", "kg"},
                  {"Reaction", "N"},
                  {"Rest depth", "µm"},
                  {"Frequency", "Hz"},
                  {"Stable step", "µs"},
                  {"Valid to", "mm/s"}}};
  for (const ContactFrequency& c : contacts)
    table.rows.push_back({c.joint, c.hertz_stiffness, c.axial_stiffness, c.effective_mass, c.typical_load,
                          1e6 * c.typical_penetration, c.angular_frequency / (2.0 * 3.14159265358979323846),
                          1e6 * c.largest_stable_step, 1e3 * c.validity_speed});
  return table;
}

// Turns in short wide bearings and guides, laws used outside of their range under the largest ideal load, and parallel
// journals whose contact is a line, not a point.
void add_law_notes(const Mechanism& mechanism, CheckResult& result) {
  for (std::size_t c = 0; c < result.contacts.size(); ++c) {
    const ClearanceDescription& d = mechanism.description().clearances[c];
    const ClearanceParameters& p = mechanism.parameters().clearance[c];
    const ContactFrequency& contact = result.contacts[c];
    const JointType type = mechanism.description().joints[static_cast<std::size_t>(d.joint)].type;
    if (const auto warning = turn_warning(contact.joint, d, type, p)) result.notes.push_back(*warning);
    if (const auto warning = range_warning(contact.joint, d.contact_law, p, contact.largest_radial_load)) {
      result.notes.push_back(*warning);
      continue;
    }
    const bool point = normal_law(d.contact_law).geometry == ContactGeometry::point;
    const std::string line = fitting_law(p, contact.largest_radial_load);
    if (!point || d.axes == JournalAxes::free || line.empty() || !(contact.typical_radial_load > 0.0)) continue;
    const double depth = make_normal_law(line, "", p).depth_under(contact.typical_radial_load),
                 as_point = make_normal_law(d.contact_law, "", p).depth_under(contact.typical_radial_load);
    if (std::abs(depth / as_point - 1.0) < 0.25) continue;
    result.notes.push_back(fmt::format(
        "{}: {} is a law for a point, and this journal lies along {} of its sleeve: under {}, {} (a line) is {} "
        "deep where it is {}",
        contact.joint, d.contact_law, readable(p.sleeve_length, "m"), readable(contact.typical_radial_load, "N"), line,
        readable(depth, "m"), readable(as_point, "m")));
  }
}

// The largest step of RK4 that is stable for all contacts, springs and dampers; infinite where nothing vibrates.
struct StableStep {
  double seconds = std::numeric_limits<double>::infinity();
  std::string joint = {};  // whose contact sets it; "": springs and dampers do
};
StableStep smallest_stable_step(const CheckResult& result) {
  StableStep stable;
  if (result.step_of_springs > 0.0) stable.seconds = result.step_of_springs;
  for (const ContactFrequency& c : result.contacts)  // a play that cannot move has no step
    if (c.largest_stable_step > 0.0 && c.largest_stable_step <= stable.seconds)
      stable = {c.largest_stable_step, c.joint};
  return stable;
}

// Springs and dampers that vibrate faster than any contact: the table of contacts then says too much of RK4's step.
void add_spring_note(CheckResult& result) {
  if (const StableStep stable = smallest_stable_step(result); stable.joint.empty() && std::isfinite(stable.seconds))
    result.notes.push_back(fmt::format(
        "springs and dampers vibrate faster than any contact: with them the largest stable step of RK4 is about {}",
        readable(stable.seconds, "s")));
}

// Plays that cannot move, or only together.
void add_play_findings(const Mechanism& mechanism, const IdealMotion& ideal, CheckResult& result) {
  IdealState state;
  ideal.state(generic_instant(0.0, ideal.duration()), state);
  const PlayMobility play = analyse_play(mechanism, state.bodies);
  for (const std::string& sentence : held_plays(mechanism, play)) result.findings.push_back(sentence);
  for (const std::string& sentence : bound_plays(mechanism, play)) result.notes.push_back(sentence);
}

// Parts that grow, and what is fixed to them but their joints.
void add_growth_notes(const Mechanism& mechanism, CheckResult& result) {
  const MechanismDescription& m = mechanism.description();
  const auto name_of = [&](int body) { return body == kGround ? std::string("ground") : m.bodies[body].name; };
  for (const ErrorDescription& error : m.errors) {
    if (error.kind != ErrorDescription::Kind::expansion) continue;
    const bool sprung = std::any_of(m.springs.begin(), m.springs.end(), [&](const SpringDescription& s) {
      return s.preloads.empty() && (s.first == error.body || s.second == error.body);
    });
    const bool points = m.line_of_sight && error.body == mechanism.boresight_body();
    if (!sprung && !points) continue;
    const std::string what = sprung && points
                                 ? "its springs' points and the place that it points from stay where they are"
                             : sprung ? "its springs' points stay where they are"
                                      : "the place that it points from stays where it is";
    result.notes.push_back(
        fmt::format("error {}: \"{}\" grows between its joints; {}", error.name, name_of(error.body), what));
  }
}

// Where the journals start: centred as the file says, or how far off the middle of their sleeves.
void add_start_note(const Mechanism& mechanism, const IdealMotion& ideal, CheckResult& result) {
  const PartsInPlay parts = parts_in_play(mechanism.description());
  if (mechanism.description().journals == JournalStart::centred) {
    result.notes.push_back(parts.inserts + " start in the middle of their " + parts.seats + ", as the file says");
    return;
  }
  result.start = starting_journals(mechanism, mechanism.parameters(), ideal);
  if (!result.start.remark.empty()) result.notes.push_back(result.start.remark);
  if (!result.start.undecided.empty()) result.notes.push_back(result.start.undecided);
  if (!result.start.warning.empty()) {
    result.notes.push_back(result.start.warning);
    return;
  }
  std::string text;
  for (const StartingJournals::Journal& j : result.start.journals)
    text += (text.empty() ? "" : ", ") + j.joint + " " + readable(j.offset.norm(), "m");
  result.notes.push_back(parts.inserts + " start at rest under the loads of t = 0, off the middle of their " +
                         parts.seats + ": " + text);
}

// A motion that the cheapest rung with dynamics would follow for long: how long, as it goes on this machine.
void add_cost_note(const std::shared_ptr<const Mechanism>& mechanism, CheckResult& result) {
  constexpr double kManySteps = 1e8, kTrialSeconds = 0.3;
  const StableStep stable = smallest_stable_step(result);
  const double steps = mechanism->duration() / stable.seconds;
  if (!(steps > kManySteps)) return;
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  options.model_look = ModelLook::none;
  // From the first look on: what is prepared before it is prepared once.
  std::optional<Stopwatch> watch;
  double first = 0.0, reached = 0.0;
  options.progress = [&](const RunProgress& p) {
    if (!watch) watch.emplace(), first = p.t;
    reached = p.t;
    return watch->wall_seconds() < kTrialSeconds && !interrupted();
  };
  std::string time;
  try {
    make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
    if (reached > first)
      time = ", about " + readable(watch->wall_seconds() * mechanism->duration() / (reached - first), "s") +
             " for one motion";
  } catch (const ComputationError&) {
    // Why it cannot be followed is for `run` to say.
  }
  result.notes.push_back(
      fmt::format("{} so fast that the motion takes {:.2g} steps{}; shorten motion.duration to what has to be seen",
                  stable.joint.empty() ? "springs and dampers vibrate" : "the contact of " + stable.joint + " vibrates",
                  steps, time));
}

// What a standing error does to the pointing, and which of them do nothing or cannot be taken up.
void add_error_notes(const Mechanism& mechanism, CheckResult& result) {
  if (mechanism.description().errors.empty()) return;
  // Columns of influence belong to a pose that drives or a prescribed motion hold.
  if (!is_kinematic(mechanism)) {
    result.notes.push_back(
        "what each error does by itself hangs on the whole motion where nothing drives a freedom; the multibody rung "
        "follows it");
    return;
  }
  result.errors = error_effects(mechanism, ideal_motion(mechanism, mechanism.parameters()));
  std::string idle, using_play;
  int count = 0;
  for (const ErrorEffect& effect : result.errors) {
    if (!effect.strain.empty()) (effect.value != 0.0 ? result.findings : result.notes).push_back(effect.strain);
    if (effect.uses_play) using_play += (using_play.empty() ? "" : ", ") + effect.name;
    if (!effect.does_nothing()) continue;
    idle += (count++ > 0 ? ", " : "") + effect.name;
  }
  if (count > 0)
    result.notes.push_back("to first order " + std::string(count == 1 ? "this error does" : "these errors do") +
                           " nothing to where the boresight body is or points: " + idle);
  if (!using_play.empty())
    result.notes.push_back(
        "these errors use up play of joints that hold each other, which then rest elsewhere; what that does "
        "to the boresight, a run says: " +
        using_play);
}

report::Table error_table(const std::vector<ErrorEffect>& effects) {
  report::Table table{
      .title = "What each error does",
      .caption =
          "The largest over the motion, to first order: of one unit of the error, and of the value "
          "that the file gives it. How journals rest is left out.",
      .columns = {{"error"}, {"position, per unit"}, {"boresight, per unit"}, {"value"}, {"position"}, {"boresight"}}};
  for (const ErrorEffect& e : effects) {
    if (!e.strain.empty()) {
      table.rows.push_back({e.name, "strains the mechanism", "", readable_of_error(e.value, e.unit), "", ""});
      continue;
    }
    const double small = e.unit == "K" ? 1.0 : 1e-6;  // one kelvin; one micrometre, microradian or ppm
    const char* per = e.unit == "K" ? " per K" : e.unit == "m" ? " per µm" : e.unit == "1" ? " per ppm" : " per µrad";
    table.rows.push_back({e.name, readable(e.position * small, "m") + per, readable(e.boresight * small, "rad") + per,
                          readable_of_error(e.value, e.unit), readable(e.position * std::abs(e.value), "m"),
                          readable(e.boresight * std::abs(e.value), "rad")});
  }
  return table;
}

}  // namespace

CheckResult check_mechanism(const std::shared_ptr<const Mechanism>& shared) {
  const Mechanism& mechanism = *shared;
  CheckResult result;
  result.kinematics = analyse_kinematics(mechanism);
  const KinematicReport& k = result.kinematics;
  const bool sound = k.feasible && k.lost.empty();
  (sound ? result.notes : result.findings) = k.findings;
  if (!sound && k.findings.empty()) {
    for (const LostMotion& lost : k.lost)
      result.findings.push_back(fmt::format("At t = {:.4g} s: {}", lost.t, lost.description));
    if (!k.feasible) result.findings.emplace_back("The ideal motion cannot be followed to its end");
  }
  for (std::string& sentence : unlikely_inertias(mechanism)) result.notes.push_back(std::move(sentence));
  if (sound) {
    try {
      add_growth_notes(mechanism, result);
      add_error_notes(mechanism, result);
    } catch (const ComputationError& error) {
      result.findings.emplace_back(error.what());
    }
  }
  if (sound && (mechanism.clearances() > 0 || k.along.empty())) {
    try {
      const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
      if (k.along.empty()) {
        look_along(mechanism, ideal, result.kinematics);
        if (!k.passed.empty())
          result.notes.push_back(fmt::format(
              "the motion passes a singular pose at t = {:.4g} s{}, where its joints hold one motion less; it is taken "
              "to "
              "go on smoothly, and rungs other than multibody may end there",
              k.passed.front(), k.passed.size() > 1 ? fmt::format(", and {} more", k.passed.size() - 1) : ""));
      }
      if (const std::string doubt = doubt_of(ideal); !doubt.empty()) result.notes.push_back(doubt);
      if (mechanism.clearances() == 0) return result;
      add_play_findings(mechanism, ideal, result);
      for (const std::string& sentence : overrun_plays(mechanism, mechanism.parameters(), ideal))
        result.findings.push_back(sentence);
      result.contacts = analyse_contacts(mechanism, mechanism.parameters(), ideal);
      for (std::string& finding : contact_findings(mechanism, result.contacts))
        result.findings.push_back(std::move(finding));
      if (result.findings.empty()) {
        add_law_notes(mechanism, result);
        result.step_of_springs = largest_step_of_springs(mechanism, mechanism.parameters(), ideal);
        add_spring_note(result);
        add_start_note(mechanism, ideal, result);
        add_cost_note(shared, result);
      }
    } catch (const ComputationError& error) {
      result.findings.emplace_back(error.what());
    }
  }
  return result;
}

report::Document check_report(const Command& command, const Mechanism& mechanism, const CheckResult& result) {
  const KinematicReport& k = result.kinematics;
  report::Document document{
      .title = mechanism.name(), .subtitle = "Checked before anything is integrated", .verb = "check"};
  document.verdict = result.findings.empty()
                         ? report::Verdict{report::Standing::good, "Nothing stands in the way of this motion."}
                         : report::Verdict{report::Standing::bad, result.findings.front()};
  document.facts = {{.label = "Mobility",
                     .value = k.mobility,
                     .note = how_many(k.drives, "drive") + ", " + how_many(k.free_freedoms, "freedom") + " left free"},
                    {.label = "Redundant rows", .value = k.redundant_rows}};
  if (!k.along.empty()) {
    const auto worst = [&](double ConditioningSample::*value) {
      return (*std::min_element(k.along.begin(), k.along.end(),
                                [&](const auto& a, const auto& b) { return a.*value < b.*value; })).*
             value;
    };
    if (has_conditioning(k)) {
      document.facts.push_back({.label = "Worst conditioning, orientation",
                                .value = worst(&ConditioningSample::orientation),
                                .note = "1 is best; at 0 the drives lose a motion"});
      document.facts.push_back({.label = "Worst conditioning, position",
                                .value = worst(&ConditioningSample::position),
                                .note = "1 is best; at 0 the drives lose a motion"});
    } else {
      document.facts.push_back(
          {.label = "Distance from losing a motion",
           .value = worst(&ConditioningSample::smallest_singular_value),
           .note = k.free_freedoms > 0 ? "0 where the joints lose one" : "0 where the drives lose one"});
    }
  }
  if (const StableStep stable = smallest_stable_step(result); std::isfinite(stable.seconds))
    document.facts.push_back({.label = "Largest stable step of RK4",
                              .value = readable(stable.seconds, "s"),
                              .note = "set by " + (stable.joint.empty() ? "springs and dampers" : stable.joint)});

  report::Section findings{.id = "findings", .title = "Findings"};
  std::string text;
  for (const auto& list : {result.findings, result.notes})
    for (const std::string& sentence : list) text += (text.empty() ? "" : "\n\n") + sentence;
  findings.items.push_back(
      report::Text{text.empty() ? "No singular pose, no redundancy worth a word, nothing infeasible." : text});
  document.sections.push_back(std::move(findings));
  document.sections.push_back({.id = "mobility", .title = "Mobility and redundancy", .items = {mobility_table(k)}});
  if (!k.along.empty())
    document.sections.push_back({.id = "conditioning", .title = "Conditioning", .items = {conditioning_panels(k)}});
  if (!result.errors.empty())
    document.sections.push_back({.id = "errors", .title = "Standing errors", .items = {error_table(result.errors)}});
  if (!result.contacts.empty())
    document.sections.push_back(
        {.id = "contacts", .title = "Contacts", .items = {contact_frequencies(result.contacts)}});
  document.provenance = provenance_of(command, mechanism, {"none", "nothing is integrated"});
  return document;
}

}  // namespace boresight::app
