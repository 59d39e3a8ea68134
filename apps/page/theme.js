// Light and dark: the reader's system decides until the reader does. Charts redraw when it changes.
const listeners = new Set();
const system = window.matchMedia("(prefers-color-scheme: dark)");
const key = "boresight-report-theme";
let chosen = null;
try { chosen = localStorage.getItem(key); } catch { /* a file opened from disk may have no storage */ }
if (chosen !== "light" && chosen !== "dark") chosen = null;
let forPrint = false;

export function theme() {
  if (forPrint) return "light";
  return chosen ?? (system.matches ? "dark" : "light");
}

function changed() {
  document.documentElement.dataset.theme = theme();
  for (const listener of listeners) listener();
}

export function onTheme(listener) { listeners.add(listener); }
export function toggleTheme() {
  chosen = theme() === "dark" ? "light" : "dark";
  try { localStorage.setItem(key, chosen); } catch { /* kept for this visit only */ }
  changed();
}
export function printing(on) {
  forPrint = on;
  changed();
}

document.documentElement.dataset.theme = theme();
system.addEventListener("change", () => { if (!chosen) changed(); });

// Okabe and Ito's palette, told apart with every common colour blindness; on dark ground the same hues, lighter.
const hues = {
  light: ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8a7a00", "#000000"],
  dark: ["#56B4E9", "#FF8B3D", "#2BC79A", "#E59BC4", "#E69F00", "#3D8FD1", "#F0E442", "#ffffff"],
};
const grounds = {
  light: { ink: "#1b2430", soft: "#4d5866", grid: "#e6eaef", axis: "#8b96a3", neutral: "#6b7683", surface: "#ffffff", rest: "#d5dbe2", contour: "#ffffff" },
  dark: { ink: "#e8ecf1", soft: "#b0bac6", grid: "#2c3541", axis: "#6f7b89", neutral: "#9aa5b2", surface: "#1a2029", rest: "#3a4552", contour: "#ffffff" },
};
export function hue(index, name = theme()) { return hues[name][index % 8]; }
export function ground(name = theme()) { return grounds[name]; }
