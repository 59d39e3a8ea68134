#include "reference/topics.hpp"

namespace boresight::app {

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = {
      {"units",
       "Values and their units",
       {"Files are TOML. A physical value is a text with its unit: \"0.1 mm\", \"72 GPa\", \"30 deg\", \"5000 rpm\". "
        "Any unit of the "
        "right dimension will do; UDUNITS-2 reads it. Pure numbers stand alone: 0.9.",
        "The radian counts as a dimension: \"rpm\" and \"deg/s\" are angular rates, \"Hz\" is not. A temperature, a "
        "logarithmic unit or "
        "a value without its unit is refused.",
        "Everything is given once, at home, in world axes, as an assembly drawing shows it."}},
      {"paths",
       "Paths",
       {"Every value of a mechanism has a path: clearance.F1.radial, body.rod1.mass, gravity.z. `--set PATH=VALUE` "
        "replaces a value "
        "before it is read; [[random]], [[sweep.axis]] and their like name numbers by the same paths. `boresight paths "
        "FILE` lists "
        "those of a file.",
        "A * stands for any one name: clearance.*.radial is the radial clearance of all joints. An element of a list "
        "has a path of its "
        "own: clearance.F1.contact.young.journal; the path of the list gives all elements one value."}},
      {"expressions",
       "Expressions of time",
       {"An expression is a text such as \"pi/6*sin(2*pi*t)\": numbers, t in seconds, pi, the operators + - * / ^ and "
        "functions "
        "such as sin, cos, tan, exp, log, sqrt. It is differentiated symbolically (GiNaC), so that speeds and "
        "accelerations are exact; "
        "it has to be finite, with its first two derivatives, during the whole motion.",
        "Of a pose, theta may use psi, phi both, and the position all three."}},
      {"editors",
       "Completion and checks in an editor",
       {"Editors that know JSON schemas for TOML (taplo and its plugins: Even Better TOML for VS Code) complete keys "
        "and underline "
        "what is wrong. Write the schema beside the file and name it in the file's first line:",
        " boresight schema mechanism > mechanism.schema.json", " #:schema ./mechanism.schema.json",
        "The schema knows names, kinds, words and what must be there. Units, names of bodies and what depends on other "
        "keys it cannot "
        "judge: `boresight check FILE` does."}},
      {"results",
       "Results and exit status",
       {"Every verb that computes writes a folder: results/FILE-VERB, or the one that --out names. It holds "
        "report.html, one "
        "file for a browser, which needs no network; report.json, what that shows; summary.json; and tables as CSV. "
        "Files are in SI with all digits, the terminal and the report in the units that people read.",
        "`boresight report DIR` makes report.html again from report.json: with the page of a newer version, or where "
        "only the small files were brought from a cluster.",
        "A folder that holds another study's results is never overwritten. A study that was stopped goes on where it "
        "was "
        "when the same command is given again.",
        "--json prints summary.json instead of the summary for people, --quiet nothing. In a pipe there are no "
        "colours, "
        "and progress comes as whole lines.",
        "The exit status says how it ended:", " 0    done",
        " 1    done, and the answer is no: a singular pose, a requirement not met",
        " 2    bad input: one line with file, line, key, what was found, what was expected",
        " 3    the computation failed, or its results could not be written",
        " 130  interrupted; what was reached is there as whole files"}},
  };
  return all;
}

}  // namespace boresight::app
