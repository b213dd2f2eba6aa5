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
  const rate = state.outputs[0]?.rate_hz;
  return ['good', rate ? `lights connected, ${rate} frames a second` : 'lights connected'];
}

export function makeBar(actions: Actions): (scene: Scene) => void {
  const studio = el('span.studio');
  const lamp = el('span.lamp', { 'aria-hidden': 'true' });
  const words = el('span');
  const status = el('p.status', { role: 'status' }, lamp, words);
  let on = false;
  const label = el('span.label');
  const detail = el('span.detail');
  const blackout = el(
    'button.blackout',
    { type: 'button', onclick: () => actions.blackout(!on), 'aria-describedby': 'blackout-detail' },
    label,
    detail,
  );
  detail.id = 'blackout-detail';
  byId('bar').append(
    el('h1', {}, el('span.mark', { 'aria-hidden': 'true' }), 'Chiaro'),
    studio,
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
  };
}
