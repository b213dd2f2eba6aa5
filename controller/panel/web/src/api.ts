// SPDX-License-Identifier: Apache-2.0
// Talks to the daemon: one request at a time for each click, one event stream for all that changes.
import type { Design, Mood, Refusal, State } from './state';

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
  let response: Response;
  try {
    response = await fetch(`/api/v1${path}`, {
      method,
      headers: body === undefined ? {} : { 'Content-Type': 'application/json' },
      body: body === undefined ? null : JSON.stringify(body),
    });
  } catch {
    throw new Refused(unreachable, 0);
  }
  const answer = response.status === 204 ? {} : await response.json().catch(() => ({}));
  if (response.ok) return answer;
  throw new Refused((answer as { error?: Refusal }).error ?? unreachable, response.status);
}

/** The fade of everything that a click on the page applies. */
const fade = 1.5;

export const api = {
  state: () => ask('GET', '/state') as Promise<State>,
  moods: async () => ((await ask('GET', '/moods')) as { moods: Mood[] }).moods,
  light: (mood: string) => ask('POST', '/design', { mood, apply: fade }),
  lightLike: (exemplar: string, title: string) =>
    ask('POST', '/design', { exemplar, title, apply: fade }),
  cancel: (job: number) => ask('DELETE', `/design/${job}`),
  undo: () => ask('POST', '/undo', { fade_s: fade }),
  blackout: (on: boolean) => ask('POST', '/blackout', { on }),
  placed: (fixture: string) => ask('POST', `/fixtures/${encodeURIComponent(fixture)}/placed`, {}),
  fader: (fixture: string, values: Record<string, number | boolean | null>) =>
    ask('PUT', `/fixtures/${encodeURIComponent(fixture)}`, values),
  master: (name: string, level: number) => ask('PUT', `/masters/${name}`, { level }),
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
