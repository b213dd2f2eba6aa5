// SPDX-License-Identifier: Apache-2.0
// The moods as cards: one click lights the studio so.
import type { Actions } from './actions';
import { byId, el, keyed, setAttribute, setText } from './dom';
import type { Mood, Scene } from './state';

interface Card {
  mood: Mood;
  status: 'idle' | 'working' | 'live';
}

function makeCard(card: Card, actions: Actions) {
  const title = el('span.title');
  const words = el('span.sentence');
  const badge = el('span.badge');
  const picture = el('img', { alt: '', loading: 'lazy', src: card.mood.picture });
  const node = el(
    'button.card',
    { type: 'button', 'data-mood': card.mood.name, onclick: () => actions.light(card.mood.name) },
    el('span.picture', {}, picture, badge),
    title,
    words,
  );
  return {
    node,
    update({ mood, status }: Card) {
      setText(title, mood.title);
      setText(words, mood.sentence);
      setAttribute(node, 'title', mood.sentence);
      setAttribute(node, 'data-status', status);
      setAttribute(node, 'aria-pressed', String(status === 'live'));
      setText(badge, status === 'live' ? 'on now' : status === 'working' ? 'working' : '');
    },
  };
}

function makeUpload(actions: Actions): HTMLElement {
  const input = el('input', { type: 'file', id: 'own', accept: 'image/*' }) as HTMLInputElement;
  input.onchange = () => {
    const file = input.files?.[0];
    input.value = '';
    if (file) actions.lightLike(file);
  };
  return el(
    'label.card.own',
    { for: 'own' },
    input,
    el('span.title', {}, 'Your own picture'),
    el('span.sentence', {}, 'Choose any picture whose light you like'),
  );
}

export function makeMoods(actions: Actions): (scene: Scene) => void {
  const list = el('div.cards');
  const empty = el('p.quiet');
  byId('moods').append(
    el('h2', { id: 'moods-title' }, 'Moods'),
    el('p.hint', {}, 'Click one: the lights set themselves.'),
    list,
    empty,
    el('div.cards', {}, makeUpload(actions)),
  );
  const update = keyed<Card, ReturnType<typeof makeCard>>(
    list,
    (card) => card.mood.name,
    (card) => makeCard(card, actions),
  );
  return (scene) => {
    const job = scene.state?.design;
    const working = job?.status === 'queued' || job?.status === 'running';
    update(
      scene.moods.map((mood) => ({
        mood,
        status:
          working && job.mood === mood.name
            ? 'working'
            : scene.state?.look?.mood === mood.name
              ? 'live'
              : 'idle',
      })),
    );
    setText(empty, scene.moods.length || !scene.state ? '' : 'No moods are installed.');
  };
}
