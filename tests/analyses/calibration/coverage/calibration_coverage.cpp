// How often a calibration's intervals hold the truth where the model that is fitted is not the one that made the data.
//
//   build/release/bin/calibration_coverage axial --sets 20 --first 1 --jobs 2 --scene four-bar --corrections 0
//
// Kinds: what the data have that the fit is not told of.
//   none     nothing but noise
//   step     multibody with fixed steps (RK4, 20 us) that do not locate impacts
//   axial    the axial gap a fifth larger or smaller
//   law      another damping law of like restitution (Hu and Guo's for Flores')
//   masses   every mass 1 % larger or smaller
//   lag      a sensor with a first-order lag of 0.2 ms
//   simbody  another program altogether: Simbody, where its package is installed; scene 3-rrcpr
// With --verbose each set prints minus two logarithms of its likelihood; with --from-truth the fit starts at the truth, and should end no lower.
// Every set draws its own truth, its own signs of what is off, and its own noise.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/calibration/allowances.hpp"
#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/rig.hpp"
#include "boresight_analyses/threads/on_threads.hpp"
#ifdef BORESIGHT_SIMBODY
#include "peer.hpp"
#endif

namespace boresight {
namespace {

struct Scene {
  std::string file, joint;
  std::vector<std::vector<Setting>> runs;
  std::vector<int> channels;
  double noise = 0.0, deviation = 0.0;  // relative, or [m]
  std::map<std::string, std::pair<double, double>>
      truth;           // least and largest, of the part of the path behind the joint
  double axial = 0.0;  // [m]
};

Scene four_bar() {
  Scene s;
  s.file = "/four-bar/four-bar.toml";
  s.joint = "D";
  for (const char* speed : {"2.0", "2.4", "2.8"})
    s.runs.push_back({{"motion.duration", "0.2 s"},
                      {"motion.drives.A", std::string("2*pi*") + speed + "*t"},
                      {"initial.journals", "centred"}});
  s.channels = {0, 1, 2, 3, 4, 5};
  s.noise = 0.01;
  s.truth = {{"radial", {1.6e-4, 2.4e-4}},
             {"contact.restitution", {0.5, 0.8}},
             {"friction.coefficient", {0.06, 0.14}},
             {"contact.stiffness_scale", {0.8, 1.25}}};
  s.axial = 5e-5;
  return s;
}

// The mechanism of examples/3-rrcpr: one second, 2 um on the platform's displacements.
Scene pointing_mechanism() {
  Scene s;
  s.file = "/3-rrcpr/3-rrcpr.toml";
  s.joint = "F1";
  s.runs = {{}};
  s.channels = {0, 1, 2};
  s.deviation = 2e-6;
  s.truth = {{"contact.restitution", {0.85, 0.93}}, {"friction.coefficient", {0.02, 0.05}}};
  s.axial = 1e-4;
  return s;
}

std::string text(double value, const char* unit = "") {
  char out[60];
  std::snprintf(out, sizeof out, "%.9g%s%s", value, *unit ? " " : "", unit);
  return out;
}

// Readings at these times of a motion that a rung follows with these options.
MatX readings(const std::string& rung, const std::shared_ptr<const Mechanism>& m, RunOptions options,
              const std::vector<double>& times, const std::vector<int>& channels) {
  options.sample_spacing = times[1] - times[0];
  options.events = false;
  const RunResult run = make_rung(rung, m)->run(m->parameters(), options);
  MatX out(static_cast<Eigen::Index>(times.size()), static_cast<Eigen::Index>(channels.size()));
  for (std::size_t i = 0; i < times.size(); ++i)
    for (std::size_t c = 0; c < channels.size(); ++c)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          channel_reading(channels[c], run.boresight.samples[i], m->boresight_B());
  return out;
}

// y' = (x - y) / tau, x straight between its values; y starts at x.
MatX lagged(const MatX& x, double spacing, double tau) {
  MatX y = x;
  const double a = std::exp(-spacing / tau);
  for (Eigen::Index i = 1; i < x.rows(); ++i) {
    const auto slope = ((x.row(i) - x.row(i - 1)) / spacing).eval();
    // Of x = x0 + slope s: y = x - slope tau + (y0 - x0 + slope tau) e^(-s / tau).
    y.row(i) = x.row(i) - slope * tau + (y.row(i - 1) - x.row(i - 1) + slope * tau) * a;
  }
  return y;
}

// Displacements (dx, dy, dz) as Simbody has them, at these times.
MatX simbody_readings([[maybe_unused]] const std::shared_ptr<const Mechanism>& m,
                      [[maybe_unused]] const std::vector<double>& times) {
#ifdef BORESIGHT_SIMBODY
  const peers::PeerScene scene(m, m->parameters());
  const auto peer = peers::make_simbody_peer();
  const peers::PeerMotion motion = peer->follow(scene, {.setting = peer->proving_setting(), .keep_path = true});
  const auto error = [&](const peers::PeerPose& pose) {
    return Vec3(pose.p - scene.ideal().body(pose.t, m->boresight_body()).p);
  };
  MatX out(static_cast<Eigen::Index>(times.size()), 3);
  std::size_t k = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (k + 2 < motion.path.size() && motion.path[k + 1].t < times[i]) ++k;
    const peers::PeerPose &before = motion.path[k], &after = motion.path[k + 1];
    const double share = (times[i] - before.t) / (after.t - before.t);
    out.row(static_cast<Eigen::Index>(i)) = ((1.0 - share) * error(before) + share * error(after)).transpose();
  }
  return out;
#else
  std::printf("simbody: libsimbody-dev was not there when this was built\n");
  std::exit(2);
#endif
}

std::vector<double> times_of(double duration, double spacing) {
  std::vector<double> t;
  for (int i = 0; i * spacing < duration * (1.0 + 1e-9); ++i) t.push_back(std::min(i * spacing, duration));
  return t;
}

struct Asked {
  std::string kind, scene = "four-bar", rung;
  int sets = 20, first = 1, jobs = 2, corrections = 0, starts = 4;
  double duration = 0.0, step = 2e-5;
  bool with_masses = false;   // they are fitted too, with what the file says as a prior
  bool from_truth = false;    // the fit starts there
  std::vector<Setting> more;  // of data and fit alike
  bool verbose = false, exact = false;
};

struct Found {
  std::vector<double> deviations, width;  // of value less truth in standard errors; half the interval over the truth
  std::vector<bool> inside;
  double variance_factor = 0.0;
  std::vector<std::string> verdict;
};

Found one_set(const Asked& asked, const Scene& scene, int set) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(set));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto either = [&](double low, double high) { return uniform(engine) < 0.5 ? low : high; };
  const std::string joint = "clearance." + scene.joint + ".";
  std::vector<Setting> truth;
  std::vector<std::string> paths;
  std::vector<double> true_values;
  for (const auto& [name, range] : scene.truth) {
    const double value = range.first + (range.second - range.first) * uniform(engine);
    paths.push_back(joint + name);
    true_values.push_back(value);
    truth.push_back({joint + name, text(value, name == "radial" ? "m" : "")});
  }
  const double axial = scene.axial * either(0.8, 1.2);
  CalibrationProblem problem;
  for (std::size_t r = 0; r < scene.runs.size(); ++r) {
    std::vector<Setting> told = scene.runs[r];
    told.insert(told.end(), asked.more.begin(), asked.more.end());
    if (asked.duration > 0.0) told.push_back({"motion.duration", text(asked.duration, "s")});
    if (asked.kind == "axial" && asked.from_truth) told.push_back({joint + "axial", text(axial, "m")});
    std::vector<Setting> made = told;
    made.insert(made.end(), truth.begin(), truth.end());
    if (asked.kind == "axial") made.push_back({joint + "axial", text(axial, "m")});
    const std::string file = std::string(BORESIGHT_EXAMPLES) + scene.file;
    if (asked.kind == "masses") {
      std::mt19937_64 signs(static_cast<std::uint64_t>(set) + 1000);  // the same in every run
      const MechanismDescription with = read_mechanism(file, made);
      for (const BodyDescription& body : with.bodies) {
        const double share = 1.0 + 0.01 * (uniform(signs) < 0.5 ? -1.0 : 1.0);
        const Setting mass = {"body." + body.name + ".mass", text(body.mass * share, "kg")};
        made.push_back(mass);
        if (asked.from_truth) told.push_back(mass);
      }
    }
    MechanismDescription description = read_mechanism(file, made);
    if (asked.kind == "law")
      for (ClearanceDescription& c : description.clearances) c.contact_law = "hu-guo";
    const auto maker = std::make_shared<const Mechanism>(description);
    RunOptions options;
    std::string rung = asked.rung.empty() ? "perturbation" : asked.rung;
    options.integrator = "dopri5";
    options.tolerance = 1e-7;
    if (asked.kind == "step") {
      rung = "multibody";
      options.integrator = "rk4";
      options.tolerance = 0.0;
      options.step = asked.step;
    }
    const double spacing = 1e-3, fine = 1e-4;
    const std::vector<double> times = times_of(maker->duration(), spacing);
    MatX clean;
    if (asked.kind == "simbody") {
      clean = simbody_readings(maker, times);
    } else if (asked.kind == "lag") {
      const MatX often =
          lagged(readings(rung, maker, options, times_of(maker->duration(), fine), scene.channels), fine, 2e-4);
      clean.resize(static_cast<Eigen::Index>(times.size()), often.cols());
      for (Eigen::Index i = 0; i < clean.rows(); ++i) clean.row(i) = often.row(10 * i);
    } else {
      clean = readings(rung, maker, options, times, scene.channels);
    }
    SyntheticRig rig;
    rig.channels = scene.channels;
    rig.noise = scene.noise;
    rig.deviation = scene.deviation;
    rig.seed = static_cast<std::uint64_t>(set);
    problem.runs.emplace_back("run " + std::to_string(r + 1),
                              std::make_shared<const Mechanism>(read_mechanism(file, told)),
                              with_rig_errors(rig, times, clean, static_cast<int>(r)));
  }
  const MechanismDescription& m = problem.runs.front().mechanism->description();
  for (std::size_t p = 0; p < paths.size(); ++p)
    problem.parameters.push_back(fitted_parameter(m, paths[p],
                                                  true_values[p] * (asked.from_truth                    ? 1.0
                                                                    : paths[p].ends_with("restitution") ? 0.9
                                                                                                        : 1.2)));
  CalibrationOptions options;
  if (asked.exact)
    options.discrepancy.reset();
  else
    allow_for(*options.discrepancy, problem);
  for (const BodyDescription& body : m.bodies) {
    if (!asked.with_masses) break;
    problem.parameters.push_back(fitted_parameter(m, "body." + body.name + ".mass", body.mass));
    problem.parameters.back().has_prior = true;
    problem.parameters.back().prior = 0.01 * body.mass;
  }
  problem.prepare(1e9, true);
  options.profile = true;
  if (getenv("TRACE"))
    options.progress = [last = std::string()](const std::string& stage, double, const std::string& e) mutable {
      if (stage != last) fprintf(stderr, "%8.2f %s %s\n", clock() / 1e6, stage.c_str(), e.c_str());
      last = stage;
      return true;
    };
  options.corrections = asked.corrections;
  options.starts = asked.starts;
  const CalibrationResult result = calibrate(problem, options);
  Found found;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const ParameterEstimate& e = result.inference.parameters[p];
    found.deviations.push_back((e.value - true_values[p]) / e.standard_error);
    found.width.push_back(0.5 * (e.high - e.low) / true_values[p]);
    found.inside.push_back(e.low <= true_values[p] && true_values[p] <= e.high);
  }
  found.variance_factor = result.inference.variance_factor;
  found.verdict = result.verdict;
  if (asked.verbose) {
    // Minus two logarithms of the likelihood, up to a constant that all fits of one set share.
    double loss = result.fit.cost;
    for (Eigen::Index c = 0; c < problem.sigma.size(); ++c)
      for (const CalibrationRun& run : problem.runs)
        loss += 2.0 * static_cast<double>(run.data.time.size()) * std::log(problem.sigma[c] / 1e-6);
    std::string line = "set " + std::to_string(set) + ", loss " + text(loss) + ", s^2 " + text(found.variance_factor);
    for (std::size_t p = 0; p < paths.size(); ++p) {
      char one[160];
      const ParameterEstimate& e = result.inference.parameters[p];
      std::snprintf(one, sizeof one, "; %s %.5g (truth %.5g), %+.1f se, +-%.2g %%",
                    paths[p].substr(joint.size()).c_str(), e.value, true_values[p], found.deviations[p],
                    100.0 * found.width[p]);
      line += one;
    }
    if (result.model_error) {
      const CalibrationModelError& e = *result.model_error;
      line += "\n    jump " + text(e.jump) + ", disagreement " + text(e.disagreement);
      for (std::size_t p = 0; p < paths.size(); ++p)
        line += ", " + text(100.0 * result.inference.parameters[p].data_error / true_values[p]) + " %";
      for (const SuspectFound& s : e.suspects)
        if (s.gain > 4.0 || s.adds.maxCoeff() > 1e-4)
          line += "\n      " + s.name + " " + text(s.mean) + " +- " + text(s.error) + ", gain " + text(s.gain) +
                  ", adds " + text(s.adds.maxCoeff());
    }
    for (const std::string& sentence : found.verdict) line += "\n    " + sentence;
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  }
  return found;
}

int cover(const Asked& asked) {
  const Scene scene = asked.scene == "four-bar" ? four_bar() : pointing_mechanism();
  std::vector<Found> found(static_cast<std::size_t>(asked.sets));
  for_each_on_threads(asked.sets, asked.jobs,
                      [&](int k) { found[static_cast<std::size_t>(k)] = one_set(asked, scene, asked.first + k); });
  int p = 0;
  for (const auto& [name, range] : scene.truth) {
    int inside = 0, within_two = 0;
    double square = 0.0;
    std::vector<double> width;
    for (const Found& f : found) {
      const auto k = static_cast<std::size_t>(p);
      inside += f.inside[k];
      within_two += std::abs(f.deviations[k]) <= 2.0;
      square += f.deviations[k] * f.deviations[k];
      width.push_back(f.width[k]);
    }
    std::sort(width.begin(), width.end());
    std::printf(
        "%-9s %-8s %-24s inside %3d of %3d, within 2 standard errors %3d, rms %6.2f standard errors, half width %.3g "
        "%%\n",
        asked.scene.c_str(), asked.kind.c_str(), name.c_str(), inside, asked.sets, within_two,
        std::sqrt(square / asked.sets), 100.0 * width[width.size() / 2]);
    ++p;
  }
  return 0;
}

}  // namespace
}  // namespace boresight

int main(int count, char** words) {
  boresight::Asked asked;
  static const std::set<std::string> kinds = {"none", "step", "axial", "law", "masses", "lag", "simbody"};
  if (count < 2 || !kinds.contains(words[1]))
    return std::printf("calibration_coverage none|step|axial|law|masses|lag|simbody [--sets N] ...\n"), 2;
  asked.kind = words[1];
  for (int k = 2; k < count; ++k) {
    const std::string option = words[k];
    if (option == "--verbose" || option == "--exact" || option == "--from-truth" || option == "--with-masses") {
      (option == "--verbose"      ? asked.verbose
       : option == "--exact"      ? asked.exact
       : option == "--from-truth" ? asked.from_truth
                                  : asked.with_masses) = true;
      continue;
    }
    if (k + 1 == count) return std::printf("%s needs a value\n", words[k]), 2;
    const std::string value = words[++k];
    if (option == "--sets")
      asked.sets = std::stoi(value);
    else if (option == "--first")
      asked.first = std::stoi(value);
    else if (option == "--jobs")
      asked.jobs = std::stoi(value);
    else if (option == "--starts")
      asked.starts = std::stoi(value);
    else if (option == "--corrections")
      asked.corrections = std::stoi(value);
    else if (option == "--scene")
      asked.scene = value;
    else if (option == "--rung")
      asked.rung = value;
    else if (option == "--duration")
      asked.duration = std::stod(value);
    else if (option == "--step")
      asked.step = std::stod(value);
    else if (option == "--set")
      asked.more.push_back({value.substr(0, value.find('=')), value.substr(value.find('=') + 1)});
    else
      return std::printf("no option %s\n", option.c_str()), 2;
  }
  return boresight::cover(asked);
}
