// The mechanism of a view as lines of an SVG picture, at one instant, exaggeration and turn. Touches no element but its own.
import { camera, fitted } from "./camera.js";
import { svg } from "./dom.js";
import { ground, hue } from "./theme.js";

const axes = ["x", "y", "z"];
const minus = (a, b) => a.map((value, k) => value - b[k]);
const plus = (a, b, factor = 1) => a.map((value, k) => value + factor * b[k]);
const unit = (a) => { const length = Math.hypot(...a); return length > 0 ? a.map((value) => value / length) : [0, 0, 1]; };
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// A track at an instant between two: `at` counts instants. One number alone stands for all of them.
function sampled(track, at) {
  if (!track) return 0;
  if (track.length === 1) return track[0];
  const i = Math.min(Math.floor(at), track.length - 2);
  return track[i] + (at - i) * (track[i + 1] - track[i]);
}
export const idealAt = (point, at) => axes.map((axis) => sampled(point[axis], at));
export const deviationAt = (point, at) => axes.map((axis) => sampled(point[`d${axis}`], at));
export const shiftedAt = (point, at, exaggeration) => plus(idealAt(point, at), deviationAt(point, at), exaggeration);

// Everything ideal over the whole motion has room in the picture.
export function frameOf(item, width, height) {
  const all = item.points.flatMap((point) => item.time.map((_, i) => idealAt(point, i)));
  return fitted(all, width, height, width < 520 ? 14 : 26);
}

// How far its play lets a centre go.
const reach = ({ radial, axial, width = 0, height = 0 }) => Math.max(radial, width, height, radial + width > 0 ? 0 : axial);
// What the legend calls the room of a joint's play (room(), below).
export const roomOf = ({ tip, side, clearance }) => (tip === undefined ? "balls" : clearance.pad || clearance.pad_width ? "pads" : side !== undefined ? "guides" : "journals");

const f = (value) => value.toFixed(1);
const line = (...points) => points.map((p, i) => `${i ? "L" : "M"}${f(p.x)} ${f(p.y)}`).join("");
const dot = ({ x, y }, r) => `M${f(x - r)} ${f(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
const square = ({ x, y }, r) => `M${f(x - r)} ${f(y - r)}h${2 * r}v${2 * r}h${-2 * r}z`;
function arrow(from, to) {
  const length = Math.hypot(to.x - from.x, to.y - from.y);
  if (length < 4) return "";
  const [ux, uy] = [(to.x - from.x) / length, (to.y - from.y) / length];
  const corner = (side) => ({ x: to.x - 10 * ux - side * 4.5 * uy, y: to.y - 10 * uy + side * 4.5 * ux });
  return `${line(corner(1), to, corner(-1))}z`;
}

// A round floor with lines a round number apart: it gives the picture its depth.
function floor({ around, center, least }, project) {
  const step = 10 ** Math.floor(Math.log10(around || 1));
  const spacing = [0.2, 0.5, 1, 2, 5].map((k) => k * step).find((one) => around / one <= 5) ?? step;
  const at = (x, y) => project([x, y, least[2]]);
  let path = `${line(...Array.from({ length: 72 }, (_, i) => at(center[0] + around * Math.cos((Math.PI * i) / 36), center[1] + around * Math.sin((Math.PI * i) / 36))))}z`;
  for (const [k, along] of [[0, (fixed, free) => at(fixed, free)], [1, (fixed, free) => at(free, fixed)]]) {
    for (let i = Math.ceil((center[k] - around) / spacing); i * spacing <= center[k] + around; ++i) {
      const half = Math.sqrt(Math.max(0, around ** 2 - (i * spacing - center[k]) ** 2));
      path += line(along(i * spacing, center[1 - k] - half), along(i * spacing, center[1 - k] + half));
    }
  }
  return path;
}

// paint(state, width, height, themeName): state = {at, exaggeration, turn, shown: {ideal, real, boresight, play}}
export function scene(item) {
  const bodies = item.bodies.filter((body) => !body.muted), grounds = item.bodies.filter((body) => body.muted);
  const path = () => svg("path", { fill: "none", "stroke-linecap": "round", "stroke-linejoin": "round" });
  const [floorLines, base, idealLines, idealRays, joined, pins, rings, journals, rays, heads, triad, feet] = Array.from({ length: 12 }, path);
  const slots = bodies.map(() => ({ halo: path(), line: path() }));
  const names = item.joints.filter((joint) => joint.clearance).map((joint) => svg("text", { "font-size": "12", "font-weight": "600", "stroke-width": "3", "paint-order": "stroke" }, joint.name));
  const triadNames = axes.map((axis) => svg("text", { "font-size": "11", "text-anchor": "middle" }, axis));
  const picture = svg("svg", { "aria-hidden": "true", "font-family": "system-ui, sans-serif" },
    floorLines, base, feet, idealLines, idealRays, joined, ...slots.flatMap(({ halo, line: own }) => [halo, own]), pins, rings, journals, rays, heads, ...names, triad, ...triadNames);
  let known = null;

  function set(one, attributes) { for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, value); }

  function paint({ at, exaggeration, turn, shown }, width, height, themeName) {
    if (known?.width !== width || known.height !== height) known = { width, height, frame: frameOf(item, width, height) };
    const { frame } = known;
    const view = camera(turn, frame);
    const colors = ground(themeName);
    const blue = hue(0, themeName), orange = hue(1, themeName), green = hue(2, themeName);
    set(picture, { width, height, viewBox: `0 0 ${width} ${height}` });

    const ideal = item.points.map((point) => view.project(idealAt(point, at)));
    const world = item.points.map((point) => shiftedAt(point, at, exaggeration));
    const real = world.map(view.project);
    const outline = ({ points, closed }, where) => (points.length > 1 ? line(...points.map((i) => where[i])) + (closed ? "z" : "") : "");
    const drawn = (is, text) => (is ? text : "");

    set(floorLines, { d: floor(frame, view.project), stroke: colors.grid, "stroke-width": 1 });
    set(base, { d: grounds.map((body) => outline(body, ideal)).join(""), stroke: colors.axis, "stroke-width": 1.2, fill: colors.rest, "fill-opacity": 0.35 });
    set(feet, { d: grounds.flatMap((body) => body.points.map((i) => square(ideal[i], 4.5))).join(""), fill: colors.axis });

    set(idealLines, { d: drawn(shown.ideal, bodies.map((body) => outline(body, ideal)).join("") + item.joints.map((joint) => line(ideal[joint.first], ideal[joint.second])).join("")),
      stroke: colors.neutral, "stroke-width": 1.3, "stroke-dasharray": "4 3" });
    const ray = ({ from, to }, where) => line(where[from], where[to]) + arrow(where[from], where[to]);
    set(idealRays, { d: drawn(shown.ideal && shown.boresight, item.rays.map((one) => ray(one, ideal)).join("")), stroke: colors.neutral, "stroke-width": 1.3, "stroke-dasharray": "4 3" });

    // The nearest body is drawn last, and its edge in the ground's colour cuts what lies behind it.
    const depth = (body) => body.points.reduce((sum, i) => sum + real[i].depth, 0) / body.points.length;
    const order = bodies.map((body) => [depth(body), body]).sort((a, b) => a[0] - b[0]);
    order.forEach(([, body], i) => {
      const d = drawn(shown.real, outline(body, real));
      set(slots[i].halo, { d, stroke: colors.surface, "stroke-width": 6.5, "stroke-linecap": "butt" });
      set(slots[i].line, { d, stroke: blue, "stroke-width": 3, fill: body.closed ? blue : "none", "fill-opacity": 0.12 });
    });
    // What slides is joined by a thin line: the axis between the two parts.
    const sliding = item.joints.filter((joint) => !joint.clearance);
    set(joined, { d: drawn(shown.real, sliding.map((joint) => line(real[joint.first], real[joint.second])).join("")), stroke: blue, "stroke-width": 1.2 });
    // The axis of a joint that has one.
    const half = (joint) => {
      if (joint.tip === undefined) return "";
      const center = world[joint.first], tip = world[joint.tip];
      return line(view.project(plus(center, minus(tip, center), -1)), real[joint.tip]);
    };
    const pinned = sliding.map((joint) => dot(real[joint.first], 3.2) + half(joint));
    set(pins, { d: drawn(shown.real, pinned.join("")), stroke: colors.ink, "stroke-width": 1.4, fill: colors.surface });

    const loose = item.joints.filter((joint) => joint.clearance);
    set(rings, { d: drawn(shown.play, loose.map((joint) => half(joint) + room(joint)).join("")), stroke: green, "stroke-width": 1.8 });
    set(journals, { d: drawn(shown.play, loose.map((joint) => dot(real[joint.second], 3.6)).join("")), fill: green, stroke: colors.surface, "stroke-width": 1 });
    loose.forEach((joint, i) => {
      const beside = 6 + 0.8 * Math.min(exaggeration * reach(joint.clearance) * view.size, 60);
      set(names[i], { x: f(real[joint.first].x + beside), y: f(real[joint.first].y - beside), fill: colors.ink, stroke: colors.surface, visibility: shown.play ? "visible" : "hidden" });
    });
    set(rays, { d: drawn(shown.boresight, item.rays.map(({ from, to }) => line(real[from], real[to])).join("")), stroke: orange, "stroke-width": 2.4 });
    set(heads, { d: drawn(shown.boresight, item.rays.map(({ from, to }) => arrow(real[from], real[to]) + dot(real[from], 3)).join("")), fill: orange, stroke: orange });

    const corner = { x: 40, y: height - 40 };
    const tips = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => view.direction(axis));
    set(triad, { d: tips.map(([x, y]) => line(corner, { x: corner.x + 22 * x, y: corner.y + 22 * y })).join(""), stroke: colors.soft, "stroke-width": 1.4 });
    tips.forEach(([x, y], k) => set(triadNames[k], { x: f(corner.x + 31 * x), y: f(corner.y + 31 * y + 4), fill: colors.soft }));

    // What the centre can move in: of a journal a cylinder, a ring at each end; of a ball a sphere, a ring about every axis; of a slider a
    // rectangle across its guide; of a pad the space between its faces, a ring or rectangle of the pad's own size at each.
    function room({ first, second, tip, side, room: middle, clearance }) {
      const foot = world[first], center = world[middle ?? first];
      const ring = (axis, along, r = exaggeration * clearance.radial) => {
        const a = unit(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0])), b = cross(axis, a);
        return `${line(...Array.from({ length: 48 }, (_, i) => {
          const angle = (2 * Math.PI * i) / 48;
          return view.project(plus(plus(plus(center, axis, exaggeration * along), a, r * Math.cos(angle)), b, r * Math.sin(angle)));
        }))}z`;
      };
      if (tip === undefined) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => ring(axis, 0)).join("");
      const axis = unit(minus(world[tip], foot));
      if (clearance.pad_width) {
        const a = unit(minus(world[side], world[second])), b = cross(a, axis);
        const sides = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        return [-1, 1].map((face) => `${line(...sides.map(([w, l]) => view.project(plus(plus(plus(center, axis, face * exaggeration * clearance.axial), a, w * clearance.pad_width), b, l * clearance.pad_length))))}z`).join("");
      }
      if (side !== undefined) {
        const a = unit(minus(world[side], foot)), b = cross(a, axis);
        return `${line(...[[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([w, h]) => view.project(plus(plus(center, a, w * exaggeration * clearance.width), b, h * exaggeration * clearance.height))))}z`;
      }
      if (clearance.pad) return ring(axis, -clearance.axial, clearance.pad) + ring(axis, clearance.axial, clearance.pad);
      return clearance.axial > 0 ? ring(axis, -clearance.axial) + ring(axis, clearance.axial) : ring(axis, 0);
    }
  }
  return { picture, paint };
}
