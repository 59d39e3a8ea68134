#include "studies.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace boresight::gauntlet {
namespace {

std::string head() {
  return "format = 1\nmechanism = \"scene.toml\"\naccuracy = \"10 %\"\n\n[index]\nquantity = "
         "\"position_error\"\nstatistic = \"rms\"\n";
}

// The number that says how wide a joint's play is.
struct Width {
  std::string path;
  double value;  // [m]
};
Width width_of(const MechanismDescription& m, const ClearanceDescription& c) {
  const std::string path = "clearance." + m.joints[c.joint].name;
  if (m.joints[c.joint].type == JointType::planar) return {path + ".axial", c.parameters.axial};
  if (c.guide == GuideShape::rectangular) return {path + ".height_gap", c.parameters.height_gap};
  return {path + ".radial", c.parameters.radial};
}

std::string scatter(const Mechanism& mechanism) {
  std::string text;
  const MechanismDescription& m = mechanism.description();
  for (const ClearanceDescription& c : m.clearances) {
    const std::string path = "clearance." + m.joints[c.joint].name;
    const Width width = width_of(m, c);
    text += fmt::format(
        "\n[[random]]\nparameter = \"{}\"\ndistribution = {{ uniform = {{ min = \"{:.9g} m\", max = \"{:.9g} "
        "m\" }} }}\n",
        width.path, 0.8 * width.value, 1.2 * width.value);
    if (c.friction_law != "none" && c.parameters.friction.coefficient > 0.0)
      text += fmt::format(
          "\n[[random]]\nparameter = \"{}.friction.coefficient\"\ndistribution = {{ uniform = {{ min = {:.9g}, max = "
          "{:.9g} }} }}\n",
          path, 0.7 * c.parameters.friction.coefficient, 0.95 * c.parameters.friction.coefficient);
    if (text.size() > 600) break;
  }
  return text;
}

}  // namespace

std::vector<Study> studies(const Mechanism& mechanism, double typical, const std::string& data) {
  const MechanismDescription& m = mechanism.description();
  std::vector<Study> all;
  if (m.clearances.empty()) return all;
  const ClearanceDescription& first = m.clearances.front();
  const auto [path, radial] = width_of(m, first);
  const std::vector<std::string> cheap = {"--rung", "perturbation"};
  const std::string random = scatter(mechanism);

  all.push_back({"montecarlo", "montecarlo", "mc.toml",
                 head() + random +
                     fmt::format("\n[montecarlo]\nsamples = 12\nseed = 3\nrequirement = {{ limit = \"{:.9g} m\", "
                                 "probability = 0.8, confidence = 0.8 }}\n",
                                 1.2 * typical),
                 cheap});
  for (const char* integrator : {"dopri5", "rosenbrock"})
    all.push_back({std::string("montecarlo ") + integrator,
                   "montecarlo",
                   "mc.toml",
                   all[0].text,
                   {"--rung", "perturbation", "--integrator", integrator}});
  all.push_back({"montecarlo auto", "montecarlo", "mc.toml", all[0].text, {}});
  all.push_back(
      {"montecarlo tail",
       "montecarlo",
       "tail.toml",
       head() + random +
           fmt::format("\n[montecarlo]\nseed = 3\nrequirement = {{ limit = \"{:.9g} m\", probability = 0.99, "
                       "confidence = 0.8 }}\n"
                       "tail = {{ cheap = \"quasistatic\", exact = \"perturbation\", budget = \"1 s\", pilot = 20 }}\n",
                       1.1 * typical),
       {}});
  all.push_back({"montecarlo fidelities",
                 "montecarlo",
                 "fidelities.toml",
                 head() + random +
                     "\n[montecarlo]\nseed = 3\nfidelities = { models = [\"perturbation\", \"quasistatic\"], budget = "
                     "\"1 s\", pilot = 20 }\n",
                 {}});
  all.push_back(
      {"sweep", "sweep", "sweep.toml",
       head() + fmt::format("\n[sweep]\n[[sweep.axis]]\nparameter = \"{}\"\nvalues = [\"{:.9g} m\", \"{:.9g} m\"]\n",
                            path, 0.8 * radial, 1.2 * radial),
       cheap});
  all.push_back({"sensitivity", "sensitivity", "sensitivity.toml",
                 head() + random + "\n[sensitivity]\nsamples = 16\nseed = 3\n", cheap});
  all.push_back({"match", "match", "match.toml",
                 head() + random +
                     fmt::format("\n[match]\nminimise = \"index\"\nover = \"mean\"\nsamples = 4\nseed = 3\nevaluations "
                                 "= 6\nmap = 0\nfront = 0\nconfirm = 4\n"
                                 "[[match.variable]]\nparameter = \"{}\"\nfrom = \"{:.9g} m\"\nto = \"{:.9g} m\"\n",
                                 path, 0.7 * radial, 1.3 * radial),
                 cheap});
  if (random.find(path) != std::string::npos) {
    // What is matched may not scatter as well.
    std::string& text = all.back().text;
    const std::size_t at = text.find("[[random]]"), next = text.find("[[random]]", at + 1);
    text.erase(at, (next == std::string::npos ? text.find("[match]") : next) - at);
    if (next == std::string::npos) {  // one motion then, without samples
      const std::string sampled = "over = \"mean\"\nsamples = 4\nseed = 3\n", confirmed = "confirm = 4\n";
      text.replace(text.find(sampled), sampled.size(), "over = \"nominal\"\n");
      text.erase(text.find(confirmed), confirmed.size());
    }
  }
  // Fits are of journals and balls.
  const auto fitted = std::find_if(m.clearances.begin(), m.clearances.end(),
                                   [](const ClearanceDescription& c) { return c.parameters.radial > 0.0; });
  if (fitted != m.clearances.end()) {
    const auto [fit, gap] = width_of(m, *fitted);
    all.push_back({"allocate", "allocate", "allocate.toml",
                   head() + fmt::format("\n[allocate]\nrequirement = {{ limit = \"{:.9g} m\", probability = 0.9, "
                                        "confidence = 0.8 }}\nsamples = 40\nconfirm = 40\nseed = 3\nfront = 0\n"
                                        "[[allocate.joint]]\nparameter = \"{}\"\nleast = \"{:.9g} m\"\n"
                                        "processes = [{{ name = \"coarse\", tolerance = \"{:.9g} m\", price = 1 }}, {{ "
                                        "name = \"fine\", tolerance = \"{:.9g} m\", price = 3 }}]\n",
                                        1.3 * typical, fit, 0.5 * gap, 0.5 * gap, 0.1 * gap),
                   cheap});
  }
  const std::string random_budget = random;
  all.push_back(
      {"budget", "budget", "budget.toml",
       "format = 1\nmechanism = \"scene.toml\"\n\n[index]\nquantity = \"orientation_error\"\n" + random_budget +
           fmt::format("\n[budget]\nmembers = 8\nattribution = 4\nseed = 3\nsampling = \"{:.9g} s\"\nwindow = \"{:.9g} "
                       "s\"\n[[budget.requirement]]\nindex = \"APE\"\naxis = \"total\"\n"
                       "interpretation = \"mixed\"\nlimit = \"2 mrad\"\nprobability = 0.8\nconfidence = 0.8\n",
                       m.motion.duration / 100, m.motion.duration / 10),
       cheap});
  all.push_back(
      {"calibrate",
       "calibrate",
       "calibrate.toml",
       fmt::format(
           "format = 1\nmechanism = \"scene.toml\"\n\n[calibrate]\nstarts = 1\ncorrections = "
           "0\n[[calibrate.parameter]]\npath = \"{}\"\nstart = \"{:.9g} m\"\n[[calibrate.run]]\ndata = \"{}\"\n",
           path, 1.1 * radial, data),
       {}});
  all.push_back({"laws", "laws", "", "", {}});
  all.push_back({"stability", "stability", "", "", {}});
  all.push_back({"chart", "chart", "", "", {"--time", "10 s"}});
  all.push_back({"export", "export", "", "", {}});
  return all;
}

}  // namespace boresight::gauntlet
