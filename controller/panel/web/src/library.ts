// SPDX-License-Identifier: Apache-2.0
// The left-hand column: moods to choose from, and looks that were saved.
import type { Actions } from './actions';
import { byId, el, setAttribute, setText, show } from './dom';
import { makeLooks } from './looks';
import { makeMoods } from './moods';
import type { Scene } from './state';

export function makeLibrary(actions: Actions, changed: () => void): (scene: Scene) => void {
  let shown: 'moods' | 'looks' = 'moods';
  const panes = {
    moods: el('div.pane', { id: 'moods', role: 'tabpanel', 'aria-labelledby': 'tab-moods' }),
    looks: el('div.pane', { id: 'looks', role: 'tabpanel', 'aria-labelledby': 'tab-looks' }),
  };
  const tab = (name: 'moods' | 'looks', label: string) =>
    el(
      'button',
      {
        type: 'button',
        role: 'tab',
        id: `tab-${name}`,
        'aria-controls': name,
        onclick: () => {
          shown = name;
          changed();
        },
      },
      label,
    );
  const tabs = { moods: tab('moods', 'Moods'), looks: tab('looks', 'Saved looks') };
  byId('library').append(
    el('div.switch', { role: 'tablist', 'aria-label': 'Library' }, tabs.moods, tabs.looks),
    panes.moods,
    panes.looks,
  );
  const parts = [makeMoods(panes.moods, actions, changed), makeLooks(panes.looks, actions)];
  return (scene) => {
    for (const name of ['moods', 'looks'] as const) {
      show(panes[name], shown === name);
      setAttribute(tabs[name], 'aria-selected', String(shown === name));
    }
    const saved = scene.looks.filter((look) => look.kept).length;
    setText(tabs.looks, saved ? `Saved looks (${saved})` : 'Saved looks');
    for (const part of parts) part(scene);
  };
}

/** A photograph dropped anywhere on the page. */
export function takeDrops(actions: Actions): void {
  const veil = byId('drop');
  let depth = 0;
  const files = (event: DragEvent) => [...(event.dataTransfer?.types ?? [])].includes('Files');
  window.addEventListener('dragenter', (event) => {
    if (!files(event)) return;
    depth += 1;
    show(veil, true);
  });
  window.addEventListener('dragleave', () => {
    depth = Math.max(0, depth - 1);
    if (depth === 0) show(veil, false);
  });
  window.addEventListener('dragover', (event) => event.preventDefault());
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    show(veil, false);
    const file = event.dataTransfer?.files[0];
    if (file) actions.lightLike(file);
  });
}
