// SPDX-License-Identifier: Apache-2.0
// The main task on the real programs: a photographer clicks Rembrandt and the studio is lit so.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { startStudio } from './studio.mjs';

const bin = process.env.CHIARO_BIN;
const patience = 600_000; // a busy machine is slow, not wrong
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

test('one click on Rembrandt lights the studio, with progress on the way', async () => {
  await page.locator('.status', { hasText: 'lights connected' }).waitFor();
  await page.locator('.card[data-mood=rembrandt]').click();
  await page.locator('#progress', { hasText: 'Trial' }).waitFor();
  await page.locator('#stage[data-kind=done]').waitFor();
  assert.match(await page.locator('#stage .result').innerText(), /key to fill [\d.]+:1/);
  await page.locator('.card[data-mood=rembrandt] .badge', { hasText: 'on now' }).waitFor();
});

test('reference, preview and camera can be seen, and the camera sees the light', async () => {
  for (const id of ['reference', 'preview', 'camera'])
    await page.locator(`#${id} img`).waitFor({ state: 'visible' });
  assert.ok((await brightness('reference')) > 5);
  assert.ok((await brightness('preview')) > 5);
  await until('the camera stays dark', async () => (await brightness('camera')) > 5);
  const key = await page.locator('#lights li[data-fixture=key]').innerText();
  assert.match(key, /camera left|camera right|to camera/);
  assert.match(key, /%.*below full|full/);
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

test('blackout darkens at once and gives back the same light', async () => {
  const levels = (state) => state.fixtures.map((f) => f.sent.intensity);
  await until('the fade does not end', async () => (await studio.state()).look.fade === 1);
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

test('the daemon may die: the page says so, and it comes back with the same look', async () => {
  const before = await studio.state();
  await studio.killDaemon();
  await page.locator('#lost').waitFor({ state: 'visible' });
  await studio.restartDaemon();
  await page.locator('#lost').waitFor({ state: 'hidden' });
  const after = await studio.state();
  assert.equal(after.look.id, before.look.id);
  assert.deepEqual(after.fixtures.map((f) => f.placed), before.fixtures.map((f) => f.placed));
  await until('the levels are not the same', async () => {
    const now = await studio.state();
    return now.fixtures.every((f, i) => f.sent.intensity === before.fixtures[i].sent.intensity);
  });
});
