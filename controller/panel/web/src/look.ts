// SPDX-License-Identifier: Apache-2.0
// The live look beside its pictures: what came out, a little more of this or that, undo and save.
import type { Actions, Nudge } from './actions';
import { byId, el, setAttribute, setText, show } from './dom';
import type { Look, Scene } from './state';
import { makeViewer } from './viewer';
import { sentence, stops, verdict } from './words';

const nudges: [Nudge, less: string, more: string][] = [
  ['brighter', 'Darker', 'Brighter'],
  ['softer', 'Harder', 'Softer'],
  ['warmer', 'Cooler', 'Warmer'],
  ['contrast', 'Flatter', 'More contrast'],
];

function makeNudges(actions: Actions) {
  const rows = nudges.map(([name, less, more]) => {
    const value = el('output.nudged', { 'aria-label': `${more} by` });
    const button = (label: string, by: number) =>
      el(
        'button',
        { type: 'button', 'aria-label': `${label}, a quarter stop`, onclick: () => actions.nudge(name, by) },
        label,
      );
    const node = el('div.nudge', { 'data-nudge': name }, button(less, -0.25), value, button(more, 0.25));
    return { name, value, node };
  });
  const node = el('fieldset.nudges', {}, el('legend', {}, 'Quarter stops'), ...rows.map((row) => row.node));
  return {
    node,
    update(look: Look | null, busy: boolean) {
      show(node, look !== null && look.can_nudge);
      setAttribute(node, 'disabled', busy);
      for (const { name, value } of rows) {
        const by = look?.nudges[name] ?? 0;
        setText(value, by === 0 ? '·' : stops(by));
        setAttribute(value, 'data-some', by !== 0);
      }
    },
  };
}

function makeSave(actions: Actions) {
  const field = el('input', { type: 'text', id: 'look-name', maxlength: '60', required: true }) as HTMLInputElement;
  const form = el(
    'form.save',
    {
      hidden: true,
      onsubmit: (event: Event) => {
        event.preventDefault();
        const name = field.value.trim();
        if (!name) return;
        actions.save(name);
        show(form, false);
        open.focus();
      },
    },
    el('label', { for: 'look-name' }, 'Name'),
    field,
    el('button.primary', { type: 'submit' }, 'Save'),
  );
  let suggestion = '';
  const open = el(
    'button',
    {
      type: 'button',
      onclick: () => {
        show(form, form.hidden);
        if (form.hidden) return;
        field.value = suggestion;
        field.select();
      },
    },
    'Save look',
  );
  return {
    open,
    form,
    update(look: Look | null) {
      suggestion = look?.name ?? '';
      setAttribute(open, 'disabled', look === null);
      setText(open, look?.kept ? 'Save as' : 'Save look');
    },
  };
}

function headline({ state, sending }: Scene): [title: string, words: string, kind: string] {
  if (sending) return [sending, 'Reading the photograph …', 'working'];
  if (!state) return ['One moment', 'Looking for the daemon …', ''];
  const { design, look } = state;
  if (design?.status === 'queued' || design?.status === 'running')
    return [
      design.title,
      design.lit ? 'Lit with the stands where they are. Looking for better places …' : 'Finding the lights for it …',
      'working',
    ];
  if (design?.status === 'failed')
    return [
      design.title,
      `This did not work. ${sentence(design.error?.what ?? '')} ${sentence(design.error?.remedy ?? '')}`,
      'failed',
    ];
  if (!look && !state.studio.ready) return ['Getting ready', sentence(state.studio.stage), ''];
  if (!look)
    return ['Choose a mood', 'One click and the lights set themselves. Or drop a photograph whose light you like.', 'empty'];
  if (!look.reference && !look.trials) return [look.name, 'Even light from the front. Choose a mood when you are ready.', 'done'];
  return [look.name, sentence(verdict(look.verdict_when_placed)), 'done'];
}

function makeFacts() {
  const values = ['Key to fill', 'At the face', 'Found in'].map((label) => {
    const value = el('dd');
    return { value, row: el('div', {}, el('dt', {}, label), value) };
  });
  const node = el('dl.facts', {}, ...values.map(({ row }) => row));
  return {
    node,
    update(look: Look | null) {
      const words = [
        look?.ratio ?? '',
        look?.light ?? '',
        look?.trials ? `${look.seconds.toFixed(1)} s` : '',
      ];
      values.forEach(({ value, row }, i) => {
        setText(value, words[i] ?? '');
        show(row, (words[i] ?? '') !== '');
      });
    },
  };
}

export function makeStage(actions: Actions, changed: () => void) {
  const title = el('h2', { id: 'look-title' });
  const words = el('p.result', { role: 'status' });
  const remedy = el('p.remedy');
  const facts = makeFacts();
  const bends = makeNudges(actions);
  const save = makeSave(actions);
  const undo = el('button', { type: 'button', onclick: () => actions.undo() }, 'Undo');
  const work = el('button', { type: 'button', onclick: () => actions.workLight() }, 'Work light');
  const viewer = makeViewer(actions, changed);
  const acts = el('div.acts', {}, undo, save.open, work);
  byId('stage').append(
    viewer.node,
    el('div.look', {}, title, words, remedy, facts.node, bends.node, acts, save.form),
  );
  return {
    camera: viewer.camera,
    update(scene: Scene) {
      const { state } = scene;
      viewer.update(scene);
      const [name, text, kind] = headline(scene);
      setText(title, name);
      setText(words, text);
      setAttribute(byId('stage'), 'data-kind', kind);
      const look = state?.look ?? null;
      const settled = kind === 'done' ? look : null;
      const advice = [settled?.remedy ?? '', ...(settled?.advice ?? [])].filter(Boolean);
      setText(remedy, advice.map(sentence).join(' '));
      show(remedy, advice.length > 0);
      facts.update(settled);
      bends.update(kind === 'failed' ? null : look, kind === 'working');
      save.update(look);
      setAttribute(undo, 'disabled', !state?.can_undo);
      setAttribute(work, 'disabled', !state);
    },
  };
}
