// SPDX-License-Identifier: Apache-2.0
// The lights in the trade's words, each with a fader, and what a person has to move.
import type { Actions } from './actions';
import { byId, el, keyed, setAttribute, setText, show } from './dom';
import { sentence } from './notices';
import type { Fixture, Instruction, Scene } from './state';

type Order = Instruction & { fixture: string };

function makeOrder(order: Order, actions: Actions) {
  const words = el('p');
  const node = el(
    'li',
    { 'data-fixture': order.fixture },
    words,
    el(
      'button.primary',
      { type: 'button', onclick: () => actions.placed(order.fixture) },
      'Done, it stands there',
    ),
  );
  return { node, update: (next: Order) => setText(words, sentence(next.words)) };
}

export function makeInstructions(actions: Actions): (scene: Scene) => void {
  const list = el('ul.orders');
  const section = byId('instructions');
  section.append(
    el('h2', { id: 'instructions-title' }, 'To move by hand'),
    el('p.hint', {}, 'Levels follow as soon as a stand is where it should be.'),
    list,
  );
  const update = keyed<Order, ReturnType<typeof makeOrder>>(
    list,
    (order) => order.fixture,
    (order) => makeOrder(order, actions),
  );
  return ({ state }) => {
    show(section, (state?.instructions.length ?? 0) > 0);
    update(state?.instructions ?? []);
  };
}

/** A slider that a person may hold while news come in, and that tells at most ten times a second. */
function makeFader(label: string, told: (level: number) => void) {
  const slider = el('input.fader', {
    type: 'range',
    min: '0',
    max: '100',
    step: '1',
    'aria-label': label,
  }) as HTMLInputElement;
  let timer = 0;
  let until = 0;
  slider.oninput = () => {
    until = Date.now() + 1000;
    timer ||= window.setTimeout(() => {
      timer = 0;
      told(Number(slider.value) / 100);
    }, 100);
  };
  return {
    node: slider,
    update(level: number) {
      if (Date.now() < until) return;
      const value = String(Math.round(100 * level));
      if (slider.value !== value) slider.value = value;
    },
  };
}

function makeLight(fixture: Fixture, actions: Actions) {
  const { name } = fixture;
  const role = el('span.role');
  const place = el('span.place');
  const level = el('span.level');
  const colour = el('span.colour');
  const fader = makeFader(`Level of ${name}`, (value) => actions.fader(name, value));
  const release = el('button.quiet', { type: 'button', onclick: () => actions.release(name) }, 'Give back to the look');
  let locked = false;
  const lock = el('button.quiet', {
    type: 'button',
    onclick: () => actions.lock(name, !locked),
  });
  const node = el(
    'li',
    { 'data-fixture': name },
    el('div.who', {}, el('span.name', {}, name), role),
    el('div.where', {}, place, colour),
    el('div.how', {}, level, fader.node),
    el('div.hand', {}, release, lock),
  );
  return {
    node,
    update(next: Fixture) {
      setText(role, next.role === next.name ? '' : next.role);
      setText(place, next.words);
      setText(level, next.level);
      setText(colour, next.colour);
      fader.update(next.sent.intensity ?? 0);
      const byHand = next.by_hand.includes('intensity');
      setAttribute(fader.node, 'disabled', !next.controlled || byHand);
      const held = Object.keys(next.manual).length > 0;
      show(release, held);
      setAttribute(node, 'data-held', held);
      setAttribute(node, 'data-dark', (next.sent.intensity ?? 0) <= 0);
      locked = next.locked;
      setText(lock, locked ? 'Locked' : 'Lock');
      setAttribute(lock, 'aria-pressed', String(locked));
      setAttribute(lock, 'aria-label', `Lock ${name}: moods leave it alone`);
    },
  };
}

export function makeLights(actions: Actions): (scene: Scene) => void {
  const list = el('ul.list');
  const master = makeFader('Master: all lights', (level) => actions.master(level));
  const percent = el('span.level');
  const section = byId('lights');
  section.append(
    el(
      'div.headline',
      {},
      el('h2', { id: 'lights-title' }, 'Lights'),
      el('div.master', {}, el('span', {}, 'Master'), master.node, percent),
    ),
    list,
  );
  const update = keyed<Fixture, ReturnType<typeof makeLight>>(
    list,
    (fixture) => fixture.name,
    (fixture) => makeLight(fixture, actions),
  );
  return ({ state }) => {
    show(section, (state?.fixtures.length ?? 0) > 0);
    update(state?.fixtures ?? []);
    const level = state?.masters.grand ?? 1;
    master.update(level);
    setText(percent, `${Math.round(100 * level)} %`);
  };
}

export function makeProblems(): (scene: Scene) => void {
  const section = byId('problems');
  const list = el('ul.faults');
  section.append(el('h2', { id: 'problems-title' }, 'To look at'), list);
  let shown = '';
  return ({ state }) => {
    const problems = state?.problems ?? [];
    show(section, problems.length > 0);
    const now = JSON.stringify(problems);
    if (now === shown) return;
    shown = now;
    list.replaceChildren(
      ...problems.map((problem) =>
        el(
          'li',
          { 'data-kind': problem.warning ? 'warn' : 'bad' },
          el('strong', {}, sentence(problem.what)),
          problem.remedy ? ` ${sentence(problem.remedy)}` : '',
          problem.where ? el('code', {}, problem.where) : null,
        ),
      ),
    );
  };
}
