#include "boresight/rungs/option_check.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/spanning_tree.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " or " : ", ") + names[k];
  return text;
}

std::string quoted(const std::string& word) { return '"' + word + '"'; }

void check_word(const std::string& option, const std::string& word, const std::vector<std::string>& known,
                const std::string& where = "") {
  if (word.empty() || std::find(known.begin(), known.end(), word) != known.end()) return;
  throw OptionRefused(option, quoted(word), listed(known) + where, nearest_name(word, known));
}

void check_number(const std::string& option, double value, bool holds, const std::string& expected) {
  if (holds && std::isfinite(value)) return;
  std::ostringstream text;
  text << value;
  throw OptionRefused(option, text.str(), expected);
}

// Whether multibody's state, in this formulation, holds quaternions.
bool has_quaternions(const RunOptions& options, const Mechanism& mechanism) {
  if (options.formulation == "paper") return true;
  const SpanningTree tree(mechanism, true);
  return tree.positions() != tree.speeds();
}

}  // namespace

OptionRefused::OptionRefused(const std::string& of, const std::string& given, const std::string& wanted,
                             const std::string& meant)
    : std::invalid_argument(of + ": found " + given + ", expected " + wanted +
                            (meant.empty() ? "" : "; did you mean " + meant + "?")),
      option(of),
      found(given),
      expected(wanted),
      nearest(meant) {}

std::string why_unread(const std::string& option, const std::string& rung) {
  if (integrator_names(rung).empty()) return "the " + rung + " rung takes no steps";
  if ((option == "formulation" || option == "stabilisation") && rung != "multibody")
    return "the " + rung + " rung has equations of its own; the multibody rung has " + option + "s";
  return "";
}

void check_options(const RunOptions& options, const std::string& rung, const Mechanism& mechanism,
                   const Parameters& parameters) {
  const std::vector<std::string> own = integrator_names(rung);
  check_word("integrator", options.integrator, own.empty() ? integrator_names() : own,
             own.empty() ? "" : " (those of the " + rung + " rung)");
  check_word("formulation", options.formulation, {"tree", "paper"});
  check_word("stabilisation", options.stabilisation, {"baumgarte", "projection"});
  check_number("step", options.step, options.step >= 0.0, "a positive time, or 0 for the rung's own choice");
  check_number("sample_spacing", options.sample_spacing, options.sample_spacing >= 0.0,
               "a positive time, or 0 for no histories");
  check_number("baumgarte_alpha", options.baumgarte_alpha, options.baumgarte_alpha >= 0.0, "a gain not below 0");
  check_number("baumgarte_beta", options.baumgarte_beta, options.baumgarte_beta >= 0.0, "a gain not below 0");
  // A step that may err by the whole clearance says nothing about what happens in it.
  check_number("tolerance", options.tolerance, options.tolerance >= 0.0 && options.tolerance < 1.0,
               "a share of the smallest clearance, above 0 and below 1");
  if (own.empty()) return;

  const std::string integrator = options.integrator.empty() ? "rk4" : options.integrator;
  if (options.tolerance > 0.0 && integrator == "rk4") {
    std::ostringstream text;
    text << options.tolerance;
    throw OptionRefused("tolerance", text.str(),
                        "an integrator with an error estimate: " +
                            listed(std::vector<std::string>(own.begin() + 1, own.end())) + "; rk4 has none");
  }
  if (options.tolerance > 0.0 && options.step > 0.0)
    throw OptionRefused("tolerance", "a step too", "one of the two: steps are fixed, or follow an error estimate");
  if (integrator == "rk4") return;
  const MechanismDescription& m = mechanism.description();
  for (std::size_t c = 0; c < m.clearances.size() && integrator == "generalized-alpha"; ++c)
    if (JointPlay(m.clearances[c], m.joints[m.clearances[c].joint].type, parameters.clearance[c]).sticks)
      throw OptionRefused("integrator", quoted(integrator),
                          "rk4, dopri5 or rosenbrock: generalized-alpha needs coordinates whose rates are the speeds, "
                          "and the friction of " +
                              m.joints[m.clearances[c].joint].name + ", LuGre's, has a state without one");
  if (integrator == "generalized-alpha" && has_quaternions(options, mechanism))
    throw OptionRefused(
        "integrator", quoted(integrator),
        "rk4, dopri5 or rosenbrock: generalized-alpha needs coordinates whose rates are the speeds, and this "
        "state holds quaternions");
}

}  // namespace boresight
