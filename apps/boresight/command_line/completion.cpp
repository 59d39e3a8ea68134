#include "command_line/completion.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight::app {
namespace {

// Options that take one of a few words.
struct Words {
  const char* option;
  std::string words;
};
std::vector<Words> options_with_words() {
  return {{"--rung", fmt::format("auto {}", fmt::join(rung_names(), " "))},
          {"--integrator", fmt::format("{}", fmt::join(integrator_names(), " "))},
          {"--formulation", "tree paper"},
          {"--stabilisation", "baumgarte projection"}};
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> options_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string bash(const CLI::App& app) {
  std::string verbs, cases;
  for (const CLI::App* verb : verbs_of(app)) {
    verbs += (verbs.empty() ? "" : " ") + verb->get_name();
    cases += fmt::format("    {}) options=\"{}\" ;;\n", verb->get_name(), fmt::join(options_of(*verb), " "));
  }
  std::string words;
  for (const Words& w : options_with_words())
    words += fmt::format("    {}) COMPREPLY=($(compgen -W \"{}\" -- \"$current\")); return ;;\n", w.option, w.words);
  return fmt::format(R"(_boresight() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}" options=""
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{}" -- "$current"))
    return
  fi
  case "$previous" in
{}  esac
  case "${{COMP_WORDS[1]}}" in
{}  esac
  if [[ "$current" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _boresight boresight
)",
                     verbs, words, cases);
}

std::string in_fish_quotes(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return "'" + quoted + "'";
}

std::string fish(const CLI::App& app) {
  std::string script;
  for (const CLI::App* verb : verbs_of(app)) {
    script += fmt::format("complete -c boresight -n __fish_use_subcommand -f -a {} -d {}\n", verb->get_name(),
                          in_fish_quotes(verb->get_description()));
    for (const CLI::Option* option : verb->get_options())
      for (const std::string& name : option->get_lnames()) {
        std::string words;
        for (const Words& w : options_with_words())
          if (w.option == "--" + name) words = fmt::format(" -x -a '{}'", w.words);
        script += fmt::format("complete -c boresight -n '__fish_seen_subcommand_from {}' -l {} -d {}{}\n",
                              verb->get_name(), name, in_fish_quotes(option->get_description()), words);
      }
  }
  return script;
}

}  // namespace

const std::vector<std::string>& completion_shells() {
  static const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  return shells;
}

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  if (shell == "zsh") return "autoload -U +X bashcompinit && bashcompinit\n" + bash(app);
  if (shell == "fish") return fish(app);
  throw std::invalid_argument("no completion for " + shell);
}

}  // namespace boresight::app
