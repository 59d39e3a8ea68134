// boresight check MECHANISM: mobility, redundancy, singular poses, contact frequencies; exit 1 when something
// stands in the way.
#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "boresight/io/mechanism_file.hpp"
#include "check/check_report.hpp"
#include "command_line/verb.hpp"
#include "results/assumed.hpp"
#include "results/report_files.hpp"
#include "results/summary.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

Json contacts_json(const std::vector<ContactFrequency>& contacts) {
  Json json = Json::object();
  for (const ContactFrequency& c : contacts)
    json[c.joint] = {{"hertz_stiffness", c.hertz_stiffness},         {"axial_stiffness", c.axial_stiffness},
                     {"effective_mass", c.effective_mass},           {"typical_load", c.typical_load},
                     {"typical_penetration", c.typical_penetration}, {"angular_frequency", c.angular_frequency},
                     {"largest_stable_step", c.largest_stable_step}, {"validity_speed", c.validity_speed}};
  return json;
}

Json start_json(const CheckResult& result) {
  Json json = Json::object();
  for (const StartingJournals::Journal& j : result.start.journals)
    json[j.joint] = {{"offset", vector_json(j.offset)}, {"slope", vector_json(j.slope)}};
  return json;
}

Json kinematics_json(const KinematicReport& k) {
  Json lost = Json::array();
  for (const LostMotion& l : k.lost)
    lost.push_back({{"t", l.t}, {"description", l.description}, {"measure", l.measure}});
  return {{"bodies", k.bodies},
          {"joints", k.joints},
          {"constraint_rows", k.constraint_rows},
          {"rank", k.rank},
          {"redundant_rows", k.redundant_rows},
          {"mobility", k.mobility},
          {"drives", k.drives},
          {"free_freedoms", k.free_freedoms},
          {"feasible", k.feasible},
          {"lost", lost}};
}

Json errors_json(const CheckResult& result) {
  Json json = Json::object();
  for (const ErrorEffect& e : result.errors)
    json[e.name] = {{"value", e.value},         {"position", e.position},
                    {"boresight", e.boresight}, {"does_nothing", e.does_nothing()},
                    {"uses_play", e.uses_play}, {"strain", e.strain}};
  return json;
}

// The ones that turn the boresight most, of the values that the file gives; where it gives none, of one unit.
void print_errors(const CheckResult& result) {
  if (result.errors.empty()) return;
  constexpr std::size_t kShown = 8;
  std::vector<const ErrorEffect*> order;
  for (const ErrorEffect& e : result.errors)
    if (e.strain.empty() && e.value != 0.0) order.push_back(&e);
  std::stable_sort(order.begin(), order.end(), [](const ErrorEffect* a, const ErrorEffect* b) {
    return a->boresight * std::abs(a->value) > b->boresight * std::abs(b->value);
  });
  for (std::size_t k = 0; k < std::min(kShown, order.size()); ++k) {
    const ErrorEffect& e = *order[k];
    const auto text = [&](double per_unit, const char* unit, const char* words) {
      return per_unit > 0.0 ? words + readable(per_unit * std::abs(e.value), unit) : std::string("nothing");
    };
    tell("  error.{} of {}: boresight off by {}, position by {}\n", e.name, readable_of_error(e.value, e.unit),
         text(e.boresight, "rad", "up to "), text(e.position, "m", e.boresight > 0.0 ? "" : "up to "));
  }
  if (order.size() < result.errors.size() || order.size() > kShown)
    tell("  {} errors; the report has what one unit of each does\n", result.errors.size());
}

void print(const Mechanism& mechanism, const CheckResult& result, const OutputDirectory& out) {
  const KinematicReport& k = result.kinematics;
  tell("{}: {}, {}, mobility {}, {}, {}\n", mechanism.name(), how_many(k.bodies, "body", "bodies"),
       how_many(k.joints, "joint"), k.mobility, how_many(k.drives, "drive"),
       how_many(k.redundant_rows, "redundant row"));
  for (const ContactFrequency& c : result.contacts) {
    if (c.largest_stable_step == 0.0) continue;  // its play cannot move: a problem below
    tell(
        "  {}: under its mean load, largest stable step of RK4 about {} (less where it strikes), penetration {}; "
        "impacts "
        "within the contact law up to {}\n",
        c.joint, c.largest_stable_step > 0.0 ? readable(c.largest_stable_step, "s") : "not known",
        readable(c.typical_penetration, "m"), readable(c.validity_speed, "m/s"));
  }
  print_errors(result);
  for (const std::string& note : result.notes) tell("  note: {}\n", note);
  for (const std::string& finding : result.findings) tell("  problem: {}\n", finding);
  if (result.findings.empty()) tell("  nothing stands in the way of this motion\n");
  tell("  report: {}\n", (out.path() / "report.html").string());
}

class CheckVerb : public Verb {
 public:
  std::string name() const override { return "check"; }
  std::string file_kind() const override { return "mechanism"; }
  std::string summary() const override {
    return "mobility, redundancy, singular poses, contact frequencies: what would go wrong before it does";
  }
  std::string example() const override { return "boresight check antenna/mechanism.toml"; }
  std::string next(const Command& command, bool answer_is_no) const override {
    if (answer_is_no)
      return "mend what the problems name, then boresight check " + shell_word(command.file) +
             " again; boresight help WORD explains a key";
    return "boresight run " + shell_word(command.file);
  }
  std::vector<std::string> unused_options() const override { return {"--rung", "--accuracy"}; }

  int execute(const Command& command) override {
    const Stopwatch watch;
    const auto shared = std::make_shared<const Mechanism>(read_mechanism(command.file, command.settings));
    const Mechanism& mechanism = *shared;
    const OutputDirectory out =
        OutputDirectory::open(command.out, command.verb, command.file,
                              identity_of(command, mechanism.description().content_hash, "", Json::object()));
    CheckResult result = check_mechanism(shared);
    for (const std::string& sentence : in_words(assumed_by(command, mechanism))) result.notes.push_back(sentence);

    Json json = common_summary(command, mechanism, {.name = "none", .why = "nothing is integrated"}, watch, {},
                               interrupted(), out);
    json["findings"] = result.findings;
    json["notes"] = result.notes;
    json["kinematics"] = kinematics_json(result.kinematics);
    json["contacts"] = contacts_json(result.contacts);
    if (!result.errors.empty()) json["standing_errors"] = errors_json(result);
    if (!result.start.journals.empty()) json["start"] = start_json(result);
    json["files"] = {"summary.json", "conditioning.csv", "report.html", "report.json"};
    write_json(out, "summary.json", json);
    out.write("conditioning.csv", [&](std::ostream& s) {
      s << "t,smallest_singular_value,orientation,position\n";
      for (const ConditioningSample& c : result.kinematics.along)
        s << exact(c.t) << ',' << exact(c.smallest_singular_value) << ',' << exact(c.orientation) << ','
          << exact(c.position) << '\n';
    });
    write_report(out, check_report(command, mechanism, result));
    out.publish();
    if (!command.quiet) print(mechanism, result, out);
    if (interrupted()) return kInterrupted;
    return result.findings.empty() ? kDone : kAnswerIsNo;
  }
};

}  // namespace

std::unique_ptr<Verb> make_check_verb() { return std::make_unique<CheckVerb>(); }

}  // namespace boresight::app
