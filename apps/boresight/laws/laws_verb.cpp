// boresight laws [MECHANISM]: the contact and friction laws, what they return, where they hold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/law_range.hpp"
#include "boresight/contact_events/contact_report.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/play/play_words.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/option_range.hpp"
#include "command_line/verb.hpp"
#include "laws/laws_report.hpp"
#include "report_parts/report_parts.hpp"
#include "results/report_files.hpp"
#include "results/summary.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// The pin of the 3-RRCPR's F1: aluminium, 20 mm across, 0.1 mm of radial clearance, 30 mm long.
ClearanceParameters default_pin() {
  ClearanceParameters p;
  p.radial = p.axial = 0.1e-3;
  p.journal_radius = 10e-3;
  p.cap_radius = 16e-3;
  p.sleeve_length = 30e-3;
  p.friction.coefficient = 0.03;
  p.friction.static_coefficient = 0.045;
  return p;
}

void print(const LawsSubject& subject, const std::vector<NormalLawRow>& normal,
           const std::vector<FrictionLawRow>& friction, const OutputDirectory& out) {
  tell("restitution returned when asked for\n  {:<22}{:>8}{:>8}{:>8}{:>8}   formula; source; holds for\n",
       "contact law", "0.3", "0.5", "0.7", "0.9");
  const auto& asked = asked_restitutions();
  const auto at = [&](const NormalLawRow& row, double e) {
    return row.returned[static_cast<std::size_t>(std::find(asked.begin(), asked.end(), e) - asked.begin())];
  };
  for (const NormalLawRow& row : normal)
    tell("  {:<22}{:8.5f}{:8.5f}{:8.5f}{:8.5f}   {}; {}; {}{}\n", row.entry->name, at(row, 0.3), at(row, 0.5),
         at(row, 0.7), at(row, 0.9), row.entry->formula, row.entry->source, range_of(row, subject),
         row.good_from > 1.0 ? "" : fmt::format("; e within 0.02 from {} on", row.good_from));
  tell("  {:<22}friction over normal force; source\n", "friction law");
  for (const FrictionLawRow& row : friction)
    tell("  {:<22}{}; {}{}\n", row.entry->name, row.entry->formula, row.entry->source,
         row.entry->sticks ? "; holds a load at rest" : "");
  for (const std::string& warning : subject.warnings) tell("  warning: {}\n", warning);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

class LawsVerb : public Verb {
 public:
  std::string name() const override { return "laws"; }
  std::string file_kind() const override { return "mechanism"; }
  bool needs_file() const override { return false; }
  std::string summary() const override {
    return "contact and friction laws: formula, source, restitution asked for and returned, where each holds";
  }
  std::string example() const override { return "boresight laws antenna/mechanism.toml"; }
  std::string next(const Command& command, bool) const override {
    return "boresight run " + (command.file.empty() ? "MECHANISM.toml" : shell_word(command.file)) +
           " --set 'clearance.*.contact.law=NAME'";
  }
  std::vector<std::string> unused_options() const override { return {"--rung", "--accuracy"}; }
  void declare_options(CLI::App& app) override {
    declare_option(app, "--joint", joint_,
                   "the clearance joint whose geometry and material are taken; otherwise the first", "JOINT");
    declare_option_with_default(app, "--speed", speed_, "of the impact", "SPEED");
    declare_option_with_default(app, "--mass", mass_, "of the body that hits", "MASS");
  }

  int execute(const Command& command) override {
    const Stopwatch watch;
    LawsSubject subject = subject_of(command);
    subject.mass = quantity_between("--mass", mass_, kMassRange);
    subject.speed = quantity_between("--speed", speed_, kContactSpeedRange);
    const OutputDirectory out = OutputDirectory::open(
        command.out, command.verb, command.file.empty() ? "contact" : command.file,
        identity_of(command, subject.hash, "", {{"joint", subject.joint}, {"speed", speed_}, {"mass", mass_}}));
    const std::vector<NormalLawRow> normal = normal_law_table(subject.parameters, subject.mass, subject.speed);
    FrictionParameters friction_parameters = subject.parameters.friction;
    const std::vector<FrictionLawRow> friction = friction_law_table(friction_parameters);

    write_json(out, "summary.json", summary_of(command, subject, normal, friction, watch, out));
    out.write("restitution.csv", [&](std::ostream& s) {
      s << "law,asked,returned\n";
      for (const NormalLawRow& row : normal)
        for (std::size_t k = 0; k < row.returned.size(); ++k)
          s << row.entry->name << ',' << exact(asked_restitutions()[k]) << ',' << exact(row.returned[k]) << '\n';
    });
    out.write("force.csv", [&](std::ostream& s) {
      s << "law,t,penetration,force\n";
      for (const NormalLawRow& row : normal)
        for (const ImpactSample& p : row.path)
          s << row.entry->name << ',' << exact(p.t) << ',' << exact(p.penetration) << ',' << exact(p.force) << '\n';
    });
    out.write("friction.csv", [&](std::ostream& s) {
      s << "law,speed,friction_over_normal_force\n";
      for (const FrictionLawRow& row : friction)
        for (std::size_t k = 0; k < row.speed.size(); ++k)
          s << row.entry->name << ',' << exact(row.speed[k]) << ',' << exact(row.force[k]) << '\n';
    });
    write_report(out, laws_report(command, subject, normal, friction));
    out.publish();
    if (!command.quiet) print(subject, normal, friction, out);
    return kDone;
  }

 private:
  LawsSubject subject_of(const Command& command) const {
    LawsSubject subject;
    subject.parameters = default_pin();
    if (command.file.empty()) {
      for (const auto& [given, option] :
           {std::pair{!command.settings.empty(), "--set"}, std::pair{!joint_.empty(), "--joint"}})
        if (given) throw InputError({"command line", 0}, option, "no mechanism file", "one: boresight laws MECHANISM");
      return subject;
    }
    const Mechanism mechanism(read_mechanism(command.file, command.settings));
    const MechanismDescription& m = mechanism.description();
    if (mechanism.clearances() == 0)
      throw InputError({command.file, 0}, "clearance", "none", "at least one joint with clearance");
    std::vector<std::string> joints;
    const auto flat = [&](int c) { return is_pad(mechanism, c) || is_slider(mechanism, c); };
    int round = mechanism.clearances();  // the first that is no pad and no slider
    for (int c = mechanism.clearances() - 1; c >= 0; --c) round = flat(c) ? round : c;
    for (int c = 0; c < mechanism.clearances(); ++c) joints.push_back(joint_of_clearance(mechanism, c));
    if (round == mechanism.clearances())
      throw InputError({command.file, 0}, "clearance", parts_in_play(m).inserts + " alone",
                       "a journal or a ball, which the laws are of");
    const std::size_t c =
        joint_.empty() ? static_cast<std::size_t>(round)
                       : static_cast<std::size_t>(std::find(joints.begin(), joints.end(), joint_) - joints.begin());
    if (c == joints.size())
      throw InputError({"command line", 0}, "--joint", "\"" + joint_ + "\"", "a joint with clearance",
                       nearest_name(joint_, joints));
    if (flat(static_cast<int>(c)))
      throw InputError(
          {"command line", 0}, "--joint",
          "\"" + joint_ +
              (is_pad(mechanism, static_cast<int>(c)) ? "\", a pad in its slot" : "\", a slider in its guide"),
          "a joint with a journal or a ball, which the laws are of");
    subject.mechanism = mechanism.name();
    subject.hash = m.content_hash;
    subject.joint = joints[c];
    subject.parameters = mechanism.parameters().clearance[c];
    subject.contact_law = m.clearances[c].contact_law;
    subject.friction_law = m.clearances[c].friction_law;
    const auto contacts = analyse_contacts(mechanism, mechanism.parameters());
    subject.largest_load = contacts[c].largest_radial_load;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (const auto warning = range_warning(joints[k], m.clearances[k].contact_law,
                                             mechanism.parameters().clearance[k], contacts[k].largest_radial_load))
        subject.warnings.push_back(*warning);
    return subject;
  }

  static Json summary_of(const Command& command, const LawsSubject& subject, const std::vector<NormalLawRow>& normal,
                         const std::vector<FrictionLawRow>& friction, const Stopwatch& watch,
                         const OutputDirectory& out) {
    Json json;
    json["verb"] = command.verb;
    if (!subject.mechanism.empty())
      json["mechanism"] = {{"name", subject.mechanism}, {"hash", subject.hash}, {"file", command.file}};
    json["version"] = BORESIGHT_VERSION;
    json["rung"] = "none";
    json["rung_why"] = "one impact of a free mass per law and restitution";
    json["seed"] = nullptr;
    json["cpu_seconds"] = watch.cpu_seconds();
    json["wall_seconds"] = watch.wall_seconds();
    json["warnings"] = subject.warnings;
    for (const NormalLawRow& row : normal) {
      Json returned = Json::object();
      for (std::size_t k = 0; k < row.returned.size(); ++k)
        returned[fmt::format("{}", asked_restitutions()[k])] =
            std::isnan(row.returned[k]) ? Json() : Json(row.returned[k]);
      json["contact_laws"][row.entry->name] = {
          {"formula", row.entry->formula},
          {"source", row.entry->source},
          {"range", range_of(row, subject)},
          {"returned", returned},
          {"restitution_within_0.02_from", row.good_from > 1.0 ? Json() : Json(row.good_from)},
          {"depth", row.one.depth},
          {"force", row.one.force}};
    }
    for (const FrictionLawRow& row : friction)
      json["friction_laws"][row.entry->name] = {{"formula", row.entry->formula},
                                                {"source", row.entry->source},
                                                {"static_peak", row.entry->peak},
                                                {"sticks", row.entry->sticks}};
    json["files"] = {"summary.json", "restitution.csv", "force.csv", "friction.csv", "report.html", "report.json"};
    json["identity"] = Json::parse(out.identity().dump());
    return json;
  }

  std::string joint_, speed_ = "0.1 m/s", mass_ = "1 kg";
};

}  // namespace

std::unique_ptr<Verb> make_laws_verb() { return std::make_unique<LawsVerb>(); }

}  // namespace boresight::app
