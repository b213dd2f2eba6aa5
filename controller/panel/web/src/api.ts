// SPDX-License-Identifier: Apache-2.0
// Talks to the daemon: one request at a time for each click, one event stream for all that changes.
import type { Design, Learnt, LookEntry, Mood, Refusal, Slots, State } from './state';

/** Thrown for every refusal, with the daemon's own words. */
export class Refused extends Error {
  constructor(
    readonly refusal: Refusal,
    readonly status: number,
  ) {
    super(refusal.what);
  }
}

const unreachable: Refusal = {
  what: 'the daemon does not answer',
  where: '',
  remedy: 'see whether chiarod is running',
};

async function ask(method: string, path: string, body?: unknown): Promise<unknown> {
  const form = body instanceof FormData;
  let response: Response;
  try {
    response = await fetch(`/api/v1${path}`, {
      method,
      headers: body === undefined || form ? {} : { 'Content-Type': 'application/json' },
      body: body === undefined ? null : form ? body : JSON.stringify(body),
    });
  } catch {
    throw new Refused(unreachable, 0);
  }
  const answer = response.status === 204 ? {} : await response.json().catch(() => ({}));
  if (response.ok) return answer;
  throw new Refused((answer as { error?: Refusal }).error ?? unreachable, response.status);
}

/** The fade of everything that a click on the page applies. */
const fade = 1;
const of = encodeURIComponent;

export const api = {
  moods: async () => ((await ask('GET', '/moods')) as { moods: Mood[] }).moods,
  looks: async () => ((await ask('GET', '/looks')) as { looks: LookEntry[] }).looks,
  slots: (universe: number) => ask('GET', `/outputs/${universe}/slots`) as Promise<Slots>,
  light: (mood: string) => ask('POST', '/design', { mood, apply: fade }),
  async addMood(picture: Blob, title: string): Promise<string> {
    const form = new FormData();
    form.append('title', title);
    form.append('picture', picture, 'picture');
    return ((await ask('POST', '/moods', form)) as { name: string }).name;
  },
  removeMood: (mood: string) => ask('DELETE', `/moods/${of(mood)}`),
  cancel: (job: number) => ask('DELETE', `/design/${job}`),
  workLight: () => ask('POST', '/work-light', { fade_s: fade }),
  nudge: (what: string, stops: number) => ask('POST', '/nudge', { [what]: stops, fade_s: 0.5 }),
  undo: () => ask('POST', '/undo', { fade_s: fade }),
  save: (name: string) => ask('POST', '/looks', { name }),
  recall: (look: number) => ask('POST', `/looks/${look}/apply`, { fade_s: fade }),
  rename: (look: number, name: string) => ask('PUT', `/looks/${look}`, { name }),
  remove: (look: number) => ask('DELETE', `/looks/${look}`),
  blackout: (on: boolean) => ask('POST', '/blackout', { on }),
  motionStop: (on: boolean) => ask('POST', '/motion-stop', { on }),
  placed: (fixture: string) => ask('POST', `/fixtures/${of(fixture)}/placed`, {}),
  fader: (fixture: string, values: Record<string, number | boolean | null>) =>
    ask('PUT', `/fixtures/${of(fixture)}`, values),
  measured: (fixture: string, reading: Record<string, unknown>) =>
    ask('POST', `/fixtures/${of(fixture)}/measured`, reading),
  master: (name: string, level: number) => ask('PUT', `/masters/${name}`, { level }),
  raise: (universe: number, levels: Map<number, number>) =>
    levels.size === 0
      ? ask('DELETE', '/kit/slots')
      : ask('PUT', '/kit/slots', { universe, slots: Object.fromEntries(levels) }),
  learn: (lamp: Record<string, unknown>) => ask('POST', '/kit', lamp) as Promise<Learnt>,
  reload: () => ask('POST', '/studio/reload', {}),
  /** Hands the token over once; a cookie carries it from then on. */
  async session(token: string): Promise<void> {
    const response = await fetch('/api/v1/session', {
      method: 'POST',
      headers: { Authorization: `Bearer ${token}` },
    });
    if (!response.ok) throw new Refused({ ...unreachable, what: 'this is not the token' }, 401);
  },
};

export interface Listener {
  state(state: State): void;
  design(design: Design): void;
  connection(up: boolean): void;
}

/** Listens for ever; comes back by itself, ever more slowly, at most every three seconds. */
export function listen(listener: Listener): void {
  let pause = 250;
  let silence = 0;
  const connect = () => {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}/api/v1/events`);
    // The daemon tells its state every second: silence means that it hangs or the cable is out.
    const watch = () => {
      clearTimeout(silence);
      silence = window.setTimeout(() => socket.close(), 5000);
    };
    watch();
    socket.onmessage = (event) => {
      watch();
      const message = JSON.parse(event.data as string) as
        | { type: 'state'; state: State }
        | { type: 'design'; design: Design };
      pause = 250;
      listener.connection(true);
      if (message.type === 'state') listener.state(message.state);
      if (message.type === 'design') listener.design(message.design);
    };
    socket.onclose = () => {
      clearTimeout(silence);
      listener.connection(false);
      window.setTimeout(connect, pause);
      pause = Math.min(2 * pause, 3000);
    };
  };
  connect();
}
