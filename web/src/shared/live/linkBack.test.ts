import { describe, expect, it, vi } from "vitest";
import { whenLinkIsBack } from "./linkBack";
import { LiveStore, type LinkState } from "./store";

const live: LinkState = { kind: "live", heardAt: 1 };
const lost: LinkState = { kind: "lost", since: 1, heardAt: 1 };
const connecting: LinkState = { kind: "connecting" };

describe("the link is back", () => {
  it.each<[string, LinkState, LinkState[], number]>([
    ["not when it comes up first", connecting, [live], 0],
    ["not while it stays", live, [live, live], 0],
    ["not while it is lost", live, [lost, connecting, lost], 0],
    ["after it was lost before", lost, [live], 1],
    ["after it was lost meanwhile, and once only", live, [lost, live, live], 1],
    ["each time", live, [lost, live, lost, connecting, live], 2],
  ])("%s", (_, before, then, times) => {
    const store = new LiveStore((flush) => flush());
    store.setLink(before);
    const heard = vi.fn();

    const end = whenLinkIsBack(store, heard);
    for (const link of then) store.setLink(link);

    expect(heard).toHaveBeenCalledTimes(times);
    end();
    store.setLink(lost);
    store.setLink(live);
    expect(heard).toHaveBeenCalledTimes(times);
  });
});
