// SPDX-License-Identifier: Apache-2.0
// The pictures: two of them under one divider, or three side by side. They all show the camera's
// frame, so that what is compared lies in the same place.
import type { Actions } from './actions';
import { el, setAttribute, setText, show } from './dom';
import type { Design, Scene, State } from './state';
import { sentence, whole } from './words';

const names = ['before', 'reference', 'preview', 'camera'] as const;
type Name = (typeof names)[number];
const labels: Record<Name, string> = {
  before: 'Before',
  reference: 'Reference',
  preview: 'Preview',
  camera: 'Camera',
};
const lefts: Name[] = ['before', 'reference', 'preview'];
const rights: Name[] = ['preview', 'camera'];

interface Shown {
  source: string;
  alt: string;
  /** Said where there is no picture. */
  words: string;
  note: string;
}

/** A picture with its caption, or words where there is none. */
function makeFrame(name: Name) {
  const picture = el('img', { alt: '', draggable: 'false' }) as HTMLImageElement;
  const empty = el('p.empty');
  const note = el('span.note');
  const node = el(
    'figure',
    { id: name },
    el('div.frame', {}, picture, empty),
    el('figcaption', {}, el('span', {}, labels[name]), note),
  );
  let broken = false;
  picture.onerror = () => {
    broken = true;
    show(picture, false);
    show(empty, true);
  };
  return {
    node,
    picture,
    update({ source, alt, words, note: remark }: Shown) {
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
      setText(
        words,
        design.trials > 0
          ? `Trial ${whole.format(design.trial)} of ${whole.format(design.trials)} · ` +
              `${design.seconds.toFixed(1)} s`
          : sentence(design.stage || 'about to begin'),
      );
    },
  };
}

/** Buttons of which one is chosen. */
function makeChoice<Value extends string>(
  label: string,
  values: Value[],
  words: (value: Value) => string,
  pick: (value: Value) => void,
) {
  const buttons = values.map((value) =>
    el('button', { type: 'button', 'data-value': value, onclick: () => pick(value) }, words(value)),
  );
  return {
    node: el('div.choice', { role: 'group', 'aria-label': label }, ...buttons),
    update(chosen: Value | null, possible: (value: Value) => boolean) {
      values.forEach((value, i) => {
        const button = buttons[i];
        if (!button) return;
        setAttribute(button, 'aria-pressed', String(chosen === value));
        setAttribute(button, 'disabled', !possible(value));
      });
    },
  };
}

/** What each frame has to show; empty where it has nothing. */
function picturesOf(scene: Scene, session: number): Record<Name, Shown> {
  const { state } = scene;
  const job = state?.design;
  const working = job?.status === 'queued' || job?.status === 'running';
  const look = state?.look ?? null;
  const mood = scene.moods.find((m) => m.name === (working ? job.mood : look?.mood));
  const eye = state?.cameras[0];
  const seen = scene.connected && (eye?.health === 'good' || eye?.health === 'lost');
  const stands = state?.instructions.length ? 'stands not moved yet' : '';
  return {
    before: {
      source: scene.before,
      alt: 'What the camera saw before',
      words: 'the light before your last click',
      note: '',
    },
    reference: {
      source: working ? (mood?.picture ?? '') : (look?.reference ?? ''),
      alt: `Reference: ${mood?.title ?? look?.name ?? ''}`,
      words: 'the mood you choose',
      note: mood?.title ?? '',
    },
    preview: {
      source: state && look ? `${look.placed_picture}?v=${look.id}.${look.edition}` : '',
      alt: 'What the camera should see',
      words: working ? '' : 'what the camera should see',
      note: look ? stands : '',
    },
    camera: {
      source: eye && seen ? `${eye.stream}?s=${session}` : '',
      alt: 'What the camera sees now',
      words: cameraWords(state, eye?.health),
      note: eye?.health === 'lost' ? 'lost, the last picture' : seen ? 'live' : '',
    },
  };
}

function cameraWords(state: State | null, health?: string): string {
  if (!state) return '';
  if (health === undefined || health === 'none') return 'no camera in the studio file';
  return 'waiting for the camera';
}

export function makeViewer(actions: Actions, changed: () => void) {
  const frames = {} as Record<Name, ReturnType<typeof makeFrame>>;
  for (const name of names) frames[name] = makeFrame(name);
  const progress = makeProgress(actions);
  const divider = el('input.divider', { type: 'range', min: '0', max: '100', value: '50', step: '1' }) as HTMLInputElement;
  const place = () => node.style.setProperty('--at', divider.value);
  divider.oninput = place;
  const frame = el('div.pictures', {}, ...names.map((name) => frames[name].node), divider, progress.node);
  let mode: 'wipe' | 'side' = 'wipe';
  let wantsLeft: Name | null = null;
  let wantsRight: Name | null = null;
  const left = makeChoice('On the left', lefts, (name) => labels[name], (name) => {
    wantsLeft = name;
    mode = 'wipe';
    changed();
  });
  const right = makeChoice('On the right', rights, (name) => labels[name], (name) => {
    wantsRight = name;
    mode = 'wipe';
    changed();
  });
  const side = makeChoice<'wipe' | 'side'>(
    'Arrangement',
    ['wipe', 'side'],
    (value) => (value === 'wipe' ? 'Divider' : 'Side by side'),
    (value) => {
      mode = value;
      changed();
    },
  );
  const node = el('div.viewer', {}, frame, el('div.view-bar', {}, left.node, side.node, right.node));
  place();
  let session = 0; // a new connection needs a new stream
  let connected = false;
  return {
    node,
    camera: frames.camera.picture,
    update(scene: Scene) {
      if (scene.connected && !connected) ++session;
      connected = scene.connected;
      progress.update(scene.state?.design ?? null);
      const shown = picturesOf(scene, session);
      for (const name of names) frames[name].update(shown[name]);
      const has = (name: Name) => shown[name].source !== '';
      const onRight = wantsRight && has(wantsRight) ? wantsRight : has('camera') || !has('preview') ? 'camera' : 'preview';
      const free = (name: Name) => has(name) && name !== onRight;
      const onLeft = wantsLeft && free(wantsLeft) ? wantsLeft : (lefts.find(free) ?? null);
      setAttribute(node, 'data-mode', mode);
      for (const name of names)
        setAttribute(frames[name].node, 'data-side', onLeft === name ? 'left' : onRight === name ? 'right' : false);
      show(divider, mode === 'wipe' && onLeft !== null);
      setAttribute(node, 'data-single', onLeft === null);
      if (onLeft) setAttribute(divider, 'aria-label', `Divider between ${labels[onLeft]} and ${labels[onRight]}`);
      left.update(mode === 'wipe' ? onLeft : null, free);
      right.update(mode === 'wipe' ? onRight : null, has);
      side.update(mode, () => true);
    },
  };
}
