// SPDX-License-Identifier: Apache-2.0
// The bar that never scrolls away: where we are, whether all is well, and blackout.
import type { Actions } from './actions';
import { byId, el, setAttribute, setText } from './dom';
import type { Scene } from './state';

function health(scene: Scene): [kind: string, words: string] {
  const { state } = scene;
  if (!scene.connected || !state) return ['bad', 'no connection'];
  if (!state.hand.connected) return ['bad', 'lights out of reach'];
  if (state.hand.refused) return ['bad', 'lights hold: the studio file differs'];
  if (state.outputs.some((output) => output.health === 'lost')) return ['bad', 'an output is lost'];
  if (state.caution === 'hold') return ['warn', 'lights hold'];
  return ['good', 'lights connected'];
}

function makeTab(name: 'studio' | 'technician', label: string, actions: Actions) {
  return el(
    'button.tab',
    { type: 'button', id: `tab-${name}`, onclick: () => actions.show(name) },
    label,
  );
}

export function makeBar(actions: Actions): (scene: Scene) => void {
  const studio = el('span.studio');
  const lamp = el('span.lamp', { 'aria-hidden': 'true' });
  const words = el('span.status-words');
  const status = el('p.status', { role: 'status' }, lamp, words);
  const tabs = {
    studio: makeTab('studio', 'Studio', actions),
    technician: makeTab('technician', 'Technician', actions),
  };
  let on = false;
  const label = el('span.label');
  const detail = el('span.detail', { id: 'blackout-detail' });
  const blackout = el(
    'button.blackout',
    { type: 'button', onclick: () => actions.blackout(!on), 'aria-describedby': 'blackout-detail' },
    label,
    detail,
  );
  byId('bar').append(
    el('h1', {}, el('span.mark', { 'aria-hidden': 'true' }), 'Chiaro'),
    studio,
    el('nav.tabs', { 'aria-label': 'Pages' }, tabs.studio, tabs.technician),
    status,
    blackout,
  );
  return (scene) => {
    on = scene.state?.blackout ?? false;
    setText(studio, scene.state?.studio.name ?? '');
    const [kind, text] = health(scene);
    setAttribute(lamp, 'data-kind', kind);
    setText(words, text);
    setText(label, on ? 'Release blackout' : 'Blackout');
    setText(detail, on ? 'all lights are dark' : 'all lights off at once');
    setAttribute(blackout, 'aria-pressed', String(on));
    setAttribute(document.body, 'data-blackout', on);
    for (const name of ['studio', 'technician'] as const) {
      setAttribute(tabs[name], 'aria-current', scene.tab === name ? 'page' : false);
      byId(`${name}-view`).hidden = scene.tab !== name;
    }
  };
}
