#include "command_line/study_input.hpp"

#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "terminal/exit_status.hpp"

namespace boresight::app {

AcceptsSetting trial_of(const std::string& mechanism_file, const std::vector<Setting>& settings) {
  return [several = trial_of_all(mechanism_file, settings)](const Setting& setting) { several({setting}); };
}

AcceptsSettings trial_of_all(const std::string& mechanism_file, const std::vector<Setting>& settings) {
  return [mechanism_file, settings](const std::vector<Setting>& further) {
    std::vector<Setting> all = settings;
    all.insert(all.end(), further.begin(), further.end());
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
      trial(trial_of(study.mechanism_file, settings)),
      trial_all(trial_of_all(study.mechanism_file, settings)) {
  check_index(study, *mechanism);
}

int status_with_accuracy(const RungChoice& choice, int status) {
  return status == kDone && choice.pilot && !choice.pilot->met ? kAnswerIsNo : status;
}

}  // namespace boresight::app
