// SPDX-License-Identifier: Apache-2.0
// A lamp without a profile: its slots are raised one after another, a person says what happens, and
// a profile comes of it.
import type { Actions } from './actions';
import { byId, el, setText, show } from './dom';
import type { Learnt, Scene, State } from './state';

const sights: [value: string, words: string][] = [
  ['nothing', 'Nothing happens'],
  ['dimmer', 'All of it gets brighter'],
  ['fine', 'The slot before, in finer steps'],
  ['red', 'Red'],
  ['green', 'Green'],
  ['blue', 'Blue'],
  ['white', 'White (cool)'],
  ['warm_white', 'Warm white'],
  ['amber', 'Amber'],
  ['lime', 'Lime'],
  ['cyan', 'Cyan'],
  ['cct', 'Warmer or cooler white'],
  ['tint', 'Greener or more magenta'],
  ['zoom', 'The beam widens'],
  ['pan', 'It turns (pan)'],
  ['tilt', 'It nods (tilt)'],
  ['keep', 'Must stay as it is now (strobe, mode)'],
];
/** The daemon lets slots fall after ten seconds of silence. */
const repeat = 3000;

function input(id: string, words: string, attributes: Record<string, unknown>) {
  const field = el('input', { id, ...attributes }) as HTMLInputElement;
  const label = el('span', {}, words);
  return { field, label, node: el('label', { for: id }, label, field) };
}

function select(id: string, label: string, options: [string, string][]) {
  const field = el(
    'select',
    { id },
    ...options.map(([value, words]) => el('option', { value }, words)),
  ) as HTMLSelectElement;
  return { field, node: el('label', { for: id }, el('span', {}, label), field) };
}

function makeSlot(slot: number, raised: (level: number) => void) {
  const slider = el('input.fader', {
    type: 'range', min: '0', max: '255', step: '1', value: '0', 'aria-label': `Level of slot ${slot}`,
  }) as HTMLInputElement;
  const level = el('span.level', {}, '0');
  const set = (value: number) => {
    slider.value = String(value);
    setText(level, String(value));
    raised(value);
  };
  slider.oninput = () => set(Number(slider.value));
  const seen = el(
    'select',
    { 'aria-label': `What slot ${slot} does` },
    ...sights.map(([value, words]) => el('option', { value }, words)),
  ) as HTMLSelectElement;
  const node = el(
    'li',
    { 'data-slot': slot },
    el('span.name', {}, `Slot ${slot}`),
    el('button', { type: 'button', 'aria-label': `Raise slot ${slot}`, onclick: () => set(255) }, 'Raise'),
    slider,
    level,
    el('button.quiet', { type: 'button', 'aria-label': `Let slot ${slot} fall`, onclick: () => set(0) }, 'Off'),
    seen,
  );
  return {
    node,
    drop: () => {
      slider.value = '0';
      setText(level, '0');
    },
    sees: () => ({ sees: seen.value, level: Number(slider.value) }),
  };
}

function firstFree(state: State, universe: number): number {
  const last = state.fixtures
    .filter((fixture) => fixture.patch?.universe === universe)
    .map((fixture) => (fixture.patch?.address ?? 1) + (fixture.patch?.slots ?? 1));
  return Math.min(512, Math.max(1, ...last));
}

function makeQuestions() {
  const name = input('lamp-name', 'What you call it', { type: 'text', required: true, maxlength: '60' });
  const role = select('lamp-role', 'Its job', [
    ['key', 'Key'], ['fill', 'Fill'], ['back', 'Back'], ['hair', 'Hair'], ['kicker', 'Kicker'],
    ['background', 'Background'], ['practical', 'Practical'],
  ]);
  const universe = select('lamp-universe', 'Universe', []);
  const address = input('lamp-address', 'First slot', { type: 'number', min: '1', max: '512', value: '1' });
  const count = input('lamp-count', 'Slots to look at', { type: 'number', min: '1', max: '32', value: '6' });
  const place = input('lamp-place', 'Where it is, seen from the sitter', { type: 'text', value: '45 left, 35 up, 1.8 m' });
  const held = select('lamp-held', 'How it is held', [
    ['stand', 'On a stand'], ['hung', 'Hung, it stays'], ['arc', 'On a motorised arc'], ['track', 'On a motorised track'],
  ]);
  const over = select('lamp-over', 'The arc goes', [['round', 'Round the sitter'], ['over', 'Over the sitter']]);
  const travel = input('lamp-travel', 'Travels, each way (degrees)', { type: 'number', min: '1', max: '180', value: '60' });
  const farEnd = input('lamp-far-end', 'The other end of the track', { type: 'text', value: '45 right, 35 up, 1.8 m' });
  const along = input('lamp-along', 'Hangs along it now (per cent)', { type: 'number', min: '0', max: '100', value: '50' });
  const bits = select('lamp-bits', 'Its motor listens to', [['16', '16 bits, two slots'], ['8', '8 bits, one slot']]);
  const output = input('lamp-output', 'Candela at full (a guess will do)', { type: 'number', min: '1', value: '5000' });
  const node = el('div.form', {}, role.node, output.node, held.node, place.node, over.node, travel.node, farEnd.node, along.node, bits.node);
  const update = () => {
    const [arc, track] = [held.field.value === 'arc', held.field.value === 'track'];
    for (const { node: question } of [over, travel]) show(question, arc);
    for (const { node: question } of [farEnd, along]) show(question, track);
    show(bits.node, arc || track);
    setText(place.label, track ? 'One end of the track' : 'Where it is, seen from the sitter');
  };
  held.field.onchange = update;
  update();
  /** What holds the lamp, as the daemon wants it. */
  const answers = () => ({
    role: role.field.value,
    output_cd: Number(output.field.value),
    place: place.field.value,
    held: held.field.value,
    over: over.field.value === 'over',
    travel_deg: Number(travel.field.value),
    far_end: farEnd.field.value,
    along: Number(along.field.value) / 100,
    motor_bits: Number(bits.field.value),
  });
  return { name, universe, address, count, node, answers };
}

export function makeLearn(actions: Actions): (scene: Scene) => void {
  const ask = makeQuestions();
  const levels = new Map<number, number>();
  let slots: ReturnType<typeof makeSlot>[] = [];
  let timer = 0;
  let touched = false;
  const universe = () => Number(ask.universe.field.value);
  const tell = () => {
    clearInterval(timer);
    actions.raise(universe(), levels);
    if (levels.size) timer = window.setInterval(() => actions.raise(universe(), levels), repeat);
  };
  const release = () => {
    clearInterval(timer);
    for (const slot of slots) slot.drop();
    if (levels.size === 0) return;
    levels.clear();
    actions.raise(universe(), levels);
  };
  const list = el('ul.try');
  const begin = () => {
    release();
    const first = Number(ask.address.field.value);
    slots = Array.from({ length: Number(ask.count.field.value) }, (_, i) =>
      makeSlot(first + i, (level) => {
        if (level) levels.set(first + i, level);
        else levels.delete(first + i);
        tell();
      }),
    );
    list.replaceChildren(...slots.map((slot) => slot.node));
    show(second, true);
  };
  const result = el('div.learnt', { hidden: true });
  const send = async (add: boolean) => {
    const learnt = await actions.learn({
      name: ask.name.field.value.trim(),
      ...ask.answers(),
      universe: universe(),
      address: Number(ask.address.field.value),
      slots: slots.map((slot) => slot.sees()),
      add,
    });
    if (learnt) showResult(result, learnt);
    if (learnt?.added) release();
  };
  const second = el(
    'div.second',
    { hidden: true },
    el('p.hint', {}, 'Raise one slot, look at the lamp, say what you see. Leave the dimmer up while you look at colours.'),
    list,
    ask.node,
    el(
      'div.acts',
      {},
      el('button', { type: 'button', onclick: () => void send(false) }, 'Show the profile'),
      el('button.primary', { type: 'button', onclick: () => void send(true) }, 'Add it to the studio'),
      el('button.quiet', { type: 'button', onclick: release }, 'Let all slots fall'),
    ),
    result,
  );
  const form = el(
    'form',
    {
      onsubmit: (event: Event) => {
        event.preventDefault();
        begin();
      },
    },
    el('div.form', {}, ask.name.node, ask.universe.node, ask.address.node, ask.count.node),
    el('div.acts', {}, el('button', { type: 'submit' }, 'Begin')),
  );
  byId('learn').append(
    el('h2', { id: 'learn-title' }, 'Learn a lamp'),
    el('p.hint', {}, 'For a lamp that no profile describes. Only slots that no other lamp has are raised, and they fall back by themselves.'),
    form,
    second,
  );
  ask.address.field.oninput = () => (touched = true);
  window.addEventListener('pagehide', release);
  return ({ state, tab }) => {
    if (tab !== 'technician' && levels.size) release();
    const universes = state?.outputs.map((output) => String(output.universe)) ?? [];
    const options = [...ask.universe.field.options].map((option) => option.value);
    if (universes.join() !== options.join())
      ask.universe.field.replaceChildren(...universes.map((value) => el('option', { value }, value)));
    if (state && !touched && slots.length === 0) ask.address.field.value = String(firstFree(state, universe()));
    show(byId('learn'), universes.length > 0);
  };
}

function showResult(result: HTMLElement, learnt: Learnt): void {
  show(result, true);
  result.replaceChildren(
    el('p', { role: 'status' }, learnt.added ? 'Added: the studio has been read again with it.' : 'Nothing is written yet.'),
    el('h3', {}, learnt.profile_file),
    el('pre', { tabindex: '0' }, learnt.profile_yaml),
    el('h3', {}, `${learnt.studio_file}, below fixtures:`),
    el('pre', { tabindex: '0' }, learnt.studio_lines),
  );
}
