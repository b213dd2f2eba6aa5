// SPDX-License-Identifier: Apache-2.0
// A slider that a person may hold while news come in, and that tells at most ten times a second.
import { el } from './dom';

export function makeFader(label: string, told: (level: number) => void) {
  const slider = el('input.fader', {
    type: 'range',
    min: '0',
    max: '100',
    step: '1',
    'aria-label': label,
  }) as HTMLInputElement;
  let timer = 0;
  let until = 0;
  slider.oninput = () => {
    until = Date.now() + 1000;
    timer ||= window.setTimeout(() => {
      timer = 0;
      told(Number(slider.value) / 100);
    }, 100);
  };
  return {
    node: slider,
    update(level: number) {
      if (Date.now() < until) return;
      const value = String(Math.round(100 * level));
      if (slider.value !== value) slider.value = value;
    },
  };
}
