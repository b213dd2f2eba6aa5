// SPDX-License-Identifier: Apache-2.0
// Reference picture, preview and camera side by side, with what is going on above them.
import type { Actions } from './actions';
import { byId, el, setAttribute, setText, show } from './dom';
import { sentence } from './notices';
import type { Design, Look, Scene, State } from './state';

const verdicts: Record<string, string> = {
  reached: 'matches the reference',
  near: 'close to the reference',
  'not reachable': 'not fully reachable with these lamps',
  not_reachable: 'not fully reachable with these lamps',
};

/** A picture with its caption, or words where there is none. */
function makeFrame(id: string, caption: string) {
  const picture = el('img', { alt: '' }) as HTMLImageElement;
  const empty = el('p.empty');
  const note = el('span.note');
  const frame = el('div.frame', {}, picture, empty);
  const node = el('figure', { id }, frame, el('figcaption', {}, caption, note));
  let broken = false;
  picture.onerror = () => {
    broken = true;
    show(picture, false);
    show(empty, true);
  };
  return {
    node,
    frame,
    update(source: string, alt: string, words: string, remark = '') {
      if (picture.getAttribute('src') !== source) {
        broken = false;
        if (source) picture.src = source;
        else picture.removeAttribute('src');
      }
      picture.alt = alt;
      show(picture, source !== '' && !broken);
      show(empty, source === '' || broken);
      setText(empty, words);
      setText(note, remark);
    },
  };
}

function makeProgress(actions: Actions) {
  const bar = el('progress', { max: '1', 'aria-label': 'Progress' }) as HTMLProgressElement;
  const words = el('p.count');
  let job = 0;
  const node = el(
    'div.progress',
    { id: 'progress' },
    bar,
    words,
    el('button.quiet', { type: 'button', onclick: () => actions.cancel(job) }, 'Cancel'),
  );
  return {
    node,
    update(design: Design | null) {
      const working = design?.status === 'queued' || design?.status === 'running';
      show(node, working);
      if (!design || !working) return;
      job = design.job;
      if (design.trials > 0) bar.value = Math.min(1, design.trial / design.trials);
      else bar.removeAttribute('value');
      const number = new Intl.NumberFormat('en-GB');
      setText(
        words,
        design.trials > 0
          ? `Trial ${number.format(design.trial)} of ${number.format(design.trials)}\n` +
              `Best ${design.best.toPrecision(3)} · ${design.seconds.toFixed(1)} s`
          : sentence(design.stage || 'about to begin'),
      );
    },
  };
}

function headline(state: State | null): [title: string, words: string, kind: string] {
  if (!state) return ['One moment', 'Looking for the daemon …', ''];
  const { design, look } = state;
  if (design?.status === 'queued' || design?.status === 'running')
    return [design.title, 'Finding the lights for it …', 'working'];
  if (design?.status === 'failed')
    return [
      design.title,
      `This did not work. ${sentence(design.error?.what ?? '')} ${sentence(design.error?.remedy ?? '')}`,
      'failed',
    ];
  if (!look && !state.studio.ready) return ['Getting ready', sentence(state.studio.stage), ''];
  if (!look) return ['No mood yet', 'Choose a mood: the lights set themselves.', ''];
  return [look.name, result(look), 'done'];
}

function result(look: Look): string {
  const verdict = verdicts[look.verdict_when_placed] ?? look.verdict_when_placed;
  const parts = [verdict];
  if (look.ratio) parts.push(`key to fill ${look.ratio}`);
  if (look.trials) parts.push(`found in ${look.seconds.toFixed(1)} s`);
  return sentence(parts.join(' · ')) + (look.remedy ? ` ${sentence(look.remedy)}` : '');
}

/** Changes whenever the prediction may have: the address of a picture that is never cached. */
function edition(state: State, look: Look): string {
  return `${look.id}.${look.verdict_when_placed}.${state.fixtures
    .map((f) => Object.values(f.placed).concat(f.wanted.intensity ?? 0))
    .flat()
    .map((value) => value.toFixed(3))
    .join('_')}`;
}

export function makeStage(actions: Actions): (scene: Scene) => void {
  const title = el('h2', { id: 'look-title' });
  const words = el('p.result', { role: 'status' });
  const undo = el('button.quiet', { type: 'button', onclick: () => actions.undo() }, 'Back to the last look');
  const progress = makeProgress(actions);
  const reference = makeFrame('reference', 'Reference picture');
  const preview = makeFrame('preview', 'Preview');
  const camera = makeFrame('camera', 'Camera');
  preview.frame.append(progress.node);
  byId('stage').append(
    el('div.headline', {}, el('div', {}, title, words), undo),
    el('div.pictures', {}, reference.node, preview.node, camera.node),
  );
  let session = 0; // a new connection needs a new stream
  let connected = false;
  return (scene) => {
    if (scene.connected && !connected) ++session;
    connected = scene.connected;
    const { state } = scene;
    const [name, text, kind] = headline(state);
    setText(title, name);
    setText(words, text);
    setAttribute(byId('stage'), 'data-kind', kind);
    show(undo, state?.can_undo ?? false);
    progress.update(state?.design ?? null);
    const job = state?.design;
    const working = job?.status === 'queued' || job?.status === 'running';
    const look = state?.look ?? null;
    const mood = scene.moods.find((m) => m.name === (working ? job.mood : look?.mood));
    const source = working ? (mood?.picture ?? '') : (look?.reference ?? '');
    reference.update(source, `Reference: ${mood?.title ?? look?.name ?? ''}`, 'the mood you choose');
    preview.update(
      state && look ? `${look.placed_picture}?v=${edition(state, look)}` : '',
      'What the camera should see',
      working ? '' : 'what the camera should see',
      state?.instructions.length ? 'lights where they stand now' : '',
    );
    const eye = state?.cameras[0];
    const seen = scene.connected && (eye?.health === 'good' || eye?.health === 'lost');
    camera.update(
      eye && seen ? `${eye.stream}?s=${session}` : '',
      'What the camera sees now',
      eye?.health === 'none' ? 'no camera in the studio file' : 'waiting for the camera',
      eye?.health === 'lost' ? 'lost, the last picture' : seen ? 'live' : '',
    );
  };
}
