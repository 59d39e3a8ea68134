// What a reader sees: opens the sample reports in headless Chromium, narrow and wide, light and dark, and looks.
//   node browser.mjs REPORT_SAMPLE NPM_FOLDER SCREENSHOT_FOLDER
// Exit 0: all holds; 1: something does not (each said on one line), or there is no Chromium to look with.
// The browser is $BORESIGHT_CHROMIUM, or chromium, chromium-browser, google-chrome from the PATH.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [sampleProgram, npm, pictures] = process.argv.slice(2).map((one) => path.resolve(one));

function chromiumPath() {
  if (process.env.BORESIGHT_CHROMIUM) return process.env.BORESIGHT_CHROMIUM;
  for (const folder of (process.env.PATH ?? "").split(path.delimiter)) {
    for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
      const file = path.join(folder, name);
      if (fs.existsSync(file)) return file;
    }
  }
  return null;
}
const executablePath = chromiumPath();
if (!executablePath) {
  console.log("FAILED: no Chromium in the PATH (Debian: apt install chromium), and BORESIGHT_CHROMIUM is not set");
  process.exit(1);
}
const { chromium } = createRequire(path.join(npm, "package.json"))("playwright-core");

fs.mkdirSync(pictures, { recursive: true });
const files = {};
for (const name of ["every-kind", "hostile", "many"]) {
  files[name] = path.join(pictures, `${name}.html`);
  execFileSync(sampleProgram, [name, files[name]]);
}

let failures = 0;
function expect(holds, what) {
  if (holds) return;
  ++failures;
  console.log(`FAILED: ${what}`);
}

// A fresh profile in a temporary folder, removed by the driver when the browser closes.
const browser = await chromium.launch({ executablePath, headless: true, args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });

async function open(name, { width, height = 900, dark = false, still = false, javaScriptEnabled = true }) {
  const context = await browser.newContext({ reducedMotion: still ? "reduce" : "no-preference", viewport: { width, height }, colorScheme: dark ? "dark" : "light", javaScriptEnabled, acceptDownloads: true });
  const page = await context.newPage();
  const label = `${name} ${width} ${dark ? "dark" : "light"}`;
  const noise = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) noise.push(message.text()); });
  page.on("pageerror", (error) => noise.push(String(error)));
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) noise.push(`request to ${request.url()}`); });
  const start = Date.now();
  await page.goto(pathToFileURL(files[name]).href);
  if (javaScriptEnabled) await page.evaluate(() => window.__boresightReady);
  return { page, context, label, noise, opened: Date.now() - start, close: async () => {
    expect(noise.length === 0, `${label}: the console is quiet, but: ${noise.slice(0, 3).join(" | ")}`);
    await context.close();
  } };
}

const settle = (page) => page.waitForTimeout(60);
async function drawAll(page) {
  await page.evaluate(() => window.__boresight.drawAll());
  await settle(page);
}

// Nothing wider than the window; every plot drawn with a size; no axis number or title cut off by its plot.
async function looksWhole(page, label) {
  const found = await page.evaluate(() => {
    const problems = [];
    if (document.documentElement.scrollWidth > innerWidth) problems.push(`the page is ${document.documentElement.scrollWidth} wide`);
    for (const stage of document.querySelectorAll(".stage")) {
      const box = stage.getBoundingClientRect();
      const lines = [...stage.querySelectorAll("path")].filter((path) => path.getAttribute("stroke-width") === "3").map((path) => path.getBoundingClientRect()).filter((at) => at.width);
      if (!lines.length) problems.push("a view without bodies");
      if (lines.some((at) => at.left < box.left || at.right > box.right || at.top < box.top || at.bottom > box.bottom)) problems.push("a view's bodies leave its picture");
    }
    const plots = [...document.querySelectorAll(".plot-holder")];
    if (!plots.length) problems.push("no plot at all");
    for (const plot of plots) {
      const name = plot.getAttribute("aria-label").slice(0, 50);
      const svg = plot.querySelector("svg.main-svg");
      const box = svg?.getBoundingClientRect();
      if (!box || box.width < 150 || box.height < 80) { problems.push(`not drawn: ${name}`); continue; }
      if (box.right > plot.getBoundingClientRect().right + 1) problems.push(`wider than its place: ${name}`);
      const inner = plot.querySelector(".nsewdrag")?.getBoundingClientRect();
      if (!inner || inner.width < 110 || inner.height < 36) problems.push(`hardly any room to draw (${inner?.width} x ${inner?.height}): ${name}`);
      for (const text of plot.querySelectorAll("svg.main-svg text")) {
        const at = text.getBoundingClientRect();
        if (at.width && (at.left < box.left - 1.5 || at.right > box.right + 1.5 || at.top < box.top - 1.5 || at.bottom > box.bottom + 1.5)) {
          problems.push(`text cut off: '${text.textContent.slice(0, 40)}' in ${name}`);
        }
      }
      const key = plot.querySelector(".colorbar, .subplot.x2y2");
      if (plot.querySelector(".heatmaplayer .hm")) {
        const a = key?.getBoundingClientRect(), b = plot.querySelector(".nsewdrag").getBoundingClientRect();
        if (!a || (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1)) problems.push(`a map without a key to its colours, or with the key on it: ${name}`);
      }
      const labels = [...plot.querySelectorAll(".xaxislayer-above .xtick, .ytick, .g-xtitle, .annotation .annotation-text-g")].map((one) => [one.textContent, one.getBoundingClientRect()]).filter(([, at]) => at.width);
      labels.forEach(([text, a], i) => labels.slice(i + 1).forEach(([other, b]) => {
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), tall = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (wide > 2 && tall > 3) problems.push(`'${text.slice(0, 30)}' and '${other.slice(0, 30)}' overlap in ${name}`);
      }));
    }
    return problems;
  });
  for (const problem of found) expect(false, `${label}: ${problem}`);
}

async function everyKind(width, dark) {
  const { page, label, close } = await open("every-kind", { width, dark });
  await drawAll(page);
  await looksWhole(page, label);
  await page.screenshot({ path: path.join(pictures, `${width}-${dark ? "dark" : "light"}-top.png`) });
  await page.screenshot({ path: path.join(pictures, `${width}-${dark ? "dark" : "light"}.png`), fullPage: true });
  const shown = await page.evaluate(() => ({
    dark: document.documentElement.dataset.theme, plots: window.__boresight.plots(), drawn: window.__boresight.drawn(),
    titled: [...document.querySelectorAll("figure")].every((one) => one.getAttribute("aria-label")),
    named: [...document.querySelectorAll("button")].every((one) => (one.textContent.trim() || one.getAttribute("aria-label"))),
  }));
  expect(shown.dark === (dark ? "dark" : "light"), `${label}: follows the system's colours`);
  expect(shown.plots === 24 && shown.drawn === shown.plots, `${label}: draws all 20 plots and 4 views, found ${shown.drawn} of ${shown.plots}`);
  expect(shown.titled && shown.named, `${label}: every figure and button has a name`);
  await close();
}

async function interaction() {
  const { page, label, close } = await open("every-kind", { width: 1440 });
  const traces = (figure) => page.locator(`figure[aria-label="${figure}"] .scatterlayer .trace`).count();
  await drawAll(page);

  const before = await traces("Position error of the platform");
  const key = page.locator('figure[aria-label="Position error of the platform"] .key', { hasText: "multibody" });
  await key.click();
  expect(await key.getAttribute("aria-pressed") === "false" && await traces("Position error of the platform") === before - 1, `${label}: the legend hides a series`);
  await key.click();
  expect(await traces("Position error of the platform") === before, `${label}: the legend shows it again`);

  const shared = "Journal orbits and offsets at six clearances";
  const all = await traces(shared);
  const sharedKey = page.locator(`figure[aria-label="${shared}"] .key`, { hasText: "F2" });
  await sharedKey.focus();
  await page.keyboard.press("Enter");
  expect(await traces(shared) === all - 6, `${label}: the shared legend hides a series in all six panels, by keyboard`);
  await page.keyboard.press("Enter");
  await sharedKey.dblclick();
  expect(await traces(shared) === 6, `${label}: a double click shows a series alone, found ${await traces(shared)} curves`);
  await sharedKey.dblclick();
  expect(await traces(shared) === all, `${label}: another double click shows all, found ${await traces(shared)} of ${all} curves`);

  // Zooming by keyboard: one panel takes its neighbours with it, and the whole range comes back.
  const ranges = () => page.evaluate((name) => [...document.querySelectorAll(`figure[aria-label="${name}"] .plot-area`)].map((one) => one._fullLayout.xaxis.range.map((v) => v.toFixed(3)).join()), shared);
  const whole = await ranges();
  await page.locator(`figure[aria-label="${shared}"] .plot-holder`).first().focus();
  await page.keyboard.press("+");
  const zoomed = await ranges();
  expect(zoomed[0] !== whole[0] && new Set(zoomed).size === 1, `${label}: panels zoom together: ${zoomed}`);
  const back = page.locator(`figure[aria-label="${shared}"] button`, { hasText: "Whole range" });
  expect(await back.isVisible(), `${label}: a zoomed chart offers its whole range`);
  await back.click();
  expect((await ranges()).join(" ") === whole.join(" "), `${label}: the whole range comes back: ${await ranges()} of ${whole}`);

  // Zooming by mouse.
  await page.locator('figure[aria-label="Position error of the platform"]').scrollIntoViewIfNeeded();
  const area = await page.locator('figure[aria-label="Position error of the platform"] .nsewdrag').boundingBox();
  await page.mouse.move(area.x + area.width * 0.3, area.y + area.height * 0.5);
  await page.waitForTimeout(200);
  await page.screenshot({ path: path.join(pictures, "1440-hover.png") });
  expect(await page.locator(".hoverlayer .hovertext, .hoverlayer .legend").count() > 0, `${label}: hovering shows values`);
  await page.mouse.down();
  await page.mouse.move(area.x + area.width * 0.6, area.y + area.height * 0.5, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(400);
  const span = await page.evaluate(() => { const [from, to] = document.querySelector('figure[aria-label="Position error of the platform"] .plot-area')._fullLayout.xaxis.range; return to - from; });
  expect(span > 0.2 && span < 0.4, `${label}: dragging zooms to what was dragged over, found ${span}`);

  await page.locator('figure[aria-label="Error of what rests"]').scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector('figure[aria-label="Error of what rests"] .plot-area')._fullLayout);
  const level = await page.evaluate(() => document.querySelector('figure[aria-label="Error of what rests"] .plot-area')._fullLayout.yaxis.range.map((v) => v.toFixed(4)).join());
  expect(level === "0.0950,0.1050", `${label}: rounding is drawn level, found the range ${level}`);

  // Keyboard: every stop of the tab key is visible, and there are no traps.
  await page.reload();
  await page.evaluate(() => window.__boresightReady);
  const stops = [];
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press("Tab");
    stops.push(await page.evaluate(() => {
      const one = document.activeElement;
      const box = one.getBoundingClientRect();
      return { name: one.className || one.tagName, seen: box.width > 0 && box.left >= 0 && getComputedStyle(one).outlineStyle !== "none" };
    }));
  }
  expect(stops[0].name === "skip", `${label}: the first stop skips to the report`);
  expect(stops.every((stop) => stop.seen), `${label}: focus is visible at each stop, not at ${stops.filter((stop) => !stop.seen).map((stop) => stop.name)}`);
  expect(stops.some((stop) => stop.name === "key") && stops.some((stop) => stop.name === "plot-holder"), `${label}: the tab key reaches legends and plots`);

  // Tables sort, and show the rest when asked.
  const cells = (figure, column) => page.locator(`figure[aria-label="${figure}"] tbody tr td:nth-child(${column})`).allTextContents();
  const heading = page.locator('figure[aria-label="Contacts by joint"] th button', { hasText: "Impacts" });
  await heading.click();
  expect((await cells("Contacts by joint", 1)).join() === "F2,F1,F3", `${label}: a table sorts up`);
  await heading.click();
  expect((await cells("Contacts by joint", 1)).join() === "F3,F1,F2", `${label}: a table sorts down`);
  expect((await cells("Contacts by joint", 4)).includes("1.235\u202f×\u202f10⁻⁶"), `${label}: numbers have four significant digits: ${await cells("Contacts by joint", 4)}`);
  expect((await cells("Every sample", 1)).length === 25, `${label}: a long table begins short`);
  await page.getByRole("button", { name: "Show all 80 rows" }).click();
  expect((await cells("Every sample", 1)).length === 80, `${label}: a long table shows all when asked`);

  // Downloads: data and pictures of each kind.
  for (const [figure, tool, least] of [["Position error of the platform", "CSV", 100000], ["Position error of the platform", "PNG", 20000], [shared, "PNG", 60000], ["Contact states", "PNG", 8000],
    ["Error over clearance and speed", "PNG", 20000], ["Which scatter matters", "PNG", 15000], ["Contact states", "CSV", 500], ["Contacts by joint", "CSV", 100]]) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`figure[aria-label="${figure}"] .tool`, { hasText: tool }).click()]);
    const file = path.join(pictures, download.suggestedFilename());
    await download.saveAs(file);
    expect(fs.statSync(file).size > least, `${label}: ${tool} of '${figure}' holds something (${fs.statSync(file).size} bytes)`);
  }
  const saved = fs.readFileSync(path.join(pictures, "contacts-by-joint.csv"), "utf8");
  expect(saved.startsWith("Joint,Impacts,Contact (%),Penetration (m)") && saved.includes("0.0000012345678"), `${label}: the CSV holds the numbers in full`);

  // The toggle turns page and charts; what is off screen follows when it is drawn.
  await page.evaluate(() => scrollTo(0, 0));
  await page.getByRole("button", { name: "Dark colours" }).click();
  await settle(page);
  await drawAll(page);
  const grounds = await page.evaluate(() => [...document.querySelectorAll(".plot-area")].map((one) => one._fullLayout.paper_bgcolor));
  expect(new Set(grounds).size === 1 && grounds[0] === "#1a2029", `${label}: all charts follow the toggle: ${[...new Set(grounds)]}`);

  // Narrower window: charts follow.
  await page.setViewportSize({ width: 700, height: 900 });
  await page.waitForTimeout(250);
  await drawAll(page);
  await looksWhole(page, `${label} narrowed to 700`);
  await close();
}

// The view: still where motion is not wanted, moving where it is; slider, mouse and keys change what is drawn.
async function moving() {
  const { page, label, close } = await open("every-kind", { width: 1440, still: true });
  await drawAll(page);
  const view = page.locator('figure[aria-label="The mechanism in motion"]');
  const stage = view.locator(".stage");
  await stage.scrollIntoViewIfNeeded();
  const drawing = () => stage.evaluate((one) => [...one.querySelectorAll("path")].map((path) => path.getAttribute("d")).join());
  // How wide the joint's play is drawn, in pixels.
  const ring = () => stage.evaluate((one) => [...one.querySelectorAll("path")].find((path) => path.getAttribute("stroke-width") === "1.8").getBBox().width);
  await page.waitForTimeout(300);
  const first = await drawing();
  await page.waitForTimeout(200);
  expect(await drawing() === first, `${label}: nothing moves by itself where the reader wants no motion`);

  // Keys turn it, and turn it back.
  await stage.focus();
  for (const key of ["ArrowLeft", "ArrowUp", "+"]) {
    const before = await drawing();
    await page.keyboard.press(key);
    expect(await drawing() !== before, `${label}: ${key} changes the view`);
  }
  expect(await view.getByRole("button", { name: "Turn back" }).isVisible(), `${label}: a turned view can be turned back`);
  await page.keyboard.press("0");
  expect(await drawing() === first, `${label}: 0 turns the view back`);

  // The slider: twice the exaggeration, twice the play; its value is written out.
  const slider = view.getByRole("slider", { name: "Exaggeration of the deviation" });
  const setTo = (times) => slider.evaluate((one, value) => { one.value = String(Math.log10(value)); one.dispatchEvent(new Event("input", { bubbles: true })); }, times);
  await setTo(100);
  const at100 = await ring();
  expect((await view.locator(".controls output").last().textContent()).endsWith("100"), `${label}: the exaggeration is written out`);
  expect(await slider.getAttribute("aria-valuetext") === "100 times", `${label}: the slider says its value`);
  expect((await view.locator(".note").textContent()).includes("0.1\u2009mm, drawn as 10\u2009mm"), `${label}: what 0.1 mm is drawn as: ${await view.locator(".note").textContent()}`);
  await setTo(400);
  const at400 = await ring();
  expect(at400 > 2 * at100, `${label}: four times the exaggeration draws a ring more than twice as wide, found ${at100} and ${at400} pixels`);
  await slider.focus();
  const before = await drawing();
  await page.keyboard.press("ArrowLeft");
  expect(await drawing() !== before, `${label}: the slider answers to the keyboard`);

  // Time, drag, legend.
  const time = view.getByRole("slider", { name: "Time" });
  await time.evaluate((one) => { one.value = "20"; one.dispatchEvent(new Event("input", { bubbles: true })); });
  expect((await view.locator(".controls output").first().textContent()).startsWith("1.00"), `${label}: the time is written out: ${await view.locator(".controls output").first().textContent()}`);
  const place = await stage.boundingBox();
  const still = await drawing();
  await page.mouse.move(place.x + 300, place.y + 200);
  await page.mouse.down();
  await page.mouse.move(place.x + 380, place.y + 230, { steps: 3 });
  await page.mouse.up();
  expect(await drawing() !== still, `${label}: dragging turns the view`);
  await view.getByRole("button", { name: "Turn back" }).click();
  expect(await drawing() === still, `${label}: the button turns it back`);
  await view.locator(".key", { hasText: "ideal" }).click();
  expect(await drawing() !== still, `${label}: the legend hides the ideal mechanism`);

  // Play and pause, by button and by the space bar.
  await view.getByRole("button", { name: "Play the motion" }).click();
  const playing = await drawing();
  await page.waitForTimeout(400);
  expect(await drawing() !== playing, `${label}: it plays`);
  await stage.focus();
  await page.keyboard.press(" ");
  expect(await view.getByRole("button", { name: "Play the motion" }).isVisible(), `${label}: the space bar pauses`);
  const paused = await drawing();
  await page.waitForTimeout(200);
  expect(await drawing() === paused, `${label}: paused, it rests`);

  const [download] = await Promise.all([page.waitForEvent("download"), view.locator(".tool", { hasText: "PNG" }).click()]);
  await download.saveAs(path.join(pictures, "view.png"));
  expect(fs.statSync(path.join(pictures, "view.png")).size > 15000, `${label}: the picture holds something`);
  const rest = page.locator('figure[aria-label="Without clearance"]');
  expect(await rest.getByRole("slider").count() === 0 && await rest.getByRole("button", { name: /Play/ }).count() === 0, `${label}: a view of one instant without deviation has nothing to play or exaggerate`);
  await close();

  const live = await open("every-kind", { width: 390, dark: true });
  const other = live.page.locator('figure[aria-label="The mechanism in motion"] .stage');
  await other.scrollIntoViewIfNeeded();
  await live.page.waitForTimeout(300);
  const seen = () => other.evaluate((one) => one.innerHTML);
  const then = await seen();
  await live.page.waitForTimeout(300);
  expect(await seen() !== then, `${live.label}: it plays by itself in sight`);
  await live.page.emulateMedia({ media: "print" });
  await live.page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const printed = await seen();
  await live.page.waitForTimeout(300);
  expect(await seen() === printed, `${live.label}: paper has one still picture`);
  await live.close();
}

async function printing() {
  const { page, label, close } = await open("every-kind", { width: 1440, dark: true });
  await page.pdf({ path: path.join(pictures, "print.pdf"), format: "A4", preferCSSPageSize: false });
  const after = await page.evaluate(() => ({ drawn: document.querySelectorAll('.plot-holder[data-drawn="true"]').length, theme: document.documentElement.dataset.theme, printing: document.documentElement.className }));
  expect(after.drawn === 20, `${label}: everything is drawn before printing, found ${after.drawn}`);
  expect(after.theme === "dark" && !after.printing, `${label}: the page is as before after printing`);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: 690, height: 1000 });
  await settle(page);
  await looksWhole(page, `${label} on paper`);
  await page.screenshot({ path: path.join(pictures, "print.png"), fullPage: true });
  const grounds = await page.evaluate(() => [...new Set([...document.querySelectorAll(".plot-area")].map((one) => one._fullLayout.paper_bgcolor))].join());
  expect(grounds === "#ffffff", `${label}: paper is light: ${grounds}`);
  await close();
}

async function hostile() {
  const { page, label, close } = await open("hostile", { width: 390 });
  await drawAll(page);
  await looksWhole(page, label);
  const seen = await page.evaluate(() => ({ title: document.title, heading: document.querySelector("h1").textContent, bold: document.querySelectorAll("main b").length, texts: [...document.querySelectorAll("svg text")].map((one) => one.textContent).join("\n") }));
  expect(seen.title.startsWith("</script><script>document.title='broken'"), `${label}: the title is text: ${seen.title}`);
  expect(seen.heading.includes('<b>bold</b> & <!--') && seen.bold === 0, `${label}: the heading is text: ${seen.heading}`);
  expect(seen.texts.includes("<b>bold</b>"), `${label}: plots show text, not markup`);
  await page.screenshot({ path: path.join(pictures, "hostile.png"), fullPage: true });
  await close();
}

async function manyCharts() {
  const { page, label, opened, close } = await open("many", { width: 1440 });
  const first = await page.evaluate(() => window.__boresight.drawn());
  expect(first >= 2 && first <= 8, `${label}: opening draws what is near the window only, found ${first} of 30`);
  expect(opened < 8000, `${label}: opens in a moment, found ${opened} ms`);
  await page.evaluate(() => scrollTo({ top: document.documentElement.scrollHeight, behavior: "instant" }));
  await page.waitForFunction(() => [...document.querySelectorAll(".plot-holder")].pop().dataset.drawn === "true", null, { timeout: 8000 });
  expect(await page.evaluate(() => window.__boresight.drawn()) < 30, `${label}: what was jumped over stays undrawn`);
  expect(await page.locator(".contents a[aria-current]").textContent() === "Part 3", `${label}: the contents follow the reader`);
  console.log(`30 charts of 3 x 4000 points: ${(fs.statSync(files.many).size / 1e6).toFixed(1)} MB, ready after ${opened} ms`);
  await close();
}

async function withoutScript() {
  const { page, label, close } = await open("every-kind", { width: 1440, javaScriptEnabled: false });
  expect((await page.locator("noscript").textContent()).includes("The requirement is not met"), `${label}: the verdict is there without scripts`);
  await close();
}

try {
  await everyKind(1440, false);
  await everyKind(390, true);
  await interaction();
  await moving();
  await printing();
  await hostile();
  await manyCharts();
  await withoutScript();
} finally {
  await browser.close();
}
console.log(failures ? `${failures} failed` : `all holds; pictures in ${path.basename(pictures)}`);
process.exit(failures ? 1 : 0);
