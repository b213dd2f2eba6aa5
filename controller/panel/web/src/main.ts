// SPDX-License-Identifier: Apache-2.0
// The page: what the daemon tells goes into one scene, each part shows its share of it.
import './style.css';
import './technician.css';
import type { Actions } from './actions';
import { Refused, api, listen } from './api';
import { makeBar } from './bar';
import { makeLearn } from './learn';
import { makeLibrary, takeDrops } from './library';
import { makeInstructions, makeLights, makeProblems } from './lights';
import { makeStage } from './look';
import { makeNotices } from './notices';
import { snapshot, titleOf, uploadOf } from './picture';
import type { Scene, State } from './state';
import { makeMonitor, makePorts } from './technician';

const scene: Scene = {
  state: null, moods: [], looks: [], tab: 'studio', before: '', sending: '', connected: false, lostSince: null, refusal: null,
};
let wantsToken = false;

/** Does what was clicked; a refusal is shown until it is closed or the next click succeeds. */
async function attempt<Value>(work: () => Promise<Value>): Promise<Value | null> {
  let value: Value | null = null;
  try {
    value = await work();
    scene.refusal = null;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    if (error.status === 401) wantsToken = true;
    else scene.refusal = error.refusal;
  }
  render();
  return value;
}
const loadMoods = () =>
  attempt(async () => {
    scene.moods = await api.moods();
    wantsToken = false;
  });
const loadLooks = () => attempt(async () => (scene.looks = await api.looks()));
/** Remembers what the camera sees now, then does what changes it. */
const changing = (work: () => Promise<unknown>) => {
  scene.before = snapshot(stage.camera);
  return void attempt(work);
};
const andLooks = (work: () => Promise<unknown>) => void attempt(work).then(loadLooks);

const actions: Actions = {
  light: (mood) => changing(() => api.light(mood)),
  lightLike: (file) =>
    changing(async () => {
      scene.sending = titleOf(file);
      render();
      try {
        const name = await api.addMood(await uploadOf(file), titleOf(file));
        void loadMoods();
        await api.light(name);
      } finally {
        scene.sending = '';
      }
    }),
  forget: (mood) => void attempt(() => api.removeMood(mood)).then(loadMoods),
  cancel: (job) => void attempt(() => api.cancel(job)),
  workLight: () => void attempt(api.workLight),
  nudge: (what, by) => void attempt(() => api.nudge(what, by)),
  undo: () => void attempt(api.undo),
  save: (name) => andLooks(() => api.save(name)),
  recall: (look) => changing(() => api.recall(look)),
  rename: (look, name) => andLooks(() => api.rename(look, name)),
  remove: (look) => andLooks(() => api.remove(look)),
  blackout: (on) => void attempt(() => api.blackout(on)),
  motionStop: (on) => void attempt(() => api.motionStop(on)),
  placed: (fixture) => void attempt(() => api.placed(fixture)),
  fader: (fixture, intensity) => void attempt(() => api.fader(fixture, { intensity })),
  release: (fixture) => void attempt(() => api.fader(fixture, { release: true })),
  lock: (fixture, lock) => void attempt(() => api.fader(fixture, { lock })),
  measured: (fixture, reading) => void attempt(() => api.measured(fixture, reading)),
  master: (name, level) => void attempt(() => api.master(name, level)),
  raise: (universe, levels) => void attempt(() => api.raise(universe, levels)),
  learn: (lamp) => attempt(() => api.learn(lamp)),
  reload: () => void attempt(api.reload).then(loadMoods),
  show: (tab) => {
    scene.tab = tab;
    render();
  },
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
const stage = makeStage(actions, render);
const parts = [
  makeBar(actions),
  makeLibrary(actions, render),
  stage.update,
  makeInstructions(actions),
  makeLights(actions),
  makeProblems(),
  makePorts(actions),
  makeMonitor(),
  makeLearn(actions),
];
takeDrops(actions);

let asked = 0;
/** Once for each screen refresh, however much news came. */
function render(): void {
  asked ||= requestAnimationFrame(() => {
    asked = 0;
    notices(scene, wantsToken);
    for (const part of parts) part(scene);
  });
}

let live = '';
let missed = '';
/** A mood that this page has not heard of was added elsewhere, on another tablet. */
function missing(state: State): string {
  const named = [state.look?.mood, state.design?.mood];
  return named.find((name) => name && !scene.moods.some((mood) => mood.name === name)) ?? '';
}
listen({
  state(state) {
    scene.state = state;
    const unknown = missing(state);
    if (unknown && unknown !== missed) void loadMoods();
    missed = unknown;
    // The list of looks changes with the live one.
    const now = `${state.look?.id} ${state.look?.kept} ${state.look?.name}`;
    if (now !== live) void loadLooks();
    live = now;
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
