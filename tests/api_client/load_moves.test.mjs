// Where a load has been, as a client without a browser reads it: newest first, page by page, over a restart of the server.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Client } from "../harness/client.mjs";
import { System } from "../harness/processes.mjs";

const kLoad = "A-102", kPath = `/api/v1/loads/${kLoad}`;
let system, client;

before(async () => {
  system = await System.create("pulse-line"); // it hangs at station 0
  system.prepareVehicles(["TP-01"]);
  await system.startServer();
  client = new Client(system.url, system.apiToken);
});
after(() => system?.stop());

const say = async (body) => {
  const answer = await client.request("PUT", `${kPath}/place`, { body });
  assert.equal(answer.status, 202, JSON.stringify(answer.body));
  return answer.body;
};
const placesOf = (moves) => moves.map(({ from, to }) => [from, to]);

test("a load that nobody has moved has no history", async () => {
  const load = await client.get(kPath);
  assert.deepEqual([load.station, load.by], [0, undefined]);
  assert.deepEqual(await client.get(`${kPath}/moves`), { items: [] });
});

test("each move is kept with its places, its time and who said so; saying the same again is none", async () => {
  await say({ station: 7 });
  await say({ station: 7 });
  await say({});
  const { by } = await say({ station: 0 });
  const { items, next_cursor } = await client.get(`${kPath}/moves`);
  assert.deepEqual(placesOf(items), [[{}, { station: 0 }], [{ station: 7 }, {}], [{ station: 0 }, { station: 7 }]]);
  assert.equal(next_cursor, undefined);
  assert.ok(items.every((move) => move.by === by && !Number.isNaN(Date.parse(move.at))), JSON.stringify(items));
  assert.equal((await client.get(kPath)).since, items[0].at);
});

test("read page by page nothing is missed or twice, whatever is added meanwhile", async () => {
  const all = (await client.get(`${kPath}/moves`)).items;
  const first = await client.get(`${kPath}/moves?limit=2`);
  await say({});
  const second = await client.get(`${kPath}/moves?limit=2&cursor=${first.next_cursor}`);
  assert.deepEqual([...first.items, ...second.items], all);
  assert.equal(second.next_cursor, undefined);
});

test("who asks for what is not there, or not so, is told in a problem document", async () => {
  const problem = async (path, status, code) => {
    const answer = await client.request("GET", path);
    assert.deepEqual([answer.status, answer.body.code], [status, code], JSON.stringify(answer.body));
    assert.match(answer.type, /application\/problem\+json/);
    return answer.body;
  };
  await problem("/api/v1/loads/nothing", 404, "unknown_load");
  await problem("/api/v1/loads/nothing/moves", 404, "unknown_load");
  assert.equal((await problem(`${kPath}/moves?limit=0`, 400, "out_of_range")).field, "?limit");
  assert.equal((await problem(`${kPath}/moves?cursor=later`, 400, "bad_cursor")).field, "?cursor");
});

test("the history is there after the server was killed", async () => {
  const before = (await client.get(`${kPath}/moves`)).items;
  await system.kill(system.server);
  await system.startServer();
  assert.deepEqual((await client.get(`${kPath}/moves`)).items, before);
  await say({ station: 7 });
  const [newest, ...rest] = (await client.get(`${kPath}/moves`)).items;
  assert.deepEqual([newest.from, newest.to], [{}, { station: 7 }]);
  assert.deepEqual(rest, before);
});
