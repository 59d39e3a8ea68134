// report_sample NAME FILE: writes one of the sample documents as HTML, for the browser test and for looking
// at.
#include <fstream>
#include <iostream>
#include <string>

#include "report/report.hpp"
#include "sample.hpp"

int main(int argc, char** argv) {
  using namespace boresight::report;
  const std::string name = argc == 3 ? argv[1] : "";
  if (name != "every-kind" && name != "hostile" && name != "many") {
    std::cerr << "usage: report_sample every-kind|hostile|many FILE\n";
    return 2;
  }
  std::ofstream file(argv[2]);
  write_html(file, name == "hostile" ? sample::hostile()
                   : name == "many"  ? sample::many_charts(30, 4000)
                                     : sample::every_kind());
  return file.good() ? 0 : 3;
}
