// A chart of the contract as Plotly's data and layout. Pure: no element is touched here.
import { look, symbols } from "./legend.js";
import { number, withUnit } from "./numbers.js";
import { ground, hue, theme } from "./theme.js";

const font = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", sans-serif';

// Plotly reads a little markup in texts; ours are plain.
export function plain(text) {
  return String(text ?? "").replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll("%{", "%\u200b{");
}

export function wrapped(text, width) {
  const most = Math.max(12, Math.floor(width / 6.6));
  const lines = [""];
  const words = String(text).split(" ").flatMap((word) => word.match(new RegExp(`.{1,${most}}`, "gsu")) ?? [""]);
  for (const word of words) {
    const line = lines[lines.length - 1];
    if (line && line.length + word.length + 1 > most) lines.push(word);
    else lines[lines.length - 1] = line ? `${line} ${word}` : word;
  }
  return lines.map(plain);
}

export function shortened(text, most) {
  return text.length > most ? `${text.slice(0, most - 1)}\u2026` : text;
}

function translucent(color, opacity) {
  const part = (from) => parseInt(color.slice(from, from + 2), 16);
  return `rgba(${part(1)},${part(3)},${part(5)},${opacity})`;
}

const isNames = (list) => list.length > 0 && typeof list[0] === "string";

export function categories(chart) {
  const along = (axis) => (chart.series ?? []).some((series) => isNames(series[axis] ?? [])) || isNames(chart.heatmap?.[axis] ?? []);
  return { x: along("x"), y: along("y") };
}

function seriesTraces(chart, series, entry, themeName) {
  const { color, dash, width } = look(entry.series, entry.index, themeName);
  const style = series.style ?? "line";
  const yUnit = chart.y.unit ? ` ${plain(chart.y.unit)}` : "";
  const xUnit = chart.x.unit ? ` ${plain(chart.x.unit)}` : "";
  const common = {
    name: plain(series.name), x: series.x, y: series.y, showlegend: false, visible: entry.visible, meta: series.name,
    hovertemplate: `%{x:.5~g}${xUnit}, %{y:.4~g}${yUnit}<extra>${plain(series.name)}</extra>`,
  };
  if (isNames(series.x)) common.hovertemplate = `%{x}: %{y:.4~g}${yUnit}<extra>${plain(series.name)}</extra>`;
  if (series.y && isNames(series.y)) common.hovertemplate = `%{y}: %{x:.4~g}${xUnit}<extra>${plain(series.name)}</extra>`;
  if (series.text) {
    common.text = series.text.map(plain);
    common.hovertemplate = common.hovertemplate.replace("<extra>", "<br>%{text}<extra>");
  }
  const lying = style === "bars" && series.y && isNames(series.y);
  if (series.error_low || series.error_high) {
    const zero = () => series.x.map(() => 0);
    common[lying ? "error_x" : "error_y"] = {
      type: "data", symmetric: false, array: series.error_high ?? zero(), arrayminus: series.error_low ?? zero(),
      thickness: 1.4, width: 4, color: style === "bars" ? ground(themeName).ink : color,
    };
  }
  const line = { color, width, dash, simplify: series.x.length > 5000 }; // simplified curves show corners in pictures
  switch (style) {
    case "markers":
    case "line+markers":
    case "dash+markers":
      return [{ ...common, type: "scatter", mode: style === "markers" ? "markers" : "lines+markers", line,
        marker: { color, size: series.x.length > 300 ? 4 : 7, symbol: symbols[entry.index % symbols.length].name, opacity: series.x.length > 300 ? 0.55 : 0.95 } }];
    case "bars": {
      const bar = { ...common, type: "bar", orientation: lying ? "h" : "v", marker: { color } };
      if (!series.y_low) return [bar];
      const along = lying ? "x" : "y"; // steps of a waterfall: from y_low to the value
      return [{ ...bar, base: series.y_low, [along]: common[along].map((value, i) => value - series.y_low[i]) }];
    }
    case "histogram":
      return [{ ...common, type: "histogram", y: undefined, nbinsx: series.bins || undefined, marker: { color, opacity: 0.8, line: { color: ground(themeName).surface, width: 0.6 } },
        hovertemplate: `%{x}${xUnit}: %{y}<extra>${plain(series.name)}</extra>` }];
    case "box":
      return [{ ...common, type: "box", hovertemplate: undefined, hoveron: "boxes", boxpoints: "outliers", line: { color, width: 1.4 }, fillcolor: translucent(color, 0.2), marker: { color, size: 3 } }];
    case "area": {
      const upper = { ...common, type: "scatter", mode: "lines", line: { ...line, width: series.y_low ? 0.6 : width }, fillcolor: translucent(color, 0.22), fill: series.y_low ? "tonexty" : "tozeroy" };
      if (!series.y_low) return [upper];
      return [{ ...common, type: "scatter", mode: "lines", y: series.y_low, line: { ...line, width: 0.6 }, error_y: undefined, hovertemplate: common.hovertemplate.replace("<extra>", " (lower)<extra>") }, upper];
    }
    default:
      return [{ ...common, type: "scatter", mode: "lines", connectgaps: false, line: { ...line, shape: style === "steps" ? "hv" : "linear" } }];
  }
}

function heatmapTraces(map, themeName, narrow) {
  const logs = (value) => (value > 0 ? Math.log10(value) : null);
  const z = map.log ? map.z.map((row) => row.map(logs)) : map.z;
  const flat = z.flat().filter((value) => value !== null);
  const key = {
    least: flat.reduce((a, b) => Math.min(a, b), Infinity), most: flat.reduce((a, b) => Math.max(a, b), -Infinity),
    title: plain(shortened(withUnit(map.label, map.unit), 60)), colorscale: map.diverging ? [[0, "#0072B2"], [0.5, "#f4f4f2"], [1, "#D55E00"]] : "Viridis", ticks: {},
  };
  if (map.log && flat.length) {
    const { least, most } = key;
    const steps = most - least > 3 ? [1] : most - least > 1 ? [1, 3] : [1, 2, 3, 5, 7];
    const ticks = [];
    for (let power = Math.floor(least); power <= Math.ceil(most); ++power) {
      for (const step of steps) {
        const at = power + Math.log10(step);
        if (at >= least - 1e-9 && at <= most + 1e-9) ticks.push([at, number(step * 10 ** power)]);
      }
    }
    key.ticks = { tickvals: ticks.map(([at]) => at), ticktext: ticks.map(([, text]) => text) };
  }
  const colorbar = { thickness: 12, outlinewidth: 0, tickfont: { size: 11 }, exponentformat: "power", title: { text: key.title, side: "right", font: { size: 12 } }, len: 1, ypad: 0, ...key.ticks };
  const unit = map.unit ? ` ${plain(map.unit)}` : "";
  const traces = [{
    type: "heatmap", x: map.x, y: map.y, z, customdata: map.z, colorbar, showscale: !narrow, hoverongaps: false, meta: "\u0000heatmap", colorscale: key.colorscale,
    ...(map.diverging ? { zmid: 0 } : {}),
    hovertemplate: `%{x}, %{y}<br>${plain(map.label)}: %{customdata:.4~g}${unit}<extra></extra>`,
  }];
  for (const [i, level] of (map.contours ?? []).entries()) {
    traces.push({
      type: "contour", x: map.x, y: map.y, z, showscale: false, showlegend: false, hoverinfo: "skip", name: number(level), meta: "\u0000contour",
      contours: { type: "constraint", operation: "=", value: map.log ? logs(level) : level, coloring: "none", showlabels: false },
      line: { color: "#ffffff", width: 2.2, dash: contourDashes[i % 4] },
    });
  }
  return { traces, key: flat.length ? key : null };
}

// Where a map is too narrow for a bar of its colours beside it: the bar above it, a map of one row. It is 14 pixels high, with 28 below for
// its numbers, and yTitle for the title of the map's own y axis.
function colorsAbove(layout, data, { least, most, title, colorscale, ticks }, diverging, yTitle, colors) {
  const [from, to] = diverging ? [-Math.max(-least, most), Math.max(-least, most)] : [least, most];
  if (!(to > from)) return;
  const inner = layout.height - layout.margin.t - layout.margin.b;
  const steps = Array.from({ length: 64 }, (_, i) => from + (to - from) * (i + 0.5) / 64);
  data.push({ type: "heatmap", xaxis: "x2", yaxis: "y2", x: steps, y: [0], z: [steps], zmin: from, zmax: to, colorscale, showscale: false, hoverinfo: "skip", meta: "\u0000key" });
  layout.yaxis.domain = [0, 1 - (14 + 28 + yTitle) / inner];
  layout.xaxis2 = { anchor: "y2", range: [from, to], fixedrange: true, showgrid: false, zeroline: false, ticks: "", tickfont: { size: 11, color: colors.soft }, exponentformat: "power", nticks: 6, ...ticks };
  layout.yaxis2 = { anchor: "x2", domain: [1 - 14 / inner, 1], fixedrange: true, visible: false };
  layout.annotations.push({ xref: "x2 domain", yref: "y2 domain", x: 0, y: 1, xanchor: "left", yanchor: "bottom", xshift: -6, yshift: 3, align: "left", showarrow: false, text: title, font: { size: 12, color: colors.soft } });
}
export const contourDashes = ["solid", "dash", "dot", "dashdot"];

function extent(chart, axis) {
  let least = Infinity, most = -Infinity;
  const take = (value) => { if (typeof value === "number") { least = Math.min(least, value); most = Math.max(most, value); } };
  for (const series of chart.series ?? []) for (const value of series[axis] ?? []) take(value);
  for (const circle of chart.circles ?? []) { take(circle[axis] - circle.r); take(circle[axis] + circle.r); }
  for (const line of chart.lines ?? []) if (line.axis === axis) take(line.value);
  return [least, most];
}

// Lines and circles, with points that nobody sees so that the axes reach them.
function marks(chart, colors, names, width) {
  const shapes = [], annotations = [], reach = { x: [], y: [] };
  const box = (chart.series ?? []).find((series) => series.x.length);
  const middle = { x: box ? box.x[0] : 0, y: box?.y?.length ? box.y.find((value) => value !== null) ?? 0 : 0 };
  const most = Math.max(10, Math.floor(width / 11));
  let uprights = false;
  for (const axis of ["x", "y"]) {
    const [least, greatest] = extent(chart, axis);
    const given = (chart.lines ?? []).filter((one) => one.axis === axis).sort((a, b) => a.value - b.value);
    const scale = (value) => (chart[axis].log && value > 0 ? Math.log10(value) : value);
    const share = (value) => (scale(value) - scale(least)) / (scale(greatest) - scale(least) || 1);
    let side = 0;
    for (const [i, line] of given.entries()) {
      const close = (other) => other && Math.abs(share(other.value) - share(line.value)) < 0.12;
      side = close(given[i - 1]) ? 1 - side : 0;
      const upright = axis === "x";
      shapes.push({ type: "line", layer: "above", xref: upright ? "x" : "x domain", yref: upright ? "y domain" : "y",
        x0: upright ? line.value : 0, x1: upright ? line.value : 1, y0: upright ? 0 : line.value, y1: upright ? 1 : line.value,
        line: { color: colors.ink, width: 1.3, dash: "6px,3px" } });
      reach.x.push(upright ? line.value : middle.x);
      reach.y.push(upright ? middle.y : line.value);
      if (!line.label) continue;
      const at = scale(line.value);
      const label = plain(shortened(line.label, most));
      // Labels of upright lines stand above the plot; of two neighbours one reaches left, one right.
      const anchor = close(given[i + 1]) && !side ? "right" : side ? "left" : share(line.value) < 0.2 ? "left" : share(line.value) > 0.8 ? "right" : "center";
      if (upright) uprights = true;
      annotations.push(upright
        ? { xref: "x", yref: "y domain", x: at, y: 1, xanchor: anchor, yanchor: "bottom", xshift: anchor === "right" ? 3 : anchor === "left" ? -3 : 0, yshift: 2, text: label }
        : { xref: "x domain", yref: "y", x: side ? 0.01 : 0.99, y: at, xanchor: side ? "left" : "right", yanchor: "bottom", yshift: 2, text: label });
    }
  }
  for (const circle of chart.circles ?? []) {
    shapes.push({ type: "circle", layer: "above", xref: "x", yref: "y", x0: circle.x - circle.r, x1: circle.x + circle.r, y0: circle.y - circle.r, y1: circle.y + circle.r,
      line: { color: colors.ink, width: 1.3, dash: "5px,3px" } });
    reach.x.push(circle.x - circle.r, circle.x + circle.r);
    reach.y.push(circle.y - circle.r, circle.y + circle.r);
    if (circle.label) annotations.push({ xref: "x", yref: "y", x: circle.x, y: circle.y + circle.r, xanchor: "center", yanchor: "bottom", text: plain(shortened(circle.label, most)) });
  }
  const style = { showarrow: false, font: { size: 11, color: colors.ink }, bgcolor: translucent(colors.surface, 0.82), borderpad: 1 };
  const traces = reach.x.length && !names ? [{ type: "scatter", mode: chart.circles?.length ? "markers" : "lines", x: reach.x, y: reach.y, line: { width: 0 }, marker: { size: 8 }, opacity: 0, hoverinfo: "skip", showlegend: false, meta: "\u0000reach" }] : [];
  return { shapes, annotations: annotations.map((one) => ({ ...one, ...style })), traces, uprights };
}

// The unit never stands alone on a line.
const joined = (axis) => (axis.unit ? `${axis.label}\u00a0(${axis.unit.replaceAll(" ", "\u00a0")})` : axis.label);

// Names along an axis, shortened to a room of so many pixels.
function named(chart, axis, room) {
  const names = [...new Set([...(chart.heatmap?.[axis] ?? []), ...(chart.series ?? []).flatMap((series) => series[axis] ?? [])])];
  return { categoryorder: "array", categoryarray: names, tickmode: "array", tickvals: names, ticktext: names.map((name) => plain(shortened(String(name), Math.max(8, Math.floor(room / 6.2))))) };
}

// What heads the values of several curves has no place for a unit but a currency's: $ in a number's format, and the currency of a locale.
const unitFormat = "$.5~g";
export const locale = (unit) => ({ locale: "unit", locales: { unit: { moduleType: "locale", name: "unit", format: { currency: ["", unit ? ` ${plain(unit)}` : ""] } } } });

// Decades alone would leave an axis that spans less than two of them without numbers.
function axisLayout(axis, colors, isCategory, title, values) {
  const layout = {
    title: title ? { text: title, standoff: 8, font: { size: 12, color: colors.soft } } : undefined,
    automargin: true, zeroline: false, showline: true, linecolor: colors.axis, linewidth: 1, gridcolor: colors.grid, gridwidth: 1,
    ticks: "outside", ticklen: 4, tickcolor: colors.axis, tickfont: { size: 11, color: colors.soft }, exponentformat: "power", minexponent: 4,
    type: isCategory ? "category" : axis.log ? "log" : "linear", hoverformat: ".5~g", separatethousands: true, spikethickness: 1, spikecolor: colors.axis, spikedash: "dot",
  };
  if (axis.log) {
    const positive = values.filter((value) => value > 0);
    const decades = positive.length ? Math.log10(values.reduce((a, b) => Math.max(a, b), 0) / positive.reduce((a, b) => Math.min(a, b), Infinity)) : 0;
    if (axis.range ? Math.log10(axis.range[1] / axis.range[0]) >= 2 : decades >= 2) layout.dtick = 1;
  }
  if (!axis.range) layout.autorange = true;
  else layout.range = axis.log ? axis.range.map(Math.log10) : axis.range;
  return layout;
}

// What differs by rounding alone is level: left to itself, the axis would stretch rounding over the whole chart, or reach from -1 to 1. Bars, boxes and
// areas have axes from zero on.
function levelRange(chart) {
  const rounding = 1e-9, margin = 0.05;
  const series = chart.series ?? [];
  const curves = series.every((one) => !["bars", "histogram", "box", "area"].includes(one.style) && !one.error_low && !one.error_high);
  if (!curves || chart.heatmap || chart.equal_axes || chart.y.log || chart.y.range || !series.some((one) => one.y?.length)) return chart.y.range;
  const [least, most] = extent(chart, "y");
  const size = Math.max(Math.abs(least), Math.abs(most));
  return size > 0 && Number.isFinite(size) && most - least <= rounding * size ? [least - margin * size, most + margin * size] : undefined;
}

// options: width, panel (small multiple), themeName, titled (for pictures: with title and legend)
export function figure(chart, entries, { width, panel = false, themeName = theme(), titled = false }) {
  const colors = ground(themeName);
  const names = categories(chart);
  const narrow = width < 520;
  const map = chart.heatmap;
  const { traces: data, key } = map ? heatmapTraces(map, themeName, narrow) : { traces: [], key: null };
  // Areas lie under the lines.
  const areasFirst = [...(chart.series ?? [])].sort((a, b) => (b.style === "area") - (a.style === "area"));
  for (const series of areasFirst) {
    data.push(...seriesTraces(chart, series, entries.find((entry) => entry.name === series.name), themeName));
  }
  const { shapes, annotations, traces, uprights } = marks(chart, colors, names.x || names.y, width);
  data.push(...traces);

  const yTitle = wrapped(joined(chart.y), width - 70);
  const xTitle = wrapped(joined(chart.x), width - 90);
  const above = uprights ? 17 : 0;
  const top = 12 + 16 * yTitle.length + above;
  annotations.push({ xref: "x domain", yref: "y domain", x: 0, y: 1, xanchor: "left", yanchor: "bottom", xshift: -6, yshift: 5 + above, align: "left", showarrow: false,
    text: yTitle.join("<br>"), font: { size: 12, color: colors.soft }, name: "y-title" });

  const types = new Set((chart.series ?? []).map((series) => series.style ?? "line"));
  const lying = names.y && types.has("bars");
  const lines = !map && !chart.equal_axes && !panel && [...types].every((type) => ["line", "dash", "steps", "area"].includes(type));
  let height = chart.height || (panel ? 250 : map ? 420 : lying ? 0 : 340);
  if (lying && !chart.height) height = top + 70 + Math.max(...chart.series.map((series) => series.y.length)) * (18 + 14 * chart.series.length);
  if (chart.equal_axes && !chart.height) height = Math.min(width, panel ? 420 : 520);
  if (narrow && !panel && !lying) height = Math.min(height, chart.equal_axes ? width : map ? 380 : 300);

  if (!chart.height) height += 15 * (xTitle.length - 1) + 16 * (yTitle.length - 1) + above;

  const all = (axis) => (chart.series ?? []).flatMap((series) => series[axis] ?? []).filter((value) => typeof value === "number");
  const values = (axis) => (chart[axis].log ? (all(axis).length ? all(axis) : (map?.[axis] ?? [])) : []);
  const layout = {
    width, height, autosize: false, margin: { l: 48, r: panel ? 14 : 20, t: top, b: 46 + 15 * (xTitle.length - 1), pad: 0 },
    paper_bgcolor: colors.surface, plot_bgcolor: colors.surface, font: { family: font, color: colors.ink, size: 12 },
    xaxis: { ...axisLayout(chart.x, colors, names.x, xTitle.join("<br>"), values("x")) },
    yaxis: { ...axisLayout({ ...chart.y, range: levelRange(chart) }, colors, names.y, "", values("y")), showspikes: false },
    shapes, annotations, showlegend: false, barmode: types.has("histogram") || (chart.series ?? []).some((series) => series.style === "bars" && series.y_low) ? "overlay" : "group", bargap: types.has("histogram") ? 0.02 : 0.3, boxmode: "group",
    hovermode: lines ? "x unified" : "closest", hoverdistance: 40,
    hoverlabel: { bgcolor: colors.surface, bordercolor: colors.axis, font: { color: colors.ink, size: 12, family: font }, namelength: -1 },
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    colorway: [hue(0, themeName)],
  };
  if (lines) for (const trace of data) if (trace.hovertemplate) trace.hovertemplate = trace.hovertemplate.replace(/^%\{x[^}]*\}[^,]*, /, "");
  if (lines) layout.xaxis.hoverformat = unitFormat;
  if (map) { layout.xaxis.showgrid = false; layout.yaxis.showgrid = false; layout.xaxis.constrain = "domain"; }
  if (names.y) Object.assign(layout.yaxis, { autorange: "reversed", showgrid: false, ticklen: 6, tickcolor: "rgba(0,0,0,0)" }, named(chart, "y", width * 0.42));
  if (names.x) {
    Object.assign(layout.xaxis, { showgrid: false, tickcolor: "rgba(0,0,0,0)" }, named(chart, "x", 190));
    const longest = Math.max(...layout.xaxis.ticktext.map((text) => text.length));
    if (longest * 6.4 > (width - 90) / layout.xaxis.ticktext.length) {
      layout.xaxis.tickangle = -90;
      layout.margin.b += Math.max(0, Math.round(6.2 * longest) - 22);
      layout.height += chart.height ? 0 : Math.max(0, Math.round(6.2 * longest) - 22);
    } else layout.xaxis.tickangle = 0;
  }
  if (key && narrow) {
    layout.height += chart.height ? 0 : 92 - top;
    layout.margin.t = 30;
    colorsAbove(layout, data, key, map.diverging, top, colors);
  }
  if (chart.equal_axes) {
    layout.yaxis.scaleanchor = "x";
    layout.xaxis.constrain = "domain";
    layout.yaxis.constrain = "domain";
  }
  const bars = (chart.series ?? []).filter((series) => ["bars", "histogram"].includes(series.style));
  if (bars.length && !chart.y.range && !chart.y.log && !names.y) layout.yaxis.rangemode = "tozero";
  if (titled) {
    layout.title = { text: plain(chart.title), font: { size: 17, color: colors.ink }, x: 0.02, xanchor: "left", y: 0.985, yanchor: "top" };
    layout.margin.t += panel ? 24 : 40;
    layout.showlegend = entries.length > 1 && !panel;
    layout.legend = { orientation: "h", y: -0.16, yanchor: "top", x: 0, font: { size: 12 }, traceorder: "normal" };
    const seen = new Set();
    for (const trace of [...data].reverse()) {
      trace.showlegend = !String(trace.meta).startsWith("\u0000") && trace.visible === true && !seen.has(trace.meta);
      if (trace.showlegend) seen.add(trace.meta);
    }
  }
  return { data, layout, unit: chart.x.unit };
}
