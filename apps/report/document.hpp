// The structs a report is built from. Each becomes JSON of the contract by itself:
//
//   Chart chart{.title = "Position error", .x = {"Time", "s"}, .y = {"Error", "mm"}};
//   chart.series.push_back({.name = "with clearance", .x = t, .y = error});
//   chart.series.push_back({.name = "ideal", .x = t, .y = zero, .muted = true});
//   Document document{.title = "3-RRCPR", .verb = "run"};
//   document.sections.push_back({.id = "error", .title = "Pointing error", .items = {chart}});
//   write_html(file, document);
//
// Numbers are in the unit that the axis names: the report converts nothing. NaN and infinity are gaps.
#pragma once

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace boresight::report {

using Numbers = std::vector<double>;
using Names = std::vector<std::string>;
// What stands along an axis: numbers, or the names of categories (for bars, markers, boxes and heat maps).
using Along = std::variant<Numbers, Names>;

struct Axis {
  std::string label = {};
  std::string unit = {};  // empty: a pure number, or categories
  bool log = false;
  // In the axis' unit, also where it is logarithmic. None: what the data need.
  std::optional<std::array<double, 2>> range = {};
};

// histogram counts x and has no y; box draws one box per distinct x from its y values; area fills from y_low
// (else zero) to y.
enum class Style { line, dash, markers, line_markers, dash_markers, steps, bars, area, histogram, box };
const char* to_string(Style style);

struct Series {
  std::string name = {};  // the same name has the same colour in all panels of one item
  Along x = {};
  Along y = Numbers{};
  Style style = Style::line;
  bool muted = false;      // thin, dashed, neutral: the ideal curve, a reference
  bool hidden = false;     // present in the legend, drawn when asked for
  Numbers y_low = {};      // area: its lower edge; bars: where they begin (a waterfall), on the axis of their values
  Numbers error_low = {};  // distances from y, not negative
  Numbers error_high = {};
  Names text = {};  // shown when hovering
  int color = 0;    // 1..8 keeps a colour for this series across charts; 0: by order
  int bins = 0;     // histogram; 0: chosen from the data
};

struct Circle {
  double x = 0.0, y = 0.0, r = 0.0;
  std::string label = {};
};

// A line across the chart: a requirement, a validity limit.
struct Line {
  char axis = 'y';  // 'x': an upright line at x = value; 'y': a level line at y = value
  double value = 0.0;
  std::string label = {};
};

struct Heatmap {
  Along x = {}, y = {};
  std::vector<Numbers> z = {};  // one row per y, one number per x
  std::string label = {};
  std::string unit = {};
  bool log = false;        // colours by decade; values must be positive, others are gaps
  bool diverging = false;  // two-sided colours about zero, for correlations and differences
  Numbers contours = {};   // level lines drawn over the colours, in the unit of z
};

struct Chart {
  std::string title = {};
  std::string caption = {};
  Axis x = {}, y = {};
  bool equal_axes = false;  // one unit is as long along y as along x: orbits, journal in sleeve
  int height = 0;           // pixels; 0: chosen by the page
  std::vector<Series> series = {};
  std::vector<Circle> circles = {};
  std::vector<Line> lines = {};
  std::optional<Heatmap> heatmap = {};
};

// Small multiples; panels whose x axes are alike zoom together.
struct Panels {
  std::string title = {};
  std::string caption = {};
  int columns = 3;
  bool shared_legend = true;
  std::vector<Chart> panels = {};
};

struct Column {
  std::string label = {};
  std::string unit = {};
  std::string align = {};  // "left", "right", "center"; empty: numbers right, text left
};

// Cells are text, numbers (shown with four significant digits, kept in full in the CSV), true/false, or null.
struct Table {
  std::string title = {};
  std::string caption = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<nlohmann::json>> rows = {};
};

struct Text {
  std::string text = {};  // paragraphs are split by blank lines
};

enum class Agreement { agrees, differs, explained };
const char* to_string(Agreement agreement);

struct Finding {
  std::string claim = {};
  Agreement status = Agreement::agrees;
  std::string measured = {};
  std::string why = {};
};

struct Findings {
  std::string title = {};
  std::string caption = {};
  std::vector<Finding> items = {};
};

struct State {
  std::string name = {};
  std::string label = {};  // empty: the name
  bool muted = false;      // the state of rest ("free"): neutral colour
};

struct StripRow {
  std::string name = {};
  Numbers start = {}, end = {};
  Names state = {};
};

// Which state each row is in along x: contacts along time.
struct Strip {
  std::string title = {};
  std::string caption = {};
  Axis x = {};
  std::vector<State> states = {};
  std::vector<StripRow> rows = {};
};

// A point of the moving mechanism, world axes: where it would be ideally, and how far it is from there. One
// number for each instant of the view, or one alone for a point at rest; no deviation: none.
struct ViewPoint {
  Numbers x = {}, y = {}, z = {};
  Numbers dx = {}, dy = {}, dz = {};
};

// Points joined by a line; indices of View::points, as in what follows.
struct ViewBody {
  std::string name = {};
  std::vector<int> points = {};
  bool closed = false;  // back to the first point
  bool muted = false;   // the ground
};

// The room that the moving part's centre has, each way: a journal's in its sleeve (radial, axial), a ball's in its socket (radial; the joint
// has no tip), a slider's in a rectangular guide (width along the joint's side, height), a pad's in its slot (axial; pad is the radius of a round one,
// pad_width and pad_length the sides of a rectangular one).
struct ViewClearance {
  double radial = 0.0, axial = 0.0;
  double width = 0.0, height = 0.0, pad = 0.0, pad_width = 0.0, pad_length = 0.0;
};

// tip, side: points along the axis and along a guide's width, moving with the first body (-1: none); a rectangular pad's width, along which side
// lies then, moves with the second. Where there is clearance the first
// body carries the sleeve, and second_tip moves with the journal; room: where the first body has the middle of the play, where that is not
// its own point all the time (-1: it is).
struct ViewJoint {
  std::string name = {};
  int first = 0, second = 0;
  int tip = -1, second_tip = -1, side = -1, room = -1;
  std::optional<ViewClearance> clearance = {};
};

// Where a body points.
struct ViewRay {
  std::string name = {};
  int from = 0, to = 0;
};

// The mechanism in motion, its deviation exaggerated by the reader. All lengths in one unit.
struct View {
  std::string title = {};
  std::string caption = {};
  std::string unit = {};  // of all lengths
  Numbers time = {};      // [s]
  std::vector<ViewPoint> points = {};
  std::vector<ViewBody> bodies = {};
  std::vector<ViewJoint> joints = {};
  std::vector<ViewRay> rays = {};
};

using Item = std::variant<Text, Table, Findings, Chart, Panels, Strip, View>;

struct Section {
  std::string id = {};  // small letters, digits, '-'; what a link to it ends with
  std::string title = {};
  std::string intro = {};
  std::vector<Item> items = {};
};

struct Fact {
  std::string label = {};
  nlohmann::json value = {};  // text, or a number shown with four significant digits
  std::string unit = {};
  std::string note = {};
};

enum class Standing { good, bad, neutral };
const char* to_string(Standing standing);

struct Verdict {
  Standing status = Standing::neutral;
  std::string text = {};
};

struct Provenance {
  std::string label = {};
  nlohmann::json value = {};
};

struct Document {
  std::string title = {};
  std::string subtitle = {};
  std::string verb = {};
  std::optional<Verdict> verdict = {};
  std::vector<Fact> facts = {};
  std::vector<std::string> warnings = {};
  std::vector<Section> sections = {};
  std::vector<Provenance> provenance = {};
};

void to_json(nlohmann::json& json, const Axis& axis);
void to_json(nlohmann::json& json, const Series& series);
void to_json(nlohmann::json& json, const Circle& circle);
void to_json(nlohmann::json& json, const Line& line);
void to_json(nlohmann::json& json, const Heatmap& heatmap);
void to_json(nlohmann::json& json, const Chart& chart);
void to_json(nlohmann::json& json, const Panels& panels);
void to_json(nlohmann::json& json, const Column& column);
void to_json(nlohmann::json& json, const Table& table);
void to_json(nlohmann::json& json, const Text& text);
void to_json(nlohmann::json& json, const Finding& finding);
void to_json(nlohmann::json& json, const Findings& findings);
void to_json(nlohmann::json& json, const State& state);
void to_json(nlohmann::json& json, const StripRow& row);
void to_json(nlohmann::json& json, const Strip& strip);
void to_json(nlohmann::json& json, const ViewPoint& point);
void to_json(nlohmann::json& json, const ViewBody& body);
void to_json(nlohmann::json& json, const ViewJoint& joint);
void to_json(nlohmann::json& json, const ViewRay& ray);
void to_json(nlohmann::json& json, const View& view);
void to_json(nlohmann::json& json, const Section& section);
void to_json(nlohmann::json& json, const Fact& fact);
void to_json(nlohmann::json& json, const Verdict& verdict);
void to_json(nlohmann::json& json, const Provenance& provenance);
void to_json(nlohmann::json& json, const Document& document);

// Height [pixels] of a chart with so many lying bars, `each` so high; as high as a chart may be where they are many.
int height_of_bars(std::size_t bars, int each);

// At most about `most` points that draw the same curve: the first, last, least and greatest point of each
// stretch, so that no spike (an impact) is lost. x must not decrease. Gaps (NaN) end stretches and stay.
std::pair<Numbers, Numbers> thinned(const Numbers& x, const Numbers& y, std::size_t most = 4000);

}  // namespace boresight::report
