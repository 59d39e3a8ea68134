// One plot in the page: draws a figure, keeps the reader's zoom, answers to the keyboard.
import Plotly from "./plotly.js";
import { addPlot } from "./drawing.js";
import { element } from "./dom.js";
import { locale } from "./figure.js";

let drawings = 0;

// make(width) -> {data, layout}; zoomed(axes, plot): called when the reader zooms or pans.
export function plot(label, make, zoomed = () => {}) {
  const area = element("div", { class: "plot-area" });
  const holder = element("div", { class: "plot-holder", tabindex: "0", role: "group", "aria-label": `${label}. Arrow keys move along x, plus and minus zoom, 0 shows everything.` }, area);
  const one = { holder, area, zoom: null, quiet: false };
  const drawing = addPlot(holder, (width) => {
    const made = make(width);
    if (one.zoom) for (const [axis, range] of Object.entries(one.zoom)) Object.assign(made.layout[axis], { range, autorange: false });
    holder.style.minHeight = `${made.layout.height}px`;
    made.layout.datarevision = ++drawings; // the arrays are the same, and what they are measured against is not
    const first = !area.classList.contains("js-plotly-plot");
    Plotly.react(area, made.data, made.layout, { displayModeBar: false, displaylogo: false, responsive: false, doubleClick: "reset+autosize", showTips: false, scrollZoom: false, ...locale(made.unit) });
    if (first) listen();
  });
  one.redraw = () => { if (drawing.drawn) drawing.draw(); };

  function listen() {
    area.on("plotly_relayout", (change) => {
      if (one.quiet) return;
      const zoom = { ...(one.zoom ?? {}) };
      for (const axis of ["xaxis", "yaxis"]) {
        if (`${axis}.range[0]` in change) zoom[axis] = [change[`${axis}.range[0]`], change[`${axis}.range[1]`]];
        else if (`${axis}.range` in change) zoom[axis] = change[`${axis}.range`];
        else if (change[`${axis}.autorange`]) delete zoom[axis];
      }
      const before = JSON.stringify(one.zoom);
      one.zoom = Object.keys(zoom).length ? zoom : null;
      if (JSON.stringify(one.zoom) !== before) zoomed(one.zoom, one);
    });
  }
  one.setZoom = (zoom) => {
    one.zoom = zoom;
    one.redraw();
    zoomed(zoom, one);
  };
  holder.addEventListener("keydown", (event) => {
    if (event.target !== holder || event.ctrlKey || event.metaKey || event.altKey) return;
    const axis = area._fullLayout?.xaxis;
    if (!axis) return;
    if (event.key === "0" || event.key === "Home") one.setZoom(null);
    else if (["ArrowLeft", "ArrowRight", "+", "=", "-"].includes(event.key)) {
      const [from, to] = axis.range.map(Number);
      const span = to - from;
      const middle = (from + to) / 2;
      const step = { ArrowLeft: -0.15, ArrowRight: 0.15 }[event.key];
      const range = step ? [from + step * span, to + step * span] : [middle - span * (event.key === "-" ? 0.75 : 1 / 3), middle + span * (event.key === "-" ? 0.75 : 1 / 3)];
      one.setZoom({ ...(one.zoom ?? {}), xaxis: range });
    } else return;
    event.preventDefault();
  });
  return one;
}

export function picture(made, width, height) {
  return Plotly.toImage({ data: made.data, layout: { ...made.layout, width, height } }, { format: "png", width, height, scale: 2 });
}
