// The server on one host, the vehicles on another, and a link between them that fails as told. Both are network namespaces: this
// process runs in the server's (./dev test network starts it so), the vehicles' is made here. What fails are the packets themselves, so
// neither side is told anything that a real network would not tell.
import { execFileSync } from "node:child_process";

import { Client } from "../harness/client.mjs";
import { plantOf } from "../harness/hall.mjs";
import { System } from "../harness/processes.mjs";

const VEHICLES = `pulseline-vehicles-${process.pid}`;
const SERVER_ADDRESS = "192.0.2.1", VEHICLES_ADDRESS = "192.0.2.2";
const ip = (...args) => execFileSync("ip", args, { stdio: ["ignore", "ignore", "inherit"] });
const onVehicles = (...command) => execFileSync("ip", ["netns", "exec", VEHICLES, ...command], { stdio: ["ignore", "ignore", "inherit"] });

const kDrop = {
  both: ["in", "out"].map((chain) => [chain, "drop"]),
  toServer: [["out", "drop"]],
  toVehicles: [["in", "drop"]],
  reset: [["out", "meta l4proto tcp reject with tcp reset"], ["in", "meta l4proto tcp reject with tcp reset"]],
};

/** The link between the two hosts. One failure at a time; heal() ends it. */
export const link = {
  up() {
    ip("link", "set", "lo", "up");
    ip("netns", "add", VEHICLES);
    ip("link", "add", "server0", "type", "veth", "peer", "name", "vehicles0", "netns", VEHICLES);
    ip("address", "add", `${SERVER_ADDRESS}/30`, "dev", "server0");
    ip("link", "set", "server0", "up");
    onVehicles("ip", "address", "add", `${VEHICLES_ADDRESS}/30`, "dev", "vehicles0");
    onVehicles("ip", "link", "set", "lo", "up");
    onVehicles("ip", "link", "set", "vehicles0", "up");
    this.heal();
  },
  down() {
    ip("netns", "delete", VEHICLES);
  },
  /** Packets are lost: `both` ways, only `toServer` or `toVehicles`; or answered by a `reset` of the connection. */
  cut(way) {
    for (const [chain, verdict] of kDrop[way]) onVehicles("nft", "add", "rule", "ip", "link", chain, ...verdict.split(" "));
  },
  /** Of a hundred packets each way this many are lost. */
  lose(percent) {
    for (const chain of ["in", "out"]) onVehicles("nft", "add", "rule", "ip", "link", chain, "numgen", "random", "mod", "100", "<", String(percent), "drop");
  },
  mtu(bytes) {
    ip("link", "set", "server0", "mtu", String(bytes));
    onVehicles("ip", "link", "set", "vehicles0", "mtu", String(bytes));
  },
  heal() {
    onVehicles("nft", "flush", "ruleset");
    onVehicles("nft", "add", "table", "ip", "link");
    for (const [chain, hook] of [["in", "input"], ["out", "output"]]) onVehicles("nft", `add chain ip link ${chain} { type filter hook ${hook} priority 0; policy accept; }`);
  },
};

/** Server and agents of a hall on their two hosts, up and ready. */
export async function startTwoHosts(plant) {
  const system = await System.create(plantOf(plant));
  const ids = plant.vehicles.map((_, i) => `V${i + 1}`);
  system.prepareVehicles(ids);
  system.host = SERVER_ADDRESS;
  system.scheme = "https";
  system.onVehicles = ["ip", "netns", "exec", VEHICLES];
  await system.startServer(["--tls-self-signed"]);
  const client = new Client(system.url, system.apiToken);
  ids.forEach((id, i) => system.startAgent(id, { seed: i + 1, sensing: "analytic", extra: ["--insecure"] }));
  await Promise.all(ids.map((id) => client.untilReady(id)));
  return { system, client, ids };
}
