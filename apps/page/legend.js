// The legend: buttons that show and hide a series, in every plot that has it.
import { element, svg } from "./dom.js";
import { ground, hue, onTheme } from "./theme.js";

// How a series looks: the same answer for the legend and for the plot.
export function look(series, index, themeName) {
  const colors = ground(themeName);
  const color = series.muted ? colors.neutral : hue(series.color ? series.color - 1 : index, themeName);
  const dash = series.style?.startsWith("dash") ? "7px,4px" : series.muted ? "4px,3px" : index >= 8 ? "2px,3px" : "solid";
  return { color, dash, width: series.muted ? 1.2 : 1.8 };
}

// Names are Plotly's; paths draw the same in the legend, around (8, 7).
export const symbols = [
  { name: "circle", path: "M8 7m-3.6 0a3.6 3.6 0 107.2 0a3.6 3.6 0 10-7.2 0" },
  { name: "square", path: "M4.8 3.8h6.4v6.4H4.8z" },
  { name: "diamond", path: "M8 2.5L12.5 7 8 11.5 3.5 7z" },
  { name: "triangle-up", path: "M8 3l4.5 7.5h-9z" },
  { name: "cross", path: "M6.6 2.8h2.8v2.8h2.8v2.8H9.4v2.8H6.6V8.4H3.8V5.6h2.8z" },
  { name: "x", path: "M5 2.8l3 2.6 3-2.6 1.2 1.2L9.6 7l2.6 3-1.2 1.2-3-2.6-3 2.6-1.2-1.2L6.4 7 3.8 4z" },
  { name: "pentagon", path: "M8 2.7l4.1 3-1.6 4.8h-5L3.9 5.7z" },
  { name: "star", path: "M8.0 2.4L9.2 5.6L12.6 5.7L9.9 7.8L10.8 11.1L8.0 9.2L5.2 11.1L6.1 7.8L3.4 5.7L6.8 5.6z" },
];

function swatch(series, index) {
  const { color, dash, width } = look(series, index);
  const picture = svg("svg", { viewBox: "0 0 26 14", width: "26", height: "14", "aria-hidden": "true" });
  if (["bars", "area", "histogram", "box", "state"].includes(series.style)) {
    picture.append(svg("rect", { x: 5, y: 2, width: 16, height: 10, rx: 2, fill: series.style === "state" && series.muted ? ground().rest : color, "fill-opacity": series.style === "area" ? 0.35 : 0.9 }));
    return picture;
  }
  if (series.style !== "markers") {
    picture.append(svg("line", { x1: 1, y1: 7, x2: 25, y2: 7, stroke: color, "stroke-width": width + 0.4, "stroke-dasharray": dash === "solid" ? "none" : dash.replaceAll("px", "") }));
  }
  if (series.style.includes("markers")) {
    picture.append(svg("path", { d: symbols[index % symbols.length].path, fill: color, transform: "translate(5 0)" }));
  }
  return picture;
}

// entries: [{name, series, index, visible}]; changed(): called when an entry was switched.
export function legend(entries, changed, label = "Series") {
  const box = element("div", { class: "legend", role: "group", "aria-label": `${label}: press to show or hide` });
  const refresh = () => {
    entries.forEach((entry, i) => {
      const button = box.children[i];
      button.setAttribute("aria-pressed", String(entry.visible));
      button.firstChild.replaceWith(swatch(entry.series, entry.index));
    });
  };
  for (const entry of entries) {
    box.append(element("button", {
      type: "button", class: "key", title: "Press to show or hide; double-click to show alone",
      onclick: () => { entry.visible = !entry.visible; refresh(); changed(); },
      ondblclick: () => {
        const alone = entries.every((other) => other === entry || !other.visible);
        for (const other of entries) other.visible = alone || other === entry;
        refresh(); changed();
      },
    }, swatch(entry.series, entry.index), element("span", {}, entry.name)));
  }
  refresh();
  onTheme(refresh);
  return box;
}

// One entry per distinct name, in order of appearance; muted series take no colour.
export function entriesOf(listOfSeries) {
  const entries = [];
  let colors = 0;
  for (const series of listOfSeries) {
    if (entries.some((entry) => entry.name === series.name)) continue;
    entries.push({ name: series.name, series: { style: "line", ...series }, index: series.muted ? 0 : colors++, visible: !series.hidden });
  }
  return entries;
}
