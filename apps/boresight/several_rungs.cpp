#include "several_rungs.hpp"

#include <cmath>
#include <filesystem>

#include "report_parts.hpp"

namespace boresight::app {

RungSampleModel model_on(const SeveralRungs& s, const std::string& rung) {
  return RungSampleModel(rung, s.question.mechanism, s.question.parameters_of(), s.question.study.index, s.run,
                         s.question.scene_varies());
}

RungChoice named_rung(const std::string& rung) { return {rung, "the study names its rungs", 0.0}; }

Json bounds_json(const ReportedInterval& i) {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return {{"value", number(i.value)},   {"low", number(i.low)}, {"high", number(i.high)},
          {"confidence", i.confidence}, {"basis", i.basis}};
}

void claim_folder(const SeveralRungs& s) {
  if (std::filesystem::exists(s.out.path() / "summary.json")) return;
  write_json(s.out, "summary.json",
             {{"verb", s.command.verb},
              {"version", BORESIGHT_VERSION},
              {"interrupted", true},
              {"warnings", {"begun and not yet ended"}},
              {"identity", Json::parse(s.out.identity().dump())}});
}

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
