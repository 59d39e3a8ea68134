// boresight serve FILE: a study or a mechanism as a model that other programs evaluate over HTTP (UM-Bridge).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "boresight/keys/units.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/function_question.hpp"
#include "command_line/option_range.hpp"
#include "command_line/verb.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/interruption.hpp"
#include "terminal/terminal.hpp"
#include "umbridge/http_server.hpp"

namespace boresight::app {
namespace {

constexpr const char* kLocal = "127.0.0.1";

class ServeVerb : public Verb {
 public:
  std::string name() const override { return "serve"; }
  std::string file_kind() const override { return "mechanism or study"; }
  std::string summary() const override {
    return "a model that other programs evaluate over HTTP, by UM-Bridge's protocol";
  }
  std::string example() const override { return "boresight serve antenna/montecarlo.toml --port 0 --time 1s"; }
  std::vector<std::string> unused_options() const override { return {"--out", "--json"}; }
  void declare_options(CLI::App& app) override {
    motion_.declare_model(app);
    app.add_option("--input", inputs_, "of a mechanism: a number that varies, by its path (any number of times)")
        ->type_name("PATH")
        ->allow_extra_args(false)
        ->take_all();
    declare_option(app, "--index", index_,
                   "of a mechanism: the index that it answers with; otherwise position_error.max",
                   "QUANTITY.STATISTIC");
    declare_option_with_default(app, "--address", address_,
                                "where it listens; the default is open to this machine alone", "ADDRESS");
    app.add_option("--port", port_, "where it listens; 0: any that is free")
        ->type_name("PORT")
        ->capture_default_str()
        ->check(CLI::Range(0, 65535));
    declare_option_with_default(app, "--limit", limit_, "longest time of one evaluation, waiting included", "TIME");
    declare_option(app, "--time", time_, "ends after this time; otherwise by Ctrl-C", "TIME");
  }

  int execute(const Command& command) override {
    const double limit = quantity_between("--limit", limit_, {kDuration, "1 ms", "1e6 s"});
    const double time = time_.empty() ? 0.0 : quantity_between("--time", time_, {kDuration, "1 ms", "1e9 s"});
    const AskedFunction asked = read_function({command, motion_, inputs_, index_});
    const UmBridge model(asked.function, "index");
    const auto start = std::chrono::steady_clock::now();
    HttpServer server(
        model, {.address = address_, .port = port_, .jobs = command.jobs, .longest = limit, .ended = [start, time] {
                  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start;
                  return interrupted() || (time > 0.0 && since.count() >= time);
                }});
    if (!command.quiet) announce(asked, server.port());
    const ServerCount count = server.serve();
    if (!command.quiet) tell("  {} requests answered, {} refused\n", count.answered, count.refused);
    return kDone;
  }

 private:
  void announce(const AskedFunction& asked, int port) const {
    const IndexFunction& f = *asked.function;
    tell("{}: model \"index\" at http://{}:{}, UM-Bridge 1.0; Ctrl-C ends it\n", asked.name, address_, port);
    tell("  rung: {}: {}\n", asked.rung.name, asked.rung.why);
    tell("  output, one number [{}]: {}\n", f.model().index.si_unit(), f.model().index.title());
    tell("  input, {} numbers:\n", f.inputs().size());
    for (const FunctionInput& input : f.inputs())
      tell("    {} [{}], here {:.6g}\n", input.name(), input.told_unit(), fmt::join(input.nominal, " and "));
    if (const std::string why = f.why_no_slopes(); !why.empty()) tell("  no gradients: {}\n", why);
    if (address_ != kLocal && address_ != "localhost" && address_ != "::1")
      tell("  warning: whoever reaches {} may have this machine compute; there is no password\n", address_);
    std::fflush(stdout);
  }

  MotionOptions motion_;
  std::vector<std::string> inputs_;
  std::string index_, address_ = kLocal, limit_ = "60 s", time_;
  int port_ = 4242;
};

}  // namespace

std::unique_ptr<Verb> make_serve_verb() { return std::make_unique<ServeVerb>(); }

}  // namespace boresight::app
