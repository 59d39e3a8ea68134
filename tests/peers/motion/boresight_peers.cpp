// boresight_peers: our rungs beside Simbody, MuJoCo and SUNDIALS on the default scene, as a table and as one
// page with the chart.
//
//   build/release/bin/boresight_peers --out peers.html
//   build/release/bin/boresight_peers --set payload.mass=500kg
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "boresight/mechanism/error.hpp"
#include "comparison.hpp"
#include "comparison_report.hpp"
#include "report/report.hpp"
#include "scenes.hpp"

int main(int argc, char** argv) {
  using namespace boresight;
  CLI::App app{"Our rungs beside whole programs on the default mechanism: accuracy against speed in one chart"};
  std::string out = "peers.html";
  double accuracy = 0.01, most_seconds = 8.0;
  std::vector<std::string> texts;
  app.add_option("--out", out, "the page to write")->capture_default_str();
  app.add_option("--accuracy", accuracy, "of the index, at which speeds are compared")->capture_default_str();
  app.add_option("--most-seconds", most_seconds, "of CPU for one run, beyond which it is given up")
      ->capture_default_str();
  app.add_option("--set", texts, "PATH=VALUE, as in boresight run");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Setting> settings;
    for (const std::string& text : texts) {
      const std::size_t at = text.find('=');
      if (at == std::string::npos) throw std::invalid_argument("--set " + text + ": expected PATH=VALUE");
      settings.push_back({text.substr(0, at), text.substr(at + 1)});
    }
    const auto mechanism = scenes::build(scenes::rrcpr(settings));
    peers::ComparisonOptions options{.most_seconds = most_seconds};
    options.progress = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
    const peers::Comparison all = peers::compare(mechanism, mechanism->parameters(), options);
    peers::print(all, accuracy);
    std::ofstream file(out);
    report::write_html(file, peers::comparison_document(*mechanism, all, accuracy));
    file.close();
    if (!file) throw std::runtime_error(out + " could not be written");
    fmt::print("page: {}\n", out);
  } catch (const std::exception& failure) {
    fmt::print(stderr, "boresight_peers: {}\n", failure.what());
    return 2;
  }
}
