// The crawl of the walk can fail: each kind of fault, planted in each place where a page says something.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { startBrowser } from "../harness/browser.mjs";
import { faultsOfWords, rememberPaint, wordsOf } from "../harness/crawl.mjs";
import { overlapsOf } from "../harness/reach.mjs";

let browser;
before(async () => { browser = await startBrowser(); });
after(() => browser?.close());

const kAllowed = ["TP-01", "A-103", "iGPS", "kN", /JO-\d+/];
const judged = (text, language) => faultsOfWords([{ text, language, where: "p" }], kAllowed).map((fault) => fault.split(" in ")[0]);

for (const [language, text, found] of [
  ["en", "Stop measured at station 2, 12:30:01, driven 3.4\u00a0m since", []],
  ["en", "TP-01 carries A-103, 182.4 kN, in the iGPS cell (JO-12)", []],
  ["zh", "TP-01 正驶往 2 号站，JO-12，承载 A-103，x 12.3 m，182.4 kN", []],
  ["en", "goal_blocked", ["a code"]],
  ["en", "ST02_F", ["a code"]],
  ["en", "reports driveFault", ["a program's name"]],
  ["en", "State: AllowedToStart", ["a program's name"]],
  ["en", "Held by {{vehicle}}", ["a hole"]],
  ["en", "NaN mm", ["no value", "a program's name"]],
  ["en", "undefined", ["no value"]],
  ["en", "[object Object]", ["no value"]],
  ["en", "resume.title", ["a key"]],
  ["en", "words:link.gone", ["a key"]],
  ["en", "Vehicle 停止", ["Chinese"]],
  ["en", "Held by TP-01。", ["Chinese"]],
  ["zh", "前轮 front drive", ["English"]],
  ["zh", "被 TP-01 held", ["English"]],
  ["zh", "TP-011", ["English"]],
  ["zh", "servo_overload", ["a code", "English"]],
]) {
  test(`${language} "${text}": ${found.join(", ") || "nothing"}`, () => assert.deepEqual(judged(text, language), found));
}

test("a page is read in all its places, what is hidden or painted over is not, and a part may declare its language", async () => {
  const page = await browser.newPage();
  await page.addInitScript(rememberPaint);
  await page.goto("about:blank");
  await page.setContent(`<html lang="en"><head><title>in_title</title></head><body>
    <p>in_text</p><p hidden>in_hidden</p><p style="visibility: hidden">in_invisible</p>
    <button aria-label="in_label" title="in_tip"></button><input placeholder="in_placeholder"><img alt="in_alt">
    <select><option>in_option</option></select><table><td data-label="in_cell"></td></table>
    <svg><text>in_drawing</text></svg><button lang="zh-CN">中文</button><canvas width="90" height="90"></canvas></body></html>`);
  await page.evaluate(() => {
    const canvas = document.querySelector("canvas"), g = canvas.getContext("2d");
    const behind = document.createElement("canvas");
    behind.width = behind.height = 90;
    behind.getContext("2d").fillText("in_hall", 9, 9);
    g.fillText("in_last_frame", 9, 9);
    g.drawImage(behind, 0, 0);
    g.fillText("in_frame", 9, 9);
    g.strokeText("in_outline", 9, 9);
  });
  const words = await wordsOf(page);
  const found = faultsOfWords(words).map((fault) => fault.match(/"(\w+)"/)[1]);
  assert.deepEqual(found.sort(), ["alt", "cell", "drawing", "frame", "hall", "label", "option", "outline", "placeholder", "text", "tip", "title"].map((name) => `in_${name}`));
  assert.deepEqual(words.filter((word) => word.language === "zh").map((word) => word.text), ["中文"]);
  await page.context().close();
});

test("words that lie over each other are found; a panel that floats, a line below and what is cut away lie over nothing", async () => {
  const page = await browser.newPage();
  await page.setContent(`
    <div style="height: 20px; line-height: 20px; width: 90px">three lines of words here</div><p style="margin: 0">what to do</p>
    <p style="position: fixed; top: 0">a panel</p>
    <p>above</p><p style="line-height: 15px; margin: 0">one line<br>the next</p>
    <div style="height: 20px; overflow: hidden; width: 90px; line-height: 20px">cut away after one line</div><p style="margin: 0">after it</p>`);
  assert.deepEqual(await overlapsOf(page), ['"three lines of words here" lies over "what to do"']);
  await page.close();
});
