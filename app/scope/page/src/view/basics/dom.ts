// SPDX-License-Identifier: Apache-2.0
/// Small helpers for building and changing the page. Texts are set as text, never as markup: names
/// and words come from files and frames.

type Attribute = string | number | boolean | null | undefined;
type Child = Node | string | null | undefined;

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, Attribute>> = {},
  ...children: readonly Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    set_attribute(node, name, value);
  }
  for (const child of children) {
    if (child !== null && child !== undefined) {
      node.append(child);
    }
  }
  return node;
}

/// Writes only what differs: a panel is refreshed ten times a second and mostly stays as it is.
export function set_attribute(node: Element, name: string, value: Attribute): void {
  if (value === null || value === undefined || value === false) {
    if (node.hasAttribute(name)) {
      node.removeAttribute(name);
    }
    return;
  }
  const words = value === true ? '' : String(value);
  if (node.getAttribute(name) !== words) {
    node.setAttribute(name, words);
  }
}

export function set_text(node: Node, words: string): void {
  const only = node.firstChild;
  if (only instanceof Text && only === node.lastChild) {
    if (only.data !== words) {
      only.data = words;
    }
  } else if (words !== '' || only !== null) {
    node.textContent = words;
  }
}

export function set_shown(node: HTMLElement, shown: boolean): void {
  if (node.hidden === shown) {
    node.hidden = !shown;
  }
}

export function button(
  words: string,
  press: () => void,
  attributes: Readonly<Record<string, Attribute>> = {},
): HTMLButtonElement {
  const node = el('button', {type: 'button', ...attributes}, words);
  node.addEventListener('click', press);
  return node;
}

/// A part of the panel: a region with a heading that names it.
export function section(id: string, title: string, ...children: readonly Child[]): HTMLElement {
  const heading = `${id}-title`;
  return el(
    'section', {id, 'aria-labelledby': heading},
    el('h2', {id: heading}, title), ...children,
  );
}

/// The nodes of a list that grows and shrinks, made once and used again.
export class Rows<Row extends {readonly node: HTMLElement}> {
  private readonly rows: Row[] = [];

  constructor(private readonly parent: HTMLElement, private readonly make: () => Row) {}

  /// The first `count` rows, all of them in the page, the rest taken out of it.
  take(count: number): readonly Row[] {
    while (this.rows.length < count) {
      const row = this.make();
      this.rows.push(row);
      this.parent.append(row.node);
    }
    while (this.rows.length > count) {
      this.rows.pop()?.node.remove();
    }
    return this.rows;
  }
}
