// A study file as the verbs take it: opened, with its mechanism as --set leaves it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/io/document.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/study/legal_corners.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"

namespace boresight::app {

// A check that the mechanism takes one further setting, on top of `settings`: it throws InputError where it does not.
AcceptsSetting trial_of(const std::string& mechanism_file, const std::vector<Setting>& settings);

// The same of several further settings together.
AcceptsSettings trial_of_all(const std::string& mechanism_file, const std::vector<Setting>& settings);

struct StudyInput {
  // Throws InputError.
  StudyInput(const std::string& file, const std::vector<Setting>& settings);
  StudyInput(const StudyInput&) = delete;
  StudyInput& operator=(const StudyInput&) = delete;

  Document document;
  Cursor root;  // stands at what the verb's own plan reads
  Study study;
  std::shared_ptr<const Mechanism> mechanism;
  AcceptsSetting trial;
  AcceptsSettings trial_all;
};

// 0 turned into 1 where an accuracy was asked for and the pilot could not show it: the answer is then "no". For what is one
// number with an accuracy: a sweep and a search of designs only say it.
int status_with_accuracy(const RungChoice& choice, int status);

}  // namespace boresight::app
