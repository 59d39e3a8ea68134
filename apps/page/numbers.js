// Numbers as engineers read them: four significant digits, grouped thousands, powers of ten written out.
const superscript = { "-": "\u207b", 0: "\u2070", 1: "\u00b9", 2: "\u00b2", 3: "\u00b3", 4: "\u2074", 5: "\u2075", 6: "\u2076", 7: "\u2077", 8: "\u2078", 9: "\u2079" };

function grouped(text) {
  const [whole, part] = text.split(".");
  const spaced = whole.replace("-", "").length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return part ? `${spaced}.${part}` : spaced;
}

export function number(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  let text;
  if (size === 0) text = "0";
  else if (Number.isInteger(value) && size < 1e9) text = grouped(String(value));
  else if (size >= 1000 && size < 1e6) text = grouped(String(Math.round(value)));
  else if (size >= 1e-3 && size < 1000) text = String(Number(value.toPrecision(4)));
  else {
    const [mantissa, power] = value.toExponential(3).split("e");
    text = `${Number(mantissa)}\u202f\u00d7\u202f10${[...power.replace("+", "")].map((c) => superscript[c]).join("")}`;
  }
  return text.replace("-", "\u2212");
}

export function shown(value) {
  if (typeof value === "number") return number(value);
  if (value === null || value === undefined) return "\u2013";
  if (typeof value === "boolean") return value ? "yes" : "no";
  return String(value);
}

export function withUnit(label, unit) {
  return unit ? `${label} (${unit})` : label;
}

// Sizes of units with their prefixes, as reports write quantities.
const prefixes = { n: 1e-9, "\u00b5": 1e-6, u: 1e-6, m: 1e-3, c: 1e-2, k: 1e3, M: 1e6, G: 1e9 };
const units = { "": 1, "%": 0.01, m: 1, rad: 1, s: 1, N: 1, Hz: 1, Pa: 1, J: 1, W: 1, g: 1, K: 1, min: 60, h: 3600, deg: Math.PI / 180, "\u00b0": Math.PI / 180, arcmin: Math.PI / 10800, arcsec: Math.PI / 648000, mas: Math.PI / 648e6 };
const sizeOf = (unit) => units[unit] ?? (unit[0] in prefixes && unit.slice(1) in units && unit.length > 1 ? prefixes[unit[0]] * units[unit.slice(1)] : undefined);

// Of a quantity as text, "0.12 mm": its number in SI, to rank it by; undefined where it is none. What stands behind a power or a
// slash scales with it in every row, so the first unit's size decides.
export function magnitude(text) {
  const parts = /^\s*([-+\u2212]?\d+(?:\.\d*)?(?:e[-+]?\d+)?)\s*([^\s/^]*)\S*\s*\S*$/i.exec(String(text));
  if (!parts) return undefined;
  const size = sizeOf(parts[2]);
  return size === undefined ? undefined : Number(parts[1].replace("\u2212", "-")) * size;
}
