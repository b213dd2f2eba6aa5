// SPDX-License-Identifier: Apache-2.0
// chiarod's server as strangers and broken clients find it, with no output process and no camera.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { request } from 'node:http';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { WebSocket } from 'ws';

const bin = process.env.CHIARO_BIN;
const root = fileURLToPath(new URL('../..', import.meta.url));
const shipped = join(root, 'config/studios/portrait.yaml');
const folders = [];
const running = [];

/** chiarod with these arguments; `port` once it answers, `code` when it ends. */
async function chiarod(...args) {
  const folder = await mkdtemp(join(tmpdir(), 'chiaro-server-'));
  folders.push(folder);
  const child = spawn(join(bin, 'chiarod'), args, {
    env: { ...process.env, CHIARO_CONFIG: join(root, 'config'),
      CHIARO_STATE: join(folder, 'state'), CHIARO_RUNTIME: join(folder, 'run') },
  });
  running.push(child);
  let said = '';
  const code = new Promise((ended) => child.on('close', (value) => ended(value)));
  const port = new Promise((ready) => {
    const hear = (piece) => {
      said += piece;
      const match = /panel: http:\/\/\S+:(\d+)\//.exec(said);
      if (match) ready(Number(match[1]));
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    code.then(() => ready(0));
  });
  return { child, port: await port, code, said: () => said };
}
let port;
before(async () => {
  const daemon = await chiarod(shipped, '--port', '0');
  assert.ok(daemon.port, daemon.said());
  port = daemon.port;
});
after(async () => {
  for (const child of running) child.kill('SIGKILL');
  for (const folder of folders) await rm(folder, { recursive: true, force: true });
});

function ask(path, { method = 'GET', headers = {}, body, to = port } = {}) {
  return new Promise((answered, failed) => {
    const asked = request({ host: '127.0.0.1', port: to, path, method, headers }, (response) => {
      let text = '';
      response.on('data', (piece) => (text += piece));
      response.on('end', () => answered({ status: response.statusCode, headers: response.headers, text,
        error: text.startsWith('{"error"') ? JSON.parse(text).error : null }));
    });
    asked.on('error', failed);
    asked.end(body);
  });
}

test('a page of somebody else is not let in', async () => {
  assert.equal((await ask('/api/v1/state', { headers: { Origin: 'http://evil.example' } })).status, 403);
  assert.equal((await ask('/api/v1/state', { headers: { Host: 'evil.example' } })).status, 403);
  const own = { Origin: `http://127.0.0.1:${port}` };
  assert.equal((await ask('/api/v1/state', { headers: own })).status, 200);
});

test('a foreign page gets no events either', async () => {
  const status = await new Promise((told) => {
    const socket = new WebSocket(`ws://127.0.0.1:${port}/api/v1/events`, { origin: 'http://evil.example' });
    socket.on('unexpected-response', (_, response) => told(response.statusCode));
    socket.on('open', () => told(101));
    socket.on('error', () => {});
  });
  assert.equal(status, 403);
});

test('a listener is told the whole state at once', async () => {
  const message = await new Promise((told, failed) => {
    const socket = new WebSocket(`ws://127.0.0.1:${port}/api/v1/events`);
    socket.on('message', (data) => {
      told(JSON.parse(String(data)));
      socket.close();
    });
    socket.on('error', failed);
  });
  assert.equal(message.type, 'state');
  assert.equal(message.state.fixtures.length, 4);
});

test('events asked for without a WebSocket are refused with the way to ask', async () => {
  assert.equal((await ask('/api/v1/events')).status, 426);
});

test('an unknown mood is answered with the nearest', async () => {
  const { status, error } = await ask('/api/v1/design', { method: 'POST', body: '{"mood":"rembrant"}' });
  assert.equal(status, 404);
  assert.equal(error.remedy, "did you mean 'rembrandt'?");
});

test('broken JSON is refused, and the connection lives on', async () => {
  assert.equal((await ask('/api/v1/design', { method: 'POST', body: '{"mood":' })).status, 400);
  assert.equal((await ask('/api/v1/state')).status, 200);
});

test('an upload beyond the limit is refused', async () => {
  const size = 25 * 1024 * 1024;
  const answer = await new Promise((told, failed) => {
    const socket = connect(port, '127.0.0.1', () =>
      socket.write(`POST /api/v1/moods HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: ${size}\r\n\r\n`));
    socket.once('data', (data) => {
      told(String(data));
      socket.destroy();
    });
    socket.on('error', failed);
  });
  assert.match(answer, /^HTTP\/1\.1 413 /);
  assert.match(answer, /24 MB/);
});

test('what is not HTTP is refused', async () => {
  const answer = await new Promise((told, failed) => {
    const socket = connect(port, '127.0.0.1', () => socket.write('\x16\x03\x01 hello\r\n\r\n'));
    socket.once('data', (data) => told(String(data)));
    socket.on('close', () => told('closed'));
    socket.on('error', failed);
  });
  assert.match(answer, /^HTTP\/1\.1 400 |^closed/);
  assert.equal((await ask('/api/v1/state')).status, 200);
});

test('files outside the page are not served', async () => {
  for (const path of ['/../CMakeLists.txt', '/%2e%2e/package.json', '/assets/../../package.json', '//etc/passwd', '/%00'])
    assert.ok((await ask(path)).status >= 400, path);
});

test('a camera without pictures says so, an unknown one names the known', async () => {
  assert.equal((await ask('/api/v1/cameras/main/picture')).status, 503);
  assert.equal((await ask('/api/v1/cameras/mian/stream')).error.remedy, "did you mean 'main'?");
});

test('a blackout that no output process takes is not claimed', async () => {
  const { status, error } = await ask('/api/v1/blackout', { method: 'POST', body: '{"on":true}' });
  assert.equal(status, 503);
  assert.match(error.what, /may not have changed/);
});

test('metrics are Prometheus text', async () => {
  const { headers, text } = await ask('/metrics');
  assert.match(headers['content-type'], /^text\/plain; version=0\.0\.4/);
  assert.match(text, /^chiaro_hand_connected 0$/m);
});

test('a port in use is a clear error', async () => {
  const second = await chiarod(shipped, '--port', String(port));
  assert.equal(await second.code, 3);
  assert.match(second.said(), new RegExp(`port ${port} .* is in use .*--port`));
});

test('a bad studio file is refused with its problems', async () => {
  const daemon = await chiarod('/nowhere/studio.yaml', '--port', '0');
  assert.equal(await daemon.code, 1);
  assert.match(daemon.said(), /\/nowhere\/studio\.yaml/);
});

test('beyond loopback a token is needed, first to start, then to ask', async () => {
  const bare = await chiarod(shipped, '--port', '0', '--listen', '0.0.0.0');
  assert.equal(await bare.code, 2);
  assert.match(bare.said(), /--token/);
  const open = await chiarod(shipped, '--port', '0', '--listen', '0.0.0.0', '--token', 's3cret');
  const to = open.port;
  assert.equal((await ask('/', { to })).status, 200, 'the page itself may be seen: it asks for the token');
  assert.equal((await ask('/api/v1/state', { to })).status, 401);
  const wrong = { Authorization: 'Bearer wrong' };
  assert.equal((await ask('/api/v1/state', { to, headers: wrong })).status, 401);
  const right = { Authorization: 'Bearer s3cret' };
  assert.equal((await ask('/api/v1/state', { to, headers: right })).status, 200);
  const session = await ask('/api/v1/session', { to, method: 'POST', headers: right });
  assert.equal(session.status, 204);
  const [cookie] = session.headers['set-cookie'][0].split(';');
  assert.equal((await ask('/api/v1/state', { to, headers: { Cookie: cookie } })).status, 200);
});
