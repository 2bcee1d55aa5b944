// One vehicle in its hall, as most tests of screens want it: real server, real program, a browser.
import { startBrowser } from "./browser.mjs";
import { Client } from "./client.mjs";
import { System } from "./processes.mjs";

/** `plant`: its name or file; `agent`: as of `System.startAgent`; the rest as of `System.create`. To be stopped by `stop()`. */
export async function hallWith(id, { plant = "pulse-line", agent = {}, ...how } = {}) {
  const system = await System.create(plant, how);
  let browser;
  const stop = async () => {
    await browser?.close();
    await system.stop();
  };
  try {
    system.prepareVehicles([id]);
    await system.startServer();
    const client = new Client(system.url, system.apiToken);
    system.startAgent(id, agent);
    await client.untilReady(id);
    browser = await startBrowser();
    return { system, client, browser, stop };
  } catch (error) {
    await stop();
    throw error;
  }
}
