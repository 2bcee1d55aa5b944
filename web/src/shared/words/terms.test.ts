import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";

const src = fileURLToPath(new URL("../..", import.meta.url));

/** All texts of the Chinese catalogs: where they stand, and what they say. */
const texts: [where: string, text: string][] = [];
function collect(value: unknown, where: string): void {
  if (typeof value === "string") texts.push([where, value]);
  else for (const [key, item] of Object.entries(value as object)) collect(item, `${where}.${key}`);
}
for (const name of readdirSync(src, { recursive: true, encoding: "utf8" }).sort()) {
  const catalog = /(?:features\/(\w+)\/i18n|catalogs\/(\w+))\.zh\.json$/.exec(name);
  if (catalog) collect(JSON.parse(readFileSync(src + name, "utf8")), catalog[1] ?? catalog[2] ?? "");
}

interface Term {
  meaning: string;
  /** What it is called. */
  word: string;
  /** What it has been called elsewhere, and is called nowhere any more. */
  never: RegExp;
  /** Where one of those words means something else. */
  but?: RegExp;
}

const kTerms: Term[] = [
  { meaning: "a station", word: "站点", never: /站位|工位|车站/ },
  {
    meaning: "the station of a number",
    word: "3 号站",
    never: /站点 ?\{\{|(?<!号)站 ?\{\{|\}\}号站|号站点|第 ?\{\{(number|station)\}\} ?站/,
  },
  { meaning: "to send a vehicle", word: "发车", never: /发送|发往|派车|派送/ },
  { meaning: "to send a message to a vehicle", word: "下发", never: /发送|发出/ },
  { meaning: "to cancel an order, and a cancelled one", word: "取消", never: /撤回|撤销|终止|作废/ },
  { meaning: "an order that the fleet gave up", word: "中止", never: /终止|放弃/ },
  { meaning: "parking feet", word: "支脚", never: /驻车|支撑|支腿/ },
  { meaning: "data that comes late", word: "延迟", never: /迟到|滞后|延误/ },
  { meaning: "a vehicle that comes late", word: "晚", never: /迟到|晚点|逾期|延误/ },
  { meaning: "a station's vehicle stands inside tolerance", word: "就绪", never: /可发车|准备好/ },
  { meaning: "a command that waits for its second press", word: "已准备", never: /已就绪|待命|就绪，再/ },
  { meaning: "the stop at a station, which is measured", word: "停站", never: /停靠站|到站停车/ },
  { meaning: "to come to a stand", word: "停车", never: /停住|停下|刹停|停止行驶/ },
  { meaning: "stands for certain, as the vehicle has told", word: "停稳", never: /停住|停妥/ },
  { meaning: "to stand", word: "静止", never: /停驻|停着/ },
  {
    meaning: "to end what goes on, and the button on the vehicle",
    word: "停止",
    never: /停止/,
    but: /停止(按钮|装置|授权|充电)|交通(已)?停止|服务器正在停止|已由.+停止/,
  },
  {
    meaning: "the vehicle's stop button, which is no emergency stop of ours",
    word: "停止按钮",
    never: /急停/,
    but: /不是急停/,
  },
  { meaning: "a code on the floor", word: "地面码", never: /二维码|条码|地码/ },
];

/** Words that hang on their place: the same word elsewhere means something else. */
const kPlaces: [where: string, word: string][] = [
  ["stations.state.ready", "就绪"],
  ["words.activity.standing", "静止"],
  ["map.group.standing", "静止"],
  ["words.link.late", "延迟"],
  ["words.job.cancelled", "已取消"],
  ["words.job.Aborted", "已中止"],
  ["send.start.armed", "已准备"],
  ["common.nav.stations", "站点"],
  ["common.nav.send", "发车"],
  ["common.nav.loads", "载荷"],
  ["loads.title", "载荷"],
  ["loads.new", "登记载荷"],
];

describe("in Chinese one thing has one name", () => {
  it("in all catalogs", () => expect(texts.length).toBeGreaterThan(1000));
  it.each(kTerms)("$meaning: $word", ({ word, never, but }) => {
    const wrong = texts.filter(([, text]) => never.test(but ? text.replace(but, "") : text));

    expect(wrong).toEqual([]);
    expect(texts.some(([, text]) => text.replace(/\{\{\w+\}\}/g, "3").includes(word))).toBe(true);
  });
  it.each(kPlaces)("%s is %s", (where, word) =>
    expect(texts.find(([place]) => place === where)?.[1]).toBe(word),
  );
  it("only a station is 就绪", () => {
    const places = texts.filter(([, text]) => text.includes("就绪")).map(([where]) => where.split(".")[0]);

    expect([...new Set(places)]).toEqual(["stations"]);
  });
});
