// SPDX-License-Identifier: Apache-2.0
// Our bytes shown to others' programs, and theirs to ours. Ours run at the far end of the cable
// that npm.sh has laid.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import readline from 'node:readline';
import {after, test} from 'node:test';
import artnet from 'artnet';
import {dmxnet} from 'dmxnet';
import modbus from 'modbus-serial';
import sacn from 'sacn';

const {CHIARO_THERE, CHIARO_SENDER, CHIARO_RECEIVER} = process.env;
const NEAR = '10.9.8.1';
const FAR = '10.9.8.2';
const PATTERN = Array.from({length: 512}, (_, n) => (7 * n + 3) & 255);
const children = new Set();

/** One of our programs in the other namespace. */
function ours(...words) {
  const [command, ...rest] = [...CHIARO_THERE.split(' '), ...words];
  const child = spawn(command, rest, {stdio: ['ignore', 'pipe', 'inherit']});
  children.add(child);
  child.on('exit', () => children.delete(child));
  return child;
}

/** Resolves with the first value that `take` is given and that suits. */
function first(take, suits, what, seconds = 25) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`no ${what} in ${seconds} s`)), seconds * 1000);
    take((value) => {
      if (!suits(value)) return;
      clearTimeout(timer);
      resolve(value);
    });
  });
}

const same = (levels) => levels.length === 512 && PATTERN.every((level, n) => levels[n] === level);

/** What our receiver prints, line by line. */
function lines(child, take) {
  readline.createInterface({input: child.stdout}).on('line', (line) => take(JSON.parse(line)));
}

after(() => {
  for (const child of children) child.kill();
  setTimeout(() => process.exit(), 500).unref();
});

test('dmxnet hears our Art-Net and is heard as a node that asks for it', async () => {
  const node = new dmxnet({log: {level: 'error'}, hosts: [NEAR]});
  const receiver = node.newReceiver({net: 0, subnet: 2, universe: 3});
  const sender = ours(CHIARO_SENDER, 'artnet', 36, 'far', 30);  // port-address 35 = 0:2:3
  await first((take) => receiver.on('data', take), same, 'levels at dmxnet');
  sender.kill();
});

test('our Art-Net input hears what npm artnet sends', async () => {
  const receiver = ours(CHIARO_RECEIVER, 'artnet', 6, 'far', 30);
  const heard = first((take) => lines(receiver, take), (line) => same(line.levels ?? []), 'levels');
  const sender = artnet({host: FAR, refresh: 200, sendAll: true});
  const again = setInterval(() => sender.set(5, 1, PATTERN), 300);
  await heard;
  clearInterval(again);
  sender.close();
  receiver.kill();
});

test('npm sacn hears our sACN, whole and in order', async () => {
  const receiver = new sacn.Receiver({universes: [12], iface: NEAR, reuseAddr: true});
  const faults = [];
  receiver.on('PacketCorruption', (fault) => faults.push(fault.message));
  receiver.on('PacketOutOfOrder', (fault) => faults.push(fault.message));
  const sender = ours(CHIARO_SENDER, 'sacn', 12, 'far', 30);
  let packets = 0;
  await first((take) => receiver.on('packet', (packet) => {
    assert.ok(same([...packet.payloadAsBuffer]));
    take(++packets);
  }), (count) => count >= 40, 'forty packets');
  assert.deepEqual(faults, []);
  sender.kill();
  receiver.close();
});

test('our sACN input hears what npm sacn sends', async () => {
  const receiver = ours(CHIARO_RECEIVER, 'sacn', 13, 'far', 30);
  const heard = first((take) => lines(receiver, take), (line) => same(line.levels ?? []), 'levels');
  const sender = new sacn.Sender({universe: 13, iface: NEAR, reuseAddr: true});
  const payload = Object.fromEntries(PATTERN.map((level, n) => [n + 1, level]));
  const again = setInterval(() => sender.send({payload, sourceName: 'peer', useRawDmxValues: true}),
      100);
  await heard;
  clearInterval(again);
  sender.close();
  receiver.kill();
});

test('the registers of modbus-serial’s server become what our levels mean', async () => {
  const registers = new Map();
  let report = () => {};
  const server = new modbus.ServerTCP({
    setRegister: (address, value, unit) => {
      registers.set(address, value);
      report(unit);
    },
    getHoldingRegister: (address) => registers.get(address) ?? 0,
  }, {host: NEAR, port: 1502, unitID: 1});
  const sender = ours(CHIARO_SENDER, 'modbus', 9, `${NEAR}:1502`, 30);
  const expected = Array.from({length: 8}, (_, i) =>
    Math.round((PATTERN[2 * i] * 256 + PATTERN[2 * i + 1]) / 65535 * 10000));
  await first((take) => { report = take; },
      () => expected.every((value, i) => registers.get(16 + i) === value), 'right registers');
  sender.kill();
  await new Promise((resolve) => server.close(resolve));
});
