// SPDX-License-Identifier: Apache-2.0
// The wall of moods: one click lights the studio so. Words and tags narrow it down.
import type { Actions } from './actions';
import { el, keyed, setAttribute, setText, show } from './dom';
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
  const button = el(
    'button.card',
    { type: 'button', 'data-mood': card.mood.name, onclick: () => actions.light(card.mood.name) },
    el('span.picture', {}, picture, badge),
    title,
    words,
  );
  const forget = el(
    'button.corner',
    {
      type: 'button',
      'aria-label': `Remove the picture ${card.mood.title}`,
      onclick: () => actions.forget(card.mood.name),
    },
    '×',
  );
  const node = el('li', {}, button, card.mood.own && forget);
  return {
    node,
    update({ mood, status }: Card) {
      setText(title, mood.title);
      setText(words, mood.sentence);
      setAttribute(button, 'title', mood.sentence);
      setAttribute(button, 'data-status', status);
      setAttribute(button, 'aria-pressed', String(status === 'live'));
      setText(badge, status === 'live' ? 'on now' : status === 'working' ? 'working' : '');
    },
  };
}

function makeUpload(actions: Actions): HTMLElement {
  const input = el('input', { type: 'file', id: 'own', accept: 'image/*' }) as HTMLInputElement;
  input.onchange = () => {
    const file = input.files?.[0];
    if (file) actions.lightLike(file);
    input.value = '';
  };
  return el(
    'label.own',
    { for: 'own' },
    input,
    el('span.title', {}, 'Your own photograph'),
    el('span.sentence', {}, 'Drop it anywhere, or choose a file'),
  );
}

/** Tags that divide the wall: worn by more than one mood and not by all. */
function telling(moods: Mood[]): string[] {
  const worn = new Map<string, number>();
  for (const mood of moods) for (const tag of mood.tags) worn.set(tag, (worn.get(tag) ?? 0) + 1);
  return [...worn]
    .filter(([, times]) => times > 1 && times < moods.length)
    .sort(([a, m], [b, n]) => n - m || a.localeCompare(b))
    .slice(0, 10)
    .map(([tag]) => tag);
}

function makeFilter(changed: () => void) {
  const search = el('input.search', {
    type: 'search',
    id: 'mood-search',
    placeholder: 'Search moods',
    'aria-label': 'Search moods',
    oninput: changed,
  }) as HTMLInputElement;
  const chips = el('ul.chips', { 'aria-label': 'Kinds of light' });
  let chosen = '';
  const update = keyed<string, { node: HTMLElement; update(tag: string): void }>(
    chips,
    (tag) => tag,
    (tag) => {
      const pick = () => {
        chosen = chosen === tag ? '' : tag;
        changed();
      };
      const button = el('button.chip', { type: 'button', onclick: pick }, tag);
      return {
        node: el('li', {}, button),
        update: () => setAttribute(button, 'aria-pressed', String(chosen === tag)),
      };
    },
  );
  return {
    search,
    chips,
    update: (moods: Mood[]) => {
      const tags = telling(moods);
      if (!tags.includes(chosen)) chosen = '';
      update(tags);
      show(search, moods.length > 8);
      show(chips, moods.length > 8 && tags.length > 0);
    },
    takes(mood: Mood): boolean {
      if (chosen && !mood.tags.includes(chosen)) return false;
      const text = `${mood.title} ${mood.sentence} ${[...mood.tags, ...mood.words].join(' ')}`.toLowerCase();
      return search.value
        .toLowerCase()
        .split(/\s+/)
        .every((word) => text.includes(word));
    },
  };
}

export function makeMoods(parent: HTMLElement, actions: Actions, changed: () => void) {
  const list = el('ul.cards');
  const empty = el('p.hint', { role: 'status' });
  const filter = makeFilter(changed);
  parent.append(makeUpload(actions), filter.search, filter.chips, list, empty);
  const update = keyed<Card, ReturnType<typeof makeCard>>(
    list,
    (card) => card.mood.name,
    (card) => makeCard(card, actions),
  );
  return (scene: Scene) => {
    const job = scene.state?.design;
    const working = job?.status === 'queued' || job?.status === 'running';
    const statusOf = (mood: Mood): Card['status'] => {
      if (working && job.mood === mood.name) return 'working';
      return scene.state?.look?.mood === mood.name ? 'live' : 'idle';
    };
    // One's own pictures first: they are what the person came with.
    const moods = [...scene.moods].sort((a, b) => Number(b.own) - Number(a.own));
    filter.update(moods);
    const shown = moods.filter((mood) => filter.takes(mood));
    update(shown.map((mood) => ({ mood, status: statusOf(mood) })));
    const none = scene.moods.length ? 'No mood is like that.' : 'No moods are installed.';
    setText(empty, shown.length || !scene.state ? '' : none);
  };
}
