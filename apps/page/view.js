// The mechanism in motion: the reader plays it, turns it, and exaggerates its deviation from the ideal motion.
import { homeTurn } from "./camera.js";
import { fileName, save } from "./csv.js";
import { element, icon, icons, paragraphs, tool } from "./dom.js";
import { addPlot } from "./drawing.js";
import { legend } from "./legend.js";
import { number } from "./numbers.js";
import { deviationAt, frameOf, roomOf, scene } from "./scene.js";
import { theme } from "./theme.js";

const reduced = matchMedia("(prefers-reduced-motion: reduce)");
const loopSeconds = (duration) => Math.min(Math.max(duration, 6), 20);

// 1, 2 or 5 times a power of ten, next below or above.
function round125(value, up) {
  const power = 10 ** Math.floor(Math.log10(value));
  const steps = [1, 2, 5, 10].map((k) => k * power);
  return up ? steps.find((one) => one >= value * (1 - 1e-9)) : steps.filter((one) => one <= value * (1 + 1e-9)).pop();
}

// Largest deviation of the joints and of the rays' feet, and the instant at which the boresight is worst.
function deviationsOf(item) {
  const shown = new Set(item.bodies.flatMap((body) => body.points).concat(item.rays.map((ray) => ray.from)));
  const ends = item.rays.length ? item.rays.map((ray) => ray.to) : [...shown];
  let most = 0, mostDrawn = 0, worst = 0, worstSize = -1;
  item.time.forEach((_, at) => {
    item.points.forEach((point, i) => {
      const size = Math.hypot(...deviationAt(point, at));
      if (shown.has(i)) most = Math.max(most, size);
      mostDrawn = Math.max(mostDrawn, size);
      if (ends.includes(i) && size > worstSize) { worst = at; worstSize = size; }
    });
  });
  return { most, mostDrawn, worst };
}

export function viewItem(item) {
  const last = item.time.length - 1;
  const duration = item.time[last] - item.time[0];
  const { most, mostDrawn, worst } = deviationsOf(item);
  const { size } = frameOf(item, 800, 480);
  const usual = mostDrawn > 0 ? Math.max(1, round125((0.12 * size) / mostDrawn, false)) : 1;
  const greatest = mostDrawn > 0 ? Math.max(10, round125((0.5 * size) / mostDrawn, true)) : 1;
  const still = { at: worst };
  const state = { at: worst, exaggeration: usual, turn: { ...homeTurn }, shown: { ideal: mostDrawn > 0, real: true, boresight: true, play: true } };
  let playing = false, wanted = !reduced.matches && last > 0, inSight = false, width = 0, clock = null;

  const made = scene(item);
  const heightOf = (w) => (w < 520 ? 340 : 480);
  const onPaper = () => document.documentElement.classList.contains("printing");
  const paint = () => { if (width) made.paint(onPaper() && wanted ? { ...state, ...still } : state, width, heightOf(width), theme()); };

  const stage = element("div", {
    class: "stage", tabindex: "0", role: "group",
    "aria-label": `${item.title}: ${item.bodies.filter((body) => !body.muted).length} bodies. Arrow keys turn it, plus and minus zoom, 0 turns it back${last > 0 ? ", the space bar plays and pauses" : ""}.`,
  }, made.picture);
  addPlot(stage, (w) => { width = w; paint(); tell(); });

  // ---- time

  const playTool = element("button", { type: "button", class: "play", onclick: () => play(!wanted) });
  const time = element("input", { type: "range", min: "0", max: String(last), step: "any", "aria-label": "Time" });
  const timeText = element("output", {});
  const scale = element("input", { type: "range", min: "0", max: String(Math.log10(greatest)), step: "0.01", "aria-label": "Exaggeration of the deviation" });
  const scaleText = element("output", {});
  const slowed = loopSeconds(duration) / (duration || 1);
  const pace = slowed > 1.05 ? `slowed ${number(Number(slowed.toPrecision(2)))} times` : slowed < 0.95 ? `${number(Number((1 / slowed).toPrecision(2)))} times as fast` : "";

  function tell() {
    const at = onPaper() && wanted ? still.at : state.at;
    const i = Math.min(Math.floor(at), Math.max(last - 1, 0));
    const t = last > 0 ? item.time[i] + (at - i) * (item.time[i + 1] - item.time[i]) : item.time[0];
    const digits = Math.max(0, 2 - Math.floor(Math.log10(duration || 1)));
    time.value = String(at);
    timeText.textContent = `${t.toFixed(digits)}\u2009s`;
    time.setAttribute("aria-valuetext", `${t.toFixed(digits)} s`);
    scale.value = String(Math.log10(state.exaggeration));
    scaleText.textContent = `\u00d7\u2009${number(state.exaggeration)}`;
    scale.setAttribute("aria-valuetext", `${number(state.exaggeration)} times`);
    measure.textContent = `Largest deviation ${number(most)}\u2009${item.unit}, drawn as ${number(Number((most * state.exaggeration).toPrecision(3)))}\u2009${item.unit}.`;
  }
  function nameTool() {
    const name = wanted ? "Pause" : "Play";
    playTool.replaceChildren(icon(wanted ? icons.pause : icons.play), name);
    playTool.setAttribute("aria-label", `${name} the motion`);
  }
  function step(now) {
    if (!playing) return;
    if (clock !== null && !onPaper()) {
      state.at = (state.at + ((now - clock) / 1000 / loopSeconds(duration)) * last) % last;
      paint();
      tell();
    }
    clock = now;
    requestAnimationFrame(step);
  }
  function run() {
    const should = wanted && inSight && last > 0;
    if (should === playing) return;
    playing = should;
    clock = null;
    if (playing) requestAnimationFrame(step);
  }
  function play(on) {
    wanted = on && last > 0;
    nameTool();
    run();
  }
  new IntersectionObserver((entries) => { inSight = entries[entries.length - 1].isIntersecting; run(); }, { threshold: 0.25 }).observe(stage);

  time.addEventListener("input", () => { play(false); state.at = Number(time.value); paint(); tell(); });
  scale.addEventListener("input", () => { state.exaggeration = Number((10 ** Number(scale.value)).toPrecision(2)); paint(); tell(); });

  // ---- turning

  const turnedBack = tool("Turn back", `Turn back ${item.title}`, icons.reset, () => turn(homeTurn));
  turnedBack.hidden = true;
  function turn(change) {
    Object.assign(state.turn, change);
    state.turn.elevation = Math.min(90, Math.max(-90, state.turn.elevation));
    state.turn.zoom = Math.min(20, Math.max(0.3, state.turn.zoom));
    turnedBack.hidden = Object.entries(homeTurn).every(([key, value]) => state.turn[key] === value);
    paint();
  }
  stage.addEventListener("keydown", (event) => {
    if (event.target !== stage || event.ctrlKey || event.metaKey || event.altKey) return;
    const { azimuth, elevation, zoom } = state.turn;
    const change = {
      ArrowLeft: { azimuth: azimuth + 6 }, ArrowRight: { azimuth: azimuth - 6 }, ArrowUp: { elevation: elevation + 6 }, ArrowDown: { elevation: elevation - 6 },
      "+": { zoom: zoom * 1.25 }, "=": { zoom: zoom * 1.25 }, "-": { zoom: zoom / 1.25 }, 0: homeTurn, Home: homeTurn,
    }[event.key];
    if (change) turn(change);
    else if (event.key === " " && last > 0) play(!wanted);
    else return;
    event.preventDefault();
  });
  let from = null;
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    from = { x: event.clientX, y: event.clientY, ...state.turn };
  });
  stage.addEventListener("pointermove", (event) => {
    if (from) turn({ azimuth: from.azimuth - 0.45 * (event.clientX - from.x), elevation: from.elevation + 0.45 * (event.clientY - from.y) });
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { from = null; });

  // ---- around it

  const loose = new Set(item.joints.filter((joint) => joint.clearance).map(roomOf));
  const rooms = [["journals", "rings of journals"], ["balls", "rings of balls"], ["guides", "rectangles of sliders"], ["pads", "bands of pads"]]
    .filter(([kind]) => loose.has(kind)).map(([, says]) => says).join(", ");
  const measure = element("p", { class: "note" });
  measure.hidden = mostDrawn === 0;
  const keys = [
    ...(mostDrawn > 0 ? [{ name: "ideal", key: "ideal", series: { style: "line", muted: true }, index: 0 }] : []),
    { name: mostDrawn > 0 ? "with clearance" : "bodies", key: "real", series: { style: "line" }, index: 0 },
    ...(item.rays.length ? [{ name: "boresight", key: "boresight", series: { style: "line" }, index: 1 }] : []),
    ...(loose.size ? [{ name: `play of the joints: ${rooms}`, key: "play", series: { style: "line" }, index: 2 }] : []),
  ].map((entry) => ({ ...entry, visible: true }));
  const switched = () => { for (const { key, visible } of keys) state.shown[key] = visible; paint(); };

  nameTool();
  tell();
  return element("figure", { class: "item view", "aria-label": item.title },
    element("div", { class: "item-head" }, element("h3", {}, item.title),
      element("div", { class: "tools" }, turnedBack, tool("PNG", `Save ${item.title} as a PNG picture`, icons.save, async () => save(fileName(item.title, "png"), await picture())))),
    legend(keys, switched, "Parts"), stage,
    element("div", { class: "controls" },
      last > 0 ? element("div", { class: "control" }, playTool, element("span", { class: "what" }, "Time"), time, timeText, pace ? element("span", { class: "pace" }, pace) : null) : null,
      mostDrawn > 0 ? element("label", { class: "control" }, element("span", { class: "what" }, "Exaggeration"), scale, scaleText) : null),
    measure,
    item.caption ? element("figcaption", {}, paragraphs(item.caption)) : null);

  // What is on the screen, in light colours, twice as fine.
  async function picture() {
    const one = scene(item), w = 1000, h = 640;
    one.paint(state, w, h, "light");
    one.picture.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    const image = new Image();
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(one.picture))}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = 2 * w;
    canvas.height = 2 * h;
    const context = canvas.getContext("2d");
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, 2 * w, 2 * h);
    context.drawImage(image, 0, 0, 2 * w, 2 * h);
    return canvas.toDataURL("image/png");
  }
}
