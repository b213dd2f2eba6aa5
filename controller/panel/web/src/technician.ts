// SPDX-License-Identifier: Apache-2.0
// For whoever looks after the cables: how each port keeps time, and what is in every slot.
import type { Actions } from './actions';
import { api } from './api';
import { byId, el, keyed, setAttribute, setText, show } from './dom';
import type { Camera, Output, Scene, Slots, State } from './state';
import { microseconds, whole } from './words';

const slotCount = 512;

function makeRow(cells: number) {
  const parts = Array.from({ length: cells }, () => el('td'));
  const node = el('tr', {}, ...parts);
  return {
    node,
    say: (words: string[]) => words.forEach((word, i) => parts[i] && setText(parts[i], word)),
  };
}

function makePort() {
  const row = makeRow(7);
  return {
    node: row.node,
    update(port: Output) {
      setAttribute(row.node, 'data-health', port.health);
      row.say([
        String(port.universe),
        port.health,
        `${port.rate_hz} a second`,
        whole.format(port.frames),
        `${microseconds(port.jitter_us_p50)} · ${microseconds(port.jitter_us_p99)} · ${microseconds(port.jitter_us_p999)}`,
        whole.format(port.late),
        `${whole.format(port.missed)} · ${whole.format(port.failed)}`,
      ]);
    },
  };
}

function makeCamera() {
  const row = makeRow(4);
  return {
    node: row.node,
    update(camera: Camera) {
      setAttribute(row.node, 'data-health', camera.health);
      row.say([camera.name, camera.health, whole.format(camera.frames), whole.format(camera.reconnects)]);
    },
  };
}

function makeTable(heads: string[], caption: string) {
  const body = el('tbody');
  const node = el(
    'div.scroll',
    {},
    el(
      'table',
      {},
      el('caption', {}, caption),
      el('thead', {}, el('tr', {}, ...heads.map((head) => el('th', { scope: 'col' }, head)))),
      body,
    ),
  );
  return { node, body };
}

function motionWords({ motion }: State): string {
  if (motion.stopped) return 'Motion: stopped · ';
  const waiting = motion.axes_waiting;
  return waiting ? `Motion: ${waiting} ${waiting === 1 ? 'axis waits' : 'axes wait'} to be armed · ` : '';
}

export function makePorts(actions: Actions): (scene: Scene) => void {
  const programs = el('p.programs');
  const ports = makeTable(
    ['Universe', 'Port', 'Rate', 'Frames', 'Jitter: median · 99 % · 99.9 %', 'Late', 'Missed · failed'],
    'Outputs',
  );
  const cameras = makeTable(['Camera', 'Health', 'Pictures', 'Came back'], 'Cameras');
  let stopped = false;
  const motion = el('button', { type: 'button', onclick: () => actions.motionStop(!stopped) });
  const none = el('p.hint', {}, 'No port reports: the output process is not there.');
  byId('ports').append(
    el(
      'div.headline',
      {},
      el('h2', { id: 'ports-title' }, 'Ports'),
      el(
        'div.acts',
        {},
        motion,
        el('button', { type: 'button', onclick: () => actions.reload() }, 'Read the studio file again'),
      ),
    ),
    programs,
    ports.node,
    none,
    cameras.node,
  );
  const updatePorts = keyed<Output, ReturnType<typeof makePort>>(ports.body, (port) => String(port.universe), makePort);
  const updateCameras = keyed<Camera, ReturnType<typeof makeCamera>>(cameras.body, (camera) => camera.name, makeCamera);
  return ({ state, tab }) => {
    if (!state || tab !== 'technician') return;
    const hand = state.hand.connected
      ? `Output process: running, ${state.hand.real_time ? 'real-time rights granted' : 'without real-time rights'}`
      : 'Output process: does not answer';
    setText(programs, `${hand} · Caution: ${state.caution} · ${motionWords(state)}Studio file: ${state.studio.file}`);
    stopped = state.motion.stopped;
    setText(motion, stopped ? 'Release motion stop' : 'Motion stop');
    setAttribute(motion, 'aria-pressed', String(stopped));
    show(ports.node, state.outputs.length > 0);
    show(none, state.outputs.length === 0);
    updatePorts(state.outputs);
    show(cameras.node, state.cameras.length > 0);
    updateCameras(state.cameras);
  };
}

function makeGrid() {
  const cells = Array.from({ length: slotCount }, (_, i) => el('li', { 'data-slot': i + 1 }));
  const grid = el('ol.slots', {}, ...cells);
  const pointed = el('p.hint', { role: 'status' }, 'Point at a slot to see whose it is.');
  let owner: string[] = [];
  let levels: number[] = [];
  const point = (event: Event) => {
    const slot = Number((event.target as HTMLElement).dataset.slot);
    if (!slot) return;
    const level = levels[slot - 1] ?? 0;
    const percent = Math.round((100 * level) / 255);
    setText(pointed, `Slot ${slot}: ${owner[slot - 1] ?? 'no lamp'}, ${level} of 255 (${percent} %)`);
  };
  grid.addEventListener('pointerover', point);
  grid.addEventListener('pointerdown', point);
  return {
    grid,
    pointed,
    update(slots: Slots) {
      owner = [];
      for (const { fixture, first, last } of slots.owners)
        for (let slot = first; slot <= last; slot++) owner[slot - 1] = fixture;
      levels = slots.slots;
      setAttribute(grid, 'aria-label', `Slot levels of universe ${slots.universe}`);
      cells.forEach((cell, i) => {
        const level = levels[i] ?? 0;
        setText(cell, level ? String(level) : '·');
        cell.style.setProperty('--level', String(level / 255));
        setAttribute(cell, 'data-on', level > 0);
        setAttribute(cell, 'data-owned', owner[i] !== undefined);
        setAttribute(cell, 'data-first', owner[i] !== undefined && owner[i] !== owner[i - 1]);
      });
    },
  };
}

/** What is really sent, four times a second, while somebody looks. */
export function makeMonitor(): (scene: Scene) => void {
  const section = byId('monitor');
  const pick = el('select', { id: 'universe', 'aria-label': 'Universe' }) as HTMLSelectElement;
  const grid = makeGrid();
  section.append(
    el(
      'div.headline',
      {},
      el('h2', { id: 'monitor-title' }, 'DMX monitor'),
      el('label.pick', { for: 'universe' }, 'Universe ', pick),
    ),
    grid.grid,
    grid.pointed,
  );
  let universes = '';
  let timer = 0;
  let shown = false;
  const look = async () => {
    const universe = Number(pick.value);
    if (universe) {
      const slots = await api.slots(universe).catch(() => null);
      if (slots) grid.update(slots);
    }
    timer = shown ? window.setTimeout(look, 250) : 0;
  };
  return ({ state, tab, connected }) => {
    const now = state?.outputs.map((output) => output.universe) ?? [];
    shown = tab === 'technician' && connected && now.length > 0;
    show(section, now.length > 0);
    if (universes !== now.join()) {
      universes = now.join();
      const chosen = pick.value;
      pick.replaceChildren(...now.map((universe) => el('option', { value: universe }, String(universe))));
      if (now.map(String).includes(chosen)) pick.value = chosen;
    }
    if (shown && !timer) {
      timer = 1;
      void look();
    }
  };
}
