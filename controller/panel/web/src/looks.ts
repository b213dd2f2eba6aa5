// SPDX-License-Identifier: Apache-2.0
// Looks that a person saved: recalled with a click, renamed, deleted.
import type { Actions } from './actions';
import { el, keyed, setAttribute, setText, show } from './dom';
import type { LookEntry, Scene } from './state';
import { verdict } from './words';

function makeEntry(look: LookEntry, actions: Actions) {
  const title = el('span.title');
  const words = el('span.sentence');
  const badge = el('span.badge');
  const recall = el(
    'button.card.saved',
    { type: 'button', 'data-look': look.id, onclick: () => actions.recall(look.id) },
    el('span.picture', {}, el('img', { alt: '', loading: 'lazy', src: look.picture }), badge),
    title,
    words,
  );
  const field = el('input', { type: 'text', maxlength: '60', 'aria-label': 'New name' }) as HTMLInputElement;
  const form = el(
    'form.rename',
    {
      hidden: true,
      onsubmit: (event: Event) => {
        event.preventDefault();
        if (field.value.trim()) actions.rename(look.id, field.value.trim());
        show(form, false);
      },
    },
    field,
    el('button', { type: 'submit' }, 'Rename'),
  );
  const rename = el('button.quiet', {
    type: 'button',
    onclick: () => {
      field.value = title.textContent ?? '';
      show(form, form.hidden);
      if (!form.hidden) field.select();
    },
  }, 'Rename');
  const remove = el('button.quiet', { type: 'button', onclick: () => actions.remove(look.id) }, 'Delete');
  const node = el('li', {}, recall, el('div.row', {}, rename, remove), form);
  return {
    node,
    update(next: LookEntry) {
      setText(title, next.name);
      setText(words, verdict(next.verdict));
      setText(badge, next.live ? 'on now' : '');
      setAttribute(recall, 'data-status', next.live ? 'live' : 'idle');
      setAttribute(recall, 'aria-pressed', String(next.live));
      setAttribute(rename, 'aria-label', `Rename ${next.name}`);
      setAttribute(remove, 'aria-label', `Delete ${next.name}`);
      show(remove, !next.live);
    },
  };
}

export function makeLooks(parent: HTMLElement, actions: Actions): (scene: Scene) => void {
  const list = el('ul.cards');
  const empty = el('p.hint', {}, 'Nothing saved yet. “Save look” keeps what is lit now under a name of yours.');
  parent.append(list, empty);
  const update = keyed<LookEntry, ReturnType<typeof makeEntry>>(
    list,
    (look) => String(look.id),
    (look) => makeEntry(look, actions),
  );
  return ({ looks }) => {
    const saved = looks.filter((look) => look.kept);
    update(saved);
    show(empty, saved.length === 0);
  };
}
