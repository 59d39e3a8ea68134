#include "report/contract.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "report/place.hpp"

namespace boresight::report {
namespace {

using namespace checks;

void axis(const Place& place) {
  object(place, {"label"}, {"unit", "log", "range"});
  text(place.at("label"), false);
  text_where_given(place, {"unit"});
  flag_where_given(place, {"log"});
  if (!place.has("range")) return;
  const Place range = place.at("range");
  if (!range.value.is_array() || range.value.size() != 2) range.fail(range.found(), "two numbers, [from, to]");
  finite(range.at(std::size_t{0}));
  finite(range.at(std::size_t{1}));
  if (range.value[0].get<double>() >= range.value[1].get<double>()) range.fail(range.value.dump(), "from < to");
  if (place.value.value("log", false) && range.value[0].get<double>() <= 0.0) {
    range.fail(range.value.dump(), "positive ends, as the axis is logarithmic");
  }
}

void series(const Place& place) {
  object(place, {"name", "x"},
         {"y", "y_low", "style", "muted", "hidden", "color", "error_low", "error_high", "text", "bins"});
  text(place.at("name"), false);
  if (place.has("style")) {
    one_of(place.at("style"),
           {"line", "dash", "markers", "line+markers", "dash+markers", "steps", "bars", "area", "histogram", "box"});
  }
  flag_where_given(place, {"muted", "hidden"});
  const std::string style = place.value.value("style", "line");
  const bool counts = style == "histogram";
  numbers_or_names(place.at("x"));
  if (counts && place.has("y")) place.at("y").fail("a key", "no y: a histogram counts the values of x");
  if (!counts && !place.has("y")) place.fail("no key 'y'", "y, as the style is " + style);
  const std::size_t length = place.at("x").value.size();
  for (const char* key : {"y", "y_low", "error_low", "error_high"}) {
    if (!place.has(key)) continue;
    same_length(place.at(key), length, "x");
    if (std::string_view(key) == "y")
      numbers_or_names(place.at(key));
    else
      numbers(place.at(key));
  }
  for (const char* key : {"error_low", "error_high"}) {
    if (!place.has(key)) continue;
    const Place errors = place.at(key);
    for (std::size_t i = 0; i < length; ++i) {
      if (errors.value[i].is_number() && errors.value[i].get<double>() < 0.0) {
        errors.at(i).fail(errors.at(i).found(), "the distance from y to its bound, not negative");
      }
    }
  }
  if (place.has("y_low") && style != "area" && style != "bars")
    place.at("y_low").fail("a key", "style area or bars, where a lower edge has a meaning");
  if (place.has("text")) {
    same_length(place.at("text"), length, "x");
    texts(place.at("text"));
  }
  if (place.has("color")) finite(place.at("color"), 1, 8);
  if (place.has("bins")) finite(place.at("bins"), 1, 1000);
}

void circle(const Place& place) {
  object(place, {"x", "y", "r"}, {"label"});
  finite(place.at("x"));
  finite(place.at("y"));
  finite(place.at("r"), 0);
  text_where_given(place, {"label"});
}

void line(const Place& place) {
  object(place, {"axis", "value"}, {"label"});
  one_of(place.at("axis"), {"x", "y"});
  finite(place.at("value"));
  text_where_given(place, {"label"});
}

void heatmap(const Place& place) {
  object(place, {"x", "y", "z", "label"}, {"unit", "log", "contours", "diverging"});
  numbers_or_names(place.at("x"));
  numbers_or_names(place.at("y"));
  text(place.at("label"), false);
  text_where_given(place, {"unit"});
  flag_where_given(place, {"log", "diverging"});
  const Place z = place.at("z");
  same_length(z, place.at("y").value.size(), "y (one row per y)");
  for (std::size_t i = 0; i < z.value.size(); ++i) {
    same_length(z.at(i), place.at("x").value.size(), "x (one number per x)");
    numbers(z.at(i));
  }
  if (place.has("contours")) {
    numbers(place.at("contours"));
    for (std::size_t i = 0; i < place.at("contours").value.size(); ++i) finite(place.at("contours").at(i));
  }
}

void chart(const Place& place) {
  object(place, {"kind", "title", "x", "y"},
         {"caption", "equal_axes", "height", "series", "circles", "lines", "heatmap"});
  text(place.at("title"), false);
  text_where_given(place, {"caption"});
  flag_where_given(place, {"equal_axes"});
  axis(place.at("x"));
  axis(place.at("y"));
  if (place.has("height")) finite(place.at("height"), 120, 2000);
  each(place, "series", series);
  each(place, "circles", circle);
  each(place, "lines", line);
  if (place.has("heatmap")) heatmap(place.at("heatmap"));
  const auto given = [&](const char* key) { return place.has(key) && !place.value.at(key).empty(); };
  if (!given("series") && !given("heatmap") && !given("circles") && !given("lines")) {
    place.fail("a chart with nothing to draw", "series, heatmap, circles or lines");
  }
  for (const char* key : {"x", "y"}) {
    if (!place.has("lines") || !place.at(key).value.value("log", false)) continue;
    const Place lines = place.at("lines");
    for (std::size_t i = 0; i < lines.value.size(); ++i) {
      if (lines.value[i]["axis"] == key && lines.value[i]["value"].get<double>() <= 0.0) {
        lines.at(i).fail(lines.value[i]["value"].dump(), "a positive value, as the axis is logarithmic");
      }
    }
  }
}

void panels(const Place& place) {
  object(place, {"kind", "title", "panels"}, {"caption", "columns", "legend"});
  text(place.at("title"), false);
  text_where_given(place, {"caption"});
  if (place.has("columns")) finite(place.at("columns"), 1, 6);
  if (place.has("legend")) one_of(place.at("legend"), {"shared", "none"});
  if (place.at("panels").value.empty()) place.at("panels").fail("no panel", "at least one chart");
  each(place, "panels", [](const Place& panel) {
    if (!panel.value.is_object() || panel.value.value("kind", json()) != "chart")
      panel.fail(panel.found(), "an item of kind chart");
    chart(panel);
  });
}

void table(const Place& place) {
  object(place, {"kind", "title", "columns", "rows"}, {"caption"});
  text(place.at("title"), false);
  text_where_given(place, {"caption"});
  each(place, "columns", [](const Place& column) {
    object(column, {"label"}, {"unit", "align"});
    text(column.at("label"), false);
    text_where_given(column, {"unit"});
    if (column.has("align")) one_of(column.at("align"), {"left", "right", "center"});
  });
  const Place rows = place.at("rows");
  array(rows);
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    same_length(rows.at(i), place.at("columns").value.size(), "columns");
    for (std::size_t k = 0; k < rows.value[i].size(); ++k) {
      if (rows.value[i][k].is_structured())
        rows.at(i).at(k).fail(rows.at(i).at(k).found(), "text, a number, true, false or null");
    }
  }
}

void findings(const Place& place) {
  object(place, {"kind", "items"}, {"title", "caption"});
  text_where_given(place, {"title", "caption"});
  each(place, "items", [](const Place& finding) {
    object(finding, {"claim", "status", "measured"}, {"why"});
    text(finding.at("claim"), false);
    one_of(finding.at("status"), {"agrees", "differs", "explained"});
    text(finding.at("measured"));
    text_where_given(finding, {"why"});
  });
}

void strip(const Place& place) {
  object(place, {"kind", "title", "x", "rows", "states"}, {"caption"});
  text(place.at("title"), false);
  text_where_given(place, {"caption"});
  axis(place.at("x"));
  each(place, "states", [](const Place& state) {
    object(state, {"name"}, {"label", "muted"});
    text(state.at("name"), false);
    text_where_given(state, {"label"});
    flag_where_given(state, {"muted"});
  });
  std::set<std::string> known;
  std::string names;
  for (const json& state : place.at("states").value) {
    names += (names.empty() ? "" : ", ") + state["name"].get<std::string>();
    if (!known.insert(state["name"]).second)
      place.at("states").fail("'" + state["name"].get<std::string>() + "' twice", "each state once");
  }
  const Place rows = place.at("rows");
  array(rows);
  for (std::size_t i = 0; i < rows.value.size(); ++i) {
    const Place row = rows.at(i);
    object(row, {"name", "start", "end", "state"}, {});
    text(row.at("name"), false);
    numbers(row.at("start"));
    same_length(row.at("end"), row.at("start").value.size(), "start");
    numbers(row.at("end"));
    same_length(row.at("state"), row.at("start").value.size(), "start");
    texts(row.at("state"));
    for (std::size_t k = 0; k < row.value["start"].size(); ++k) {
      finite(row.at("start").at(k));
      finite(row.at("end").at(k), row.value["start"][k].get<double>());
      if (!known.count(row.value["state"][k]))
        row.at("state").at(k).fail(row.at("state").at(k).found(), "one of " + names);
    }
  }
}

// An index of the view's points.
void point_index(const Place& place, std::size_t points) {
  if (!place.value.is_number_integer() || place.value.get<double>() < 0.0 ||
      place.value.get<double>() >= static_cast<double>(points))
    place.fail(place.found(), "the index of one of the " + std::to_string(points) + " points");
}

void view_point(const Place& place, std::size_t instants) {
  object(place, {"x", "y", "z"}, {"dx", "dy", "dz"});
  for (const char* key : {"x", "y", "z", "dx", "dy", "dz"}) {
    if (!place.has(key)) continue;
    const Place track = place.at(key);
    array(track);
    if (track.value.size() != 1) same_length(track, instants, "time, or one number for a point at rest");
    for (std::size_t i = 0; i < track.value.size(); ++i) finite(track.at(i));
  }
}

void view_joint(const Place& place, std::size_t points) {
  object(place, {"name", "first", "second"}, {"tip", "second_tip", "side", "room", "clearance"});
  text(place.at("name"), false);
  for (const char* key : {"first", "second", "tip", "second_tip", "side", "room"})
    if (place.has(key)) point_index(place.at(key), points);
  if (!place.has("clearance")) return;
  const Place play = place.at("clearance");
  object(play, {"radial", "axial"}, {"width", "height", "pad", "pad_width", "pad_length"});
  for (const char* key : {"radial", "axial", "width", "height", "pad", "pad_width", "pad_length"})
    if (play.has(key)) finite(play.at(key), 0);
  const auto needs = [&](const char* key, std::initializer_list<const char*> others) {
    if (play.has(key))
      for (const char* other : others)
        if (!place.has(other))
          play.at(key).fail(play.at(key).found(), std::string("the joint's ") + other + " beside it");
  };
  needs("width", {"tip", "side"});
  needs("pad", {"tip"});
  needs("pad_width", {"tip", "side"});
  if (play.has("width") != play.has("height")) play.fail("one of width and height", "both");
  if (play.has("pad_width") != play.has("pad_length")) play.fail("one of pad_width and pad_length", "both");
}

void view(const Place& place) {
  object(place, {"kind", "title", "unit", "time", "points", "bodies", "joints", "rays"}, {"caption"});
  text(place.at("title"), false);
  text_where_given(place, {"caption"});
  text(place.at("unit"), false);
  const Place time = place.at("time"), points = place.at("points");
  for (const char* key : {"time", "points", "bodies", "joints", "rays"}) array(place.at(key));
  if (time.value.empty()) time.fail("no instant", "at least one");
  for (std::size_t i = 0; i < time.value.size(); ++i)
    finite(time.at(i), i > 0 ? time.value[i - 1].get<double>() : -std::numeric_limits<double>::infinity());
  if (points.value.empty()) points.fail("no point", "at least one");
  for (std::size_t i = 0; i < points.value.size(); ++i) view_point(points.at(i), time.value.size());
  for (std::size_t i = 0; i < place.at("bodies").value.size(); ++i) {
    const Place body = place.at("bodies").at(i);
    object(body, {"name", "points"}, {"closed", "muted"});
    text(body.at("name"), false);
    flag_where_given(body, {"closed", "muted"});
    array(body.at("points"));
    for (std::size_t k = 0; k < body.at("points").value.size(); ++k)
      point_index(body.at("points").at(k), points.value.size());
  }
  for (std::size_t i = 0; i < place.at("joints").value.size(); ++i)
    view_joint(place.at("joints").at(i), points.value.size());
  for (std::size_t i = 0; i < place.at("rays").value.size(); ++i) {
    const Place ray = place.at("rays").at(i);
    object(ray, {"name", "from", "to"}, {});
    text(ray.at("name"), false);
    for (const char* key : {"from", "to"}) point_index(ray.at(key), points.value.size());
  }
}

void item(const Place& place) {
  if (!place.value.is_object() || !place.has("kind")) place.fail(place.found(), "an item with a kind");
  one_of(place.at("kind"), {"text", "table", "findings", "chart", "panels", "strip", "view"});
  const auto& kind = place.value["kind"].get_ref<const std::string&>();
  if (kind == "text") {
    object(place, {"kind", "text"}, {});
    text(place.at("text"));
  }
  if (kind == "table") table(place);
  if (kind == "findings") findings(place);
  if (kind == "chart") chart(place);
  if (kind == "panels") panels(place);
  if (kind == "strip") strip(place);
  if (kind == "view") view(place);
}

void fact(const Place& place) {
  object(place, {"label", "value"}, {"unit", "note"});
  text(place.at("label"), false);
  if (!place.at("value").value.is_primitive()) place.at("value").fail(place.at("value").found(), "text or a number");
  text_where_given(place, {"unit", "note"});
}

void provenance(const Place& place) {
  object(place, {"label", "value"}, {});
  text(place.at("label"), false);
  if (!place.at("value").value.is_primitive()) place.at("value").fail(place.at("value").found(), "text or a number");
}

void section(const Place& place) {
  object(place, {"id", "title", "items"}, {"intro"});
  text(place.at("id"), false);
  const auto& id = place.value["id"].get_ref<const std::string&>();
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
  if (id.find_first_not_of(allowed) != std::string::npos)
    place.at("id").fail("'" + id + "'", "small letters, digits and '-'");
  text(place.at("title"), false);
  text_where_given(place, {"intro"});
  each(place, "items", item);
}

}  // namespace

void check(const json& document) {
  const Place root{document, ""};
  object(root, {"title", "sections"}, {"subtitle", "verb", "verdict", "facts", "warnings", "provenance"});
  text(root.at("title"), false);
  text_where_given(root, {"subtitle", "verb"});
  if (root.has("verdict")) {
    object(root.at("verdict"), {"status", "text"}, {});
    one_of(root.at("verdict").at("status"), {"good", "bad", "neutral"});
    text(root.at("verdict").at("text"), false);
  }
  each(root, "facts", fact);
  if (root.has("warnings")) texts(root.at("warnings"));
  each(root, "sections", section);
  each(root, "provenance", provenance);
  std::set<std::string> ids;
  for (std::size_t i = 0; i < document["sections"].size(); ++i) {
    const auto& id = document["sections"][i]["id"].get_ref<const std::string&>();
    if (!ids.insert(id).second)
      root.at("sections").at(i).at("id").fail("'" + id + "' a second time", "an id of its own");
  }
}

}  // namespace boresight::report
