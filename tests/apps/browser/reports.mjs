// Every verb's own report, made by real runs in a folder of its own, in headless Chromium, wide and narrow, light and dark: nothing on the
// console, every chart drawn, nothing that axe-core has against it (contrast, names, roles), and every stop of the tab key visible.
//   node reports.mjs PROGRAM EXAMPLES NPM_FOLDER WORK_FOLDER [--all]
// One report of each verb, and of a run's tools and its errors; --all: those of other scenes and methods too, whose pages are made of the same parts.
// Exit 0: all holds; 1: something does not, each said on one line. The browser is $BORESIGHT_CHROMIUM, or chromium from the PATH.
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [program, examples, npm, work] = process.argv.slice(2, 6).map((one) => path.resolve(one));
const all = process.argv.includes("--all");
const require = createRequire(path.join(npm, "package.json"));
const { chromium } = require("playwright-core");
const axe = fs.readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

function chromiumPath() {
  if (process.env.BORESIGHT_CHROMIUM) return process.env.BORESIGHT_CHROMIUM;
  const places = (process.env.PATH ?? "").split(path.delimiter);
  return places.flatMap((folder) => ["chromium", "chromium-browser", "google-chrome"].map((name) => path.join(folder, name))).find((file) => fs.existsSync(file));
}

// One line for each kind of report; antenna is what `boresight new` writes. As small as their charts allow.
const scene = path.join(examples, "3-rrcpr");
const commands = {
  check: ["check", "antenna/mechanism.toml"],
  run: ["run", "antenna/mechanism.toml", "--compare"],
  "run-nonlinear": ["run", path.join(examples, "flores-slider-crank", "flores-slider-crank.toml"), "--rung", "perturbation", "--set", "motion.duration=0.6s", "--nonlinear", "12 ms", "--sample", "0.2 ms"],
  "run-3-rrcpr": ["run", path.join(scene, "3-rrcpr.toml"), "--rung", "perturbation"],
  "run-errors": ["run", path.join(scene, "tolerances.toml"), "--rung", "perturbation", "--set", "error.*.length=20um", "--set", "error.A3.zero=0.1mrad", "--set", "error.rod1.warming=5K"],
  "run-errors-exactly": ["run", path.join(examples, "altaz-gimbal", "altaz-gimbal.toml"), "--set", "error.*=0.1mrad"],
  sweep: ["sweep", "antenna/sweep.toml"],
  "sweep-3-rrcpr": ["sweep", path.join(scene, "clearance-sweep.toml"), "--rung", "perturbation"],
  chart: ["chart", "antenna/mechanism.toml", "--time", "5 s"],
  stability: ["stability", "antenna/mechanism.toml"],
  montecarlo: ["montecarlo", "antenna/montecarlo.toml"],
  sensitivity: ["sensitivity", "antenna/sensitivity.toml"],
  "sensitivity-morris": ["sensitivity", "antenna/morris.toml"],
  "sensitivity-shapley": ["sensitivity", "antenna/shapley.toml"],
  match: ["match", "antenna/match.toml"],
  allocate: ["allocate", "antenna/allocate.toml"],
  budget: ["budget", "antenna/budget.toml"],
  "budget-errors": ["budget", "errors-budget.toml", "--rung", "quasistatic"],
  calibrate: ["calibrate", "antenna/calibrate.toml"],
  laws: ["laws"],
};

const further = ["run-3-rrcpr", "run-errors-exactly", "sweep-3-rrcpr", "sensitivity-morris", "sensitivity-shapley", "budget-errors"];
if (!all) for (const name of further) delete commands[name];

let failures = 0;
function expect(holds, what) {
  if (holds) return;
  ++failures;
  console.log(`FAILED: ${what}`);
}

fs.rmSync(work, { recursive: true, force: true });
fs.mkdirSync(work, { recursive: true });
const call = (...words) => spawnSync(program, words, { cwd: work, encoding: "utf8" });
expect(call("new", "antenna").status === 0, "boresight new antenna");
// The example of --help says what else has to be given first.
const examplesOf = (verb) => call(verb, "--help").stdout.split("Example")[1].split("\n").filter((line) => line.startsWith("  boresight ")).map((line) => line.match(/"[^"]*"|\S+/g).slice(1).map((word) => word.replaceAll('"', "")));
// The other ways of sensitivity: the same study with another table.
const study = fs.readFileSync(path.join(work, "antenna", "sensitivity.toml"), "utf8").split("[sensitivity]")[0];
const correlation = '[[correlation]]\nparameters = ["clearance.elevation.radial", "payload.mass"]\ncoefficient = 0.4\n';
fs.writeFileSync(path.join(work, "antenna", "morris.toml"), `${study}[sensitivity]\nmethod = "morris"\nsamples = 16\n`);
fs.writeFileSync(path.join(work, "antenna", "shapley.toml"), `${study}${correlation}[sensitivity]\nmethod = "shapley"\nsamples = 64\n`);
const errors = fs.readFileSync(path.join(scene, "tolerances-budget.toml"), "utf8");
fs.writeFileSync(path.join(work, "errors-budget.toml"), errors.replace('"tolerances.toml"', JSON.stringify(path.join(scene, "tolerances.toml"))).replace("members = 200", "members = 40").replace("attribution = 40", "attribution = 10"));
const reports = [];
const seconds = (since) => ((performance.now() - since) / 1000).toFixed(1);
for (const [name, words] of Object.entries(commands)) {
  const begun = performance.now();
  for (const before of examplesOf(words[0]).slice(0, -1)) call(...before);
  const ended = call(...words, "--out", name);
  expect(ended.status === 0 || ended.status === 1, `${words.join(" ")}: status ${ended.status}: ${ended.stderr}`);
  console.log(`${name}: computed in ${seconds(begun)} s`);
  const report = path.join(work, name, "report.html");
  if (fs.existsSync(report)) reports.push([name, report]);
  else expect(false, `${words.join(" ")} leaves no report`);
}

const browser = await chromium.launch({ executablePath: chromiumPath(), headless: true, args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"] });

async function look(name, report, { width, dark }) {
  const label = `${name} ${width} ${dark ? "dark" : "light"}`;
  // The page's policy forbids foreign scripts, and axe-core is one.
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme: dark ? "dark" : "light", reducedMotion: "reduce", bypassCSP: true });
  const page = await context.newPage();
  const noise = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) noise.push(message.text()); });
  page.on("pageerror", (error) => noise.push(String(error)));
  page.on("request", (request) => { if (!/^(file|data|blob):/.test(request.url())) noise.push(`request to ${request.url()}`); });
  await page.goto(pathToFileURL(report).href);
  await page.evaluate(() => window.__boresightReady);
  await page.evaluate(() => window.__boresight.drawAll());
  await page.waitForTimeout(60);

  const seen = await page.evaluate(() => ({
    plots: window.__boresight.plots(), drawn: window.__boresight.drawn(), wide: document.documentElement.scrollWidth,
    unsaid: [...document.querySelectorAll("main td, main dd, main p, svg text")].filter((one) => /\b(NaN|undefined|null|Infinity)\b/.test(one.textContent)).map((one) => one.textContent.slice(0, 60)),
    cut: [...document.querySelectorAll(".plot-holder")].flatMap((plot) => {
      const box = plot.querySelector("svg.main-svg")?.getBoundingClientRect();
      if (!box || box.width < 150 || box.height < 80) return [`not drawn: ${plot.getAttribute("aria-label").slice(0, 50)}`];
      return [...plot.querySelectorAll("svg.main-svg text")].filter((text) => {
        const at = text.getBoundingClientRect();
        return at.width && (at.left < box.left - 1.5 || at.right > box.right + 1.5 || at.top < box.top - 1.5 || at.bottom > box.bottom + 1.5);
      }).map((text) => `cut off: '${text.textContent.slice(0, 40)}'`);
    }),
  }));
  expect(seen.drawn === seen.plots, `${label}: draws ${seen.drawn} of ${seen.plots}`);
  expect(seen.wide <= width, `${label}: the page is ${seen.wide} wide`);
  for (const one of [...new Set(seen.cut)]) expect(false, `${label}: ${one}`);
  for (const one of seen.unsaid) expect(false, `${label}: says '${one}'`);

  await page.evaluate(axe);
  // Names, roles and order are the same in every width and colour: the second look is at what these decide.
  const rules = dark && !all ? { runOnly: ["color-contrast", "scrollable-region-focusable", "link-in-text-block"] } : {};
  const { violations } = await page.evaluate((rules) => window.axe.run(document, { resultTypes: ["violations"], ...rules }), rules);
  for (const one of violations)
    expect(false, `${label}: ${one.id} (${one.impact}), ${one.nodes.length} times: ${one.nodes[0].html.slice(0, 120)} ${one.nodes[0].any.map((check) => check.message).join(" ").slice(0, 160)}`);

  if (width > 1000) { // from the first stop of the tab key to the last, and no trap on the way
    await page.evaluate(() => scrollTo(0, 0));
    const stops = await page.evaluate(() => [...document.querySelectorAll("a[href], button, input, summary, [tabindex='0']")].filter((one) => one.checkVisibility() && !one.disabled && one.tabIndex >= 0).length);
    let unseen = [], reached = new Set();
    for (let i = 0; i < stops; ++i) {
      await page.keyboard.press("Tab");
      const stop = await page.evaluate(() => {
        const one = document.activeElement, box = one.getBoundingClientRect();
        one.dataset.stop ??= String(Math.random());
        return { key: one.dataset.stop, name: one.getAttribute("aria-label") ?? (one.textContent.trim() || one.className), seen: box.width > 0 && getComputedStyle(one).outlineStyle !== "none" };
      });
      reached.add(stop.key);
      if (!stop.seen) unseen.push(stop.name.slice(0, 40));
    }
    expect(reached.size >= stops - 1, `${label}: the tab key reaches ${reached.size} of ${stops} stops`);
    expect(unseen.length === 0, `${label}: focus is not visible at ${[...new Set(unseen)].slice(0, 4).join(", ")}`);
  }
  if (all) await page.screenshot({ path: path.join(work, `${name}-${width}.png`), fullPage: true });
  expect(noise.length === 0, `${label}: the console is quiet, but: ${noise.slice(0, 3).join(" | ")}`);
  await context.close();
}

try {
  for (const [name, report] of reports) {
    const begun = performance.now();
    await look(name, report, { width: 1280, dark: false });
    await look(name, report, { width: 390, dark: true });
    console.log(`${name}: looked at in ${seconds(begun)} s`);
  }
} finally {
  await browser.close();
}
console.log(failures ? `${failures} failed` : `${reports.length} reports hold${all ? `; pictures in ${path.basename(work)}` : ""}`);
process.exit(failures ? 1 : 0);
