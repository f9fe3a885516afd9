// SPDX-License-Identifier: Apache-2.0
// Chromium and Firefox, and actions of tests on the page.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { dirname, join, relative } from "node:path";

const BROWSERS = [
  ["chromium", "chrome", process.env.CHROMIUM || "chromium"],
  ["firefox", "firefox", process.env.FIREFOX || "firefox-esr"],
];

const MOST_WAITS = 3000; // of 20 ms: what does not come by then never does

/** Starts the installed browsers: [{name, browser, downloads}]. */
export async function startBrowsers(puppeteer, folder) {
  const started = [];
  for (const [name, kind, program] of BROWSERS) {
    const found = spawnSync("sh", ["-c", 'command -v "$0"', program], { encoding: "utf8" }).stdout.trim();
    if (!found) {
      console.log(`skipped: ${name} is not installed`);
      continue;
    }
    const downloads = mkdtempSync(join(folder, `${name}_`));
    const browser = await puppeteer.launch({
      browser: kind,
      executablePath: found,
      args: kind === "chrome" ? ["--no-sandbox", "--disable-gpu"] : [],
      extraPrefsFirefox: {
        "browser.download.folderList": 2,
        "browser.download.dir": downloads,
        "browser.download.useDownloadDir": true,
        "browser.download.always_ask_before_handling_new_types": false,
      },
    });
    if (kind === "chrome") {
      const session = await browser.target().createCDPSession();
      await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads });
    }
    started.push({ name, browser, downloads });
  }
  return started;
}

/** A fresh page. It records its requests and errors. */
export async function open(one, url, { width = 1280, height = 900, scheme = "light" } = {}) {
  const page = await one.browser.newPage();
  page.requests = [];
  page.complaints = [];
  page.on("request", (request) => page.requests.push(request.url()));
  page.on("console", (message) => page.complaints.push(message.text()));
  page.on("pageerror", (error) => page.complaints.push(String(error)));
  await page.setViewport({ width, height });
  await page.goto(url);
  if (scheme === "dark")
    await page.evaluate(() => document.querySelector('.theme input[value="dark"]').click());
  return page;
}

export async function ended(page) {
  await page.waitForFunction(
    () => document.getElementById("progress").hidden && document.getElementById("status").textContent !== "",
    { timeout: 120000 },
  );
  return page.$eval("#status", (element) => element.textContent);
}

/** Waits until something holds. */
export async function until(words, holds) {
  for (let i = 0; !holds(); ++i) {
    if (i === MOST_WAITS) throw new Error(`there is no ${words}`);
    await new Promise((done) => setTimeout(done, 20));
  }
}

/** Chooses files or a folder, and waits for the end. */
export async function choose(page, field, ...paths) {
  const input = await page.$(`#${field}`);
  await page.$eval("#status", (element) => {
    element.textContent = "";
  });
  await input.uploadFile(...paths);
  return ended(page);
}

/**
 * Chooses a folder. WebDriver does not set fields of folders in Firefox: there the page gets files that say
 * of themselves what those of such a field do.
 */
export async function chooseFolder(one, page, folder) {
  if (one.name === "chromium") return choose(page, "folder", folder);
  const files = readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
    .map((path) => [relative(dirname(folder), path), readFileSync(path, "base64")]);
  await page.evaluate((all) => {
    document.getElementById("status").textContent = "";
    const transfer = new DataTransfer();
    for (const [path, text] of all) {
      const bytes = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
      transfer.items.add(new File([bytes], path.split("/").pop()));
    }
    const field = document.getElementById("folder");
    field.files = transfer.files;
    [...field.files].forEach((file, i) =>
      Object.defineProperty(file, "webkitRelativePath", { value: all[i][0] }),
    );
    field.dispatchEvent(new Event("change"));
  }, files);
  return ended(page);
}

/** Drops files made in the page, [[name, base64]]. */
export async function drop(page, files) {
  await page.evaluate(
    (all) => {
      document.getElementById("status").textContent = "";
      const transfer = new DataTransfer();
      for (const [name, text] of all) {
        transfer.items.add(new File([Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0))], name));
      }
      document
        .getElementById("drop")
        .dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: transfer }));
    },
    files.map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")]),
  );
  return ended(page);
}

/** Unfolds every asset and shows all its findings. */
export async function unfold(page) {
  await page.evaluate(() => {
    for (const one of document.querySelectorAll("#list details.asset")) one.open = true;
  });
  await page.waitForFunction(() =>
    [...document.querySelectorAll("#list details.asset")].every((one) => one.querySelector(".body")),
  );
  await page.evaluate(() => {
    for (const more of document.querySelectorAll(".findings + button")) while (!more.hidden) more.click();
  });
}

/** Presses a button and gives the file that is downloaded: {name, bytes}. */
export async function download(one, page, button) {
  rmSync(one.downloads, { recursive: true, force: true });
  mkdirSync(one.downloads);
  await page.click(button);
  let got = null;
  await until(`a file from ${button}`, () => {
    const names = existsSync(one.downloads) ? readdirSync(one.downloads) : [];
    if (names.length !== 1 || /\.(crdownload|part|tmp)$|^\.org\.chromium/.test(names[0])) return false;
    got = { name: names[0], bytes: readFileSync(join(one.downloads, names[0])) };
    return got.bytes.length > 0;
  });
  return got;
}
