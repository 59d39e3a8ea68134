#include "command_line/study_input.hpp"

#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "terminal/exit_status.hpp"

namespace boresight::app {

std::function<void(const Setting&)> trial_of(const std::string& mechanism_file, const std::vector<Setting>& settings) {
  return [mechanism_file, settings](const Setting& setting) {
    std::vector<Setting> all = settings;
    all.push_back(setting);
    const Mechanism tried(read_mechanism(mechanism_file, all));
  };
}

StudyInput::StudyInput(const std::string& file, const std::vector<Setting>& settings)
    : document(Document::from_file(file)),
      root(document),
      study(read_study(root, document.content_hash())),
      mechanism(read_referred(
          root.origin("mechanism"), "mechanism", study.mechanism_file,
          [&] { return std::make_shared<const Mechanism>(read_mechanism(study.mechanism_file, settings)); })),
      trial(trial_of(study.mechanism_file, settings)) {
  check_index(study, *mechanism);
}

int status_with_accuracy(const RungChoice& choice, int status) {
  return status == kDone && choice.pilot && !choice.pilot->met ? kAnswerIsNo : status;
}

}  // namespace boresight::app
