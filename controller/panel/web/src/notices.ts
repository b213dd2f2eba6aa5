// SPDX-License-Identifier: Apache-2.0
// What must be read before anything else: lost connection, blackout, a click that was refused, and
// the door to a daemon that wants a token.
import type { Actions } from './actions';
import { byId, el, setText, show } from './dom';
import type { Scene } from './state';
import { sentence } from './words';

function makeSignIn(actions: Actions): HTMLElement {
  const field = el('input', {
    id: 'token',
    type: 'password',
    autocomplete: 'current-password',
    required: true,
  }) as HTMLInputElement;
  return el(
    'form.notice.warn',
    {
      id: 'sign-in',
      onsubmit: (event: Event) => {
        event.preventDefault();
        actions.signIn(field.value);
      },
    },
    el('label', { for: 'token' }, 'This daemon wants a token'),
    field,
    el('button', { type: 'submit' }, 'Open'),
  );
}

export function makeNotices(actions: Actions): (scene: Scene, wantsToken: boolean) => void {
  const lost = el('p.notice.bad', { id: 'lost' });
  const dark = el('p.notice.dark', { id: 'dark' }, 'Blackout. All lights are dark until you release it.');
  const away = el(
    'p.notice.bad',
    { id: 'hand-gone' },
    'The output process does not answer: the lights keep what they were last sent, and nothing ' +
      'here reaches them. Start chiaro-output with the same studio file.',
  );
  const what = el('strong');
  const remedy = el('span');
  const refusal = el(
    'div.notice.warn',
    { id: 'refusal', role: 'alert' },
    el('p', {}, what, ' ', remedy),
    el('button.quiet', { type: 'button', onclick: () => actions.dismiss() }, 'Close'),
  );
  const signIn = makeSignIn(actions);
  byId('notices').append(signIn, lost, away, dark, refusal);
  return (scene, wantsToken) => {
    show(signIn, wantsToken);
    const cut = !scene.connected && scene.lostSince !== null && !wantsToken;
    show(lost, cut);
    setText(
      lost,
      'Connection lost. The lights hold what they show; trying again by itself. ' +
        'If it stays so, see whether chiarod is running.',
    );
    show(away, !cut && scene.connected && scene.state !== null && !scene.state.hand.connected);
    show(dark, scene.state?.blackout ?? false);
    show(refusal, scene.refusal !== null);
    if (!scene.refusal) return;
    setText(what, sentence(scene.refusal.what));
    setText(remedy, sentence(scene.refusal.remedy));
  };
}
