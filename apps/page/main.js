// The report's page: reads the document that the C++ side wrote, and builds everything the reader sees.
import "./page.css";
import { chartItem, panelsItem, stripItem } from "./chart.js";
import { element, icon, icons, paragraphs, tool } from "./dom.js";
import { announceReady } from "./drawing.js";
import { shown } from "./numbers.js";
import { findingsItem, tableItem } from "./table.js";
import { theme, toggleTheme } from "./theme.js";
import { viewItem } from "./view.js";

const report = JSON.parse(document.getElementById("document").textContent);

const kinds = {
  text: (item) => element("div", { class: "item prose" }, paragraphs(item.text)),
  table: tableItem,
  findings: findingsItem,
  chart: chartItem,
  panels: panelsItem,
  strip: stripItem,
  view: viewItem,
};

function fact({ label, value, unit, note }) {
  return element("div", { class: "fact" }, element("dt", {}, label),
    element("dd", {}, element("span", { class: "value" }, shown(value)), unit ? element("span", { class: "unit" }, `\u2009${unit}`) : null),
    note ? element("dd", { class: "note" }, note) : null);
}

function section({ id, title, intro, items }) {
  return element("section", { class: "chapter", id, "aria-labelledby": `${id}-title` }, element("h2", { id: `${id}-title`, tabindex: "-1" }, title),
    intro ? element("div", { class: "prose" }, paragraphs(intro)) : null, sideBySide(items));
}

// Charts with equal axes are square: neighbours share a row.
function sideBySide(items) {
  const made = [];
  for (const item of items) {
    const one = kinds[item.kind](item);
    const before = made[made.length - 1];
    if (item.kind !== "chart" || !item.equal_axes) made.push(one);
    else if (before?.className === "row") before.append(one);
    else if (before?.classList.contains("squared")) made[made.length - 1] = element("div", { class: "row" }, before, one);
    else made.push(one);
  }
  return made;
}

const links = report.sections.map(({ id, title }) => element("li", {}, element("a", { href: `#${id}` }, title)));
const contents = report.sections.length > 1 ? element("nav", { class: "contents", "aria-label": "Contents" },
  element("details", { open: matchMedia("(min-width: 1280px)").matches }, element("summary", {}, "Contents"), element("ol", {}, links))) : null;

const themeTool = tool("", "", icons.theme, () => { toggleTheme(); nameTheme(); });
function nameTheme() {
  const name = theme() === "dark" ? "Light colours" : "Dark colours";
  themeTool.setAttribute("aria-label", name);
  themeTool.title = name;
}
nameTheme();

const verdict = report.verdict;
document.getElementById("report").replaceWith(
  element("a", { class: "skip", href: "#content" }, "Skip to the report"),
  element("div", { class: "page" },
    contents,
    element("main", { id: "content" },
      element("header", {},
        element("div", { class: "masthead" }, element("p", { class: "kicker" }, element("span", { class: "mark" }, "Boresight"), report.verb ? ` ${report.verb}` : ""),
          element("div", { class: "tools" }, themeTool, tool("", "Print", icons.print, () => window.print()))),
        element("h1", {}, report.title),
        report.subtitle ? element("p", { class: "subtitle" }, report.subtitle) : null,
        verdict ? element("p", { class: `verdict ${verdict.status}` }, icon(icons[verdict.status]), element("span", {}, verdict.text)) : null,
        report.facts?.length ? element("dl", { class: "facts" }, report.facts.map(fact)) : null,
        report.warnings?.length ? element("ul", { class: "warnings", "aria-label": "Warnings" }, report.warnings.map((text) => element("li", {}, icon(icons.warning), element("span", {}, text)))) : null),
      report.sections.map(section),
      report.provenance?.length ? element("footer", { "aria-label": "Provenance" }, element("h2", {}, "Where this comes from"),
        element("dl", {}, report.provenance.map(({ label, value }) => element("div", {}, element("dt", {}, label), element("dd", {}, shown(value)))))) : null)));

// The contents list shows where the reader is.
const chapters = [...document.querySelectorAll(".chapter")];
function mark() {
  let current = -1;
  chapters.forEach((chapter, i) => { if (chapter.getBoundingClientRect().top < innerHeight * 0.35) current = i; });
  if (innerHeight + scrollY >= document.documentElement.scrollHeight - 4 && scrollY > 0) current = chapters.length - 1;
  links.forEach((link, i) => {
    if (i === current) link.firstChild.setAttribute("aria-current", "true");
    else link.firstChild.removeAttribute("aria-current");
  });
}
let marking = false;
addEventListener("scroll", () => {
  if (marking) return;
  marking = true;
  requestAnimationFrame(() => { marking = false; mark(); });
}, { passive: true });
mark();

announceReady();
