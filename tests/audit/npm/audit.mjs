// Audits a page with Lighthouse, at 1280x800, and prints what it found as JSON.
//   node audit.mjs FOLDER CHROMIUM URL FLAG...
// FOLDER holds node_modules, as scripts/npm-tools fetches it.

import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, chromePath, url, ...chromeFlags] = process.argv.slice(2);
const { resolve: find } = createRequire(resolve(folder, "package.json"));
const load = (name) => import(pathToFileURL(find(name)));

const { launch } = await load("chrome-launcher");
const { default: lighthouse, desktopConfig } = await load("lighthouse");

const CATEGORIES = ["accessibility", "best-practices", "performance"];
const SCREEN = { mobile: false, width: 1280, height: 800, deviceScaleFactor: 1, disabled: false };
// A page that shows live values is never idle; Lighthouse would wait for it for 45 s.
const LOAD_MS = 20_000;

const percent = (score) => Math.round(100 * score);

/** The audits of a category that cost points, with what they found. */
function faultsOf({ categories, audits }, category) {
  return categories[category].auditRefs
    .filter(({ id, weight }) => weight > 0 && audits[id].score !== null && audits[id].score < 1)
    .map(({ id }) => {
      const items = audits[id].details?.items ?? [];
      const places = items.map((item) => item.node?.snippet ?? item.description ?? item.url);
      return `${id}: ${[audits[id].displayValue, ...places].filter(Boolean).join(", ")}`;
    });
}

const chrome = await launch({ chromePath, chromeFlags, ignoreDefaultFlags: false });
try {
  const options = { port: chrome.port, logLevel: "error", onlyCategories: CATEGORIES };
  const { lhr } = await lighthouse(url, options, {
    ...desktopConfig,
    settings: { ...desktopConfig.settings, maxWaitForLoad: LOAD_MS, screenEmulation: SCREEN },
  });
  if (lhr.runtimeError) throw new Error(`${lhr.runtimeError.code}: ${lhr.runtimeError.message}`);
  const { audits } = lhr;
  console.log(JSON.stringify({
    scores: Object.fromEntries(CATEGORIES.map((id) => [id, percent(lhr.categories[id].score)])),
    faults: CATEGORIES.flatMap((id) => faultsOf(lhr, id)),
    shift: audits["cumulative-layout-shift"].numericValue,
    bytes: audits["total-byte-weight"].numericValue,
    requests: audits["network-requests"].details.items.map((item) => item.url),
  }));
} finally {
  chrome.kill();
}
