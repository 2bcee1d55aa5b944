import { expect, it } from "vitest";
import type { JobState } from "@/shared/api/types";
import en from "@/shared/words/catalogs/words.en.json";
import zh from "@/shared/words/catalogs/words.zh.json";
import { orderStateKey } from "./orderState";

const kCases: [JobState, string | undefined, string, string][] = [
  ["Aborted", "cancelled_by_person", "Cancelled", "已取消"],
  ["Aborted", "vehicle_gone", "Aborted", "已中止"],
  ["Aborted", undefined, "Aborted", "已中止"],
  ["Interrupted", "cancelled_by_person", "Interrupted", "已中断"],
  ["Ended", undefined, "Done", "已完成"],
];

it.each(kCases)("%s because of %s is %s, %s", (state, code, english, chinese) => {
  const key = orderStateKey({ state, ...(code !== undefined && { reason: { code, params: {} } }) });
  const [, name = ""] = /^words:job\.(\w+)$/.exec(key) ?? [];
  const word = (catalog: { job: Record<string, string> }) => catalog.job[name];

  expect([word(en), word(zh)]).toEqual([english, chinese]);
});
