// Elements made from data: text is always set as text, never as markup.
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.flat().filter((child) => child !== undefined && child !== null && child !== false));
  return made;
}

const svgNamespace = "http://www.w3.org/2000/svg";
export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(svgNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// A line drawing of 16 by 16, in the colour of the text around it.
export function icon(path) {
  return svg("svg", { viewBox: "0 0 16 16", width: "16", height: "16", "aria-hidden": "true", class: "icon" },
    svg("path", { d: path, fill: "none", stroke: "currentColor", "stroke-width": "1.75", "stroke-linecap": "round", "stroke-linejoin": "round" }));
}
export const icons = {
  good: "M3 8.5l3.2 3.2L13 4.8",
  bad: "M4 4l8 8M12 4l-8 8",
  neutral: "M3.5 8h9",
  warning: "M8 5.5v3.6M8 11.6v.1M8 1.8l6.6 11.9H1.4z",
  save: "M8 2.5v7.5M4.8 7L8 10.2 11.2 7M2.8 13.3h10.4",
  copy: "M6 5.5h7v8H6zM10 5.5v-3H3v8h3",
  theme: "M13 9.8A5.6 5.6 0 016.2 3a5.6 5.6 0 106.8 6.8z",
  print: "M4.5 6V2.5h7V6M4.5 11.5h-2V6h11v5.5h-2M4.5 9.5h7v4h-7z",
  play: "M5 3.2v9.6l7.5-4.8z",
  pause: "M5.2 3.5v9M10.8 3.5v9",
  reset: "M3 8a5 5 0 105-5H4.5M6.5 1L4.3 3l2.2 2",
};

export function paragraphs(text) {
  return String(text ?? "").split(/\n\s*\n/).filter((part) => part.trim()).map((part) => element("p", {}, part.trim()));
}

export function tool(label, name, picture, action) {
  return element("button", { type: "button", class: "tool", "aria-label": name, title: name, onclick: action }, icon(picture), label);
}
