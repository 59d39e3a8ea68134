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
