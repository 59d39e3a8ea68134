#include "results/report_files.hpp"

#include <fstream>
#include <ostream>
#include <sstream>

#include "boresight/mechanism/error.hpp"
#include "report/contract.hpp"
#include "report/report.hpp"
#include "results/folder_claim.hpp"
#include "results/whole_results.hpp"

namespace boresight::app {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& folder, const std::string& found, const std::string& expected) {
  throw InputError({"command line", 0}, "DIR", "\"" + folder.string() + "\", " + found, expected);
}

nlohmann::json json_in(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in, nullptr, false);
}

}  // namespace

void write_report(const OutputDirectory& out, const nlohmann::json& document) {
  const nlohmann::json prepared = report::prepared(document);
  out.write("report.html", [&](std::ostream& stream) { report::write_page(stream, prepared); });
  out.write("report.json", [&](std::ostream& stream) { stream << report::document_text(prepared) << '\n'; });
}

void rebuild_report(const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) refuse(folder, "which is no folder", "a folder of results");
  const std::optional<FolderClaim> claim = FolderClaim::take(folder);
  if (!claim) throw OutputDirectoryError(folder.string() + ": another run is writing there; wait for it to end");
  recover(folder);
  const nlohmann::json summary = json_in(folder / "summary.json");
  if (!summary.is_object() || !summary.contains("verb"))
    refuse(folder, "which has no results (no summary.json)", "a folder of results, as results/FILE-VERB");
  if (!fs::exists(folder / "report.json", failed)) {
    const bool begun = summary.value("interrupted", nlohmann::json(false)) == true;
    refuse(folder, "which has no report.json",
           begun ? "a study that has come to a result: give its command again, which goes on with it"
                 : "results of version 1.0.0 or later with a report: give the command again that made them");
  }
  const nlohmann::json document = json_in(folder / "report.json");
  try {
    report::check(document);
  } catch (const std::exception&) {
    refuse(folder, "whose report.json is damaged",
           "it as the verb wrote it: give the command again that made the results");
  }
  std::ostringstream page;
  report::write_page(page, document);
  write_atomically(folder / "report.html", std::move(page).str());
}

}  // namespace boresight::app
