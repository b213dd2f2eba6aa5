// SPDX-License-Identifier: Apache-2.0
// A few small helpers in place of a framework.

type Child = Node | string | null | false;

/** `el('button.big', {type: 'button', onclick}, 'Text')` */
export function el(
  spec: string,
  attributes: Record<string, unknown> = {},
  ...children: Child[]
): HTMLElement {
  const [tag, ...classes] = spec.split('.');
  const node = document.createElement(tag || 'div');
  if (classes.length) node.className = classes.join(' ');
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') (node as unknown as Record<string, unknown>)[name] = value;
    else setAttribute(node, name, value);
  }
  for (const child of children) if (child !== null && child !== false) node.append(child);
  return node;
}

/** Touches the page only where something changed, so that focus and screen readers are left alone. */
export function setAttribute(node: Element, name: string, value: unknown): void {
  if (value === false || value === null || value === undefined) {
    if (node.hasAttribute(name)) node.removeAttribute(name);
    return;
  }
  const text = value === true ? '' : String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

export function setText(node: Element, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

export function show(node: HTMLElement, visible: boolean): void {
  if (node.hidden === visible) node.hidden = !visible;
}

export function byId(id: string): HTMLElement {
  const node = document.getElementById(id);
  if (!node) throw new Error(`the page has no #${id}`);
  return node;
}

/** Keeps one child per key, in order: makes, updates and drops as the list changes. */
export function keyed<Item, Part extends { node: HTMLElement; update(item: Item): void }>(
  parent: HTMLElement,
  keyOf: (item: Item) => string,
  make: (item: Item) => Part,
): (items: Item[]) => void {
  const parts = new Map<string, Part>();
  return (items) => {
    const keys = new Set(items.map(keyOf));
    for (const [key, part] of parts) {
      if (keys.has(key)) continue;
      part.node.remove();
      parts.delete(key);
    }
    items.forEach((item, place) => {
      const key = keyOf(item);
      let part = parts.get(key);
      if (!part) parts.set(key, (part = make(item)));
      if (parent.children[place] !== part.node)
        parent.insertBefore(part.node, parent.children[place] ?? null);
      part.update(item);
    });
  };
}
