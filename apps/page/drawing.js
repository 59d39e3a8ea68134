// When plots are drawn: those near the window first, the others when the reader comes near them, all of them before printing.
import { onTheme, printing } from "./theme.js";

const plots = [];
const waiting = new Set();
let scheduled = false;

function drawNext() {
  scheduled = false;
  const [plot] = waiting;
  if (!plot) return;
  waiting.delete(plot);
  plot.draw();
  schedule();
}
function schedule() {
  if (!waiting.size || scheduled) return;
  scheduled = true;
  setTimeout(drawNext, 0);
}

const near = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    const plot = plots.find((one) => one.holder === entry.target);
    plot.near = entry.isIntersecting;
    if (entry.isIntersecting && (!plot.drawn || plot.stale)) waiting.add(plot);
  }
  schedule();
}, { rootMargin: "500px 0px" });

const resized = new ResizeObserver((entries) => {
  if (document.documentElement.classList.contains("printing")) return;
  for (const entry of entries) {
    const plot = plots.find((one) => one.holder === entry.target);
    const width = Math.round(entry.contentRect.width);
    if (!plot.drawn || !width || width === plot.width) continue;
    plot.stale = true;
    if (plot.near) waiting.add(plot);
  }
  schedule();
});

// holder: the element that is as wide as the plot may be; drawInto(width): draws at that width, again if drawn before.
export function addPlot(holder, drawInto) {
  const plot = {
    holder, drawn: false, stale: false, near: false, width: 0,
    draw(width = Math.round(holder.clientWidth)) {
      if (!width) return;
      plot.width = width;
      drawInto(width);
      plot.drawn = true;
      plot.stale = false;
      holder.dataset.drawn = "true";
    },
  };
  plots.push(plot);
  near.observe(holder);
  resized.observe(holder);
  return plot;
}

onTheme(() => {
  for (const plot of plots) {
    if (!plot.drawn) continue;
    plot.stale = true;
    if (plot.near) waiting.add(plot);
  }
  schedule();
});

function drawAll() {
  for (const plot of plots) plot.draw();
}

// Printing lays the page out as wide as paper, in light colours, and draws everything at that width at once.
addEventListener("beforeprint", () => {
  document.documentElement.classList.add("printing");
  printing(true);
  drawAll();
});
addEventListener("afterprint", () => {
  document.documentElement.classList.remove("printing");
  printing(false);
  drawAll();
});

// For tests and for scripts that take pictures: resolves once what is near the window is drawn.
export function announceReady() {
  const settled = new Promise((resolve) => {
    const look = () => {
      const missing = plots.some((plot) => plot.near && (!plot.drawn || plot.stale));
      if (missing || waiting.size) setTimeout(look, 10);
      else resolve(true);
    };
    requestAnimationFrame(() => setTimeout(look, 30));
  });
  window.__boresightReady = settled;
  window.__boresight = {
    plots: () => plots.length,
    drawn: () => plots.filter((plot) => plot.drawn && !plot.stale).length,
    drawAll,
  };
}
