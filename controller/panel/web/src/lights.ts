// SPDX-License-Identifier: Apache-2.0
// The lights in the trade's words, each with a fader, the masters, and what a person has to do.
import type { Actions } from './actions';
import { byId, el, keyed, setAttribute, setText, show } from './dom';
import { makeFader } from './fader';
import { makeMeter } from './meter';
import type { Fixture, Instruction, Scene } from './state';
import { sentence } from './words';

type Order = Instruction & { fixture: string };

function makeOrder(order: Order, actions: Actions) {
  const words = el('p');
  const node = el(
    'li',
    { 'data-fixture': order.fixture },
    words,
    el(
      'button.primary',
      { type: 'button', 'aria-label': `Done: ${order.fixture}`, onclick: () => actions.placed(order.fixture) },
      'Done',
    ),
  );
  return { node, update: (next: Order) => setText(words, sentence(next.words)) };
}

export function makeInstructions(actions: Actions): (scene: Scene) => void {
  const list = el('ul.orders');
  const section = byId('instructions');
  section.append(
    el('h2', { id: 'instructions-title' }, 'To do by hand'),
    el('p.hint', {}, 'Levels follow as soon as you say that it is done.'),
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

function makeLight(fixture: Fixture, actions: Actions) {
  const { name } = fixture;
  const role = el('span.role');
  const place = el('span.place');
  const level = el('span.level');
  const colour = el('span.colour');
  const light = el('span.light');
  const fader = makeFader(`Level of ${name}`, (value) => actions.fader(name, value));
  const meter = makeMeter(name, actions);
  const release = el('button.quiet', { type: 'button', onclick: () => actions.release(name) }, 'Give back');
  setAttribute(release, 'aria-label', `Give ${name} back to the look`);
  let locked = false;
  const lock = el('button.quiet', { type: 'button', onclick: () => actions.lock(name, !locked) });
  const node = el(
    'li',
    { 'data-fixture': name },
    el('div.who', {}, el('span.name', {}, name), role),
    el('div.where', {}, place, colour),
    el('div.how', {}, el('div.said', {}, level, light), fader.node),
    el('div.hand', {}, release, meter.open, lock),
    meter.form,
  );
  return {
    node,
    update(next: Fixture) {
      setText(role, next.role === next.name ? '' : next.role);
      setText(place, next.words);
      setText(level, next.level);
      setText(colour, next.colour);
      setText(light, next.light);
      fader.update(next.sent.intensity ?? 0);
      const byHand = next.by_hand.includes('intensity');
      setAttribute(fader.node, 'disabled', !next.controlled || byHand);
      show(fader.node, !byHand);
      const held = Object.keys(next.manual).length > 0;
      show(release, held);
      setAttribute(node, 'data-held', held);
      setAttribute(node, 'data-dark', (next.sent.intensity ?? 0) <= 0);
      locked = next.locked;
      setText(lock, locked ? 'Locked' : 'Lock');
      setAttribute(lock, 'aria-pressed', String(locked));
      setAttribute(lock, 'aria-label', `Lock ${name}: moods leave it alone`);
      meter.update(next);
    },
  };
}

const masters = [
  ['grand', 'All'],
  ['key', 'Key'],
  ['fill', 'Fill'],
  ['back', 'Back'],
  ['background', 'Background'],
] as const;

function makeMasters(actions: Actions) {
  const faders = masters.map(([name, label]) => {
    const fader = makeFader(`Master: ${label}`, (level) => actions.master(name, level));
    const percent = el('span.level');
    const node = el('div.master', {}, el('span', { 'aria-hidden': 'true' }, label), fader.node, percent);
    return { name, fader, percent, node };
  });
  const node = el('div.masters', { role: 'group', 'aria-label': 'Masters' }, ...faders.map((f) => f.node));
  return {
    node,
    update(levels: Record<string, number>) {
      for (const { name, fader, percent } of faders) {
        const level = levels[name] ?? 1;
        fader.update(level);
        setText(percent, `${Math.round(100 * level)} %`);
      }
    },
  };
}

export function makeLights(actions: Actions): (scene: Scene) => void {
  const list = el('ul.list');
  const group = makeMasters(actions);
  const section = byId('lights');
  section.append(
    el('div.headline', {}, el('h2', { id: 'lights-title' }, 'Lights'), group.node),
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
    group.update(state?.masters ?? {});
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
