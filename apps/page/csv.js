// Tables and charts as CSV, with the numbers that the report holds.
function cell(value) {
  if (value === null || value === undefined) return "";
  // A text that a spreadsheet would take for a formula is led by an apostrophe; numbers stay numbers.
  const formula = typeof value === "string" && /^[=+\-@\t\r]/.test(value) && !(value.trim() !== "" && Number.isFinite(Number(value)));
  const text = (formula ? "'" : "") + String(value);
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csv(header, rows) {
  return [header, ...rows].map((row) => row.map(cell).join(",")).join("\r\n") + "\r\n";
}

export function fileName(title, ending) {
  const name = title.normalize("NFKD").replace(/[^\w]+/g, "-").replace(/^-+|-+$/g, "").toLowerCase().slice(0, 60);
  return `${name || "report"}.${ending}`;
}

export function save(name, content, type) {
  const address = typeof content === "string" && content.startsWith("data:")
    ? content : URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  if (!address.startsWith("data:")) setTimeout(() => URL.revokeObjectURL(address), 10000);
}

export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = document.createElement("textarea");
    area.value = text;
    area.style.position = "fixed";
    area.style.opacity = "0";
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}
