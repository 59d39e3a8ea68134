// Charts, small multiples and state strips as figures with legend, tools and caption.
import { csv, fileName, save } from "./csv.js";
import { element, icons, paragraphs, tool } from "./dom.js";
import { contourDashes, figure } from "./figure.js";
import { entriesOf, legend, look } from "./legend.js";
import { number, withUnit } from "./numbers.js";
import { picture, plot } from "./plot.js";
import { stripFigure } from "./strip.js";

function frame(item, kind, { saveCsv, savePng, reset }, ...content) {
  const resetTool = tool("Whole range", `Show the whole range of ${item.title}`, icons.reset, reset);
  resetTool.hidden = true;
  const figureElement = element("figure", { class: `item ${kind}`, "aria-label": item.title },
    element("div", { class: "item-head" }, element("h3", {}, item.title),
      element("div", { class: "tools" }, resetTool,
        tool("PNG", `Save ${item.title} as a PNG picture`, icons.save, savePng),
        tool("CSV", `Save the data of ${item.title} as CSV`, icons.save, saveCsv))),
    ...content,
    item.caption ? element("figcaption", {}, paragraphs(item.caption)) : null);
  return { figureElement, resetTool };
}

function described(chart, entries) {
  const names = entries.map((entry) => entry.name).join(", ");
  const what = chart.heatmap ? `${withUnit(chart.heatmap.label, chart.heatmap.unit)} over ` : "";
  return `${chart.title}: ${what}${withUnit(chart.y.label, chart.y.unit)} against ${withUnit(chart.x.label, chart.x.unit)}${names ? `; ${names}` : ""}`;
}

function contourKey(chart) {
  const map = chart.heatmap;
  if (!map?.contours?.length) return null;
  const styles = { solid: "solid", dash: "dashed", dot: "dotted", dashdot: "dash-dotted" };
  return element("p", { class: "note" }, `White level lines: ${map.contours.map((level, i) => `${number(level)}${map.unit ? ` ${map.unit}` : ""} (${styles[contourDashes[i % 4]]})`).join(", ")}`);
}

function chartRows(chart) {
  const rows = [];
  for (const series of chart.series ?? []) {
    series.x.forEach((x, i) => rows.push([series.name, x, series.y?.[i], series.y_low?.[i], series.error_low?.[i], series.error_high?.[i], series.text?.[i]]));
  }
  const map = chart.heatmap;
  if (map) map.z.forEach((row, j) => row.forEach((z, i) => rows.push([withUnit(map.label, map.unit), map.x[i], map.y[j], undefined, undefined, undefined, z])));
  return rows;
}
const sameAxes = (a, b) => ["x", "y"].every((axis) => a[axis].label === b[axis].label && a[axis].unit === b[axis].unit);
// Of panels, each row of which says itself what it holds where they have axes of their own.
function panelsText(panels) {
  const alike = panels.every((panel) => sameAxes(panel, panels[0]));
  const own = (panel) => (alike ? [] : [panel.x.label, panel.x.unit, panel.y.label, panel.y.unit]);
  const [series, x, y, ...rest] = rowHeader(panels[0]);
  const header = alike ? ["panel", series, x, y, ...rest] : ["panel", "x_is", "x_unit", "y_is", "y_unit", series, "x", "y", ...rest];
  return csv(header, panels.flatMap((panel) => chartRows(panel).map((row) => [panel.title, ...own(panel), ...row])));
}
const rowHeader = (chart) => ["series", withUnit(chart.x.label, chart.x.unit), withUnit(chart.y.label, chart.y.unit), "y_low", "error_low", "error_high", chart.heatmap ? "value" : "text"];

function wantsLegend(entries, title) {
  return entries.length > 1 || (entries.length === 1 && entries[0].name !== title);
}

export function chartItem(item) {
  const entries = entriesOf(item.series ?? []);
  const one = plot(described(item, entries), (width) => figure(item, entries, { width }), (zoom) => { parts.resetTool.hidden = !zoom; });
  if (item.equal_axes) one.holder.classList.add("square");
  const keys = wantsLegend(entries, item.title) ? legend(entries, one.redraw) : null;
  const parts = frame(item, "chart", {
    reset: () => one.setZoom(null),
    saveCsv: () => save(fileName(item.title, "csv"), csv(rowHeader(item), chartRows(item)), "text/csv"),
    savePng: async () => save(fileName(item.title, "png"), await picturesOf(item, entries)),
  }, keys, contourKey(item), one.holder);
  if (item.equal_axes) parts.figureElement.classList.add("squared");
  return parts.figureElement;
}

function picturesOf(item, entries, width = 1100) {
  const made = figure(item, entries, { width: item.equal_axes ? 720 : width, themeName: "light", titled: true });
  const rows = Math.ceil(entries.length / 4);
  made.layout.margin.b += entries.length > 1 ? 24 + 20 * rows : 0;
  const height = (item.equal_axes ? 700 : Math.max(560, made.layout.height + 40)) + (entries.length > 1 ? 20 * rows : 0);
  return picture(made, item.equal_axes ? 720 : width, height);
}

// Several pictures as one: a title, the panels in their grid.
async function composed(title, entries, pictures, columns, width, height) {
  const rows = Math.ceil(pictures.length / columns);
  const keys = entries.filter((entry) => entry.visible);
  const canvas = document.createElement("canvas");
  const scale = 2, head = keys.length > 1 ? 74 : 44;
  canvas.width = columns * width * scale;
  canvas.height = (rows * height + head) * scale;
  const context = canvas.getContext("2d");
  context.scale(scale, scale);
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, columns * width, rows * height + head);
  context.fillStyle = "#1b2430";
  context.font = "600 18px sans-serif";
  context.fillText(title, 14, 29);
  let at = 14;
  for (const entry of keys.length > 1 ? keys : []) {
    const { color, dash, width: thickness } = look(entry.series, entry.index, "light");
    context.strokeStyle = color;
    context.lineWidth = entry.series.style === "bars" || entry.series.style === "area" ? 9 : thickness + 0.6;
    context.setLineDash(dash === "solid" ? [] : dash.split(",").map(parseFloat));
    context.beginPath();
    context.moveTo(at, 55);
    context.lineTo(at + 28, 55);
    context.stroke();
    context.font = "13px sans-serif";
    context.fillText(entry.name, at + 34, 59);
    at += 58 + context.measureText(entry.name).width;
  }
  for (const [i, address] of pictures.entries()) {
    const image = new Image();
    image.src = address;
    await image.decode();
    context.drawImage(image, (i % columns) * width, head + Math.floor(i / columns) * height, width, height);
  }
  return canvas.toDataURL("image/png");
}

export function panelsItem(item) {
  const entries = entriesOf(item.panels.flatMap((panel) => panel.series ?? []));
  const columns = Math.min(item.columns ?? 3, item.panels.length);
  const plots = [];
  const linked = (a, b) => !a.equal_axes && !b.equal_axes && a.x.label === b.x.label && a.x.unit === b.x.unit && !!a.x.log === !!b.x.log;
  let passing = false;
  const cells = item.panels.map((panel, index) => {
    const one = plot(described(panel, entriesOf(panel.series ?? [])), (width) => figure(panel, entries, { width, panel: true }), (zoom) => {
      if (!passing) {
        passing = true;
        plots.forEach((other, k) => {
          if (other === one || !linked(panel, item.panels[k])) return;
          const rest = { ...(other.zoom ?? {}) };
          delete rest.xaxis;
          if (zoom?.xaxis) rest.xaxis = zoom.xaxis;
          other.setZoom(zoom && Object.keys(rest).length ? rest : null);
        });
        passing = false;
      }
      parts.resetTool.hidden = !plots.some((other) => other.zoom);
    });
    plots[index] = one;
    return element("div", { class: "panel" }, element("h4", {}, panel.title), contourKey(panel), one.holder, panel.caption ? element("p", { class: "note" }, panel.caption) : null);
  });
  const keys = item.legend !== "none" && wantsLegend(entries, item.title) ? legend(entries, () => plots.forEach((one) => one.redraw())) : null;
  const parts = frame(item, "panels", {
    reset: () => plots.forEach((one) => one.setZoom(null)),
    saveCsv: () => save(fileName(item.title, "csv"), panelsText(item.panels), "text/csv"),
    savePng: async () => {
      const width = 520, height = item.panels.some((panel) => panel.equal_axes) ? 520 : 400;
      const pictures = [];
      for (const panel of item.panels) {
        const made = figure(panel, entries, { width, panel: true, themeName: "light", titled: true });
        made.layout.title.font.size = 14;
        pictures.push(await picture(made, width, height));
      }
      save(fileName(item.title, "png"), await composed(item.title, entries, pictures, columns, width, height));
    },
  }, keys, element("div", { class: "panel-grid", style: `--columns: ${columns}` }, cells));
  return parts.figureElement;
}

export function stripItem(item) {
  const entries = entriesOf(item.states.map((state) => ({ name: state.label || state.name, style: "state", muted: state.muted })));
  const one = plot(`${item.title}: ${item.rows.map((row) => row.name).join(", ")} along ${withUnit(item.x.label, item.x.unit)}`,
    (width) => stripFigure(item, entries, { width }), (zoom) => { parts.resetTool.hidden = !zoom; });
  const parts = frame(item, "strip", {
    reset: () => one.setZoom(null),
    saveCsv: () => save(fileName(item.title, "csv"), csv(["row", "start", "end", "state"], item.rows.flatMap((row) => row.start.map((start, i) => [row.name, start, row.end[i], row.state[i]]))), "text/csv"),
    savePng: async () => {
      const made = stripFigure(item, entries, { width: 1100, themeName: "light", titled: true });
      save(fileName(item.title, "png"), await picture(made, 1100, made.layout.height));
    },
  }, legend(entries, one.redraw, "States"), one.holder);
  return parts.figureElement;
}
