#include "montecarlo/several_rungs.hpp"

#include <filesystem>

#include "boresight_analyses/runs/scatter_draws.hpp"
#include "report_parts/report_parts.hpp"

namespace boresight::app {

std::unique_ptr<SampleModel> model_on(const SeveralRungs& s, const std::string& rung) {
  const RandomInputs& inputs = s.question.plan.inputs;
  RunOptions run = s.run;
  check_run_options(run, rung, *s.question.mechanism);
  const bool lanes =
      rung == "perturbation" && LaneSampleModel::serve(*s.question.mechanism, s.question.study.index, run);
  if (!lanes && run.step == 0.0)
    run.step = with_options_checked(
        [&] { return common_step(rung, s.question.mechanism, pilot_samples(inputs, *s.question.mechanism), run); });
  return sample_model(rung, s.question.mechanism, s.question.parameters_of(), s.question.study.index, run,
                      scene_varies(inputs));
}

RungChoice named_rung(const std::string& rung) { return {rung, "the study names its rungs", 0.0}; }

void claim_folder(const SeveralRungs& s) { announce_begun(s.out, s.command.verb, "begun and not yet ended"); }

Json several_rungs_summary(const SeveralRungs& s, const std::string& rung, const std::vector<std::string>& warnings) {
  Json json = common_summary(s.command, *s.question.mechanism, named_rung(rung), s.watch, warnings, false, s.out);
  json["study"] = {{"file", s.question.study.file}, {"hash", s.question.study.content_hash}};
  json["seed"] = s.question.plan.design.seed;
  json["index"] = {{"quantity", s.question.study.index.quantity},
                   {"statistic", s.question.study.index.statistic},
                   {"unit", s.question.study.index.si_unit()}};
  return json;
}

report::Document several_rungs_report(const SeveralRungs& s, const std::string& rung, const std::string& leaves_out,
                                      const std::vector<std::string>& warnings) {
  report::Document document{.title = s.question.mechanism->name(), .verb = "montecarlo"};
  document.warnings = warnings;
  document.sections.push_back(
      {.id = "model", .title = "What the " + rung + " rung leaves out", .items = {report::Text{leaves_out}}});
  document.provenance = provenance_of(s.command, *s.question.mechanism, named_rung(rung));
  document.provenance.push_back({"Study hash", s.question.study.content_hash});
  document.provenance.push_back({"Seed", static_cast<double>(s.question.plan.design.seed)});
  return document;
}

}  // namespace boresight::app
