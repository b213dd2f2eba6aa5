// SPDX-License-Identifier: Apache-2.0
// The page in every state, against a daemon that plays it.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { openBrowser } from './browser.mjs';
import { dark, done, failed, mockDaemon, quiet, working } from './mock_daemon.mjs';

const web = process.env.CHIARO_WEB ?? fileURLToPath(new URL('../../controller/panel/web/dist', import.meta.url));
let browser;
let daemon;
let page;

before(async () => (browser = await openBrowser()));
after(() => browser.close());
afterEach(async () => {
  await page?.close();
  await daemon?.close();
});

async function open(state, viewport = { width: 1280, height: 800 }) {
  daemon = await mockDaemon(web, state);
  page = await browser.newPage({ viewport });
  page.setDefaultTimeout(20000);
  page.faults = [];
  page.on('pageerror', (fault) => page.faults.push(fault));
  await page.goto(daemon.url);
  await page.getByRole('button', { name: /Rembrandt/ }).waitFor();
  await page.locator('#lights li').first().waitFor();
}
const text = (selector) => page.locator(selector).innerText();

test('an empty studio invites to choose a mood', async () => {
  await open(quiet());
  assert.equal(await page.locator('.card[data-mood]').count(), 5);
  assert.match(await text('#stage'), /Choose a mood/);
  assert.equal(await page.locator('#instructions').isVisible(), false);
  assert.deepEqual(page.faults, []);
});

test('one click designs and applies', async () => {
  await open(quiet());
  await page.getByRole('button', { name: /Rembrandt/ }).click();
  const request = await daemon.click((r) => r.path === '/api/v1/design');
  assert.equal(request.body.mood, 'rembrandt');
  assert.ok(request.body.apply > 0);
});

test('progress shows trials, best and time, and can be cancelled', async () => {
  await open(working());
  const words = await text('#progress');
  assert.match(words, /Trial 1,240 of 4,000/);
  assert.match(words, /Best 0\.0524 · 0\.3 s/);
  await page.getByRole('button', { name: 'Cancel' }).click();
  const request = await daemon.click((r) => r.method === 'DELETE');
  assert.equal(request.path, '/api/v1/design/5');
});

test('a finished look stands beside its reference and the camera, in the trade\'s words', async () => {
  await open(done());
  for (const id of ['reference', 'preview', 'camera'])
    await page.locator(`#${id} img`).waitFor({ state: 'visible' });
  assert.match(await text('#stage'), /Rembrandt/);
  assert.match(await text('#stage'), /key to fill 4:1/);
  const key = await text('#lights li[data-fixture=key]');
  assert.match(key, /45° camera left, 35° up, 1\.8 m/);
  assert.match(key, /62 %, 0\.7 stops below full/);
  assert.match(key, /4300 K/);
});

test('a stand that must be moved is asked for, and its button says that it was', async () => {
  await open(done());
  assert.match(await text('#instructions'), /Move key to 47° camera left, 38° up, 1\.6 m\./);
  await page.getByRole('button', { name: 'Done, it stands there' }).click();
  await daemon.click((r) => r.path === '/api/v1/fixtures/key/placed');
  daemon.tell(quiet());
  await page.locator('#instructions').waitFor({ state: 'hidden' });
});

test('a failed design says why and what to do', async () => {
  await open(failed());
  assert.match(await text('#stage'), /No lamp reaches the subject\. Unlock the key/);
  assert.match(await text('#problems'), /The camera answered 503/);
});

test('a refused click says why, until it is closed', async () => {
  await open(quiet());
  daemon.refuse('POST /api/v1/design', 422, { what: 'the picture is empty', where: '', remedy: 'choose another' });
  await page.getByRole('button', { name: /Split/ }).click();
  await page.getByRole('alert').waitFor();
  assert.match(await text('#refusal'), /The picture is empty\. Choose another\./);
  await page.getByRole('button', { name: 'Close' }).click();
  await page.locator('#refusal').waitFor({ state: 'hidden' });
});

test('blackout is always in sight, tells its state and can be released', async () => {
  await open(quiet());
  const button = page.locator('button.blackout');
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  await page.mouse.wheel(0, 5000);
  assert.ok(await button.isVisible());
  await button.click();
  await daemon.click((r) => r.path === '/api/v1/blackout' && r.body.on);
  daemon.tell(dark());
  await page.getByText('All lights are dark until you release it').waitFor();
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  await button.click();
  await daemon.click((r) => r.path === '/api/v1/blackout' && !r.body.on);
});

test('a lost connection is told and mends itself', async () => {
  await open(done());
  const { url } = daemon;
  await daemon.close();
  await page.locator('#lost').waitFor({ state: 'visible' });
  daemon = await mockDaemon(web, quiet(), Number(new URL(url).port));
  await page.locator('#lost').waitFor({ state: 'hidden' });
});

test('the keyboard reaches every mood, fader and blackout, each with a name', async () => {
  await open(done());
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, [tabindex="0"]')]
      .filter((node) => node.checkVisibility())
      .filter((node) => !(node.innerText?.trim() || node.ariaLabel || node.labels?.length))
      .map((node) => node.outerHTML),
  );
  assert.deepEqual(nameless, []);
  const reached = new Set();
  for (let step = 0; step < 40; step++) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => {
      const node = document.activeElement;
      return node.dataset.mood ?? node.ariaLabel ?? node.className;
    }));
  }
  for (const wanted of ['rembrandt', 'golden-hour', 'Level of key', 'blackout'])
    assert.ok(reached.has(wanted), `${wanted} in ${[...reached]}`);
});

test('text stands out from its ground', async () => {
  await open(done());
  const weak = await page.evaluate(() => {
    const rgb = (css) => css.match(/[\d.]+/g).map(Number);
    const luminance = ([r, g, b]) =>
      [r, g, b].map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4))
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const ground = (node) => {
      for (let at = node; at; at = at.parentElement) {
        const colour = rgb(getComputedStyle(at).backgroundColor);
        if (colour.length < 4 || colour[3] > 0.8) return colour;
      }
      return [17, 18, 20];
    };
    return [...document.querySelectorAll('body *')]
      .filter((n) => n.checkVisibility() && [...n.childNodes].some((c) => c.nodeType === 3 && c.data.trim()))
      .map((n) => {
        const [a, b] = [luminance(rgb(getComputedStyle(n).color)), luminance(ground(n))];
        return [n.textContent, (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05)];
      })
      .filter(([, ratio]) => ratio < 4.5);
  });
  assert.deepEqual(weak, []);
});

for (const [name, viewport] of [['a laptop', { width: 1280, height: 800 }], ['a tablet', { width: 820, height: 1180 }], ['a phone', { width: 400, height: 860 }]])
  test(`nothing is cut off on ${name}`, async () => {
    await open(done(), viewport);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= viewport.width, `${width}`);
    assert.ok(await page.locator('button.blackout').isVisible());
  });

test('the page speaks the photographer\'s language', async () => {
  for (const state of [quiet(), working(), done(), failed(), dark()]) {
    await open(state);
    const words = await text('body');
    for (const word of [/\brig\b/i, /\btwin\b/i, /\bDOF\b/i, /\bexemplar\b/i, /\bgoal\b/i])
      assert.doesNotMatch(words, word);
    await page.close();
    await daemon.close();
    page = daemon = undefined;
  }
});

test('a fader held by a person tells the daemon', async () => {
  await open(done());
  const fader = page.getByLabel('Level of fill');
  await fader.focus();
  await fader.press('ArrowRight');
  const sent = await daemon.click((r) => r.path === '/api/v1/fixtures/fill');
  assert.equal(sent.method, 'PUT');
  assert.equal(sent.body.intensity, 0.17);
});
