// SPDX-License-Identifier: Apache-2.0
// The page: what the daemon tells goes into one scene, each part shows its share of it.
import './style.css';
import type { Actions } from './actions';
import { Refused, api, listen } from './api';
import { makeBar } from './bar';
import { makeInstructions, makeLights, makeProblems } from './lights';
import { makeMoods } from './moods';
import { makeNotices } from './notices';
import { exemplarOf } from './picture';
import { makeStage } from './stage';
import type { Scene } from './state';

const scene: Scene = { state: null, moods: [], connected: false, lostSince: null, refusal: null };
let wantsToken = false;

/** Does what was clicked; a refusal is shown until it is closed or the next click succeeds. */
async function attempt(work: () => Promise<unknown>): Promise<void> {
  try {
    await work();
    scene.refusal = null;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    if (error.status === 401) wantsToken = true;
    else scene.refusal = error.refusal;
  }
  render();
}

const actions: Actions = {
  light: (mood) => void attempt(() => api.light(mood)),
  lightLike: (file) =>
    void attempt(async () => api.lightLike(await exemplarOf(file), file.name.replace(/\.\w+$/, ''))),
  cancel: (job) => void attempt(() => api.cancel(job)),
  undo: () => void attempt(api.undo),
  blackout: (on) => void attempt(() => api.blackout(on)),
  placed: (fixture) => void attempt(() => api.placed(fixture)),
  fader: (fixture, intensity) => void attempt(() => api.fader(fixture, { intensity })),
  release: (fixture) => void attempt(() => api.fader(fixture, { release: true })),
  lock: (fixture, lock) => void attempt(() => api.fader(fixture, { lock })),
  master: (level) => void attempt(() => api.master('grand', level)),
  dismiss: () => {
    scene.refusal = null;
    render();
  },
  signIn: (token) =>
    void attempt(async () => {
      await api.session(token);
      location.reload();
    }),
};

const notices = makeNotices(actions);
const parts = [
  makeBar(actions),
  makeMoods(actions),
  makeStage(actions),
  makeInstructions(actions),
  makeLights(actions),
  makeProblems(),
];

let asked = 0;
/** Once for each screen refresh, however much news came. */
function render(): void {
  asked ||= requestAnimationFrame(() => {
    asked = 0;
    notices(scene, wantsToken);
    for (const part of parts) part(scene);
  });
}

async function loadMoods(): Promise<void> {
  await attempt(async () => {
    scene.moods = await api.moods();
    wantsToken = false;
  });
}

listen({
  state(state) {
    scene.state = state;
    render();
  },
  design(design) {
    if (scene.state) scene.state.design = design;
    render();
  },
  connection(up) {
    if (up && !scene.connected) void loadMoods();
    if (!up) scene.lostSince ??= Date.now();
    else scene.lostSince = null;
    scene.connected = up;
    render();
  },
});
void loadMoods();
render();
