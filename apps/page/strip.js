// The state strip as bars along x, one row per joint.
import { plain, shortened, wrapped } from "./figure.js";
import { withUnit } from "./numbers.js";
import { ground, hue, theme } from "./theme.js";

export function stripFigure(item, entries, { width, themeName = theme(), titled = false }) {
  const colors = ground(themeName);
  const unit = item.x.unit ? ` ${plain(item.x.unit)}` : "";
  const data = item.states.map((state, k) => {
    const base = [], length = [], row = [], end = [];
    for (const one of item.rows) {
      one.state.forEach((name, i) => {
        if (name !== state.name) return;
        base.push(one.start[i]);
        length.push(one.end[i] - one.start[i]);
        end.push(one.end[i]);
        row.push(plain(one.name));
      });
    }
    const color = state.muted ? colors.rest : hue(entries[k].index, themeName);
    return {
      type: "bar", orientation: "h", base, x: length, y: row, customdata: end, width: 0.66, name: plain(entries[k].name), visible: entries[k].visible, showlegend: titled,
      marker: { color, line: { color, width: state.muted ? 0 : 0.8 } }, // the edge keeps a short impact visible
      hovertemplate: `%{y}: %{base:.6~g} to %{customdata:.6~g}${unit}<extra>${plain(entries[k].name)}</extra>`,
    };
  });
  const xTitle = wrapped(withUnit(item.x.label, item.x.unit), width - 90);
  const font = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", sans-serif';
  const layout = {
    width, height: 62 + 34 * item.rows.length + 15 * (xTitle.length - 1) + (titled ? 90 : 0), autosize: false, margin: { l: 40, r: 20, t: titled ? 50 : 8, b: (titled ? 90 : 46) + 15 * (xTitle.length - 1) }, barmode: "overlay",
    paper_bgcolor: colors.surface, plot_bgcolor: colors.surface, font: { family: font, size: 12, color: colors.ink },
    xaxis: { title: { text: xTitle.join("<br>"), standoff: 8, font: { size: 12, color: colors.soft } }, gridcolor: colors.grid, zeroline: false, showline: true, linecolor: colors.axis,
      ticks: "outside", ticklen: 4, tickcolor: colors.axis, tickfont: { size: 11, color: colors.soft }, automargin: true, type: item.x.log ? "log" : "linear",
      ...(item.x.range ? { range: item.x.log ? item.x.range.map(Math.log10) : item.x.range } : { range: span(item) }) },
    yaxis: { type: "category", categoryorder: "array", categoryarray: item.rows.map((row) => plain(row.name)), autorange: "reversed", fixedrange: true, automargin: true, showgrid: false, ticks: "outside", ticklen: 6, tickcolor: "rgba(0,0,0,0)", tickmode: "array", tickvals: item.rows.map((row) => plain(row.name)), ticktext: item.rows.map((row) => plain(shortened(row.name, Math.max(8, Math.floor(width * 0.3 / 6.4))))), tickfont: { size: 12, color: colors.ink } },
    showlegend: titled, legend: { orientation: "h", y: -0.35, yanchor: "top", traceorder: "normal" }, hovermode: "closest",
    hoverlabel: { bgcolor: colors.surface, bordercolor: colors.axis, font: { color: colors.ink, size: 12 }, namelength: -1 },
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
  };
  if (titled) layout.title = { text: plain(item.title), font: { size: 17 }, x: 0.02, xanchor: "left" };
  return { data, layout };
}

function span(item) {
  let least = Infinity, most = -Infinity;
  for (const row of item.rows) {
    for (const value of row.start) least = Math.min(least, value);
    for (const value of row.end) most = Math.max(most, value);
  }
  return most > least ? [least, most] : undefined;
}
