#include "comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace boresight::peers {
namespace {

// A logarithmic axis has no zero.
double drawn(double error) { return std::max(error, 1e-9); }

const ComparedPoint* best_of(const Comparison& all, double accuracy, const std::string& begins) {
  return all.cheapest_within(accuracy, [&](const ComparedPoint& p) { return p.program.rfind(begins, 0) == 0; });
}
const ComparedPoint* best_peer(const Comparison& all, double accuracy) {
  return all.cheapest_within(accuracy, [](const ComparedPoint& p) { return p.stands_alone; });
}

Claim claim(std::string text, double asked, const ComparedPoint* ours, const ComparedPoint* theirs) {
  Claim out{.text = std::move(text), .asked = asked, .measured = 0.0, .how = {}};
  if (ours && theirs) {
    out.measured = theirs->measured.cpu_seconds / ours->measured.cpu_seconds;
    out.how = fmt::format("{}, {}: {:.4g} ms, off by {:.2g} %; {}, {}: {:.4g} ms, off by {:.2g} %", ours->line(),
                          ours->fineness, 1e3 * ours->measured.cpu_seconds, 100.0 * ours->error, theirs->line(),
                          theirs->fineness, 1e3 * theirs->measured.cpu_seconds, 100.0 * theirs->error);
  } else {
    out.how = ours ? "no setting of the peer comes within it" : "no setting of ours comes within it";
  }
  return out;
}

std::vector<std::string> programs_of(const Comparison& all) {
  std::vector<std::string> names;
  for (const ComparedPoint& p : all.points)
    if (std::find(names.begin(), names.end(), p.program) == names.end()) names.push_back(p.program);
  return names;
}

// One colour a program, so that its methods stand together.
int color_of(const ComparedPoint& p) {
  static constexpr std::pair<const char*, int> kColors[] = {
      {"multibody", 1}, {"perturbation on lanes", 6}, {"perturbation", 2}, {"Simbody", 3}, {"MuJoCo", 7},
      {"SUNDIALS", 4},  {"quasistatic", 5},           {"envelope", 5}};
  for (const auto& [program, color] : kColors)
    if (p.program.rfind(program, 0) == 0) return color;
  return 8;
}

report::Chart chart_of(const Comparison& all, double accuracy) {
  report::Chart chart{
      .title = "Error of the pointing index against CPU time",
      .caption =
          "One second of motion, largest position error. Down and left is better; each mark is one step or "
          "tolerance, finer to the right; one colour a program. Errors are those of the median over "
          "neighbouring steps, with half "
          "their spread. Dashed: integrators of SUNDIALS on our right-hand sides.",
      .x = {"CPU of one second of motion", "ms", true},
      .y = {"error of the index", "%", true},
      .height = 760};
  std::vector<std::string> lines;
  for (const ComparedPoint& p : all.points)
    if (std::find(lines.begin(), lines.end(), p.line()) == lines.end()) lines.push_back(p.line());
  for (const std::string& line : lines) {
    report::Series series{.name = line, .style = report::Style::line_markers};
    report::Numbers x, y;
    for (const ComparedPoint& p : all.points) {
      if (p.line() != line || !p.done()) continue;
      x.push_back(1e3 * p.measured.cpu_seconds);
      y.push_back(100.0 * drawn(p.error));
      series.text.push_back(p.fineness);
      series.color = color_of(p);
      if (!p.ours && !p.stands_alone) series.style = report::Style::dash_markers;
    }
    if (x.empty()) continue;
    series.x = std::move(x);
    series.y = std::move(y);
    chart.series.push_back(std::move(series));
  }
  chart.lines.push_back({'y', 100.0 * accuracy, fmt::format("{:g} % of the index", 100.0 * accuracy)});
  chart.lines.push_back({'y', 100.0 * drawn(all.reference.uncertainty), "the reference's own uncertainty"});
  return chart;
}

report::Table cheapest_table(const Comparison& all, double accuracy) {
  report::Table table{.title = fmt::format("Cheapest within {:g} % of the index", 100.0 * accuracy),
                      .caption = "Ratios to the cheapest whole program that is not ours.",
                      .columns = {{"Program"}, {"Way"}, {"Fineness"}, {"Error", "%"}, {"CPU", "ms"}, {"Times faster"}}};
  const ComparedPoint* peer = best_peer(all, accuracy);
  for (const std::string& name : programs_of(all)) {
    const ComparedPoint* p = all.cheapest_within(accuracy, [&](const ComparedPoint& q) { return q.program == name; });
    if (!p) {
      table.rows.push_back({name, "none comes within it", nullptr, nullptr, nullptr, nullptr});
      continue;
    }
    table.rows.push_back(
        {name, p->setup, p->fineness, 100.0 * p->error, 1e3 * p->measured.cpu_seconds,
         peer ? nlohmann::json(peer->measured.cpu_seconds / p->measured.cpu_seconds) : nlohmann::json()});
  }
  return table;
}

report::Table proof_table(const Comparison& all) {
  report::Table table{.title = "What each program models, proved",
                      .caption =
                          "Without clearance it follows the ideal motion; with it, up to the first contact, "
                          "our multibody rung's.",
                      .columns = {{"Program"},
                                  {"Setting"},
                                  {"From the ideal motion", "nm"},
                                  {"From our flight", "nm"},
                                  {"First contact", "ms"},
                                  {"Ours", "ms"},
                                  {"How it is written"}}};
  for (const ProvedPeer& p : all.proofs)
    table.rows.push_back(
        {p.name, p.setting, p.proof.has_ideal ? nlohmann::json(1e9 * p.proof.from_ideal) : nlohmann::json(),
         1e9 * p.proof.flight_difference, 1e3 * p.proof.first_contact, 1e3 * p.proof.our_first_contact, p.models});
  return table;
}

report::Table every_table(const Comparison& all) {
  report::Table table{
      .title = "Every setting",
      .caption = {},
      .columns = {
          {"Way"}, {"Fineness"}, {"Index", "mm"}, {"Half spread", "%"}, {"Error", "%"}, {"CPU", "ms"}, {"Outcome"}}};
  for (const ComparedPoint& p : all.points) {
    if (p.done())
      table.rows.push_back({p.line(), p.fineness, 1e3 * p.measured.value,
                            100.0 * p.measured.half_spread / all.reference.value, 100.0 * p.error,
                            1e3 * p.measured.cpu_seconds, "done"});
    else
      table.rows.push_back({p.line(), p.fineness, nullptr, nullptr, nullptr, nullptr, "failed: " + p.measured.refusal});
  }
  return table;
}

}  // namespace

std::vector<Claim> claims(const Comparison& all, double accuracy) {
  const ComparedPoint* multibody = best_of(all, accuracy, "multibody");
  std::vector<Claim> out;
  if (best_of(all, 1e300, "MuJoCo"))
    out.push_back(
        claim("multibody is at least 2 times faster than MuJoCo", 2.0, multibody, best_of(all, accuracy, "MuJoCo")));
  if (best_of(all, 1e300, "Simbody"))
    out.push_back(
        claim("multibody is at least 5 times faster than Simbody", 5.0, multibody, best_of(all, accuracy, "Simbody")));
  if (best_peer(all, 1e300))
    out.push_back(claim("a sample of perturbation is at least 1,500 times faster than the best of them", 1500.0,
                        best_of(all, accuracy, "perturbation"), best_peer(all, accuracy)));
  return out;
}

void print(const Comparison& all, double accuracy) {
  fmt::print("reference {:.5g} mm, known to {:.2g} %; {}, load {:.2g}\n", 1e3 * all.reference.value,
             100.0 * all.reference.uncertainty, all.machine.processor, all.machine.load);
  for (const ProvedPeer& p : all.proofs)
    fmt::print("{} ({}): {}{:.2g} nm from our flight to the first contact, at {:.5g} ms, ours at {:.5g} ms\n", p.name,
               p.setting,
               p.proof.has_ideal
                   ? fmt::format("{:.2g} nm from the ideal motion without clearance, ", 1e9 * p.proof.from_ideal)
                   : "",
               1e9 * p.proof.flight_difference, 1e3 * p.proof.first_contact, 1e3 * p.proof.our_first_contact);
  fmt::print("{:<62} {:<18} {:>9} {:>9} {:>10}\n", "way", "fineness", "index mm", "error %", "CPU ms");
  for (const ComparedPoint& p : all.points) {
    if (p.done())
      fmt::print("{:<62} {:<18} {:>9.5f} {:>9.3g} {:>10.4g}\n", p.line(), p.fineness, 1e3 * p.measured.value,
                 100.0 * p.error, 1e3 * p.measured.cpu_seconds);
    else
      fmt::print("{:<62} {:<18} {}\n", p.line(), p.fineness, p.measured.refusal);
  }
  fmt::print("\nwithin {:g} % of the index\n", 100.0 * accuracy);
  for (const Claim& c : claims(all, accuracy))
    fmt::print("  {}: {:.4g} times, {}\n    {}\n", c.text, c.measured, c.holds() ? "holds" : "does not hold", c.how);
}

report::Document comparison_document(const Mechanism& mechanism, const Comparison& all, double accuracy) {
  report::Document document{.title = mechanism.name(),
                            .subtitle = "Beside Simbody, MuJoCo and SUNDIALS, in one run on one machine",
                            .verb = "peers"};
  report::Findings findings{
      .title = fmt::format("Within {:g} % of the index", 100.0 * accuracy), .caption = {}, .items = {}};
  std::size_t held = 0;
  const std::vector<Claim> all_claims = claims(all, accuracy);
  for (const Claim& c : all_claims) {
    held += c.holds();
    findings.items.push_back({.claim = c.text,
                              .status = c.holds() ? report::Agreement::agrees : report::Agreement::differs,
                              .measured = fmt::format("{:.4g} times", c.measured),
                              .why = c.how});
  }
  document.verdict = report::Verdict{
      held == all_claims.size() ? report::Standing::good : report::Standing::neutral,
      fmt::format("{} of {} claims hold at {:g} % of the index.", held, all_claims.size(), 100.0 * accuracy)};
  document.facts.push_back({.label = "Reference",
                            .value = fmt::format("{:.5g} mm", 1e3 * all.reference.value),
                            .note = fmt::format("known to {:.2g} %", 100.0 * all.reference.uncertainty)});
  report::Section section{.id = "speed", .title = "Accuracy against speed"};
  section.items.push_back(chart_of(all, accuracy));
  if (!findings.items.empty()) section.items.push_back(std::move(findings));
  section.items.push_back(cheapest_table(all, accuracy));
  document.sections.push_back(std::move(section));
  if (!all.proofs.empty())
    document.sections.push_back({.id = "proof", .title = "The same mechanism", .items = {proof_table(all)}});
  document.sections.push_back({.id = "every", .title = "Every setting", .items = {every_table(all)}});
  document.provenance.push_back(
      {"Machine", fmt::format("{}, {} cores, {}, {}, load {:.2g} while measuring", all.machine.processor,
                              all.machine.cores, all.machine.compiler, all.machine.build, all.machine.load)});
  return document;
}

}  // namespace boresight::peers
