// SPDX-License-Identifier: Apache-2.0
// The real output process without a brain, and liblo's own `oscsend` at the other end: an OSC
// message blacks the studio out and releases it. Usage: node --test, with CHIARO_OUTPUT the program.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import dgram from 'node:dgram';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import net from 'node:net';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {test} from 'node:test';

const STUDIO = (port) => `studio: peers
subject: {stand_in: person, eye_height: 1.55 m, at: [0, 0, 0]}
cameras:
  main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22 deg}
fixtures:
  key: {role: key, profile: generic/dimmer, mode: 1ch, mount: {fixed: {at: [-1.5, -1.5, 2.2], aim_at: [0, 0, 1.4]}}, patch: {universe: 1, address: 1}}
outputs: {universe 1: mock}
exposure: {grey_card: 800 lx, white_balance: 5600 K}
surfaces:
  tablet: {osc: {map: generic/tablet, interface: lo, port: ${port}}}
`;

/** A UDP port that nobody has. */
function freePort() {
  return new Promise((resolve) => {
    const socket = dgram.createSocket('udp4');
    socket.bind(0, '127.0.0.1', () => {
      const {port} = socket.address();
      socket.close(() => resolve(port));
    });
  });
}

/** The output's own state, over its socket. */
function status(socket) {
  return new Promise((resolve) => {
    let text = '';
    const line = net.connect(socket, () => line.write('status\n'));
    line.on('data', (bytes) => {
      text += bytes;
      if (!text.includes('\n')) return;
      line.end();
      resolve(JSON.parse(text));
    });
    line.on('error', () => resolve({}));
  });
}

async function until(condition, what) {
  for (let i = 0; i < 300; ++i) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  assert.fail(`not ${what} within 15 s`);
}

test('oscsend blacks the studio out with no brain there', async () => {
  const folder = mkdtempSync(path.join(tmpdir(), 'chiaro-osc-'));
  const port = await freePort();
  writeFileSync(path.join(folder, 'studio.yaml'), STUDIO(port));
  const output = spawn(process.env.CHIARO_OUTPUT,
      [path.join(folder, 'studio.yaml'), '--state', folder, '--no-real-time'],
      {env: {...process.env, CHIARO_RUNTIME: folder}, stdio: ['ignore', 'ignore', 'inherit']});
  try {
    const socket = path.join(folder, 'output.sock');
    const send = (...words) => execFileSync('oscsend', ['127.0.0.1', String(port), ...words]);
    await until(async () => (await status(socket)).blackout === false, 'running');
    await until(async () => {
      send('/chiaro/blackout/on', 'i', '1');
      return (await status(socket)).blackout;
    }, 'dark');
    send('/chiaro/blackout/on', 'i', '0');
    assert.equal((await status(socket)).blackout, true, 'a lifted finger releases nothing');
    await until(async () => {
      send('/chiaro/blackout/off', 'f', '1');
      return (await status(socket)).blackout === false;
    }, 'light again');
  } finally {
    output.kill();
    await new Promise((resolve) => output.on('exit', resolve));
    rmSync(folder, {recursive: true});
  }
});
