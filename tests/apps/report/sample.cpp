#include "sample.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace boresight::report::sample {
namespace {

constexpr double pi = std::numbers::pi;

Numbers range(double from, double to, int count) {
  Numbers values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

template <typename F>
Numbers over(const Numbers& x, F f) {
  Numbers values;
  for (const double one : x) values.push_back(f(one));
  return values;
}

std::string numbered(const char* name, int i) { return std::string(name).append(std::to_string(i)); }

// An error that looks like clearance: a slow drift, with decaying rattles after impacts.
Numbers rattle(const Numbers& t, double size, double phase) {
  return over(t, [=](double s) {
    const double since = std::fmod(s + phase, 0.13);
    return size * (0.6 + 0.4 * std::sin(2 * pi * s + phase)) +
           0.4 * size * std::exp(-since / 0.02) * std::abs(std::sin(420 * since));
  });
}

Section charts() {
  const Numbers t = range(0, 1, 2000);
  Chart error{.title = "Position error of the platform",
              .caption = "Statistics use every accepted step; the curve keeps the extremes of each millisecond.",
              .x = {"Time", "s"},
              .y = {"Position error", "mm"}};
  error.series = {
      {.name = "multibody", .x = t, .y = rattle(t, 0.18, 0.0)},
      {.name = "quasistatic", .x = t, .y = over(t, [](double s) { return 0.11 + 0.06 * std::sin(2 * pi * s); })},
      {.name = "ideal", .x = t, .y = over(t, [](double) { return 0.0; }), .muted = true},
      {.name = "envelope",
       .x = t,
       .y = over(t, [](double s) { return 0.27 + 0.02 * std::sin(4 * pi * s); }),
       .style = Style::area,
       .y_low = over(t, [](double s) { return 0.02 - 0.01 * std::sin(4 * pi * s); })}};
  error.series[1].y = [&] {  // a gap, where the quasistatic rung had no answer
    Numbers y = std::get<Numbers>(error.series[1].y);
    for (int i = 900; i < 1000; ++i) y[i] = NAN;
    return y;
  }();
  error.lines = {{'y', 0.35, "requirement 0.35 mm"}, {'x', 0.62, "singularity nearby"}};

  Chart orbit{.title = "Journal in its sleeve, F1",
              .caption = "Centre of the journal against the clearance circle.",
              .x = {"Offset along x", "µm"},
              .y = {"Offset along z", "µm"},
              .equal_axes = true};
  const Numbers a = range(0, 60, 900);
  orbit.series = {
      {.name = "journal centre",
       .x = over(a, [](double s) { return 100.5 * std::cos(s) * (1 - 0.35 * std::exp(-std::fmod(s, 7.0))); }),
       .y = over(a, [](double s) { return 100.5 * std::sin(s) * (1 - 0.35 * std::exp(-std::fmod(s, 7.0))); })}};
  orbit.circles = {{0, 0, 100, "clearance circle, 100 µm"}};

  Chart work{.title = "Accuracy against work",
             .caption = "Each point is one tolerance; both axes are logarithmic.",
             .x = {"Processor time per simulated second", "s", true},
             .y = {"Largest position error against the reference", "mm", true}};
  int k = 0;
  for (const char* name : {"Dormand–Prince 5(4)", "RADAU IIA 5", "generalised-α", "Adams PECE"}) {
    const double speed = 1.0 + 0.8 * k++;
    const Numbers cost = over(range(-1, 1.5, 6), [&](double p) { return speed * std::pow(10, p); });
    work.series.push_back({.name = name,
                           .x = cost,
                           .y = over(cost, [&](double c) { return 1e-2 * std::pow(c, -speed); }),
                           .style = Style::line_markers,
                           .text = {"1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"}});
  }
  return {.id = "charts",
          .title = "Error along the motion",
          .intro =
              "The platform follows its spiral in one second. Three of its joints have a clearance of 0.1 mm.\n\n"
              "What the rungs agree on is statics; what they differ in is impact.",
          .items = {error, orbit, work}};
}

Section multiples() {
  Panels panels{.title = "Journal orbits and offsets at six clearances",
                .caption = "Zooming one panel along time zooms its neighbours.",
                .columns = 3};
  const Numbers t = range(0, 1, 400);
  for (int i = 1; i <= 6; ++i) {
    Chart chart{.title = numbered("Clearance ", 20 * i).append(" µm"), .x = {"Time", "s"}, .y = {"Offset", "µm"}};
    chart.series = {{.name = "F1", .x = t, .y = rattle(t, 20.0 * i, 0.03 * i)},
                    {.name = "F2", .x = t, .y = rattle(t, 17.0 * i, 0.3 + 0.02 * i)},
                    {.name = "ideal", .x = t, .y = over(t, [](double) { return 0.0; }), .muted = true}};
    panels.panels.push_back(chart);
  }
  Panels orbits{.title = "Journal centres in their sleeves", .columns = 3};
  for (const char* joint : {"F1", "F2", "F3"}) {
    Chart chart{.title = joint, .x = {"Offset along x", "µm"}, .y = {"Offset along z", "µm"}, .equal_axes = true};
    const Numbers a = range(0, 40, 500);
    chart.series = {{.name = "journal centre",
                     .x = over(a, [](double s) { return 60 * std::cos(s) + 40 * std::cos(3.1 * s); }),
                     .y = over(a, [](double s) { return 60 * std::sin(s) + 40 * std::sin(2.9 * s); })}};
    chart.circles = {{0, 0, 100}};
    orbits.panels.push_back(chart);
  }
  Strip strip{.title = "Contact states",
              .caption = "The edge of a bar is never thinner than a line, so that short impacts stay visible.",
              .x = {"Time", "s"},
              .states = {{"free", "free flight", true},
                         {"radial", "radial contact"},
                         {"axial", "axial contact"},
                         {"both", "radial and axial"}}};
  std::mt19937 random(4);
  for (const char* joint : {"F1", "F2", "F3"}) {
    StripRow row{.name = joint};
    double at = 0;
    while (at < 1) {
      const double length = 0.002 + 0.04 * (random() % 1000) / 1000.0;
      row.start.push_back(at);
      row.end.push_back(std::min(1.0, at + length));
      row.state.push_back(strip.states[random() % 4].name);
      at += length;
    }
    strip.rows.push_back(row);
  }
  return {.id = "joints", .title = "What the joints do", .items = {panels, orbits, strip}};
}

Section maps() {
  const Numbers clearance = range(0.02, 0.2, 25),
                speed = over(range(-1, 2, 30), [](double p) { return std::pow(10, p); });
  Heatmap map{
      .x = clearance, .y = speed, .label = "Largest position error", .unit = "mm", .log = true, .contours = {0.1, 1}};
  for (const double v : speed)
    map.z.push_back(over(clearance, [&](double c) { return c * (1 + 3 * v / (1 + 40 * c)); }));
  map.z[3][4] = NAN;
  Chart error_map{.title = "Error over clearance and speed",
                  .caption = "The one empty cell failed to converge.",
                  .x = {"Radial clearance", "mm"},
                  .y = {"Speed of the drives", "rad/s", true},
                  .heatmap = map};
  const Names parameters{"clearance.F1.radial", "clearance.F2.radial", "contact.restitution", "friction.coefficient"};
  Chart correlation{.title = "Correlation of the estimates",
                    .x = {"Parameter"},
                    .y = {"Parameter"},
                    .heatmap = Heatmap{.x = parameters,
                                       .y = parameters,
                                       .z = {{1, .3, -.6, .1}, {.3, 1, -.2, 0}, {-.6, -.2, 1, .7}, {.1, 0, .7, 1}},
                                       .label = "Correlation",
                                       .diverging = true}};
  Chart sobol{.title = "Which scatter matters",
              .caption = "Bars: Sobol' indices; whiskers: 95 % intervals.",
              .x = {"Share of the variance"},
              .y = {"Parameter"}};
  sobol.series = {{.name = "first order",
                   .x = Numbers{0.52, 0.21, 0.08, 0.02},
                   .y = parameters,
                   .style = Style::bars,
                   .error_low = {0.03, 0.02, 0.02, 0.01},
                   .error_high = {0.03, 0.03, 0.02, 0.02}},
                  {.name = "total",
                   .x = Numbers{0.6, 0.27, 0.12, 0.03},
                   .y = parameters,
                   .style = Style::bars,
                   .error_low = {0.03, 0.02, 0.02, 0.01},
                   .error_high = {0.03, 0.03, 0.02, 0.02}}};
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.2, 0.03);
  Numbers samples, joint_values;
  Names joints;
  for (int i = 0; i < 3000; ++i) samples.push_back(normal(random));
  for (int i = 0; i < 300; ++i)
    joints.push_back(numbered("F", 1 + i % 3)), joint_values.push_back(normal(random) * (1 + i % 3));
  Chart distribution{.title = "Distribution of the index", .x = {"Largest position error", "mm"}, .y = {"Samples"}};
  distribution.series = {{.name = "3000 samples", .x = samples, .style = Style::histogram, .bins = 40}};
  distribution.lines = {{'x', 0.25, "requirement 0.25 mm"}, {'x', 0.262, "p97.5"}};
  Chart boxes{.title = "Penetration by joint", .x = {"Joint"}, .y = {"Greatest penetration", "µm"}};
  boxes.series = {{.name = "3 joints", .x = joints, .y = joint_values, .style = Style::box}};
  Chart steps{.title = "Step size of the integrator", .x = {"Time", "s"}, .y = {"Step", "s", true}, .height = 260};
  const Numbers t = range(0, 1, 120);
  steps.series = {{.name = "RADAU IIA 5",
                   .x = t,
                   .y = over(t, [](double s) { return std::pow(10, -4.5 + 1.5 * std::sin(20 * s)); }),
                   .style = Style::steps},
                  {.name = "largest stable step",
                   .x = t,
                   .y = over(t, [](double) { return 4e-4; }),
                   .style = Style::dash,
                   .hidden = true}};
  Chart level{.title = "Error of what rests", .x = {"Time", "s"}, .y = {"Error", "µm"}, .height = 260};
  level.series = {
      {.name = "rounding apart", .x = t, .y = over(t, [](double s) { return 0.1 + 1e-15 * std::sin(20 * s); })}};
  return {.id = "maps",
          .title = "Maps and distributions",
          .items = {error_map, correlation, sobol, distribution, boxes, steps, level}};
}

Section words() {
  Table table{
      .title = "Contacts by joint",
      .caption = "Sort by pressing a heading.",
      .columns = {{"Joint"}, {"Impacts"}, {"Contact", "%"}, {"Penetration", "m"}, {"Force", "N"}, {"Above validity"}}};
  table.rows = {{"F1", 148, 81.23456, 1.2345678e-6, 512.3456, false},
                {"F2", 96, 77.1, 9.87e-7, 1420.5, false},
                {"F3", 12045, 3.0, nullptr, -0.0001234, true}};
  Table lengthy{.title = "Every sample", .columns = {{"Sample"}, {"Value", "mm"}, {"Status"}}};
  for (int i = 0; i < 80; ++i) lengthy.rows.push_back({i, 0.2 + 0.001 * i, i % 17 ? "done" : "failed"});
  Findings findings{.title = "Against the paper"};
  findings.items = {{"The error grows linearly with clearance", Agreement::agrees, "slope 1.02 ± 0.03",
                     "Table 3 of the paper gives 1.0."},
                    {"Payload lowers the error", Agreement::differs, "0.21 mm at 0 kg, 0.24 mm at 30 kg",
                     "Beyond 20 kg the platform falls out of contact."},
                    {"The error peaks at 0.25 s", Agreement::explained, "0.27 s", "The paper samples every 20 ms."}};
  return {.id = "tables",
          .title = "Tables and findings",
          .items = {Text{"A paragraph.\n\nAnother one."}, table, lengthy, findings}};
}

// A crank turns, a rod hangs on it with clearance, and carries a plate that points up.
View crank(const std::string& name) {
  View view{.title = name, .caption = "The journal goes round in its sleeve.", .unit = "mm", .time = range(0, 2, 41)};
  const auto point = [&](auto place, double off) {
    ViewPoint made;
    for (const double t : view.time) {
      const std::array<double, 3> p = place(t);
      made.x.push_back(p[0]), made.y.push_back(p[1]), made.z.push_back(p[2]);
      if (off == 0.0) continue;
      made.dx.push_back(off * std::cos(9 * t)), made.dy.push_back(0.0),
          made.dz.push_back(off * std::sin(9 * t) * (0.25 + 0.25 * t));
    }
    view.points.push_back(made);
  };
  const auto turning = [](double x, double y, double z) {
    return [=](double t) { return std::array<double, 3>{x + 80 * std::cos(pi * t), y, z + 80 * std::sin(pi * t)}; };
  };
  view.points.push_back({.x = {0}, .y = {0}, .z = {0}});
  view.points.push_back({.x = {300}, .y = {0}, .z = {0}});
  view.points.push_back({.x = {0}, .y = {20}, .z = {0}});  // along the ground's axis
  point(turning(0, 0, 0), 0.0);                            // 3: the crank's end
  point(turning(0, 20, 0), 0.0);
  point(turning(0, 0, 0), 0.1);  // 5: the journal
  point(turning(0, 20, 0), 0.1);
  point(turning(150, -40, 90), 0.1);  // 7 to 9: the plate
  point(turning(150, 40, 90), 0.1);
  point(turning(220, 0, 90), 0.1);
  point(turning(170, 0, 90), 0.1);
  point(turning(170, 0, 200), 0.2);  // 11: where it points
  view.bodies = {{.name = "ground", .points = {0, 1}, .muted = true},
                 {.name = "crank", .points = {0, 3}},
                 {.name = "rod", .points = {5, 7}},
                 {.name = "plate", .points = {7, 8, 9}, .closed = true}};
  view.joints = {
      {.name = "O", .first = 0, .second = 0, .tip = 2},
      {.name = name, .first = 3, .second = 5, .tip = 4, .second_tip = 6, .clearance = ViewClearance{0.1, 0.05}},
      {.name = "S", .first = 7, .second = 7}};
  view.rays = {{.name = "boresight", .from = 10, .to = 11}};
  return view;
}

Section moving() {
  View ideal = crank("Without clearance");
  for (ViewPoint& point : ideal.points) point.dx = point.dy = point.dz = {};
  ideal.joints.erase(ideal.joints.begin() + 1);
  ideal.time = {0};
  for (ViewPoint& point : ideal.points) point.x.resize(1), point.y.resize(1), point.z.resize(1);
  // A ball with play, which has no axis.
  View ball = crank("With a ball");
  ball.joints.erase(ball.joints.begin() + 1);
  ball.joints.back().clearance = ViewClearance{0.1, 0.0};
  // A slider whose guide is wider than high, and a pad.
  View flat = crank("With a slider and a pad");
  flat.joints[1].side = 0;
  flat.joints[1].clearance = ViewClearance{.width = 0.15, .height = 0.05};
  flat.joints.push_back(
      {.name = "pad", .first = 1, .second = 1, .tip = 2, .clearance = ViewClearance{.axial = 0.1, .pad = 40}});
  return {.id = "moving", .title = "The mechanism", .items = {crank("The mechanism in motion"), ideal, ball, flat}};
}

}  // namespace

Document every_kind() {
  return {
      .title = "3-RRCPR parallel pointing mechanism",
      .subtitle = "One motion of one second, clearance 0.1 mm at F1, F2 and F3",
      .verb = "run",
      .verdict = Verdict{Standing::bad, "The requirement is not met: largest position error 0.412 mm, limit 0.35 mm"},
      .facts = {{"Largest position error", 0.41234567, "mm", "at t = 0.262 s, rung multibody"},
                {"Boresight error, rms", 0.3121, "mrad"},
                {"Impacts", 12289, "", "3 joints"},
                {"Rung", "multibody", "", "chosen: the envelope is 34 % away from it"},
                {"Constraint drift", 3.2e-11, "m"}},
      .warnings = {"2 impacts at F3 were faster than the contact law's validity (0.62 m/s against 0.48 m/s)",
                   "The motion passes 1.3° from a singularity at t = 0.62 s"},
      .sections = {charts(), multiples(), maps(), words(), moving()},
      .provenance = {{"Version", "0.1.0"},
                     {"Mechanism", "3-rrcpr.toml, sha256 91d0c2f7b8a8e4d3f6e5"},
                     {"Seed", 1},
                     {"Processor time", "12.3 s"},
                     {"Threads", 8}}};
}

Document hostile() {
  const std::string text =
      "</script><script>document.title='broken'</script> \"quoted\" 'single' <b>bold</b> & <!-- %{x} µ 日本 "
      "\xE2\x80\xA8 $x$";
  Chart chart{.title = text, .caption = text, .x = {text, text}, .y = {text, "<i>"}};
  chart.series = {{.name = text, .x = {Numbers{1, 2, 3}}, .y = Numbers{1, NAN, INFINITY}, .text = {text, text, text}}};
  chart.lines = {{'y', 0.5, text}};
  Table table{.title = text, .columns = {{text, text}}, .rows = {{text}, {"=1+1"}}};
  Findings findings{.title = text, .items = {{text, Agreement::differs, text, text}}};
  Strip strip{.title = text, .x = {"Time", "s"}, .states = {{text}}, .rows = {{text, {0}, {1}, {text}}}};
  return {.title = text,
          .subtitle = text,
          .verb = text,
          .verdict = Verdict{Standing::neutral, text},
          .facts = {{text, text, text, text}},
          .warnings = {text},
          .sections = {{.id = "hostile",
                        .title = text,
                        .intro = text,
                        .items = {Text{text}, chart, table, findings, strip, crank(text)}}},
          .provenance = {{text, text}}};
}

Document many_charts(int charts, int points) {
  Document document{.title = "Many charts"};
  const Numbers t = range(0, 1, points);
  for (int i = 0; i < charts; ++i) {
    Chart chart{.title = numbered("Chart ", i + 1), .x = {"Time", "s"}, .y = {"Error", "mm"}};
    for (int k = 0; k < 3; ++k)
      chart.series.push_back({.name = numbered("rung ", k + 1), .x = t, .y = rattle(t, 0.1 * (k + 1), 0.01 * i)});
    if (i % 10 == 0)
      document.sections.push_back({.id = numbered("part-", i / 10), .title = numbered("Part ", i / 10 + 1)});
    document.sections.back().items.push_back(chart);
  }
  return document;
}

}  // namespace boresight::report::sample
