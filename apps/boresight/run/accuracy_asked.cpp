#include "run/accuracy_asked.hpp"

#include <fmt/format.h>

#include <cmath>

#include "results/scatter_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

std::optional<AccuracyAsked> accuracy_asked(const Command& command, const RungChoice& choice, const RunResult& result,
                                            const IndexChoice& index) {
  if (!command.accuracy || choice.pilot) return std::nullopt;
  return AccuracyAsked{*command.accuracy, result.error.model_of(index.kind()) + result.error.discretisation};
}

std::string accuracy_sentence(const AccuracyAsked& asked, const IndexChoice& index) {
  const std::string wanted = readable_share(asked.wanted);
  if (std::isnan(asked.stated))
    return fmt::format("{}: whether it is within {} is not known, as nothing measured what the steps do to it",
                       index.title(), wanted);
  return fmt::format("{}: {} {}; the run states {} of itself", index.title(),
                     asked.met() ? "within" : "not shown to be within", wanted, readable_share(asked.stated));
}

Json accuracy_json(const AccuracyAsked& asked) {
  return {{"wanted", asked.wanted}, {"stated", number_json(asked.stated)}, {"met", asked.met()}};
}

}  // namespace boresight::app
