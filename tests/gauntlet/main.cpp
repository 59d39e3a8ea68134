// boresight_gauntlet: generated mechanisms and those of files through every rung, integrator and verb. README.md.
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <thread>

#include "errors.hpp"
#include "generator.hpp"
#include "plays.hpp"
#include "table.hpp"
#include "trial.hpp"

namespace boresight::gauntlet {
namespace {

struct Entry {
  std::string name, family, text;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

volatile std::sig_atomic_t asked_to_end = 0;

// To a terminal or a log, now and then: how far it is.
class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void done(const Verdict& v) {
    ++done_;
    wrong_ += has_new_fault(v);
    const auto now = std::chrono::steady_clock::now();
    if (now - told_ < std::chrono::seconds(kSecondsBetween) || done_ == all_) return;
    told_ = now;
    const double minutes = std::chrono::duration<double>(now - began_).count() / 60.0;
    fmt::print(stderr, "{} of {} scenes, {} wrong; {:.0f} min so far, {:.0f} min left\n", done_, all_, wrong_, minutes,
               minutes / static_cast<double>(done_) * static_cast<double>(all_ - done_));
  }

 private:
  static constexpr int kSecondsBetween = 30;
  std::size_t all_, done_ = 0;
  int wrong_ = 0;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(), told_ = began_;
};

// Several scenes at once, each in its own process; verdicts of those that were tried, in the order of the scenes. Ctrl-C ends it with the
// scenes under way.
std::vector<Verdict> try_all(const std::vector<std::function<Entry()>>& scenes, const TrialOptions& options, int jobs,
                             KnownFaults& known, const std::string& flags) {
  std::vector<Verdict> verdicts(scenes.size());
  struct Running {
    pid_t process;
    int file;
    std::size_t scene;
    std::string text;
  };
  std::vector<Running> running;
  std::size_t next = 0;
  Progress progress(scenes.size());
  const auto begins = [&] { return next < scenes.size() && asked_to_end == 0; };
  while (begins() || !running.empty()) {
    while (begins() && static_cast<int>(running.size()) < jobs) {
      int ends[2];
      if (pipe(ends) != 0) throw std::runtime_error("no pipe");
      fflush(nullptr);
      const pid_t child = fork();
      if (child < 0) throw std::runtime_error("no process");
      if (child == 0) {
        close(ends[0]);
        const Entry entry = scenes[next]();
        const std::string text = to_json(try_scene(entry.name, entry.family, entry.text, options)).dump();
        for (std::size_t done = 0; done < text.size();) {
          const ssize_t n = write(ends[1], text.data() + done, text.size() - done);
          if (n <= 0) _exit(1);
          done += static_cast<std::size_t>(n);
        }
        _exit(0);
      }
      close(ends[1]);
      running.push_back({child, ends[0], next++, {}});
    }
    std::vector<pollfd> waits;
    for (const Running& r : running) waits.push_back({r.file, POLLIN, 0});
    if (poll(waits.data(), waits.size(), -1) < 0) continue;  // a signal
    for (std::size_t k = waits.size(); k-- > 0;) {
      if (waits[k].revents == 0) continue;
      Running& r = running[k];
      char buffer[1 << 16];
      const ssize_t n = read(r.file, buffer, sizeof buffer);
      if (n > 0) {
        r.text.append(buffer, static_cast<std::size_t>(n));
        continue;
      }
      close(r.file);
      int status = 0;
      waitpid(r.process, &status, 0);
      const Json json = Json::parse(r.text, nullptr, false);
      Verdict& v = verdicts[r.scene];
      if (json.is_discarded()) {
        v.scene = fmt::format("scene {} of this call", r.scene);
        v.fault("crash", "the gauntlet itself", fmt::format("status {}", status));
      } else {
        v = verdict_from(json);
      }
      known.mark(v);
      print_faults(v, flags);
      fflush(stdout);
      progress.done(v);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  verdicts.resize(next);
  return verdicts;
}

int run(int argc, char** argv) {
  CLI::App app("Mechanisms from seeds and files through every rung, integrator and verb");
  std::uint64_t from = 1, count = 0;
  int jobs = 1;
  std::vector<std::string> files, write;
  std::vector<std::uint64_t> seeds;
  std::string save, known_file;
  bool corpus = false, errors = false, plays = false;
  TrialOptions options;
  options.program = BORESIGHT_PROGRAM;
  app.add_option("--from", from, "first seed");
  app.add_option("--count", count, "how many seeds");
  app.add_option("--seed", seeds, "further seeds");
  app.add_option("--jobs", jobs, "scenes at once");
  app.add_option("--scene", files, "mechanism files")->check(CLI::ExistingFile);
  app.add_flag("--corpus", corpus, "the archetypes of tests/gauntlet/corpus");
  app.add_flag("--errors", errors, "standing errors of lengths, axes and drives in each scene");
  app.add_flag("--plays", plays, "play in each scene's guides, balls, crosses, pads and pairs of bearings too");
  app.add_option("--write", write, "SEED FILE: writes the mechanism file of a seed")->expected(2);
  app.add_option("--save", save, "folder for the mechanism files of scenes with faults");
  app.add_option("--known", known_file, "file of known faults, which are printed and do not count")
      ->check(CLI::ExistingFile);
  app.add_option("--cpu", options.limits.cpu_seconds, "limit of one stage, s of CPU")->capture_default_str();
  app.add_flag("--auto", options.automatic, "`run --accuracy` by the program, against the reference");
  app.add_flag("--verbs", options.verbs, "a small study of every verb");
  app.add_option("--program", options.program, "the boresight program");
  app.add_flag("--integrators,!--no-integrators", options.integrators, "all integrators, or each rung's own only");
  app.add_flag("--invariances,!--no-invariances", options.invariances,
               "the drawing moved, turned, renamed, reordered, in other units");
  CLI11_PARSE(app, argc, argv);
  // It is called from other folders.
  if (options.program.find('/') != std::string::npos)
    options.program = std::filesystem::absolute(options.program).string();

  const auto dressed = [errors, plays](std::string text, bool corners = false) {
    if (plays) text = with_plays(text, corners);
    return errors ? with_errors(text) : text;
  };
  if (!write.empty()) {
    std::ofstream(write[1]) << dressed(generate(std::stoull(write[0])).toml(),
                                       std::stoull(write[0]) >= kFirstSeedWithCorners);
    return 0;
  }
  std::vector<std::function<Entry()>> scenes;
  if (corpus)
    for (const auto& entry : std::filesystem::directory_iterator(GAUNTLET_CORPUS))
      if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files)
    scenes.push_back([file, dressed] { return Entry{file, "file", dressed(text_of(file))}; });
  for (std::uint64_t seed = from; seed < from + count; ++seed) seeds.push_back(seed);
  for (std::uint64_t seed : seeds)
    scenes.push_back([seed, dressed] {
      const Scene scene = generate(seed);
      return Entry{fmt::format("seed {}", seed), scene.family, dressed(scene.toml(), seed >= kFirstSeedWithCorners)};
    });
  KnownFaults known = known_file.empty() ? KnownFaults() : KnownFaults(known_file);
  std::string flags;  // of this call, by which a scene is made and tried again
  for (const auto& [given, flag] : {std::pair{errors, "--errors"},
                                    {plays, "--plays"},
                                    {options.automatic, "--auto"},
                                    {options.verbs, "--verbs"},
                                    {!options.integrators, "--no-integrators"},
                                    {!options.invariances, "--no-invariances"}})
    if (given) flags += std::string(" ") + flag;
  const std::vector<Verdict> verdicts = try_all(scenes, options, jobs, known, flags);
  print_table(verdicts);
  for (const std::string& gone : known.gone()) fmt::print("mended, take it off the list: {}\n", gone);
  if (!save.empty()) {
    std::filesystem::create_directories(save);
    for (std::size_t k = 0; k < verdicts.size(); ++k)
      if (!verdicts[k].faults.empty()) {
        const Entry entry = scenes[k]();
        std::string name = std::filesystem::path(entry.name).stem().string();
        std::replace(name.begin(), name.end(), ' ', '-');
        std::ofstream(std::filesystem::path(save) / (name + ".toml")) << entry.text;
      }
  }
  if (asked_to_end != 0) return 130;
  const bool wrong = std::any_of(verdicts.begin(), verdicts.end(), has_new_fault);
  return wrong ? 1 : 0;
}

}  // namespace
}  // namespace boresight::gauntlet

int main(int argc, char** argv) {
  // Inherited by the scenes' processes, which go on where a signal is sent to all of them, and not by the programs that these run.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { boresight::gauntlet::asked_to_end = 1; });
  try {
    return boresight::gauntlet::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "boresight_gauntlet: {}\n", e.what());
    return 2;
  }
}
