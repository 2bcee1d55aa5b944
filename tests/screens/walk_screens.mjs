// Every screen of the dashboard as a person comes to it: an address, and what is pressed there.

const kTabs = ["loads", "cameras", "why", "stops"];
const isNarrow = (page) => page.viewportSize().width < 1536;
const press = (page, selector) => page.locator(selector).first().click();

/** Arms a command and keeps it so: it falls back after eight seconds, and a look may take longer. */
const armed = (button) => async (page) => {
  if ((await page.locator("[data-state=armed], .is-armed").count()) > 0) return;
  await page.locator(button).and(page.locator(":not([aria-disabled=true])")).first().click();
  await page.locator("[data-state=armed], .is-armed").first().waitFor();
};

/** The same where something has to be chosen before. */
const armedAt = (choice, button) => async (page) => {
  if ((await page.locator(`${choice}[aria-pressed=true]`).count()) === 0) await press(page, choice);
  await armed(button)(page);
};

const vehicle = (id, more = {}) => ({ name: `vehicle ${id}`, path: `/vehicles/${id}`, ready: ".pcard, .whyl, .card .pin", ...more });
/** One tab of a vehicle's page, where it has tabs. */
const tab = (id, which) =>
  vehicle(id, { name: `vehicle ${id}, ${which}`, only: isNarrow, open: (page) => page.getByRole("tab").nth(kTabs.indexOf(which)).click() });
const order = (name, one) => ({ name: `order ${name}`, path: `/orders/${one.id}`, ready: ".odetail" });

/** Brackets that are to move on arrival, as high as no bracket reaches. */
const bracketsTo = (height) => async (page) => {
  await page.locator(".arrivalrow", { hasText: /Set brackets|升降支架/ }).click();
  await page.locator(".bheight input").fill(height);
};

/** `open`: what is pressed there; `keep`: what is pressed again when it has fallen back; `only`: where there is such a screen. */
export function screensOf({ orders, stop }) {
  return [
    { name: "map", path: "/map?vehicle=TP-01", ready: ".veh[data-vehicle]" },
    { name: "map, broken wheel", path: "/map?vehicle=TP-02", ready: ".veh[data-vehicle]" },
    { name: "user's menu", path: "/map", ready: ".veh[data-vehicle]", open: (page) => press(page, ".who > button"), within: ".menu" },
    { name: "floor tool", path: "/map?floor=1", ready: ".closures li" },
    { name: "floor tool, armed", path: "/map?floor=1", ready: ".closures li", keep: armed(".closures .cmd") },
    { name: "place tool", path: "/map?place=OM-01", ready: ".tool" },
    { name: "place tool, armed", path: "/map?place=OM-01", ready: ".tool", open: (page) => page.locator(".tool").getByRole("button", { name: /^(One step east|向东一步)/ }).click(), keep: armed(".tool .cmd") },
    { name: "send", path: "/send", ready: ".card" },
    { name: "send, a vehicle", path: "/send?vehicle=OM-01", ready: ".card" },
    { name: "send, brackets on arrival", path: "/send?vehicle=TP-01&station=7", ready: ".checks .chk", only: (page) => !isNarrow(page), open: bracketsTo("400") },
    { name: "send, closed floor", path: "/send?vehicle=TP-01&station=3", ready: ".checks .chk" },
    { name: "send, chosen", path: "/send?vehicle=OM-01&station=29", ready: ".mode[role=radio], .checks" },
    { name: "send, armed", path: "/send?vehicle=OM-01&station=29", ready: ".mode[role=radio], .checks", keep: armed(".confirm .armed") },
    { name: "send, broken wheel", path: "/send?vehicle=TP-02&station=7", ready: ".mode[role=radio], .checks" },
    { name: "send, wrong station", path: "/send?vehicle=TP-01&station=15", ready: ".card" },
    { name: "send, body of a platform", path: "/send?vehicle=TP-01&station=3&view=platform", ready: ".bodyview .bc" },
    { name: "send, body with a broken wheel", path: "/send?vehicle=TP-02&view=platform", ready: ".bodyview .wl" },
    { name: "send, cameras", path: "/send?vehicle=TP-01&station=3&view=cameras", ready: ".bodyview .cam" },
    { name: "send, brackets and feet", path: "/send?vehicle=TP-01&station=3&view=lifts", ready: ".bodyview .lifts" },
    { name: "hand drive", path: "/drive/OM-01", ready: ".desk .says" },
    { name: "hand drive, fixed wheels", path: "/drive/DL-01", ready: ".desk .says" },
    { name: "hand drive, no pose or order", path: "/drive/TP-02", ready: ".desk .says" },
    { name: "send, under way", path: `/send?order=${orders.driven.id}`, ready: ".confirm" },
    { name: "send, waiting", path: `/send?order=${orders.waiting.id}`, ready: ".confirm" },
    { name: "send, arrived", path: `/send?order=${orders.done.id}`, ready: ".confirm" },
    { name: "orders", path: "/orders", ready: ".rows" },
    ...Object.entries(orders).map(([name, one]) => order(name, one)),
    { name: "order, cancel armed", path: `/orders/${orders.waiting.id}`, ready: ".odetail", keep: armed(".odetail .cmd:is(:has-text('Cancel'), :has-text('取消'))") },
    {
      name: "tour form",
      path: "/orders",
      ready: ".rows",
      open: async (page) => {
        await press(page, ".listpage > header .btn");
        const form = page.locator(".tour");
        await form.getByRole("button", { name: "OM-01", exact: true }).click();
        for (const digit of "29") await form.getByRole("button", { name: digit, exact: true }).click();
      },
    },
    { name: "stations", path: "/stations", ready: ".board, .rows" },
    { name: "vehicles", path: "/vehicles", ready: ".rows" },
    { name: "loads", path: "/loads", ready: ".rows" },
    { name: "load", path: "/loads/A-102", ready: ".lplan .load" },
    { name: "load, elsewhere", path: "/loads/A-102", ready: ".lplan .load", open: (page) => press(page, ".lsay"), keep: armedAt(".lplaces .btn", ".lform .cmd") },
    { name: "no such load", path: "/loads/A-999", ready: ".card" },
    vehicle("TP-01"),
    ...kTabs.slice(1).map((which) => tab("TP-01", which)),
    vehicle("TP-02"),
    tab("TP-02", "why"),
    vehicle("MV-01"),
    tab("MV-01", "why"),
    vehicle("OM-01"),
    tab("OM-01", "cameras"),
    vehicle("DL-01"),
    tab("DL-01", "why"),
    vehicle("MV-02"), // never connected
    { name: "records", path: "/records", ready: ".rows" },
    { name: "record", path: `/records/${stop.id}`, ready: ".card" },
    { name: "record, run", path: `/records/${stop.id}`, only: isNarrow, ready: "[role=tab]", open: (page) => page.getByRole("tab").nth(1).click() },
    { name: "record, trend", path: `/records/${stop.id}`, only: isNarrow, ready: "[role=tab]", open: (page) => page.getByRole("tab").last().click() },
    { name: "no such page", path: "/nothing", ready: ".card" },
  ];
}

/** The same hall with the whole fleet paused. */
export function pausedScreens({ orders }) {
  const openPanel = async (page) => {
    await press(page, ".banner.held .btn");
    await page.locator(".resume").waitFor();
  };
  const closed = (page) => page.locator(".resume").press("Escape");
  return [
    { name: "paused: map", path: "/map", ready: ".banner.held" },
    { name: "paused: resume panel", path: "/map", ready: ".banner.held", open: openPanel, within: ".resume", closed },
    { name: "paused: resume armed", path: "/orders", ready: ".banner.held", open: openPanel, keep: armed(".resume .cmd"), within: ".resume", closed },
    { name: "paused: send", path: "/send?vehicle=OM-01&station=29", ready: ".banner.held" },
    { name: "paused: under way", path: `/send?order=${orders.driven.id}`, ready: ".banner.held" },
    { name: "paused: order", path: `/orders/${orders.driven.id}`, ready: ".banner.held" },
    vehicle("DL-01", { name: "paused: vehicle" }),
    { name: "paused: vehicle, resume armed", path: "/vehicles/DL-01", ready: ".card.held .cmd, .held .cmd", keep: armed(".held .cmd") },
    { name: "paused: vehicles", path: "/vehicles", ready: ".rows" },
  ];
}
