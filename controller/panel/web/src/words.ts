// SPDX-License-Identifier: Apache-2.0
// Numbers and verdicts as people say them.

/** "the port is in use" to "The port is in use." */
export function sentence(words: string): string {
  if (!words) return '';
  const text = words.charAt(0).toUpperCase() + words.slice(1);
  return /[.!?…]$/.test(text) ? text : `${text}.`;
}

const quarters = ['', '¼', '½', '¾'];

/** 0.75 to "+¾", -1.25 to "−1¼". */
export function stops(value: number): string {
  const whole = Math.round(Math.abs(value) * 4);
  if (whole === 0) return '0';
  const text = `${whole >= 4 ? Math.floor(whole / 4) : ''}${quarters[whole % 4] ?? ''}`;
  return `${value < 0 ? '−' : '+'}${text}`;
}

const verdicts: Record<string, string> = {
  reached: 'matches the reference',
  near: 'close to the reference',
  'not reachable': 'not fully reachable with these lamps',
  not_reachable: 'not fully reachable with these lamps',
};

export function verdict(name: string): string {
  return verdicts[name] ?? name;
}

export const whole = new Intl.NumberFormat('en-GB');

export function microseconds(us: number): string {
  return us < 1000 ? `${Math.round(us)} µs` : `${(us / 1000).toFixed(1)} ms`;
}
