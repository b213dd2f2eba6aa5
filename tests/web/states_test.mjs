// SPDX-License-Identifier: Apache-2.0
// The page in every state, against a daemon that plays it.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { openBrowser } from './browser.mjs';
import { dark, done, failed, handGone, mockDaemon, png, quiet, working } from './mock_daemon.mjs';

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
  assert.equal(await page.locator('.card[data-mood]').count(), 9);
  assert.match(await text('#stage'), /Choose a mood/);
  await page.getByRole('button', { name: 'Work light' }).click();
  await daemon.click((r) => r.path === '/api/v1/work-light');
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
  assert.match(words, /Trial 1,240 of 4,000 · 0\.3 s/);
  await page.getByRole('button', { name: 'Cancel' }).click();
  const request = await daemon.click((r) => r.method === 'DELETE');
  assert.equal(request.path, '/api/v1/design/5');
});

test('a finished look stands beside its reference and the camera, in the trade\'s words', async () => {
  await open(done());
  await page.getByRole('button', { name: 'Side by side' }).click();
  for (const id of ['reference', 'preview', 'camera'])
    await page.locator(`#${id} img`).waitFor({ state: 'visible' });
  assert.match(await text('#stage'), /Rembrandt/);
  assert.match(await text('#stage'), /Key to fill\s+4:1 \(2 stops\)/);
  assert.match(await text('#stage'), /At the face\s+800 lx \(74 fc\)/);
  const key = await text('#lights li[data-fixture=key]');
  assert.match(key, /45° camera left, 35° up, 1\.8 m/);
  assert.match(key, /62 %, 0\.7 stops below full/);
  assert.match(key, /4300 K/);
  assert.match(key, /620 lx \(58 fc\)/);
});

test('a divider compares two pictures, by pointer, by finger and by keyboard', async () => {
  await open(done());
  const divider = page.getByLabel('Divider between Reference and Camera');
  await divider.focus();
  const at = () => divider.inputValue();
  await divider.press('ArrowRight');
  assert.equal(await at(), '51');
  const box = await divider.boundingBox();
  await page.mouse.click(box.x + box.width * 0.25, box.y + box.height / 2);
  assert.ok(Number(await at()) < 35, await at());
  // The edge of the clipped picture lies under the handle.
  const clip = await page.locator('#reference').evaluate((node) => getComputedStyle(node).clipPath);
  assert.match(clip, /inset/);
  await page.getByRole('group', { name: 'On the left' }).getByRole('button', { name: 'Preview' }).click();
  await page.getByLabel('Divider between Preview and Camera').waitFor();
});

test('a click remembers what the camera saw before it', async () => {
  await open(done());
  await page.locator('#camera img').evaluate((image) => image.decode());
  await page.locator('.card[data-mood=split]').click();
  await page.getByLabel('Divider between Before and Camera').waitFor();
  assert.match(await page.locator('#before img').getAttribute('src'), /^data:image\/jpeg/);
});

test('words and tags narrow the wall of moods', async () => {
  await open(quiet());
  const shown = (wanted) => page.waitForFunction((names) =>
    [...document.querySelectorAll('.card[data-mood]')].map((card) => card.dataset.mood).join() === names, wanted);
  await page.getByLabel('Search moods').fill('night');
  await shown('moonlight');
  await page.getByLabel('Search moods').fill('no such light');
  await page.getByText('No mood is like that.').waitFor();
  await page.getByLabel('Search moods').fill('');
  await page.getByRole('button', { name: 'warm', exact: true }).click();
  await shown('golden-hour,candlelight');
});

test('a photograph of one\'s own is kept as a mood and lit like', async () => {
  await open(quiet());
  daemon.answer('POST /api/v1/moods', { name: 'anna' });
  await page.locator('#own').setInputFiles({ name: 'anna_01.png', mimeType: 'image/png', buffer: png(200, 150, 90) });
  const kept = await daemon.click((r) => r.path === '/api/v1/moods');
  assert.match(kept.body, /name="title"\r\n\r\nanna 01/);
  const lit = await daemon.click((r) => r.path === '/api/v1/design');
  assert.equal(lit.body.mood, 'anna');
});

test('a file that is no picture is refused in the daemon\'s words', async () => {
  await open(quiet());
  daemon.refuse('POST /api/v1/moods', 422, { what: 'this is a HEIC picture', where: 'picture', remedy: 'save it as JPEG' });
  await page.locator('#own').setInputFiles({ name: 'a.heic', mimeType: 'image/heic', buffer: Buffer.from('no picture') });
  await page.getByRole('alert').waitFor();
  assert.match(await text('#refusal'), /This is a HEIC picture\. Save it as JPEG\./);
});

test('a nudge is a quarter stop, and what it came to is told', async () => {
  await open(done());
  assert.equal(await text('[data-nudge=warmer] output'), '+½');
  await page.getByRole('button', { name: 'Brighter, a quarter stop' }).click();
  const sent = await daemon.click((r) => r.path === '/api/v1/nudge');
  assert.equal(sent.body.brighter, 0.25);
  await page.getByRole('button', { name: 'Harder, a quarter stop' }).click();
  assert.equal((await daemon.click((r) => r.path === '/api/v1/nudge' && r.body.softer)).body.softer, -0.25);
});

test('a look is saved under a name, recalled, renamed and deleted', async () => {
  await open(done());
  await page.getByRole('button', { name: 'Save look' }).click();
  await page.getByLabel('Name', { exact: true }).fill('Anna, noon');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  const kept = await daemon.click((r) => r.method === 'POST' && r.path === '/api/v1/looks');
  assert.equal(kept.body.name, 'Anna, noon');
  await page.getByRole('tab', { name: /Saved looks/ }).click();
  await page.getByRole('button', { name: /^Anna, morning/ }).click();
  await daemon.click((r) => r.path === '/api/v1/looks/2/apply');
  await page.getByRole('button', { name: 'Rename Anna, morning' }).click();
  await page.getByLabel('New name').fill('Anna');
  await page.getByLabel('New name').press('Enter');
  assert.equal((await daemon.click((r) => r.method === 'PUT' && r.path === '/api/v1/looks/2')).body.name, 'Anna');
  await page.getByRole('button', { name: 'Delete Anna, morning' }).click();
  await daemon.click((r) => r.method === 'DELETE' && r.path === '/api/v1/looks/2');
});

test('a meter reading is typed in as the meter shows it', async () => {
  await open(done());
  await page.getByRole('button', { name: 'Meter reading for key' }).click();
  await page.getByLabel(/Meter at the face, towards key/).fill('f/5.6 1/50 ISO 100');
  await page.keyboard.press('Enter');
  const sent = await daemon.click((r) => r.path === '/api/v1/fixtures/key/measured');
  assert.equal(sent.body.reading, 'f/5.6 1/50 ISO 100');
});

test('the technician sees how ports keep time and what is in every slot', async () => {
  await open(done());
  await page.getByRole('button', { name: 'Technician' }).click();
  await page.locator('#ports', { hasText: /41 µs · 310 µs · 1\.2 ms/ }).waitFor();
  await page.locator('.slots li[data-slot="2"]', { hasText: '20' }).waitFor();
  await page.locator('.slots li[data-slot="5"]').hover();
  await page.locator('#monitor', { hasText: /Slot 5: fill, 80 of 255 \(31 %\)/ }).waitFor();
});

test('an unknown lamp is learned slot by slot, and its slots fall when one looks away', async () => {
  await open(done());
  await page.getByRole('button', { name: 'Technician' }).click();
  assert.equal(await page.getByLabel('First slot').inputValue(), '9');
  await page.getByLabel('What you call it').fill('old panel');
  await page.getByLabel('Slots to look at').fill('2');
  await page.getByRole('button', { name: 'Begin' }).click();
  await page.getByRole('button', { name: 'Raise slot 9' }).click();
  const raised = await daemon.click((r) => r.method === 'PUT' && r.path === '/api/v1/kit/slots');
  assert.deepEqual(raised.body, { universe: 1, slots: { 9: 255 } });
  await page.getByLabel('What slot 9 does').selectOption('dimmer');
  await page.getByLabel('What slot 10 does').selectOption('fine');
  assert.equal(await page.getByLabel('Travels, each way (degrees)').isVisible(), false);
  await page.getByLabel('How it is held').selectOption('arc');
  await page.getByLabel('Travels, each way (degrees)').fill('40');
  daemon.answer('POST /api/v1/kit', { profile: 'own/old-panel', profile_file: '/studios/fixtures/own/old-panel.yaml',
    profile_yaml: 'profile: own/old-panel', studio_file: '/studios/portrait.yaml', studio_lines: '  old panel:', added: false });
  await page.getByRole('button', { name: 'Show the profile' }).click();
  const learnt = await daemon.click((r) => r.path === '/api/v1/kit');
  assert.deepEqual(learnt.body.slots.map((slot) => slot.sees), ['dimmer', 'fine']);
  assert.equal(learnt.body.held, 'arc');
  assert.equal(learnt.body.travel_deg, 40);
  await page.locator('.learnt pre').first().waitFor();
  await page.getByRole('button', { name: 'Studio', exact: true }).click();
  await daemon.click((r) => r.method === 'DELETE' && r.path === '/api/v1/kit/slots');
});

test('an output process that is gone is told in large words', async () => {
  await open(handGone());
  await page.locator('#hand-gone').waitFor({ state: 'visible' });
  assert.match(await text('#bar'), /lights out of reach/);
});

test('a stand that must be moved is asked for, and its button says that it was', async () => {
  await open(done());
  assert.match(await text('#instructions'), /Move key to 47° camera left, 38° up, 1\.6 m\./);
  await page.getByRole('button', { name: 'Done: key' }).click();
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

test('what was refused is read wherever the page is scrolled to', async () => {
  await open(done());
  daemon.refuse('POST /api/v1/undo', 409, { what: 'there is nothing to go back to', where: '', remedy: 'choose a mood' });
  await page.getByRole('button', { name: 'Undo' }).click();
  await page.locator('#refusal').waitFor();
  await page.mouse.move(900, 700);
  await page.mouse.wheel(0, 400);
  await page.waitForFunction(() => scrollY > 100);
  assert.ok(await page.evaluate(() => {
    const { left, top, width, height } = document.querySelector('#refusal strong').getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2)?.closest('#refusal') !== null;
  }));
});

test('a first answer on the lamps is told while places are still looked for', async () => {
  const state = working();
  state.design.lit = true;
  await open(state);
  assert.match(await text('#stage'), /Lit with the stands where they are/);
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
    [...document.querySelectorAll('button, input, select, [tabindex="0"]')]
      .filter((node) => node.checkVisibility())
      .filter((node) => !(node.innerText?.trim() || node.ariaLabel || node.labels?.length))
      .map((node) => node.outerHTML),
  );
  assert.deepEqual(nameless, []);
  const reached = new Set();
  for (let step = 0; step < 70; step++) {
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
  for (const state of [quiet(), working(), done(), failed(), dark(), handGone()]) {
    await open(state);
    const first = await text('body');
    await page.getByRole('button', { name: 'Technician' }).click();
    const words = first + (await text('body'));
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
