#include "command_line/verb.hpp"

namespace boresight::app {

// A verb is registered by one line here.
#define BORESIGHT_VERBS(VERB) \
  VERB(new)                   \
  VERB(import)                \
  VERB(check)                 \
  VERB(run)                   \
  VERB(sweep)                 \
  VERB(chart)                 \
  VERB(stability)             \
  VERB(montecarlo)            \
  VERB(sensitivity)           \
  VERB(match)                 \
  VERB(allocate)              \
  VERB(calibrate)             \
  VERB(budget)                \
  VERB(report)                \
  VERB(export)                \
  VERB(convert)               \
  VERB(laws)                  \
  VERB(serve)                 \
  VERB(paths)                 \
  VERB(help)                  \
  VERB(schema)

#define DECLARE(name) std::unique_ptr<Verb> make_##name##_verb();
BORESIGHT_VERBS(DECLARE)
#undef DECLARE

std::vector<std::unique_ptr<Verb>> all_verbs() {
  std::vector<std::unique_ptr<Verb>> verbs;
#define APPEND(name) verbs.push_back(make_##name##_verb());
  BORESIGHT_VERBS(APPEND)
#undef APPEND
  return verbs;
}

}  // namespace boresight::app
