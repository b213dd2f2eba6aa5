// SPDX-License-Identifier: Apache-2.0
// A light meter's word on one lamp: typed in as the meter shows it.
import type { Actions } from './actions';
import { el, setText, show } from './dom';
import type { Fixture } from './state';

export function makeMeter(name: string, actions: Actions) {
  const id = `meter-${name.replace(/\W+/g, '-')}`;
  const field = el('input', {
    type: 'text',
    id,
    placeholder: '420 lx, 39 fc, f/5.6 1/50 ISO 100',
    required: true,
  }) as HTMLInputElement;
  const hint = el('p.hint');
  const forget = el('button.quiet', { type: 'button', onclick: () => actions.measured(name, { forget: true }) }, 'Forget the reading');
  const form = el(
    'form.meter',
    {
      hidden: true,
      onsubmit: (event: Event) => {
        event.preventDefault();
        actions.measured(name, { reading: field.value });
      },
    },
    el('label', { for: id }, `Meter at the face, towards ${name}, other lamps off`),
    field,
    el('button', { type: 'submit' }, 'Set'),
    forget,
    hint,
  );
  const open = el(
    'button.quiet',
    {
      type: 'button',
      'aria-label': `Meter reading for ${name}`,
      onclick: () => {
        show(form, form.hidden);
        if (!form.hidden) field.focus();
      },
    },
    'Meter',
  );
  return {
    open,
    form,
    update(fixture: Fixture) {
      show(forget, fixture.measured);
      const candela = `${Math.round(fixture.output_cd).toLocaleString('en-GB')} cd at full`;
      setText(hint, fixture.measured ? `Measured: ${candela}` : `By its data sheet: ${candela}`);
    },
  };
}
