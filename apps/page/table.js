// Tables that sort, and findings.
import { copy, csv, fileName, save } from "./csv.js";
import { element, icon, icons, paragraphs, tool } from "./dom.js";
import { magnitude, shown, withUnit } from "./numbers.js";

const shownAtFirst = 25;

export function tableItem(item) {
  const numeric = item.columns.map((_, k) => item.rows.every((row) => typeof row[k] === "number" || row[k] === null) && item.rows.some((row) => typeof row[k] === "number"));
  const align = item.columns.map((column, k) => column.align ?? (numeric[k] ? "right" : "left"));
  let order = item.rows.map((_, i) => i);
  let sorted = { column: -1, down: false };
  let all = item.rows.length <= shownAtFirst + 5;

  const body = element("tbody");
  const heads = item.columns.map((column, k) => element("th", { scope: "col", class: align[k], "aria-sort": "none" },
    element("button", { type: "button", onclick: () => sort(k) }, element("span", {}, column.label), column.unit ? element("span", { class: "unit" }, column.unit) : null)));
  const more = element("button", { type: "button", class: "more", onclick: () => { all = true; fill(); } });

  function fill() {
    body.replaceChildren(...(all ? order : order.slice(0, shownAtFirst)).map((i) => element("tr", {}, item.rows[i].map((value, k) =>
      element("td", { class: `${align[k]}${typeof value === "number" ? " number" : ""}`, title: typeof value === "number" && shown(value).replace("\u2212", "-") !== String(value) ? String(value) : undefined }, shown(value))))));
    more.hidden = all;
    more.textContent = `Show all ${item.rows.length} rows`;
  }
  // Quantities as text ("0.12 mm", "35 µm") by how large they are, where all of a column are such.
  const sizes = item.columns.map((_, k) => {
    const cells = item.rows.map((row) => (row[k] === null ? null : typeof row[k] === "number" ? row[k] : magnitude(row[k])));
    return cells.some((size, i) => size === undefined && item.rows[i][k] !== "") ? null : cells;
  });
  function sort(k) {
    sorted = { column: k, down: sorted.column === k && !sorted.down };
    const key = (i) => (sizes[k] ? sizes[k][i] ?? null : item.rows[i][k]);
    order.sort((a, b) => {
      const [left, right] = [key(a), key(b)];
      if (left === null || right === null) return (left === null) - (right === null);
      const difference = typeof left === "number" && typeof right === "number" ? left - right : String(left).localeCompare(String(right), undefined, { numeric: true });
      return (sorted.down ? -difference : difference) || a - b;
    });
    heads.forEach((head, i) => head.setAttribute("aria-sort", i !== k ? "none" : sorted.down ? "descending" : "ascending"));
    fill();
  }
  fill();

  const text = () => csv(item.columns.map((column) => withUnit(column.label, column.unit)), order.map((i) => item.rows[i]));
  const copied = element("span", { class: "copied", role: "status" });
  return element("figure", { class: "item table", "aria-label": item.title },
    element("div", { class: "item-head" }, element("h3", {}, item.title), element("div", { class: "tools" }, copied,
      tool("Copy", `Copy ${item.title} as CSV`, icons.copy, async () => { await copy(text()); copied.textContent = "Copied"; setTimeout(() => { copied.textContent = ""; }, 1500); }),
      tool("CSV", `Save ${item.title} as CSV`, icons.save, () => save(fileName(item.title, "csv"), text(), "text/csv")))),
    element("div", { class: "table-scroll", tabindex: "0", role: "region", "aria-label": item.title }, element("table", {}, element("thead", {}, element("tr", {}, heads)), body)),
    more,
    item.caption ? element("figcaption", {}, paragraphs(item.caption)) : null);
}

const standings = {
  agrees: { word: "Agrees", picture: icons.good, className: "good" },
  differs: { word: "Differs", picture: icons.bad, className: "bad" },
  explained: { word: "Explained", picture: icons.neutral, className: "neutral" },
};

export function findingsItem(item) {
  return element("section", { class: "item findings", "aria-label": item.title ?? "Findings" },
    item.title ? element("div", { class: "item-head" }, element("h3", {}, item.title)) : null,
    element("ul", {}, item.items.map((finding) => {
      const { word, picture, className } = standings[finding.status];
      return element("li", { class: className },
        element("span", { class: `badge ${className}` }, icon(picture), word),
        element("div", { class: "finding" },
          element("p", { class: "claim" }, finding.claim),
          finding.measured ? element("p", { class: "measured" }, element("span", { class: "what" }, "Measured: "), finding.measured) : null,
          finding.why ? element("p", { class: "why" }, finding.why) : null));
    })),
    item.caption ? element("div", { class: "caption" }, paragraphs(item.caption)) : null);
}
