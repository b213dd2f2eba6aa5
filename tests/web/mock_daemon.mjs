// SPDX-License-Identifier: Apache-2.0
// A daemon in a given state: serves the built page and answers as the API's contract says, so that
// states which are rare in a healthy studio (failed, out of reach, blacked out) can be looked at.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join } from 'node:path';
import { deflateSync } from 'node:zlib';
import { WebSocketServer } from 'ws';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css' };

/** As PNG wants it; zlib.crc32 came after Node 18. */
function checksum(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(checksum(body), body.length + 4);
  return out;
}

/** A picture of one hue, lit from the left: 32 x 24 PNG. */
export function png(...hue) {
  const [width, height] = [32, 24];
  const rows = Buffer.alloc((3 * width + 1) * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const light = Math.max(0.05, 1 - Math.hypot(x - 11, y - 9) / 22);
      hue.forEach((value, channel) => (rows[y * (3 * width + 1) + 1 + 3 * x + channel] = value * light));
    }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from('89504e470d0a1a0a', 'hex'),
    chunk('IHDR', head),
    chunk('IDAT', deflateSync(rows)),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

export const moods = [
  ['rembrandt', 'Rembrandt', 'A small triangle of light on the far cheek', [230, 180, 130], ['low key', 'hard']],
  ['split', 'Split', 'Half the face in light, half in the dark', [200, 200, 210], ['low key', 'hard']],
  ['high-key', 'High key', 'Bright, open and almost without shadow', [250, 248, 240], ['high key', 'soft']],
  ['low-key', 'Low key', 'Little light, much dark', [120, 100, 90], ['low key', 'soft']],
  ['golden-hour', 'Golden hour', 'Late sun from one side, warm and low', [255, 170, 80], ['warm', 'hard']],
  ['loop', 'Loop', 'A small loop of shadow beside the nose', [225, 200, 180], ['middle key', 'soft']],
  ['butterfly', 'Butterfly', 'Light from high in front', [240, 220, 200], ['high key', 'hard']],
  ['moonlight', 'Moonlight', 'Cold light from behind and above', [110, 130, 180], ['cool', 'hard']],
  ['candlelight', 'Candlelight', 'One small warm flame', [220, 130, 50], ['warm', 'low key']],
];
const moodList = moods.map(([name, title, sentence, , tags]) => ({
  name, title, sentence, tags, words: name === 'moonlight' ? ['night'] : [], turn: '', attainable: true,
  own: false, picture: `/api/v1/moods/${name}/picture`,
}));
export const saved = [
  { id: 3, name: 'Rembrandt', mood: 'rembrandt', verdict: 'near', created: '2026-01-01T10:00:00Z', live: true, kept: false, picture: '/api/v1/looks/3/picture' },
  { id: 2, name: 'Anna, morning', mood: 'loop', verdict: 'reached', created: '2026-01-01T09:00:00Z', live: false, kept: true, picture: '/api/v1/looks/2/picture' },
];

const level = (intensity) =>
  intensity > 0
    ? `${Math.round(100 * intensity)} %, ${(-Math.log2(intensity)).toFixed(1)} stops below full`
    : 'off';
const fixture = (name, role, words, intensity, colour, more = {}) => ({
  name, role, mount: 'stand', words, level: level(intensity), colour, wanted: {},
  placed: { azimuth_deg: -45, elevation_deg: 35, distance_m: 1.8 }, sent: { intensity },
  light: intensity > 0 ? `${Math.round(1000 * intensity)} lx (${Math.round(92.9 * intensity)} fc)` : '',
  lux: 1000 * intensity, output_cd: 12000, measured: false, patch: null,
  manual: {}, limits: { intensity: [0, 1] }, locked: false, controlled: true,
  by_hand: ['azimuth_deg', 'elevation_deg', 'distance_m'], instruction: null, ...more,
});
const hung = { mount: 'fixed', by_hand: [], placed: {} };
const at = (address, slots) => ({ patch: { universe: 1, address, slots } });
const lights = (key, fill, back) => [
  fixture('key', 'key', '45° camera left, 35° up, 1.8 m', key, '4300 K', at(1, 4)),
  fixture('fill', 'fill', '50° camera right, 20° up, 2.0 m', fill, '4300 K', at(5, 4)),
  fixture('back', 'back', '144° camera left, 32° up, 1.8 m', back, '', hung),
  fixture('wall', 'background', '120° camera right, 5° down, 2.1 m', 0, '', hung),
];

/** All is well, nothing chosen yet. */
export function quiet() {
  return {
    version: 1,
    studio: { name: 'portrait three-point', file: '/studios/portrait.yaml', fingerprint: '0', ready: true, stage: '' },
    hand: { connected: true, refused: false, real_time: true },
    caution: 'normal', blackout: false, motion: { stopped: false, armed: false, axes_waiting: 0 },
    masters: { grand: 1, key: 1, fill: 1, back: 1, background: 1 },
    look: null, design: null, fixtures: lights(0, 0, 0), instructions: [],
    outputs: [{ universe: 1, health: 'good', rate_hz: 40, frames: 1, late: 0, missed: 0, failed: 0,
      jitter_us_p50: 41, jitter_us_p99: 310, jitter_us_p999: 1240 }],
    tried: {},
    cameras: [{ name: 'main', health: 'good', frames: 1, reconnects: 0,
      picture: '/api/v1/cameras/main/picture', stream: '/api/v1/cameras/main/stream' }],
    problems: [], can_undo: false,
  };
}

export function working() {
  return {
    ...quiet(),
    design: { job: 5, mood: 'rembrandt', title: 'Rembrandt', status: 'running', stage: 'search',
      trial: 1240, trials: 4000, best: 0.0524, seconds: 0.31, lit: false, look: null, error: null },
  };
}

/** Rembrandt is live; the key should be moved. */
export function done() {
  const move = { words: 'move key to 47° camera left, 38° up, 1.6 m',
    to: { azimuth_deg: -47, elevation_deg: 38, distance_m: 1.6 } };
  const state = { ...quiet(), fixtures: lights(0.62, 0.16, 0.31), can_undo: true };
  state.fixtures[0].instruction = move;
  state.instructions = [{ fixture: 'key', ...move }];
  state.look = { id: 3, name: 'Rembrandt', mood: 'rembrandt', verdict: 'reached',
    verdict_when_placed: 'near', remedy: '', ratio: '4:1 (2 stops)', light: '800 lx (74 fc)', nudges: { warmer: 0.5 }, advice: [],
    can_nudge: true, kept: false, edition: 2, fade: 1,
    picture: '/api/v1/looks/3/picture', placed_picture: '/api/v1/looks/3/placed_picture',
    reference: '/api/v1/moods/rembrandt/picture', trials: 4000, seconds: 0.84 };
  state.design = { ...working().design, status: 'done', stage: '', trial: 4000, look: 3 };
  return state;
}

export function failed() {
  const state = done();
  state.design = { ...state.design, job: 6, mood: 'split', title: 'Split', status: 'failed', look: null,
    error: { what: 'no lamp reaches the subject', where: 'key',
      remedy: 'unlock the key, or bring a lamp in front of the subject' } };
  state.problems = [
    { what: 'the camera answered 503', where: 'http://127.0.0.1:8091/camera/main',
      remedy: 'open the address in a browser: it must show one picture', warning: false },
    { what: "'wall' has no limit and may reach full", where: 'portrait.yaml:31:5',
      remedy: 'give it limits: {most: 80 %}', warning: true },
  ];
  state.cameras[0].health = 'lost';
  return state;
}

/** The output process is gone. */
export function handGone() {
  const state = done();
  state.hand.connected = false;
  state.outputs = [];
  state.problems = [{ what: 'the output process does not answer', where: '',
    remedy: 'start chiaro-output with the same studio file', warning: false }];
  return state;
}

export function dark() {
  return { ...done(), blackout: true, caution: 'blackout' };
}

/** Serves until closed. `requests` remembers every click that reached it. */
export async function mockDaemon(web, state, port = 0) {
  const requests = [];
  const answers = new Map();
  let now = state;
  const listeners = new WebSocketServer({ noServer: true });
  const event = () => JSON.stringify({ type: 'state', state: now });

  async function answer(method, path, body) {
    if (method !== 'GET') {
      requests.push({ method, path, body: body.startsWith('{') ? JSON.parse(body) : body || null });
      const given = answers.get(`${method} ${path}`);
      return { status: given?.status ?? 200, json: given ? (given.error ? { error: given.error } : given.json) : {} };
    }
    if (path === '/api/v1/state') return { json: now };
    if (path === '/api/v1/looks') return { json: { looks: now.look ? saved : saved.slice(1) } };
    if (path === '/api/v1/outputs/1/slots')
      return { json: { universe: 1, slots: Array.from({ length: 512 }, (_, i) => (i < 8 ? 20 * i : 0)),
        owners: [{ fixture: 'key', first: 1, last: 4 }, { fixture: 'fill', first: 5, last: 8 }] } };
    if (path === '/api/v1/moods') return { json: { moods: moodList } };
    if (path.startsWith('/api/')) {
      const mood = moods.find(([name]) => path.includes(`/${name}/`));
      return { type: 'image/png', bytes: png(...(mood?.[3] ?? [215, 170, 128])) };
    }
    const file = join(web, path === '/' ? 'index.html' : path);
    const bytes = await readFile(file).catch(() => null);
    return { status: bytes ? 200 : 404, type: types[extname(file)], bytes: bytes ?? '' };
  }

  const server = createServer(async (request, response) => {
    let body = '';
    for await (const piece of request) body += piece.toString('latin1');
    const path = new URL(request.url, 'http://localhost').pathname;
    const { status = 200, type, bytes, json } = await answer(request.method, path, body);
    response.writeHead(status, { 'Content-Type': json ? 'application/json' : (type ?? 'text/plain') });
    response.end(json ? JSON.stringify(json) : bytes);
  });
  server.on('upgrade', (request, socket, head) =>
    listeners.handleUpgrade(request, socket, head, (client) => {
      listeners.clients.add(client);
      client.send(event());
    }),
  );
  await new Promise((ready) => server.listen(port, '127.0.0.1', ready));
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    requests,
    /** The first click that `match` takes, now or later. */
    async click(match) {
      for (;;) {
        const found = requests.find(match);
        if (found) return found;
        await new Promise((next) => setTimeout(next, 5));
      }
    },
    refuse: (route, status, error) => answers.set(route, { status, error }),
    answer: (route, json) => answers.set(route, { status: 200, json }),
    tell(next) {
      now = next;
      for (const client of listeners.clients) client.send(event());
    },
    async close() {
      for (const client of listeners.clients) client.terminate();
      server.closeAllConnections?.();
      await new Promise((closed) => server.close(closed));
    },
  };
}
