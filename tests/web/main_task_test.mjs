// SPDX-License-Identifier: Apache-2.0
// The main task on the real programs: a photographer clicks Rembrandt and the studio is lit so;
// then each thing that may fail in a studio, fails.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { png } from './mock_daemon.mjs';
import { startStudio } from './studio.mjs';

const bin = process.env.CHIARO_BIN;
const patience = 60_000; // a busy machine is slow, not wrong
let browser;
let studio;
let page;

before(async () => {
  studio = await startStudio(bin);
  browser = await openBrowser();
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.setDefaultTimeout(patience);
  await page.goto(studio.url);
});
after(async () => {
  await browser?.close();
  await studio?.stop();
});

/** Mean brightness, 0..255, of the picture in #id as it is shown. */
function brightness(id) {
  return page.locator(`#${id} img`).evaluate((picture) => {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 32;
    const context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0, 32, 32);
    const { data } = context.getImageData(0, 0, 32, 32);
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) sum += (data[i] + data[i + 1] + data[i + 2]) / 3;
    return sum / 1024;
  });
}
async function until(what, condition) {
  const end = Date.now() + patience;
  while (Date.now() < end) {
    if (await condition()) return;
    await new Promise((next) => setTimeout(next, 100));
  }
  assert.fail(`${what}\n${JSON.stringify(await studio.state())}\n${studio.output()}`);
}
const levels = (state) => state.fixtures.map((f) => f.sent.intensity);
const faded = () => until('the fade does not end', async () => (await studio.state()).look?.fade === 1);

test('work light shows the sitter evenly before any mood', async () => {
  await page.locator('.status', { hasText: 'lights connected' }).waitFor();
  await page.getByRole('button', { name: 'Work light' }).click();
  await page.locator('#look-title', { hasText: 'Work light' }).waitFor();
  await until('the camera stays dark', async () => (await brightness('camera')) > 20);
  const { fixtures } = await studio.state();
  const [key, fill] = ['key', 'fill'].map((name) => fixtures.find((f) => f.name === name).lux);
  assert.ok(Math.abs(Math.log2(key / fill)) < 0.1, `${key} lx and ${fill} lx`);
});

test('one click on Rembrandt lights the studio, and before and after can be compared', async (t) => {
  const seen = await page.evaluateHandle(() => {
    const story = { clicked: 0, steps: [] };
    document.addEventListener('click', () => (story.clicked = performance.now()), { capture: true, once: true });
    const socket = new WebSocket(`ws://${location.host}/api/v1/events`);
    socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      const design = message.design ?? message.state.design;
      const step = !design ? '' : design.status === 'running' && design.lit ? 'lit' : design.status;
      if (story.clicked && step && step !== story.steps.at(-1)?.step)
        story.steps.push({ step, ms: Math.round(performance.now() - story.clicked) });
    };
    return story;
  });
  await faded();
  await page.locator('.card[data-mood=rembrandt]').click();
  await page.getByLabel('Divider between Before and Camera').waitFor();
  await page.locator('.card[data-mood=rembrandt] .badge', { hasText: 'on now' }).waitFor();
  await page.locator('#stage[data-kind=done]').waitFor();
  assert.match(await page.locator('#stage .facts').innerText(), /Key to fill\s+[\d.]+:1/);
  assert.ok((await brightness('before')) > 20);
  const steps = async () => (await seen.jsonValue()).steps;
  await until('no event told of the job', async () => (await steps()).some(({ step }) => step === 'done'));
  const told = (await steps()).map(({ step }) => step);
  // The lamps change before places have been looked for, and each step is told once and in order.
  const order = ['queued', 'running', 'lit', 'done'];
  assert.ok(told.includes('lit'), told.join());
  assert.deepEqual(told, order.filter((step) => told.includes(step)));
  t.diagnostic((await steps()).map(({ step, ms }) => `${step} after ${ms} ms`).join(', '));
});

test('reference, preview and camera lie side by side, and the camera sees the light', async () => {
  await page.getByRole('button', { name: 'Side by side' }).click();
  for (const id of ['reference', 'preview', 'camera'])
    await page.locator(`#${id} img`).waitFor({ state: 'visible' });
  assert.ok((await brightness('reference')) > 5);
  await until('the preview stays dark', async () => (await brightness('preview')) > 5);
  await until('the camera stays dark', async () => (await brightness('camera')) > 5);
  const key = await page.locator('#lights li[data-fixture=key]').innerText();
  assert.match(key, /camera left|camera right|to camera|azimuth/);
  assert.match(key, /%.*below full|full/);
  assert.match(key, /lx \([\d.]+ fc\)/);
  await page.getByRole('button', { name: 'Divider', exact: true }).click();
});

test('the preview becomes as large as the camera\'s picture', async () => {
  await until('no larger preview came', () =>
    page.locator('#preview img').evaluate((image) => image.naturalWidth === 640 && image.naturalHeight === 480));
});

test('a stand is moved by a person, and the levels follow', async () => {
  const orders = page.locator('#instructions li');
  await until('no stand was to be moved', async () => (await orders.count()) > 0);
  const before = await studio.state();
  const { fixture, to } = before.instructions[0];
  await page.locator(`#instructions li[data-fixture="${fixture}"] button`).click();
  await page.locator(`#instructions li[data-fixture="${fixture}"]`).waitFor({ state: 'detached' });
  const placed = (await studio.state()).fixtures.find((f) => f.name === fixture).placed;
  assert.ok(Math.abs(placed.azimuth_deg - to.azimuth_deg) < 0.01);
  const wanted = (state) => JSON.stringify(state.fixtures.map((f) => f.wanted.intensity));
  await until('the levels did not follow', async () => wanted(await studio.state()) !== wanted(before));
});

test('a nudge makes it brighter, undo takes it back', async () => {
  await faded();
  const before = await studio.state();
  await page.getByRole('button', { name: 'Brighter, a quarter stop' }).click();
  await page.locator('[data-nudge=brighter] output', { hasText: '+¼' }).waitFor();
  await faded();
  const sum = (state) => state.fixtures.reduce((lux, f) => lux + f.lux, 0);
  await until('it did not get brighter', async () => sum(await studio.state()) > 1.05 * sum(before));
  await page.getByRole('button', { name: 'Undo' }).click();
  await until('undo did not take it back', async () => {
    const now = await studio.state();
    return now.look.id === before.look.id && now.look.fade === 1;
  });
});

test('a look is saved, and recalled after another', async () => {
  await page.getByRole('button', { name: /^Save/ }).click();
  await page.getByLabel('Name', { exact: true }).fill('Anna');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.locator('#look-title', { hasText: 'Anna' }).waitFor();
  const { look } = await studio.state();
  await page.getByRole('button', { name: 'Work light' }).click();
  await page.locator('#look-title', { hasText: 'Work light' }).waitFor();
  await page.getByRole('tab', { name: /Saved looks/ }).click();
  await page.locator(`[data-look="${look.id}"]`).click();
  await page.locator('#look-title', { hasText: 'Anna' }).waitFor();
  await faded();
  await page.getByRole('tab', { name: 'Moods' }).click();
});

test('a photograph of one\'s own is lit like, and stays on the wall', async () => {
  await page.locator('#own').setInputFiles({ name: 'by_the_window.png', mimeType: 'image/png', buffer: png(210, 170, 130) });
  await page.locator('.card[data-mood=by-the-window] .badge', { hasText: 'on now' }).waitFor();
  await page.locator('#look-title', { hasText: 'by the window' }).waitFor();
});

test('a file that is no picture is refused with words', async () => {
  await page.locator('#own').setInputFiles({ name: 'a.png', mimeType: 'image/png', buffer: Buffer.from('no picture at all') });
  await page.getByRole('alert').waitFor();
  assert.ok((await page.locator('#refusal').innerText()).length > 30);
  await page.getByRole('button', { name: 'Close' }).click();
});

test('blackout darkens at once and gives back the same light', async () => {
  await faded();
  const lit = levels(await studio.state());
  const button = page.locator('button.blackout');
  await button.click();
  await page.locator('#dark').waitFor({ state: 'visible' });
  assert.deepEqual(levels(await studio.state()), lit.map(() => 0));
  await button.click();
  await page.locator('#dark').waitFor({ state: 'hidden' });
  await until('the light did not come back', async () =>
    levels(await studio.state()).every((level, i) => Math.abs(level - lit[i]) < 1e-6));
});

test('a lamp without a profile is learned on the wire and added to the studio', async () => {
  await page.getByRole('button', { name: 'Technician' }).click();
  await page.getByLabel('What you call it').fill('old panel');
  await page.getByLabel('First slot').fill('101');
  await page.getByLabel('Slots to look at').fill('2');
  await page.getByRole('button', { name: 'Begin' }).click();
  await page.getByRole('button', { name: 'Raise slot 101' }).click();
  await page.locator('.slots li[data-slot="101"]', { hasText: '255' }).waitFor();
  await page.getByLabel('What slot 101 does').selectOption('dimmer');
  await page.getByLabel('What slot 102 does').selectOption('fine');
  await page.getByRole('button', { name: 'Add it to the studio' }).click();
  await page.getByText('Added: the studio has been read again with it.').waitFor();
  assert.match(await readFile(studio.file, 'utf8'), /profile: own\/old-panel/);
  await page.getByRole('button', { name: 'Studio', exact: true }).click();
  await page.locator('#lights li[data-fixture="old panel"]').waitFor();
  await until('the output process did not take the new file', async () => {
    const now = await studio.state();
    return now.hand.connected && !now.hand.refused;
  });
});

test('the daemon may die: the page says so, and it comes back with the same look', async () => {
  await faded();
  const before = await studio.state();
  await studio.kill('daemon');
  await page.locator('#lost').waitFor({ state: 'visible' });
  await studio.restart('daemon');
  await page.locator('#lost').waitFor({ state: 'hidden' });
  const after = await studio.state();
  assert.equal(after.look.id, before.look.id);
  assert.deepEqual(after.fixtures.map((f) => f.placed), before.fixtures.map((f) => f.placed));
  await until('the levels are not the same', async () => {
    const now = await studio.state();
    return now.fixtures.every((f, i) => f.sent.intensity === before.fixtures[i].sent.intensity);
  });
});

test('a camera that goes is told, and comes back by itself', async () => {
  await studio.kill('simulator');
  await page.locator('#camera .note', { hasText: 'lost, the last picture' }).waitFor();
  await studio.restart('simulator');
  await page.locator('#camera .note', { hasText: 'live' }).waitFor();
});

test('an output process that goes is told in large words, and comes back', async () => {
  await studio.kill('hand');
  await page.locator('#hand-gone').waitFor({ state: 'visible' });
  await page.locator('.status', { hasText: 'lights out of reach' }).waitFor();
  await studio.restart('hand');
  await page.locator('#hand-gone').waitFor({ state: 'hidden' });
});
